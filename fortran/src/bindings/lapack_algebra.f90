! SPDX-License-Identifier: BSD-3-Clause
!> Dense linear algebra by LAPACK: eigenvalues and eigenvectors, systems of equations and null
!> vectors.
module lapack_algebra
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: eigenvalues, eigenvectors, null_vectors, solve

   !> Solutions, shape (n, m), of a system with a matrix, shape (n, n), and right-hand sides, shape
   !> (n, m); an error if the matrix is singular.
   interface solve
      module procedure :: solve_complex, solve_real
   end interface solve

   interface
      subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: jobvl, jobvr
         integer, intent(in) :: n, lda, ldvl, ldvr, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: wr(*), wi(*), vl(ldvl, *), vr(ldvr, *), work(*)
         integer, intent(out) :: info
      end subroutine dgeev

      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv

      subroutine dggev(jobvl, jobvr, n, a, lda, b, ldb, alphar, alphai, beta, vl, ldvl, vr, ldvr, &
                       work, lwork, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: jobvl, jobvr
         integer, intent(in) :: n, lda, ldb, ldvl, ldvr, lwork
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         real(wp), intent(out) :: alphar(*), alphai(*), beta(*), vl(ldvl, *), vr(ldvr, *), work(*)
         integer, intent(out) :: info
      end subroutine dggev

      subroutine zgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: n, nrhs, lda, ldb
         complex(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine zgesv

      subroutine zgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, rwork, info)
         import :: wp
         implicit none (type, external)
         character(len=1), intent(in) :: jobu, jobvt
         integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
         complex(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: s(*), rwork(*)
         complex(wp), intent(out) :: u(ldu, *), vt(ldvt, *), work(*)
         integer, intent(out) :: info
      end subroutine zgesvd
   end interface

contains

   !> The finite eigenvalues s of matrix x = s M x, where M is diagonal.
   subroutine eigenvalues(matrix, mass, values, error)
      !> The matrix, shape (n, n)
      real(wp), intent(in) :: matrix(:, :)
      !> Diagonal of M, shape (n)
      real(wp), intent(in) :: mass(:)
      !> The eigenvalues that rounding distinguishes from infinite ones, at most n
      complex(wp), allocatable, intent(out) :: values(:)
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: a(:, :), alpha(:, :), b(:, :), beta(:), work(:)
      real(wp), dimension(1, 1) :: no_left, no_right
      logical, allocatable :: finite(:)
      integer :: i, info, n

      n = size(matrix, 1)
      allocate (a, source=matrix)
      allocate (b(n, n), source=0.0_wp)
      do i = 1, n
         b(i, i) = mass(i)
      end do
      allocate (alpha(n, 2), beta(n), work(34*n))
      call dggev("N", "N", n, a, n, b, n, alpha(:, 1), alpha(:, 2), beta, no_left, 1, no_right, 1, &
                 work, size(work), info)
      if (info /= 0) call raise(error, "eigenvalues: dggev returns "//text(info)//" for " &
                                //text(n)//" rows; 0 expected")
      finite = beta > epsilon(1.0_wp)*hypot(alpha(:, 1), alpha(:, 2))
      values = pack(cmplx(alpha(:, 1), alpha(:, 2), kind=wp), finite)/pack(beta, finite)
   end subroutine eigenvalues

   !> Eigenvalues in descending order of modulus, and eigenvectors of norm 1.
   subroutine eigenvectors(matrix, values, vectors, error)
      !> The matrix, shape (n, n)
      real(wp), intent(in) :: matrix(:, :)
      !> Eigenvalues, shape (n); of a pair the one with positive imaginary part first
      complex(wp), allocatable, intent(out) :: values(:)
      !> Eigenvectors, shape (n, n)
      complex(wp), allocatable, intent(out) :: vectors(:, :)
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: a(:, :), imaginary(:), modulus(:), real_part(:), right(:, :), work(:)
      real(wp) :: no_left(1, 1)
      integer :: i, info, n, next

      n = size(matrix, 1)
      allocate (a, source=matrix)
      allocate (real_part(n), imaginary(n), right(n, n), work(34*n), values(n), vectors(n, n))
      call dgeev("N", "V", n, a, n, real_part, imaginary, no_left, 1, right, n, work, size(work), &
                 info)
      if (info /= 0) then
         call raise(error, "eigenvectors: dgeev returns "//text(info)//" for "//text(n) &
                    //" rows; 0 expected")
         return
      end if
      modulus = hypot(real_part, imaginary)
      i = 1
      do while (i <= n)
         next = maxloc(modulus, dim=1)
         values(i) = cmplx(real_part(next), imaginary(next), kind=wp)
         vectors(:, i) = right(:, next)
         modulus(next) = -1.0_wp
         i = i + 1
         if (imaginary(next) <= 0.0_wp) cycle
         ! LAPACK keeps a pair side by side
         vectors(:, i - 1) = cmplx(right(:, next), right(:, next + 1), kind=wp)
         values(i) = conjg(values(i - 1))
         vectors(:, i) = conjg(vectors(:, i - 1))
         modulus(next + 1) = -1.0_wp
         i = i + 1
      end do
   end subroutine eigenvectors

   !> Solution of a real system.
   subroutine solve_real(matrix, right, solution, error)
      real(wp), intent(in) :: matrix(:, :)
      real(wp), intent(in) :: right(:, :)
      real(wp), intent(out) :: solution(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: a(size(matrix, 1), size(matrix, 2))
      integer :: info, pivot(size(matrix, 1))

      a = matrix
      solution = right
      call dgesv(size(a, 1), size(right, 2), a, size(a, 1), pivot, solution, size(a, 1), info)
      if (info /= 0) call raise(error, "solve: pivot "//text(info)//" of "//text(size(pivot)) &
                                //" is 0; a regular matrix expected")
   end subroutine solve_real

   !> Solution of a complex system.
   subroutine solve_complex(matrix, right, solution, error)
      complex(wp), intent(in) :: matrix(:, :)
      complex(wp), intent(in) :: right(:, :)
      complex(wp), intent(out) :: solution(:, :)
      type(error_type), allocatable, intent(out) :: error
      complex(wp) :: a(size(matrix, 1), size(matrix, 2))
      integer :: info, pivot(size(matrix, 1))

      a = matrix
      solution = right
      call zgesv(size(a, 1), size(right, 2), a, size(a, 1), pivot, solution, size(a, 1), info)
      if (info /= 0) call raise(error, "solve: pivot "//text(info)//" of "//text(size(pivot)) &
                                //" is 0; a regular matrix expected")
   end subroutine solve_complex

   !> The unit vectors q and p with matrix q = 0 and p^T matrix = 0, of a matrix of rank n - 1: the
   !> last singular vectors.
   subroutine null_vectors(matrix, q, p, error)
      !> The matrix, shape (n, n)
      complex(wp), intent(in) :: matrix(:, :)
      !> Right null vector, shape (n)
      complex(wp), intent(out) :: q(:)
      !> Left null vector, shape (n)
      complex(wp), intent(out) :: p(:)
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      complex(wp), dimension(size(matrix, 1), size(matrix, 1)) :: a, left, right
      complex(wp) :: work(10*size(matrix, 1))
      real(wp) :: real_work(5*size(matrix, 1)), singular(size(matrix, 1))
      integer :: info, n

      n = size(matrix, 1)
      a = matrix
      call zgesvd("A", "A", n, n, a, n, singular, left, n, right, n, work, size(work), &
                  real_work, info)
      if (info /= 0) call raise(error, "null_vectors: zgesvd returns "//text(info)//"; 0 expected")
      q = conjg(right(n, :))
      p = conjg(left(:, n))
   end subroutine null_vectors
end module lapack_algebra
