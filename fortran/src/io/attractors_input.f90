!> How attractors are found and judged, and at which points, from a namelist.
module attractors_input
   use attractors, only: attractor_settings_type
   use block_parameters, only: absent_history, block_history_type
   use dde, only: integration_options, methods
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use namelist_input, only: namelist_file_type, word_length
   use points_input, only: check_points, points_settings_type
   use spectrum_input, only: check_spectrum
   use value_checks, only: absent, check_choice, check_count, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: read_attractors

   !> Most histories.
   integer, parameter :: most_histories = 1000
   !> Most doublings of the time that exponents take.
   integer, parameter :: most_doublings = 10
   !> Most samples at a point.
   real(wp), parameter :: most_samples = 1.0e8_wp
   !> Longest path kept of a point.
   real(wp), parameter :: longest_path = 1.0e5_wp

   !> How the solver takes steps.
   type :: solver_settings_type
      !> One of the solver's methods
      character(len=word_length) :: method = ""
      !> Relative and absolute tolerance of one step
      real(wp) :: tolerance = missing
      !> Most steps of one integration
      integer(int64) :: most_steps = missing_count
   end type solver_settings_type

contains

   !> Read and check all sections.
   subroutine read_attractors(path, observation, options, points, given, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> How attractors are judged
      type(attractor_settings_type), intent(out) :: observation
      !> Method, tolerances and limits
      type(integration_options), intent(out) :: options
      !> Where they are looked for
      type(points_settings_type), intent(out) :: points
      !> Histories from which they are reached
      type(block_history_type), allocatable, intent(out) :: given(:)
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      type(block_history_type), allocatable :: histories(:)
      type(solver_settings_type) :: solver
      namelist /settings/ observation, solver, points, histories

      allocate (histories(most_histories), source=absent_history)
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      histories = pack(histories, min(histories%theta, histories%u, histories%v) < absent)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_observation(path//": observation", observation, error)
      call check_choice(error, path//": solver", "method", solver%method, methods)
      call check_number(error, path//": solver", "tolerance", solver%tolerance, above=0.0_wp)
      call check_number(error, path//": solver", "most_steps", real(solver%most_steps, wp), &
                        at_least=1.0_wp)
      options = integration_options(method=trim(solver%method), relative=solver%tolerance, &
                                    absolute=solver%tolerance, most_steps=solver%most_steps)
      call move_alloc(histories, given)
      call check_points(path//": points", points, given, error)
   end subroutine read_attractors

   !> Refuse settings by which no point, or no point in a reasonable time, could be judged; keep an
   !> earlier error.
   pure subroutine check_observation(place, observation, error)
      character(len=*), intent(in) :: place
      type(attractor_settings_type), intent(in) :: observation
      type(error_type), allocatable, intent(inout) :: error

      associate (o => observation)
         call check_number(error, place, "t_transient", o%t_transient, above=0.0_wp)
         call check_number(error, place, "t_observed", o%t_observed, above=0.0_wp)
         call check_number(error, place, "t_lasting", o%t_lasting, at_least=0.0_wp)
         call check_number(error, place, "t_turning", o%t_turning, at_least=0.0_wp)
         call check_number(error, place, "t_path", o%t_path, at_least=0.0_wp, at_most=longest_path)
         call check_number(error, place, "interval", o%interval, above=0.0_wp)
         call check_count(error, place, "exponents", o%exponents, at_least=2)
         call check_count(error, place, "doublings", o%doublings, 0, at_most=most_doublings)
         call check_number(error, place, "sample_interval", o%sample_interval, above=0.0_wp, &
                           at_most=o%t_observed)
         call check_spectrum(error, place, o%window, o%segments, o%overlap)
         if (allocated(error)) return
         call check_number(error, place, "number of samples t_observed/sample_interval", &
                           o%t_observed/o%sample_interval, at_most=most_samples)
      end associate
   end subroutine check_observation
end module attractors_input
