!> Replaces lapack/dde_lapack.f90 in a build without LAPACK or in quadruple precision. Nothing here
!> is called, since `lapack_is_there` is false.
module dde_lapack
   implicit none (type, external)
   private
   public :: gbtrf, gbtrs, getrf, getrs, lapack_is_there

   !> Whether the procedures of this module work.
   logical, parameter :: lapack_is_there = .false.

contains

   !> No factors of a matrix.
   pure subroutine getrf(m, n, a, lda, ipiv, info)
      integer, intent(in) :: m, n, lda
      class(*), intent(in) :: a(:, :)
      integer, intent(inout) :: ipiv(:)
      integer, intent(out) :: info

      info = 1
   end subroutine getrf

   !> No solution.
   pure subroutine getrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
      character(len=1), intent(in) :: trans
      integer, intent(in) :: n, nrhs, lda, ldb, ipiv(:)
      class(*), intent(in) :: a(:, :), b(:)
      integer, intent(out) :: info

      info = 1
   end subroutine getrs

   !> No factors of a banded matrix.
   pure subroutine gbtrf(m, n, kl, ku, ab, ldab, ipiv, info)
      integer, intent(in) :: m, n, kl, ku, ldab
      class(*), intent(in) :: ab(:, :)
      integer, intent(inout) :: ipiv(:)
      integer, intent(out) :: info

      info = 1
   end subroutine gbtrf

   !> No solution of a banded system.
   pure subroutine gbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
      character(len=1), intent(in) :: trans
      integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb, ipiv(:)
      class(*), intent(in) :: ab(:, :), b(:)
      integer, intent(out) :: info

      info = 1
   end subroutine gbtrs
end module dde_lapack
