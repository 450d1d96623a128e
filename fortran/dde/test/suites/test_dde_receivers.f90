!> Receivers and continuations that the solver refuses before it starts.
module test_dde_receivers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, refused, table_sampler
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: infection
   use solving, only: at_tolerance
   use test_problems, only: sine
   implicit none (type, external)
   private
   public :: collect_dde_receivers

contains

   !> All tests of this suite.
   subroutine collect_dde_receivers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("samplers", test_samplers), &
                   new_unittest("times of samples", test_times), &
                   new_unittest("used tables", test_used_tables), &
                   new_unittest("watchers", test_watchers), &
                   new_unittest("tables of events", test_tables), &
                   new_unittest("continuations", test_continuations)]
   end subroutine collect_dde_receivers

   !> Components wanted that are not there.
   subroutine test_samplers(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(table_sampler) :: table

      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, table)
      call expect_failure(error, failure, "wanted of the sampler is not allocated; components 1..1")
      table = table_sampler([1, 2], [0.5_wp])
      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, table)
      call expect_failure(error, failure, "wanted(2) = 2 of the sampler; 1..1 expected")
      table = table_sampler([1], [0.5_wp])
      table%share_of_step = 0.0_wp
      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, table)
      call expect_failure(error, failure, "share_of_step = 0.0 of the sampler; a number > 0")
      call expect(error, outcome%reason == refused .and. table%received == 0, "no sample is taken")
   end subroutine test_samplers

   !> Times of samples ascend, from the initial time on.
   subroutine test_times(error)
      type(error_type), allocatable, intent(out) :: error

      call refuse_times(error, [0.5_wp, 2.0_wp, 1.0_wp], &
                        "time(3) = 1.0 of the table of samples after time(2) = 2.0")
      call refuse_times(error, [ieee_value(1.0_wp, ieee_quiet_nan), 0.5_wp], &
                        "next = NaN of the sampler; a time from 0.0 (t_start) on expected")
      call refuse_times(error, [0.5_wp, ieee_value(1.0_wp, ieee_quiet_nan)], &
                        "time(2) of the table of samples is NaN")
      call refuse_times(error, [-1.0_wp, 0.5_wp], &
                        "next = -1.0 of the sampler; a time from 0.0 (t_start) on expected")
   end subroutine test_times

   !> A run that goes on fills a table further, a new one refuses it; what no run reached is not a
   !> number.
   subroutine test_used_tables(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(table_sampler) :: table

      table = table_sampler([1], [0.0_wp, 0.5_wp, 1.0_wp, 1.5_wp, 3.0_wp])
      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, table, &
                     continuation=state)
      call expect_success(error, failure)
      call integrate(sine(), 1.0_wp, 2.0_wp, integration_options(), outcome, failure, table, &
                     continuation=state)
      call expect_success(error, failure)
      call expect_close(error, table%values(1, :4), sin(table%time(:4)), 1.0e-7_wp, "samples")
      call expect(error, table%received == 4 .and. ieee_is_nan(table%values(1, 5)), &
                  "the last is not a number")
      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, table)
      call expect_failure(error, failure, "the table of samples holds 4 samples of an earlier run")
   end subroutine test_used_tables

   !> Samples at these times are refused in these words.
   subroutine refuse_times(error, time, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The times
      real(wp), intent(in) :: time(:)
      !> Part of the message
      character(len=*), intent(in) :: words
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(table_sampler) :: table

      table = table_sampler([1], time)
      call integrate(sine(), 0.0_wp, 3.0_wp, integration_options(), outcome, failure, table)
      call expect_failure(error, failure, words)
      call expect(error, table%received == 0, "no sample is taken")
   end subroutine refuse_times

   !> Directions and marks that cannot be.
   subroutine test_watchers(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table

      call refuse_watcher(error, table, "direction and terminal of the watcher are not allocated")
      table = event_table([1], [0.5_wp], [1])
      deallocate (table%terminal)
      call refuse_watcher(error, table, "not allocated")
      table = event_table([1, 1], [0.5_wp, 0.5_wp], [1, 2])
      call refuse_watcher(error, table, "direction(2) = 2 of the watcher; -1 (falling)")
      table = event_table([1], [0.5_wp], [1])
      table%terminal = [.true., .false.]
      call refuse_watcher(error, table, "1 directions for 2 marks `terminal`")
      table = event_table([1], [0.5_wp], [1])
      table%look_every = 0.0_wp
      call refuse_watcher(error, table, "look_every = 0.0 of the watcher; a time > 0 expected")
   end subroutine test_watchers

   !> Components and levels that cannot be.
   subroutine test_tables(error)
      type(error_type), allocatable, intent(out) :: error

      call refuse_watcher(error, event_table([2], [0.5_wp], [1]), "component(1) = 2 of the watcher")
      call refuse_watcher(error, event_table([1, 0], [0.5_wp, 0.5_wp], [1, 1]), "component(2) = 0")
      call refuse_watcher(error, event_table([1], [0.5_wp, 0.5_wp], [1]), "2 levels, 1 directions")
   end subroutine test_tables

   !> Another time, other equations, other components, a past too short, arrays that do not fit.
   subroutine test_continuations(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation, spoilt
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(infection) :: problem

      problem = infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], &
                          past=[5.0_wp, 0.1_wp, 1.0_wp], first=[5.0_wp, 0.1_wp, 1.0_wp])
      call integrate(problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-9_wp), outcome, failure, &
                     continuation=continuation)
      call expect_success(error, failure)
      spoilt = continuation
      call refuse_continuation(error, problem, 20.5_wp, spoilt, &
                               "t_start = 20.5 is 0.5 off the time 20.0")
      deallocate (spoilt%nodes)
      call refuse_continuation(error, problem, 20.0_wp, spoilt, &
                               "arrays of the continuation do not fit")
      problem%component = [2, 3]
      call refuse_continuation(error, problem, 20.0_wp, continuation, &
                               "keeps components 2, delayed are 2 3")
      problem%component = [2, 2]
      problem%lag = [1.0_wp, 19.0_wp]
      call refuse_continuation(error, problem, 20.0_wp, continuation, &
                               "lag(2) = 19.0 reaches beyond")
      problem%n = 2
      call refuse_continuation(error, problem, 20.0_wp, continuation, &
                               "3 equations for 2; 2 expected")
   end subroutine test_continuations

   !> The watcher is refused in these words.
   subroutine refuse_watcher(error, watcher, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The watcher
      type(event_table), intent(in) :: watcher
      !> Part of the message
      character(len=*), intent(in) :: words
      type(event_table) :: table
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      table = watcher
      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, watcher=table)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
   end subroutine refuse_watcher

   !> The problem is refused in these words, and the continuation stays as it was.
   subroutine refuse_continuation(error, problem, t_start, continuation, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Initial time
      real(wp), intent(in) :: t_start
      !> Where the run before ended
      type(continuation_type), intent(inout) :: continuation
      !> Part of the message
      character(len=*), intent(in) :: words
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(problem, t_start, 30.0_wp, integration_options(), outcome, failure, &
                     continuation=continuation)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
      call expect_close(error, continuation%time, [20.0_wp, 0.0_wp], 0.0_wp, "time kept")
   end subroutine refuse_continuation
end module test_dde_receivers
