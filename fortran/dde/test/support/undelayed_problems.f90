! SPDX-License-Identifier: BSD-3-Clause
!> Ordinary differential equations, as delay equations without delays.
module undelayed_problems
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: blow_up, decay, falls_out, quadrature, swing, undelayed

   !> The problems.
   enum, bind(c)
      enumerator :: power_of_time, decaying, turning, infinite, ending
   end enum

   !> One of them.
   type, extends(constant_past) :: undelayed
      !> Which one, and its power of t
      integer :: kind = decaying, power = 0
   contains
      procedure :: rhs => undelayed_rhs
      procedure :: series => undelayed_series
   end type undelayed

contains

   !> y' = (power + 1) t^power, from a first state.
   pure type(undelayed) function quadrature(power, first) result(problem)
      integer, intent(in) :: power
      real(wp), intent(in) :: first

      call fill(problem, 1, [first], [first])
      problem%analytic = .true.
      problem%kind = power_of_time
      problem%power = power
   end function quadrature

   !> y' = -rate y, from 1.
   pure type(undelayed) function decay(rate) result(problem)
      real(wp), intent(in) :: rate

      call fill(problem, 1, [1.0_wp], [1.0_wp])
      problem%kind = decaying
      problem%rate = rate
   end function decay

   !> y1 = cos(rate t), y2 = -sin(rate t); rate 1 if not given.
   pure type(undelayed) function swing(rate) result(problem)
      real(wp), intent(in), optional :: rate

      call fill(problem, 2, [1.0_wp, 0.0_wp], [1.0_wp, 0.0_wp])
      problem%analytic = .true.
      problem%kind = turning
      if (present(rate)) problem%rate = rate
   end function swing

   !> y' = y^2 from 1: infinite at t = 1.
   pure type(undelayed) function blow_up() result(problem)
      call fill(problem, 1, [1.0_wp], [1.0_wp])
      problem%analytic = .true.
      problem%kind = infinite
   end function blow_up

   !> y' = 1 where t < 1, no number after; from a first state.
   pure type(undelayed) function falls_out(first) result(problem)
      real(wp), intent(in) :: first

      call fill(problem, 1, [first], [first])
      problem%kind = ending
   end function falls_out

   pure subroutine undelayed_rhs(self, t, y, z, dydt)
      class(undelayed), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      select case (self%kind)
      case (power_of_time)
         dydt = (self%power + 1)*t**self%power
      case (decaying)
         dydt = -self%rate*y
      case (turning)
         dydt = self%rate*[y(2), -y(1)]
      case (infinite)
         dydt = y**2
      case default
         dydt = 1.0_wp
         if (t >= 1.0_wp) dydt = ieee_value(t, ieee_quiet_nan)
      end select
   end subroutine undelayed_rhs

   !> Binomials of (t + unit s)**(power + 1); each coefficient from the one before; the square as a
   !> sum of products. The other problems give no series.
   pure subroutine undelayed_series(self, t, unit, degree, z, y)
      class(undelayed), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: j, k

      y(1:, :) = 0.0_wp
      do k = 1, degree
         select case (self%kind)
         case (power_of_time)
            if (k > self%power + 1) exit
            y(k, 1) = unit**k*t**(self%power + 1 - k) &
                      *product([(self%power + 2.0_wp - j, j=1, k)])/gamma(k + 1.0_wp)
         case (turning)
            y(k, :) = self%rate*unit/k*[y(k - 1, 2), -y(k - 1, 1)]
         case default
            y(k, 1) = unit/k*sum(y(0:k - 1, 1)*y(k - 1:0:-1, 1))
         end select
      end do
   end subroutine undelayed_series
end module undelayed_problems
