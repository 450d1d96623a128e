! SPDX-License-Identifier: BSD-3-Clause
!> Problems with a component that is much faster than the others, with exact solutions.
module fast_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: follower

   !> y1' = -rate (y1 - cos t), y2' = y1(t - 1): y1 follows cos t.
   type, extends(constant_past) :: follower
   contains
      procedure :: rhs => follower_rhs
      procedure :: series => follower_series
      procedure :: relaxation_rate => follower_rate
      procedure :: slow_series => follower_slow_series
      procedure :: exact => follower_exact
   end type follower

   interface follower
      module procedure :: new_follower
   end interface follower

contains

   !> The problem, y1 = 0 before t = 0 and `start` then.
   pure type(follower) function new_follower(rate, start) result(problem)
      real(wp), intent(in) :: rate, start

      call fill(problem, 2, [0.0_wp, 0.0_wp], [start, 0.0_wp], [1.0_wp], [1])
      problem%analytic = .true.
      problem%rate = rate
   end function new_follower

   !> Both components, the second at time t >= 1.
   pure function follower_exact(self, t) result(y)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: y(2)
      real(wp) :: in_phase, out_of_phase, left

      in_phase = 1.0_wp/(1.0_wp + self%rate**(-2))
      out_of_phase = in_phase/self%rate
      left = self%first(1) - in_phase
      y(1) = in_phase*cos(t) + out_of_phase*sin(t) + left*exp(-min(self%rate*t, 700.0_wp))
      y(2) = in_phase*sin(t - 1.0_wp) + out_of_phase*(1.0_wp - cos(t - 1.0_wp)) &
             + left/self%rate*(1.0_wp - exp(-max(0.0_wp, min(self%rate*(t - 1.0_wp), 700.0_wp))))
   end function follower_exact

   !> y1' = -rate (y1 - cos t), y2' = y1(t - 1).
   pure subroutine follower_rhs(self, t, y, z, dydt)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-self%rate*(y(1) - cos(t)), z(1)]
   end subroutine follower_rhs

   !> Coefficients of cos.
   pure function cosine(t, unit, degree) result(coefficient)
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp) :: coefficient(0:degree)
      real(wp) :: power
      integer :: k

      power = 1.0_wp
      do k = 0, degree
         coefficient(k) = power*merge(1.0_wp, -1.0_wp, modulo(k, 4) == 0 .or. modulo(k, 4) == 3) &
                          *merge(cos(t), sin(t), modulo(k, 2) == 0)
         power = power*unit/(k + 1)
      end do
   end function cosine

   !> Term by term.
   pure subroutine follower_series(self, t, unit, degree, z, y)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: led(0:degree)
      integer :: k

      led = cosine(t, unit, degree)
      do k = 0, degree - 1
         y(k + 1, 1) = -unit*self%rate/(k + 1)*(y(k, 1) - led(k))
         y(k + 1, 2) = unit/(k + 1)*z(k, 1)
      end do
   end subroutine follower_series

   !> Rate.
   pure function follower_rate(self, t, y) result(rate)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = self%rate
   end function follower_rate

   !> y1 = cos t - y1'/rate.
   pure subroutine follower_slow_series(self, t, unit, degree, z, y)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: led(0:degree)
      integer :: k

      led = cosine(t, unit, degree)
      do k = 0, degree
         y(k, 1) = led(k)
         if (k < degree) y(k, 1) = y(k, 1) - (k + 1)/(unit*self%rate)*y(k + 1, 1)
      end do
      do k = 1, degree
         y(k, 2) = unit/k*z(k - 1, 1)
      end do
   end subroutine follower_slow_series
end module fast_problems
