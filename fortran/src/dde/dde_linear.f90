!> Small dense linear systems by Gaussian elimination, real and complex. Pivots are the largest of
!> their column relative to their rows: in a stiff system a row of huge numbers must not serve as
!> pivot for the others. LAPACK pivots without that, and in double precision only.
module dde_linear
   use kinds, only: wp
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
   pure subroutine factorise_real(a, pivot, singular)
      !> Matrix, replaced by its factors, shape (n, n)
      real(wp), contiguous, intent(inout) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, intent(out) :: pivot(:)
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      real(wp) :: largest(size(a, 1)), row(size(a, 2))
      integer :: i, j, k

      largest = max(maxval(abs(a), dim=2), tiny(1.0_wp))
      singular = .false.
      do k = 1, size(a, 1)
         j = k - 1 + maxloc(abs(a(k:, k))/largest(k:), dim=1)
         pivot(k) = j
         if (j /= k) then
            row(k:) = a(k, k:)
            a(k, k:) = a(j, k:)
            a(j, k:) = row(k:)
            largest(j) = largest(k)
         end if
         singular = .not. abs(a(k, k)) > 0.0_wp
         if (singular) return
         a(k, k) = 1.0_wp/a(k, k)
         do i = k + 1, size(a, 1)
            a(i, k) = a(i, k)*a(k, k)
         end do
         do j = k + 1, size(a, 1)
            do i = k + 1, size(a, 1)
               a(i, j) = a(i, j) - a(i, k)*a(k, j)
            end do
         end do
      end do
   end subroutine factorise_real

   !> Factors of a complex matrix.
   pure subroutine factorise_complex(a, pivot, singular)
      !> Matrix, replaced by its factors, shape (n, n)
      complex(wp), contiguous, intent(inout) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, intent(out) :: pivot(:)
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      complex(wp) :: row(size(a, 2))
      real(wp) :: largest(size(a, 1))
      integer :: i, j, k

      largest = max(maxval(abs(real(a)) + abs(aimag(a)), dim=2), tiny(1.0_wp))
      singular = .false.
      do k = 1, size(a, 1)
         j = k - 1 + maxloc((abs(real(a(k:, k))) + abs(aimag(a(k:, k))))/largest(k:), dim=1)
         pivot(k) = j
         if (j /= k) then
            row(k:) = a(k, k:)
            a(k, k:) = a(j, k:)
            a(j, k:) = row(k:)
            largest(j) = largest(k)
         end if
         singular = .not. abs(real(a(k, k))) + abs(aimag(a(k, k))) > 0.0_wp
         if (singular) return
         a(k, k) = 1.0_wp/a(k, k)
         do i = k + 1, size(a, 1)
            a(i, k) = a(i, k)*a(k, k)
         end do
         do j = k + 1, size(a, 1)
            do i = k + 1, size(a, 1)
               a(i, j) = a(i, j) - a(i, k)*a(k, j)
            end do
         end do
      end do
   end subroutine factorise_complex

   !> Solution of a factorised real system.
   pure subroutine solve_real(a, pivot, b)
      !> Factors, shape (n, n)
      real(wp), contiguous, intent(in) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, intent(in) :: pivot(:)
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), contiguous, intent(inout) :: b(:)
      real(wp) :: moved
      integer :: i, k

      do k = 1, size(b)
         moved = b(pivot(k))
         b(pivot(k)) = b(k)
         b(k) = moved
         do i = k + 1, size(b)
            b(i) = b(i) - a(i, k)*moved
         end do
      end do
      do k = size(b), 1, -1
         b(k) = b(k)*a(k, k)
         do i = 1, k - 1
            b(i) = b(i) - a(i, k)*b(k)
         end do
      end do
   end subroutine solve_real

   !> Solution of a factorised complex system.
   pure subroutine solve_complex(a, pivot, b)
      !> Factors, shape (n, n)
      complex(wp), contiguous, intent(in) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, intent(in) :: pivot(:)
      !> Right-hand side, replaced by the solution, shape (n)
      complex(wp), contiguous, intent(inout) :: b(:)
      complex(wp) :: moved
      integer :: i, k

      do k = 1, size(b)
         moved = b(pivot(k))
         b(pivot(k)) = b(k)
         b(k) = moved
         do i = k + 1, size(b)
            b(i) = b(i) - a(i, k)*moved
         end do
      end do
      do k = size(b), 1, -1
         b(k) = b(k)*a(k, k)
         do i = 1, k - 1
            b(i) = b(i) - a(i, k)*b(k)
         end do
      end do
   end subroutine solve_complex
end module dde_linear
