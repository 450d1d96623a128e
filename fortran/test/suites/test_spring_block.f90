! SPDX-License-Identifier: BSD-3-Clause
!> The spring block against equations (3) and (4) written in v, and runs without delay against GSL.
module test_spring_block
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use block_builder, only: build_block, index_of_ln_v, index_of_theta, index_of_u
   use dde_errors, only: text
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
