! SPDX-License-Identifier: BSD-3-Clause
!> What the solver refuses before it starts, and that its message names the value met.
module test_dde_refusals
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
                                            ieee_value
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, methods, refused, &
                  table_sampler
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_close, expect_failure
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme, infection
   use solving, only: at_tolerance, run
   use test_problems, only: linear, sine, wille_baker
   use undelayed_problems, only: swing, undelayed
   implicit none (type, external)
   private
   public :: collect_dde_refusals

contains

   subroutine collect_dde_refusals(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("nothing to refuse", test_good), &
                   new_unittest("problems", test_problems), &
                   new_unittest("first states", test_first_states), &
                   new_unittest("ends", test_ends), &
                   new_unittest("options", test_options), &
                   new_unittest("tolerances of components", test_each), &
                   new_unittest("samplers", test_samplers), &
                   new_unittest("used tables", test_used_tables), &
                   new_unittest("watchers", test_watchers), &
                   new_unittest("continuations", test_continuations), &
                   new_unittest("changes of the state", test_changes)]
   end subroutine collect_dde_refusals

   !> What the other tests spoil is accepted as it stands.
   subroutine test_good(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(undelayed) :: alone
      integer :: i

      call run(error, wille_baker(), 1.0_wp, 2.0_wp, integration_options(), outcome)
      call run(error, wille_baker(), 1.0_wp, 2.0_wp, &
               integration_options("explicit", relative=0.0_wp), outcome)
      alone = swing()
      deallocate (alone%lag, alone%component)
      do i = 1, size(methods)
         alone%analytic = methods(i) == "taylor"
         call run(error, alone, 0.0_wp, 1.0_wp, integration_options(methods(i)), outcome)
      end do
   end subroutine test_good

   !> At least one equation; delays that are positive numbers, each of one component.
   subroutine test_problems(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: lags(5)
      type(wille_baker) :: problem
      integer :: i

      do i = -3, 0, 3
         problem = wille_baker()
         problem%n = i
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
   end subroutine test_problems

   !> The first state is finite.
   subroutine test_first_states(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: bad(2)
      integer :: i, j

      bad = [not_a_number(), -infinity()]
      do i = 1, size(bad)
         do j = 1, size(methods)
            call refuse(error, "the initial state has y(2) = "//text(bad(i))//"; a finite number", &
                        wille_baker(first=[1.0_wp, bad(i), 1.0_wp]), &
                        integration_options(methods(j)))
         end do
      end do
   end subroutine test_first_states

   !> The end is a finite number after the start, and the start is finite. Their distance is finite.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: ends(3)
      integer :: i

      ends = [0.5_wp, not_a_number(), infinity()]
      do i = 1, size(ends)
         call refuse(error, "t_end = "//text(ends(i)), t_end=ends(i))
      end do
      call refuse(error, ">= NaN", t_start=not_a_number())
      call refuse(error, ">= -Inf", t_start=-infinity())
      call refuse(error, "t_end = 1.0E+308; finite, >= -1.0E+308 and at most 1.0E+307 later", &
                  t_start=-1.0e308_wp, t_end=1.0e308_wp)
   end subroutine test_ends

   !> Tolerances, limits and the method are in their ranges.
   subroutine test_options(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      real(wp) :: bad(4)
      integer :: i

      bad = [-0.5_wp, not_a_number(), infinity(), 0.0_wp]
      do i = 1, size(bad)
         call refuse(error, "absolute = "//text(bad(i)), options=integration_options( &
                     absolute=bad(i)))
         if (i == 4) cycle
         call refuse(error, "relative = "//text(bad(i)), options=integration_options( &
                     relative=bad(i)))
         call refuse(error, "past_kept = "//text(bad(i)), options=integration_options( &
                     past_kept=bad(i)))
         if (i == 3) cycle
         call refuse(error, "first_step = "//text(bad(i)), options=integration_options( &
                     first_step=bad(i)))
         call refuse(error, "longest_step = "//text(bad(i)), options=integration_options( &
                     longest_step=bad(i)))
      end do
      call refuse(error, "longest_step = 0.0", options=integration_options(longest_step=0.0_wp))
      call refuse(error, "most_bytes = 0.0", options=integration_options(most_bytes=0.0_wp))
      call refuse(error, "method = 'euler'; one of auto, explicit, ", &
                  options=integration_options("euler"))
      call refuse(error, ", "//trim(methods(size(methods)))//" expected", &
                  options=integration_options("euler"))
      call refuse(error, "method = 'taylor' for a problem that gives no Taylor series " &
                  //"(analytic = .false.)", enzyme(), integration_options("taylor"))
      options%break_at = [1.0_wp, not_a_number()]
      call refuse(error, "break_at(2) = NaN; a finite number expected", options=options)
   end subroutine test_options

   !> As many tolerances as equations, each one that can be.
   subroutine test_each(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options

      options%each_absolute = [1.0e-8_wp]
      call refuse(error, "1 tolerances each_absolute for 3 equations", options=options)
      options%each_absolute = [1.0e-8_wp, 0.0_wp, 1.0_wp]
      call refuse(error, "each_absolute(2) = 0.0; finite and > 0 expected", options=options)
      deallocate (options%each_absolute)
      options%each_relative = [-1.0_wp, 0.0_wp, 0.0_wp]
      call refuse(error, "each_relative(1) = -1.0; finite and >= 0 expected", options=options)
   end subroutine test_each

   !> Components that are there; times that ascend, from the initial time on.
   subroutine test_samplers(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: early = " of the sampler; a time from 1.0 (t_start) on"
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
   end subroutine test_samplers

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

   !> Directions, marks, components and levels that cannot be.
   subroutine test_watchers(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table

      call refuse(error, "direction and terminal of the watcher are not allocated", watcher=table)
      table = event_table([1], [0.5_wp], [1], terminal=[.true., .false.])
      call refuse(error, "1 directions for 2 marks `terminal`", watcher=table)
      table = event_table([1], [0.5_wp], [1])
      table%look_every = 0.0_wp
      call refuse(error, "look_every = 0.0 of the watcher; a time > 0 expected", watcher=table)
      call refuse(error, "direction(2) = 2 of the watcher; -1 (falling)", &
                  watcher=event_table([1, 1], [0.5_wp, 0.5_wp], [1, 2]))
      call refuse(error, "component(1) = 4 of the watcher", &
                  watcher=event_table([4], [0.5_wp], [1]))
      call refuse(error, "component(2) = 0", &
                  watcher=event_table([1, 0], [0.5_wp, 0.5_wp], [1, 1]))
      call refuse(error, "the watcher has level(1) = NaN; a finite number expected", &
                  watcher=event_table([1], [not_a_number()], [1]))
      call refuse(error, "2 levels, 1 directions", watcher=event_table([1], [0.5_wp, 0.5_wp], [1]))
   end subroutine test_watchers

   !> Another time, other equations, other components, a past too short, arrays that do not fit or
   !> that no run leaves.
   subroutine test_continuations(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation, spoilt
      type(integration_result) :: outcome
      type(infection) :: problem
      integer :: i

      problem = infection()
      call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-9_wp), outcome, &
               continuation=continuation)
      call refuse(error, "t_start = 20.5 is 0.5 off the time 20.0", problem, t_start=20.5_wp, &
                  continuation=continuation)
      spoilt = continuation
      deallocate (spoilt%nodes)
      call refuse(error, "arrays of the continuation do not fit", problem, continuation=spoilt)
      spoilt = continuation
      spoilt%y(3) = not_a_number()
      call refuse(error, "the continuation has y(3) = NaN", problem, continuation=spoilt)
      do i = -1, 0
         spoilt = continuation
         spoilt%step_length(2) = real(i, wp)
         call refuse(error, "step 2 of the continuation", problem, continuation=spoilt)
         call refuse(error, "its length is "//text(real(i, wp)), problem, continuation=spoilt)
      end do
      spoilt = continuation
      spoilt%step_start(:, 2) = spoilt%step_start(:, 4)
      call refuse(error, "step 2 of the continuation", problem, continuation=spoilt)
      spoilt = continuation
      spoilt%step_start(1, size(spoilt%step_length)) = 20.5_wp
      call refuse(error, "begins -0.5 before the next", problem, continuation=spoilt)
      problem%component = [2, 3]
      call refuse(error, "keeps components 2, delayed are 2 3", problem, continuation=continuation)
      problem%component = [2, 2]
      problem%lag = [1.0_wp, 19.0_wp]
      call refuse(error, "lag(2) = 19.0 reaches beyond", problem, continuation=continuation)
      problem%n = 2
      call refuse(error, "3 equations for 2; 2 expected", problem, continuation=continuation)
      call expect_close(error, continuation%time, [20.0_wp, 0.0_wp], 0.0_wp, "time kept")
   end subroutine test_continuations

   !> A change needs a run before it, and a state.
   subroutine test_changes(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call state%change_state([1.0_wp, 2.0_wp], failure)
      call expect_failure(error, failure, "the continuation is empty; one filled by a run expected")
      call run(error, linear(), 0.0_wp, 1.0_wp, integration_options(), outcome, continuation=state)
      call state%change_state([1.0_wp, 2.0_wp], failure)
      call expect_failure(error, failure, "2 components for 1 equations")
      call state%change_state([not_a_number()], failure)
      call expect_failure(error, failure, "y(1) = NaN; a finite number expected")
   end subroutine test_changes

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

      allocate (asked, source=wille_baker())
      if (present(problem)) then
         deallocate (asked)
         allocate (asked, source=problem)
      end if
      if (present(options)) how = options
      start = 1.0_wp
      if (present(continuation)) start = continuation%time(1)
      if (present(t_start)) start = t_start
      finish = 30.0_wp
      if (present(t_end)) finish = t_end
      samples = table_sampler([1], [start])
      if (ieee_is_nan(start)) samples = table_sampler([1], [1.0_wp])
      if (present(sampler)) samples = sampler
      events = event_table([1], [0.5_wp], [1])
      if (present(watcher)) events = watcher
      call integrate(asked, start, finish, how, outcome, failure, samples, events, continuation)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
      call expect(error, samples%received == 0, "no sample is taken")
   end subroutine refuse

   !> No number.
   pure real(wp) function not_a_number() result(value)
      value = ieee_value(value, ieee_quiet_nan)
   end function not_a_number

   !> Beyond all numbers.
   pure real(wp) function infinity() result(value)
      value = ieee_value(value, ieee_positive_inf)
   end function infinity
end module test_dde_refusals
