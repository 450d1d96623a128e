! SPDX-License-Identifier: BSD-3-Clause
!> Events: where they are found, in what order, and that one can end a run.
module test_dde_events
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: continuation_type, dde_problem_type, elapsed, event_met, event_table, instant, &
                  integration_options, integration_result, methods, reached_end, table_sampler
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: mackey_glass
   use solving, only: at_tolerance, run
   use test_problems, only: linear, sine
   use undelayed_problems, only: quadrature, swing
   implicit none (type, external)
   private
   public :: collect_dde_events

   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

   !> Passages of sin 50 t, no number where it is near an extreme.
   type, extends(event_table) :: fast_function
   contains
      procedure :: values => fast_values
   end type fast_function

   !> A table of which nothing is known beforehand, so that all steps are searched.
   type, extends(event_table) :: searched_table
   end type searched_table

contains

   subroutine collect_dde_events(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("times of events", test_times), &
                   new_unittest("an event that ends the run", test_terminal), &
                   new_unittest("order of events", test_order), &
                   new_unittest("a fast function of time", test_fast), &
                   new_unittest("steps without events are not searched", test_bounds), &
                   new_unittest("within a spacing of t", test_within_spacing), &
                   new_unittest("a zero where runs meet", test_zero_between), &
                   new_unittest("from event to event", test_turns)]
   end subroutine collect_dde_events

   !> Passages of sin t through 1/2, rising, falling and both; those through 0, that at t = 0 is
   !> none. Maxima and minima of cos t, and maxima of -sin t. t^2 passes 1/4 and 1/100 twice within
   !> one step from -1 to 1, whose ends do not show it; t passes numbers where steps meet. The slope
   !> of y' = -y(t - 1) from 0 with a jump to 1 jumps from 0 to -1 at t = 1, and passes -1/2 there
   !> and again at 5/2.
   subroutine test_times(error)
      type(error_type), allocatable, intent(out) :: error
      logical, parameter :: slopes(3) = .true.
      integer :: i

      do i = 1, size(methods)
         call check(sine(), 0.0_wp, 8.0_wp, &
                    event_table([1, 1, 1, 1], [0.5_wp, 0.5_wp, 0.5_wp, 0.0_wp], [1, -1, 0, 0]), &
                    [1, 1, 5, 5, 6, 12, 13, 13]*pi/6, [1, 3, 2, 3, 4, 4, 1, 3])
         call check(swing(), 0.0_wp, 20.0_wp, &
                    event_table([1, 1, 2], spread(0.0_wp, 1, 3), [-1, 1, -1], of_slope=slopes), &
                    [2, 3, 4, 6, 7, 8, 10, 11, 12]*0.5_wp*pi, [2, 3, 1, 2, 3, 1, 2, 3, 1])
         call check(quadrature(1, 1.0_wp), -1.0_wp, 1.0_wp, &
                    event_table([1, 1], [0.25_wp, 0.01_wp], [0, 0]), &
                    [-0.5_wp, -0.1_wp, 0.1_wp, 0.5_wp], [1, 2, 2, 1], step=2.0_wp)
         call check(quadrature(0, 0.0_wp), 0.0_wp, 3.5_wp, &
                    event_table([1, 1, 1], [1.0_wp, 2.0_wp, 3.0_wp], [0, 0, 0]), &
                    [1.0_wp, 2.0_wp, 3.0_wp], [1, 2, 3], step=1.0_wp)
         call check(linear(past=[0.0_wp]), 0.0_wp, 2.9_wp, &
                    event_table([1], [-0.5_wp], [0], of_slope=slopes(:1)), [1.0_wp, 2.5_wp], [1, 1])
      end do

   contains

      subroutine check(problem, t_start, t_end, watcher, times, which, step)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: t_start, t_end, times(:)
         type(event_table), intent(in) :: watcher
         integer, intent(in) :: which(:)
         !> Length of all steps, if it is given
         real(wp), intent(in), optional :: step
         type(event_table) :: table
         type(integration_options) :: options
         type(integration_result) :: outcome

         options = at_tolerance(1.0e-12_wp, methods(i))
         if (present(step)) options%first_step = step
         if (present(step)) options%longest_step = step
         table = watcher
         call run(error, problem, t_start, t_end, options, outcome, watcher=table)
         call expect(error, outcome%reason == reached_end, "the run goes to its end")
         call expect_events(error, table, times, 1.0e-10_wp, methods(i), which)
         if (allocated(error)) return
         if (present(step)) then
            call expect(error, outcome%accepted == ceiling((t_end - t_start)/step), "steps")
         end if
         if (any(table%of_slope)) return
         call expect_close(error, table%y(1, :table%received), table%level(which), 1.0e-14_wp, "y")
      end subroutine check
   end subroutine test_times

   !> All events: their times and, if given, their functions.
   subroutine expect_events(error, table, times, within, what, which)
      type(error_type), allocatable, intent(inout) :: error
      class(event_table), intent(in) :: table
      real(wp), intent(in) :: times(:), within
      character(len=*), intent(in) :: what
      integer, intent(in), optional :: which(:)

      call expect(error, table%received == size(times), text(table%received)//" events, "//what)
      if (allocated(error)) return
      call expect_close(error, table%time(:table%received)%hi, times, within, what)
      if (present(which)) call expect(error, all(table%which(:table%received) == which), &
                                      "events of other functions, "//what)
   end subroutine expect_events

   !> cos t passes 1/2, then -1/2, which ends the run: state, slope, time and samples stop there.
   !> The table looks at cos t alone, but events have -sin t, too.
   subroutine test_terminal(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: here
      type(event_table) :: table
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      integer :: i

      do i = 1, size(methods)
         here = continuation_type()
         table = event_table([1, 1], [0.5_wp, -0.5_wp], [0, 0], terminal=[.false., .true.])
         samples = table_sampler([2], [0.0_wp, 2.08_wp, 2.09_wp, 2.1_wp, 5.0_wp])
         call run(error, swing(), 0.0_wp, 8.0_wp, at_tolerance(1.0e-12_wp, methods(i)), outcome, &
                  samples, table, here)
         call expect(error, outcome%reason == event_met, "the reason is `event_met`")
         call expect_events(error, table, [pi/3, 2*pi/3], 1.0e-10_wp, methods(i), [1, 2])
         if (allocated(error)) return
         call expect_close(error, table%y(1, :2), [0.5_wp, -0.5_wp], 1.0e-14_wp, "cos t")
         call expect_close(error, table%y(2, :2), -sin([pi/3, 2*pi/3]), 1.0e-10_wp, "-sin t")
         call expect_close(error, outcome%t, table%time(2)%hi, 0.0_wp, "end")
         call expect_close(error, outcome%y, table%y(:, 2), 0.0_wp, "y at the end")
         call expect_close(error, here%slope, [here%y(2), -here%y(1)], 1.0e-9_wp, &
                           methods(i)//", slope")
         call expect(error, samples%received == 3, "samples after it are not taken: " &
                     //text(samples%received))
         call expect_close(error, samples%values(1, 2:3), -sin([2.08_wp, 2.09_wp]), 1.0e-10_wp, &
                           "samples before it")
      end do
   end subroutine test_terminal

   !> y = t passes 1000 levels in one step, each of 100 functions at one time: in order of time,
   !> then of number. The square of their number would be 1e10 comparisons. Of events at one time,
   !> all are handed over, though one of them ends the run; later ones are not.
   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 100000
      type(event_table) :: table
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      options = integration_options("explicit", first_step=1.0_wp)
      table = event_table(spread(1, 1, n), [((1 + modulo(617*i, 1000))/1001.0_wp, i=1, n)], &
                          spread(1, 1, n))
      call run(error, quadrature(0, 0.0_wp), 0.0_wp, 1.0_wp, options, outcome, watcher=table)
      call expect(error, outcome%accepted == 1 .and. table%received == n, "all in one step")
      if (allocated(error)) return
      associate (t => table%time%hi, which => table%which)
         call expect_close(error, t(:n), table%level(which(:n)), 1.0e-14_wp, "times")
         call expect(error, all(t(2:n) > t(:n - 1) .or. which(2:n) > which(:n - 1) &
                                .and. t(2:n) >= t(:n - 1)), "in order")
      end associate
      table = event_table([1, 1, 1], [0.51_wp, 0.5_wp, 0.5_wp], [1, 1, 1], &
                          terminal=[.false., .true., .false.])
      call run(error, quadrature(0, 0.0_wp), 0.0_wp, 1.0_wp, options, outcome, watcher=table)
      call expect_events(error, table, [0.5_wp, 0.5_wp], 1.0e-15_wp, "at one time", [2, 3])
   end subroutine test_order

   !> A function of time that changes much faster than the solution, 1 + t: all of its
   !> zeros k pi/50 up to t = 100, looked at five times between two of them, at no further step.
   subroutine test_fast(error)
      type(error_type), allocatable, intent(out) :: error
      type(fast_function) :: table
      type(integration_result) :: outcome, unwatched
      integer :: i, k

      do i = 1, size(methods)
         table = fast_function(direction=[0], terminal=[.false.])
         table%look_every = 0.0125_wp
         call run(error, quadrature(0, 1.0_wp), 0.0_wp, 100.0_wp, &
                  at_tolerance(1.0e-6_wp, methods(i)), unwatched)
         call run(error, quadrature(0, 1.0_wp), 0.0_wp, 100.0_wp, &
                  at_tolerance(1.0e-6_wp, methods(i)), outcome, watcher=table)
         call expect_events(error, table, [(k*pi/50, k=1, 1591)], 1.0e-9_wp, methods(i))
         call expect(error, outcome%accepted == unwatched%accepted, "as many steps")
      end do
   end subroutine test_fast

   !> Bounds of dense output pass over steps, but over no event of a chaotic motion.
   subroutine test_bounds(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: direction(2) = [0, 0]
      real(wp), parameter :: level(2) = [0.9_wp, 0.0_wp]
      type(event_table) :: table
      type(integration_result) :: outcome
      type(searched_table) :: searched
      integer :: i

      do i = 1, size(methods)
         table = event_table([1, 1], level, direction, of_slope=[.false., .true.])
         searched = searched_table(component=[1, 1], level=level, direction=direction, &
                                   terminal=[.false., .false.], of_slope=[.false., .true.])
         call run(error, mackey_glass(), 0.0_wp, 300.0_wp, at_tolerance(1.0e-6_wp, methods(i)), &
                  outcome, watcher=table)
         call run(error, mackey_glass(), 0.0_wp, 300.0_wp, at_tolerance(1.0e-6_wp, methods(i)), &
                  outcome, watcher=searched)
         if (allocated(error)) return
         call expect(error, searched%received > 20, "many events")
         associate (n => searched%received)
            call expect_events(error, table, searched%time(:n)%hi, 0.0_wp, methods(i), &
                               searched%which(:n))
         end associate
      end do
   end subroutine test_bounds

   !> sin 50 t, no number where it is near an extreme.
   pure subroutine fast_values(self, t, y, slope, g)
      class(fast_function), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)

      g = sin(50.0_wp*t)
      if (abs(g(1)) > 0.9_wp) g = ieee_value(t, ieee_quiet_nan)
   end subroutine fast_values

   !> An oscillator at t = 100 with a period of half a spacing of t: maxima a period apart.
   subroutine test_within_spacing(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      real(wp), parameter :: period = 2.0_wp**(-47)
      integer :: i

      table = event_table([1], [0.0_wp], [-1], of_slope=[.true.])
      call run(error, swing(2*pi/period), 100.0_wp, 100.0_wp + 20*period, &
               at_tolerance(1.0e-12_wp), outcome, watcher=table)
      call expect_between(error, real(table%received, wp), 19.0_wp, 20.0_wp, "maxima")
      if (allocated(error)) return
      call expect_close(error, [(elapsed(instant(100.0_wp), table%time(i))/(i*period), i=1, 19)], &
                        spread(1.0_wp, 1, 19), 1.0e-9_wp, "time in periods")
   end subroutine test_within_spacing

   !> Zeros and extremes of cos t where runs end, and amid runs so short that rounding is all that
   !> their dense output shows: each is met once. A Newton iteration leaves rounding in its slopes
   !> at the ends, and a series what follows its last term, so that only the explicit pair is asked
   !> for all.
   subroutine test_zero_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(continuation_type) :: continuation
      real(wp) :: little
      integer :: i, j, k

      do i = 1, size(methods)
         do j = 0, 2
            little = j*merge(1.0e-14_wp, 1.0e-5_wp, methods(i) == "explicit")
            table = event_table([1, 1], [0.0_wp, 0.0_wp], [0, 0], of_slope=[.false., .true.])
            continuation = continuation_type()
            do k = 1, 12
               call go_on(0.5_wp*k*pi - little)
               if (j > 0) call go_on(0.5_wp*k*pi + little)
            end do
            call go_on(6.2_wp*pi)
            call expect_events(error, table, [(0.5_wp*k*pi, k=1, 12)], 1.0e-8_wp, methods(i))
         end do
      end do

   contains

      subroutine go_on(t_end)
         real(wp), intent(in) :: t_end
         type(integration_result) :: outcome

         call run(error, swing(), continuation%time(1), t_end, &
                  at_tolerance(1.0e-10_wp, methods(i)), outcome, watcher=table, &
                  continuation=continuation)
      end subroutine go_on
   end subroutine test_zero_between

   !> Each rising passage of sin t through 1/2, and each falling one of its slope, ends a run; the
   !> next goes on and does not meet the same event again. Watchers for each take turns.
   subroutine test_turns(error)
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
   end subroutine test_turns
end module test_dde_events
