! SPDX-License-Identifier: BSD-3-Clause
!> Curves of special points of periodic orbits, against published values.
module test_orbit_curves
   use branch_ends, only: follow_settings_type
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use known_models, only: delayed_cubic, duffing, known_model
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_family, only: family_type
   use orbit_branch, only: branch_type
   use orbit_curves, only: curve_type, follow_curve
   use orbit_runs, only: branch_from_hopf, new_orbit
   use special_points, only: cusp, fold, special_point_type, torus_bifurcation
   implicit none (type, external)
   private
   public :: collect_orbit_curves

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_orbit_curves(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("curves end at published points", test_published), &
                   new_unittest("a known fold curve and its cusp", test_cusp), &
                   new_unittest("a cusp among short steps", test_cusp_short_steps)]
   end subroutine collect_orbit_curves

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
      type(known_model) :: model
      type(special_point_type), allocatable :: special(:)
      real(wp) :: omega, tau
      integer :: i

      call hopf_of_duffing(a, b, d, turns, omega, tau)
      model = known_model(duffing, [tau, a, b, d, 0.0_wp])
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
         call expect_close(error, parameters(3), known(1), within(1), "b")
         call expect_close(error, parameters(1), known(2), within(2), "tau")
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

      associate (orbit => start%orbit)
         orbit = new_orbit(5, 20, 2.0_wp*pi, [-2.0_wp*first**3, 3.0_wp*first**2])
         orbit%nodes = reshape(sqrt(1.0_wp + first)*sin(2.0_wp*pi*orbit%node_times()), [1, 101])
      end associate
      start%kind = fold
      settings%family = family_type(known_model(delayed_cubic, [0.0_wp, 0.0_wp]), [1, 2], &
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
         call expect_close(error, found%orbit%parameters, [0.0_wp, 0.0_wp], 1.0e-9_wp, "its place")
         call expect_close(error, found%orbit%amplitude(), 2.0_wp, 1.0e-3_wp, "its amplitude")
         call expect(error, found%mesh_error < 1.0e-9_wp, "two meshes agree")
      end associate
   end subroutine curve_of_cubic

   !> Points of the curve are folds, on both sides of the cusp.
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
   end subroutine test_cusp

   !> Directions that lag behind the curve by steps would miss this cusp.
   subroutine test_cusp_short_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_type) :: curve

      call curve_of_cubic(0.05_wp, 0.008_wp, 0.001_wp, curve, error)
   end subroutine test_cusp_short_steps
end module test_orbit_curves
