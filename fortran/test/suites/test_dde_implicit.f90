!> Whole runs of the implicit methods and of `auto`.
module test_dde_implicit
   use block_builder, only: build_block
   use dde, only: integrate, integration_options, integration_result, step_underflow, &
                  too_many_steps, value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use fast_problems, only: plain_block
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme, infection, mackey_glass
   use solving, only: at_tolerance, solve
   use spring_block, only: spring_block_type
   use stiff_problems, only: exponential_decay
   use test_problems, only: linear, wille_baker
   use undelayed_problems, only: blow_up, falls_out, without_delays
   implicit none (type, external)
   private
   public :: collect_dde_implicit

   !> Methods under test.
   character(len=8), parameter :: methods(4) = ["radau5  ", "radau9  ", "radau13 ", "auto    "]

contains

   !> All tests of this suite.
   subroutine collect_dde_implicit(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("linear, with and without a jump", test_linear), &
                   new_unittest("two delays", test_two_delays), &
                   new_unittest("infection", test_infection), &
                   new_unittest("enzyme kinetics", test_enzyme), &
                   new_unittest("mackey-glass", test_mackey_glass), &
                   new_unittest("steps longer than the delay", test_overlap), &
                   new_unittest("jacobian of the block", test_jacobian), &
                   new_unittest("auto takes the better method", test_auto), &
                   new_unittest("reasons to stop", test_stops)]
   end subroutine collect_dde_implicit

   !> Exact values of y' = -y(t - 1).
   subroutine test_linear(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: time(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]
      integer :: i

      do i = 1, size(methods)
         call solve(linear(n=1, lag=[1.0_wp], component=[1], past=[1.0_wp], first=[1.0_wp]), &
                    time, at_tolerance(1.0e-10_wp, methods(i)), y, error)
         call expect_close(error, y(1, :), [0.0_wp, -0.5_wp, 19.0_wp/120, 10493.0_wp/518400], &
                           1.0e-9_wp, trim(methods(i))//", kink")
         call solve(linear(n=1, lag=[1.0_wp], component=[1], past=[0.0_wp], first=[1.0_wp]), &
                    time, at_tolerance(1.0e-10_wp, methods(i)), y, error)
         call expect_close(error, y(1, :), [1.0_wp, 0.0_wp, 5.0_wp/24, 19223.0_wp/362880], &
                           1.0e-9_wp, trim(methods(i))//", jump")
      end do
   end subroutine test_linear

   !> Exact values of the problem of Wille and Baker.
   subroutine test_two_delays(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      integer :: i

      do i = 1, size(methods)
         call solve(wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], &
                                past=[1.0_wp, 1.0_wp, 1.0_wp], first=[1.0_wp, 1.0_wp, 1.0_wp]), &
                    [5.0_wp], at_tolerance(1.0e-10_wp, methods(i)), y, error)
         call expect_close(error, y(:, 1), [767.0_wp/40, 176.42257844738032_wp, &
                                            190.34420193607042_wp], 1.0e-6_wp, trim(methods(i)))
      end do
   end subroutine test_two_delays

   !> Published values of the infection problem.
   subroutine test_infection(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      integer :: i

      do i = 1, size(methods)
         call solve(infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], &
                              past=[5.0_wp, 0.1_wp, 1.0_wp], first=[5.0_wp, 0.1_wp, 1.0_wp]), &
                    [40.0_wp], at_tolerance(1.0e-10_wp, methods(i)), y, error)
         call expect_close(error, y(:, 1), [0.0912491205664_wp, 0.0202995003351_wp, &
                                            5.9884513791_wp], 2.0e-8_wp, trim(methods(i)))
      end do
   end subroutine test_infection

   !> Published values of the enzyme kinetics.
   subroutine test_enzyme(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      integer :: i

      do i = 1, size(methods)
         call solve(enzyme(n=4, lag=[4.0_wp], component=[4], &
                           past=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp], &
                           first=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp]), &
                    [160.0_wp], at_tolerance(1.0e-10_wp, methods(i)), y, error)
         call expect_close(error, y(:, 1), [33.92579471114_wp, 22.70653713103_wp, &
                                            18.83057673173_wp, 22.26599078770_wp], 1.0e-6_wp, &
                           trim(methods(i)))
      end do
   end subroutine test_enzyme

   !> Published values of Mackey and Glass's equation.
   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      integer :: i

      do i = 1, size(methods)
         call solve(mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], &
                                 first=[1.2_wp]), &
                    [50.0_wp, 100.0_wp, 200.0_wp], at_tolerance(1.0e-11_wp, methods(i)), y, error)
         call expect_close(error, y(1, :), [1.060954362898_wp, 1.013724016524_wp, &
                                            1.186718107117_wp], 2.0e-7_wp, trim(methods(i)))
      end do
   end subroutine test_mackey_glass

   !> With a delay of 1e-4 and changes on a scale of 1, ten units of time take a few dozen steps,
   !> and the exact solution is met.
   subroutine test_overlap(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponential_decay) :: problem
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i

      problem = exponential_decay(1.0e-4_wp)
      do i = 1, size(methods)
         call integrate(problem, 0.0_wp, 10.0_wp, at_tolerance(1.0e-8_wp, methods(i)), outcome, &
                        failure)
         call expect_success(error, failure)
         call expect_close(error, outcome%y, [exp(10.0_wp*problem%rate)], 1.0e-8_wp, &
                           trim(methods(i)))
         call expect_between(error, real(outcome%accepted, wp), 10.0_wp, 300.0_wp, "steps")
      end do
   end subroutine test_overlap

   !> The block's own derivatives against central differences.
   subroutine test_jacobian(error)
      type(error_type), allocatable, intent(out) :: error
      type(spring_block_type) :: block_model
      real(wp) :: above(3), below(3), by_y(3, 3), moved(3)
      real(wp), allocatable :: by_z(:, :), z(:)
      real(wp), parameter :: y(3) = [0.7_wp, -1.3_wp, -0.4_wp], step = 1.0e-5_wp
      integer :: i, j

      do i = 0, 1
         block_model = build_block(tau=7.0_wp*i, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, &
                                   v=1.1_wp)
         allocate (z(i), source=0.2_wp)
         allocate (by_z(3, i))
         call block_model%jacobian(0.0_wp, y, z, by_y, by_z)
         do j = 1, 3
            moved = y
            moved(j) = y(j) + step
            call block_model%rhs(0.0_wp, moved, z, above)
            moved(j) = y(j) - step
            call block_model%rhs(0.0_wp, moved, z, below)
            call expect_close(error, by_y(:, j), (above - below)/(2.0_wp*step), 1.0e-8_wp, "by y")
         end do
         do j = 1, i
            call block_model%rhs(0.0_wp, y, z + step, above)
            call block_model%rhs(0.0_wp, y, z - step, below)
            call expect_close(error, by_z(:, j), (above - below)/(2.0_wp*step), 1.0e-8_wp, "by z")
         end do
         deallocate (z, by_z)
      end do
   end subroutine test_jacobian

   !> A mild scene stays explicit; a stiff one without its slow series takes few evaluations.
   subroutine test_auto(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(plain_block) :: stiff

      call integrate(build_block(tau=10.0_wp, epsilon=0.35_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp), &
                     0.0_wp, 200.0_wp, at_tolerance(1.0e-9_wp, "auto"), outcome, failure)
      call expect_success(error, failure)
      call expect(error, outcome%implicit_steps == 0, "the mild scene stays explicit")
      stiff%spring_block_type = build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, &
                                            gamma=1.0e6_wp, v=1.5_wp)
      call integrate(stiff, 0.0_wp, 100.0_wp, at_tolerance(1.0e-9_wp, "auto"), outcome, failure)
      call expect_success(error, failure)
      call expect(error, outcome%implicit_steps > 50 .and. outcome%switches >= 1, &
                  "the stiff scene turns implicit")
      call expect(error, outcome%evaluations < 20000_int64 .and. outcome%factorisations > 0, &
                  "evaluations: "//text(outcome%evaluations))
   end subroutine test_auto

   !> Singular, undefined and too long runs end with their reason.
   subroutine test_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(blow_up) :: singular
      type(falls_out) :: undefined
      integer :: i

      singular = blow_up(n=1, past=[1.0_wp], first=[1.0_wp])
      call without_delays(singular)
      undefined = falls_out(n=1, past=[0.0_wp], first=[0.0_wp])
      call without_delays(undefined)
      do i = 1, size(methods)
         options = at_tolerance(1.0e-6_wp, methods(i))
         call integrate(singular, 0.0_wp, 2.0_wp, options, outcome, failure)
         call expect(error, allocated(failure) .and. outcome%reason == step_underflow &
                     .and. abs(outcome%t - 1.0_wp) < 1.0e-5_wp, trim(methods(i))//": singular")
         call integrate(undefined, 0.0_wp, 2.0_wp, options, outcome, failure)
         call expect(error, allocated(failure) .and. outcome%reason == value_not_finite &
                     .and. abs(outcome%t - 1.0_wp) < 1.0e-6_wp, trim(methods(i))//": undefined")
         options%most_steps = 3
         call integrate(singular, 0.0_wp, 0.9_wp, options, outcome, failure)
         call expect(error, allocated(failure) .and. outcome%reason == too_many_steps, &
                     trim(methods(i))//": too many steps")
      end do
   end subroutine test_stops
end module test_dde_implicit
