!> y' = -y(t - pi/2), y = sin t for t <= 0; the solution is sin t.
module model
   use dde
   implicit none
   private
   public :: delayed_sine

   !> The problem.
   type, extends(dde_problem_type) :: delayed_sine
   contains
      procedure :: initial, history, rhs
   end type delayed_sine

contains

   pure subroutine initial(self, y)
      class(delayed_sine), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 0
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(delayed_sine), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component

      value = sin(t)
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(delayed_sine), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -z
   end subroutine rhs
end module model

!> Prints the largest error at the end of runs by all methods.
program tester
   use dde
   use errors, only: percent
   use kinds, only: single => wp
   use model, only: delayed_sine
   implicit none
   type(error_type), allocatable :: error
   type(integration_result) :: outcome
   real(wp) :: largest
   integer :: i

   largest = 0
   do i = 1, size(methods)
      if (methods(i) == "taylor") cycle
      call integrate(delayed_sine(n=1, lag=[acos(0.0_wp)], component=[1]), 0.0_wp, 10.0_wp, &
                     integration_options(method=methods(i)), outcome, error)
      if (allocated(error)) error stop error%message
      largest = max(largest, abs(outcome%y(1) - sin(10.0_wp)))
   end do
   print "(a, es10.2)", "largest error", largest
   print "(a, f6.1)", "methods in percent", percent(1.0_single)
end program tester
