! SPDX-License-Identifier: BSD-3-Clause
!> Runs that go on from where one ended: they agree with the exact solution as one run does.
module test_dde_continuation
   use dde, only: continuation_type, dde_problem_type, event_met, event_table, integrate, &
                  integration_options, integration_result, methods, too_many_steps
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_failure, &
                           expect_success
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: infection, mackey_glass, published_infection
   use solving, only: at_tolerance, run
   use test_problems, only: linear, sine
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_continuation

   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_dde_continuation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("known solutions", test_known), &
                   new_unittest("another rate, a shorter delay", test_changes), &
                   new_unittest("a longer delay", test_longer_lag), &
                   new_unittest("when steps run out", test_too_many_steps), &
                   new_unittest("from event to event", test_events), &
                   new_unittest("through a file", test_file), &
                   new_unittest("within a spacing of t", test_runs), &
                   new_unittest("Taylor steps in pieces", test_pieces), &
                   new_unittest("rounding of the oldest step", test_rounding)]
   end subroutine collect_dde_continuation

   !> y = sin t, in the middle of the first delay, at its end, and on; and the published values of
   !> the infection problem.
   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(methods)
         call expect_end(error, sine(), [0.7_wp, 0.8_wp, 0.5_wp*pi, pi, 4.0_wp, 19.0_wp, 30.0_wp], &
                         at_tolerance(1.0e-10_wp, methods(i)), [sin(30.0_wp)], 1.0e-8_wp, &
                         "sine by "//methods(i))
         call expect_end(error, infection(), &
                         [0.5_wp, 1.0_wp, 3.7_wp, 10.0_wp, 11.0_wp, 25.0_wp, 40.0_wp], &
                         at_tolerance(1.0e-10_wp, methods(i)), published_infection, 2.0e-8_wp, &
                         "infection by "//methods(i))
      end do
   end subroutine test_known

   !> y' = -y(t - 1) up to t = 3/2, then -2 y(t - 1), with a kink there and at 5/2, or -y(t - 1/2):
   !> y(3) = 1/8 and y(5/2) = -13/128 by hand.
   subroutine test_changes(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: faster, shorter
      type(integration_result) :: outcome

      call run(error, linear(), 0.0_wp, 1.5_wp, at_tolerance(1.0_wp), outcome, continuation=faster)
      shorter = faster
      call run(error, linear(rate=2.0_wp), 1.5_wp, 3.0_wp, at_tolerance(1.0_wp), outcome, &
               continuation=faster)
      call expect_close(error, outcome%y, [0.125_wp], 1.0e-14_wp, "y(3)")
      call expect(error, outcome%breaking_points == 2, "2 and 5/2 are landed on")
      call run(error, linear(lag=[0.5_wp]), 1.5_wp, 2.5_wp, at_tolerance(1.0_wp), outcome, &
               continuation=shorter)
      call expect_close(error, outcome%y, [-13.0_wp/128], 1.0e-14_wp, "y(5/2)")
   end subroutine test_changes

   !> y' = -y(t - 1/2), and -y(t - 1) from 3/2 on: y(2) = -1/6 by hand. The first run must keep a
   !> past of 1. From 1/2 on, y(1) = 0: the history of the problem holds before the first run.
   subroutine test_longer_lag(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(linear) :: problem
      real(wp), parameter :: past_kept(4) = [1, 0, 0, 1], known(4) = [-1.0_wp/6, 0.0_wp, 0.0_wp, &
                                                                      0.0_wp]
      real(wp), parameter :: middle(4) = [1.5_wp, 0.5_wp, 1.5_wp, 1.5_wp]
      integer :: i

      do i = 1, 4
         options = at_tolerance(1.0_wp)
         options%past_kept = past_kept(i)
         problem = linear()
         problem%lag = [0.5_wp]
         continuation = continuation_type()
         call run(error, problem, 0.0_wp, middle(i), options, outcome, continuation=continuation)
         if (i == 4) call drop_steps(continuation)
         problem%lag = [1.0_wp]
         call integrate(problem, middle(i), middle(i) + 0.5_wp, options, outcome, failure, &
                        continuation=continuation)
         if (i <= 2) then
            call expect_success(error, failure)
            call expect_close(error, outcome%y, known(i:i), 1.0e-14_wp, "the end")
         else
            call expect_failure(error, failure, "reaches beyond the past that the continuation")
         end if
      end do
   end subroutine test_longer_lag

   !> A continuation whose steps a caller dropped.
   pure subroutine drop_steps(continuation)
      type(continuation_type), intent(inout) :: continuation

      continuation%step_start = continuation%step_start(:, :0)
      continuation%step_length = continuation%step_length(:0)
      continuation%valid_for = continuation%valid_for(:0)
      continuation%nodes = continuation%nodes(:, :0)
      continuation%coefficients = continuation%coefficients(:, :, :0)
   end subroutine drop_steps

   !> Three steps at a time to the end.
   subroutine test_too_many_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i, runs

      do i = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(i))
         options%most_steps = 3
         continuation = continuation_type()
         outcome%t = 0.0_wp
         do runs = 1, 1000
            call integrate(sine(), continuation%time(1), 20.0_wp, options, outcome, failure, &
                           continuation=continuation)
            if (outcome%reason /= too_many_steps) exit
         end do
         call expect_success(error, failure)
         call expect_between(error, real(runs, wp), 3.0_wp, 200.0_wp, "runs of "//methods(i))
         call expect_close(error, outcome%y, [sin(20.0_wp)], 1.0e-7_wp, methods(i))
      end do
   end subroutine test_too_many_steps

   !> Each rising passage of sin t through 1/2, and each falling one of its slope, ends a run; the
   !> next goes on and does not meet the same event again. Watchers for each take turns.
   subroutine test_events(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: tables(2)
      type(continuation_type) :: continuation
      type(integration_result) :: outcome
      integer, parameter :: turn(9) = [1, 2, 1, 2, 1, 2, 2, 2, 2]
      integer, parameter :: cycle_of(9) = [0, 0, 1, 1, 2, 2, 3, 4, 5]
      real(wp), parameter :: phase(2) = [pi/6, acos(0.3_wp)]
      integer :: i, k

      do i = 1, size(methods)
         continuation = continuation_type()
         tables(1) = event_table([1], [0.5_wp], [1], terminal=[.true.])
         tables(2) = event_table([1], [0.3_wp], [-1], terminal=[.true.], of_slope=[.true.])
         do k = 1, size(turn)
            call run(error, sine(), continuation%time(1), 100.0_wp, &
                     at_tolerance(1.0e-12_wp, methods(i)), outcome, watcher=tables(turn(k)), &
                     continuation=continuation)
            call expect(error, outcome%reason == event_met, "the reason is `event_met`")
            call expect_close(error, outcome%t, phase(turn(k)) + 2*pi*cycle_of(k), 1.0e-9_wp, &
                              methods(i)//", event "//text(k))
         end do
      end do
   end subroutine test_events

   !> What was written to a file and read back gives the same bits.
   subroutine test_file(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: one, other
      type(integration_result) :: here, there
      integer :: i

      do i = 1, size(methods)
         one = continuation_type()
         call run(error, sine(), 0.0_wp, 7.3_wp, at_tolerance(1.0e-9_wp, methods(i)), here, &
                  continuation=one)
         if (allocated(error)) return
         other = through_file(one)
         call run(error, sine(), 7.3_wp, 20.0_wp, at_tolerance(1.0e-9_wp, methods(i)), here, &
                  continuation=one)
         call run(error, sine(), 7.3_wp, 20.0_wp, at_tolerance(1.0e-9_wp, methods(i)), there, &
                  continuation=other)
         call expect_close(error, there%y, here%y, 0.0_wp, methods(i))
         call expect(error, there%evaluations == here%evaluations, "the same work")
      end do
   end subroutine test_file

   !> What comes back from a text file that was written, with all digits, and read.
   function through_file(kept) result(back)
      type(continuation_type), intent(in) :: kept
      type(continuation_type) :: back
      integer :: unit

      allocate (back%y, back%slope, back%rate, mold=kept%y)
      allocate (back%kink, mold=kept%kink)
      allocate (back%passages, back%generation, mold=kept%passages)
      allocate (back%kept, mold=kept%kept)
      allocate (back%step_start, mold=kept%step_start)
      allocate (back%step_length, back%valid_for, mold=kept%step_length)
      allocate (back%nodes, mold=kept%nodes)
      allocate (back%coefficients, mold=kept%coefficients)
      open (newunit=unit, status="scratch", action="readwrite", form="formatted")
      write (unit, "(*(es27.17e4))") kept%time, kept%origin, kept%y, kept%slope, kept%rate, &
         kept%next_step, kept%kink, kept%step_start, kept%step_length, kept%valid_for, &
         kept%nodes, kept%coefficients
      write (unit, "(a, *(1x, i0))") kept%method, kept%passages, kept%generation, kept%kept
      rewind (unit)
      read (unit, *) back%time, back%origin, back%y, back%slope, back%rate, &
         back%next_step, back%kink, back%step_start, back%step_length, back%valid_for, &
         back%nodes, back%coefficients
      read (unit, *) back%method, back%passages, back%generation, back%kept
      close (unit)
   end function through_file

   !> Run after run from 0, the last ends in this state.
   subroutine expect_end(error, problem, ends, options, known, within, what)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: ends(:)
      type(integration_options), intent(in) :: options
      real(wp), intent(in) :: known(:), within
      character(len=*), intent(in) :: what
      type(continuation_type) :: continuation
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(ends)
         call run(error, problem, continuation%time(1), ends(i), options, outcome, &
                  continuation=continuation)
      end do
      call expect_close(error, outcome%y, known, within, what)
   end subroutine expect_end

   !> A fast oscillator at t = 100, whose phase is lost with less than a spacing of t, in runs of a
   !> hundred steps.
   subroutine test_runs(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp), parameter :: spacing_of_100 = 2.0_wp**(-46), turns = 1.1_wp*128
      real(wp) :: t_start
      integer :: i, runs

      do i = 1, size(methods)
         options = at_tolerance(1.0e-12_wp, methods(i))
         options%most_steps = 100
         continuation = continuation_type()
         t_start = 100.0_wp
         do runs = 1, 1000
            call integrate(swing(turns*2*pi/(64*spacing_of_100)), t_start, &
                           100.0_wp + 64*spacing_of_100, options, outcome, failure, &
                           continuation=continuation)
            t_start = outcome%t
            if (outcome%reason /= too_many_steps) exit
         end do
         call expect_success(error, failure)
         call expect(error, runs > 3, "several runs")
         call expect_close(error, outcome%y, [cos(turns*2*pi), -sin(turns*2*pi)], 1.0e-8_wp, &
                           methods(i))
      end do
   end subroutine test_runs

   !> A cut costs a step, not those of a whole delay.
   subroutine test_pieces(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(integration_result) :: outcome, whole
      integer, parameter :: pieces = 20
      integer(int64) :: steps
      integer :: i

      call run(error, mackey_glass(), 0.0_wp, 600.0_wp, at_tolerance(1.0e-10_wp, "taylor"), whole)
      steps = 0
      do i = 1, pieces
         call run(error, mackey_glass(), (i - 1)*600.0_wp/pieces, i*600.0_wp/pieces, &
                  at_tolerance(1.0e-10_wp, "taylor"), outcome, continuation=continuation)
         if (allocated(error)) return
         steps = steps + outcome%accepted
      end do
      call expect_close(error, outcome%y, whole%y, 1.0e-6_wp, "the end")
      call expect(error, steps <= whole%accepted + pieces, text(steps)//" steps in pieces, " &
                  //text(whole%accepted)//" in one")
   end subroutine test_pieces

   !> The oldest step may begin a rounding after t - lag, 83 here; not more.
   subroutine test_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: known, outcome
      real(wp), parameter :: late(2) = [spacing(100.0_wp), 1.0e-9_wp]
      integer :: i

      call run(error, mackey_glass(), 0.0_wp, 110.0_wp, at_tolerance(1.0e-10_wp, "taylor"), known)
      do i = 1, size(late)
         continuation = continuation_type()
         ! the end of the first run is the start of the oldest step kept by the second
         call run(error, mackey_glass(), 0.0_wp, 83.0_wp, at_tolerance(1.0e-10_wp, "taylor"), &
                  outcome, continuation=continuation)
         call run(error, mackey_glass(), 83.0_wp, 100.0_wp, at_tolerance(1.0e-10_wp, "taylor"), &
                  outcome, continuation=continuation)
         if (allocated(error)) return
         associate (start => continuation%step_start(:, 1))
            call expect_close(error, start, [83.0_wp, 0.0_wp], 0.0_wp, "the oldest step")
            start(1) = start(1) + late(i)
         end associate
         call integrate(mackey_glass(), 100.0_wp, 110.0_wp, at_tolerance(1.0e-10_wp, "taylor"), &
                        outcome, failure, continuation=continuation)
         if (i == 1) then
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect_close(error, outcome%y, known%y, 1.0e-8_wp, "the end")
         else
            call expect_failure(error, failure, "reaches beyond the past")
         end if
      end do
   end subroutine test_rounding
end module test_dde_continuation
