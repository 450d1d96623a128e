! SPDX-License-Identifier: BSD-3-Clause
!> The path of a motion that is drawn: it is the solution, it shows the fastest slip events, and the
!> points left out are as close to its line as is asked.
module test_motion_path
   use attractor_searches, only: disturbed_block, fine_settings, search
   use attractors, only: attractor_settings_type, attractor_type
   use block_builder, only: build_block, index_of_ln_v, index_of_u
   use dde, only: continuation_type, event_table, integration_options, integration_result, &
                  table_sampler
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use motion_classes, only: cycle_motion
   use motion_path, only: find_kept_points, follow_path
   use solving, only: at_tolerance, run
   implicit none (type, external)
   private
   public :: collect_motion_path

contains

   subroutine collect_motion_path(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("solution", test_solution), &
                   new_unittest("fast slip events", test_slip_events), &
                   new_unittest("path of an attractor", test_attractor), &
                   new_unittest("lines", test_lines), &
                   new_unittest("line of circle", test_circle)]
   end subroutine collect_motion_path

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
   subroutine test_slip_events(error)
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
   end subroutine test_slip_events

   !> The path of the paper's torus, a cycle, comes back to its beginning after one period, and its
   !> largest v is the maximum.
   subroutine test_attractor(error)
      type(error_type), allocatable, intent(out) :: error
      type(attractor_type) :: found

      call search(disturbed_block(10.0_wp, 0.5_wp, 0.8_wp), observed(50.0_wp), found, error)
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

   !> How attractors are found here.
   pure type(attractor_settings_type) function observed(t_path) result(settings)
      real(wp), intent(in) :: t_path

      settings = fine_settings(2000.0_wp, 1000.0_wp)
      settings%t_path = t_path
      settings%exponents = 3
   end function observed

   !> None, one and two points, three at one place. Of a line with two corners and points between
   !> them the ends and the corners are kept, and a point beside the line if it is further away than
   !> the tolerance. A line that turns back on itself keeps its end.
   subroutine test_lines(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: points(2, 9)

      points = 1.0_wp
      call check(points(:, :0), [integer ::])
      call check(points(:, :1), [1])
      call check(points(:, :2), [1, 2])
      call check(points(:, :3), [1, 3])
      points(1, :) = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp]
      points(2, :) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 2.0_wp, 2.0_wp]
      call check(points, [1, 4, 6, 9])
      points(2, 8) = 2.09_wp
      call check(points, [1, 4, 6, 9])
      points(2, 8) = 2.11_wp
      call check(points, [1, 4, 6, 8, 9])
      call check(reshape([0.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 1.0_wp], [1, 5]), [1, 3, 5])

   contains

      !> These points are kept.
      subroutine check(line, known)
         real(wp), intent(in) :: line(:, :)
         integer, intent(in) :: known(:)
         integer :: i

         associate (kept => pack([(i, i=1, size(line, 2))], find_kept_points(line, 0.1_wp)))
            call expect(error, size(kept) == size(known), text(size(known))//" points")
            if (allocated(error)) return
            call expect(error, all(kept == known), "the points of "//text(size(line, 2)))
         end associate
      end subroutine check
   end subroutine test_lines

   !> Of 1001 points on half a circle those left out are within the tolerance of the line, and there
   !> are about pi/sqrt(8 tolerance) chords: a chord over the angle a is a**2/8 from the circle.
   subroutine test_circle(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp), tolerance = 1.0e-3_wp
      logical :: kept(1001)
      real(wp) :: angle(1001), farthest
      integer :: chords, first, i, last

      angle = [(pi*i/1000.0_wp, i=0, 1000)]
      kept = find_kept_points(transpose(reshape([cos(angle), sin(angle)], [1001, 2])), tolerance)
      farthest = 0.0_wp
      first = 1
      do i = 2, 1001
         if (.not. kept(i)) cycle
         last = i
         farthest = max(farthest, 1.0_wp - cos(0.5_wp*(angle(last) - angle(first))))
         first = last
      end do
      call expect(error, farthest <= tolerance, "within the tolerance")
      chords = count(kept) - 1
      associate (fewest => pi/sqrt(8.0_wp*tolerance))
         call expect(error, chords >= fewest - 1.0_wp .and. chords <= 2.0_wp*fewest, &
                     text(chords)//" chords")
      end associate
   end subroutine test_circle
end module test_motion_path
