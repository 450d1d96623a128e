! SPDX-License-Identifier: BSD-3-Clause
!> A laser with feedback (Lang and Kobayashi 1980): field E = y(1) + i y(2), carriers n = y(3),
!>
!>     E' = (1 + i alpha) n E - i omega E + eta E(t - tau),
!>     n' = epsilon (p - n - (2 n + 1) abs(E)^2).
!>
!> In a frame that turns with omega = -alpha eta it comes to rest, with n = -eta and
!> abs(E)^2 = (p - n)/(2 n + 1).
module laser_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: laser

   !> The problem
   type, extends(dde_problem_type) :: laser
   contains
      procedure :: initial, history, rhs
   end type laser

contains

   pure subroutine initial(self, y)
      class(laser), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = [0.3_wp, 0.0_wp, 0.0_wp]
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(laser), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = merge(0.3_wp, 0.0_wp, component == 1)
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(laser), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp), parameter :: alpha = 4.0_wp, epsilon = 5.0e-3_wp, eta = 5.0e-3_wp, p = 0.1_wp
      complex(wp) :: field, rate
      field = cmplx(y(1), y(2), wp)
      rate = cmplx(y(3), alpha*(y(3) + eta), wp)*field + eta*cmplx(z(1), z(2), wp)
      dydt = [real(rate), aimag(rate), epsilon*(p - y(3) - (2.0_wp*y(3) + 1.0_wp)*abs(field)**2)]
   end subroutine rhs
end module laser_problem

program lang_kobayashi_example
   use dde, only: error_type, integrate, integration_options, integration_result, wp
   use laser_problem, only: laser
   implicit none (type, external)
   type(error_type), allocatable :: error
   type(integration_result) :: outcome

   call integrate(laser(n=3, lag=[100.0_wp, 100.0_wp], component=[1, 2]), 0.0_wp, 5000.0_wp, &
                  integration_options(), outcome, error)
   if (allocated(error)) error stop error%message
   print "(a, f12.9, a, f12.9)", "n = ", outcome%y(3), ", intensity ", sum(outcome%y(:2)**2)
   if (abs(outcome%y(3) + 0.005_wp) > 1.0e-8_wp) error stop "expected n = -0.005"
   if (abs(sum(outcome%y(:2)**2) - 0.105_wp/0.99_wp) > 1.0e-8_wp) error stop "expected 0.106060606"
end program lang_kobayashi_example
