!> Normal form of torus points, against an exact one.
module test_torus_normal_form
   use collocation_basis, only: gauss_points, radau_points
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use orbit_equations, only: newton_type
   use orbit_runs, only: correct, fix_parameters, new_orbit
   use periodic_orbit, only: periodic_orbit_type
   use special_points, only: fold, special_point_type, torus_bifurcation
   use torus_normal_form, only: find_torus_coefficient
   use twin_waves, only: kappa, omega1, on_cycle, sigma, twin_waves_family
   implicit none (type, external)
   private
   public :: collect_torus_normal_form

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   !> All tests of this suite.
   subroutine collect_torus_normal_form(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exact coefficients", test_exact), &
                   new_unittest("criticality", test_criticality)]
   end subroutine collect_torus_normal_form

   !> Tori of rotating waves, stable and unstable ones: with delay at Gauss points, with an uneven
   !> course of time at the points of Radau.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      type(twin_waves_family) :: family
      real(wp), parameter :: p22(2) = [-2.5_wp, 1.5_wp], omega2(2) = [0.4_wp, 2.3_wp]
      real(wp) :: coefficient, disturbed(4), expected
      integer :: i, j, points

      do points = gauss_points, radau_points
         family%delayed = points == gauss_points
         do i = 1, 2
            orbit = new_orbit(7, points, 32, turn/omega1, [p22(i), omega2(i)])
            associate (s => orbit%node_times())
               orbit%nodes = reshape([(on_cycle(turn*s(j)), j=1, size(s))], [4, size(s)])
            end associate
            call correct(family, orbit, newton, failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            call find_torus_coefficient(fix_parameters(family), orbit, &
                                        exp(cmplx(0.0_wp, turn*omega2(i)/omega1, kind=wp)), 6, &
                                        coefficient, disturbed, failure)
            call expect_success(error, failure)
            expected = family%coefficient(orbit%parameters)
            call expect_close(error, coefficient, expected, 1.0e-8_wp, "coefficient "//text(i))
            call expect(error, (expected < 0.0_wp) .eqv. i == 1, "one stable, one unstable torus")
            if (.not. family%delayed) cycle
            ! q = (kappa x2, 0, 1 + sigma kappa x2^2, -i) Re z2 along the cycle, where |x2| is 0, 1,
            ! 1/sqrt(2) and anything when the state is greatest
            associate (k => sigma*kappa)
               call expect_close(error, disturbed, [0.0_wp, 0.0_wp, 1.0_wp + 0.5_wp*k, 1.0_wp] &
                                 /sqrt(0.5_wp*kappa**2 + 2.0_wp + k + 0.375_wp*k**2), &
                                 1.0e-8_wp, "disturbance")
            end associate
         end do
      end do
   end subroutine test_exact

   !> It is the sign of the coefficient where that is certain and no strong resonance is near.
   subroutine test_criticality(error)
      type(error_type), allocatable, intent(out) :: error
      type(special_point_type) :: point

      point%kind = fold
      call expect(error, point%criticality() == "", "none of a fold")
      point%kind = torus_bifurcation
      point%multiplier = exp(cmplx(0.0_wp, 0.22_wp*turn, kind=wp))
      point%coefficient = -0.1_wp
      call expect(error, point%criticality() == "not determined", "found on one mesh only")
      call check(-0.1_wp, 1.0e-6_wp, 0.22_wp, "supercritical")
      call check(0.1_wp, 1.0e-6_wp, 0.22_wp, "subcritical")
      call check(0.1_wp, 0.05_wp, 0.22_wp, "not determined")
      call check(0.1_wp, 1.0e-6_wp, 1.0_wp/3.0_wp, "not determined")
      call check(0.1_wp, 1.0e-6_wp, 0.2_wp, "subcritical")

   contains

      !> The word for a coefficient with its error at an angle in turns.
      subroutine check(coefficient, coefficient_error, angle, word)
         real(wp), intent(in) :: coefficient, coefficient_error, angle
         character(len=*), intent(in) :: word

         point%coefficient = coefficient
         point%coefficient_error = coefficient_error
         point%multiplier = exp(cmplx(0.0_wp, angle*turn, kind=wp))
         call expect(error, point%criticality() == word, word//" at angle "//text(angle))
      end subroutine check
   end subroutine test_criticality
end module test_torus_normal_form
