! SPDX-License-Identifier: BSD-3-Clause
!> Polynomials of a collocation method, from its nodes.
module dde_collocation
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: difference_weights, lagrange_factors, lagrange_weights, shape_bump

contains

   !> The polynomial E(s), E' = product of (s - c), E(0) = 0, in Newton form over (0, c): the shape
   !> of the leading error of the collocation polynomial.
   pure subroutine shape_bump(c, newton, slope)
      !> Nodes
      real(wp), intent(in) :: c(:)
      !> Newton coefficients (0:stages + 1)
      real(wp), allocatable, intent(out) :: newton(:)
      !> E'(0)
      real(wp), intent(out) :: slope
      real(wp) :: power(0:size(c))
      real(wp) :: x(0:size(c))
      integer :: i, j, s

      s = size(c)
      power = 0.0_wp
      power(0) = 1.0_wp
      do i = 1, s
         power(1:i) = power(0:i - 1) - c(i)*power(1:i)
         power(0) = -c(i)*power(0)
      end do
      slope = power(0)
      x = [0.0_wp, c]
      allocate (newton(0:s + 1))
      do i = 0, s
         newton(i) = x(i)*sum([(power(j)*x(i)**j/(j + 1), j=0, s)])
      end do
      call divide_differences(x, newton(0:s))
      newton(s + 1) = 1.0_wp/(s + 1)
   end subroutine shape_bump

   !> Replace values at x by their divided differences.
   pure subroutine divide_differences(x, values)
      real(wp), intent(in) :: x(0:)
      !> Values there, replaced by Newton coefficients
      real(wp), intent(inout) :: values(0:)
      integer :: i, j

      do j = 1, ubound(x, 1)
         do i = ubound(x, 1), j, -1
            values(i) = (values(i) - values(i - 1))/(x(i) - x(i - j))
         end do
      end do
   end subroutine divide_differences

   !> Weights of the stage increments in the Newton coefficients of the collocation polynomial. The
   !> coefficient of degree 0 is 0.
   pure function difference_weights(x) result(weights)
      !> Nodes (0, c)
      real(wp), intent(in) :: x(0:)
      !> Weights, shape (stages, degree)
      real(wp) :: weights(ubound(x, 1), ubound(x, 1))
      real(wp) :: unit(0:ubound(x, 1))
      integer :: i

      do i = 1, ubound(x, 1)
         unit = 0.0_wp
         unit(i) = 1.0_wp
         call divide_differences(x, unit)
         weights(i, :) = unit(1:)
      end do
   end function difference_weights

   !> Weights of the stage increments in the collocation polynomial at s, over those of
   !> `lagrange_weights`: one over the products of x(i) - x(j).
   pure function lagrange_factors(x) result(factors)
      !> Nodes (0, c)
      real(wp), intent(in) :: x(0:)
      real(wp) :: factors(ubound(x, 1))
      integer :: i, j

      do i = 1, ubound(x, 1)
         ! one by one: compilers differ in the product of an array
         factors(i) = 1.0_wp
         do j = 0, ubound(x, 1)
            if (j /= i) factors(i) = factors(i)*(x(i) - x(j))
         end do
         factors(i) = 1.0_wp/factors(i)
      end do
   end function lagrange_factors

   !> Weights of the stage increments in the collocation polynomial at s.
   pure subroutine lagrange_weights(stages, x, factors, s, weights)
      !> Number of stages
      integer, intent(in) :: stages
      !> Nodes (0, c)
      real(wp), intent(in) :: x(0:stages)
      !> `lagrange_factors` of these nodes
      real(wp), intent(in) :: factors(stages)
      !> Place
      real(wp), intent(in) :: s
      !> The weights
      real(wp), intent(out) :: weights(stages)
      real(wp) :: behind
      integer :: i

      behind = s
      do i = 1, stages
         weights(i) = factors(i)*behind
         behind = behind*(s - x(i))
      end do
      behind = 1.0_wp
      do i = stages, 1, -1
         weights(i) = weights(i)*behind
         behind = behind*(s - x(i))
      end do
   end subroutine lagrange_weights
end module dde_collocation
