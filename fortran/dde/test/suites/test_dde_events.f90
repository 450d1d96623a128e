! SPDX-License-Identifier: BSD-3-Clause
!> Events: where they are found, in what order, and that one can end a run.
module test_dde_events
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: continuation_type, elapsed, event_met, event_table, event_watcher_type, &
                  instant, integration_options, integration_result, methods, reached_end, &
                  table_sampler
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

   !> Zeros of cos t and -sin t, each by its own component: 1 where the other was evaluated, too.
   type, extends(event_watcher_type) :: frugal_watcher
      !> Events, and those of which the other component is known
      integer :: received = 0, whole = 0
   contains
      procedure :: reads_for => own_component
      procedure :: takes => own_component
      procedure :: values => both_components
      procedure :: value => component_alone
      procedure :: take => count_event
   end type frugal_watcher

contains

   subroutine collect_dde_events(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("passages and maxima", test_passages), &
                   new_unittest("an event that ends the run", test_terminal), &
                   new_unittest("two passages in one step", test_pair), &
                   new_unittest("order of several functions", test_order), &
                   new_unittest("thousands of events in one step", test_thousands), &
                   new_unittest("a zero where steps meet", test_zero_at_step_end), &
                   new_unittest("a fast function of time", test_fast), &
                   new_unittest("steps without events are not searched", test_bounds), &
                   new_unittest("an event costs its own components", test_frugal), &
                   new_unittest("within a spacing of t", test_within_spacing), &
                   new_unittest("a slope that jumps", test_jump), &
                   new_unittest("a zero where runs meet", test_zero_between)]
   end subroutine collect_dde_events

   !> sin t = 1/2 at pi/6, 5 pi/6 and 13 pi/6: rising, falling, both. sin t = 0 at t = 0 is no
   !> event, pi and 2 pi are. Maxima and minima of cos t, and maxima of -sin t.
   subroutine test_passages(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      integer :: i, k

      do i = 1, size(methods)
         table = event_table([1, 1, 1, 1], [0.5_wp, 0.5_wp, 0.5_wp, 0.0_wp], [1, -1, 0, 0])
         call run(error, sine(), 0.0_wp, 8.0_wp, at_tolerance(1.0e-12_wp, methods(i)), outcome, &
                  watcher=table)
         call expect(error, outcome%reason == reached_end, "the run goes to its end")
         call expect_times(error, table, 1, [pi/6, 13*pi/6], methods(i)//", rising")
         call expect_times(error, table, 2, [5*pi/6], methods(i)//", falling")
         call expect_times(error, table, 3, [pi/6, 5*pi/6, 13*pi/6], methods(i)//", both")
         call expect_times(error, table, 4, [pi, 2*pi], methods(i)//", zeros")
         call expect_close(error, table%y(1, :table%received), &
                           table%level(table%which(:table%received)), 1.0e-14_wp, "y")
         table = event_table([1, 1, 2], [0.0_wp, 0.0_wp, 0.0_wp], [-1, 1, -1], &
                             of_slope=[.true., .true., .true.])
         call run(error, swing(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-12_wp, methods(i)), outcome, &
                  watcher=table)
         call expect_times(error, table, 1, [(2*pi*k, k=1, 3)], methods(i)//", maxima of cos t")
         call expect_times(error, table, 2, [(2*pi*k - pi, k=1, 3)], methods(i)//", minima")
         call expect_times(error, table, 3, [(2*pi*k - 0.5_wp*pi, k=1, 3)], &
                           methods(i)//", maxima of -sin t")
      end do
   end subroutine test_passages

   !> Times of the events of one function.
   subroutine expect_times(error, table, which, known, what)
      type(error_type), allocatable, intent(inout) :: error
      type(event_table), intent(in) :: table
      integer, intent(in) :: which
      real(wp), intent(in) :: known(:)
      character(len=*), intent(in) :: what

      associate (n => table%received)
         call expect_close(error, pack(table%time(:n)%hi, table%which(:n) == which), known, &
                           1.0e-10_wp, what)
      end associate
   end subroutine expect_times

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
         call expect(error, table%received == 2, "two events")
         if (allocated(error)) return
         call expect_close(error, table%time(:2)%hi, [pi/3, 2*pi/3], 1.0e-10_wp, methods(i))
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

   !> t^2 passes 1/4 and 1/100 twice within one step from -1 to 1; the step's ends do not show it.
   subroutine test_pair(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         options = integration_options(methods(i), first_step=2.0_wp)
         table = event_table([1, 1], [0.25_wp, 0.01_wp], [0, 0])
         call run(error, quadrature(1, 1.0_wp), -1.0_wp, 1.0_wp, options, outcome, watcher=table)
         call expect(error, outcome%accepted == 1, "one step")
         call expect(error, table%received == 4, "four events")
         if (allocated(error)) return
         call expect_close(error, table%time(:4)%hi, [-0.5_wp, -0.1_wp, 0.1_wp, 0.5_wp], &
                           1.0e-13_wp, trim(methods(i)))
         call expect(error, all(table%which(:4) == [1, 2, 2, 1]), "which")
      end do
   end subroutine test_pair

   !> t passes seven levels in one step, given in disorder: events come in order of time. Of events
   !> at one time, all are handed over, though one of them ends the run; later ones are not.
   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      real(wp), parameter :: levels(7) = [0.31_wp, 0.3_wp, 0.9_wp, 0.1_wp, 0.32_wp, 0.89_wp, 0.2_wp]

      table = event_table([1, 1, 1, 1, 1, 1, 1], levels, [1, 1, 1, 1, 1, 1, 1])
      call run(error, quadrature(0, 0.0_wp), 0.0_wp, 1.0_wp, &
               integration_options("explicit", first_step=1.0_wp), outcome, watcher=table)
      call expect(error, table%received == 7, "seven events")
      if (allocated(error)) return
      call expect(error, all(table%which(:7) == [4, 7, 2, 1, 5, 6, 3]), "their order")
      call expect_close(error, table%time(:7)%hi, levels(table%which(:7)), 1.0e-15_wp, "times")
      table = event_table([1, 1, 1], [0.51_wp, 0.5_wp, 0.5_wp], [1, 1, 1], &
                          terminal=[.false., .true., .false.])
      call run(error, quadrature(0, 0.0_wp), 0.0_wp, 1.0_wp, &
               integration_options("explicit", first_step=1.0_wp), outcome, watcher=table)
      call expect(error, table%received == 2, "two events")
      call expect(error, all(table%which(:2) == [2, 3]), "which")
   end subroutine test_order

   !> t passes 1 and 2 where steps meet and 3 where the run ends: each once.
   subroutine test_zero_at_step_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         options = integration_options(methods(i), first_step=1.0_wp, longest_step=1.0_wp)
         table = event_table([1, 1, 1], [1.0_wp, 2.0_wp, 3.0_wp], [0, 0, 0])
         call run(error, quadrature(0, 0.0_wp), 0.0_wp, 3.0_wp, options, outcome, watcher=table)
         call expect(error, outcome%accepted == 3, "three steps")
         call expect(error, abs(outcome%y(1) - 3.0_wp) > 0.0_wp .or. table%received == 3, &
                     "a zero at the very end is seen")
         call expect_between(error, real(table%received, wp), 2.0_wp, 3.0_wp, "events")
         if (allocated(error)) return
         call expect_close(error, table%time(:2)%hi, [1.0_wp, 2.0_wp], 1.0e-13_wp, methods(i))
      end do
   end subroutine test_zero_at_step_end

   !> y = t passes 1000 levels in one step, each of 100 functions at one time: in order of time,
   !> then of number. The square of their number would be 1e10 comparisons.
   subroutine test_thousands(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: levels = 1000, functions = 100*levels
      type(event_table) :: table
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i, k, number(functions)

      ! each level has the functions number(i), number(i) + levels, ...
      number(:levels) = [(1 + modulo(617*i, levels), i=1, levels)]
      options = at_tolerance(1.0e-6_wp)
      options%first_step = 1.0_wp
      table = event_table(spread(1, 1, functions), &
                          [(position(number(:levels), 1 + modulo(i - 1, levels)) &
                            /(levels + 1.0_wp), i=1, functions)], spread(1, 1, functions))
      call run(error, quadrature(0, 0.0_wp), 0.0_wp, 1.0_wp, options, outcome, watcher=table)
      call expect(error, outcome%accepted == 1, "one step")
      call expect(error, table%received == functions, text(table%received)//" events")
      if (allocated(error)) return
      number = [((number(i) + levels*k, k=0, 99), i=1, levels)]
      call expect(error, all(table%which(:functions) == number), "in order")
   end subroutine test_thousands

   !> Where a number stands in a list, as a real number.
   pure real(wp) function position(list, number) result(place)
      integer, intent(in) :: list(:), number

      place = findloc(list, number, dim=1)
   end function position

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
         if (allocated(error)) return
         call expect_close(error, table%time(:table%received)%hi, [(k*pi/50, k=1, 1591)], &
                           1.0e-9_wp, methods(i))
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
         call expect_close(error, table%time(:table%received)%hi, &
                           searched%time(:searched%received)%hi, 0.0_wp, methods(i))
         call expect(error, all(table%which(:table%received) &
                                == searched%which(:searched%received)), "of the same functions")
      end do
   end subroutine test_bounds

   !> Neither the location of an event nor the event itself evaluates what it does not read.
   subroutine test_frugal(error)
      type(error_type), allocatable, intent(out) :: error
      type(frugal_watcher), allocatable :: watcher
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         if (allocated(watcher)) deallocate (watcher)
         allocate (watcher)
         watcher%direction = [0, 0]
         watcher%terminal = [.false., .false.]
         call run(error, swing(), 0.1_wp, 12.0_wp, at_tolerance(1.0e-10_wp, methods(i)), outcome, &
                  watcher=watcher)
         call expect(error, watcher%received == 7, text(watcher%received)//" events")
         call expect(error, watcher%whole == 0, text(watcher%whole)//" of them whole")
      end do
   end subroutine test_frugal

   !> The component of a function.
   pure function own_component(self, which, n) result(components)
      class(frugal_watcher), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = [which]
   end function own_component

   !> Both components.
   pure subroutine both_components(self, t, y, slope, g)
      class(frugal_watcher), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)

      g = y
   end subroutine both_components

   !> One component; no event is found where the other is that of the same time.
   pure real(wp) function component_alone(self, which, t, y, slope) result(value)
      class(frugal_watcher), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: t, y(:), slope(:)

      value = merge(1.0_wp, y(which), are_whole(y))
   end function component_alone

   !> Count an event.
   subroutine count_event(self, which, t, y, slope)
      class(frugal_watcher), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)

      self%received = self%received + 1
      if (are_whole(y) .or. abs(y(which)) > 1.0e-6_wp) self%whole = self%whole + 1
   end subroutine count_event

   !> Whether cos t and -sin t are those of one time.
   pure logical function are_whole(y) result(value)
      real(wp), intent(in) :: y(:)

      value = abs(sum(y**2) - 1.0_wp) < 1.0e-6_wp
   end function are_whole

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

   !> y' = -y(t - 1) from y = 0 with a jump to 1 at t = 0: the slope jumps from 0 to -1 at t = 1
   !> and passes -1/2 there, and again at 5/2 on its way up from -1 to 0.
   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         table = event_table([1], [-0.5_wp], [0], of_slope=[.true.])
         call run(error, linear(past=[0.0_wp]), 0.0_wp, 2.9_wp, &
                  at_tolerance(1.0e-10_wp, methods(i)), outcome, watcher=table)
         call expect_close(error, table%time(:table%received)%hi, [1.0_wp, 2.5_wp], 1.0e-9_wp, &
                           methods(i))
         call expect_close(error, table%time(1)%hi, 1.0_wp, 0.0_wp, methods(i))
      end do
   end subroutine test_jump

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
               call go_on(error, methods(i), 0.5_wp*k*pi - little, table, continuation)
               if (j > 0) call go_on(error, methods(i), 0.5_wp*k*pi + little, table, continuation)
            end do
            call go_on(error, methods(i), 6.2_wp*pi, table, continuation)
            call expect(error, table%received == 12, text(table%received)//" events, "//methods(i))
            if (allocated(error)) return
            call expect_close(error, table%time(:12)%hi, [(0.5_wp*k*pi, k=1, 12)], 1.0e-8_wp, &
                              methods(i))
         end do
      end do
   end subroutine test_zero_between

   !> An oscillator goes on, watched.
   subroutine go_on(error, method, t_end, table, continuation)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: method
      real(wp), intent(in) :: t_end
      type(event_table), intent(inout) :: table
      type(continuation_type), intent(inout) :: continuation
      type(integration_result) :: outcome

      call run(error, swing(), continuation%time(1), t_end, at_tolerance(1.0e-10_wp, method), &
               outcome, watcher=table, continuation=continuation)
   end subroutine go_on
end module test_dde_events
