! SPDX-License-Identifier: BSD-3-Clause
!> The linear systems (shift - J) x = b of an implicit step, where J is the Jacobian, by Gaussian
!> elimination, real and complex, full and banded. Each pivot is the largest of its column relative
!> to its row. Otherwise a row of huge numbers in a stiff system would be the pivot for the others.
!> Zeros at both ends of a column are left out, and each zero above the diagonal: the Jacobian of a
!> trajectory with tangent vectors has blocks on its diagonal. Real and complex systems share bodies
!> in files that are included.
module dde_systems
   use dde_jacobian, only: jacobian_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: complex_system, real_system, size_of

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

   !> What real and complex systems have in common.
   type :: linear_system
      !> Where the elements are
      type(matrix_layout) :: layout
      !> Row exchanged with each row, and first and last row of each column of the factors that is
      !> not 0, shape (n)
      integer, allocatable, dimension(:) :: pivot, first, last
      !> One over the size of each equation, shape (n)
      real(wp), allocatable :: row_scale(:)
      !> Additions and multiplications of a factorisation and of a solution
      real(wp) :: factor_operations = 0.0_wp, solve_operations = 0.0_wp
   contains
      procedure, non_overridable :: column
   end type linear_system

   !> A system with a real shift.
   type, extends(linear_system) :: real_system
      !> Elements, then those of the factors
      real(wp), allocatable :: a(:)
   contains
      procedure, non_overridable :: reshape => reshape_real
      procedure, non_overridable :: fill => fill_real
      procedure, non_overridable :: factorise => factorise_real
      procedure, non_overridable :: solve => solve_real
   end type real_system

   !> A system with a complex shift.
   type, extends(linear_system) :: complex_system
      !> Elements, then those of the factors
      complex(wp), allocatable :: a(:)
   contains
      procedure, non_overridable :: reshape => reshape_complex
      procedure, non_overridable :: fill => fill_complex
      procedure, non_overridable :: factorise => factorise_complex
      procedure, non_overridable :: solve => solve_complex
   end type complex_system

   !> Size of a number: of a complex one the sum of its parts.
   interface size_of
      module procedure :: size_of_real
      module procedure :: size_of_complex
   end interface size_of

contains

   !> A band, or the full matrix where that takes less memory.
   pure type(matrix_layout) function new_layout(n, lower, upper) result(layout)
      integer, intent(in) :: n, lower, upper

      layout%n = n
      layout%lower = lower
      layout%upper = upper
      layout%stride = min(int(n, int64), 2_int64*lower + upper)
      layout%origin = -layout%stride
      if (layout%stride < n) layout%origin = -lower
      layout%length = layout%origin + n*(layout%stride + 1)
   end function new_layout

   !> Where a column is: its element i is number column + i.
   pure integer(int64) function column(self, j) result(at)
      class(linear_system), intent(in) :: self
      integer, intent(in) :: j

      at = self%layout%origin + j*self%layout%stride
   end function column

   !> Storage for a band of at least so many diagonals.
   pure subroutine reshape_real(self, n, lower, upper)
      class(real_system), intent(inout) :: self
      include "reshape_system.inc"
   end subroutine reshape_real

   !> Storage for a band of at least so many diagonals.
   pure subroutine reshape_complex(self, n, lower, upper)
      class(complex_system), intent(inout) :: self
      include "reshape_system.inc"
   end subroutine reshape_complex

   !> The matrix shift - J, whose band may be wider than that of J.
   pure subroutine fill_real(self, jacobian, shift)
      class(real_system), intent(inout) :: self
      real(wp), intent(in) :: shift
      include "fill_system.inc"
   end subroutine fill_real

   !> The matrix shift - J.
   pure subroutine fill_complex(self, jacobian, shift)
      class(complex_system), intent(inout) :: self
      complex(wp), intent(in) :: shift
      include "fill_system.inc"
   end subroutine fill_complex

   !> Factorise a matrix that is filled.
   pure subroutine factorise_real(self, singular)
      class(real_system), intent(inout) :: self
      !> Whether a pivot vanished
      logical, intent(out) :: singular

      call find_real_factors(self%layout, self%a, self%pivot, self%first, self%last, &
                             self%row_scale, self%factor_operations, self%solve_operations, &
                             singular)
   end subroutine factorise_real

   !> Factorise a matrix that is filled.
   pure subroutine factorise_complex(self, singular)
      class(complex_system), intent(inout) :: self
      logical, intent(out) :: singular

      call find_complex_factors(self%layout, self%a, self%pivot, self%first, self%last, &
                                self%row_scale, self%factor_operations, self%solve_operations, &
                                singular)
   end subroutine factorise_complex

   !> Replace a right-hand side by the solution.
   pure subroutine solve_real(self, b)
      class(real_system), intent(in) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), intent(inout) :: b(self%layout%n)

      call substitute_real(self%layout, self%a, self%pivot, self%first, self%last, b)
   end subroutine solve_real

   !> Replace a right-hand side by the solution.
   pure subroutine solve_complex(self, b)
      class(complex_system), intent(in) :: self
      complex(wp), intent(inout) :: b(self%layout%n)

      call substitute_complex(self%layout, self%a, self%pivot, self%first, self%last, b)
   end subroutine solve_complex

   !> Factors of a real matrix.
   pure subroutine find_real_factors(layout, a, pivot, first, last, row_scale, factor_operations, &
                                     solve_operations, singular)
      type(matrix_layout), intent(in) :: layout
      !> Matrix, replaced by its factors
      real(wp), intent(inout) :: a(layout%length)
      !> Real additions and multiplications over two for one element
      real(wp), parameter :: cost = 1.0_wp
      real(wp) :: moved
      include "factorise.inc"
   end subroutine find_real_factors

   !> Factors of a complex matrix.
   pure subroutine find_complex_factors(layout, a, pivot, first, last, row_scale, &
                                        factor_operations, solve_operations, singular)
      type(matrix_layout), intent(in) :: layout
      complex(wp), intent(inout) :: a(layout%length)
      real(wp), parameter :: cost = 4.0_wp
      complex(wp) :: moved
      include "factorise.inc"
   end subroutine find_complex_factors

   !> Solution of a factorised real system.
   pure subroutine substitute_real(layout, a, pivot, first, last, b)
      type(matrix_layout), intent(in) :: layout
      real(wp), intent(in) :: a(layout%length)
      !> Right-hand side, replaced by the solution
      real(wp), intent(inout) :: b(layout%n)
      real(wp) :: moved
      include "solve.inc"
   end subroutine substitute_real

   !> Solution of a factorised complex system.
   pure subroutine substitute_complex(layout, a, pivot, first, last, b)
      type(matrix_layout), intent(in) :: layout
      complex(wp), intent(in) :: a(layout%length)
      complex(wp), intent(inout) :: b(layout%n)
      complex(wp) :: moved
      include "solve.inc"
   end subroutine substitute_complex

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
end module dde_systems
