!> The factorisations of LAPACK for large systems, dense and banded, real and complex. A build
!> without LAPACK or in quadruple precision has src/radau/dde_lapack.f90 in place of this file.
module dde_lapack
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: factorise_by_lapack, factorise_band, lapack_is_there, solve_band, solve_by_lapack

   !> Whether the procedures of this module work.
   logical, parameter :: lapack_is_there = .true.

   !> Replace a matrix by its factors.
   interface factorise_by_lapack
      module procedure :: factorise_real, factorise_complex
   end interface factorise_by_lapack

   !> Replace a right-hand side by the solution.
   interface solve_by_lapack
      module procedure :: solve_real, solve_complex
   end interface solve_by_lapack

   !> Replace a banded matrix by its factors.
   interface factorise_band
      module procedure :: factorise_real_band, factorise_complex_band
   end interface factorise_band

   !> Replace a right-hand side by the solution of a banded system.
   interface solve_band
      module procedure :: solve_real_band, solve_complex_band
   end interface solve_band

   interface
      pure subroutine dgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgetrf

      pure subroutine zgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, lda
         complex(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine zgetrf

      pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, nrhs, lda, ldb, ipiv(*)
         real(wp), intent(in) :: a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dgetrs

      pure subroutine zgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, nrhs, lda, ldb, ipiv(*)
         complex(wp), intent(in) :: a(lda, *)
         complex(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine zgetrs

      pure subroutine dgbtrf(m, n, kl, ku, ab, ldab, ipiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, kl, ku, ldab
         real(wp), intent(inout) :: ab(ldab, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgbtrf

      pure subroutine zgbtrf(m, n, kl, ku, ab, ldab, ipiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, kl, ku, ldab
         complex(wp), intent(inout) :: ab(ldab, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine zgbtrf

      pure subroutine dgbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb, ipiv(*)
         real(wp), intent(in) :: ab(ldab, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dgbtrs

      pure subroutine zgbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb, ipiv(*)
         complex(wp), intent(in) :: ab(ldab, *)
         complex(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine zgbtrs
   end interface

contains

   !> Factors of a real matrix.
   pure subroutine factorise_real(a, pivot, singular)
      !> Matrix, shape (n, n), replaced by its factors
      real(wp), contiguous, intent(inout) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(out) :: pivot(:)
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      integer :: info

      call dgetrf(size(pivot), size(pivot), a, size(a, 1), pivot, info)
      singular = info /= 0
   end subroutine factorise_real

   !> Solution of a factorised real system.
   pure subroutine solve_real(a, pivot, b)
      !> Factors, shape (n, n)
      real(wp), contiguous, intent(in) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(in) :: pivot(:)
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), contiguous, intent(inout) :: b(:)
      integer :: info

      call dgetrs("N", size(b), 1, a, size(a, 1), pivot, b, size(b), info)
   end subroutine solve_real

   !> Factors of a real banded matrix.
   pure subroutine factorise_real_band(lower, upper, a, pivot, singular)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Element (i, j) at (1 + lower + upper + i - j, j), replaced by the factors, shape
      !> (1 + 2 lower + upper, n)
      real(wp), contiguous, intent(inout) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(out) :: pivot(:)
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      integer :: info

      call dgbtrf(size(pivot), size(pivot), lower, upper, a, size(a, 1), pivot, info)
      singular = info /= 0
   end subroutine factorise_real_band

   !> Solution of a factorised real banded system.
   pure subroutine solve_real_band(lower, upper, a, pivot, b)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Factors, shape (1 + 2 lower + upper, n)
      real(wp), contiguous, intent(in) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(in) :: pivot(:)
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), contiguous, intent(inout) :: b(:)
      integer :: info

      call dgbtrs("N", size(b), lower, upper, 1, a, size(a, 1), pivot, b, size(b), info)
   end subroutine solve_real_band

   !> Factors of a complex matrix.
   pure subroutine factorise_complex(a, pivot, singular)
      !> Matrix, shape (n, n), replaced by its factors
      complex(wp), contiguous, intent(inout) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(out) :: pivot(:)
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      integer :: info

      call zgetrf(size(pivot), size(pivot), a, size(a, 1), pivot, info)
      singular = info /= 0
   end subroutine factorise_complex

   !> Solution of a factorised complex system.
   pure subroutine solve_complex(a, pivot, b)
      !> Factors, shape (n, n)
      complex(wp), contiguous, intent(in) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(in) :: pivot(:)
      !> Right-hand side, replaced by the solution, shape (n)
      complex(wp), contiguous, intent(inout) :: b(:)
      integer :: info

      call zgetrs("N", size(b), 1, a, size(a, 1), pivot, b, size(b), info)
   end subroutine solve_complex

   !> Factors of a complex banded matrix.
   pure subroutine factorise_complex_band(lower, upper, a, pivot, singular)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Element (i, j) at (1 + lower + upper + i - j, j), replaced by the factors, shape
      !> (1 + 2 lower + upper, n)
      complex(wp), contiguous, intent(inout) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(out) :: pivot(:)
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      integer :: info

      call zgbtrf(size(pivot), size(pivot), lower, upper, a, size(a, 1), pivot, info)
      singular = info /= 0
   end subroutine factorise_complex_band

   !> Solution of a factorised complex banded system.
   pure subroutine solve_complex_band(lower, upper, a, pivot, b)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Factors, shape (1 + 2 lower + upper, n)
      complex(wp), contiguous, intent(in) :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, contiguous, intent(in) :: pivot(:)
      !> Right-hand side, replaced by the solution, shape (n)
      complex(wp), contiguous, intent(inout) :: b(:)
      integer :: info

      call zgbtrs("N", size(b), lower, upper, 1, a, size(a, 1), pivot, b, size(b), info)
   end subroutine solve_complex_band
end module dde_lapack
