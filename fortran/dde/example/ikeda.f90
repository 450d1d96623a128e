! SPDX-License-Identifier: BSD-3-Clause
!> Light in a ring cavity (Ikeda, Daido and Akimoto 1980) at a long delay:
!>
!>     x' = -x - 2 sin x(t - 1e5),   x = 1 for t <= 0.
!>
!> x becomes a square wave of height a = 2 sin a (Chow and Mallet-Paret 1983). `auto` resolves its
!> edges with explicit steps and passes over its plateaus with implicit ones.
module ikeda_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: ikeda

   !> The problem
   type, extends(dde_problem_type) :: ikeda
   contains
      procedure :: initial, history, rhs
   end type ikeda

contains

   pure subroutine initial(self, y)
      class(ikeda), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = 1.0_wp
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(ikeda), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = 1.0_wp
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(ikeda), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      dydt = -y - 2.0_wp*sin(z)
   end subroutine rhs
end module ikeda_problem

program ikeda_example
   use dde, only: error_type, integrate, integration_options, integration_result, wp
   use ikeda_problem, only: ikeda
   implicit none (type, external)
   type(error_type), allocatable :: error
   type(integration_result) :: outcome

   call integrate(ikeda(n=1, lag=[1.0e5_wp], component=[1]), 0.0_wp, 6.05e6_wp, &
                  integration_options(), outcome, error)
   if (allocated(error)) error stop error%message
   print "(a, f12.9, a, i0, a)", "height ", abs(outcome%y(1)), " after ", outcome%accepted, " steps"
   if (abs(abs(outcome%y(1)) - 1.895494267034_wp) > 1.0e-8_wp) error stop "expected 1.895494267"
end program ikeda_example
