!> The path of a motion that is drawn: it is the solution, and it shows the fastest slip events.
module test_motion_path
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use block_builder, only: build_block
   use dde, only: continuation_type, event_table, integrate, integration_options, &
                  integration_result, table_sampler
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: cycle_motion, fixed_point
   use motion_path, only: follow_path
   use solving, only: at_tolerance
   use spring_block, only: index_of_ln_v, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: collect_motion_path

contains

   !> All tests of this suite.
   subroutine collect_motion_path(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("solution", test_solution), &
                   new_unittest("fast slip events", test_slip_events), &
                   new_unittest("path of an attractor", test_attractor), &
                   new_unittest("no path", test_none)]
   end subroutine collect_motion_path

   !> The chaos of the paper from t = 30: the path begins where v rises through 1, its points are
   !> those of a run of its own at these times, and it ends 40 later.
   subroutine test_solution(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: from
      type(event_table) :: passages
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      type(table_sampler) :: direct
      real(wp), allocatable :: path(:, :)
      real(wp) :: start

      options = at_tolerance(1.0e-10_wp, "auto")
      block_model = build_block(tau=7.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, v=1.1_wp)
      call integrate(block_model, 0.0_wp, 30.0_wp, options, outcome, failure, continuation=from)
      call expect_success(error, failure)
      call follow_path(block_model, from, 40.0_wp, 4.0e-3_wp, options, path)
      call expect(error, allocated(path), "a path")
      if (allocated(error)) return
      passages = event_table([index_of_ln_v], level=[0.0_wp], direction=[1])
      call integrate(block_model, 0.0_wp, 70.0_wp, options, outcome, failure, watcher=passages)
      call expect_success(error, failure)
      if (allocated(error)) return
      associate (times => passages%time(:passages%received)%hi)
         start = minval(times, mask=times > 30.0_wp)
      end associate
      direct = table_sampler([index_of_u, index_of_ln_v], start + path(1, :))
      call integrate(block_model, 0.0_wp, 111.0_wp, options, outcome, failure, direct)
      call expect_success(error, failure)
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
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: from
      type(event_table) :: maxima
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      real(wp), allocatable :: path(:, :)
      real(wp) :: largest

      options = at_tolerance(1.0e-8_wp, "auto")
      block_model = build_block(tau=15.0_wp, epsilon=1.0_wp, xi=0.5_wp, gamma=1.0e8_wp, v=1.5_wp)
      call integrate(block_model, 0.0_wp, 400.0_wp, options, outcome, failure, continuation=from)
      call expect_success(error, failure)
      call follow_path(block_model, from, 60.0_wp, 4.0e-3_wp, options, path)
      call expect(error, allocated(path), "a path")
      if (allocated(error)) return
      maxima = event_table([index_of_ln_v], level=[0.0_wp], direction=[-1], of_slope=[.true.])
      call integrate(block_model, 400.0_wp, 600.0_wp, options, outcome, failure, watcher=maxima, &
                     continuation=from)
      call expect_success(error, failure)
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
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(attractor_type) :: found
      type(failure_type), allocatable :: failure

      call find_attractor(build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, &
                                      v=1.1_wp), observed(50.0_wp), &
                          at_tolerance(1.0e-8_wp, "auto"), found, failure)
      call expect_success(error, failure)
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

   !> Steady sliding has no path, and neither has a motion of which none is asked for.
   subroutine test_none(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(attractor_type) :: found
      type(failure_type), allocatable :: failure

      call find_attractor(build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.8_wp, gamma=0.8_wp, &
                                      v=1.1_wp), observed(50.0_wp), &
                          at_tolerance(1.0e-8_wp, "auto"), found, failure)
      call expect_success(error, failure)
      call expect(error, found%class == fixed_point .and. .not. allocated(found%path), &
                  "steady sliding")
      call find_attractor(build_block(tau=0.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, &
                                      v=1.1_wp), observed(0.0_wp), &
                          at_tolerance(1.0e-8_wp, "auto"), found, failure)
      call expect_success(error, failure)
      call expect(error, found%class /= fixed_point .and. .not. allocated(found%path), "not asked")
   end subroutine test_none

   !> How attractors are found here.
   pure type(attractor_settings_type) function observed(t_path) result(settings)
      !> Time of the path
      real(wp), intent(in) :: t_path

      settings = attractor_settings_type(t_lasting=0.0_wp, &
                                         t_transient=2000.0_wp, t_observed=1000.0_wp, &
                                         t_turning=500.0_wp, t_path=t_path, interval=5.0_wp, &
                                         exponents=3, zero_level=3.0e-5_wp, longest_bar=1.0e-3_wp, &
                                         doublings=0, sample_interval=0.1_wp, window="hann", &
                                         segments=8, overlap=0.5_wp, peak_floor=1.0e-6_wp, &
                                         peak_prominence=10.0_wp)
   end function observed
end module test_motion_path
