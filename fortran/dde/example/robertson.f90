! SPDX-License-Identifier: BSD-3-Clause
!> Robertson's stiff reaction with a delay (Guglielmi and Hairer 2001):
!>
!>     a' = -0.04 a + 1e4 b(t - 1e-4) c,   b' = -a' - 3e7 b^2,   c' = 3e7 b^2,
!>
!> from a = 1. The last steps are longer than 1e14 delays. So late the delay no longer matters: the
!> published value without delay is a(1e11) = 2.083340149701e-8 (Test Set for IVP Solvers).
module robertson_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: robertson

   !> The problem
   type, extends(dde_problem_type) :: robertson
   contains
      procedure :: initial, history, rhs
   end type robertson

contains

   pure subroutine initial(self, y)
      class(robertson), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = [1.0_wp, 0.0_wp, 0.0_wp]
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(robertson), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = 0.0_wp
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(robertson), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      dydt(1) = -0.04_wp*y(1) + 1.0e4_wp*z(1)*y(3)
      dydt(3) = 3.0e7_wp*y(2)**2
      dydt(2) = -dydt(1) - dydt(3)
   end subroutine rhs
end module robertson_problem

program robertson_example
   use dde, only: error_type, integrate, integration_options, integration_result, wp
   use robertson_problem, only: robertson
   implicit none (type, external)
   type(error_type), allocatable :: error
   type(integration_result) :: outcome

   call integrate(robertson(n=3, lag=[1.0e-4_wp], component=[2]), 0.0_wp, 1.0e11_wp, &
                  integration_options("radau13", 1.0e-10_wp, 1.0e-16_wp), outcome, error)
   if (allocated(error)) error stop error%message
   print "(a, es15.9, a, i0, a)", "a = ", outcome%y(1), " after ", outcome%accepted, " steps"
   if (abs(outcome%y(1)/2.083340149701e-8_wp - 1.0_wp) > 1.0e-9_wp) then
      error stop "expected 2.083340150e-8"
   end if
end program robertson_example
