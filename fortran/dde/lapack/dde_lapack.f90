!> LAPACK's factorisations of dense and banded matrices, real and complex, by generic names. A build
!> without LAPACK or in quadruple precision has src/radau/dde_lapack.f90 in place of this file.
module dde_lapack
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: gbtrf, gbtrs, getrf, getrs, lapack_is_there

   !> Whether the procedures of this module work.
   logical, parameter :: lapack_is_there = .true.

   !> Replace a matrix by its factors.
   interface getrf
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
   end interface getrf

   !> Replace one right-hand side by the solution.
   interface getrs
      pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, nrhs, lda, ldb, ipiv(*)
         real(wp), intent(in) :: a(lda, *)
         real(wp), intent(inout) :: b(*)
         integer, intent(out) :: info
      end subroutine dgetrs

      pure subroutine zgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, nrhs, lda, ldb, ipiv(*)
         complex(wp), intent(in) :: a(lda, *)
         complex(wp), intent(inout) :: b(*)
         integer, intent(out) :: info
      end subroutine zgetrs
   end interface getrs

   !> Replace a banded matrix by its factors.
   interface gbtrf
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
   end interface gbtrf

   !> Replace one right-hand side by the solution of a banded system.
   interface gbtrs
      pure subroutine dgbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb, ipiv(*)
         real(wp), intent(in) :: ab(ldab, *)
         real(wp), intent(inout) :: b(*)
         integer, intent(out) :: info
      end subroutine dgbtrs

      pure subroutine zgbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb, ipiv(*)
         complex(wp), intent(in) :: ab(ldab, *)
         complex(wp), intent(inout) :: b(*)
         integer, intent(out) :: info
      end subroutine zgbtrs
   end interface gbtrs
end module dde_lapack
