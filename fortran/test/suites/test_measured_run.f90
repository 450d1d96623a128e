! SPDX-License-Identifier: BSD-3-Clause
!> The baseline with fixed steps on problems with exact solutions, and measured runs.
module test_measured_run
   use block_builder, only: build_block
   use dde, only: dde_problem_type, integration_result, table_sampler, value_not_finite
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use fixed_step_rk4, only: integrate_rk4
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use measured_case, only: case_type
   use model_history, only: read_history
   use measured_run, only: measure_run, run_type, time_runs
   use test_problems, only: linear, sine
   use undelayed_problems, only: falls_out
   implicit none (type, external)
   private
   public :: collect_measured_run

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_measured_run(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("order of rk4, kinks on the grid", test_order_kinks), &
                   new_unittest("order of rk4, delay off the grid", test_order_off_grid), &
                   new_unittest("samples of rk4", test_rk4_samples), &
                   new_unittest("refusals of rk4", test_rk4_refusals), &
                   new_unittest("sample times", test_sample_times), &
                   new_unittest("measured run", test_one_run)]
   end subroutine collect_measured_run

   !> y' = -y(t-1), y = 1 up to t = 0, at t = 10.
   subroutine test_order_kinks(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_orders(linear(), 10.0_wp, 10493.0_wp/518400, 0.05_wp, error)
   end subroutine test_order_kinks

   !> y' = -y(t - pi/2) goes on as sin t; delayed values lie a third of a step off the grid points.
   subroutine test_order_off_grid(error)
      type(error_type), allocatable, intent(out) :: error
      type(sine) :: problem
      real(wp), parameter :: h = 0.5_wp*pi/(31.0_wp + 1.0_wp/3.0_wp)

      problem = sine()
      call expect_orders(problem, 50*h, sin(50*h), h, error)
   end subroutine test_order_off_grid

   !> Order 4 with a cubic history and 2 with a linear one.
   subroutine expect_orders(problem, t_end, known, h, error)
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_end, known, h
      type(error_type), allocatable, intent(inout) :: error

      call expect_between(error, order_of(problem, .true., t_end, known, h), 3.8_wp, 4.2_wp, &
                          "order with a cubic history")
      call expect_between(error, order_of(problem, .false., t_end, known, h), 1.8_wp, 2.2_wp, &
                          "order with a linear history")
   end subroutine expect_orders

   !> How the error falls from steps of length h to half of that.
   real(wp) function order_of(problem, cubic, t_end, known, h) result(order)
      class(dde_problem_type), intent(in) :: problem
      logical, intent(in) :: cubic
      real(wp), intent(in) :: t_end, known, h
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      real(wp) :: misfit(2)
      integer :: i

      do i = 1, 2
         call integrate_rk4(problem, t_end, h/i, cubic, outcome, failure)
         misfit(i) = abs(outcome%y(1) - known)
      end do
      order = log(misfit(1)/misfit(2))/log(2.0_wp)
   end function order_of

   !> Between grid points, at both ends, and as many as asked for.
   subroutine test_rk4_samples(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(sine) :: problem
      type(table_sampler) :: table
      real(wp) :: time(6)

      time = [0.0_wp, 0.013_wp, 1.0_wp, 2.0_wp, 4.99_wp, 5.0_wp]
      problem = sine()
      table = table_sampler([1], time)
      call integrate_rk4(problem, 5.0_wp, 0.01_wp, .true., outcome, failure, table)
      call expect_success(error, failure)
      call expect(error, table%received == size(time), "every sample is taken")
      call expect_close(error, table%values(1, :), sin(time), 1.0e-8_wp, "samples")
      call expect(error, outcome%accepted == 500_int64, "500 steps")
      call expect(error, outcome%evaluations == 2001_int64, "four evaluations a step")
   end subroutine test_rk4_samples

   !> Steps longer than the delay, and a value that is not finite.
   subroutine test_rk4_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(sine) :: problem

      problem = sine()
      call integrate_rk4(problem, 10.0_wp, 2.0_wp, .true., outcome, failure)
      call expect_failure(error, failure, "longer than the shortest delay, 1.570796")
      call integrate_rk4(falls_out(0.0_wp), 2.0_wp, 0.1_wp, .true., outcome, failure)
      call expect_failure(error, failure, "not finite")
      call expect(error, outcome%reason == value_not_finite, "the reason says so")
      call expect_close(error, outcome%t, 0.9_wp, 1.0e-12_wp, "time reached")
   end subroutine test_rk4_refusals

   !> The last one is t_end, also where the quotient rounds down.
   subroutine test_sample_times(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: case
      real(wp), allocatable :: time(:)

      case%sample_interval = 0.1_wp
      case%t_end = 0.3_wp
      time = case%sample_times()
      call expect(error, size(time) == 4, "four times")
      call expect_close(error, time(4), 0.3_wp, 0.0_wp, "last time")
      case%sample_interval = 2.0_wp
      case%t_end = 5.0_wp
      time = case%sample_times()
      call expect(error, size(time) == 3, "multiples up to the end")
      call expect_close(error, time(3), 4.0_wp, 0.0_wp, "last multiple")
   end subroutine test_sample_times

   !> A case that decays, by the solver and by the baseline.
   subroutine test_one_run(error)
      type(error_type), allocatable, intent(out) :: error
      type(run_type) :: runs(2)
      type(case_type) :: case
      type(failure_type), allocatable :: failure
      integer :: i

      case%name = "decay"
      case%t_end = 50.0_wp
      case%sample_interval = 0.5_wp
      case%model = build_block(tau=10.0_wp, epsilon=0.2_wp, xi=0.8_wp, gamma=0.8_wp)
      call read_history("decay", case%model, [character(len=5) :: "theta", "u", "v"], &
                        [0.0_wp, 0.0_wp, 1.1_wp], case%history, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      runs%method = ["auto     ", "rk4_cubic"]
      runs%setting = [1.0e-10_wp, 0.01_wp]
      do i = 1, 2
         call measure_run(case, 0.0_wp, 100000_int64, runs(i))
         runs(i)%seconds = 0.0_wp
         call expect(error, runs(i)%status == "ok" .and. runs(i)%reason == "", "the run is ok")
      end do
      call expect(error, size(runs(1)%samples, 2) == 101, "101 samples")
      call expect_close(error, runs(1)%samples(3, :), runs(2)%samples(3, :), 1.0e-7_wp, "ln v")
      call expect_close(error, runs(1)%most, log(1.1_wp), 1.0e-15_wp, "largest ln v")
      call expect(error, runs(1)%least <= minval(runs(1)%samples(3, :)), "smallest ln v")
      call time_runs(case, 100000_int64, 3, 1.0e-3_wp, runs)
      do i = 1, 2
         call expect_between(error, runs(i)%seconds, 1.0e-7_wp, 1.0_wp, "seconds")
      end do
   end subroutine test_one_run
end module test_measured_run
