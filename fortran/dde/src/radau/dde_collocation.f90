!> Polynomials of a collocation method, from its nodes.
module dde_collocation
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: add_up, combine, difference_increments, in_lanes, lagrange_weights, shape_bump
   public :: stage_lanes

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
      integer :: i, k

      do k = 1, n
         select case (stages)
         case (3)
            total = matrix(:, 1)*vectors(k, 1) + matrix(:, 2)*vectors(k, 2) &
                    + matrix(:, 3)*vectors(k, 3)
         case (5)
            total = matrix(:, 1)*vectors(k, 1) + matrix(:, 2)*vectors(k, 2) &
                    + matrix(:, 3)*vectors(k, 3) + matrix(:, 4)*vectors(k, 4) &
                    + matrix(:, 5)*vectors(k, 5)
         case default
            total = matrix(:, 1)*vectors(k, 1) + matrix(:, 2)*vectors(k, 2) &
                    + matrix(:, 3)*vectors(k, 3) + matrix(:, 4)*vectors(k, 4) &
                    + matrix(:, 5)*vectors(k, 5) + matrix(:, 6)*vectors(k, 6) &
                    + matrix(:, 7)*vectors(k, 7)
         end select
         do i = 1, stages
            sums(k, i) = total(i)
         end do
      end do
   end subroutine combine

   !> A matrix over stages, its rows filled up with zeros.
   pure function in_lanes(matrix) result(filled)
      !> The matrix, shape (stages, stages)
      real(wp), intent(in) :: matrix(:, :)
      real(wp) :: filled(stage_lanes, size(matrix, 2))

      filled = 0.0_wp
      filled(:size(matrix, 1), :) = matrix
   end function in_lanes

   !> Sum over j of weight(j) times vector j, in this order. `matmul` would use fused multiply-adds
   !> where the processor has them, and give other last bits.
   pure subroutine add_up(weights, vectors, total)
      !> Weights
      real(wp), intent(in) :: weights(:)
      !> One vector a weight
      real(wp), intent(in) :: vectors(:, :)
      !> The sum
      real(wp), intent(out) :: total(:)
      integer :: j

      total = weights(1)*vectors(:, 1)
      do j = 2, size(weights)
         total = total + weights(j)*vectors(:, j)
      end do
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

   !> Newton coefficients of the collocation polynomial's increments.
   pure subroutine difference_increments(x, increments, differences)
      !> Nodes (0, c)
      real(wp), intent(in) :: x(0:)
      !> Increments at c, shape (n, stages)
      real(wp), intent(in) :: increments(:, :)
      !> The coefficients, shape (0:stages, n)
      real(wp), intent(out) :: differences(0:, :)
      integer :: k

      do k = 1, size(differences, 2)
         differences(0, k) = 0.0_wp
         differences(1:, k) = increments(k, :)
         call divide_differences(x, differences(:, k))
      end do
   end subroutine difference_increments

   !> Weights of the stage increments in the collocation polynomial at s, without that of node 0.
   pure function lagrange_weights(x, s) result(weights)
      !> Nodes (0, c)
      real(wp), intent(in) :: x(0:)
      !> Place
      real(wp), intent(in) :: s
      real(wp) :: weights(ubound(x, 1))
      integer :: i, j

      weights = 1.0_wp
      do i = 1, ubound(x, 1)
         do j = 0, ubound(x, 1)
            if (j /= i) weights(i) = weights(i)*(s - x(j))/(x(i) - x(j))
         end do
      end do
   end function lagrange_weights
end module dde_collocation
