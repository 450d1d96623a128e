! SPDX-License-Identifier: BSD-3-Clause
!> Ordinary differential equations, as delay equations without delays.
module undelayed_problems
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: blow_up, fall_to, falls_out, quadrature, swing

contains

   !> y' = (power + 1) t^power, power 0 or 1, from a first state.
   type(constant_past) function quadrature(power, first) result(problem)
      integer, intent(in) :: power
      real(wp), intent(in) :: first

      call fill(problem, 1, [first], [first], p=[real(power, wp)])
      problem%f => power_of_time
      problem%terms => binomials
      problem%analytic = .true.
   end function quadrature

   !> y1 = cos(rate t), y2 = -sin(rate t); rate 1 if not given.
   type(constant_past) function swing(rate) result(problem)
      real(wp), intent(in), optional :: rate

      call fill(problem, 2, [1.0_wp, 0.0_wp], [1.0_wp, 0.0_wp], p=[1.0_wp])
      if (present(rate)) problem%p = rate
      problem%f => turn
      problem%exact => cosine_and_sine
      problem%analytic = .true.
   end function swing

   !> y' = y^2 from 1: 1/(1 - t), infinite at t = 1.
   type(constant_past) function blow_up() result(problem)
      call fill(problem, 1, [1.0_wp], [1.0_wp])
      problem%f => square
      problem%terms => squares
      problem%analytic = .true.
   end function blow_up

   !> y' = level - y, from 2 above the level: level + 2 exp(-t).
   type(constant_past) function fall_to(level) result(problem)
      real(wp), intent(in) :: level

      call fill(problem, 1, [level + 2.0_wp], [level + 2.0_wp], p=[level])
      problem%f => distance
      problem%exact => falling
   end function fall_to

   !> y' = 1 where t < 1, no number after; from a first state.
   type(constant_past) function falls_out(first) result(problem)
      real(wp), intent(in) :: first

      call fill(problem, 1, [first], [first])
      problem%f => ending
   end function falls_out

   pure subroutine distance(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = p - y
   end subroutine distance

   pure subroutine falling(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = p + 2.0_wp*exp(-t)
   end subroutine falling

   pure subroutine power_of_time(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = (p(1) + 1.0_wp)*t**nint(p(1))
   end subroutine power_of_time

   !> Of powers 0 and 1.
   pure subroutine binomials(p, t, unit, z, y)
      real(wp), intent(in) :: p(:), t, unit, z(0:, :)
      real(wp), intent(inout) :: y(0:, :)

      y(1:, :) = 0.0_wp
      y(1, 1) = unit*(p(1) + 1.0_wp)*t**nint(p(1))
      y(2, 1) = unit**2*p(1)
   end subroutine binomials

   pure subroutine turn(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = p(1)*[y(2), -y(1)]
   end subroutine turn

   pure subroutine cosine_and_sine(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = [cos(p(1)*t), -sin(p(1)*t)]
   end subroutine cosine_and_sine

   pure subroutine square(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = y**2
   end subroutine square

   pure subroutine squares(p, t, unit, z, y)
      real(wp), intent(in) :: p(:), t, unit, z(0:, :)
      real(wp), intent(inout) :: y(0:, :)
      integer :: k

      do k = 1, ubound(y, 1)
         y(k, 1) = unit/k*sum(y(0:k - 1, 1)*y(k - 1:0:-1, 1))
      end do
   end subroutine squares

   pure subroutine ending(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = merge(1.0_wp, ieee_value(t, ieee_quiet_nan), t < 1.0_wp)
   end subroutine ending
end module undelayed_problems
