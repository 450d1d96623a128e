!> Cases and what to measure of them, from a namelist.
module measure_input
   use block_parameters, only: block_history_type, block_parameters_type, missing_history, &
                               missing_parameters
   use cases_input, only: case_section_type, join_cases, keep_given, most_cases
   use dde, only: solver_methods => methods
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use measured_run, only: baseline_methods, run_type
   use namelist_input, only: element_length, elements, namelist_file_type
   use value_checks, only: absent, check_choice, check_count, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: measure_settings_type, read_measure

   !> Most tolerances or lengths of steps.
   integer, parameter :: most = 100
   !> Methods to choose from.
   character(len=10), parameter :: choices(*) = [character(len=10) :: solver_methods, &
                                                 baseline_methods]

   !> The runs of each case and how they are measured.
   type :: measure_settings_type
      !> Methods
      character(len=element_length) :: methods(16) = ""
      !> Tolerances of the solver's methods
      real(wp) :: tolerances(most) = absent
      !> Lengths of steps of the other methods
      real(wp) :: steps(most) = absent
      !> Most steps of a run of the solver
      integer(int64) :: most_steps = missing_count
      !> Times measured; 0 for none
      integer :: repeats = missing_count
      !> Shortest time to measure, in CPU seconds
      real(wp) :: least_seconds = missing
   contains
      !> Each method at each of its tolerances or lengths of steps
      procedure :: runs => runs_of_methods
   end type measure_settings_type

contains

   !> Read and check cases and settings.
   subroutine read_measure(path, list, measure, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), allocatable, intent(out) :: list(:)
      !> The settings
      type(measure_settings_type), intent(out) :: measure
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type), allocatable :: parameters(:)
      type(block_history_type), allocatable :: histories(:)
      type(case_section_type), allocatable :: cases(:)
      type(namelist_file_type) :: file
      integer :: i
      logical :: solver
      namelist /settings/ cases, parameters, histories, measure

      allocate (cases(most_cases))
      allocate (parameters(most_cases), source=missing_parameters)
      allocate (histories(most_cases), source=missing_history)
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      call keep_given(cases, parameters, histories)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call join_cases(path, cases, parameters, histories, list, error)
      call check_number(error, path, "most_steps", real(measure%most_steps, wp), at_least=1.0_wp)
      call check_count(error, path, "repeats", measure%repeats, 0)
      call check_number(error, path, "least_seconds", measure%least_seconds, at_least=0.0_wp)
      do i = 1, max(1, count(measure%methods /= ""))
         call check_choice(error, path, "methods", measure%methods(i), choices)
      end do
      if (allocated(error)) return
      do i = 1, count(measure%methods /= "")
         solver = all(baseline_methods /= measure%methods(i))
         call check_list(path, trim(merge("tolerances", "steps     ", solver)), &
                         merge(measure%tolerances, measure%steps, solver), error)
      end do
   end subroutine read_measure

   !> Refuse an empty list, and numbers that are not positive; keep an earlier error.
   pure subroutine check_list(path, key, list, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: key
      real(wp), intent(in) :: list(:)
      type(error_type), allocatable, intent(inout) :: error
      integer :: i

      do i = 1, max(1, count(list < absent))
         call check_number(error, path, key, list(i), above=0.0_wp)
      end do
   end subroutine check_list

   !> Each method at each of its tolerances or lengths of steps.
   pure function runs_of_methods(self) result(runs)
      class(measure_settings_type), intent(in) :: self
      type(run_type), allocatable :: runs(:)
      real(wp), allocatable :: settings(:)
      integer :: i, j

      allocate (runs(0))
      do i = 1, count(self%methods /= "")
         settings = elements(self%tolerances)
         if (any(baseline_methods == self%methods(i))) settings = elements(self%steps)
         runs = [runs, [(run_type(self%methods(i), settings(j)), j=1, size(settings))]]
      end do
   end function runs_of_methods
end module measure_input
