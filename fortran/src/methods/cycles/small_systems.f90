! SPDX-License-Identifier: BSD-3-Clause
!> Systems of some tens of equations with some tens of right-hand sides: calls of BLAS cost more
!> than their sums.
module small_systems
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: group, solve_equations

   !> Numbers that are changed together: loops of this length become instructions for several
   !> numbers.
   integer, parameter :: group = 4

contains

   !> Solve equations by elimination with row pivoting: right-hand sides become the solutions.
   pure subroutine solve_equations(unknowns, last, equations, singular)
      !> Number of unknowns, and of numbers in an equation, a multiple of `group`
      integer, intent(in) :: unknowns, last
      !> Equations, one a column: factors of the unknowns, then right-hand sides
      real(wp), intent(inout) :: equations(last, unknowns)
      !> Whether a pivot is 0 or not a number
      logical, intent(out) :: singular
      real(wp) :: row(last)
      integer :: first, k, pivot, r

      singular = .false.
      do r = 1, unknowns
         equations(:, r) = equations(:, r)/maxval(abs(equations(:unknowns, r)))
      end do
      do k = 1, unknowns
         pivot = k
         do r = k + 1, unknowns
            if (abs(equations(k, r)) > abs(equations(k, pivot))) pivot = r
         end do
         singular = .not. abs(equations(k, pivot)) > 0.0_wp
         if (singular) return
         row = equations(:, pivot)
         equations(:, pivot) = equations(:, k)
         equations(:, k) = row
         ! factors of unknowns before k are read no more
         first = first_of_group(k)
         do r = k + 1, unknowns
            call subtract(last - first + 1, equations(k, r)/row(k), row(first), equations(first, r))
         end do
      end do
      first = first_of_group(unknowns + 1)
      do k = unknowns, 1, -1
         row(first:) = equations(first:, k)
         do r = k + 1, unknowns
            call subtract(last - first + 1, equations(r, k), equations(first, r), row(first))
         end do
         equations(unknowns + 1:, k) = row(unknowns + 1:)/equations(k, k)
      end do
   end subroutine solve_equations

   !> The first number of the group of a number.
   pure integer function first_of_group(number) result(first)
      integer, intent(in) :: number

      first = number - modulo(number - 1, group)
   end function first_of_group

   !> Subtract a multiple of a vector.
   pure subroutine subtract(n, factor, vector, from)
      !> Size, a multiple of `group`
      integer, intent(in) :: n
      real(wp), intent(in) :: factor, vector(group, n/group)
      real(wp), intent(inout) :: from(group, n/group)
      integer :: i, j

      do j = 1, n/group
         do i = 1, group
            from(i, j) = from(i, j) - factor*vector(i, j)
         end do
      end do
   end subroutine subtract
end module small_systems
