! SPDX-License-Identifier: BSD-3-Clause
!> Polynomials of a collocation method, from its nodes.
module dde_collocation
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: add_up, combine, difference_weights, in_lanes, lagrange_factors, lagrange_weights
   public :: shape_bump, stage_lanes

   !> Rows of matrices over stages. Those above the number of stages are 0. The number is known to
   !> the compiler, which therefore makes vector instructions.
   integer, parameter :: stage_lanes = 8

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

   !> Combinations of the stages' vectors: sum over j of matrix(i, j) times vector j, for each i.
   !> Written out for 3, 5 and 7 stages: a loop over them costs four times as many instructions.
   pure subroutine combine(n, stages, matrix, vectors, sums)
      !> Number of equations
      integer, intent(in) :: n
      !> Number of stages: 3, 5 or 7
      integer, intent(in) :: stages
      !> Weights, rows filled up with zeros
      real(wp), intent(in) :: matrix(stage_lanes, stages)
      !> One vector a stage
      real(wp), intent(in) :: vectors(n, stages)
      !> One combination a stage
      real(wp), intent(out) :: sums(n, stages)
      real(wp) :: total(stage_lanes)
      integer :: k

      select case (stages)
      case (3)
         do k = 1, n
            total(:3) = vectors(k, :)
            sums(k, 1) = matrix(1, 1)*total(1) + matrix(1, 2)*total(2) + matrix(1, 3)*total(3)
            sums(k, 2) = matrix(2, 1)*total(1) + matrix(2, 2)*total(2) + matrix(2, 3)*total(3)
            sums(k, 3) = matrix(3, 1)*total(1) + matrix(3, 2)*total(2) + matrix(3, 3)*total(3)
         end do
      case (5)
         do k = 1, n
            total(:6) = matrix(:6, 1)*vectors(k, 1) + matrix(:6, 2)*vectors(k, 2) &
                        + matrix(:6, 3)*vectors(k, 3) + matrix(:6, 4)*vectors(k, 4) &
                        + matrix(:6, 5)*vectors(k, 5)
            sums(k, :) = total(:5)
         end do
      case default
         do k = 1, n
            total = matrix(:, 1)*vectors(k, 1) + matrix(:, 2)*vectors(k, 2) &
                    + matrix(:, 3)*vectors(k, 3) + matrix(:, 4)*vectors(k, 4) &
                    + matrix(:, 5)*vectors(k, 5) + matrix(:, 6)*vectors(k, 6) &
                    + matrix(:, 7)*vectors(k, 7)
            sums(k, :) = total(:7)
         end do
      end select
   end subroutine combine

   !> A matrix over stages, its rows filled up with zeros.
   pure function in_lanes(matrix) result(filled)
      !> The matrix, shape (stages, stages)
      real(wp), intent(in) :: matrix(:, :)
      real(wp) :: filled(stage_lanes, size(matrix, 2))

      filled = 0.0_wp
      filled(:size(matrix, 1), :) = matrix
   end function in_lanes

   !> Sum over j of weight(j) times vector j, over a divisor, in this order. `matmul` would use
   !> fused multiply-adds where the processor has them, and give other last bits.
   pure subroutine add_up(n, stages, weights, vectors, divisor, total)
      !> Number of equations, and of stages
      integer, intent(in) :: n, stages
      !> Weights
      real(wp), intent(in) :: weights(stages)
      !> One vector a weight
      real(wp), intent(in) :: vectors(n, stages)
      !> Divisor of the sum
      real(wp), intent(in) :: divisor
      !> The sum
      real(wp), intent(out) :: total(n)
      integer :: j, k

      do k = 1, n
         total(k) = weights(1)*vectors(k, 1)
      end do
      do j = 2, stages
         do k = 1, n
            total(k) = total(k) + weights(j)*vectors(k, j)
         end do
      end do
      total = total/divisor
   end subroutine add_up

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
