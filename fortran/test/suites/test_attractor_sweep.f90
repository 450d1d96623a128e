!> Sweeps: coexisting motions show, and a sweep goes through a change between delay and none.
module test_attractor_sweep
   use attractor_points, only: find_attractors, finding_type, point_type
   use attractor_sweep, only: sweep_attractors
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use block_builder, only: build_block
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: cycle_motion, fixed_point, undecided
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_attractor_sweep

contains

   !> All tests of this suite.
   subroutine collect_attractor_sweep(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("hysteresis", test_hysteresis), &
                   new_unittest("delay up and down", test_delay), &
                   new_unittest("from and to no delay", test_no_delay), &
                   new_unittest("one point", test_one_point), &
                   new_unittest("a longer run", test_longer_run), &
                   new_unittest("after a failed point", test_failed_point)]
   end subroutine collect_attractor_sweep

   !> How attractors are found here: exponents are of no interest.
   pure type(attractor_settings_type) function approached_for(time) result(settings)
      !> Time of the approach
      real(wp), intent(in) :: time

      settings = attractor_settings_type(t_lasting=0.0_wp, t_path=0.0_wp, &
                                         t_transient=time, t_observed=500.0_wp, &
                                         t_turning=50.0_wp, interval=5.0_wp, &
                                         exponents=2, zero_level=1.0e-3_wp, &
                                         longest_bar=1.0e-2_wp, doublings=0, &
                                         sample_interval=0.1_wp, window="hann", segments=2, &
                                         overlap=0.5_wp, peak_floor=1.0e-6_wp, &
                                         peak_prominence=10.0_wp)
   end function approached_for

   !> A point that starts near steady sliding, gamma = 0.8.
   elemental type(point_type) function near_sliding(tau, epsilon, xi) result(point)
      !> Parameters
      real(wp), intent(in) :: tau, epsilon, xi

      point = point_type(block_parameters_type(tau=tau, epsilon=epsilon, xi=xi, gamma=0.8_wp), &
                         block_history_type(v=1.1_wp))
   end function near_sliding

   !> Largest maximum of v at each point.
   subroutine largest_maxima(error, points, settings, largest)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The points in the order of the sweep
      type(point_type), intent(in) :: points(:)
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> The maxima
      real(wp), intent(out) :: largest(:)
      type(finding_type), allocatable :: findings(:)
      integer :: i

      largest = 0.0_wp
      call sweep_attractors(points, settings, at_tolerance(1.0e-7_wp, "auto"), findings)
      do i = 1, size(points)
         call expect_success(error, findings(i)%problem)
         if (allocated(error)) return
         largest(i) = maxval(findings(i)%attractor%motion%maxima)
      end do
   end subroutine largest_maxima

   !> At tau = 7, xi = 0.5 the small cycle vanishes in a saddle-node at epsilon = 0.331. Beyond it
   !> there is a large cycle, which exists below, too.
   subroutine test_hysteresis(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(point_type) :: points(4)
      real(wp) :: down(4), up(4)

      points = near_sliding(7.0_wp, [0.31_wp, 0.32_wp, 0.325_wp, 0.337_wp], 0.5_wp)
      call largest_maxima(error, points, approached_for(3000.0_wp), up)
      call largest_maxima(error, points(4:1:-1), approached_for(3000.0_wp), down)
      call expect_between(error, maxval(up(:3)), 1.5_wp, 2.0_wp, "small cycle on the way up")
      call expect_between(error, up(4), 4.0_wp, 5.5_wp, "large cycle beyond")
      call expect_between(error, minval(down), 4.0_wp, 5.5_wp, "large cycle on the way down")
   end subroutine test_hysteresis

   !> The cycle through the paper's torus, with a longer delay from point to point and back: the
   !> same maxima, those of runs from the history.
   subroutine test_delay(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: alone(:)
      type(point_type) :: points(3)
      real(wp) :: down(3), up(3)
      integer :: i

      points = near_sliding([9.5_wp, 10.0_wp, 11.0_wp], 0.5_wp, 0.8_wp)
      call largest_maxima(error, points, approached_for(1500.0_wp), up)
      call largest_maxima(error, points(3:1:-1), approached_for(1500.0_wp), down)
      call find_attractors(points, approached_for(1500.0_wp), at_tolerance(1.0e-7_wp, "auto"), &
                           alone)
      do i = 1, 3
         call expect_success(error, alone(i)%problem)
         if (allocated(error)) return
         associate (known => maxval(alone(i)%attractor%motion%maxima))
            call expect_close(error, [up(i), down(4 - i)], [known, known], 1.0e-4_wp, "maxima")
         end associate
      end do
   end subroutine test_delay

   !> A cycle without delay, steady sliding with a short one, and back.
   subroutine test_no_delay(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: findings(:)
      type(point_type) :: points(3)
      integer :: i

      points = near_sliding([0.0_wp, 2.0_wp, 0.0_wp], 0.5_wp, 0.8_wp)
      call sweep_attractors(points, approached_for(1000.0_wp), at_tolerance(1.0e-7_wp, "auto"), &
                            findings)
      do i = 1, 3
         call expect_success(error, findings(i)%problem)
      end do
      if (allocated(error)) return
      call expect(error, all(findings%attractor%by_exponents &
                             == [cycle_motion, fixed_point, cycle_motion]), "classes")
      call expect_close(error, maxval(findings(3)%attractor%motion%maxima), &
                        maxval(findings(1)%attractor%motion%maxima), 1.0e-4_wp, "the same cycle")
   end subroutine test_no_delay

   !> A sweep of one point is a run from the history.
   subroutine test_one_point(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(attractor_type) :: alone
      type(failure_type), allocatable :: failure
      type(finding_type), allocatable :: findings(:)

      call sweep_attractors([near_sliding(10.0_wp, 0.5_wp, 0.8_wp)], approached_for(200.0_wp), &
                            at_tolerance(1.0e-7_wp, "auto"), findings)
      call expect_success(error, findings(1)%problem)
      call find_attractor(build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, &
                                      v=1.1_wp), approached_for(200.0_wp), &
                          at_tolerance(1.0e-7_wp, "auto"), alone, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, findings(1)%attractor%motion%maxima, alone%motion%maxima, 0.0_wp, &
                        "maxima")
   end subroutine test_one_point

   !> An attractor found from where a run ended has the maxima of one longer run, and ends where
   !> that one ends.
   subroutine test_longer_run(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(attractor_type) :: in_parts, whole
      type(continuation_type) :: end_in_parts, end_of_whole, start
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model

      options = at_tolerance(1.0e-9_wp, "auto")
      block_model = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
      call integrate(block_model, 0.0_wp, 300.0_wp, options, outcome, failure, continuation=start)
      call expect_success(error, failure)
      call find_attractor(block_model, approached_for(200.0_wp), options, in_parts, failure, &
                          start, end_in_parts)
      call expect_success(error, failure)
      call find_attractor(block_model, approached_for(500.0_wp), options, whole, failure, &
                          arrived=end_of_whole)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, in_parts%motion%maxima, whole%motion%maxima, 1.0e-6_wp, "maxima")
      call expect_close(error, in_parts%motion%section_time, &
                        whole%motion%section_time, 1.0e-4_wp, "times")
      call expect_close(error, end_in_parts%time, [1050.0_wp, 0.0_wp], 0.0_wp, "end")
      call expect_close(error, end_in_parts%y, end_of_whole%y, 1.0e-5_wp, "last state")
   end subroutine test_longer_run

   !> A point that cannot be run gives its reason; the next starts from where it started. Explicit
   !> steps are no longer than the delay.
   subroutine test_failed_point(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: findings(:)
      type(integration_options) :: options
      type(point_type) :: points(3)

      options = at_tolerance(1.0e-7_wp, "explicit")
      options%most_steps = 20000
      points = near_sliding([10.0_wp, 1.0e-3_wp, 10.0_wp], 0.5_wp, 0.8_wp)
      call sweep_attractors(points, approached_for(1500.0_wp), options, findings)
      call expect_success(error, findings(1)%problem)
      call expect_failure(error, findings(2)%problem, "20000 steps (most_steps) were used up")
      call expect_success(error, findings(3)%problem)
      if (allocated(error)) return
      call expect(error, findings(2)%attractor%class == undecided, "no class")
      call expect_close(error, maxval(findings(3)%attractor%motion%maxima), &
                        maxval(findings(1)%attractor%motion%maxima), 1.0e-4_wp, "the same cycle")
   end subroutine test_failed_point
end module test_attractor_sweep
