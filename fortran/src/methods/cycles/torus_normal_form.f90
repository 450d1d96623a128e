! SPDX-License-Identifier: BSD-3-Clause
!> Normal form of a torus (Neimark-Sacker) bifurcation of a periodic orbit x0 with period T. On the
!> centre manifold, with r = t/T,
!>
!>     x     = x0(s) + 2 Re[z q(s) + z^2 h20(s) + z |z|^2 h21(s)] + |z|^2 h11(s) + ...,
!>     ds/dr = 1 + a |z|^2 + ...,   dz/dr = d z |z|^2 + ...,
!>     q(s + 1) = m q(s),   h20(s + 1) = m^2 h20(s),   h21(s + 1) = m h21(s),   h11(s + 1) = h11(s)
!>
!> with the critical multiplier m (Kuznetsov et al. 2005, SIAM J. Numer. Anal. 43, 1407). Each power
!> of z in the equation x' = T f gives a linear equation for its term. Those for h11 and h21 have a
!> solution for one value of a or d only, which is a further unknown: no adjoint eigenvector is
!> needed. Delayed values are those at s - (1 + a |z|^2) lag/T; their z is (1 - d |z|^2 lag/T) z.
module torus_normal_form
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use orbit_map, only: linear_map_type, solve_by_gmres
   use model_family, only: family_type
   use orbit_change, only: orbit_change_type, phase_condition, weights_of
   use orbit_linearisation, only: linearise_orbit
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   use torus_expansion, only: h11, h20, q, torus_expansion_type, x0
   implicit none (type, external)
   private
   public :: find_torus_coefficient

   !> The linear equation of a term; the vector is its past in units of the state, then the further
   !> unknown, each by real and imaginary part. Forcings have numbers as in `orbit_passes`, or 0.
   type, extends(linear_map_type) :: term_map_type
      !> Linear equations about the orbit
      type(orbit_passes_type) :: linear
      !> Factor of the term over a period
      complex(wp) :: multiplier = (1.0_wp, 0.0_wp)
      !> Real and imaginary part of its forcing, and of that which the further unknown multiplies
      integer :: given(2) = 0, unknown(2) = 0
      !> Weights in a sum over the nodes that is 0, shape (n, nodes); where they are not allocated,
      !> the further unknown is 0
      complex(wp), allocatable :: condition(:, :)
   contains
      procedure :: apply => defect_of_term
   end type term_map_type

   !> Number of the forcing by the period; those by free parameters and further ones follow.
   integer, parameter :: of_period = 2
   !> Residual of the linear equations
   real(wp), parameter :: tolerance = 1.0e-11_wp

contains

   !> The coefficient Re d/T: d|z|/dt = Re d/T |z|^3, where the mean of |q|^2 over the period is 1.
   subroutine find_torus_coefficient(family, orbit, multiplier, wanted, coefficient, disturbed, &
                                     error)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> The critical multiplier
      complex(wp), intent(in) :: multiplier
      !> Number of multipliers among which it is
      integer, intent(in) :: wanted
      !> The coefficient; |q| of each component at the time when that is greatest, shape (n)
      real(wp), intent(out) :: coefficient, disturbed(:)
      !> A linear equation has no solution
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: disturbances(:, :, :), h21(:, :)
      complex(wp) :: a, d, terms(size(disturbed), 0:3)
      type(torus_expansion_type) :: x
      type(multipliers_type) :: found
      type(orbit_change_type) :: phase
      type(term_map_type) :: map
      integer :: critical, further, i
      real(wp) :: highest, time

      coefficient = 0.0_wp
      disturbed = 0.0_wp
      call linearise_orbit(family, orbit, map%linear, error)
      if (allocated(error)) return
      call find_multipliers(map%linear, wanted, found, error, disturbances)
      if (allocated(error)) return
      further = of_period + size(family%free)
      critical = minloc(abs(found%values - multiplier), dim=1)
      call family%at(orbit%parameters, x%problem)
      x%orbit = orbit
      x%multiplier(q:h20) = found%values(critical)**[1, 2]
      allocate (x%nodes(size(orbit%nodes, 1), size(orbit%nodes, 2), 0:3), source=(0.0_wp, 0.0_wp))
      x%nodes(:, :, x0) = orbit%nodes
      associate (q_nodes => disturbances(:, :, critical))
         x%nodes(:, :, q) = q_nodes/sqrt(real(sum(weights_with(orbit, q_nodes)*q_nodes)))
      end associate
      do i = 1, size(disturbed)
         call orbit%find_highest(i, 1.0_wp, highest, time)
         terms = x%terms_at(time)
         disturbed(i) = abs(terms(i, q))
      end do

      call linearise_orbit(family, orbit, map%linear, error, x%second_order())
      if (allocated(error)) return
      map%multiplier = x%multiplier(h20)
      map%given = further + [1, 2]
      call solve_term(map, x%nodes(:, :, h20), a, error)
      if (allocated(error)) return
      map%multiplier = x%multiplier(h11)
      map%given = [further + 3, 0]
      ! a lower speed is a longer period
      map%unknown = [of_period, 0]
      phase = phase_condition(orbit, 0)
      map%condition = cmplx(phase%nodes, kind=wp)
      call solve_term(map, x%nodes(:, :, h11), a, error)
      if (allocated(error)) return
      x%a = -real(a)

      call linearise_orbit(family, orbit, map%linear, error, x%third_order())
      if (allocated(error)) return
      map%multiplier = x%multiplier(q)
      map%given = further + [1, 2]
      map%unknown = further + [3, 4]
      map%condition = weights_with(orbit, x%nodes(:, :, q))
      allocate (h21(size(orbit%nodes, 1), size(orbit%nodes, 2)))
      call solve_term(map, h21, d, error)
      if (allocated(error)) return
      coefficient = real(d)/(orbit%period*orbit%unit**2)
      disturbed = disturbed/orbit%unit
   end subroutine find_torus_coefficient

   !> Weights w of the nodes with sum(w x) = mean of conjg(y) . x over the period.
   function weights_with(orbit, y) result(weights)
      type(periodic_orbit_type), intent(in) :: orbit
      !> y at the nodes, shape (n, nodes)
      complex(wp), intent(in) :: y(:, :)
      complex(wp) :: weights(size(y, 1), size(y, 2))
      type(orbit_change_type) :: imaginary_part, real_part

      real_part%nodes = real(y)
      real_part = weights_of(orbit, real_part)
      imaginary_part%nodes = -aimag(y)
      imaginary_part = weights_of(orbit, imaginary_part)
      weights = cmplx(real_part%nodes, imaginary_part%nodes, kind=wp)
   end function weights_with

   !> Solve the linear equation of a term.
   subroutine solve_term(map, nodes, unknown, error)
      type(term_map_type), intent(inout) :: map
      !> The term at the nodes, shape (n, nodes)
      complex(wp), intent(out) :: nodes(:, :)
      complex(wp), intent(out) :: unknown
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: parts(:, :, :), right(:), solution(:)

      associate (linear => map%linear)
         call linear%reach_back()
         allocate (parts(size(nodes, 1), size(nodes, 2), 2), source=0.0_wp)
         if (allocated(map%condition)) then
            parts(:, :, 1) = real(map%condition)
            parts(:, :, 2) = aimag(map%condition)
         end if
         call linear%prepare(parts)
         allocate (right(2*linear%past_size() + 2), solution(2*linear%past_size() + 2))
      end associate
      nodes = 0.0_wp
      unknown = 0.0_wp
      solution = 0.0_wp
      call defect(map, solution, 1.0_wp, right)
      right = -right
      call solve_by_gmres(map, right, tolerance, solution, error)
      if (allocated(error)) return
      call defect(map, solution, 1.0_wp, right, parts)
      nodes = cmplx(parts(:, :, 1), parts(:, :, 2), kind=wp)
      unknown = cmplx(solution(size(solution) - 1), solution(size(solution)), kind=wp)
   end subroutine solve_term

   !> The past times the multiplier, less the past a period later, and the condition.
   subroutine defect_of_term(self, vector, image)
      class(term_map_type), intent(inout) :: self
      real(wp), intent(in) :: vector(:)
      real(wp), intent(out) :: image(:)

      call defect(self, vector, 0.0_wp, image)
   end subroutine defect_of_term

   !> Defect of a term, plus a multiple of the given forcing.
   subroutine defect(self, vector, given, image, nodes)
      class(term_map_type), intent(in) :: self
      real(wp), intent(in) :: vector(:), given
      real(wp), intent(out) :: image(:)
      !> Real and imaginary part of the nodes, shape (n, nodes, 2)
      real(wp), intent(out), optional :: nodes(:, :, :)
      complex(wp) :: past(self%linear%past_size()), unknown
      real(wp) :: factor(0:size(self%linear%response, 1) - self%linear%inputs(), 2)
      real(wp) :: later(size(past), 2), sums(2, 2)
      integer :: i

      associate (n => size(past), unit => self%linear%unit)
         past = cmplx(vector(:n), vector(n + 1:2*n), kind=wp)
         unknown = cmplx(vector(2*n + 1), vector(2*n + 2), kind=wp)
         factor = 0.0_wp
         factor(self%unknown, 1) = [real(unknown), -aimag(unknown)]
         factor(self%unknown, 2) = [aimag(unknown), real(unknown)]
         factor(self%given(1), 1) = given
         factor(self%given(2), 2) = given
         do i = 1, 2
            if (present(nodes)) then
               call self%linear%pass(unit*vector((i - 1)*n + 1:i*n), factor(1:, i), later(:, i), &
                                     sums(:, i), nodes(:, :, i))
            else
               call self%linear%pass(unit*vector((i - 1)*n + 1:i*n), factor(1:, i), later(:, i), &
                                     sums(:, i))
            end if
         end do
         past = self%multiplier*past - cmplx(later(:, 1), later(:, 2), kind=wp)/unit
         if (allocated(self%condition)) then
            unknown = cmplx(sums(1, 1) - sums(2, 2), sums(1, 2) + sums(2, 1), kind=wp)
         end if
         image = [real(past), aimag(past), real(unknown), aimag(unknown)]
      end associate
   end subroutine defect
end module torus_normal_form
