! SPDX-License-Identifier: BSD-3-Clause
!> Floquet multipliers against exact ones, characteristic roots and Lyapunov exponents; the normal
!> form of torus points against an exact one.
module test_floquet_multipliers
   use block_builder, only: build_block
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use exponent_runs, only: measure
   use expectations, only: expect, expect_between, expect_close, expect_success
   use floquet_multipliers, only: multipliers_type
   use known_models, only: delayed_sine, driven_growth, known_model
   use lyapunov_spectrum, only: growth_settings_type, growth_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_family, only: fixed_model
   use model_problem, only: model_type
   use orbit_equations, only: newton_type
   use orbit_runs, only: correct, cycle_of_block, multipliers_of, new_orbit
   use periodic_orbit, only: periodic_orbit_type
   use solving, only: at_tolerance
   use special_points, only: fold, special_point_type, torus_bifurcation
   use torus_normal_form, only: find_torus_coefficient
   use twin_waves, only: kappa, omega1, on_cycle, sigma, twin_waves_type
   implicit none (type, external)
   private
   public :: collect_floquet_multipliers

   real(wp), parameter :: pi = acos(-1.0_wp)

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   subroutine collect_floquet_multipliers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exact multipliers, delays of one and two periods", test_exact), &
                   new_unittest("multipliers near a Hopf point", test_near_hopf), &
                   new_unittest("multipliers and exponents", test_exponents), &
                   new_unittest("exact coefficients", test_exact_coefficient), &
                   new_unittest("criticality", test_criticality)]
   end subroutine collect_floquet_multipliers

   !> Where the delay is k periods, x(t - k) = x(t)/mu^k: the multipliers solve mu = exp(a/mu^k),
   !> and exp(-2) is that of the circle. Both signs of a: a growing and an oscillating disturbance.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(known_model) :: model
      type(multipliers_type) :: found
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      real(wp), parameter :: rates(2) = [0.5_wp, -1.8_wp]
      real(wp) :: times(20*6 + 1)
      complex(wp) :: mu
      integer :: i, j, k, others

      do k = 1, 2
         do i = 1, 2
            orbit = new_orbit(6, 20, 1.0_wp, [rates(i), 0.7_wp, real(k, wp)])
            times = orbit%node_times()
            model = known_model(driven_growth, orbit%parameters)
            allocate (orbit%nodes(3, size(times)))
            orbit%nodes(1, :) = cos(2.0_wp*pi*times)
            orbit%nodes(2, :) = sin(2.0_wp*pi*times)
            orbit%nodes(3, :) = 0.0_wp
            call correct(model, orbit, newton, failure)
            call expect_success(error, failure)
            call multipliers_of(model, orbit, 6, found, error)
            if (allocated(error)) return
            call expect_close(error, orbit%period, 1.0_wp, 1.0e-12_wp, "period")
            call expect_close(error, found%trivial_error, 0.0_wp, 1.0e-9_wp, "trivial multiplier")
            others = 0
            do j = 1, size(found%values)
               mu = found%values(j)
               if (abs(mu - exp(-2.0_wp)) < 1.0e-8_wp) cycle
               others = others + 1
               call expect_close(error, abs(exp(rates(i)/mu**k) - mu), 0.0_wp, 2.0e-8_wp, &
                                 "multiplier "//text(j)//" of "//text(k)//" periods")
            end do
            call expect(error, others >= 5, "multipliers of the delayed equation")
            if (i == 1) then
               ! the real root by iteration of mu = exp(a/mu^k) with averaging
               mu = (1.3_wp, 0.0_wp)
               do j = 1, 200
                  mu = 0.5_wp*(mu + exp(rates(1)/mu**k))
               end do
               call expect_close(error, abs(found%values(1) - mu), 0.0_wp, 1.0e-9_wp, &
                                 "the growing disturbance")
               call expect(error, found%unstable() == 1, "one unstable multiplier")
            else
               call expect(error, abs(aimag(found%values(1))) > 0.1_wp, "an oscillation")
            end if
         end do
      end do
   end subroutine test_exact

   !> A small orbit about a stationary state has the multipliers exp(T s), s the roots of
   !> s = -(1 + rho) exp(-s pi/2).
   subroutine test_near_hopf(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(known_model) :: model
      type(multipliers_type) :: found
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      complex(wp) :: s
      real(wp), parameter :: rho = 1.0e-8_wp
      integer :: i

      model = known_model(delayed_sine, [rho])
      orbit = new_orbit(6, 20, 2.0_wp*pi, [rho])
      orbit%nodes = reshape(sqrt(rho)*sin(2.0_wp*pi*orbit%node_times()), [1, 121])
      call correct(model, orbit, newton, failure)
      call expect_success(error, failure)
      call multipliers_of(model, orbit, 5, found, error)
      if (allocated(error)) return
      call expect_close(error, abs(found%values(1)), 1.0_wp, 1.0e-6_wp, "the pair on the axis")
      ! the next root by Newton's method
      s = (-1.6_wp, 4.7_wp)
      do i = 1, 50
         s = s - (s + exp(-0.5_wp*pi*s))/(1.0_wp - 0.5_wp*pi*exp(-0.5_wp*pi*s))
      end do
      call expect_between(error, real(s), -3.0_wp, -0.5_wp, "real part of the next root")
      call expect_close(error, minval(abs(found%values - exp(2.0_wp*pi*s))), 0.0_wp, 1.0e-7_wp, &
                        "multiplier of the next root")
   end subroutine test_near_hopf

   !> ln |mu|/T of the paper's "torus", a cycle, is its second Lyapunov exponent.
   subroutine test_exponents(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: settings
      type(growth_type) :: measured
      type(multipliers_type) :: multipliers
      type(periodic_orbit_type) :: orbit
      type(model_type) :: block
      real(wp) :: exponents(4)

      block = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
      call cycle_of_block(block, 1500.0_wp, 5, 40, orbit, multipliers, error)
      if (allocated(error)) return
      call expect_close(error, multipliers%trivial_error, 0.0_wp, 1.0e-9_wp, "trivial multiplier")
      settings = growth_settings_type(exponents=4, t_begin=1000.0_wp, t_end=3000.0_wp, &
                                      t_turning=500.0_wp, interval=5.0_wp, blocks=10)
      call measure(error, block, settings, at_tolerance(1.0e-8_wp), measured)
      if (allocated(error)) return
      exponents = sum(measured%growth, dim=2)/sum(measured%length)
      call expect_close(error, log(abs(multipliers%values(1)))/orbit%period, exponents(2), &
                        5.0e-4_wp, "second exponent")
      call expect_close(error, log(abs(multipliers%values(2)))/orbit%period, &
                        0.5_wp*(exponents(3) + exponents(4)), 5.0e-4_wp, "third and fourth")
   end subroutine test_exponents

   !> Stable and unstable tori of rotating waves, with delay and with an uneven course of time.
   subroutine test_exact_coefficient(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      type(twin_waves_type) :: model
      real(wp), parameter :: p22(2) = [-2.5_wp, 1.5_wp], omega2(2) = [0.4_wp, 2.3_wp]
      real(wp) :: coefficient, disturbed(4), expected
      integer :: i, j, kind

      do kind = 1, 2
         model%delayed = kind == 1
         do i = 1, 2
            orbit = new_orbit(7, 32, turn/omega1, [p22(i), omega2(i)])
            associate (s => orbit%node_times())
               orbit%nodes = reshape([(on_cycle(turn*s(j)), j=1, size(s))], [4, size(s)])
            end associate
            call model%put(orbit%parameters)
            call correct(model, orbit, newton, failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            call find_torus_coefficient(fixed_model(model), orbit, &
                                        exp(cmplx(0.0_wp, turn*omega2(i)/omega1, kind=wp)), 6, &
                                        coefficient, disturbed, failure)
            call expect_success(error, failure)
            expected = model%coefficient()
            call expect_close(error, coefficient, expected, 2.0e-9_wp, "coefficient "//text(i))
            call expect(error, (expected < 0.0_wp) .eqv. i == 1, "one stable, one unstable torus")
            if (.not. model%delayed) cycle
            ! q = (kappa x2, 0, 1 + sigma kappa x2^2, -i) Re z2 along the cycle, where |x2| is 0, 1,
            ! 1/sqrt(2) and anything when the state is greatest
            associate (k => sigma*kappa)
               call expect_close(error, disturbed, [0.0_wp, 0.0_wp, 1.0_wp + 0.5_wp*k, 1.0_wp] &
                                 /sqrt(0.5_wp*kappa**2 + 2.0_wp + k + 0.375_wp*k**2), &
                                 1.0e-8_wp, "disturbance")
            end associate
         end do
      end do
   end subroutine test_exact_coefficient

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
end module test_floquet_multipliers
