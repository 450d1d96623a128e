! SPDX-License-Identifier: BSD-3-Clause
!> The spring block against equation (4) written in v. tests/test_trajectory.py has its runs.
module test_spring_block
   use block_builder, only: build_block, index_of_ln_v, index_of_theta, index_of_u
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   implicit none (type, external)
   private
   public :: collect_spring_block

contains

   subroutine collect_spring_block(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("equation (4)", test_equation_4)]
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
end module test_spring_block
