!> Response of friction to velocity steps against the exact solution of (1.2),
!> theta = Dc/v + (theta_0 - Dc/v) exp(-v t/Dc), with (1.1).
module test_velocity_step
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect_close, expect_success
   use velocity_step_friction, only: friction_coefficient, friction_parameters_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use velocity_step, only: friction_response_type, respond, step_protocol_type
   implicit none (type, external)
   private
   public :: collect_velocity_step

   !> Samples in each phase.
   integer, parameter :: n = 50
   !> The law of Figure 8.
   type(friction_parameters_type), parameter :: law = &
      friction_parameters_type(mu0=0.6_wp, a=0.01_wp, b=0.015_wp, dc=1.0e-5_wp, v0=1.0e-6_wp, &
                               b_state=10.0_wp)

contains

   subroutine collect_velocity_step(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("friction coefficient", test_coefficient), &
                   new_unittest("exact response", test_exact)]
   end subroutine collect_velocity_step

   !> Equation (1.1) by hand.
   subroutine test_coefficient(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_close(error, friction_coefficient(law, 1.0e-6_wp, 10.0_wp), &
                        0.6_wp + 0.005_wp*log(2.0_wp), 1.0e-15_wp, "mu at v0")
      call expect_close(error, friction_coefficient(law, 4.0e-6_wp, 30.0_wp), &
                        0.6_wp - 0.01_wp*log(1.25_wp) + 0.015_wp*log(4.0_wp), 1.0e-15_wp, "mu")
      call expect_close(error, friction_coefficient(law, 1.0e20_wp, 0.0_wp), 0.6_wp, 1.0e-15_wp, &
                        "mu0")
   end subroutine test_coefficient

   !> Time, slip, velocity, state and friction of all three phases: steady slip at v0 = 1 um/s over
   !> 3 Dc, at 10 um/s over 9 Dc, and at v0 again.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(friction_response_type) :: response
      real(wp) :: after_step_up, exact(3*n), time(3*n), slip(3*n), velocity(3*n)
      real(wp) :: part(n)
      integer, parameter :: last(2) = [n, 2*n]
      integer :: i

      call respond(step_protocol_type(law=law, delta_v=9.0e-6_wp, slip_before=3.0_wp, &
                                      slip_after=9.0_wp, samples=n, tolerance=1.0e-10_wp), &
                   response, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      part = [(i/(n - 1.0_wp), i=0, n - 1)]
      time = [30.0_wp*part, 30.0_wp + 9.0_wp*part, 39.0_wp + 90.0_wp*part]
      slip = 1.0e-5_wp*[3.0_wp*part, 3.0_wp + 9.0_wp*part, 12.0_wp + 9.0_wp*part]
      velocity = [(1.0e-6_wp, i=1, n), (1.0e-5_wp, i=1, n), (1.0e-6_wp, i=1, n)]
      after_step_up = 1.0_wp + 9.0_wp*exp(-9.0_wp)
      exact = [(10.0_wp, i=1, n), 1.0_wp + 9.0_wp*exp(-9.0_wp*part), &
               10.0_wp + (after_step_up - 10.0_wp)*exp(-9.0_wp*part)]
      call expect_close(error, response%time, time, 1.0e-12_wp, "time")
      call expect_close(error, response%slip/1.0e-5_wp, slip/1.0e-5_wp, 1.0e-12_wp, "slip over Dc")
      call expect_close(error, response%velocity/1.0e-6_wp, velocity/1.0e-6_wp, 1.0e-14_wp, &
                        "velocity over v0")
      call expect_close(error, response%theta, exact, 2.0e-9_wp, "theta")
      call expect_close(error, response%theta(last + 1), response%theta(last), 1.0e-14_wp, &
                        "theta does not jump with the velocity")
      call expect_close(error, response%mu, 0.6_wp - 0.01_wp*log(1.0e-6_wp/velocity + 1.0_wp) &
                        + 0.015_wp*log(exact/10.0_wp + 1.0_wp), 1.0e-11_wp, "mu")
   end subroutine test_exact
end module test_velocity_step
