!> What to measure of the cases, from the namelist group &measure.
module measure_input
   use dde, only: solver_methods => methods
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_run, only: baseline_methods, run_type
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use solver_checks, only: check_tolerance
   use value_checks, only: check_choice, check_count, check_number
   implicit none (type, external)
   private
   public :: measure_settings_type, read_measure

   !> Most methods, tolerances or lengths of steps.
   integer, parameter :: most = 100
   !> Methods to choose from.
   character(len=10), parameter :: choices(*) = [character(len=10) :: solver_methods, &
                                                 baseline_methods]

   !> The runs of each case and how they are measured.
   type :: measure_settings_type
      !> Runs asked for: method and setting
      type(run_type), allocatable :: runs(:)
      !> Most steps of a run of the solver
      integer(int64) :: most_steps = 0
      !> Times measured; 0 for none
      integer :: repeats = 0
      !> Shortest time to measure, in CPU seconds
      real(wp) :: least_seconds = 0.0_wp
   end type measure_settings_type

contains

   !> Read and check the settings: each method at each of its tolerances or lengths of steps.
   subroutine read_measure(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(measure_settings_type), intent(out) :: settings
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: methods(most)
      real(wp) :: tolerances(most), steps(most), least_seconds
      character(len=256) :: reason
      integer :: i, j, most_steps, repeats, status, unit
      namelist /measure/ methods, tolerances, steps, most_steps, repeats, least_seconds

      methods = ""
      tolerances = not_given()
      steps = not_given()
      most_steps = -1
      repeats = -1
      least_seconds = not_given()
      call open_namelist(path, "measure", unit, error)
      if (allocated(error)) return
      read (unit, nml=measure, iostat=status, iomsg=reason)
      call close_namelist(path, "measure", unit, status, reason, error)
      call check_count(error, path, "most_steps", most_steps, 1)
      call check_count(error, path, "repeats", repeats, 0)
      call check_number(error, path, "least_seconds", least_seconds, at_least=0.0_wp)
      call check_choice(error, path, "methods", methods(1), choices)
      settings%most_steps = most_steps
      settings%repeats = repeats
      settings%least_seconds = least_seconds
      allocate (settings%runs(0))
      do i = 1, count(methods /= "")
         call check_choice(error, path, "methods", methods(i), choices)
         if (any(baseline_methods == methods(i))) then
            do j = 1, max(1, given(steps))
               call check_number(error, path, "steps", steps(j), above=0.0_wp)
               settings%runs = [settings%runs, run_type(methods(i), steps(j))]
            end do
         else
            do j = 1, max(1, given(tolerances))
               call check_tolerance(error, path, "tolerances", tolerances(j))
               settings%runs = [settings%runs, run_type(methods(i), tolerances(j))]
            end do
         end if
      end do
   end subroutine read_measure

   !> Length of a list: up to the last element that is a number.
   pure integer function given(list) result(length)
      !> The list, filled up with what is no number
      real(wp), intent(in) :: list(:)

      length = findloc(list <= huge(1.0_wp), .true., dim=1, back=.true.)
   end function given
end module measure_input
