!> The spring block against equations (3) and (4) written in v.
module test_spring_block
   use block_builder, only: build_block
   use dde_errors, only: text
   use expectations, only: expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: collect_spring_block

contains

   !> All tests of this suite.
   subroutine collect_spring_block(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("equation (4)", test_equation_4), &
                   new_unittest("equation (3)", test_equation_3), &
                   new_unittest("rest", test_steady_sliding)]
   end subroutine collect_spring_block

   !> With a delay, at random states and parameters; dw/dt = (dv/dt)/v.
   subroutine test_equation_4(error)
      type(error_type), allocatable, intent(out) :: error
      type(spring_block_type) :: block
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

   !> Without one, the velocity itself takes the place of the delayed one.
   subroutine test_equation_3(error)
      type(error_type), allocatable, intent(out) :: error
      type(spring_block_type) :: block
      real(wp) :: dydt(3)

      block = build_block(tau=0.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=2.0_wp)
      call block%rhs(0.0_wp, [0.3_wp, -0.2_wp, log(2.0_wp)], [real(wp) ::], dydt)
      call expect_close(error, dydt(index_of_theta), -0.6_wp - 3.0_wp*log(2.0_wp), 1.0e-15_wp, &
                        "dtheta/dt")
      call expect_close(error, dydt(index_of_u), 1.0_wp, 1.0e-15_wp, "du/dt")
      call expect_close(error, 2.0_wp*dydt(index_of_ln_v), &
                        0.8_wp - 5.0_wp*(0.3_wp + log(2.0_wp)), 1.0e-14_wp, "dv/dt")
   end subroutine test_equation_3

   !> At theta = 0, u = 0, v = 1 nothing moves, with and without delay.
   subroutine test_steady_sliding(error)
      type(error_type), allocatable, intent(out) :: error
      type(spring_block_type) :: block
      real(wp) :: dydt(3), y(3)

      block = build_block(tau=0.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=1.0e6_wp)
      call block%initial(y)
      call block%rhs(0.0_wp, y, [real(wp) ::], dydt)
      call expect_close(error, dydt, [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "derivatives")
      block = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=1.0e6_wp)
      call block%rhs(0.0_wp, y, [block%history(-10.0_wp, index_of_ln_v)], dydt)
      call expect_close(error, dydt, [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "derivatives")
   end subroutine test_steady_sliding
end module test_spring_block
