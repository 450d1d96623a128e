! SPDX-License-Identifier: BSD-3-Clause
!> Trajectory of one scene: its model integrated from its history to t_end. Samples go to the file
!> in pieces while the integration runs, only the variables that the scene lists. Where the fast
!> state of a block alone relaxes within the sample interval, they also follow the steps of the
!> solver, so that events shorter than the interval are resolved. Those of a chain are over time and
!> block, of a network over time and node.
module trajectory_command
   use dde, only: integrate, integration_result, sampler_type, stop_requested
   use dde_errors, only: error_type, text
   use dde_kinds, only: int64, wp
   use model_attributes, only: name_of_blocks
   use model_chain, only: blocks_in_order
   use model_description, only: description_type
   use model_history, only: display_names, shown_name
   use progress_receiver, only: progress_receiver_type
   use request, only: request_type
   use results, only: results_type
   use scene_request, only: read_scene, scene_type
   use value_checks, only: check_choice
   implicit none (type, external)
   private
   public :: run_trajectory

   !> Samples held before they are written: of one block, and at least.
   integer, parameter :: most_held = 8192, least_held = 32

   !> Longest time between samples as a share of the step, where they follow the steps. The largest
   !> sample of a slip event is within 0.2 % of its maximum, measured for gamma from 100 to 1e10.
   real(wp), parameter :: largest_share = 0.25_wp

   !> Sampler that fills a trajectory.
   type, extends(sampler_type) :: trajectory_sampler_type
      !> The trajectory
      class(results_type), pointer :: data => null()
      !> Who is told of the samples received
      class(progress_receiver_type), allocatable :: progress
      !> Last time, and the time between even samples
      real(wp) :: t_end = 0.0_wp, interval = 0.0_wp
      !> Which variables are exponentials of their components
      logical, allocatable :: exponential(:)
      !> Times of samples not written yet, and their values, shape (blocks, variables, samples)
      real(wp), allocatable :: time(:), values(:, :, :)
      !> Number of samples in the file, and of those not written yet
      integer :: written = 0, held = 0
      !> Number of even times reached, and of all
      integer :: reached = 0, times = 0
      !> The next even time
      real(wp) :: even = 0.0_wp
   contains
      procedure :: begin, take
      procedure, private :: flush => flush_samples
   end type trajectory_sampler_type

contains

   !> Run the command.
   subroutine run_trajectory(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(scene_type) :: scene
      type(trajectory_sampler_type) :: samples

      call read_scene(given, scene, error)
      if (allocated(error)) return
      samples%data => data
      call move_alloc(given%progress, samples%progress)
      call samples%begin(given%place, scene, error)
      if (allocated(error)) return
      call integrate(scene%problem, 0.0_wp, scene%t_end, scene%options(), outcome, error, samples)
      if (allocated(data%error)) then
         stop_requested = 0
         error = data%error
      end if
      if (allocated(error)) return
      call samples%flush()
      call put_outcome(data, scene, outcome)
   end subroutine run_trajectory

   !> Begin the trajectory of a scene.
   subroutine begin(self, place, scene, error)
      class(trajectory_sampler_type), intent(inout) :: self
      !> What stands before messages
      character(len=*), intent(in) :: place
      type(scene_type), intent(in) :: scene
      !> A variable that there is not
      type(error_type), allocatable, intent(inout) :: error
      character(len=len(scene%variables)), allocatable :: names(:)
      type(description_type) :: about
      character(len=:), allocatable :: meaning
      integer, allocatable :: components(:), places(:)
      integer :: block, dimension, i, length, over(2), variables
      logical :: refined

      self%t_end = scene%t_end
      self%interval = scene%sample_interval
      about = scene%problem%describe()
      names = pack(scene%variables, scene%variables /= "")
      if (size(names) == 0) names = display_names(about)
      variables = size(names)
      call find_components(place, about, names, components, self%exponential, error)
      if (allocated(error)) return
      associate (blocks => scene%problem%shape%blocks, model => scene%problem)
         ! the quotient may be one rounding below a whole number
         self%times = floor(scene%t_end/scene%sample_interval*(1.0_wp + epsilon(1.0_wp))) + 1
         refined = blocks == 1 .and. model%sizes%observed%integral > 0
         if (refined) refined = model%relaxation_rate(0.0_wp, model%steady_state()) &
                                *scene%sample_interval > 1.0_wp
         if (refined) self%share_of_step = largest_share
         length = max(least_held, most_held/blocks)
         allocate (places(blocks))
         allocate (self%time(length), self%values(blocks, variables, length))
         call self%data%attribute("title", "Trajectory of a model")
         ! length 0 is NetCDF's unlimited dimension
         dimension = self%data%dimension("t", merge(0, self%times, refined))
         call self%data%column(dimension, "t", [real(wp) ::], "time")
         do i = 1, variables
            meaning = trim(about%meanings(components(i)))
            if (self%exponential(i)) meaning = "exp("//trim(about%states(components(i)))//")"
            if (blocks > 1) then
               over = [self%data%dimension(name_of_blocks(model), blocks), dimension]
               call self%data%table(over, trim(names(i)), self%values(:, i, :0), meaning)
            else
               call self%data%column(dimension, trim(names(i)), &
                                       self%values(1, i, :0), meaning)
            end if
         end do
         places(blocks_in_order(blocks, trim(model%ends))) = [(block, block=1, blocks)]
         self%wanted = [((model%states()*(places(block) - 1) + components(i), &
                            block=1, blocks), i=1, variables)]
      end associate
      self%next = 0.0_wp
      call self%progress%begin("trajectory of "//trim(scene%name)//" (about "//text( &
                                 ceiling(8.0e-6_wp*self%times*(1 + size(self%wanted)))) &
                                 //" MB before compression)")
   end subroutine begin

   !> The components of variables by their names.
   subroutine find_components(place, about, variables, components, exponential, error)
      !> What stands before messages
      character(len=*), intent(in) :: place
      !> What the definition says
      type(description_type), intent(in) :: about
      character(len=*), intent(in) :: variables(:)
      integer, allocatable, intent(out) :: components(:)
      !> Whether a variable is the exponential of its component
      logical, allocatable, intent(out) :: exponential(:)
      !> Error if there is no variable of a name
      type(error_type), allocatable, intent(inout) :: error
      integer :: i, number

      allocate (components(size(variables)), exponential(size(variables)))
      do i = 1, size(variables)
         call check_choice(error, place, "variable", variables(i), &
                           [about%states, about%auxiliaries%name])
         if (allocated(error)) return
         components(i) = findloc(about%states, variables(i), dim=1)
         exponential(i) = components(i) == 0
         number = findloc(about%auxiliaries%name, variables(i), dim=1)
         if (exponential(i)) components(i) = about%auxiliaries(number)%state
      end do
   end subroutine find_components

   !> Take one sample; the next one is at the next even time, unless the solver brings it forward.
   subroutine take(self, y)
      class(trajectory_sampler_type), intent(inout) :: self
      !> Components as wanted
      real(wp), intent(in) :: y(:)
      integer :: i

      if (self%held == size(self%time)) call self%flush()
      ! a sampler cannot end the integration otherwise
      if (allocated(self%data%error)) stop_requested = 1
      self%held = self%held + 1
      self%time(self%held) = self%next
      associate (now => self%values(:, :, self%held))
         now = reshape(y, shape(now))
         do i = 1, size(now, 2)
            if (self%exponential(i)) now(:, i) = exp(now(:, i))
         end do
      end associate
      if (self%next >= self%even) then
         self%reached = self%reached + 1
         self%even = huge(1.0_wp)
         if (self%reached < self%times) then
            self%even = min(self%reached*self%interval, self%t_end)
         end if
         call self%progress%advance(self%reached, self%times)
      end if
      self%next = self%even
   end subroutine take

   !> Write the samples that are held.
   subroutine flush_samples(self)
      class(trajectory_sampler_type), intent(inout) :: self
      integer :: i

      self%data%variables(1)%reals = self%time(:self%held)
      do i = 2, size(self%data%variables)
         self%data%variables(i)%reals = [self%values(:, i - 1, :self%held)]
      end do
      call self%data%write_values(first=self%written + 1)
      self%written = self%written + self%held
      self%held = 0
   end subroutine flush_samples

   !> The scene, and what the integration did.
   subroutine put_outcome(data, scene, outcome)
      class(results_type), intent(inout) :: data
      type(scene_type), intent(in) :: scene
      type(integration_result), intent(in) :: outcome
      character(len=:), allocatable :: switches
      integer :: i

      call scene%put(data)
      associate (observed => scene%problem%sizes%observed)
         if (observed%integral > 0) then
            call data%attribute("integral", shown_name(scene%problem, observed%integral))
            call data%attribute("integral_slope", merge(1.0_wp, 0.0_wp, observed%with_time))
         end if
      end associate
      call data%attribute("t_end", scene%t_end)
      call data%attribute("t_transient", scene%t_transient)
      call data%attribute("sample_interval", scene%sample_interval)
      call data%attribute("tolerance", scene%tolerance)
      call data%attribute("method", trim(scene%method))
      call data%attribute("steps_accepted", outcome%accepted)
      call data%attribute("steps_rejected", outcome%rejected)
      call data%attribute("steps_implicit", outcome%implicit_steps)
      call data%attribute("evaluations", outcome%evaluations)
      call data%attribute("breaking_points", int(outcome%breaking_points, int64))
      switches = ""
      do i = 1, scene%problem%switches
         switches = switches//"; "//scene%problem%name_of("switching", i)//": " &
                    //text(outcome%switched(i))
      end do
      if (switches /= "") call data%attribute("switches", switches(3:))
   end subroutine put_outcome
end module trajectory_command
