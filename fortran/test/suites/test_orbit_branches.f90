! SPDX-License-Identifier: BSD-3-Clause
!> Branches of periodic orbits, their special points and curves of these, against simulations on
!> both sides, other meshes, known curves and published values. More published values:
!> python/gallery/neurons.py.
module test_orbit_branches
   use block_builder, only: block_at, build_block, by_epsilon, by_tau, index_of_ln_v, made
   use branch_ends, only: follow_settings_type
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_family, only: family_type
   use model_problem, only: model_type
   use orbit_branch, only: branch_type
   use orbit_change, only: orbit_change_type
   use orbit_curves, only: curve_type, follow_curve
   use orbit_runs, only: branch_from, branch_from_hopf, last_maxima, orbit_of_block, sine_orbit
   use orbit_start, only: orbit_of_double_period
   use periodic_orbit, only: periodic_orbit_type
   use special_points, only: cusp, fold, nearest_resonance, period_doubling, special_point_type, &
                             torus_bifurcation
   implicit none (type, external)
   private
   public :: collect_orbit_branches

   !> tau, epsilon, xi and gamma of a cycle.
   real(wp), parameter :: place_of_cycle(4) = [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp]
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_orbit_branches(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a fold of the block", test_fold), &
                   new_unittest("a torus point of the block", test_torus), &
                   new_unittest("a period doubling and its branch", test_doubling), &
                   new_unittest("ends of a branch", test_ends), &
                   new_unittest("nearest resonances", test_resonances), &
                   new_unittest("curves end at published points", test_published), &
                   new_unittest("a known fold curve and its cusp", test_cusp)]
   end subroutine collect_orbit_branches

   !> The branch of a block at xi = gamma = 0.8 through the cycle that a trajectory has reached, and
   !> its points.
   subroutine branch_of_block(tau, epsilon, settings, degree, direction, branch, special, error)
      real(wp), intent(in) :: tau, epsilon
      type(follow_settings_type), intent(in) :: settings
      integer, intent(in) :: degree, direction
      type(branch_type), intent(out) :: branch
      type(special_point_type), allocatable, intent(out) :: special(:)
      type(error_type), allocatable, intent(inout) :: error
      type(periodic_orbit_type) :: orbit

      call orbit_of_block(build_block(tau, epsilon, 0.8_wp, 0.8_wp, v=1.1_wp), 1000.0_wp, degree, &
                          30, orbit, error)
      call branch_from(orbit, settings, direction, branch, special, error)
   end subroutine branch_of_block

   !> The special point of a branch, and on a mesh of another degree.
   subroutine find_point_twice(settings, kind, point, other, branch, error)
      type(follow_settings_type), intent(in) :: settings
      character(len=*), intent(in) :: kind
      type(special_point_type), intent(out) :: point, other
      type(branch_type), intent(out) :: branch
      type(error_type), allocatable, intent(inout) :: error
      type(special_point_type), allocatable :: special(:)
      integer :: degree

      do degree = 5, 6
         other = point
         call branch_of_block(10.0_wp, 0.5_wp, settings, degree, 1, branch, special, error)
         if (allocated(error)) return
         call expect(error, size(special) == 1, "one special point of degree "//text(degree))
         if (allocated(error)) return
         point = special(1)
      end do
      call expect(error, point%kind == kind, "a point of kind "//kind)
      call expect_close(error, point%mesh_error, 0.0_wp, 1.0e-9_wp, "difference of the meshes")
      call expect_close(error, point%orbit%parameters, other%orbit%parameters, 1.0e-8_wp, &
                        "parameters of both points")
   end subroutine find_point_twice

   !> The cycle of tau = 10, xi = 0.8 ends in a fold.
   subroutine test_fold(error)
      type(error_type), allocatable, intent(out) :: error
      type(follow_settings_type) :: settings
      type(branch_type) :: branch
      type(special_point_type) :: other, point

      settings%family = family_type(block_at(place_of_cycle), [by_epsilon], [1.0_wp])
      settings%window(:, 1) = [0.4_wp, 1.0_wp]
      settings%most_points = 18
      call find_point_twice(settings, fold, point, other, branch, error)
      if (allocated(error)) return
      call expect(error, all(point%unstable == [0, 1]), "behind it one unstable multiplier")
   end subroutine test_fold

   !> A longer delay makes the cycle of epsilon = 0.5, xi = 0.8 a torus: simulations are a cycle
   !> before the torus point, and none behind it.
   subroutine test_torus(error)
      type(error_type), allocatable, intent(out) :: error
      type(follow_settings_type) :: settings
      type(branch_type) :: branch
      type(special_point_type) :: other, point
      type(model_type) :: block
      real(wp), allocatable :: maxima(:)
      integer :: i

      settings%family = family_type(block_at(place_of_cycle), [by_tau], [5.0_wp])
      settings%window(:, 1) = [10.0_wp, 12.4_wp]
      call find_point_twice(settings, torus_bifurcation, point, other, branch, error)
      if (allocated(error)) return
      call expect(error, branch%ending == "window", "the end of the window")
      call expect_close(error, branch%orbits(size(branch%orbits))%parameters(1), 12.4_wp, &
                        1.0e-12_wp, "the last orbit is at the edge")
      call expect_close(error, abs(point%multiplier), 1.0_wp, 1.0e-9_wp, "modulus of the pair")
      call expect(error, point%criticality() == "supercritical", "stable tori start there")
      call expect_close(error, point%coefficient, other%coefficient, 1.0e-8_wp, &
                        "coefficient of the normal form")
      do i = 1, 2
         block = build_block(point%orbit%parameters(1) + merge(-0.25_wp, 0.15_wp, i == 1), 0.5_wp, &
                             0.8_wp, 0.8_wp, v=1.1_wp)
         call last_maxima(block, index_of_ln_v, 4000.0_wp, 200.0_wp, maxima, error)
         call expect(error, maxval(maxima) - minval(maxima) < 1.0e-3_wp .eqv. i == 1, "a cycle")
      end do
   end subroutine test_torus

   !> Mackey and Glass's equation: from its Hopf point (cos(omega tau) = -1/4, omega^2 = 0.15) to
   !> the first period doubling. Simulations repeat after one maximum before it and after two behind
   !> it, and those lie on the branch of double period.
   subroutine test_doubling(error)
      type(error_type), allocatable, intent(out) :: error
      type(follow_settings_type) :: settings
      type(branch_type) :: branch, doubled
      type(failure_type), allocatable :: failure
      type(model_type) :: model
      type(orbit_change_type) :: tangent
      type(periodic_orbit_type) :: orbit
      type(special_point_type), allocatable :: of_doubled(:), special(:)
      real(wp), allocatable :: maxima(:)
      real(wp) :: hopf, omega, range(2), tau
      integer :: i

      omega = sqrt(0.15_wp)
      hopf = acos(-0.25_wp)/omega
      model = made("made_mackey_glass", [hopf], [1.2_wp])
      settings%family = family_type(model, [1], [10.0_wp])
      settings%window(:, 1) = [4.0_wp, 14.5_wp]
      call branch_from_hopf(settings, [hopf], omega, 0.01_wp, branch, special, error)
      if (allocated(error)) return
      call expect(error, branch%ending == "window", "the end of the window")
      call expect(error, branch%orbits(2)%parameters(1) > hopf, "supercritical")
      call expect(error, branch%multipliers(2)%unstable() == 0, "stable at first")
      call expect(error, size(special) >= 1, "a special point")
      if (allocated(error)) return
      associate (point => special(1))
         call expect(error, point%kind == period_doubling, "a period doubling")
         call expect_close(error, abs(point%multiplier + 1.0_wp), 0.0_wp, 1.0e-9_wp, "multiplier")
         tau = point%orbit%parameters(1)
         call last_maxima(made("made_mackey_glass", [tau - 0.3_wp], [1.2_wp]), 1, 8010.0_wp, &
                          300.0_wp, maxima, error)
         call expect_close(error, maxval(maxima), minval(maxima), 1.0e-4_wp, &
                           "one maximum before it")
         call last_maxima(made("made_mackey_glass", [tau + 0.3_wp], [1.2_wp]), 1, 8010.0_wp, &
                          300.0_wp, maxima, error)
         if (allocated(error)) return
         call expect(error, abs(maxima(2) - maxima(1)) > 1.0e-2_wp, "different maxima behind it")
         call expect_close(error, maxima(3), maxima(1), 1.0e-4_wp, "two in turn")
         call orbit_of_double_period(settings%family, point, 0.01_wp, orbit, tangent, failure)
         call expect_success(error, failure)
         settings%window(2, 1) = tau + 0.3_wp
         call branch_from(orbit, settings, 1, doubled, of_doubled, error, tangent)
         if (allocated(error)) return
         i = size(doubled%orbits)
         call expect(error, doubled%ending == "window", "the branch of double period goes on")
         range = doubled%orbits(i)%range_of(1)
         call expect_close(error, range(2), maxval(maxima), 1.0e-5_wp, "its maximum")
         call expect(error, doubled%multipliers(i)%unstable() == 0, "stable")
         call expect_close(error, doubled%orbits(1)%period/point%orbit%period, 2.0_wp, 1.0e-2_wp, &
                           "twice the period")
         point%kind = fold
         call orbit_of_double_period(settings%family, point, 0.01_wp, orbit, tangent, failure)
         call expect_failure(error, failure, "kind fold")
      end associate
   end subroutine test_doubling

   !> Branches end at a small amplitude (towards smaller epsilon the cycle shrinks to the Hopf
   !> point), at a long period and after the most orbits.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      type(follow_settings_type) :: settings
      type(branch_type) :: branch
      type(special_point_type), allocatable :: special(:)

      settings%family = family_type(block_at(place_of_cycle), [by_epsilon], [1.0_wp])
      settings%window(:, 1) = [0.0_wp, 1.0_wp]
      settings%least_amplitude = 0.05_wp
      call branch_of_block(10.0_wp, 0.35_wp, settings, 5, -1, branch, special, error)
      if (allocated(error)) return
      call expect(error, branch%ending == "amplitude", "a small amplitude")
      call expect_between(error, branch%orbits(size(branch%orbits))%amplitude(), 1.0e-4_wp, &
                          0.05_wp, "the last amplitude")
      settings%longest_period = 10.4_wp
      call branch_of_block(10.0_wp, 0.5_wp, settings, 5, 1, branch, special, error)
      if (allocated(error)) return
      call expect(error, branch%ending == "period", "a long period")
      settings%longest_period = 20.0_wp
      settings%most_points = 3
      call branch_of_block(10.0_wp, 0.5_wp, settings, 5, 1, branch, special, error)
      if (allocated(error)) return
      call expect(error, branch%ending == "orbits" .and. size(branch%orbits) == 3, "three orbits")
   end subroutine test_ends

   !> The golden mean has the fractions of Fibonacci numbers.
   subroutine test_resonances(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, all(nearest_resonance(1.0_wp/3) == [1, 3]), "1:3")
      call expect(error, all(nearest_resonance(0.2_wp + 1.0e-4_wp) == [1, 5]), "1:5")
      call expect(error, all(nearest_resonance(1.0e-3_wp) == [0, 1]), "1:1")
      call expect(error, all(nearest_resonance(0.5_wp) == [1, 2]), "1:2")
      call expect(error, all(nearest_resonance(0.3819660113_wp) == [3, 8]), "3:8")
   end subroutine test_resonances

   !> The Hopf point of greater omega of the Duffing equation:
   !> (a + b - omega^2)^2 + (d omega)^2 = b^2.
   pure subroutine hopf_of_duffing(a, b, d, turns, omega, tau)
      real(wp), intent(in) :: a, b, d
      integer, intent(in) :: turns
      real(wp), intent(out) :: omega, tau
      real(wp) :: half

      half = a + b - 0.5_wp*d**2
      omega = sqrt(half + sqrt(half**2 - (a + b)**2 + b**2))
      tau = (modulo(atan2(-d*omega/b, (a + b - omega**2)/b), 2.0_wp*pi) + 2.0_wp*pi*turns)/omega
   end subroutine hopf_of_duffing

   !> The curve that starts at the first point of a kind on the branch from a Hopf point.
   subroutine curve_of_duffing(b, turns, kind, known, within, curve, error)
      real(wp), intent(in) :: b
      integer, intent(in) :: turns
      character(len=*), intent(in) :: kind
      !> b and tau at the end of the curve, and the accuracy to which they are published
      real(wp), intent(in) :: known(2), within(2)
      type(curve_type), intent(out) :: curve
      type(error_type), allocatable, intent(inout) :: error
      real(wp), parameter :: a = 0.5_wp, d = 0.05_wp
      type(follow_settings_type) :: settings
      type(branch_type) :: branch
      type(failure_type), allocatable :: failure
      type(model_type) :: model
      type(special_point_type), allocatable :: special(:)
      real(wp) :: omega, tau
      integer :: i

      call hopf_of_duffing(a, b, d, turns, omega, tau)
      model = made("made_duffing", [tau, a, b, d, 0.0_wp], [0.5_wp, 0.0_wp])
      settings%family = family_type(model, [1], [5.0_wp])
      settings%window(:, 1) = [0.0_wp, 20.0_wp]
      settings%most_points = 30
      call branch_from_hopf(settings, model%numbers, omega, 0.02_wp, branch, special, error)
      if (allocated(error)) return
      i = findloc(special%kind == kind, .true., dim=1)
      call expect(error, i > 0, "a point of kind "//kind)
      if (allocated(error)) return
      settings%family = family_type(model, [1, 3], [5.0_wp, 0.2_wp])
      settings%least_amplitude = 0.003_wp
      settings%window = reshape([0.1_wp, 20.0_wp, 0.01_wp, 0.6_wp], [2, 2])
      settings%most_points = 200
      call follow_curve(settings, special(i), -1, curve, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, curve%ending == trim(merge("generalised_hopf", "double_hopf     ", &
                                                    kind == fold)), "a Hopf point at its end")
      associate (parameters => curve%points(size(curve%points))%orbit%parameters)
         call expect_close(error, (parameters([3, 1]) - known)/within, [0.0_wp, 0.0_wp], 1.0_wp, &
                           "misfit of b and tau in units of their accuracy")
      end associate
   end subroutine curve_of_duffing

   !> "minimal_demo" of DDE-BIFTOOL: torus curves start at the double Hopf points b = 0.354445,
   !> tau = 8.72874 and b = 0.173725, tau = 17.4169, a curve of folds at the generalised Hopf point
   !> b = 0.036906, tau = 14.8348.
   subroutine test_published(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_type) :: curve

      call curve_of_duffing(0.37_wp, 1, torus_bifurcation, [0.354445_wp, 8.72874_wp], &
                            [2.0e-6_wp, 5.0e-5_wp], curve, error)
      if (allocated(error)) return
      call curve_of_duffing(0.2_wp, 2, torus_bifurcation, [0.173725_wp, 17.4169_wp], &
                            [2.0e-6_wp, 2.0e-4_wp], curve, error)
      if (allocated(error)) return
      call curve_of_duffing(0.04_wp, 1, fold, [0.036906_wp, 14.8348_wp], [1.0e-6_wp, 2.0e-4_wp], &
                            curve, error)
      if (allocated(error)) return
      call expect(error, size(curve%cusps) == 0, "no cusp at the generalised Hopf point")
   end subroutine test_published

   !> The curve of folds of cycles sqrt(1 + s) sin t of a cubic towards smaller b. The folds are at
   !> a = -2 s^3, b = 3 s^2, with a cusp at s = 0.
   subroutine curve_of_cubic(first, most_b, longest_step, curve, error)
      real(wp), intent(in) :: first, most_b, longest_step
      type(curve_type), intent(out) :: curve
      type(error_type), allocatable, intent(inout) :: error
      type(follow_settings_type) :: settings
      type(failure_type), allocatable :: failure
      type(special_point_type) :: start

      start%orbit = sine_orbit(5, 20, sqrt(1.0_wp + first), 2.0_wp*pi, &
                               [-2.0_wp*first**3, 3.0_wp*first**2, 1.0_wp])
      start%kind = fold
      settings%family = family_type(made("made_circle", start%orbit%parameters, [1.0_wp]), [1, 2], &
                                    [1.0_wp, 1.0_wp])
      settings%least_amplitude = 0.02_wp
      settings%window = reshape([-1.0_wp, 1.0_wp, -1.0_wp, most_b], [2, 2])
      settings%longest_step = longest_step
      call follow_curve(settings, start, -1, curve, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, curve%ending == "window", "the curve turns back to greater b")
      call expect(error, size(curve%cusps) == 1, "one cusp")
      if (allocated(error)) return
      associate (found => curve%cusps(1))
         call expect(error, found%kind == cusp, "its kind")
         call expect_close(error, found%orbit%parameters(:2), [0.0_wp, 0.0_wp], 1.0e-9_wp, "place")
         call expect_close(error, found%orbit%amplitude(), 2.0_wp, 1.0e-3_wp, "its amplitude")
         call expect(error, found%mesh_error < 1.0e-9_wp, "two meshes agree")
      end associate
   end subroutine curve_of_cubic

   !> Points of the curve are folds, on both sides of the cusp. Among short steps, directions that
   !> lag behind the curve by steps would miss it.
   subroutine test_cusp(error)
      type(error_type), allocatable, intent(out) :: error
      type(follow_settings_type) :: default
      type(curve_type) :: curve
      integer :: i

      call curve_of_cubic(0.4_wp, 0.6_wp, default%longest_step, curve, error)
      if (allocated(error)) return
      do i = 2, size(curve%points)
         associate (p => curve%points(i)%orbit%parameters)
            call expect_close(error, p(1)**2/4.0_wp, (p(2)/3.0_wp)**3, 1.0e-7_wp, "a fold")
         end associate
      end do
      associate (last => curve%points(size(curve%points))%orbit%parameters)
         call expect(error, last(1) > 0.1_wp, "the other side of the cusp")
      end associate
      call curve_of_cubic(0.05_wp, 0.008_wp, 0.001_wp, curve, error)
   end subroutine test_cusp
end module test_orbit_branches
