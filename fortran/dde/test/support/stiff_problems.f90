! SPDX-License-Identifier: BSD-3-Clause
!> Problems with components that are much faster than the others, all but `sdisc`
!> with exact solutions.
module stiff_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, decay_of_past, fill
   implicit none (type, external)
   private
   public :: exponential_decay, follower, prothero_robinson, sdisc

   !> y1' = -rate (y1 - cos t), y2' = y1(t - 1): y1 follows cos t.
   type, extends(constant_past) :: follower
   contains
      procedure :: relaxation_rate => rate_of_follower
      procedure :: slow_series => slow_series_of_follower
   end type follower

   interface follower
      module procedure :: new_follower
   end interface follower

contains

   !> y1 = 0 before t = 0 and `start` then. The second coefficient of its slow series is wrong by a
   !> share and a value, if one is given.
   type(follower) function new_follower(rate, start, wrong_by) result(problem)
      real(wp), intent(in) :: rate, start
      real(wp), intent(in), optional :: wrong_by

      call fill(problem, 2, [0.0_wp, 0.0_wp], [start, 0.0_wp], [1.0_wp], [1], [rate, start, 0.0_wp])
      if (present(wrong_by)) problem%p(3) = wrong_by
      problem%f => follow
      problem%exact => followed
      problem%terms => series_of_follower
      problem%analytic = .true.
   end function new_follower

   !> y_i' = rate (y_i - a_i cos t) - a_i sin t, y_i(0) = a_i: y_i = a_i cos t whatever the rate,
   !> far below 0 (Prothero and Robinson 1974), with a = 1, 0, 0, ...; n equations, 1 if not given.
   type(constant_past) function prothero_robinson(rate, n) result(problem)
      real(wp), intent(in) :: rate
      integer, intent(in), optional :: n

      call fill(problem, 1, [0.0_wp], [1.0_wp])
      if (present(n)) call fill(problem, n, first=[1.0_wp, spread(0.0_wp, 1, n - 1)])
      problem%p = [rate, problem%first]
      problem%f => relax_to_cosine
      problem%exact => cosine_of_each
   end function prothero_robinson

   !> y' = -y(t - lag) with the history exp(root t), where root = -exp(-root lag): y = exp(root t).
   !> The delay is below 1/e; the root by Newton's method.
   type(constant_past) function exponential_decay(lag) result(problem)
      real(wp), intent(in) :: lag
      integer :: i

      call fill(problem, 1, first=[1.0_wp], lag=[lag], component=[1], p=[1.0_wp, -1.0_wp])
      do i = 1, 20
         associate (x => problem%p(2), e => exp(-problem%p(2)*lag))
            x = x - (x + e)/(1.0_wp - lag*e)
         end associate
      end do
      problem%f => decay_of_past
      problem%exact => exponential
   end function exponential_decay

   !> y' = 1/(1 + t^2) - 1e6 (y + 0.8 y(t - 1) - 0.9 pi) from 0, with the history arctan t: near
   !> each multiple of the delay y changes within 1e-6. From the set of test problems of RADAR5
   !> (Guglielmi and Hairer 2001, Computing 67, 1).
   type(constant_past) function sdisc() result(problem)
      call fill(problem, 1, first=[0.0_wp], lag=[1.0_wp], component=[1])
      problem%f => jumping_balance
      problem%exact => arctangent
   end function sdisc

   pure subroutine follow(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = [-p(1)*(y(1) - cos(t)), z(1)]
   end subroutine follow

   pure subroutine followed(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)
      real(wp) :: in_phase, left, out_of_phase

      associate (rate => p(1))
         in_phase = 1.0_wp/(1.0_wp + rate**(-2))
         out_of_phase = in_phase/rate
         left = p(2) - in_phase
         y(1) = in_phase*cos(t) + out_of_phase*sin(t) + left*exp(-min(rate*t, 700.0_wp))
         y(2) = 0.0_wp
         if (t < 1.0_wp) return
         y(2) = in_phase*sin(t - 1.0_wp) + out_of_phase*(1.0_wp - cos(t - 1.0_wp)) &
                + left/rate*(1.0_wp - exp(-min(rate*(t - 1.0_wp), 700.0_wp)))
      end associate
   end subroutine followed

   !> Coefficients of cos.
   pure function cosine(t, unit, degree) result(coefficient)
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp) :: coefficient(0:degree)
      integer :: k

      coefficient = [(unit**k/gamma(k + 1.0_wp)*cos(t + 0.5_wp*acos(-1.0_wp)*k), k=0, degree)]
   end function cosine

   pure subroutine series_of_follower(p, t, unit, z, y)
      real(wp), intent(in) :: p(:), t, unit, z(0:, :)
      real(wp), intent(inout) :: y(0:, :)
      real(wp) :: led(0:ubound(y, 1))
      integer :: k

      led = cosine(t, unit, ubound(y, 1))
      do k = 0, ubound(y, 1) - 1
         y(k + 1, :) = unit/(k + 1)*[-p(1)*(y(k, 1) - led(k)), z(k, 1)]
      end do
   end subroutine series_of_follower

   pure function rate_of_follower(self, t, y) result(rate)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = self%p(1)
   end function rate_of_follower

   !> y1 = cos t - y1'/rate.
   pure subroutine slow_series_of_follower(self, t, unit, degree, z, y)
      class(follower), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: led(0:degree)
      integer :: k

      led = cosine(t, unit, degree)
      do k = 0, degree - 1
         y(k, 1) = led(k) - (k + 1)/(unit*self%p(1))*y(k + 1, 1)
         y(k + 1, 2) = unit/(k + 1)*z(k, 1)
      end do
      y(degree, 1) = led(degree)
      associate (wrong => self%p(3))
         y(2, 2) = (1.0_wp + 100.0_wp*wrong)*y(2, 2) + wrong*unit**2
         ! no number at all if it is none
         y = y + 0.0_wp*wrong
      end associate
   end subroutine slow_series_of_follower

   pure subroutine relax_to_cosine(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = p(1)*(y - p(2:)*cos(t)) - p(2:)*sin(t)
   end subroutine relax_to_cosine

   pure subroutine cosine_of_each(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = p(2:)*cos(t)
   end subroutine cosine_of_each

   pure subroutine exponential(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = exp(p(2)*t)
   end subroutine exponential

   !> In balance with y + 0.8 y(t - 1) = 0.9 pi.
   pure subroutine jumping_balance(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = 1.0_wp/(1.0_wp + t*t) - 1.0e6_wp*(y + 0.8_wp*z - 0.9_wp*acos(-1.0_wp))
   end subroutine jumping_balance

   pure subroutine arctangent(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = atan(t)
   end subroutine arctangent
end module stiff_problems
