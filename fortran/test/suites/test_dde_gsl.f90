!> The spring block without delay against GSL, which integrates the same equations in v.
module test_dde_gsl
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use block_builder, only: build_block
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, solve
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: collect_dde_gsl

   !> Parameters of both scenes.
   real(wp), parameter :: xi = 0.8_wp, gamma = 0.8_wp
   !> theta, u, v at t = 0.
   real(wp), parameter :: start(3) = [0.0_wp, 0.0_wp, 1.1_wp]
   !> Times at which both are compared.
   real(wp), parameter :: times(6) = [1.0_wp, 10.0_wp, 33.3_wp, 100.0_wp, 200.0_wp, 400.0_wp]

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

   !> All tests of this suite.
   subroutine collect_dde_gsl(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("damped", test_damped), &
                   new_unittest("limit cycle", test_limit_cycle)]
   end subroutine collect_dde_gsl

   !> Below the Hopf point the motion dies out.
   subroutine test_damped(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: states(3, size(times))

      call compare(error, 0.3_wp, 1.0e-11_wp, states)
      call expect_between(error, maxval(abs(states(:, 6) - [0.0_wp, 0.0_wp, 1.0_wp])), 0.0_wp, &
                          1.0e-2_wp, "distance to rest")
   end subroutine test_damped

   !> Above it there is a limit cycle, far from rest.
   subroutine test_limit_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: states(3, size(times))

      call compare(error, 0.5_wp, 1.0e-10_wp, states)
      call expect_between(error, norm2(states(:, 6) - [0.0_wp, 0.0_wp, 1.0_wp]), 0.5_wp, 10.0_wp, &
                          "distance to rest")
   end subroutine test_limit_cycle

   !> Compare theta, u and v at all times.
   subroutine compare(error, epsilon, within, states)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: epsilon, within
      !> GSL's states
      real(wp), intent(out) :: states(3, size(times))
      type(spring_block_type) :: block
      real(wp), allocatable :: ours(:, :)
      integer(c_int) :: status

      status = integrate_by_gsl(epsilon, xi, gamma, 1.0e-13_wp, start, size(times), times, states)
      call expect(error, status == 0, "GSL reaches the end")
      block = build_block(tau=0.0_wp, epsilon=epsilon, xi=xi, gamma=gamma, theta=start(1), &
                          u=start(2), v=start(3))
      call solve(block, times, at_tolerance(1.0e-13_wp), ours, error)
      call expect_close(error, ours(index_of_theta, :), states(1, :), within, "theta")
      call expect_close(error, ours(index_of_u, :), states(2, :), within, "u")
      call expect_close(error, exp(ours(index_of_ln_v, :)), states(3, :), within, "v")
   end subroutine compare
end module test_dde_gsl
