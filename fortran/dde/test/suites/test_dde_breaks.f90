! SPDX-License-Identifier: BSD-3-Clause
!> Kinks and jumps: steps end at each that matters, so that piecewise polynomials come out exact at
!> any tolerance. They come from delays, from the caller, from changes between runs and from
!> switching functions.
module test_dde_breaks
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: delayed_pulse, jumping_history, many_delays, sided
   use pseudo_random, only: uniform
   use solving, only: at_tolerance, run, solve
   use test_problems, only: linear, wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_breaks

   !> Methods that do not need a series.
   character(len=8), parameter :: methods(6) = [character(len=8) :: "bs5", "dop853", "radau5", &
                                                "radau9", "radau13", "auto"]
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_dde_breaks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("breaking points", test_points), &
                   new_unittest("kinks are landed on", test_landing), &
                   new_unittest("jumps are landed on", test_jumps), &
                   new_unittest("changes between runs", test_changes), &
                   new_unittest("the past that is kept", test_past_kept), &
                   new_unittest("many doses", test_doses), &
                   new_unittest("many delays", test_many_delays), &
                   new_unittest("a relay that goes on from an event", test_relay), &
                   new_unittest("dry friction", test_friction), &
                   new_unittest("events that change the state", test_acts)]
   end subroutine collect_dde_breaks

   !> A method of order 8 needs a continuous eighth derivative: a kink is landed on 7 times, a jump
   !> 8 times, as far as the multiples of the delay lie before the end. Two delays are counted by
   !> hand. Delays 1 and 0.2 to t = 2.1: 0.2, 0.4, .. 2.0, where many sums meet. Delays 1 and 0.1 to
   !> t = 1.85: 0.1 .. 0.7, 1.0 .. 1.6, for 0.8 and 1.7 are sums of eight. Delays 1 and sqrt 2 to
   !> t = 4.5: 4, 4, 2 and 1 with 0, 1, 2 and 3 times the root.
   subroutine test_points(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_points(linear(), 30.0_wp, 7)
      call expect_points(linear(past=[0.0_wp]), 30.0_wp, 8)
      call expect_points(linear(), 3.5_wp, 3)
      call expect_points(linear(past=[0.0_wp]), 3.5_wp, 3)
      call expect_points(linear(), 3.0_wp, 2)
      call expect_points(linear(), 1.0_wp, 0)
      call expect_points(linear(past=[0.0_wp]), 8.5_wp, 8)
      call expect_points(linear(), 8.5_wp, 7)
      call expect_points(wille_baker(), 2.1_wp, 10)
      call expect_points(wille_baker(lag=[1.0_wp, 0.1_wp]), 1.85_wp, 14)
      call expect_points(wille_baker(lag=[1.0_wp, sqrt(2.0_wp)]), 4.5_wp, 11)

   contains

      subroutine expect_points(problem, t_end, points)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: t_end
         integer, intent(in) :: points
         type(integration_result) :: outcome

         call run(error, problem, 0.0_wp, t_end, at_tolerance(1.0e-6_wp), outcome)
         call expect(error, outcome%breaking_points == points, text(points) &
                     //" breaking points before t = "//text(t_end)//", but " &
                     //text(outcome%breaking_points))
      end subroutine expect_points
   end subroutine test_points

   !> Piecewise polynomials up to degree 7 by the method of order 8: with one delay and with two.
   subroutine test_landing(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      real(wp), parameter :: time(28) = [(0.25_wp*i, i=1, 28)]
      real(wp), allocatable :: y(:, :)

      call solve(linear(), time, at_tolerance(1.0_wp), y, error)
      call expect_close(error, y(1, :), [(decayed(time(i) + 1.0_wp), i=1, size(time))], &
                        1.0e-14_wp, "y with a kink")
      call solve(linear(past=[0.0_wp]), time, at_tolerance(1.0_wp), y, error)
      call expect_close(error, y(1, :), [(decayed(time(i)), i=1, size(time))], 1.0e-14_wp, &
                        "y with a jump")
      call solve(wille_baker(), [1.0_wp], at_tolerance(1.0_wp), y, error)
      call expect_close(error, y(:, 1), [2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], &
                        1.0e-14_wp, "y(1)")
   end subroutine test_landing

   !> Exact solution of y' = -y(t - 1), y(0) = 1: the sum of (-1)^k (s - k)^k/k! over 0 <= k <= s,
   !> where s = t after a jump and t + 1 without one.
   pure real(wp) function decayed(s) result(y)
      real(wp), intent(in) :: s
      integer :: k

      y = sum([((-1)**k*(s - k)**k/gamma(k + 1.0_wp), k=0, floor(s))])
   end function decayed

   !> Of the right-hand side in time (runs end within the pulse and go on), of the history, and of
   !> switching functions: of a delayed value, and of time faster than the steps between them would
   !> be.
   subroutine test_jumps(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(methods)
         call expect_exact(delayed_pulse(), [50.1_wp, 50.0_wp, 80.0_wp], &
                           [50.05_wp, 50.1_wp, 51.0_wp, 55.0_wp], [10.0_wp, 39.5_wp], 1.0e-10_wp)
         call expect_exact(jumping_history(0.0_wp), [-0.5_wp], [2.5_wp], [0.875_wp], 1.0e-13_wp)
         call expect_exact(sided("relay"), [real(wp) ::], [21.25_wp], [-0.25_wp], 1.0e-12_wp)
         call expect_exact(sided("pulses"), [real(wp) ::], [10.0_wp*pi], [5.0_wp*pi], 1.0e-10_wp)
      end do

   contains

      subroutine expect_exact(problem, break_at, ends, known, within)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: break_at(:), ends(:), known(:), within
         type(continuation_type) :: state
         type(integration_options) :: options
         type(integration_result) :: outcome
         integer :: part

         options = at_tolerance(1.0e-3_wp, methods(i))
         options%break_at = break_at
         do part = 1, size(ends)
            call run(error, problem, state%time(1), ends(part), options, outcome, &
                     continuation=state)
            if (allocated(error)) return
         end do
         call expect_close(error, outcome%y, known, within, methods(i))
      end subroutine expect_exact
   end subroutine test_jumps

   !> y' = -y(t - 1) up to t = 3/2, then -2 y(t - 1), with a kink there and at 5/2, or -y(t - 1/2):
   !> y(3) = 1/8 and y(5/2) = -13/128 by hand. y' = y(t - 1) from rest, put to 1 at t = 5/2: 7/2 at
   !> t = 11/2.
   subroutine test_changes(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: faster, shorter, state
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(linear) :: problem
      integer :: i

      call run(error, linear(), 0.0_wp, 1.5_wp, at_tolerance(1.0_wp), outcome, continuation=faster)
      shorter = faster
      call run(error, linear(rate=2.0_wp), 1.5_wp, 3.0_wp, at_tolerance(1.0_wp), outcome, &
               continuation=faster)
      call expect_close(error, outcome%y, [0.125_wp], 1.0e-14_wp, "y(3)")
      call expect(error, outcome%breaking_points == 2, "2 and 5/2 are landed on")
      call run(error, linear(lag=[0.5_wp]), 1.5_wp, 2.5_wp, at_tolerance(1.0_wp), outcome, &
               continuation=shorter)
      call expect_close(error, outcome%y, [-13.0_wp/128], 1.0e-14_wp, "y(5/2)")
      problem = linear(past=[0.0_wp], first=[0.0_wp], rate=-1.0_wp)
      do i = 1, size(methods)
         state = continuation_type()
         call run(error, problem, 0.0_wp, 2.5_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome, &
                  continuation=state)
         call state%change_state([1.0_wp], failure)
         call expect_success(error, failure)
         call run(error, problem, 2.5_wp, 5.5_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome, &
                  continuation=state)
         call expect_close(error, outcome%y, [3.5_wp], 1.0e-13_wp, methods(i))
      end do
   end subroutine test_changes

   !> y' = -y(t - 1/2), and -y(t - 1) from 3/2 on: y(2) = -1/6 by hand. The first run must keep a
   !> past of 1. From 1/2 on, y(1) = 0: the history of the problem holds before the first run. The
   !> oldest step may begin a rounding after t - lag; not more.
   subroutine test_past_kept(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: past_kept(5) = [1, 0, 0, 1, 1]
      real(wp), parameter :: known(5) = [-1.0_wp/6, 0.0_wp, 0.0_wp, -1.0_wp/6, 0.0_wp]
      real(wp), parameter :: middle(5) = [1.5_wp, 0.5_wp, 1.5_wp, 1.5_wp, 1.5_wp]
      real(wp), parameter :: late(5) = [0.0_wp, 0.0_wp, 0.0_wp, spacing(0.5_wp), 1.0e-9_wp]
      logical, parameter :: fails(5) = [.false., .false., .true., .false., .true.]
      type(continuation_type) :: state
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(known)
         options = at_tolerance(1.0_wp)
         options%past_kept = past_kept(i)
         state = continuation_type()
         call run(error, linear(lag=[0.5_wp]), 0.0_wp, middle(i), options, outcome, &
                  continuation=state)
         if (allocated(error)) return
         if (late(i) > 0.0_wp) then
            call expect_close(error, state%step_start(:, 1), [0.5_wp, 0.0_wp], 0.0_wp, "the oldest")
            state%step_start(1, 1) = state%step_start(1, 1) + late(i)
         end if
         call integrate(linear(), middle(i), middle(i) + 0.5_wp, options, outcome, failure, &
                        continuation=state)
         if (fails(i)) then
            call expect_failure(error, failure, "reaches beyond the past that the continuation")
         else
            call expect_success(error, failure)
            call expect_close(error, outcome%y, known(i:i), 1.0e-14_wp, "the end")
         end if
      end do
   end subroutine test_past_kept

   !> A hundred thousand points at which the right-hand side may jump. Where each cost a look at all
   !> others this took minutes.
   subroutine test_doses(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer, parameter :: doses = 100000
      integer :: i

      options = at_tolerance(1.0e-3_wp, "bs5")
      options%break_at = [(i*1.0e-3_wp, i=1, doses)]
      call run(error, linear(), 0.0_wp, doses*1.0e-3_wp, options, outcome)
      call expect(error, outcome%breaking_points >= doses - 1, "a step ends at each")
   end subroutine test_doses

   !> Random delays from 1/2 to 3/2, t = 10: no more than three times the steps that landing on the
   !> first generation alone takes, which is all delays and 20 steps for 1e-6, half as many steps as
   !> delays if these are very many, and errors as small as the tolerance allows.
   subroutine test_many_delays(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: counts(4) = [10, 20, 100, 2000]
      type(integration_result) :: fine, outcome
      integer :: i, k

      do i = 1, size(counts)
         associate (lags => uniform(i, counts(i), 0.5_wp, 1.5_wp))
            call run(error, many_delays(lags), 0.0_wp, 10.0_wp, at_tolerance(1.0e-11_wp), fine)
            do k = 1, size(methods)
               call run(error, many_delays(lags), 0.0_wp, 10.0_wp, &
                        at_tolerance(1.0e-6_wp, methods(k)), outcome)
               call expect(error, outcome%accepted <= min(3*(20 + counts(i)), 800), &
                           text(outcome%accepted)//" steps for "//text(counts(i))//" delays")
               call expect_close(error, outcome%y, fine%y, &
                                 1.0e-5_wp*max(1.0_wp, maxval(abs(fine%y))), methods(k))
            end do
         end associate
      end do
   end subroutine test_many_delays

   !> It changes sides ten times, and ends in the same state from where an event ended a run.
   subroutine test_relay(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(integration_result) :: outcome
      type(event_table) :: events
      type(integration_options) :: options
      integer :: i

      do i = 1, size(methods)
         options = at_tolerance(1.0e-3_wp, methods(i))
         call run(error, sided("relay"), 0.0_wp, 21.25_wp, options, outcome)
         call expect(error, outcome%switched(1) == 10, methods(i)//" changes sides 10 times")
         events = event_table([1], [-0.5_wp], [1], [.true.])
         state = continuation_type()
         call run(error, sided("relay"), 0.0_wp, 21.25_wp, options, outcome, watcher=events, &
                  continuation=state)
         call expect_close(error, outcome%t, 2.5_wp, 1.0e-13_wp, "the event")
         call run(error, sided("relay"), state%time(1), 21.25_wp, options, outcome, &
                  continuation=state)
         call expect_close(error, outcome%y, [-0.25_wp], 1.0e-12_wp, methods(i)//" continued")
      end do
   end subroutine test_relay

   !> Events that change the state: after five bounces, each half as fast, a delayed velocity has
   !> followed; after ten resets a delayed state; two at one time but for rounding keep their order.
   !> A ball that bounces faster and faster, and a relay without a delay, cannot go on.
   subroutine test_acts(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp), parameter :: period = log(2.0_wp), late = 10.4_wp*period - 0.5_wp
      real(wp) :: since
      integer :: i

      do i = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(i))
         call run(error, sided("ball"), 0.0_wp, 2.9_wp, options, outcome)
         call expect(error, outcome%switched(1) == 5, methods(i)//" bounces 5 times")
         call expect_close(error, outcome%y, [0.025_wp/32 - 0.025_wp**2/2, 1.0_wp/32 - 0.025_wp, &
                                              0.15_wp/8 - 0.15_wp**2/2 - 0.5_wp], 1.0e-8_wp, &
                           methods(i)//" bounces")
         call integrate(sided("ball"), 0.0_wp, 4.0_wp, options, outcome, failure)
         call expect_failure(error, failure, "events follow each other without end: switching(")
         call expect_close(error, outcome%t, 3.0_wp, 1.0e-7_wp, methods(i)//" comes to rest")
         call run(error, sided("neuron"), 0.0_wp, 10.4_wp*period, options, outcome)
         call expect(error, outcome%switched(1) == 10, methods(i)//" fires 10 times")
         since = late - 9.0_wp*period
         call expect_close(error, outcome%y, [2.0_wp - 2.0_wp*exp(-0.4_wp*period), &
                                              9.0_wp*(2.0_wp*period - 1.0_wp) + 2.0_wp*since &
                                              - 2.0_wp*(1.0_wp - exp(-since))], 1.0e-7_wp, &
                           methods(i)//" is reset")
         call run(error, sided("order"), 0.0_wp, 1.0_wp, options, outcome)
         call expect_close(error, outcome%y, [1.0_wp, 4.0_wp], 1.0e-12_wp, methods(i)//" in order")
         call integrate(sided("chatter"), 0.0_wp, 2.0_wp, options, outcome, failure)
         call expect_failure(error, failure, "events follow each other without end: switching(")
         call expect_close(error, outcome%t, 1.0_wp, 1.0e-12_wp, methods(i)//" chatters")
      end do
   end subroutine test_acts

   !> Two oscillators change sides at one time, and stay at rest after five half periods.
   subroutine test_friction(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp), parameter :: angle = 10.0_wp - 3.0_wp*pi
      integer :: i

      do i = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(i))
         call run(error, sided("friction"), 0.0_wp, 10.0_wp, options, outcome)
         associate (y => [-0.1_wp - 0.3_wp*cos(angle), 0.3_wp*sin(angle)])
            call expect_close(error, outcome%y, [y, y], 1.0e-7_wp, methods(i))
         end associate
         call expect(error, all(outcome%switched == 3), methods(i)//" changes sides 3 times")
         call integrate(sided("friction"), 0.0_wp, 20.0_wp, options, outcome, failure)
         call expect_failure(error, failure, "from both sides of the zero of switching(")
         call expect_close(error, outcome%t, 5.0_wp*pi, 1.0e-4_wp, methods(i)//" stops")
      end do
   end subroutine test_friction
end module test_dde_breaks
