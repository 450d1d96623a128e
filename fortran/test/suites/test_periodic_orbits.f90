! SPDX-License-Identifier: BSD-3-Clause
!> Single periodic orbits, against exact solutions and other discretisations.
module test_periodic_orbits
   use block_builder, only: build_block, index_of_ln_v, made
   use collocation_basis, only: collocation_basis_type
   use dde, only: continuation_type, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use floquet_multipliers, only: multipliers_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use orbit_equations, only: newton_type
   use orbit_mesh, only: adapted_mesh
   use orbit_runs, only: correct, cycle_of_block, new_orbit, sine_orbit
   use orbit_start, only: orbit_of_trajectory
   use periodic_orbit, only: periodic_orbit_type
   use solving, only: at_tolerance, run
   implicit none (type, external)
   private
   public :: collect_periodic_orbits

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_periodic_orbits(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("points and weights", test_points), &
                   new_unittest("order of an exact orbit", test_order), &
                   new_unittest("without delay", test_no_delay), &
                   new_unittest("stiff cycles on two meshes", test_two_meshes), &
                   new_unittest("adapted meshes", test_meshes), &
                   new_unittest("shorter cycles", test_shorter), &
                   new_unittest("refusals", test_refusals)]
   end subroutine collect_periodic_orbits

   !> The points integrate polynomials up to degree 2m - 2 exactly. The Lagrange polynomials
   !> reproduce polynomials and their slopes.
   subroutine test_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(collocation_basis_type) :: basis
      integer :: m, power

      do m = 2, 9
         basis = collocation_basis_type(m)
         do power = 0, 2*m - 2
            call expect_close(error, sum(basis%weight*basis%point**power), 1.0_wp/(power + 1), &
                              1.0e-14_wp, "integral of s^"//text(power))
         end do
         call expect(error, abs(sum(basis%weight*basis%point**(2*m - 1)) - 0.5_wp/m) > 1.0e-12_wp, &
                     "no higher degree")
         call expect_close(error, dot_product(basis%node**m, basis%values_at(0.3_wp)), 0.3_wp**m, &
                           1.0e-14_wp, "value")
         call expect_close(error, dot_product(basis%node**m, basis%slopes_at(0.3_wp)), &
                           m*0.3_wp**(m - 1), 1.0e-12_wp, "slope")
         call expect_close(error, dot_product(basis%node**m, basis%leading), 1.0_wp, 1.0e-8_wp, &
                           "leading coefficient of degree "//text(m))
      end do
   end subroutine test_points

   !> The orbit sqrt(rho) sin t from a disturbed one: the error of the state is of order m + 1 where
   !> the delay does not fall on the mesh. The phase is that of the nearest sine.
   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      real(wp) :: off(2), part(2), period_off(2), state(1)
      integer, parameter :: intervals(2) = [9, 19], places = 1000
      integer :: i, j, m

      do m = 3, 5
         do i = 1, 2
            orbit = sine_orbit(m, intervals(i), 0.51_wp, 6.3_wp, [-0.75_wp, -1.0_wp, 0.0_wp])
            call correct(made("made_circle", orbit%parameters, [1.0_wp]), orbit, newton, failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect(error, newton%iterations <= 5, "Newton's method is fast")
            period_off(i) = abs(orbit%period - 2.0_wp*pi)
            part = 0.0_wp
            do j = 1, places
               state = orbit%at(real(j, wp)/places)
               part = part + state(1)*[sin(2.0_wp*pi*j/places), cos(2.0_wp*pi*j/places)]
            end do
            off(i) = maxval(abs(orbit%nodes(1, :) - 0.5_wp*sin( &
                                2.0_wp*pi*orbit%node_times() + atan2(part(2), part(1)))))
         end do
         call expect_between(error, log(off(1)/off(2))/log(19.0_wp/9), m + 0.6_wp, m + 2.0_wp, &
                             "order of the state, degree "//text(m))
         call expect_between(error, log(period_off(1)/period_off(2))/log(19.0_wp/9), &
                             m + 0.6_wp, 2*m + 1.5_wp, "order of the period, degree "//text(m))
      end do
   end subroutine test_order

   !> Without delay the product of all multipliers is exp(integral of the divergence) (Liouville).
   subroutine test_no_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(multipliers_type) :: multipliers
      type(periodic_orbit_type) :: orbit
      type(model_type) :: block
      real(wp) :: by_y(3, 3), by_z(3, 0), divergence, y(3), z(0)
      integer :: i, k, l

      block = build_block(tau=0.0_wp, epsilon=0.6_wp, xi=0.5_wp, gamma=0.8_wp, v=1.1_wp)
      call cycle_of_block(block, 500.0_wp, 6, 40, orbit, multipliers, error)
      if (allocated(error)) return
      call expect(error, size(multipliers%values) == 2, "two multipliers beside the trivial one")
      divergence = 0.0_wp
      do i = 1, orbit%intervals()
         associate (h => orbit%mesh(i + 1) - orbit%mesh(i), basis => orbit%basis)
            do k = 1, basis%degree
               y = orbit%at(orbit%mesh(i) + h*basis%point(k))
               call block%jacobian(0.0_wp, y, z, by_y, by_z)
               divergence = divergence + h*basis%weight(k)*orbit%period*sum([(by_y(l, l), l=1, 3)])
            end do
         end associate
      end do
      call expect_close(error, abs(product(multipliers%values)), exp(divergence), &
                        1.0e-8_wp, "product of the multipliers")
      call expect(error, multipliers%unstable() == 0, "a stable cycle")
   end subroutine test_no_delay

   !> A relaxation cycle with v over four decades, and the gamma of stiff faults, where a component
   !> is in balance: two meshes of different degrees give the same cycle.
   subroutine test_two_meshes(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: range(2)
      type(periodic_orbit_type) :: orbit

      call check(build_block(tau=0.1_wp, epsilon=2.0_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp), &
                 400.0_wp, [120, 150], 1.0e-3_wp, 1.0e-7_wp)
      if (allocated(error)) return
      range = orbit%range_of(index_of_ln_v)
      call expect(error, range(2) - range(1) > log(1.0e4_wp), "four decades of v")
      call check(build_block(tau=1.0_wp, epsilon=0.9_wp, xi=0.5_wp, gamma=1.0e6_wp, v=1.1_wp), &
                 1000.0_wp, [40, 41], 1.0e-8_wp, 1.0e-8_wp)

   contains

      !> Periods on both meshes.
      subroutine check(block, t_end, intervals, trivial_error, within)
         type(model_type), intent(in) :: block
         real(wp), intent(in) :: t_end, trivial_error, within
         integer, intent(in) :: intervals(2)
         type(multipliers_type) :: multipliers
         type(periodic_orbit_type) :: other

         call cycle_of_block(block, t_end, 6, intervals(1), orbit, multipliers, error)
         if (allocated(error)) return
         call expect_close(error, multipliers%trivial_error, 0.0_wp, trivial_error, &
                           "trivial multiplier")
         call cycle_of_block(block, t_end, 7, intervals(2), other, multipliers, error)
         call expect_close(error, orbit%period, other%period, within, "period")
      end subroutine check
   end subroutine test_two_meshes

   !> An adapted mesh follows a front, and its orbit has the same values.
   subroutine test_meshes(error)
      type(error_type), allocatable, intent(out) :: error
      type(periodic_orbit_type) :: moved, orbit
      real(wp) :: mesh(31), place, state(1)
      integer :: interval

      orbit = new_orbit(5, 200, 1.0_wp, [0.0_wp])
      orbit%nodes = reshape(tanh(100.0_wp*(orbit%node_times() - 0.3_wp)) &
                            - tanh(100.0_wp*(orbit%node_times() - 0.7_wp)), [1, 1001])
      mesh = adapted_mesh(orbit, 30)
      call expect(error, all(mesh(2:) > mesh(:30)), "an ascending mesh")
      call expect_close(error, mesh([1, 31]), [0.0_wp, 1.0_wp], 0.0_wp, "ends")
      call expect(error, count(abs(mesh - 0.3_wp) < 0.05_wp) >= 10, "intervals in the first front")
      call expect(error, count(abs(mesh - 0.7_wp) < 0.05_wp) >= 10, "intervals in the second front")
      moved = orbit%on_mesh(mesh)
      state = moved%at(0.31_wp)
      call expect_close(error, state(1), tanh(1.0_wp) - tanh(-39.0_wp), 1.0e-3_wp, "value there")
      call moved%locate(1.0_wp, interval, place)
      call expect(error, interval == 30, "the last interval")
      call expect_close(error, orbit%range_of(1), [0.0_wp, 2.0_wp*tanh(20.0_wp)], 1.0e-10_wp, &
                        "range")
   end subroutine test_meshes

   !> A cycle of a third of the period plus a small part of the whole period: with the part
   !> negative, or shifted by a sixth of the period, it lies on the other side of the short cycle.
   subroutine test_shorter(error)
      type(error_type), allocatable, intent(out) :: error
      type(periodic_orbit_type) :: large, small

      large = wave(0.3_wp, 0.0_wp)
      small = wave(0.01_wp, 0.0_wp)
      call expect(error, large%opposite_parts(small) == 0, "on one side")
      large = wave(-0.01_wp, 0.0_wp)
      call expect(error, large%opposite_parts(small) == 3, "opposite beside thirds")
      large = wave(0.01_wp, 1.0_wp/6)
      call expect(error, large%opposite_parts(small) == 3, "shifted beside thirds")
      large = wave(0.3_wp, 0.0_wp)
      call expect(error, small%comes_to_shorter(large), "towards the short cycle")
      call expect(error, .not. large%comes_to_shorter(small), "away from it")
      call expect(error, .not. large%comes_to_shorter(large), "far from it")
   end subroutine test_shorter

   !> cos(6 pi s) + a cos(2 pi (s + shift)).
   type(periodic_orbit_type) function wave(a, shift) result(orbit)
      !> The part of the whole period, and its shift
      real(wp), intent(in) :: a, shift

      orbit = new_orbit(5, 30, 1.0_wp, [0.0_wp])
      associate (s => orbit%node_times())
         orbit%nodes = reshape(cos(6.0_wp*pi*s) + a*cos(2.0_wp*pi*(s + shift)), [1, size(s)])
      end associate
   end function wave

   !> What is no orbit is refused.
   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: arrived
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(newton_type) :: newton
      type(periodic_orbit_type) :: orbit
      type(model_type) :: block

      orbit = sine_orbit(4, 10, 1.0_wp, 6.0_wp, [-1.5_wp, -1.0_wp, 0.0_wp])
      newton%most_iterations = 4
      call correct(made("made_circle", orbit%parameters, [1.0_wp]), orbit, newton, failure)
      call expect_failure(error, failure, "Newton's method")
      block = build_block(tau=0.0_wp, epsilon=0.1_wp, xi=0.5_wp, gamma=0.8_wp, v=1.1_wp)
      call run(error, block, 0.0_wp, 10.0_wp, at_tolerance(1.0e-8_wp), outcome, &
               continuation=arrived)
      call orbit_of_trajectory(block, at_tolerance(1.0e-9_wp), arrived, index_of_ln_v, 1.0_wp, &
                               collocation_basis_type(4), 10, orbit, failure)
      call expect_failure(error, failure, "maxima")
   end subroutine test_refusals
end module test_periodic_orbits
