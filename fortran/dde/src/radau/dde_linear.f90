!> Small dense linear systems by Gaussian elimination, real and complex. Each pivot is the largest
!> of its column relative to its row. Otherwise a row of huge numbers in a stiff system would be the
!> pivot for the others. LAPACK does not scale rows and is slower for a few equations (dde_systems).
!> Zeros at both ends of a column are left out: the Jacobian of a trajectory with tangent vectors
!> has blocks on its diagonal.
module dde_linear
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: factorise, solve

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

contains

   !> Factors of a real matrix.
   pure subroutine factorise_real(a, pivot, first, last, row_scale, singular)
      !> Rows exchanged, shape (n)
      integer, intent(out) :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, intent(out), dimension(size(pivot)) :: first, last
      !> Matrix, replaced by its factors
      real(wp), intent(inout) :: a(size(pivot), size(pivot))
      !> One over the largest element of each row, shape (n)
      real(wp), intent(out) :: row_scale(size(pivot))
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      real(wp) :: moved
      real(wp) :: best, share
      integer :: i, j, k, n

      n = size(pivot)
      singular = .false.
      row_scale = tiny(1.0_wp)
      do j = 1, n
         do i = 1, n
            row_scale(i) = max(row_scale(i), abs(a(i, j)))
         end do
      end do
      row_scale = 1.0_wp/row_scale
      do k = 1, n
         last(k) = n
         do while (last(k) > k .and. abs(a(last(k), k)) <= 0.0_wp)
            last(k) = last(k) - 1
         end do
         first(k) = 1
         do while (first(k) < k .and. abs(a(first(k), k)) <= 0.0_wp)
            first(k) = first(k) + 1
         end do
         pivot(k) = k
         best = abs(a(k, k))*row_scale(k)
         do i = k + 1, last(k)
            share = abs(a(i, k))*row_scale(i)
            if (share > best) then
               best = share
               pivot(k) = i
            end if
         end do
         singular = .not. best > 0.0_wp
         if (singular) return
         if (pivot(k) /= k) then
            do j = k, n
               moved = a(k, j)
               a(k, j) = a(pivot(k), j)
               a(pivot(k), j) = moved
            end do
            row_scale(pivot(k)) = row_scale(k)
         end if
         a(k, k) = 1.0_wp/a(k, k)
         do i = k + 1, last(k)
            a(i, k) = a(i, k)*a(k, k)
         end do
         do j = k + 1, n
            moved = a(k, j)
            if (abs(moved) <= 0.0_wp) cycle
            do i = k + 1, last(k)
               a(i, j) = a(i, j) - a(i, k)*moved
            end do
         end do
      end do
   end subroutine factorise_real

   !> Factors of a complex matrix.
   pure subroutine factorise_complex(a, pivot, first, last, row_scale, singular)
      !> Rows exchanged, shape (n)
      integer, intent(out) :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, intent(out), dimension(size(pivot)) :: first, last
      !> Matrix, replaced by its factors
      complex(wp), intent(inout) :: a(size(pivot), size(pivot))
      !> One over the largest element of each row, shape (n)
      real(wp), intent(out) :: row_scale(size(pivot))
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      complex(wp) :: moved
      real(wp) :: best, share
      integer :: i, j, k, n

      n = size(pivot)
      singular = .false.
      row_scale = tiny(1.0_wp)
      do j = 1, n
         do i = 1, n
            row_scale(i) = max(row_scale(i), size_of(a(i, j)))
         end do
      end do
      row_scale = 1.0_wp/row_scale
      do k = 1, n
         last(k) = n
         do while (last(k) > k .and. size_of(a(last(k), k)) <= 0.0_wp)
            last(k) = last(k) - 1
         end do
         first(k) = 1
         do while (first(k) < k .and. size_of(a(first(k), k)) <= 0.0_wp)
            first(k) = first(k) + 1
         end do
         pivot(k) = k
         best = size_of(a(k, k))*row_scale(k)
         do i = k + 1, last(k)
            share = size_of(a(i, k))*row_scale(i)
            if (share > best) then
               best = share
               pivot(k) = i
            end if
         end do
         singular = .not. best > 0.0_wp
         if (singular) return
         if (pivot(k) /= k) then
            do j = k, n
               moved = a(k, j)
               a(k, j) = a(pivot(k), j)
               a(pivot(k), j) = moved
            end do
            row_scale(pivot(k)) = row_scale(k)
         end if
         a(k, k) = 1.0_wp/a(k, k)
         do i = k + 1, last(k)
            a(i, k) = a(i, k)*a(k, k)
         end do
         do j = k + 1, n
            moved = a(k, j)
            if (size_of(moved) <= 0.0_wp) cycle
            do i = k + 1, last(k)
               a(i, j) = a(i, j) - a(i, k)*moved
            end do
         end do
      end do
   end subroutine factorise_complex

   !> Size of a complex number: the sum of its parts.
   elemental real(wp) function size_of(z) result(value)
      !> The number
      complex(wp), intent(in) :: z

      value = abs(real(z)) + abs(aimag(z))
   end function size_of

   !> Solution of a factorised real system.
   pure subroutine solve_real(a, pivot, first, last, b)
      !> Rows exchanged, shape (n)
      integer, intent(in) :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, intent(in), dimension(size(pivot)) :: first, last
      !> Factors
      real(wp), intent(in) :: a(size(pivot), size(pivot))
      !> Right-hand side, replaced by the solution
      real(wp), intent(inout) :: b(size(pivot))
      real(wp) :: moved
      integer :: i, k, n

      n = size(pivot)
      do k = 1, n
         moved = b(pivot(k))
         b(pivot(k)) = b(k)
         b(k) = moved
         do i = k + 1, last(k)
            b(i) = b(i) - a(i, k)*moved
         end do
      end do
      do k = n, 1, -1
         moved = b(k)*a(k, k)
         b(k) = moved
         do i = first(k), k - 1
            b(i) = b(i) - a(i, k)*moved
         end do
      end do
   end subroutine solve_real

   !> Solution of a factorised complex system.
   pure subroutine solve_complex(a, pivot, first, last, b)
      !> Rows exchanged, shape (n)
      integer, intent(in) :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, intent(in), dimension(size(pivot)) :: first, last
      !> Factors
      complex(wp), intent(in) :: a(size(pivot), size(pivot))
      !> Right-hand side, replaced by the solution
      complex(wp), intent(inout) :: b(size(pivot))
      complex(wp) :: moved
      integer :: i, k, n

      n = size(pivot)
      do k = 1, n
         moved = b(pivot(k))
         b(pivot(k)) = b(k)
         b(k) = moved
         do i = k + 1, last(k)
            b(i) = b(i) - a(i, k)*moved
         end do
      end do
      do k = n, 1, -1
         moved = b(k)*a(k, k)
         b(k) = moved
         do i = first(k), k - 1
            b(i) = b(i) - a(i, k)*moved
         end do
      end do
   end subroutine solve_complex
end module dde_linear
