! SPDX-License-Identifier: BSD-3-Clause
!> Slip events of prescribed velocities, ln v = a sin t + b sin 3t, by integrals in closed form. The
!> path of a motion that is drawn: it is the solution, it shows the fastest events, and the points
!> left out are as close to its line as is asked.
module test_slip_events
   use attractor_searches, only: disturbed_block, fine_settings, search
   use attractors, only: attractor_settings_type, attractor_type
   use block_builder, only: build_block, index_of_ln_v, index_of_u, made
   use dde, only: continuation_type, event_table, integration_options, integration_result, &
                  table_sampler
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_description, only: observed_type
   use model_problem, only: model_type
   use motion_classes, only: cycle_motion
   use motion_path, only: find_kept_points, follow_path
   use slip_events, only: find_slip_events, slip_event_type
   use solving, only: at_tolerance, run
   implicit none (type, external)
   private
   public :: collect_slip_events

   real(wp), parameter :: pi = acos(-1.0_wp), bound = 1.0e-9_wp
   !> Slip of sin t > 0: the integral of exp(sin t) over half a period is pi (I0(1) + L0(1)), by the
   !> modified functions of Bessel and Struve.
   real(wp), parameter :: slip = pi*(1.266065877752008336_wp + 0.710243185937890861_wp)

contains

   subroutine collect_slip_events(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("events of a velocity", test_velocity), &
                   new_unittest("events of a signal without integral", test_plain_signal), &
                   new_unittest("peaks at the threshold", test_tiny_events), &
                   new_unittest("no event", test_none), &
                   new_unittest("solution", test_solution), &
                   new_unittest("fast slip events", test_fast_events), &
                   new_unittest("path of an attractor", test_attractor), &
                   new_unittest("lines", test_lines)]
   end subroutine collect_slip_events

   !> The motion with these amplitudes; maybe its logarithm is what is observed, from -3 or 0.
   type(model_type) function signal(a, b, event, start) result(model)
      real(wp), intent(in) :: a, b
      real(wp), intent(in), optional :: event, start

      model = made("made_signal", [a, b], [0.0_wp, 0.0_wp])
      if (present(start)) model%past(2) = start
      if (present(event)) model%sizes%observed = observed_type(component=2, event=event)
   end function signal

   !> Events of a model up to a time are those of these thresholds with these onsets, recurrence
   !> times, durations, slips, peaks and least velocities, shape (7, events).
   subroutine check(error, model, thresholds, times, known, what)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      !> Thresholds; transient and end
      real(wp), intent(in) :: thresholds(:), times(2), known(:, :)
      character(len=*), intent(in) :: what
      type(failure_type), allocatable :: failure
      type(slip_event_type), allocatable :: events(:)
      integer :: i

      call find_slip_events(model, thresholds, times(1), times(2), at_tolerance(1.0e-12_wp), &
                            events, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, real(size(events), wp), real(size(known, 2), wp), 0.0_wp, &
                        "number of events, "//what)
      do i = 1, min(size(events), size(known, 2))
         associate (e => events(i))
            call expect_close(error, [e%threshold, e%onset, e%recurrence_time, e%duration, &
                                      e%slip, e%peak_velocity, e%least_velocity], known(:, i), &
                              bound, what//", event "//text(i))
         end associate
      end do
   end subroutine check

   !> Onsets of sin t at 2 pi, 4 pi, ...; the last event is left out, since it has no next. 2 sin t
   !> + sin 3t has maxima of (10/3) sqrt(5/12) before and after its minimum at pi/2, and makes one
   !> event of both. Of two thresholds, sin t > 1/2 from pi/6 to 5 pi/6: the slip there by the
   !> midpoint rule. Only events that begin after the transient count.
   subroutine test_velocity(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: parts = 100000
      real(wp), parameter :: two_pi = 2.0_wp*pi, e = exp(1.0_wp), high = exp(0.5_wp), &
                             highest = exp(10.0_wp/3.0_wp*sqrt(5.0_wp/12.0_wp)), &
                             h = 2.0_wp/3.0_wp*pi/parts
      real(wp) :: of_both, of_high
      integer :: i

      call check(error, signal(1.0_wp, 0.0_wp), [1.0_wp], [0.0_wp, 40.0_wp], &
                 reshape([(1.0_wp, two_pi*i, two_pi, pi, slip, e, 1.0_wp/e, i=1, 5)], [7, 5]), &
                 "a sine")
      of_both = pi/parts*sum([(exp(2.0_wp*sin(pi*(i - 0.5_wp)/parts) &
                                   + sin(3.0_wp*pi*(i - 0.5_wp)/parts)), i=1, parts)])
      call check(error, signal(2.0_wp, 1.0_wp), [1.0_wp], [0.0_wp, 20.0_wp], &
                 reshape([(1.0_wp, two_pi*i, two_pi, pi, of_both, highest, 1.0_wp/highest, &
                           i=1, 2)], [7, 2]), "two maxima")
      of_high = h*sum([(exp(sin(pi/6.0_wp + h*(i - 0.5_wp))), i=1, parts)])
      call check(error, signal(1.0_wp, 0.0_wp), [1.0_wp, high], [1.0_wp, 19.0_wp], &
                 reshape([1.0_wp, two_pi, two_pi, pi, slip, e, 1.0_wp/e, &
                          high, 13.0_wp*pi/6, two_pi, parts*h, of_high, e, 1.0_wp/e, &
                          1.0_wp, 2.0_wp*two_pi, two_pi, pi, slip, e, 1.0_wp/e], [7, 3]), &
                 "two thresholds")
      call check(error, signal(1.0_wp, 0.0_wp), [1.0_wp], [2.1_wp*pi, 7.9_wp*pi], &
                 reshape([1.0_wp, 2.0_wp*two_pi, two_pi, pi, slip, e, 1.0_wp/e], [7, 1]), &
                 "after a transient")
   end subroutine test_velocity

   !> sin t > 1/2, the threshold of the definition, of a signal that is no exponential and of which
   !> no state is the integral; sin t - 3 > -2.5, where peaks are largest values of either sign.
   subroutine test_plain_signal(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: known(7, 2)
      integer :: i

      known = reshape([(0.5_wp, pi/6 + 2.0_wp*pi*i, 2.0_wp*pi, 2.0_wp*pi/3, 0.0_wp, 1.0_wp, &
                        -1.0_wp, i=0, 1)], [7, 2])
      call check(error, signal(1.0_wp, 0.0_wp, event=0.5_wp), [real(wp) ::], [0.0_wp, 14.0_wp], &
                 known, "a sine")
      known([1, 6, 7], :) = known([1, 6, 7], :) - 3.0_wp
      call check(error, signal(1.0_wp, 0.0_wp, event=0.0_wp, start=-3.0_wp), [-2.5_wp], &
                 [0.0_wp, 14.0_wp], known, "a negative sine")
   end subroutine test_plain_signal

   !> sin t - sin 3t has one maximum of 2 in a period, and two of (2/3)**1.5: events of those are
   !> none at a threshold of one part in 1e7 below, and do not end the loading after the large ones.
   subroutine test_tiny_events(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: height = (2.0_wp/3.0_wp)**1.5_wp
      type(failure_type), allocatable :: failure
      type(slip_event_type), allocatable :: events(:)
      integer :: i

      do i = 5, 7, 2
         call find_slip_events(signal(1.0_wp, -1.0_wp), exp([height - 10.0_wp**(-i)]), 0.0_wp, &
                               5.0_wp*pi, at_tolerance(1.0e-12_wp), events, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         call expect_close(error, real(size(events), wp), merge(6.0_wp, 2.0_wp, i == 5), 0.0_wp, &
                           "number of events")
      end do
      call expect_close(error, events%recurrence_time, [(2.0_wp*pi, i=1, 2)], bound, "recurrence")
      call expect_close(error, events%least_velocity, exp([(-2.0_wp, i=1, 2)]), bound, "least")
   end subroutine test_tiny_events

   !> Without motion there is no event.
   subroutine test_none(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: none(7, 0)

      call check(error, build_block(1.0_wp, 0.1_wp, 0.5_wp, 0.8_wp), [1.0_wp], [0.0_wp, 50.0_wp], &
                 none, "at rest")
   end subroutine test_none

   !> The chaos of the paper from t = 30: the path begins where v rises through 1, its points are
   !> those of a run of its own at these times, and it ends 40 later.
   subroutine test_solution(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: from
      type(event_table) :: passages
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(model_type) :: block_model
      type(table_sampler) :: direct
      real(wp), allocatable :: path(:, :)
      real(wp) :: start

      options = at_tolerance(1.0e-10_wp, "auto")
      block_model = build_block(tau=7.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, v=1.1_wp)
      call run(error, block_model, 0.0_wp, 30.0_wp, options, outcome, continuation=from)
      call follow_path(block_model, from, 40.0_wp, 4.0e-3_wp, options, path)
      call expect(error, allocated(path), "a path")
      if (allocated(error)) return
      passages = event_table([index_of_ln_v], level=[0.0_wp], direction=[1])
      call run(error, block_model, 0.0_wp, 70.0_wp, options, outcome, watcher=passages)
      if (allocated(error)) return
      associate (times => passages%time(:passages%received)%hi)
         start = minval(times, mask=times > 30.0_wp)
      end associate
      direct = table_sampler([index_of_u, index_of_ln_v], start + path(1, :))
      call run(error, block_model, 0.0_wp, 111.0_wp, options, outcome, sampler=direct)
      if (allocated(error)) return
      call expect_close(error, path(2, :), direct%values(1, :), 1.0e-6_wp, "u")
      call expect_close(error, path(3, :), direct%values(2, :), 1.0e-6_wp, "ln v")
      associate (last => path(1, size(path, 2)))
         call expect_close(error, last, 40.0_wp, 1.0e-12_wp, "end")
      end associate
      call expect_between(error, real(size(path, 2), wp), 30.0_wp, 200.0_wp, "points")
   end subroutine test_solution

   !> A real fault, gamma = 1e8, where v comes up to 1e3 and more: the largest v of the path is that
   !> of the maxima, and between two points u changes by what a line in the plot can show.
   subroutine test_fast_events(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: from
      type(event_table) :: maxima
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(model_type) :: block_model
      real(wp), allocatable :: path(:, :)
      real(wp) :: largest

      options = at_tolerance(1.0e-8_wp, "auto")
      block_model = build_block(tau=15.0_wp, epsilon=1.0_wp, xi=0.5_wp, gamma=1.0e8_wp, v=1.5_wp)
      call run(error, block_model, 0.0_wp, 400.0_wp, options, outcome, continuation=from)
      call follow_path(block_model, from, 60.0_wp, 4.0e-3_wp, options, path)
      call expect(error, allocated(path), "a path")
      if (allocated(error)) return
      maxima = event_table([index_of_ln_v], level=[0.0_wp], direction=[-1], of_slope=[.true.])
      call run(error, block_model, 400.0_wp, 600.0_wp, options, outcome, watcher=maxima, &
               continuation=from)
      if (allocated(error)) return
      largest = maxval(path(3, :))
      call expect_between(error, largest, log(1.0e3_wp), log(1.0e12_wp), "ln v of an event")
      associate (ln_v => maxima%y(index_of_ln_v, :maxima%received))
         call expect(error, minval(abs(ln_v - largest)) < 0.02_wp, &
                     "a maximum of ln v is the largest of the path, "//text(largest))
      end associate
   end subroutine test_fast_events

   !> The path of the paper's torus, a cycle, comes back to its beginning after one period, and its
   !> largest v is the maximum.
   subroutine test_attractor(error)
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found

      settings = fine_settings(2000.0_wp, 1000.0_wp)
      settings%t_path = 50.0_wp
      settings%exponents = 3
      call search(disturbed_block(10.0_wp, 0.5_wp, 0.8_wp), settings, found, error)
      if (allocated(error)) return
      call expect(error, found%class == cycle_motion .and. found%period == 1, "a cycle")
      call expect(error, allocated(found%path), "a path")
      if (allocated(error)) return
      associate (t => found%path(1, :), ln_v => found%path(3, :), n => size(found%path, 2))
         call expect_close(error, t(n)*found%bases(1), 1.0_wp, 1.0e-9_wp, "one period")
         call expect_close(error, found%path(2:, n), found%path(2:, 1), 1.0e-4_wp, "closed")
         call expect(error, .not. any(ln_v(:n - 2) < 0.0_wp .and. ln_v(2:n - 1) > 0.0_wp), &
                     "no passage before the end")
         call expect_close(error, maxval(ln_v), log(found%motion%maxima(1)), 0.02_wp, "largest v")
      end associate
   end subroutine test_attractor

   !> None, one and two points, three at one place. Of a line with two corners and points between
   !> them the ends and the corners are kept, and a point beside the line if it is further away than
   !> the tolerance. A line that turns back on itself keeps its end. Of 1001 points on half a circle
   !> those left out are within the tolerance of the line, and there are about pi/sqrt(8 tolerance)
   !> chords: a chord over the angle a is a**2/8 from the circle.
   subroutine test_lines(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp), tolerance = 1.0e-3_wp
      integer, allocatable :: kept(:)
      real(wp) :: angle(1001), points(2, 9)
      integer :: i

      points = 1.0_wp
      call check(points(:, :0), [integer ::])
      call check(points(:, :1), [1])
      call check(points(:, :2), [1, 2])
      call check(points(:, :3), [1, 3])
      points(1, :) = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp]
      points(2, :) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 2.0_wp, 2.0_wp]
      points(2, 8) = 2.09_wp
      call check(points, [1, 4, 6, 9])
      points(2, 8) = 2.11_wp
      call check(points, [1, 4, 6, 8, 9])
      call check(reshape([0.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 1.0_wp], [1, 5]), [1, 3, 5])
      angle = [(pi*i/1000.0_wp, i=0, 1000)]
      kept = pack([(i, i=1, 1001)], find_kept_points(transpose( &
                  reshape([cos(angle), sin(angle)], [1001, 2])), tolerance))
      associate (chords => size(kept) - 1, fewest => pi/sqrt(8.0_wp*tolerance))
         call expect(error, all(1.0_wp - cos(0.5_wp*(angle(kept(2:)) - angle(kept(:chords)))) &
                                <= tolerance), "within the tolerance")
         call expect(error, chords >= fewest - 1.0_wp .and. chords <= 2.0_wp*fewest, &
                     text(chords)//" chords")
      end associate

   contains

      !> These points are kept.
      subroutine check(line, known)
         real(wp), intent(in) :: line(:, :)
         integer, intent(in) :: known(:)

         associate (found => pack([(i, i=1, size(line, 2))], find_kept_points(line, 0.1_wp)))
            call expect_close(error, real(found, wp), real(known, wp), 0.0_wp, &
                              "points of "//text(size(line, 2)))
         end associate
      end subroutine check
   end subroutine test_lines
end module test_slip_events
