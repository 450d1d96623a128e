! SPDX-License-Identifier: BSD-3-Clause
!> Problems that jump, and a problem of many delays or of components of any size.
module piecewise_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, linear
   implicit none (type, external)
   private
   public :: delayed_pulse, jumping_history, logistic, many_delays, piecewise, relaxing
   public :: switching_kinds

   !> y' = y(t - 1), y = 0 for t < -1/2, 1 for -1/2 <= t < 0, y(0) = 0: y(5/2) = 7/8.
   type, extends(linear) :: jumping_history
      !> y for t < -1/2
      real(wp) :: before = 0.0_wp
   contains
      procedure :: history => step_history
   end type jumping_history

   !> y_i' = 1.8 y_i (1 - z_i) for each delayed value z_i, y_i' = 0 for other components.
   type, extends(constant_past) :: logistic
   contains
      procedure :: rhs => logistic_rhs
      procedure :: series => logistic_series
   end type logistic

   !> Number of problems that jump or change their stiffness again and again.
   integer, parameter :: switching_kinds = 6
   !> Other problems. y1' = 100 for 50 <= t < 50.1, else 0; y2' = y1(t - 1): from (0, 0),
   !> y2(55) = 39.5. Then y' = -y - (sum of all delayed values)/24. Then y2' = -y2,
   !> y1' = -1000 (y1^2/k - k y2^2): y1 is near k y2.
   integer, parameter :: delayed_pulse = 7, many_delays = 8, relaxing = 9

   !> One of these problems.
   type, extends(constant_past) :: piecewise
      !> Which one
      integer :: kind = 1
      !> The fast rate, or the size of y1
      real(wp) :: k = 1000.0_wp
   contains
      procedure :: rhs => piecewise_rhs
   end type piecewise

contains

   pure function step_history(self, t, component) result(value)
      class(jumping_history), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = merge(1.0_wp, self%before, t >= -0.5_wp)
   end function step_history

   pure subroutine logistic_rhs(self, t, y, z, dydt)
      class(logistic), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 0.0_wp
      dydt(:size(z)) = 1.8_wp*y(:size(z))*(1.0_wp - z)
   end subroutine logistic_rhs

   pure subroutine logistic_series(self, t, unit, degree, z, y)
      class(logistic), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: i, k

      y(1:, :) = 0.0_wp
      do i = 1, size(self%lag)
         do k = 0, degree - 1
            y(k + 1, i) = unit/(k + 1)*1.8_wp*(y(k, i) - sum(y(0:k, i)*z(k:0:-1, i)))
         end do
      end do
   end subroutine logistic_series

   pure subroutine piecewise_rhs(self, t, y, z, dydt)
      class(piecewise), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      select case (self%kind)
      case (1) ! a square wave
         dydt(1) = -self%k*(y(1) - sign(1.0_wp, sin(t)))
         dydt(2) = -y(2) - z(1)
      case (2) ! a stiffness that comes and goes
         dydt(1) = -merge(self%k, 1.0_wp, sin(3*t) > 0.0_wp)*(y(1) - cos(t))
         dydt(2) = -y(2) + z(1)
      case (3) ! a fast square wave
         dydt(1) = -self%k*(y(1) - sign(1.0_wp, sin(10*t)) - z(2))
         dydt(2) = y(1) - y(2)
      case (4) ! the oscillator of van der Pol
         dydt(1) = y(2)
         dydt(2) = self%k*((1.0_wp - y(1)**2)*y(2) - y(1))
      case (5) ! a thermostat
         dydt(1) = -self%k*(y(1) - 2*y(2))
         dydt(2) = merge(1.0_wp, -1.0_wp, z(1) < 0.5_wp) - 0.1_wp*y(2)
      case (delayed_pulse)
         dydt = [merge(100.0_wp, 0.0_wp, t >= 50.0_wp .and. t < 50.1_wp), z(1)]
      case (many_delays)
         dydt = -y - sum(z)/max(24, size(z)/5)
      case (relaxing)
         dydt = [-1000.0_wp*self%k*((y(1)/self%k)**2 - y(2)**2), -y(2)]
      case default ! a steep delayed feedback
         dydt(1) = self%k*(1.0_wp/(1.0_wp + max(z(1), 0.0_wp)**20) - y(1))
         dydt(2) = y(1) - y(2)
      end select
   end subroutine piecewise_rhs
end module piecewise_problems
