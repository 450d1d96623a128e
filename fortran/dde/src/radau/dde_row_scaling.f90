!> Scaling of linear systems by rows, dense and banded, real and complex.
module dde_row_scaling
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: scale_band, scale_rows

   !> Divide each equation by its largest coefficient.
   interface scale_rows
      module procedure :: scale_real_rows, scale_complex_rows
   end interface scale_rows

   !> Scale the rows of a banded matrix.
   interface scale_band
      module procedure :: scale_real_band, scale_complex_band
   end interface scale_band

contains

   !> Divide each equation by its largest coefficient.
   pure subroutine scale_real_rows(a, row)
      !> Matrix, shape (n, n)
      real(wp), intent(inout) :: a(:, :)
      !> Factor of each equation, shape (n)
      real(wp), intent(out) :: row(:)
      integer :: j

      row = tiny(1.0_wp)
      do j = 1, size(a, 2)
         row = max(row, abs(a(:, j)))
      end do
      row = 1.0_wp/row
      do j = 1, size(a, 2)
         a(:, j) = row*a(:, j)
      end do
   end subroutine scale_real_rows

   !> Scale the rows of a real banded matrix.
   pure subroutine scale_real_band(lower, upper, a, row)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Element (i, j) at (1 + lower + upper + i - j, j)
      real(wp), intent(inout) :: a(:, :)
      !> Factor of each equation, shape (n)
      real(wp), intent(out) :: row(:)
      integer :: first, j, last, shift

      row = tiny(1.0_wp)
      do j = 1, size(row)
         shift = 1 + lower + upper - j
         first = max(1, j - upper)
         last = min(size(row), j + lower)
         row(first:last) = max(row(first:last), abs(a(shift + first:shift + last, j)))
      end do
      row = 1.0_wp/row
      do j = 1, size(row)
         shift = 1 + lower + upper - j
         first = max(1, j - upper)
         last = min(size(row), j + lower)
         a(shift + first:shift + last, j) = row(first:last)*a(shift + first:shift + last, j)
      end do
   end subroutine scale_real_band

   !> Divide each equation by its largest coefficient.
   pure subroutine scale_complex_rows(a, row)
      !> Matrix, shape (n, n)
      complex(wp), intent(inout) :: a(:, :)
      !> Factor of each equation, shape (n)
      real(wp), intent(out) :: row(:)
      integer :: j

      row = tiny(1.0_wp)
      do j = 1, size(a, 2)
         row = max(row, abs(a(:, j)))
      end do
      row = 1.0_wp/row
      do j = 1, size(a, 2)
         a(:, j) = row*a(:, j)
      end do
   end subroutine scale_complex_rows

   !> Scale the rows of a complex banded matrix.
   pure subroutine scale_complex_band(lower, upper, a, row)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Element (i, j) at (1 + lower + upper + i - j, j)
      complex(wp), intent(inout) :: a(:, :)
      !> Factor of each equation, shape (n)
      real(wp), intent(out) :: row(:)
      integer :: first, j, last, shift

      row = tiny(1.0_wp)
      do j = 1, size(row)
         shift = 1 + lower + upper - j
         first = max(1, j - upper)
         last = min(size(row), j + lower)
         row(first:last) = max(row(first:last), abs(a(shift + first:shift + last, j)))
      end do
      row = 1.0_wp/row
      do j = 1, size(row)
         shift = 1 + lower + upper - j
         first = max(1, j - upper)
         last = min(size(row), j + lower)
         a(shift + first:shift + last, j) = row(first:last)*a(shift + first:shift + last, j)
      end do
   end subroutine scale_complex_band
end module dde_row_scaling
