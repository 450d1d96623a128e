! SPDX-License-Identifier: BSD-3-Clause
!> How far the exponents of the exponential terms of f move in a step. Where |a| is large exp(a) or
!> exp(-a) vanishes in the rounding of other terms, and a step that ends beyond a switch, or holds a
!> pulse between its stages, looks as accurate as one without. The exponents themselves are as
!> smooth as the solution: three places of a step show how far each of them comes.
module dde_exponents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_interpolant, only: highest_degree, newton_state
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: judge_exponents

   !> Places of the step: a parabola through the values there bounds an exponent.
   real(wp), parameter :: places(3) = [0.0_wp, 0.5_wp, 1.0_wp]
   !> A term below exp(-hidden) of the tolerance is not seen.
   real(wp), parameter :: hidden = 5.0_wp
   !> Largest change of an exponent in a step, as far as its term is seen.
   real(wp), parameter :: most_change = 10.0_wp
   !> Uncertainty of a bound, over the second difference.
   real(wp), parameter :: uncertain = 0.125_wp

contains

   !> Reject a step in which an exponent moves by so much that its term may have been missed.
   pure subroutine judge_exponents(context, step, error)
      !> The context of a step that is within the tolerance otherwise
      type(step_context), intent(inout) :: context
      !> The step
      class(step_type), intent(in) :: step
      !> Error of the step in units of the tolerance
      real(wp), intent(inout) :: error
      real(wp), allocatable :: a(:, :), y(:, :), z(:, :)
      real(wp) :: coefficients(0:highest_degree), far, ignored, s
      integer :: i, j, k

      associate (problem => context%problem, degree => size(step%nodes), h => step%h)
         allocate (a(problem%exponentials, 3), y(problem%n, 3), z(size(problem%lag), 3))
         call context%delayed_values(h*places, z)
         do i = 1, problem%n
            call step%interpolant(i, coefficients(:degree))
            do j = 1, 3
               call newton_state(step%nodes, coefficients(:degree), places(j), y(i, j), ignored)
               do k = 1, merge(size(problem%lag), 0, step%constants%implicit)
                  s = places(j) - problem%lag(k)/h
                  if (s <= 0.0_wp .or. problem%component(k) /= i) cycle
                  ! a delayed value within the step
                  call newton_state(step%nodes, coefficients(:degree), s, z(k, j), ignored)
               end do
            end do
         end do
         do j = 1, 3
            call problem%exponents(context%cursor%inside(step%t + h*places(j)), y(:, j), z(:, j), &
                                   a(:, j))
         end do
      end associate
      far = hidden - log(context%tolerance%level)
      do k = 1, size(a, 1)
         if (change(a(k, :), far) > most_change) error = huge(1.0_wp)
      end do
   end subroutine judge_exponents

   !> Change of an exponent within -far and far, from its values at the places.
   pure real(wp) function change(a, far)
      real(wp), intent(in) :: a(3), far
      real(wp) :: bend, extreme, least, most, rise, s

      change = 0.0_wp
      if (.not. ieee_is_finite(sum(a))) return
      bend = a(1) - 2.0_wp*a(2) + a(3)
      rise = 4.0_wp*a(2) - 3.0_wp*a(1) - a(3)
      extreme = a(2)
      s = -0.25_wp*rise/sign(max(abs(bend), tiny(1.0_wp)), bend)
      if (s > 0.0_wp .and. s < 1.0_wp) extreme = a(1) + 0.5_wp*s*rise
      least = min(extreme, minval(a)) - uncertain*abs(bend)
      most = max(extreme, maxval(a)) + uncertain*abs(bend)
      change = max(-far, min(far, most)) - max(-far, min(far, least))
   end function change
end module dde_exponents
