!> Cases and what to measure of them, from a namelist.
module measure_input
   use cases_input, only: check_cases, missing_case, most_cases
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use measured_run, only: baseline_methods, run_type
   use namelist_input, only: element_length, elements, namelist_file_type
   use value_checks, only: absent, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: measure_settings_type, read_measure

   !> Most tolerances or lengths of steps.
   integer, parameter :: most = 100

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
      procedure :: runs => runs_of_methods
   end type measure_settings_type

contains

   !> Read and check cases and settings.
   subroutine read_measure(path, cases, measure, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), allocatable, intent(out) :: cases(:)
      !> The settings
      type(measure_settings_type), intent(out) :: measure
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ cases, measure

      allocate (cases(most_cases), source=missing_case)
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      cases = pack(cases, cases%name /= "")
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_cases(path, cases, error)
      call check_count(error, path, "repeats", measure%repeats, at_least=0)
   end subroutine read_measure

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
