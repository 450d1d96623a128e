!> The spring block against equations (3) and (4) written in v; its series against its right-hand
!> side; runs without delay against GSL.
module test_spring_block
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use block_builder, only: build_block, index_of_ln_v, index_of_theta, index_of_u
   use dde_errors, only: text
   use dde_interpolant, only: series_value
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   use solving, only: at_tolerance, solve
   implicit none (type, external)
   private
   public :: collect_spring_block

   interface
      integer(c_int) function integrate_by_gsl(epsilon, xi, gamma, tolerance, start, n, time, &
                                               states) result(status) bind(c)
         import :: c_double, c_int
         implicit none (type, external)
         real(c_double), value :: epsilon, xi, gamma, tolerance
         real(c_double), intent(in) :: start(3)
         integer(c_int), value :: n
         real(c_double), intent(in) :: time(n)
         real(c_double), intent(out) :: states(3, n)
      end function integrate_by_gsl
   end interface

contains

   subroutine collect_spring_block(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("equation (4)", test_equation_4), &
                   new_unittest("series of the block", test_taylor_series), &
                   new_unittest("slow series of the block", test_slow_series), &
                   new_unittest("runs by GSL", test_gsl)]
   end subroutine collect_spring_block

   !> With a delay, at random states and parameters; dw/dt = (dv/dt)/v.
   subroutine test_equation_4(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: block
      real(wp) :: delayed_v, dydt(3), x(8)
      integer :: i

      do i = 1, 50
         x = uniform(i, 8, 0.05_wp, 3.0_wp)
         x(5:6) = x(5:6) - 1.5_wp
         associate (epsilon => x(1), xi => x(2), gamma => x(3), v => x(4), theta => x(5), u => x(6))
            delayed_v = x(7)
            block = build_block(tau=10.0_wp, epsilon=epsilon, xi=xi, gamma=gamma)
            call block%rhs(x(8), [theta, u, log(v)], [log(delayed_v)], dydt)
            call expect_close(error, dydt(index_of_theta), &
                              -v*(theta + (1.0_wp + epsilon)*log(delayed_v)), 1.0e-12_wp, &
                              "dtheta/dt of state "//text(i))
            call expect_close(error, dydt(index_of_u), v - 1.0_wp, 1.0e-14_wp, &
                              "du/dt of state "//text(i))
            call expect_close(error, v*dydt(index_of_ln_v), &
                              -gamma**2*(u + (theta + log(v))/xi), 1.0e-11_wp, &
                              "dv/dt of state "//text(i))
         end associate
      end do
   end subroutine test_equation_4

   !> The series of the block, with a delayed value that is a polynomial, solves its equations: its
   !> derivative is the right-hand side, but for what follows the last term.
   subroutine test_taylor_series(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 20
      real(wp), parameter :: gamma(4) = [0.05_wp, 0.8_wp, 3.0_wp, 20.0_wp], s = 0.5_wp
      real(wp), parameter :: w(4) = [0.7_wp, -1.0_wp, 0.1_wp, 1.5_wp]
      type(model_type) :: problem
      real(wp) :: coefficient(0:degree, 3), found(3), rises(0:degree - 1, 3), slope(3), unit
      real(wp), allocatable :: delayed(:, :)
      integer :: delays, i, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.3_wp*i, xi=0.4_wp + 0.2_wp*i, &
                                  gamma=gamma(i), v=1.1_wp)
            allocate (delayed(0:degree, delays), source=0.0_wp)
            if (delays > 0) delayed(:3, 1) = [0.2_wp, -0.1_wp, 0.03_wp, 0.01_wp]
            coefficient = 0.0_wp
            coefficient(0, :) = [0.4_wp, -0.3_wp, w(i)]
            unit = 0.1_wp/max(1.0_wp, gamma(i)**2)
            call problem%series(0.0_wp, unit, degree, delayed, coefficient)
            call problem%rhs(0.0_wp, polynomial(coefficient, s), polynomial(delayed, s), slope)
            rises = spread([(real(k, wp), k=1, degree)], 2, 3)*coefficient(1:, :)
            found = polynomial(rises, s)/unit
            call expect_close(error, found/maxval(abs(slope)), slope/maxval(abs(slope)), &
                              1.0e-13_wp, "slope for gamma = "//text(gamma(i)))
            deallocate (delayed)
         end do
      end do
   end subroutine test_taylor_series

   !> Polynomials at s.
   pure function polynomial(coefficient, s) result(value)
      real(wp), intent(in) :: coefficient(0:, :), s
      real(wp) :: value(size(coefficient, 2))
      integer :: k

      value = 0.0_wp
      do k = ubound(coefficient, 1), 0, -1
         value = coefficient(k, :) + s*value
      end do
   end function polynomial

   !> Iterated from a state, the slow series of the block balances w, with theta and u by (4).
   subroutine test_slow_series(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 14
      real(wp), parameter :: gamma(3) = [1.0e3_wp, 1.0e6_wp, 1.0e12_wp], s = 0.7_wp
      type(model_type) :: problem
      real(wp) :: found(3), rises(0:degree - 1, 3), slope(3), state(3), v, y(0:degree, 3)
      real(wp), allocatable :: z(:, :)
      real(wp), parameter :: unit = 0.05_wp
      integer :: delays, i, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.6_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            allocate (z(0:degree, delays), source=0.0_wp)
            if (delays > 0) z(:3, 1) = [0.2_wp, -0.1_wp, 0.03_wp, 0.01_wp]
            y = 0.0_wp
            y(0, :) = [0.4_wp, -0.3_wp, 5.0_wp]
            do k = 1, 4
               call problem%slow_series(0.0_wp, unit, degree, z, y)
            end do
            state = [(series_value(degree, y(:, k), s), k=1, 3)]
            rises = spread([(k, k=1, degree)], 2, 3)*y(1:, :)
            found = [(series_value(degree - 1, rises(:, k), s), k=1, 3)]/unit
            v = exp(state(3))
            call problem%rhs(0.0_wp, state, [(series_value(degree, z(:, k), s), k=1, delays)], &
                             slope)
            call expect_close(error, found(:2), slope(:2), 1.0e-12_wp, "theta and u")
            call expect_close(error, state(3), -state(1) - 0.5_wp*state(2) &
                              - 0.5_wp/gamma(i)**2*v*found(3), 1.0e-14_wp, &
                              "balance at gamma = "//text(gamma(i)))
            deallocate (z)
         end do
      end do
   end subroutine test_slow_series

   !> theta, u and v by GSL, which integrates the same equations in v. Below the Hopf point the
   !> motion dies out, above it there is a limit cycle, far from rest.
   subroutine test_gsl(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: epsilon(2) = [0.3_wp, 0.5_wp], within(2) = [1.0e-11_wp, 1.0e-10_wp]
      real(wp), parameter :: xi = 0.8_wp, gamma = 0.8_wp, start(3) = [0.0_wp, 0.0_wp, 1.1_wp]
      real(wp), parameter :: times(6) = [1.0_wp, 10.0_wp, 33.3_wp, 100.0_wp, 200.0_wp, 400.0_wp]
      real(wp), parameter :: nearest(2) = [0.0_wp, 0.5_wp], farthest(2) = [1.0e-2_wp, 10.0_wp]
      real(wp), allocatable :: ours(:, :)
      real(wp) :: states(3, size(times))
      integer :: i

      do i = 1, 2
         call expect(error, integrate_by_gsl(epsilon(i), xi, gamma, 1.0e-13_wp, start, &
                                             size(times), times, states) == 0, "GSL ends")
         call solve(build_block(0.0_wp, epsilon(i), xi, gamma, v=start(3)), times, &
                    at_tolerance(1.0e-13_wp), ours, error)
         call expect_close(error, ours(index_of_theta, :), states(1, :), within(i), "theta")
         call expect_close(error, ours(index_of_u, :), states(2, :), within(i), "u")
         call expect_close(error, exp(ours(index_of_ln_v, :)), states(3, :), within(i), "v")
         call expect_between(error, norm2(states(:, 6) - [0.0_wp, 0.0_wp, 1.0_wp]), nearest(i), &
                             farthest(i), "distance to rest")
      end do
   end subroutine test_gsl
end module test_spring_block
