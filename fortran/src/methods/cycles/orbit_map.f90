! SPDX-License-Identifier: BSD-3-Clause
!> Linear maps that are known by what they do to a vector: systems of equations by GMRES (Saad and
!> Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856), eigenvalues of greatest modulus by Arnoldi's
!> method. Both converge fast where all eigenvalues but a few are close to one value.
module orbit_map
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use lapack_algebra, only: eigenvectors
   implicit none (type, external)
   private
   public :: leading_eigenvalues, linear_map_type, solve_by_gmres

   !> A linear map of vectors of real numbers.
   type, abstract :: linear_map_type
   contains
      !> Image of a vector
      procedure(image_of_vector), deferred :: apply
   end type linear_map_type

   abstract interface
      !> Image of a vector.
      subroutine image_of_vector(self, vector, image)
         import :: linear_map_type, wp
         implicit none (type, external)
         class(linear_map_type), intent(inout) :: self
         real(wp), intent(in) :: vector(:)
         real(wp), intent(out) :: image(:)
      end subroutine image_of_vector
   end interface

   !> A vector shorter than this share of what it was is noise. One shorter than this other share is
   !> made orthogonal again.
   real(wp), parameter :: noise = 1.0e-15_wp, little = 0.1_wp
   !> Arnoldi's method checks its eigenvalues after `first_check` steps, then every `steps_between`,
   !> up to `most_checked`: where a delay is hundreds of periods as many eigenvalues are near 1.
   integer, parameter :: first_check = 24, steps_between = 12, most_checked = 600
   !> Vectors of the basis whose inner products are summed together: one sum alone waits for each of
   !> its additions.
   integer, parameter :: together = 4

contains

   !> Solution of map x = right, from x = 0.
   subroutine solve_by_gmres(map, right, tolerance, solution, error)
      !> The map
      class(linear_map_type), intent(inout) :: map
      !> Right-hand side, norm of the residual over that of the right-hand side
      real(wp), intent(in) :: right(:), tolerance
      !> The solution
      real(wp), intent(out) :: solution(:)
      !> The tolerance was not reached
      type(error_type), allocatable, intent(out) :: error
      !> The residual may stop decreasing before the tolerance; up to this it is accepted.
      real(wp), parameter :: acceptable = 1.0e-3_wp
      !> Steps allowed: the number of vectors of the basis.
      integer, parameter :: most_steps = 500
      real(wp), allocatable :: basis(:, :), cosine(:), h(:, :), image(:), rotated(:), sine(:)
      real(wp) :: length, size_of_right
      integer :: i, k, most, n

      n = size(right)
      most = min(n, most_steps)
      solution = 0.0_wp
      size_of_right = norm2(right)
      if (size_of_right <= 0.0_wp) return
      allocate (h(most + 1, most), image(n), cosine(most), sine(most))
      allocate (basis(n, most + together), rotated(most + 1), source=0.0_wp)
      rotated(1) = size_of_right
      basis(:, 1) = right/size_of_right
      do k = 1, most
         call map%apply(basis(:, k), image)
         call extend_basis(basis, k, image, h(:, k))
         do i = 1, k - 1
            h(i:i + 1, k) = [cosine(i)*h(i, k) + sine(i)*h(i + 1, k), &
                             cosine(i)*h(i + 1, k) - sine(i)*h(i, k)]
         end do
         length = norm2(h(k:k + 1, k))
         if (length <= 0.0_wp) exit
         cosine(k) = h(k, k)/length
         sine(k) = h(k + 1, k)/length
         h(k, k) = length
         rotated(k + 1) = -sine(k)*rotated(k)
         rotated(k) = cosine(k)*rotated(k)
         if (.not. abs(rotated(k + 1)) > tolerance*size_of_right) exit
      end do
      k = min(k, most)
      if (.not. abs(rotated(k + 1)) <= max(acceptable, tolerance)*size_of_right) then
         call raise(error, "gmres: residual "//text(abs(rotated(k + 1))/size_of_right)//" of the " &
                    //"right-hand side after "//text(k)//" steps; at most "//text(tolerance) &
                    //" expected")
         return
      end if
      do i = k, 1, -1
         rotated(i) = (rotated(i) - dot_product(h(i, i + 1:k), rotated(i + 1:k)))/h(i, i)
      end do
      do i = 1, k
         solution = solution + rotated(i)*basis(:, i)
      end do
   end subroutine solve_by_gmres

   !> Eigenvalues of greatest modulus, in descending order, and their eigenvectors.
   subroutine leading_eigenvalues(map, n, wanted, tolerance, values, vectors, error)
      !> The map
      class(linear_map_type), intent(inout) :: map
      !> Size of its vectors, number of eigenvalues
      integer, intent(in) :: n, wanted
      !> Norm of the residual of an eigenvector of norm 1, over the modulus of the first eigenvalue
      real(wp), intent(in) :: tolerance
      !> The eigenvalues: the number wanted, or a few less or more where pairs would be separated or
      !> the vectors are shorter
      complex(wp), allocatable, intent(out) :: values(:)
      !> Eigenvectors, shape (n, size(values))
      complex(wp), allocatable, intent(out) :: vectors(:, :)
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: small_values(:), small_vectors(:, :)
      real(wp), allocatable :: basis(:, :), h(:, :), image(:)
      real(wp) :: residual
      integer :: count, i, k, most
      logical :: complete

      most = min(n, most_checked)
      allocate (basis(n, most + together), h(most + 1, most), image(n), source=0.0_wp)
      ! no eigenvector should be orthogonal to it
      basis(:, 1) = [(1.0_wp + sin(1.0_wp*i*i), i=1, n)]
      basis(:, 1) = basis(:, 1)/norm2(basis(:, 1))
      do k = 1, most
         call map%apply(basis(:, k), image)
         call extend_basis(basis, k, image, h(:, k))
         complete = k == n .or. .not. h(k + 1, k) > 0.0_wp
         if (.not. complete .and. &
             (k < first_check .or. mod(k - first_check, steps_between) > 0)) cycle
         call eigenvectors(h(:k, :k), small_values, small_vectors, error)
         if (allocated(error)) return
         count = min(wanted, k)
         if (count < k) then
            if (abs(aimag(small_values(count))) > 0.0_wp) then
               if (small_values(count + 1) == conjg(small_values(count))) count = count + 1
            end if
         end if
         if (.not. complete) then
            ! the norm of the residual of an eigenvector
            residual = h(k + 1, k)*maxval(abs(small_vectors(k, :count)))
            if (residual > tolerance*abs(small_values(1))) cycle
         end if
         values = small_values(:count)
         vectors = cmplx(matmul(basis(:, :k), real(small_vectors(:, :count))), &
                         matmul(basis(:, :k), aimag(small_vectors(:, :count))), kind=wp)
         return
      end do
      call raise(error, "multipliers: "//text(wanted)//" of a map of "//text(n)//" numbers do " &
                 //"not converge in "//text(most)//" steps; a shorter delay or period expected")
   end subroutine leading_eigenvalues

   !> Make an image orthogonal to the basis, twice where that leaves little of it, and append it.
   pure subroutine extend_basis(basis, k, image, h)
      !> Orthonormal vectors, shape (n, at least k + together); those after k are 0
      real(wp), contiguous, intent(inout) :: basis(:, :)
      integer, intent(in) :: k
      !> The image, replaced by what is left of it
      real(wp), contiguous, intent(inout) :: image(:)
      !> Coefficients of the image; number k + 1 is 0 where nothing is left
      real(wp), intent(inout) :: h(:)
      real(wp) :: parts(together), whole
      integer :: i, j, l, last, turn

      whole = norm2(image)
      h(:k) = 0.0_wp
      do turn = 1, 2
         do j = 0, k - 1, together
            parts = 0.0_wp
            do i = 1, size(image)
               do l = 1, together
                  parts(l) = parts(l) + basis(i, j + l)*image(i)
               end do
            end do
            do i = 1, size(image)
               do l = 1, together
                  image(i) = image(i) - parts(l)*basis(i, j + l)
               end do
            end do
            last = min(together, k - j)
            h(j + 1:j + last) = h(j + 1:j + last) + parts(:last)
         end do
         h(k + 1) = norm2(image)
         if (h(k + 1) > little*whole) exit
      end do
      if (h(k + 1) <= noise*whole) h(k + 1) = 0.0_wp
      basis(:, k + 1) = image
      if (h(k + 1) > 0.0_wp) basis(:, k + 1) = image/h(k + 1)
   end subroutine extend_basis
end module orbit_map
