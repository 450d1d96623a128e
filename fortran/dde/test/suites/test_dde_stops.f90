! SPDX-License-Identifier: BSD-3-Clause
!> Why an integration ends, and that time and state say how far it came.
module test_dde_stops
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: dde_problem_type, event_table, integrate, integration_options, &
                  integration_result, methods, reached_end, step_underflow, table_sampler, &
                  too_many_steps, value_not_finite
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_between, expect_close, expect_failure
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: jumping_history
   use solving, only: at_tolerance, run
   use test_problems, only: fill, sine
   use undelayed_problems, only: blow_up, falls_out, swing
   implicit none (type, external)
   private
   public :: collect_dde_stops

contains

   subroutine collect_dde_stops(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("step underflow", test_step_underflow), &
                   new_unittest("tolerance below rounding", test_below_rounding), &
                   new_unittest("an end far away", test_far_end), &
                   new_unittest("too many steps", test_too_many_steps), &
                   new_unittest("values not finite", test_not_finite), &
                   new_unittest("no length", test_no_length)]
   end subroutine collect_dde_stops

   !> y = 1/(1 - t) has no value at t = 1: the step shrinks until it cannot move time.
   subroutine test_step_underflow(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         call integrate(blow_up(), 0.0_wp, 2.0_wp, at_tolerance(1.0e-9_wp, methods(i)), outcome, &
                        failure)
         call expect(error, outcome%reason == step_underflow, "the reason is `step_underflow`")
         call expect_failure(error, failure, "too small to change the time; a singularity?")
         call expect_close(error, outcome%t, 1.0_wp, 1.0e-8_wp, "t by "//methods(i))
         if (methods(i) /= "explicit") cycle
         call expect_failure(error, failure, "stopped at t = 1.0000")
         call expect_between(error, outcome%y(1), 1.0e15_wp, huge(1.0_wp), "y")
      end do
   end subroutine test_step_underflow

   !> If no step meets the tolerance because of rounding errors, the message says so: of a value,
   !> and of a slope where the value is 0.
   subroutine test_below_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         options = integration_options(methods(i), relative=0.0_wp, absolute=1.0e-300_wp, &
                                       most_steps=1000_int64)
         call integrate(swing(), 0.0_wp, 2.0_wp, options, outcome, failure)
         call expect_failure(error, failure, "below its rounding error 2.220446049")
      end do
      options%method = "explicit"
      call integrate(sine(), 0.0_wp, 2.0_wp, options, outcome, failure)
      call expect_failure(error, failure, "the tolerance 1.0E-300 of y(1) = 0.0 is below its")
   end subroutine test_below_rounding

   !> y = sin t up to 1/2, where an event ends the run, with its end far away.
   subroutine test_far_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         table = event_table([1], [0.5_wp], [1], terminal=[.true.])
         call run(error, sine(), 0.0_wp, 1.0e307_wp, at_tolerance(1.0e-10_wp, methods(i)), &
                  outcome, watcher=table)
         call expect_close(error, outcome%t, asin(0.5_wp), 1.0e-8_wp, "t by "//methods(i))
      end do
   end subroutine test_far_end

   !> The steps run out: time and state belong together.
   subroutine test_too_many_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome

      options = at_tolerance(1.0e-11_wp)
      options%first_step = 3.0_wp
      options%most_steps = 20_int64
      call integrate(swing(), 0.0_wp, 1000.0_wp, options, outcome, failure)
      call expect(error, outcome%reason == too_many_steps, "the reason is `too_many_steps`")
      call expect_failure(error, failure, "20 steps (most_steps)")
      call expect(error, outcome%rejected > 0, "some steps were rejected")
      call expect(error, outcome%accepted + outcome%rejected == 20, "20 steps were tried")
      call expect_between(error, outcome%t, 1.0_wp, 60.0_wp, "t")
      call expect_close(error, outcome%y, [cos(outcome%t), -sin(outcome%t)], 1.0e-9_wp, "y")
   end subroutine test_too_many_steps

   !> y = t up to t = 1, and no number beyond: it comes as near as steps can be short. Where not
   !> even the first slope is a number, it stays at the start. A history that is no number is named
   !> with its component and time.
   subroutine test_not_finite(error)
      type(error_type), allocatable, intent(out) :: error
      type(jumping_history) :: problem
      integer :: i

      call fill(problem, 1, [0.0_wp], [0.0_wp], [1.0_wp], [1])
      problem%rate = -1.0_wp
      problem%before = ieee_value(1.0_wp, ieee_quiet_nan)
      do i = 1, size(methods)
         if (methods(i) == "taylor") cycle
         call expect_stop(falls_out(0.0_wp), 0.0_wp, "f(1) is NaN at t = 1.0", 1.0_wp, 1.0_wp)
         call expect_stop(falls_out(5.0_wp), 3.0_wp, "stopped at t = 3.0 of 5.0 after 0 steps", &
                          3.0_wp, 5.0_wp)
         call expect_stop(problem, 0.0_wp, "the history of y(1) is NaN at t = -1.0", &
                          0.0_wp, 0.0_wp)
      end do

   contains

      !> A run over two units of time ends with these words, at a time and a value.
      subroutine expect_stop(problem, t_start, words, t, y)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: t_start, t, y
         character(len=*), intent(in) :: words
         type(failure_type), allocatable :: failure
         type(integration_result) :: outcome

         call integrate(problem, t_start, t_start + 2.0_wp, at_tolerance(1.0e-9_wp, methods(i)), &
                        outcome, failure)
         call expect(error, outcome%reason == value_not_finite, "the reason is `value_not_finite`")
         call expect_failure(error, failure, words)
         call expect_close(error, [outcome%t, outcome%y], [t, y], 1.0e-12_wp, words//methods(i))
      end subroutine expect_stop
   end subroutine test_not_finite

   !> A run of no length gives the first state and the sample there.
   subroutine test_no_length(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(table_sampler) :: table

      table = table_sampler([1], [1.0_wp])
      call run(error, falls_out(5.0_wp), 1.0_wp, 1.0_wp, at_tolerance(1.0e-9_wp), outcome, table)
      call expect(error, outcome%reason == reached_end, "the reason is `reached_end`")
      call expect_close(error, outcome%y, [5.0_wp], 0.0_wp, "y")
      call expect_close(error, table%values(1, :), [5.0_wp], 0.0_wp, "the sample")
   end subroutine test_no_length
end module test_dde_stops
