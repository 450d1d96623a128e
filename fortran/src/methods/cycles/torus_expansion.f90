! SPDX-License-Identifier: BSD-3-Clause
!> Expansion of the right-hand side T f of a delay equation about a periodic orbit x0 along a
!> complex disturbance q with the amplitude z:
!>
!>     x = x0(s) + 2 Re[z q(s) + z^2 h20(s)] + |z|^2 h11(s),   s' = 1 + a |z|^2.
!>
!> Delayed values are those at s - (1 + a |z|^2) lag/T. Derivatives are differences in z.
module torus_expansion
   use dde, only: find_jacobian
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: h11, h20, q, torus_expansion_type, x0

   !> Numbers of the terms x0, q, h20, h11.
   integer, parameter :: x0 = 0, q = 1, h20 = 2, h11 = 3

   !> The expansion.
   type :: torus_expansion_type
      !> The problem
      class(model_type), allocatable :: problem
      !> x0
      type(periodic_orbit_type) :: orbit
      !> All terms at the nodes of the orbit, shape (n, nodes, 0:3); 0 before they are known
      complex(wp), allocatable :: nodes(:, :, :)
      !> Factor of each term over a period
      complex(wp) :: multiplier(0:3) = (1.0_wp, 0.0_wp)
      !> Change of speed
      real(wp) :: a = 0.0_wp
   contains
      procedure :: terms_at, components, second_order, third_order
      !> The least |z| of the differences
      procedure, private :: least_size
   end type torus_expansion_type

   !> Derivatives are differences with four sizes of z, in proportion 1, 2, 3, 4. With the first,
   !> 2 |z q| is at most this share of the amplitude of the orbit. Third derivatives have rounding
   !> errors of order 1/z^3, and truncation errors of order z^6.
   real(wp), parameter :: share = 3.0e-3_wp
   integer, parameter :: sizes = 4
   !> p(0) and p'(0) by p(1), p(4), p(9), p(16) for polynomials p of degree 3
   real(wp), parameter :: at_zero(sizes) = [56.0_wp, -28.0_wp, 8.0_wp, -1.0_wp]/35.0_wp, &
                          slope_at_zero(sizes) = [-122.0_wp, 169.0_wp, -54.0_wp, 7.0_wp]/180.0_wp
   !> Phases of z in a Fourier sum
   integer, parameter :: phases = 8

contains

   !> All terms at a time in periods, shape (n, 0:3).
   pure function terms_at(self, s) result(terms)
      class(torus_expansion_type), intent(in) :: self
      real(wp), intent(in) :: s
      complex(wp) :: terms(size(self%nodes, 1), 0:3)
      real(wp) :: place
      integer :: first, i

      associate (basis => self%orbit%basis)
         call self%orbit%locate(s - floor(s), i, place)
         first = (i - 1)*basis%degree + 1
         do i = x0, h11
            terms(:, i) = self%multiplier(i)**floor(s) &
                          *matmul(self%nodes(:, first:first + basis%degree, i), &
                                  basis%values_at(place))
         end do
      end associate
   end function terms_at

   !> Components 0, 1, 2 of the right-hand side T f as a Fourier series in the phase of z, shape
   !> (n, 0:2).
   pure function components(self, s, z) result(parts)
      class(torus_expansion_type), intent(in) :: self
      real(wp), intent(in) :: s, z
      complex(wp) :: parts(size(self%nodes, 1), 0:2)
      complex(wp) :: delayed(size(self%problem%lag), 0:3), factor(0:3), turned, &
                     terms(size(self%nodes, 1), 0:3)
      real(wp) :: f(size(self%nodes, 1))
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
      integer :: k

      associate (lag => self%problem%lag, period => self%orbit%period)
         do k = 1, size(lag)
            terms = self%terms_at(s - (1.0_wp + self%a*z**2)*lag(k)/period)
            delayed(k, :) = terms(self%problem%component(k), :)
         end do
         terms = self%terms_at(s)
         parts = 0.0_wp
         do k = 1, phases
            turned = exp(cmplx(0.0_wp, turn*k/phases, kind=wp))
            factor = [cmplx(1.0_wp, kind=wp), 2.0_wp*z*turned, 2.0_wp*(z*turned)**2, &
                      cmplx(z**2, kind=wp)]
            call self%problem%rhs(0.0_wp, real(matmul(terms, factor)), &
                                  real(matmul(delayed, factor)), f)
            parts(:, 0) = parts(:, 0) + f
            parts(:, 1) = parts(:, 1) + f*conjg(turned)
            parts(:, 2) = parts(:, 2) + f*conjg(turned)**2
         end do
         parts = period*parts/phases
      end associate
   end function components

   !> The least |z| of the differences; q must be known.
   pure real(wp) function least_size(self) result(z)
      class(torus_expansion_type), intent(in) :: self

      z = share*self%orbit%amplitude()*self%orbit%unit/(2.0_wp*maxval(abs(self%nodes(:, :, q))))
   end function least_size

   !> Forcings at the collocation points: real and imaginary part of that of h20, and that of h11; q
   !> must be known.
   pure function second_order(self) result(forcing)
      class(torus_expansion_type), intent(in) :: self
      real(wp), allocatable :: forcing(:, :, :, :)
      complex(wp) :: parts(size(self%nodes, 1), 0:2), undisturbed(size(self%nodes, 1), 0:2)
      real(wp) :: s, z
      integer :: i, j, k

      z = self%least_size()
      associate (mesh => self%orbit%mesh, point => self%orbit%basis%point)
         allocate (forcing(size(parts, 1), size(point), size(mesh) - 1, 3), source=0.0_wp)
         do i = 1, size(forcing, 3)
            do k = 1, size(point)
               s = mesh(i) + (mesh(i + 1) - mesh(i))*point(k)
               undisturbed = self%components(s, 0.0_wp)
               do j = 1, sizes
                  parts = self%components(s, z*j) - undisturbed
                  parts = at_zero(j)*parts/(z*j)**2
                  forcing(:, k, i, 1) = forcing(:, k, i, 1) + real(parts(:, 2))
                  forcing(:, k, i, 2) = forcing(:, k, i, 2) + aimag(parts(:, 2))
                  forcing(:, k, i, 3) = forcing(:, k, i, 3) + real(parts(:, 0))
               end do
            end do
         end do
      end associate
   end function second_order

   !> Forcings at the collocation points, each by real and imaginary part: that of h21 without d,
   !> and that which d multiplies, -q - (lag df/dz) q(s - lag/T). All terms and `a` must be known.
   pure function third_order(self) result(forcing)
      class(torus_expansion_type), intent(in) :: self
      real(wp), allocatable :: forcing(:, :, :, :)
      complex(wp), dimension(size(self%nodes, 1)) :: by_d, cubic, slope
      complex(wp) :: delayed(size(self%problem%lag), 0:3), parts(size(self%nodes, 1), 0:2), &
                     terms(size(self%nodes, 1), 0:3)
      real(wp) :: by_y(size(by_d), size(by_d)), by_z(size(by_d), size(delayed, 1)), s, z
      integer :: first, i, j, k

      z = self%least_size()
      associate (lag => self%problem%lag, basis => self%orbit%basis, mesh => self%orbit%mesh)
         allocate (forcing(size(by_d), basis%degree, self%orbit%intervals(), 4))
         do i = 1, size(forcing, 3)
            first = (i - 1)*basis%degree + 1
            do k = 1, basis%degree
               s = mesh(i) + (mesh(i + 1) - mesh(i))*basis%point(k)
               slope = matmul(self%nodes(:, first:first + basis%degree, q), basis%slope(:, k)) &
                       /(mesh(i + 1) - mesh(i))
               cubic = -self%a*slope
               do j = 1, sizes
                  parts = self%components(s, z*j)
                  cubic = cubic + slope_at_zero(j)*parts(:, 1)/(z*j)/z**2
               end do
               do j = 1, size(lag)
                  terms = self%terms_at(s - lag(j)/self%orbit%period)
                  delayed(j, :) = terms(self%problem%component(j), :)
               end do
               terms = self%terms_at(s)
               call find_jacobian(self%problem, 0.0_wp, real(terms(:, x0)), real(delayed(:, x0)), &
                                  by_y, by_z)
               by_d = -terms(:, q) - matmul(by_z, lag*delayed(:, q))
               forcing(:, k, i, 1) = real(cubic)
               forcing(:, k, i, 2) = aimag(cubic)
               forcing(:, k, i, 3) = real(by_d)
               forcing(:, k, i, 4) = aimag(by_d)
            end do
         end do
      end associate
   end function third_order
end module torus_expansion
