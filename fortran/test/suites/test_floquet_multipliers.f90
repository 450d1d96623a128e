! SPDX-License-Identifier: BSD-3-Clause
!> Floquet multipliers against exact ones, characteristic roots and Lyapunov exponents, also those
!> of modes along cycles; the normal form of torus points against an exact one.
module test_floquet_multipliers
   use block_builder, only: block_at, build_block, made, paper_law
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use exponent_runs, only: measure
   use floquet_multipliers, only: multipliers_type
   use lyapunov_spectrum, only: growth_settings_type, growth_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_family, only: fixed_model
   use model_problem, only: model_type
   use model_roots, only: find_model_roots
   use orbit_equations, only: newton_type
   use orbit_runs, only: correct, cycle_of_block, multipliers_of, new_orbit
   use periodic_orbit, only: periodic_orbit_type
   use solving, only: at_tolerance
   use special_points, only: fold, special_point_type, torus_bifurcation
   use torus_normal_form, only: find_torus_coefficient
   use transverse_growth, only: find_zeros, measure_transverse_growth, of_mode, &
                                transverse_growth_type, zero_type
   use transverse_multipliers, only: find_transverse_cycle, transverse_cycle_type
   implicit none (type, external)
   private
   public :: collect_floquet_multipliers

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Rotating waves (made_waves): the shears, the frequency of the cycle, the delay, coefficients.
   real(wp), parameter :: kappa = 0.6_wp, sigma = 0.7_wp, omega1 = 1.3_wp, lag = 2.1_wp
   complex(wp), parameter :: p11 = (-0.8_wp, 0.3_wp), p12 = (-0.5_wp, 0.7_wp), &
                             p21 = (-0.4_wp, -0.6_wp), both_k(2) = [(0.3_wp, 0.2_wp), &
                                                                    (-0.25_wp, 0.1_wp)]
   real(wp), parameter :: b = 0.4_wp, c = 0.5_wp
   !> tau, epsilon, xi and gamma: the paper's torus, a cycle; chaos; steady sliding.
   real(wp), parameter :: cycle_place(4) = [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], &
                          chaos_place(4) = [7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp], &
                          rest_place(4) = [7.0_wp, 0.1_wp, 0.5_wp, 0.8_wp]

contains

   subroutine collect_floquet_multipliers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exact multipliers, delays of one and two periods", test_exact), &
                   new_unittest("multipliers and exponents", test_exponents), &
                   new_unittest("exact coefficients", test_exact_coefficient), &
                   new_unittest("criticality", test_criticality), &
                   new_unittest("modes about rest are blocks", test_modes_at_rest), &
                   new_unittest("multipliers and exponents of modes", test_modes), &
                   new_unittest("motions that are no cycle", test_no_cycle)]
   end subroutine collect_floquet_multipliers

   !> Where the delay is k periods, x(t - k) = x(t)/mu^k: the multipliers solve mu = exp(a/mu^k),
   !> and exp(-2) is that of the circle. Both signs of a: a growing and an oscillating disturbance.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(model_type) :: model
      type(multipliers_type) :: found
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      real(wp), parameter :: rates(2) = [0.5_wp, -1.8_wp]
      real(wp) :: times(20*6 + 1)
      complex(wp) :: mu
      integer :: i, j, k

      do k = 1, 2
         do i = 1, 2
            orbit = new_orbit(6, 20, 1.0_wp, [rates(i), 0.7_wp, real(k, wp)])
            times = turn*orbit%node_times()
            orbit%nodes = transpose(reshape([cos(times), sin(times), 0.0_wp*times], &
                                            [size(times), 3]))
            model = made("made_driven", orbit%parameters, [1.0_wp, 0.0_wp, 0.0_wp])
            call correct(model, orbit, newton, failure)
            call expect_success(error, failure)
            call multipliers_of(model, orbit, 6, found, error)
            if (allocated(error)) return
            call expect_close(error, orbit%period, 1.0_wp, 1.0e-12_wp, "period")
            call expect_close(error, found%trivial_error, 0.0_wp, 1.0e-9_wp, "trivial multiplier")
            associate (others => pack(found%values, abs(found%values - exp(-2.0_wp)) > 1.0e-8_wp))
               call expect_close(error, abs(exp(rates(i)/others**k) - others), &
                                 0.0_wp*abs(others), 2.0e-8_wp, "multipliers of " &
                                 //text(k)//" periods")
               call expect(error, size(others) >= 5, "multipliers of the delayed equation")
            end associate
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

   !> ln |mu|/T of the paper's "torus", a cycle, are its Lyapunov exponents but for that of the
   !> flow, by methods with series, with equations alone and with derivatives.
   subroutine test_exponents(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=8), parameter :: methods(3) = ["taylor  ", "dop853  ", "radau13 "]
      type(growth_type) :: measured
      type(multipliers_type) :: multipliers
      type(periodic_orbit_type) :: orbit
      type(model_type) :: block
      real(wp) :: exponents(4)
      integer :: i

      block = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
      call cycle_of_block(block, 1500.0_wp, 5, 40, orbit, multipliers, error)
      if (allocated(error)) return
      call expect_close(error, multipliers%trivial_error, 0.0_wp, 1.0e-9_wp, "trivial multiplier")
      do i = 1, size(methods)
         call measure(error, block, &
                      growth_settings_type(exponents=4, t_begin=1000.0_wp, t_end=3000.0_wp, &
                                           t_turning=500.0_wp, interval=5.0_wp, batches=10), &
                      at_tolerance(1.0e-8_wp, methods(i)), measured)
         if (allocated(error)) return
         exponents = sum(measured%growth, dim=2)/sum(measured%length)
         call expect_close(error, [exponents(2), 0.5_wp*sum(exponents(3:))], &
                           log(abs(multipliers%values(:2)))/orbit%period, 5.0e-4_wp, &
                           "second, third and fourth by "//methods(i))
      end do
   end subroutine test_exponents

   !> Stable and unstable tori of rotating waves, with delay or with an uneven course of time. The
   !> cycle |z1| = 1, z2 = 0 has frequency omega1, and z2 neither grows nor decays, with omega2.
   subroutine test_exact_coefficient(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      type(model_type) :: model
      complex(wp), parameter :: p22(2) = [(-2.5_wp, 0.4_wp), (1.5_wp, 0.4_wp)]
      real(wp), parameter :: omega2(2) = [0.4_wp, 2.3_wp]
      complex(wp) :: alpha(2), k(2)
      real(wp) :: angle(32*7 + 1), coefficient, disturbed(4), expected, uneven(2)
      integer :: i, j, kind

      do kind = 1, 2
         k = merge(both_k, (0.0_wp, 0.0_wp), kind == 1)
         uneven = merge(0.0_wp, [b, c], kind == 1)
         do i = 1, 2
            associate (pairs => cmplx(0.0_wp, [omega1, omega2(i)], kind=wp))
               alpha = pairs - [p11, p21] - k*exp(-lag*pairs)
            end associate
            orbit = new_orbit(7, 32, turn/omega1, [lag, uneven, kappa, sigma, &
                              ([real(alpha(j)), aimag(alpha(j))], j=1, 2), &
                              real(p11), aimag(p11), real(p21), aimag(p21), &
                              real(p12), aimag(p12), real(p22(i)), aimag(p22(i)), &
                              ([real(k(j)), aimag(k(j))], j=1, 2), spread(0.0_wp, 1, 4)])
            angle = turn*orbit%node_times()
            orbit%nodes = transpose(reshape([cos(angle), sin(angle), sigma*cos(angle)*sin(angle), &
                                             sin(angle)], [size(angle), 4]))
            model = made("made_waves", orbit%parameters, orbit%nodes(:, 1))
            call correct(model, orbit, newton, failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            call find_torus_coefficient(fixed_model(model), orbit, &
                                        exp(cmplx(0.0_wp, turn*omega2(i)/omega1, kind=wp)), 6, &
                                        coefficient, disturbed, failure)
            call expect_success(error, failure)
            expected = coefficient_of_waves(p22(i), omega2(i), k, uneven)
            call expect_close(error, coefficient, expected, 2.0e-9_wp, "coefficient "//text(i))
            call expect(error, (expected < 0.0_wp) .eqv. i == 1, "one stable, one unstable torus")
            if (kind == 2) cycle
            ! q = (kappa x2, 0, 1 + sigma kappa x2^2, -i) Re z2 along the cycle, where |x2| is 0, 1,
            ! 1/sqrt(2) and anything when the state is greatest
            associate (s => sigma*kappa)
               call expect_close(error, disturbed, [0.0_wp, 0.0_wp, 1.0_wp + 0.5_wp*s, 1.0_wp] &
                                 /sqrt(0.5_wp*kappa**2 + 2.0_wp + s + 0.375_wp*s**2), &
                                 1.0e-8_wp, "disturbance")
            end associate
         end do
      end do
   end subroutine test_exact_coefficient

   !> Re d/T. While |z2|^2 = S is almost constant, so are R = |z1|^2 and the frequencies:
   !>
   !>     i omega1 = alpha1 + p11 R + p12 S + k1 exp(-i omega1 lag),
   !>     lambda   = alpha2 + p21 R + p22 S + k2 exp(-lambda lag)
   !>
   !> with the growth lambda of z2. Its derivative by S is d/T for z = z2; the mean of w is 1. It is
   !> divided by the mean of |q|^2 for this z.
   pure real(wp) function coefficient_of_waves(p22, omega2, k, uneven) result(value)
      complex(wp), intent(in) :: p22, k(2)
      real(wp), intent(in) :: omega2, uneven(2)
      integer, parameter :: places = 400
      complex(wp) :: by_lambda, by_omega, change(2), wave
      real(wp) :: q(4), r_slope, square, w
      integer :: i, part

      ! i omega1' (1 + k1 lag exp(-i omega1 lag)) - p11 R' = p12, by Cramer's rule
      by_omega = (0.0_wp, 1.0_wp)*(1.0_wp + lag*k(1)*exp(cmplx(0.0_wp, -lag*omega1, kind=wp)))
      r_slope = -aimag(conjg(by_omega)*p12)/aimag(conjg(by_omega)*p11)
      by_lambda = 1.0_wp + lag*k(2)*exp(cmplx(0.0_wp, -lag*omega2, kind=wp))
      square = 0.0_wp
      do i = 1, places
         wave = exp(cmplx(0.0_wp, turn*i/places, kind=wp))
         w = 1.0_wp + uneven(1)*real(wave)
         do part = 1, 2
            ! real and imaginary part of q: z = 1/2 and -i/2; later by the integral of c Re z2
            change(2) = 0.5_wp*(0.0_wp, -1.0_wp)**(part - 1)
            change(1) = -(0.0_wp, omega1)*wave/w*uneven(2)*aimag(change(2))/omega2
            ! the shears, to first order in z2
            q(1) = real(change(1)) + kappa*real(change(2))*aimag(wave)
            q(2) = aimag(change(1))
            q(3) = real(change(2)) + sigma*(q(1)*aimag(wave) + real(wave)*q(2))
            q(4) = aimag(change(2)) + q(2)
            square = square + w/places*sum(q**2)
         end do
      end do
      value = real((p21*r_slope + p22)/by_lambda)/square
   end function coefficient_of_waves

   !> It is the sign of the coefficient where that is certain and no strong resonance is near.
   subroutine test_criticality(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: coefficients(5) = [-0.1_wp, 0.1_wp, 0.1_wp, 0.1_wp, 0.1_wp], &
                             errors(5) = [1.0e-6_wp, 1.0e-6_wp, 0.05_wp, 1.0e-6_wp, 1.0e-6_wp], &
                             angles(5) = [0.22_wp, 0.22_wp, 0.22_wp, 1.0_wp/3, 0.2_wp]
      character(len=14), parameter :: words(5) = [ &
         "supercritical ", "subcritical   ", "not determined", "not determined", "subcritical   "]
      type(special_point_type) :: point
      integer :: i

      point%kind = fold
      call expect(error, point%criticality() == "", "none of a fold")
      point%kind = torus_bifurcation
      point%multiplier = exp(cmplx(0.0_wp, 0.22_wp*turn, kind=wp))
      point%coefficient = -0.1_wp
      call expect(error, point%criticality() == "not determined", "found on one mesh only")
      do i = 1, 5
         point%coefficient = coefficients(i)
         point%coefficient_error = errors(i)
         point%multiplier = exp(cmplx(0.0_wp, angles(i)*turn, kind=wp))
         call expect(error, point%criticality() == words(i), words(i)//" at "//text(angles(i)))
      end do
   end subroutine test_criticality

   !> A chain of one block with kappa = 1.
   type(model_type) function chain_at(place, keep_delays) result(model)
      real(wp), intent(in) :: place(4)
      logical, intent(in), optional :: keep_delays

      model = build_block(place(1), place(2), place(3), place(4), v=1.1_wp, &
                          law="chain_"//paper_law, own=[1.0_wp], keep_delays=keep_delays)
   end function chain_at

   !> About rest a mode is a block at gamma sqrt(s) and xi s: the exponent of a cycle that rests is
   !> the real part of the rightmost root there.
   subroutine test_modes_at_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(model_type) :: chain
      type(multipliers_type) :: found
      type(periodic_orbit_type) :: orbit
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: delays(3) = [7.0_wp, 2.0_wp, 0.0_wp], &
                             stiffness(3) = [1.0_wp, 1.3_wp, 5.0_wp], period = 6.0_wp
      integer :: i, j

      do i = 1, size(delays)
         chain = chain_at([delays(i), chaos_place(2:)], keep_delays=.true.)
         orbit = new_orbit(6, 30, period, chain%numbers)
         allocate (orbit%nodes(3, 30*6 + 1), source=0.0_wp)
         do j = 1, size(stiffness)
            associate (s => stiffness(j), p => chain%numbers)
               call multipliers_of(of_mode(chain, s), orbit, 0, found, error)
               if (allocated(error)) return
               call find_model_roots(block_at([p(1), p(2), s*p(3), sqrt(s)*p(4)]), -0.5_wp, roots, &
                                     failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, log(found%greatest)/period, real(roots(1)), 1.0e-9_wp, &
                                 "exponent")
            end associate
         end do
      end do
   end subroutine test_modes_at_rest

   !> The exponents and their zero are those measured along the motion.
   subroutine test_modes(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(transverse_cycle_type) :: found
      type(transverse_growth_type), allocatable :: growth(:)
      type(zero_type), allocatable :: zeros(:)
      real(wp), parameter :: s(3) = [1.0_wp, 1.2_wp, 2.0_wp]
      integer :: i

      settings = growth_settings_type(t_begin=1000.0_wp, t_end=3000.0_wp, t_turning=300.0_wp, &
                                      interval=20.0_wp, batches=10)
      call measure_transverse_growth(chain_at(cycle_place), s, settings, at_tolerance(1.0e-8_wp), &
                                     growth, failure)
      call expect_success(error, failure)
      call find_zeros(chain_at(cycle_place), settings, at_tolerance(1.0e-8_wp), growth, zeros, &
                      failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_transverse_cycle(chain_at(cycle_place), 2000.0_wp, at_tolerance(1.0e-8_wp), s, &
                                 found)
      call expect(error, found%reason == "", "a cycle: "//found%reason)
      if (allocated(error)) return
      call expect(error, abs(found%growth(1)%value) <= 0.0_wp, "the flow at s = 1")
      call expect_close(error, found%growth%s, s, 0.0_wp, "s")
      do i = 1, size(s)
         call expect_close(error, found%growth(i)%value, growth(i)%value, 3.0_wp*growth(i)%error, &
                           "exponent")
      end do
      call expect_close(error, growth%error, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-3_wp, "their errors")
      call expect_close(error, found%growth%error, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-10_wp, "meshes")
      call expect(error, size(found%zeros) == 1 .and. size(zeros) == 1, "one zero each")
      if (allocated(error)) return
      call expect_close(error, found%zeros(1)%s, zeros(1)%s, 3.0_wp*zeros(1)%error, "zero")
      call expect(error, zeros(1)%error < 1.0e-3_wp, "accuracy of the zero")
      call expect(error, .not. (found%zeros(1)%rises .or. zeros(1)%rises), "its direction")
   end subroutine test_modes

   !> They have no exponents, and the reason is given.
   subroutine test_no_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      type(transverse_cycle_type) :: found
      real(wp), parameter :: places(4, 2) = reshape([chaos_place, rest_place], [4, 2])
      integer :: i

      do i = 1, 2
         call find_transverse_cycle(chain_at(places(:, i)), 600.0_wp, at_tolerance(1.0e-8_wp), &
                                    [1.0_wp, 2.0_wp], found)
         call expect(error, found%reason /= "" .and. size(found%growth) == 0 &
                     .and. size(found%zeros) == 0, "no cycle")
      end do
   end subroutine test_no_cycle
end module test_floquet_multipliers
