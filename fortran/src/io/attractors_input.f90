!> How attractors are found and judged, and at which points, from a namelist.
module attractors_input
   use attractors, only: attractor_settings_type
   use block_parameters, only: absent_history, block_history_type
   use dde, only: integration_options
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use namelist_input, only: namelist_file_type, word_length
   use points_input, only: points_settings_type
   use value_checks, only: absent, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: read_attractors

   !> Most histories.
   integer, parameter :: most_histories = 1000

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
   subroutine read_attractors(path, observation, options, points, histories, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> How attractors are judged
      type(attractor_settings_type), intent(out) :: observation
      !> Method, tolerances and limits
      type(integration_options), intent(out) :: options
      !> Where they are looked for
      type(points_settings_type), intent(out) :: points
      !> Histories from which they are reached
      type(block_history_type), allocatable, intent(out) :: histories(:)
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      type(solver_settings_type) :: solver
      namelist /settings/ observation, solver, points, histories

      allocate (histories(most_histories), source=absent_history)
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      histories = pack(histories, min(histories%theta, histories%u, histories%v) < absent)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      options = integration_options(method=trim(solver%method), relative=solver%tolerance, &
                                    absolute=solver%tolerance, most_steps=solver%most_steps)
      call check_number(error, path//": observation", "interval", observation%interval, &
                        above=0.0_wp)
      call points%check(path//": points", histories, error)
   end subroutine read_attractors
end module attractors_input
