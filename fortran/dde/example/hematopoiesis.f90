! SPDX-License-Identifier: BSD-3-Clause
!> Blood stem cells (Mackey 1978), times in days:
!>
!>     s' = -delta s - b(s) + k b(s(t - tau)),   b(s) = beta s/(1 + s^n).
!>
!> With k and n from cos(omega tau) = (delta + b')/(k b'), sin(omega tau) = -omega/(k b') at rest, a
!> small disturbance keeps its size and returns after 2 pi/omega = 14 days. The program measures
!> this period by events: the maxima of s.
module stem_cells_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: stem_cells, tau

   real(wp), parameter :: beta = 1.77_wp, delta = 0.05_wp, omega = acos(-1.0_wp)/7, tau = 2.2_wp
   real(wp), parameter :: slope = -delta - omega/tan(omega*tau)
   real(wp), parameter :: k = -omega/(slope*sin(omega*tau))
   real(wp), parameter :: power = beta*(k - 1.0_wp)/delta - 1.0_wp
   real(wp), parameter :: n = 1.0_wp + (1.0_wp - slope/beta*(1.0_wp + power)**2)/power

   !> The problem
   type, extends(dde_problem_type) :: stem_cells
   contains
      procedure :: initial, history, rhs
   end type stem_cells

contains

   pure subroutine initial(self, y)
      class(stem_cells), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = self%history(0.0_wp, 1)
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(stem_cells), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = power**(1.0_wp/n) + 1.0e-6_wp*sin(omega*t)
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(stem_cells), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      dydt = -delta*y - beta*y/(1.0_wp + y**n) + k*beta*z/(1.0_wp + z**n)
   end subroutine rhs
end module stem_cells_problem

program hematopoiesis_example
   use dde, only: error_type, event_table, integrate, integration_options, integration_result, wp
   use stem_cells_problem, only: stem_cells, tau
   implicit none (type, external)
   type(error_type), allocatable :: error
   type(event_table) :: maxima
   type(integration_result) :: outcome
   real(wp) :: period

   maxima = event_table(component=[1], level=[0.0_wp], direction=[-1], of_slope=[.true.])
   call integrate(stem_cells(n=1, lag=[tau], component=[1]), 0.0_wp, 100.0_wp, &
                  integration_options(relative=1.0e-13_wp, absolute=1.0e-13_wp), outcome, error, &
                  watcher=maxima)
   if (allocated(error)) error stop error%message
   period = (maxima%time(7)%hi - maxima%time(1)%hi)/6
   print "(a, f9.5, a)", "period ", period, " days"
   if (abs(period - 14.0_wp) > 1.0e-5_wp) error stop "expected 14 days"
end program hematopoiesis_example
