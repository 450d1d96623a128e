! SPDX-License-Identifier: BSD-3-Clause
!> A delay that depends on the state (Paul 1994, "A test set of functional differential equations",
!> problem 1.3.10): y' = y(y(t)), y = 1/2 before t = 2, y(2) = 1. The argument y(t) passes the jump
!> at 2 where t = 4, and 4 where t = 4 + 2 log 2.
module own_past_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: own_past

   !> The problem
   type, extends(dde_problem_type) :: own_past
   contains
      procedure :: initial, history, rhs, moving_lags
   end type own_past

contains

   pure subroutine initial(self, y)
      class(own_past), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = 1.0_wp
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(own_past), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = 0.5_wp
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(own_past), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      dydt = z
   end subroutine rhs

   pure subroutine moving_lags(self, t, y, lag)
      class(own_past), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp), intent(out) :: lag(self%moving)
      lag = t - y
   end subroutine moving_lags
end module own_past_problem

program own_past_example
   use dde, only: error_type, integrate, integration_options, integration_result, wp
   use own_past_problem, only: own_past
   implicit none (type, external)
   real(wp), parameter :: known = 4.0_wp - 2.0_wp*log(2.0_wp*log(2.0_wp) - 0.5_wp)
   type(error_type), allocatable :: error
   type(integration_result) :: outcome

   ! no bound of the delay is known
   call integrate(own_past(n=1, lag=[huge(1.0_wp)], component=[1], moving=1), 2.0_wp, 5.5_wp, &
                  integration_options(), outcome, error)
   if (allocated(error)) error stop error%message
   print "(a, f12.9, a, i0, a)", "y(5.5) = ", outcome%y(1), ", ", outcome%breaking_points, &
      " breaking points"
   if (abs(outcome%y(1) - known) > 1.0e-7_wp) error stop "expected 4 - 2 log(2 log 2 - 1/2)"
end program own_past_example
