! SPDX-License-Identifier: BSD-3-Clause
!> Lyapunov exponents of one scene, at its own tolerance, at others, and with shorter steps.
module exponents_command
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: integration_options
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use exponent_averages, only: average_growth, dimension_of, exponent_type, running_averages, &
                                sign_of, zero
   use lyapunov_spectrum, only: expect_smooth, growth_settings_type, growth_type, measure_growth
   use request, only: elements, request_type
   use rest, only: judge_flow
   use results, only: results_type
   use scene_request, only: scene_settings_type, scene_type
   use value_checks, only: absent, check_count, check_number, missing, missing_count, most_samples
   implicit none (type, external)
   private
   public :: run_exponents

   !> What is measured.
   type :: exponents_settings_type
      !> Number of exponents, that of the flow among them
      integer :: count = missing_count
      !> Time at which measuring ends
      real(wp) :: t_end = missing
      !> Time before measuring in which the vectors turn
      real(wp) :: t_turning = missing
      !> Longest time between two orthonormalisations
      real(wp) :: interval = missing
      !> Number of batches of the time
      integer :: batches = missing_count
      !> Greatest absolute value of a zero exponent, longest error bar of one
      real(wp) :: zero_level = missing, longest_bar = missing
      !> Tolerances at which all is measured once more
      real(wp) :: check_tolerances(8) = absent
      !> Longest steps with which all is measured once more
      real(wp) :: check_steps(8) = absent
   contains
      procedure :: options_of_runs
   end type exponents_settings_type

   !> Most times of running averages.
   integer, parameter :: most_times = 400

contains

   !> Run the command.
   subroutine run_exponents(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(exponents_settings_type) :: settings
      type(growth_type), allocatable :: measured(:)
      type(integration_options), allocatable :: options(:)
      type(scene_type) :: scene
      integer :: i
      logical :: neutral

      call read_exponents(given, scene, settings, error)
      if (.not. allocated(error)) call expect_smooth(scene%problem, error)
      if (allocated(error)) return
      options = settings%options_of_runs(scene%options())
      allocate (measured(size(options)))
      call judge_flow(scene%problem, scene%t_transient, settings%t_end, options(1), neutral, error)
      if (allocated(error)) return
      call given%progress%begin("exponents of "//trim(scene%name), parts=size(options))
      do i = 1, size(options)
         call given%progress%begin_part(i)
         call measure_growth(scene%problem, &
                             growth_settings_type(settings%count, scene%t_transient, &
                                                  settings%t_end, settings%t_turning, &
                                                  settings%interval, settings%batches, &
                                                  across_flow=neutral .and. settings%count > 1), &
                             options(i), measured(i), error, progress=given%progress)
         if (allocated(error)) return
      end do
      call put_exponents(data, scene, settings, options, measured)
   end subroutine run_exponents

   !> Options of all runs: those of the scene, others with its tolerances, and with shorter steps.
   pure function options_of_runs(self, own) result(options)
      class(exponents_settings_type), intent(in) :: self
      !> Options of the scene
      type(integration_options), intent(in) :: own
      type(integration_options), allocatable :: options(:)

      associate (tolerances => elements(self%check_tolerances), steps => elements(self%check_steps))
         allocate (options(1 + size(tolerances) + size(steps)), source=own)
         options(2:1 + size(tolerances))%relative = tolerances
         options(2:1 + size(tolerances))%absolute = tolerances
         options(2 + size(tolerances):)%longest_step = steps
      end associate
   end function options_of_runs

   !> Read and check a scene and the settings of its exponents.
   subroutine read_exponents(given, opened, exponents, error)
      class(request_type), intent(inout) :: given
      type(scene_type), intent(out) :: opened
      type(exponents_settings_type), intent(out) :: exponents
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(scene_settings_type) :: scene
      namelist /settings/ scene, exponents

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      call opened%open(given, scene, error)
      call check_count(error, given%place, "exponents%count", exponents%count, at_least=1, &
                       at_most=1000)
      call check_count(error, given%place, "exponents%batches", exponents%batches, at_least=2, &
                       at_most=100000)
      call check_number(error, given%place, "exponents%t_end", exponents%t_end, &
                        above=opened%t_transient)
      call check_number(error, given%place, "exponents%interval", exponents%interval, &
                        at_least=exponents%t_end/most_samples*exponents%count)
   end subroutine read_exponents

   !> The exponents of a scene: the first run has its own settings, the others are checks.
   subroutine put_exponents(data, scene, settings, options, measured)
      class(results_type), intent(inout) :: data
      type(scene_type), intent(in) :: scene
      type(exponents_settings_type), intent(in) :: settings
      !> Tolerances and longest steps
      type(integration_options), intent(in) :: options(:)
      !> Growth with each
      type(growth_type), intent(in) :: measured(:)
      type(exponent_type), allocatable :: exponents(:)
      real(wp), dimension(settings%count, size(options)) :: bars, values
      real(wp), dimension(size(options)) :: dimension, dimension_error
      real(wp), allocatable :: averages(:, :), batches(:, :), time(:)
      integer :: i, ids(4), signs(settings%count, size(options))
      logical :: flow

      allocate (batches(settings%count, settings%batches))
      flow = size(measured(1)%growth, 1) < settings%count
      do i = size(options), 1, -1
         exponents = average_growth(measured(i)%growth, measured(i)%length, settings%batches, flow)
         values(:, i) = exponents%value
         bars(:, i) = exponents%error
         signs(:, i) = sign_of(exponents, settings%zero_level, settings%longest_bar)
         call dimension_of(exponents, settings%zero_level, dimension(i), dimension_error(i))
      end do
      do i = 1, settings%count
         batches(i, :) = exponents(i)%batches
      end do
      associate (first => measured(1))
         call running_averages(with_flow(first%growth, flow), first%length, most_times, time, &
                               averages)
         call data%attribute("title", "Lyapunov exponents of a motion")
         ids = [data%dimension("exponent", settings%count), &
                data%dimension("run", size(options), coordinates="tolerance longest_step"), &
                data%dimension("t", size(time)), data%dimension("time_block", settings%batches)]
         call data%column(ids(2), "tolerance", options%relative, &
                          "tolerance, the scene's own first")
         call data%column(ids(2), "longest_step", &
                          merge(options%longest_step, ieee_value(1.0_wp, ieee_quiet_nan), &
                                options%longest_step < huge(1.0_wp)), &
                          "longest step allowed, if any")
         call data%column(ids(2), "mean_step", measured%time/max(1_int64, measured%steps), &
                          "mean step, also of the history")
         call data%column(ids(2), "dimension", dimension, "Kaplan-Yorke dimension")
         call data%column(ids(2), "dimension_error", dimension_error, "its standard error")
         call data%column(ids(3), "t", first%t_begin + time, "time")
         call data%table(ids([1, 2]), "value", values, "exponent")
         call data%table(ids([1, 2]), "error", bars, "standard error from blocks")
         call data%table(ids([1, 2]), "sign", real(signs, wp), "sign of the exponent, 2: unclear")
         call data%table(ids([1, 4]), "block_value", batches, "exponent in each block")
         call data%table(ids([1, 3]), "running_average", averages, "plain average up to a time")
         call scene%put(data)
         call data%attribute("method", trim(scene%method))
         call data%attribute("t_begin", first%t_begin)
         call data%attribute("t_end", settings%t_end)
         call data%attribute("t_turning", settings%t_turning)
         call data%attribute("interval", first%interval)
         call data%attribute("zero_level", settings%zero_level)
         call data%attribute("longest_bar", settings%longest_bar)
         call data%attribute("zero_exponents", int(count(signs(:, 1) == zero), int64))
         call data%attribute("least_share", first%least_share)
         call data%attribute("steps_accepted", first%steps)
         call data%attribute("steps_implicit", first%implicit_steps)
         call data%attribute("evaluations", first%evaluations)
      end associate
   end subroutine put_exponents

   !> The growth of the vectors and, if wanted, after those that grow that of the flow: none.
   pure function with_flow(growth, flow) result(whole)
      !> Growth of the vectors, shape (vectors, intervals)
      real(wp), intent(in) :: growth(:, :)
      logical, intent(in) :: flow
      real(wp) :: whole(size(growth, 1) + merge(1, 0, flow), size(growth, 2))
      integer :: growing

      if (.not. flow) then
         whole = growth
         return
      end if
      growing = count(sum(growth, dim=2) > 0.0_wp)
      whole(:growing, :) = growth(:growing, :)
      whole(growing + 1, :) = 0.0_wp
      whole(growing + 2:, :) = growth(growing + 1:, :)
   end function with_flow
end module exponents_command
