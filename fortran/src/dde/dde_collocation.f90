!> Polynomials of a collocation method: what follows from its nodes.
module dde_collocation
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: combined, divide_differences, lagrange_weights, shape_bump, weighted_sum

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
   pure function combined(n, stages, matrix, vectors) result(sums)
      !> Number of equations
      integer, intent(in) :: n
      !> Number of stages
      integer, intent(in) :: stages
      !> Weights
      real(wp), intent(in) :: matrix(stages, stages)
      !> One vector a stage
      real(wp), intent(in) :: vectors(n, stages)
      real(wp) :: sums(n, stages)
      integer :: i, j

      do i = 1, stages
         sums(:, i) = matrix(i, 1)*vectors(:, 1)
         do j = 2, stages
            sums(:, i) = sums(:, i) + matrix(i, j)*vectors(:, j)
         end do
      end do
   end function combined

   !> Sum over j of weight(j) times vector j, in this order and without the fused multiply-adds that
   !> gfortran's library for `matmul` takes where the processor has them.
   pure function weighted_sum(weights, vectors) result(total)
      !> Weights
      real(wp), intent(in) :: weights(:)
      !> One vector a weight
      real(wp), intent(in) :: vectors(:, :)
      real(wp) :: total(size(vectors, 1))
      integer :: j

      total = weights(1)*vectors(:, 1)
      do j = 2, size(weights)
         total = total + weights(j)*vectors(:, j)
      end do
   end function weighted_sum

   !> Replace values at x by their divided differences.
   pure subroutine divide_differences(x, values)
      !> Places
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

   !> Weights of the stage increments in the collocation polynomial at s; that of 0 is left out.
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
