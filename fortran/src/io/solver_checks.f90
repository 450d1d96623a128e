!> Refusal of a method or tolerance that programs do not offer, with its place in the input.
module solver_checks
   use dde, only: methods
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use value_checks, only: check_choice, check_number
   implicit none (type, external)
   private
   public :: check_method, check_tolerance

   !> Tolerances that the schema of the configuration allows: below, rounding limits the solver;
   !> above, its error estimates have no meaning.
   real(wp), parameter :: least_tolerance = 1.0e-13_wp, largest_tolerance = 1.0e-2_wp

contains

   !> Refuse a method that the solver does not have; keep an earlier error.
   pure subroutine check_method(error, place, method)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes
      character(len=*), intent(in) :: place
      !> Name of the method
      character(len=*), intent(in) :: method

      call check_choice(error, place, "method", method, methods)
   end subroutine check_method

   !> Refuse a tolerance out of range; keep an earlier error.
   pure subroutine check_tolerance(error, place, key, value)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes
      character(len=*), intent(in) :: place
      !> Key
      character(len=*), intent(in) :: key
      !> The tolerance
      real(wp), intent(in) :: value

      call check_number(error, place, key, value, at_least=least_tolerance, &
                        at_most=largest_tolerance)
   end subroutine check_tolerance
end module solver_checks
