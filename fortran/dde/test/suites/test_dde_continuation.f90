!> Runs that go on from where one ended: they agree with the exact solution as one run does.
module test_dde_continuation
   use dde, only: continuation_type, dde_problem_type, event_met, event_table, integrate, &
                  integration_options, integration_result, methods, too_many_steps
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_failure, &
                           expect_success
   use files_of_continuations, only: through_file
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: infection, mackey_glass
   use solving, only: at_tolerance
   use test_problems, only: linear, sine
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_continuation

   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> All tests of this suite.
   subroutine collect_dde_continuation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("with a delay", test_sine), &
                   new_unittest("two delays", test_infection), &
                   new_unittest("without delays", test_oscillator), &
                   new_unittest("kinks are landed on", test_kink), &
                   new_unittest("kinks are counted on", test_passages), &
                   new_unittest("another rate", test_rate), &
                   new_unittest("another delay", test_lag), &
                   new_unittest("a longer delay", test_longer_lag), &
                   new_unittest("when steps run out", test_too_many_steps), &
                   new_unittest("from event to event", test_events), &
                   new_unittest("through a file", test_file), &
                   new_unittest("names of methods", test_names), &
                   new_unittest("within a spacing of t", test_runs), &
                   new_unittest("Taylor steps in pieces", test_pieces), &
                   new_unittest("rounding of the oldest step", test_rounding)]
   end subroutine collect_dde_continuation

   !> Each method that a caller may choose runs, and none runs in place of another.
   subroutine test_names(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         if (methods(i) == "auto") cycle
         continuation = continuation_type()
         call integrate(sine(), 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp, methods(i)), outcome, &
                        failure, continuation=continuation)
         call expect_success(error, failure)
         call expect(error, continuation%method == methods(i), continuation%method//" for " &
                     //methods(i))
      end do
   end subroutine test_names

   !> y = sin t, in the middle of the first delay, at its end, and on.
   subroutine test_sine(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: ends(7) = [0.7_wp, 0.8_wp, 0.5_wp*pi, pi, 4.0_wp, 19.0_wp, 30.0_wp]
      integer :: i

      do i = 1, size(methods)
         call expect_end(error, sine(), ends, at_tolerance(1.0e-10_wp, methods(i)), &
                         [sin(30.0_wp)], 1.0e-8_wp, trim(methods(i)))
      end do
   end subroutine test_sine

   !> The published values of the infection problem.
   subroutine test_infection(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: ends(7) = [0.5_wp, 1.0_wp, 3.7_wp, 10.0_wp, 11.0_wp, 25.0_wp, 40.0_wp]
      integer :: i

      do i = 1, size(methods)
         call expect_end(error, infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], &
                                          past=[5.0_wp, 0.1_wp, 1.0_wp], &
                                          first=[5.0_wp, 0.1_wp, 1.0_wp]), &
                         ends, at_tolerance(1.0e-10_wp, methods(i)), &
                         [0.0912491205664_wp, 0.0202995003351_wp, 5.9884513791_wp], 2.0e-8_wp, &
                         trim(methods(i)))
      end do
   end subroutine test_infection

   !> Without delays only state and time go on.
   subroutine test_oscillator(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(methods)
         call expect_end(error, swing(), [0.1_wp, 5.0_wp, 20.0_wp], &
                         at_tolerance(1.0e-10_wp, methods(i)), [cos(20.0_wp), -sin(20.0_wp)], &
                         1.0e-8_wp, trim(methods(i)))
      end do
   end subroutine test_oscillator

   !> Where all kinks are still landed on, piecewise polynomials come out exact at any tolerance:
   !> with a kink and with a jump, which is one passage rougher.
   subroutine test_kink(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: ends(6) = [0.3_wp, 1.0_wp, 2.2_wp, 2.3_wp, 4.0_wp, 5.0_wp]

      call expect_end(error, decay(past=1.0_wp), ends, at_tolerance(1.0_wp), [19.0_wp/120], &
                      1.0e-14_wp, "kink")
      call expect_end(error, decay(past=0.0_wp), ends, at_tolerance(1.0_wp), [5.0_wp/24], &
                      1.0e-14_wp, "jump")
   end subroutine test_kink

   !> Seven passages of a kink and eight of a jump are landed on, three in the run before t = 3.5.
   subroutine test_passages(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: first, second
      integer :: jump

      do jump = 0, 1
         continuation = continuation_type()
         call integrate(decay(past=1.0_wp - jump), 0.0_wp, 3.5_wp, at_tolerance(1.0e-6_wp), first, &
                        failure, continuation=continuation)
         call expect_success(error, failure)
         call integrate(decay(past=1.0_wp - jump), 3.5_wp, 30.0_wp, at_tolerance(1.0e-6_wp), &
                        second, failure, continuation=continuation)
         call expect_success(error, failure)
         call expect(error, first%breaking_points == 3, "three in the first run")
         call expect(error, second%breaking_points == 4 + jump, text(4 + jump) &
                     //" in the second, but "//text(second%breaking_points))
      end do
   end subroutine test_passages

   !> y' = -y(t - 1), and -2 y(t - 1) from 3/2 on: a kink there and at 5/2. y(3) = 1/8 by hand.
   subroutine test_rate(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(linear) :: problem

      problem = decay(past=1.0_wp)
      call integrate(problem, 0.0_wp, 1.5_wp, at_tolerance(1.0_wp), outcome, failure, &
                     continuation=continuation)
      problem%rate = 2.0_wp
      call integrate(problem, 1.5_wp, 3.0_wp, at_tolerance(1.0_wp), outcome, failure, &
                     continuation=continuation)
      call expect_success(error, failure)
      call expect_close(error, outcome%y, [0.125_wp], 1.0e-14_wp, "y(3)")
      call expect(error, outcome%breaking_points == 2, "2 and 5/2 are landed on")
   end subroutine test_rate

   !> y' = -y(t - 1), and -y(t - 1/2) from 3/2 on. y(5/2) = -13/128 by hand.
   subroutine test_lag(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(linear) :: problem

      problem = decay(past=1.0_wp)
      call integrate(problem, 0.0_wp, 1.5_wp, at_tolerance(1.0_wp), outcome, failure, &
                     continuation=continuation)
      problem%lag = [0.5_wp]
      call integrate(problem, 1.5_wp, 2.5_wp, at_tolerance(1.0_wp), outcome, failure, &
                     continuation=continuation)
      call expect_success(error, failure)
      call expect_close(error, outcome%y, [-13.0_wp/128], 1.0e-14_wp, "y(5/2)")
   end subroutine test_lag

   !> y' = -y(t - 1/2), and -y(t - 1) from 3/2 on. y(2) = -1/6 by hand. The first run must keep a
   !> past of 1.
   subroutine test_longer_lag(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(linear) :: problem
      real(wp) :: past_kept(2)
      integer :: i

      past_kept = [1.0_wp, 0.0_wp]
      do i = 1, 2
         options = at_tolerance(1.0_wp)
         options%past_kept = past_kept(i)
         problem = decay(past=1.0_wp)
         problem%lag = [0.5_wp]
         continuation = continuation_type()
         call integrate(problem, 0.0_wp, 1.5_wp, options, outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
         problem%lag = [1.0_wp]
         call integrate(problem, 1.5_wp, 2.0_wp, options, outcome, failure, &
                        continuation=continuation)
         if (i == 1) then
            call expect_success(error, failure)
            call expect_close(error, outcome%y, [-1.0_wp/6], 1.0e-14_wp, "y(2)")
         else
            call expect_failure(error, failure, "reaches beyond the past that the continuation")
         end if
      end do
   end subroutine test_longer_lag

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
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i, k

      do i = 1, size(methods)
         continuation = continuation_type()
         tables(1) = event_table([1], [0.5_wp], [1], terminal=[.true.])
         tables(2) = event_table([1], [0.3_wp], [-1], terminal=[.true.], of_slope=[.true.])
         do k = 0, 2
            call integrate(sine(), continuation%time(1), 100.0_wp, &
                           at_tolerance(1.0e-12_wp, methods(i)), outcome, failure, &
                           watcher=tables(1), continuation=continuation)
            call expect_success(error, failure)
            call expect(error, outcome%reason == event_met, "the reason is `event_met`")
            call expect_close(error, outcome%t, pi/6 + 2*pi*k, 1.0e-9_wp, methods(i)//", 1/2")
            call integrate(sine(), continuation%time(1), 100.0_wp, &
                           at_tolerance(1.0e-12_wp, methods(i)), outcome, failure, &
                           watcher=tables(2), continuation=continuation)
            call expect_success(error, failure)
            call expect_close(error, outcome%t, acos(0.3_wp) + 2*pi*k, 1.0e-9_wp, &
                              methods(i)//", slope")
         end do
         do k = 3, 5
            call integrate(sine(), continuation%time(1), 100.0_wp, &
                           at_tolerance(1.0e-12_wp, methods(i)), outcome, failure, &
                           watcher=tables(2), continuation=continuation)
            call expect_success(error, failure)
            call expect_close(error, outcome%t, acos(0.3_wp) + 2*pi*k, 1.0e-9_wp, &
                              methods(i)//", slopes")
         end do
      end do
   end subroutine test_events

   !> What was written to a file and read back, as bits and as text, gives the same bits.
   subroutine test_file(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: first, one, other
      type(failure_type), allocatable :: failure
      type(integration_result) :: here, there
      integer :: i, k

      do i = 1, size(methods)
         first = continuation_type()
         call integrate(sine(), 0.0_wp, 7.3_wp, at_tolerance(1.0e-9_wp, methods(i)), here, &
                        failure, continuation=first)
         call expect_success(error, failure)
         do k = 1, 2
            one = first
            other = through_file(first, formatted=k == 2)
            call integrate(sine(), 7.3_wp, 20.0_wp, at_tolerance(1.0e-9_wp, methods(i)), here, &
                           failure, continuation=one)
            call expect_success(error, failure)
            call integrate(sine(), 7.3_wp, 20.0_wp, at_tolerance(1.0e-9_wp, methods(i)), there, &
                           failure, continuation=other)
            call expect_success(error, failure)
            call expect_close(error, there%y, here%y, 0.0_wp, methods(i)//", file "//text(k))
            call expect(error, there%evaluations == here%evaluations, "the same work")
         end do
      end do
   end subroutine test_file

   !> Run after run from 0, the last ends in this state.
   subroutine expect_end(error, problem, ends, options, known, within, what)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> End of each run, ascending
      real(wp), intent(in) :: ends(:)
      !> Tolerances
      type(integration_options), intent(in) :: options
      !> Last state
      real(wp), intent(in) :: known(:)
      !> Largest difference
      real(wp), intent(in) :: within
      !> What it is
      character(len=*), intent(in) :: what
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(ends)
         call integrate(problem, continuation%time(1), ends(i), options, outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
      end do
      call expect_close(error, outcome%y, known, within, what)
   end subroutine expect_end

   !> y' = -y(t - 1), y(0) = 1.
   pure type(linear) function decay(past) result(problem)
      !> y before t = 0
      real(wp), intent(in) :: past

      problem = linear(n=1, lag=[1.0_wp], component=[1], past=[past], first=[1.0_wp])
   end function decay

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
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome, whole
      integer, parameter :: pieces = 20
      integer(int64) :: steps
      integer :: i

      call integrate(chaotic(), 0.0_wp, 600.0_wp, by_taylor(), whole, failure)
      call expect_success(error, failure)
      steps = 0
      do i = 1, pieces
         call integrate(chaotic(), (i - 1)*600.0_wp/pieces, i*600.0_wp/pieces, &
                        by_taylor(), outcome, failure, continuation=continuation)
         call expect_success(error, failure)
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

      call integrate(chaotic(), 0.0_wp, 110.0_wp, by_taylor(), known, failure)
      call expect_success(error, failure)
      do i = 1, size(late)
         continuation = continuation_type()
         ! the end of the first run is the start of the oldest step kept by the second
         call integrate(chaotic(), 0.0_wp, 83.0_wp, by_taylor(), outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
         call integrate(chaotic(), 83.0_wp, 100.0_wp, by_taylor(), outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
         if (allocated(error)) return
         associate (start => continuation%step_start(:, 1))
            call expect_close(error, start, [83.0_wp, 0.0_wp], 0.0_wp, "the oldest step")
            start(1) = start(1) + late(i)
         end associate
         call integrate(chaotic(), 100.0_wp, 110.0_wp, by_taylor(), outcome, failure, &
                        continuation=continuation)
         if (i == 1) then
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect_close(error, outcome%y, known%y, 1.0e-8_wp, "the end")
         else
            call expect_failure(error, failure, "reaches beyond the past")
         end if
      end do
   end subroutine test_rounding

   !> Taylor steps.
   type(integration_options) function by_taylor() result(options)
      options = at_tolerance(1.0e-10_wp, "taylor")
   end function by_taylor

   !> Mackey and Glass's equation.
   type(mackey_glass) function chaotic() result(problem)
      problem = mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], first=[1.2_wp])
   end function chaotic
end module test_dde_continuation
