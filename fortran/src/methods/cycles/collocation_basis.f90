! SPDX-License-Identifier: BSD-3-Clause
!> Polynomials on the unit interval by their values at nodes, and the points at which they fulfil an
!> equation: those of Radau IIA, which damp fast components. Gauss points leave them undamped.
module collocation_basis
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: collocation_basis_type

   !> Polynomials of one degree. Node 1 is 0, the last node is 1.
   type :: collocation_basis_type
      !> Degree m
      integer :: degree = 0
      !> Nodes, the extremes of a Chebyshev polynomial, shape (m + 1)
      real(wp), allocatable :: node(:)
      !> Collocation points, shape (m)
      real(wp), allocatable :: point(:)
      !> Weights of the integral over the unit interval at the points, shape (m)
      real(wp), allocatable :: weight(:)
      !> Values and slopes of the Lagrange polynomials at the points, shape (m + 1, m)
      real(wp), allocatable :: value(:, :), slope(:, :)
      !> Coefficients of the power m of the Lagrange polynomials, shape (m + 1)
      real(wp), allocatable :: leading(:)
   contains
      procedure :: values_at, slopes_at
   end type collocation_basis_type

   interface collocation_basis_type
      module procedure :: new_basis
   end interface collocation_basis_type

contains

   !> The basis of a degree m >= 1.
   pure function new_basis(degree) result(basis)
      integer, intent(in) :: degree
      type(collocation_basis_type) :: basis
      real(wp), parameter :: pi = acos(-1.0_wp)
      integer :: i, k

      basis%degree = degree
      allocate (basis%node(degree + 1), basis%leading(degree + 1))
      do i = 0, degree
         basis%node(i + 1) = 0.5_wp*(1.0_wp - cos(pi*i/degree))
      end do
      do i = 1, degree + 1
         basis%leading(i) = 1.0_wp/product(basis%node(i) - pack(basis%node, &
                                                                [(k /= i, k=1, degree + 1)]))
      end do
      basis%point = points_of(degree)
      basis%weight = weights_of(basis%point)
      allocate (basis%value(degree + 1, degree), basis%slope(degree + 1, degree))
      do k = 1, degree
         basis%value(:, k) = basis%values_at(basis%point(k))
         basis%slope(:, k) = basis%slopes_at(basis%point(k))
      end do
   end function new_basis

   !> Lagrange polynomials at a place.
   pure function values_at(self, place) result(values)
      class(collocation_basis_type), intent(in) :: self
      real(wp), intent(in) :: place
      real(wp) :: values(self%degree + 1)
      real(wp) :: above, below
      integer :: i

      below = 1.0_wp
      do i = 1, size(values)
         values(i) = self%leading(i)*below
         below = below*(place - self%node(i))
      end do
      above = 1.0_wp
      do i = size(values), 1, -1
         values(i) = values(i)*above
         above = above*(place - self%node(i))
      end do
   end function values_at

   !> Derivatives of the Lagrange polynomials at a place.
   pure function slopes_at(self, place) result(slopes)
      class(collocation_basis_type), intent(in) :: self
      real(wp), intent(in) :: place
      real(wp) :: slopes(self%degree + 1)
      ! products of the factors of nodes below and above a node, and their derivatives
      real(wp) :: above, above_slope, below(self%degree + 1)
      integer :: i

      below(1) = 1.0_wp
      slopes(1) = 0.0_wp
      do i = 1, self%degree
         slopes(i + 1) = slopes(i)*(place - self%node(i)) + below(i)
         below(i + 1) = below(i)*(place - self%node(i))
      end do
      above = 1.0_wp
      above_slope = 0.0_wp
      do i = size(slopes), 1, -1
         slopes(i) = self%leading(i)*(slopes(i)*above + below(i)*above_slope)
         above_slope = above_slope*(place - self%node(i)) + above
         above = above*(place - self%node(i))
      end do
   end function slopes_at

   !> Zeros of P_m(x) - P_{m-1}(x) with x = 2 point - 1, by Newton's method from the right, where
   !> zeros already found are divided out (Maehly). The last one is 1.
   pure function points_of(degree) result(points)
      integer, intent(in) :: degree
      real(wp) :: points(degree)
      real(wp) :: move, p(0:degree), slope(0:degree), x
      integer, parameter :: most_iterations = 60
      integer :: i, iteration, k

      p(0) = 1.0_wp
      slope(0) = 0.0_wp
      do i = degree, 1, -1
         x = 1.5_wp
         do iteration = 1, most_iterations
            p(1) = x
            slope(1) = 1.0_wp
            do k = 2, degree
               p(k) = ((2*k - 1)*x*p(k - 1) - (k - 1)*p(k - 2))/k
               slope(k) = slope(k - 2) + (2*k - 1)*p(k - 1)
            end do
            associate (f => p(degree) - p(degree - 1), &
                       df => slope(degree) - slope(degree - 1), &
                       found => 2.0_wp*points(i + 1:) - 1.0_wp)
               move = f/(df - f*sum(1.0_wp/(x - found)))
            end associate
            x = x - move
            if (abs(move) <= 2.0_wp*epsilon(x)) exit
         end do
         points(i) = 0.5_wp*(x + 1.0_wp)
      end do
      points(degree) = 1.0_wp
   end function points_of

   !> Weights w with which polynomials up to degree 2m - 2 are integrated exactly. So 1, ...,
   !> P_{m-1} are orthogonal also as sums over the points: w = 1/(sum of (2j + 1) P_j^2 over j =
   !> 0..m-1).
   pure function weights_of(points) result(weights)
      real(wp), intent(in) :: points(:)
      real(wp) :: weights(size(points))
      real(wp), dimension(size(points)) :: before, legendre, next
      integer :: j

      before = 0.0_wp
      legendre = 1.0_wp
      weights = 1.0_wp
      associate (x => 2.0_wp*points - 1.0_wp)
         do j = 1, size(points) - 1
            next = ((2*j - 1)*x*legendre - (j - 1)*before)/j
            before = legendre
            legendre = next
            weights = weights + (2*j + 1)*legendre**2
         end do
      end associate
      weights = 1.0_wp/weights
   end function weights_of
end module collocation_basis
