! SPDX-License-Identifier: BSD-3-Clause
!> What the solver refuses before it starts, with a message that names the value met; and why a run
!> ends early, with time and state that say how far it came.
module test_dde_refusals
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
                                            ieee_value
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, methods, reached_end, refused, &
                  step_underflow, table_sampler, too_many_steps, value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: int64, wp
   use expectations, only: expect, expect_between, expect_close, expect_failure
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: jumping_history
   use published_problems, only: enzyme, infection
   use solving, only: at_tolerance, run
   use test_problems, only: constant_past, sine, wille_baker
   use undelayed_problems, only: blow_up, falls_out, swing
   implicit none (type, external)
   private
   public :: collect_dde_refusals

contains

   subroutine collect_dde_refusals(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("nothing to refuse", test_good), &
                   new_unittest("problems", test_problems), &
                   new_unittest("times and options", test_options), &
                   new_unittest("samplers and watchers", test_receivers), &
                   new_unittest("used tables", test_used_tables), &
                   new_unittest("continuations", test_continuations), &
                   new_unittest("runs that end early", test_ends), &
                   new_unittest("tolerance below rounding", test_below_rounding), &
                   new_unittest("too many steps", test_too_many_steps)]
   end subroutine collect_dde_refusals

   !> What the other tests spoil is accepted as it stands, by all methods, and without lists of
   !> delays. A run of no length gives the first state and the sample there.
   subroutine test_good(error)
      type(error_type), allocatable, intent(out) :: error
      type(constant_past) :: alone
      type(integration_result) :: outcome
      type(table_sampler) :: table
      integer :: i

      call run(error, wille_baker(), 1.0_wp, 2.0_wp, integration_options(relative=0.0_wp), outcome)
      do i = 1, size(methods)
         alone = swing()
         deallocate (alone%lag, alone%component)
         alone%analytic = methods(i) == "taylor"
         call run(error, alone, 0.0_wp, 1.0_wp, integration_options(methods(i)), outcome)
      end do
      table = table_sampler([1], [1.0_wp])
      call run(error, falls_out(5.0_wp), 1.0_wp, 1.0_wp, at_tolerance(1.0e-9_wp), outcome, table)
      call expect(error, outcome%reason == reached_end, "the reason is `reached_end`")
      call expect_close(error, [outcome%y, table%values(1, :)], [5.0_wp, 5.0_wp], 0.0_wp, "y")
   end subroutine test_good

   !> At least one equation; delays that are positive numbers, each of one component; a band and the
   !> rows of delayed values; a first state that is finite, by each method.
   subroutine test_problems(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: lags(5)
      type(wille_baker) :: problem
      integer :: i

      do i = -3, 0, 3
         problem = wille_baker(n=i)
         call refuse(error, "n = "//text(i)//" equations", problem)
      end do
      problem = wille_baker()
      deallocate (problem%lag)
      call refuse(error, "lag is not allocated", problem)
      problem = wille_baker()
      deallocate (problem%component)
      call refuse(error, "component is not allocated", problem)
      call refuse(error, "3 delays for 2 delayed components", &
                  wille_baker(lag=[1.0_wp, 0.2_wp, 0.5_wp]))
      lags = [0.0_wp, -1.5_wp, not_a_number(), infinity(), 1.0e-150_wp]
      do i = 1, size(lags)
         call refuse(error, "lag(2) = "//text(lags(i)), wille_baker(lag=[1.0_wp, lags(i)]))
      end do
      do i = 0, 4, 4
         call refuse(error, "component(2) = "//text(i)//"; 1..3 expected", &
                     wille_baker(component=[1, i]))
      end do
      problem = wille_baker()
      problem%lower = 1
      call refuse(error, "lower = 1, upper = -1; both >= 0 expected", problem)
      problem%upper = 1
      call refuse(error, "no rows; rows of each delayed value expected", problem)
      problem%rows = reshape([1, 1], [2, 1])
      call refuse(error, "rows has the shape (2, 1); (2, 2) expected", problem)
      do i = 0, 4, 4
         problem%rows = reshape([1, 3, i, 3], [2, 2])
         call refuse(error, "rows(:, 2) = "//text(i)//", 3; ascending in 1..3 expected", problem)
      end do
      do i = 1, size(methods)
         call refuse(error, "the initial state has y(2) = NaN; a finite number", &
                     wille_baker(first=[1.0_wp, not_a_number(), 1.0_wp]), &
                     integration_options(methods(i)))
      end do
      call refuse(error, "y(2) = -Inf", wille_baker(first=[1.0_wp, -infinity(), 1.0_wp]))
   end subroutine test_problems

   !> Ends that are finite, after the start and not too far; tolerances, limits and the method in
   !> their ranges; as many tolerances of components as equations.
   subroutine test_options(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      real(wp) :: bad(4)
      integer :: i

      bad = [-0.5_wp, not_a_number(), infinity(), 0.0_wp]
      do i = 1, 3
         call refuse(error, "t_end = "//text(bad(i)), t_end=bad(i))
         if (i < 3) call refuse(error, ">= "//text(-bad(4 - i)), t_start=-bad(4 - i))
      end do
      call refuse(error, "t_end = 1.0E+308; finite, >= -1.0E+308 and at most 1.0E+307 later", &
                  t_start=-1.0e308_wp, t_end=1.0e308_wp)
      do i = 1, size(bad)
         call refuse_option("absolute = ", integration_options(absolute=bad(i)))
         if (i /= 3) call refuse_option("longest_step = ", integration_options(longest_step=bad(i)))
         if (i == 4) cycle
         call refuse_option("relative = ", integration_options(relative=bad(i)))
         call refuse_option("past_kept = ", integration_options(past_kept=bad(i)))
         if (i < 3) call refuse_option("first_step = ", integration_options(first_step=bad(i)))
      end do
      call refuse(error, "most_bytes = 0.0", options=integration_options(most_bytes=0.0_wp))
      call refuse(error, "method = 'euler'; one of auto, explicit, ", &
                  options=integration_options("euler"))
      call refuse(error, ", "//trim(methods(size(methods)))//" expected", &
                  options=integration_options("euler"))
      call refuse(error, "method = 'taylor' for a problem that gives no Taylor series " &
                  //"(analytic = .false.)", enzyme(), integration_options("taylor"))
      options%break_at = [1.0_wp, not_a_number()]
      call refuse(error, "break_at(2) = NaN; a finite number expected", options=options)
      deallocate (options%break_at)
      options%each_absolute = [1.0e-8_wp]
      call refuse(error, "1 tolerances each_absolute for 3 equations", options=options)
      options%each_absolute = [1.0e-8_wp, 0.0_wp, 1.0_wp]
      call refuse(error, "each_absolute(2) = 0.0; finite and > 0 expected", options=options)
      deallocate (options%each_absolute)
      options%each_relative = [-1.0_wp, 0.0_wp, 0.0_wp]
      call refuse(error, "each_relative(1) = -1.0; finite and >= 0 expected", options=options)

   contains

      subroutine refuse_option(name, how)
         character(len=*), intent(in) :: name
         type(integration_options), intent(in) :: how

         call refuse(error, name//text(bad(i)), options=how)
      end subroutine refuse_option
   end subroutine test_options

   !> Components that are there; times that ascend, from the initial time on; directions, marks and
   !> levels that can be.
   subroutine test_receivers(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: early = " of the sampler; a time from 1.0 (t_start) on"
      real(wp), parameter :: half(2) = 0.5_wp
      type(event_table) :: events
      type(table_sampler) :: table

      call refuse(error, "wanted of the sampler is not allocated; components 1..3", sampler=table)
      call refuse(error, "wanted(2) = 4 of the sampler; 1..3 expected", &
                  sampler=table_sampler([1, 4], [1.5_wp]))
      table = table_sampler([1], [1.5_wp])
      table%share_of_step = 0.0_wp
      call refuse(error, "share_of_step = 0.0 of the sampler; a number > 0", sampler=table)
      call refuse(error, "time(3) = 1.0 of the table of samples after time(2) = 2.0", &
                  sampler=table_sampler([1], [1.0_wp, 2.0_wp, 1.0_wp]))
      call refuse(error, "next = NaN"//early, sampler=table_sampler([1], [not_a_number(), 1.0_wp]))
      call refuse(error, "next = -1.0"//early, sampler=table_sampler([1], [-1.0_wp, 1.0_wp]))
      call refuse(error, "time(2) of the table of samples is NaN", &
                  sampler=table_sampler([1], [1.0_wp, not_a_number()]))
      call refuse(error, "direction and terminal of the watcher are not allocated", watcher=events)
      call refuse(error, "1 directions for 2 marks `terminal`", &
                  watcher=event_table([1], half(:1), [1], terminal=[.true., .false.]))
      events = event_table([1], half(:1), [1])
      events%look_every = 0.0_wp
      call refuse(error, "look_every = 0.0 of the watcher; a time > 0 expected", watcher=events)
      call refuse(error, "direction(2) = 2 of the watcher; -1 (falling)", &
                  watcher=event_table([1, 1], half, [1, 2]))
      call refuse(error, "component(1) = 4 of the watcher", watcher=event_table([4], half(:1), [1]))
      call refuse(error, "component(2) = 0", watcher=event_table([1, 0], half, [1, 1]))
      call refuse(error, "the watcher has level(1) = NaN; a finite number expected", &
                  watcher=event_table([1], [not_a_number()], [1]))
      call refuse(error, "2 levels, 1 directions", watcher=event_table([1], half, [1]))
   end subroutine test_receivers

   !> A run that goes on fills a table further, a new one refuses it; what no run reached is not a
   !> number.
   subroutine test_used_tables(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(table_sampler) :: table

      table = table_sampler([1], [0.0_wp, 0.5_wp, 1.0_wp, 1.5_wp, 3.0_wp])
      call run(error, sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, table, &
               continuation=state)
      call run(error, sine(), 1.0_wp, 2.0_wp, integration_options(), outcome, table, &
               continuation=state)
      call expect_close(error, table%values(1, :4), sin(table%time(:4)), 1.0e-7_wp, "samples")
      call expect(error, table%received == 4 .and. ieee_is_nan(table%values(1, 5)), &
                  "the last is not a number")
      call integrate(sine(), 0.0_wp, 1.0_wp, integration_options(), outcome, failure, table)
      call expect_failure(error, failure, "the table of samples holds 4 samples of an earlier run")
   end subroutine test_used_tables

   !> Another time, other equations, other components, a past too short, arrays that do not fit or
   !> that no run leaves. A change needs a run before it, and a state.
   subroutine test_continuations(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: empty, good, spoilt
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(infection) :: problem
      integer :: i

      call empty%change_state([1.0_wp, 2.0_wp], failure)
      call expect_failure(error, failure, "the continuation is empty; one filled by a run expected")
      problem = infection()
      call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-9_wp), outcome, continuation=good)
      if (allocated(error)) return
      call good%change_state([1.0_wp, 2.0_wp], failure)
      call expect_failure(error, failure, "2 components for 3 equations")
      call good%change_state([1.0_wp, not_a_number(), 1.0_wp], failure)
      call expect_failure(error, failure, "y(2) = NaN; a finite number expected")
      call refuse(error, "t_start = 20.5 is 0.5 off the time 20.0", problem, t_start=20.5_wp, &
                  continuation=good)
      spoilt = good
      deallocate (spoilt%nodes)
      call refuse(error, "arrays of the continuation do not fit", problem, continuation=spoilt)
      spoilt = good
      spoilt%y(3) = not_a_number()
      call refuse(error, "the continuation has y(3) = NaN", problem, continuation=spoilt)
      do i = -1, 0
         spoilt = good
         spoilt%step_length(2) = real(i, wp)
         call refuse(error, "step 2 of the continuation", problem, continuation=spoilt)
         call refuse(error, "its length is "//text(real(i, wp)), problem, continuation=spoilt)
      end do
      spoilt = good
      spoilt%step_start(:, 2) = spoilt%step_start(:, 4)
      call refuse(error, "step 2 of the continuation", problem, continuation=spoilt)
      spoilt = good
      spoilt%step_start(1, size(spoilt%step_length)) = 20.5_wp
      call refuse(error, "begins -0.5 before the next", problem, continuation=spoilt)
      problem%component = [2, 3]
      call refuse(error, "keeps components 2, delayed are 2 3", problem, continuation=good)
      problem%component = [2, 2]
      problem%lag = [1.0_wp, 19.0_wp]
      call refuse(error, "lag(2) = 19.0 reaches beyond", problem, continuation=good)
      problem%n = 2
      call refuse(error, "3 equations for 2; 2 expected", problem, continuation=good)
      call expect_close(error, good%time, [20.0_wp, 0.0_wp], 0.0_wp, "time kept")
   end subroutine test_continuations

   !> A run is refused in these words, and takes no sample.
   subroutine refuse(error, words, problem, options, t_start, t_end, sampler, watcher, continuation)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: words
      !> The problem, options, times and receivers; those not given are good
      class(dde_problem_type), intent(in), optional :: problem
      type(integration_options), intent(in), optional :: options
      real(wp), intent(in), optional :: t_start, t_end
      type(table_sampler), intent(in), optional :: sampler
      type(event_table), intent(in), optional :: watcher
      type(continuation_type), intent(inout), optional :: continuation
      class(dde_problem_type), allocatable :: asked
      type(event_table) :: events
      type(failure_type), allocatable :: failure
      type(integration_options) :: how
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      real(wp) :: finish, start

      if (present(problem)) allocate (asked, source=problem)
      if (.not. present(problem)) allocate (asked, source=wille_baker())
      if (present(options)) how = options
      start = 1.0_wp
      if (present(continuation)) start = continuation%time(1)
      if (present(t_start)) start = t_start
      finish = 30.0_wp
      if (present(t_end)) finish = t_end
      samples = table_sampler([1], [merge(1.0_wp, start, ieee_is_nan(start))])
      if (present(sampler)) samples = sampler
      events = event_table([1], [0.5_wp], [1])
      if (present(watcher)) events = watcher
      call integrate(asked, start, finish, how, outcome, failure, samples, events, continuation)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
      call expect(error, samples%received == 0, "no sample is taken")
   end subroutine refuse

   !> y = 1/(1 - t) has no value at t = 1: the step shrinks until it cannot move time. y = t up to
   !> t = 1, and no number beyond: it comes as near as steps can be short. Where not even the first
   !> slope is a number, it stays at the start. A history that is no number is named with its
   !> component and time. An end far away does not matter where an event ends the run.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         call expect_stop(blow_up(), 0.0_wp, step_underflow, &
                          "too small to change the time; a singularity?", 1.0_wp, 1.0e-8_wp)
         table = event_table([1], [0.5_wp], [1], terminal=[.true.])
         call run(error, sine(), 0.0_wp, 1.0e307_wp, at_tolerance(1.0e-10_wp, methods(i)), &
                  outcome, watcher=table)
         call expect_close(error, outcome%t, asin(0.5_wp), 1.0e-8_wp, "t by "//methods(i))
         if (methods(i) == "taylor") cycle
         call expect_stop(falls_out(0.0_wp), 0.0_wp, value_not_finite, "f(1) is NaN at t = 1.0", &
                          1.0_wp, 1.0e-12_wp, 1.0_wp)
         call expect_stop(falls_out(5.0_wp), 3.0_wp, value_not_finite, &
                          "stopped at t = 3.0 of 5.0 after 0 steps", 3.0_wp, 0.0_wp, 5.0_wp)
         call expect_stop(jumping_history(not_a_number()), 0.0_wp, value_not_finite, &
                          "the history of y(1) is NaN at t = -1.0", 0.0_wp, 0.0_wp, 0.0_wp)
      end do

   contains

      !> A run over two units of time ends for a reason, with these words, at a time and a value.
      subroutine expect_stop(problem, t_start, reason, words, t, within, y)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: t_start, t, within
         real(wp), intent(in), optional :: y
         integer, intent(in) :: reason
         character(len=*), intent(in) :: words
         type(failure_type), allocatable :: failure

         call integrate(problem, t_start, t_start + 2.0_wp, at_tolerance(1.0e-9_wp, methods(i)), &
                        outcome, failure)
         call expect(error, outcome%reason == reason, "the reason, "//words)
         call expect_failure(error, failure, words)
         call expect_close(error, outcome%t, t, within, words//methods(i))
         if (present(y)) call expect_close(error, outcome%y, [y], within, words//methods(i))
      end subroutine expect_stop
   end subroutine test_ends

   !> If no step meets the tolerance because of rounding errors, the message says so: of a value,
   !> and of a slope where the value is 0.
   subroutine test_below_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      options = integration_options(relative=0.0_wp, absolute=1.0e-300_wp, most_steps=1000_int64)
      do i = 1, size(methods)
         options%method = methods(i)
         call integrate(swing(), 0.0_wp, 2.0_wp, options, outcome, failure)
         call expect_failure(error, failure, "below its rounding error 2.220446049")
      end do
      options%method = "explicit"
      call integrate(sine(), 0.0_wp, 2.0_wp, options, outcome, failure)
      call expect_failure(error, failure, "the tolerance 1.0E-300 of y(1) = 0.0 is below its")
   end subroutine test_below_rounding

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
      call expect(error, outcome%rejected > 0 .and. outcome%accepted + outcome%rejected == 20, &
                  "20 steps were tried, some rejected")
      call expect_between(error, outcome%t, 1.0_wp, 60.0_wp, "t")
      call expect_close(error, outcome%y, [cos(outcome%t), -sin(outcome%t)], 1.0e-9_wp, "y")
   end subroutine test_too_many_steps

   !> No number, and beyond all numbers.
   pure real(wp) function not_a_number() result(value)
      value = ieee_value(value, ieee_quiet_nan)
   end function not_a_number

   pure real(wp) function infinity() result(value)
      value = ieee_value(value, ieee_positive_inf)
   end function infinity
end module test_dde_refusals
