!> Linear systems by Gaussian elimination, real and complex, full and banded. Each pivot is the
!> largest of its column relative to its row. Otherwise a row of huge numbers in a stiff system
!> would be the pivot for the others. Zeros at both ends of a column are left out, and each zero
!> above the diagonal: the Jacobian of a trajectory with tangent vectors has blocks on its diagonal.
module dde_linear
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: factorise, matrix_layout, solve

   !> Where the elements of a matrix and of its factors are. Exchanges of rows move the first
   !> element of a column up by at most `lower` rows.
   type :: matrix_layout
      !> Number of equations, diagonals below and above the main one
      integer :: n = 0, lower = 0, upper = 0
      !> Element (i, j) is number origin + i + j*stride: by columns, those of a band shifted
      integer(int64) :: origin = 0, stride = 0
      !> Number of elements
      integer(int64) :: length = 0
   end type matrix_layout

   interface matrix_layout
      module procedure :: new_layout
   end interface matrix_layout

   !> Replace a matrix by its factors.
   interface factorise
      module procedure :: factorise_real
      module procedure :: factorise_complex
   end interface factorise

   !> Replace a right-hand side by the solution.
   interface solve
      module procedure :: solve_real
      module procedure :: solve_complex
   end interface solve

   !> Size of a number: of a complex one the sum of its parts.
   interface size_of
      module procedure :: size_of_real
      module procedure :: size_of_complex
   end interface size_of

contains

   !> A band, or the full matrix where that takes less memory.
   pure type(matrix_layout) function new_layout(n, lower, upper) result(layout)
      !> Number of equations
      integer, intent(in) :: n
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper

      layout%n = n
      layout%lower = lower
      layout%upper = upper
      layout%stride = min(int(n, int64), 2_int64*lower + upper)
      layout%origin = -layout%stride
      if (layout%stride < n) layout%origin = -lower
      layout%length = layout%origin + n*(layout%stride + 1)
   end function new_layout

   !> Factors of a real matrix.
   pure subroutine factorise_real(layout, a, pivot, first, last, row_scale, factor_operations, &
                                  solve_operations, singular)
      type(matrix_layout), intent(in) :: layout
      !> Matrix, replaced by its factors
      real(wp), intent(inout) :: a(layout%length)
      !> Real additions and multiplications over two for one element
      real(wp), parameter :: cost = 1.0_wp
      real(wp) :: moved
      include "factorise.inc"
   end subroutine factorise_real

   !> Factors of a complex matrix.
   pure subroutine factorise_complex(layout, a, pivot, first, last, row_scale, &
                                     factor_operations, solve_operations, singular)
      type(matrix_layout), intent(in) :: layout
      complex(wp), intent(inout) :: a(layout%length)
      real(wp), parameter :: cost = 4.0_wp
      complex(wp) :: moved
      include "factorise.inc"
   end subroutine factorise_complex

   !> Solution of a factorised real system.
   pure subroutine solve_real(layout, a, pivot, first, last, b)
      type(matrix_layout), intent(in) :: layout
      real(wp), intent(in) :: a(layout%length)
      !> Right-hand side, replaced by the solution
      real(wp), intent(inout) :: b(layout%n)
      real(wp) :: moved
      include "solve.inc"
   end subroutine solve_real

   !> Solution of a factorised complex system.
   pure subroutine solve_complex(layout, a, pivot, first, last, b)
      type(matrix_layout), intent(in) :: layout
      complex(wp), intent(in) :: a(layout%length)
      complex(wp), intent(inout) :: b(layout%n)
      complex(wp) :: moved
      include "solve.inc"
   end subroutine solve_complex

   !> Size of a real number.
   elemental real(wp) function size_of_real(x) result(value)
      real(wp), intent(in) :: x

      value = abs(x)
   end function size_of_real

   !> Size of a complex number.
   elemental real(wp) function size_of_complex(z) result(value)
      complex(wp), intent(in) :: z

      value = abs(real(z)) + abs(aimag(z))
   end function size_of_complex
end module dde_linear
