!> Replaces lapack/dde_lapack.f90 in a build without LAPACK or in quadruple precision. Nothing here
!> is called, since `lapack_is_there` is false.
module dde_lapack
   implicit none (type, external)
   private
   public :: gbtrf, gbtrs, getrf, getrs, lapack_is_there

   !> Whether the procedures of this module work.
   logical, parameter :: lapack_is_there = .false.

contains

   !> No factors of a real or complex matrix.
   pure subroutine getrf(m, n, a, lda, ipiv, info)
      !> As in LAPACK
      integer, intent(in) :: m, n, lda
      !> As in LAPACK
      class(*), intent(in) :: a(:, :)
      !> As in LAPACK
      integer, intent(inout) :: ipiv(:), info

      info = 1
   end subroutine getrf

   !> No solution.
   pure subroutine getrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
      !> As in LAPACK
      character(len=1), intent(in) :: trans
      !> As in LAPACK
      integer, intent(in) :: n, nrhs, lda, ldb, ipiv(:)
      !> As in LAPACK
      class(*), intent(in) :: a(:, :), b(:)
      !> As in LAPACK
      integer, intent(out) :: info

      info = 1
   end subroutine getrs

   !> No factors of a banded matrix.
   pure subroutine gbtrf(m, n, kl, ku, ab, ldab, ipiv, info)
      !> As in LAPACK
      integer, intent(in) :: m, n, kl, ku, ldab
      !> As in LAPACK
      class(*), intent(in) :: ab(:, :)
      !> As in LAPACK
      integer, intent(inout) :: ipiv(:), info

      info = 1
   end subroutine gbtrf

   !> No solution of a banded system.
   pure subroutine gbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
      !> As in LAPACK
      character(len=1), intent(in) :: trans
      !> As in LAPACK
      integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb, ipiv(:)
      !> As in LAPACK
      class(*), intent(in) :: ab(:, :), b(:)
      !> As in LAPACK
      integer, intent(out) :: info

      info = 1
   end subroutine gbtrs
end module dde_lapack
