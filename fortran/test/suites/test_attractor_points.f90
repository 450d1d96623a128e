! SPDX-License-Identifier: BSD-3-Clause
!> Attractors at many points: trouble at one is none of the others'. On sweeps coexisting motions
!> show, and a sweep goes through a change between delay and none.
module test_attractor_points
   use attractor_points, only: find_attractors, finding_type, point_type, sweep_attractors
   use attractor_searches, only: coarse_settings
   use attractors, only: attractor_settings_type
   use block_builder, only: build_block
   use dde, only: integration_options
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use motion_classes, only: cycle_motion, fixed_point, undecided
   use progress_recorder, only: recorder
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_attractor_points

contains

   subroutine collect_attractor_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("on a grid", test_grid), &
                   new_unittest("a point that cannot be run", test_problem), &
                   new_unittest("hysteresis on a sweep", test_hysteresis), &
                   new_unittest("sweep of the delay up and down", test_delay), &
                   new_unittest("sweep from and to no delay", test_no_delay), &
                   new_unittest("sweep after a failed point", test_failed_point)]
   end subroutine collect_attractor_points

   !> The block; points have parameters of their own.
   type(model_type) function block() result(model)
      model = build_block(0.0_wp, 0.5_wp, 0.8_wp, 0.8_wp)
   end function block

   !> How attractors are found here.
   pure type(attractor_settings_type) function quickly() result(settings)
      settings = coarse_settings(200.0_wp)
      settings%exponents = 3
      settings%doublings = 1
   end function quickly

   !> On a grid across the Hopf curve of the block without delay,
   !> epsilon = xi gamma**2/(xi + gamma**2): the points that are computed are the same as without
   !> refinements, the others have the class of their neighbours.
   subroutine test_grid(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: columns = 5, lines = 5
      type(finding_type), allocatable :: all_computed(:), findings(:)
      type(recorder) :: progress
      type(point_type) :: points(columns*lines)
      integer :: i, j

      points = [((near_sliding(0.0_wp, 0.1_wp*i, 0.5_wp + 0.02_wp*j), i=1, columns), j=1, lines)]
      call find_attractors(block(), points, quickly(), at_tolerance(1.0e-6_wp, "auto"), &
                           all_computed)
      call find_attractors(block(), points, quickly(), at_tolerance(1.0e-6_wp, "auto"), findings, &
                           progress, columns, 1)
      call expect(error, all(all_computed%computed) .and. .not. all(findings%computed), &
                  "some points are not computed")
      call expect(error, all(findings%attractor%class == all_computed%attractor%class), &
                  "the same classes")
      do j = 1, size(points)
         if (.not. findings(j)%computed) cycle
         call expect_success(error, findings(j)%problem)
         if (allocated(error)) return
         call expect_close(error, all_of(findings(j)), all_of(all_computed(j)), 0.0_wp, &
                           "point "//text(j))
      end do
      associate (done => progress%done, n => size(progress%done))
         call expect(error, all(done(2:) >= done(:n - 1)) .and. done(n) == size(points) &
                     .and. all(done(:n - 1) < size(points)), "progress to the end")
      end associate
   end subroutine test_grid

   !> All numbers of a finding.
   pure function all_of(finding) result(numbers)
      type(finding_type), intent(in) :: finding
      real(wp), allocatable :: numbers(:)

      associate (a => finding%attractor)
         numbers = [real([a%class, a%by_exponents, a%by_section, a%by_spectrum, a%period], wp), &
                    a%exponents%value, a%exponents%error, a%roughness, a%bases, a%line_share, &
                    a%motion%maxima, &
                     reshape(a%motion%section, [size(a%motion%section)]), a%motion%section_time]
      end associate
   end function all_of

   !> A history from which no step is possible gives its words and no class; the points beside it
   !> are what they are alone.
   subroutine test_problem(error)
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: alone(:), findings(:)
      type(point_type) :: points(3)

      points = [near_sliding(0.0_wp, 0.3_wp, 0.8_wp, 1.0_wp), &
                near_sliding(10.0_wp, 0.5_wp, 0.8_wp, 1.0e-300_wp), &
                near_sliding(10.0_wp, 0.5_wp, 0.8_wp, 1.5_wp)]
      call find_attractors(block(), points, quickly(), at_tolerance(1.0e-6_wp, "auto"), findings)
      call find_attractors(block(), points(3:), quickly(), at_tolerance(1.0e-6_wp, "auto"), alone)
      call expect_success(error, findings(1)%problem)
      call expect_failure(error, findings(2)%problem, "stopped at t = ")
      call expect_success(error, findings(3)%problem)
      if (allocated(error)) return
      call expect(error, findings(1)%attractor%class == fixed_point, "steady sliding")
      call expect(error, findings(2)%attractor%class == undecided, "nothing there")
      call expect_close(error, all_of(findings(3)), all_of(alone(1)), 0.0_wp, "the same alone")
   end subroutine test_problem

   !> A point that starts near steady sliding, gamma = 0.8.
   elemental type(point_type) function near_sliding(tau, epsilon, xi, v) result(point)
      real(wp), intent(in) :: tau, epsilon, xi
      !> 1.1 unless given
      real(wp), intent(in), optional :: v

      point%numbers = [tau, epsilon, xi, 0.8_wp]
      point%past = [0.0_wp, 0.0_wp, log(1.1_wp)]
      if (present(v)) point%past(3) = log(v)
   end function near_sliding

   !> Largest maximum of v at each point.
   subroutine largest_maxima(error, points, settings, largest)
      type(error_type), allocatable, intent(inout) :: error
      type(point_type), intent(in) :: points(:)
      type(attractor_settings_type), intent(in) :: settings
      real(wp), intent(out) :: largest(:)
      type(finding_type), allocatable :: findings(:)
      integer :: i

      largest = 0.0_wp
      call sweep_attractors(block(), points, settings, at_tolerance(1.0e-7_wp, "auto"), findings)
      do i = 1, size(points)
         call expect_success(error, findings(i)%problem)
         if (allocated(error)) return
         largest(i) = maxval(findings(i)%attractor%motion%maxima)
      end do
   end subroutine largest_maxima

   !> At tau = 7, xi = 0.5 the small cycle vanishes in a saddle-node at epsilon = 0.331. Beyond it
   !> there is a large cycle, which exists below, too.
   subroutine test_hysteresis(error)
      type(error_type), allocatable, intent(out) :: error
      type(point_type) :: points(4)
      real(wp) :: down(4), up(4)

      points = near_sliding(7.0_wp, [0.31_wp, 0.32_wp, 0.325_wp, 0.337_wp], 0.5_wp)
      call largest_maxima(error, points, coarse_settings(3000.0_wp), up)
      call largest_maxima(error, points(4:1:-1), coarse_settings(3000.0_wp), down)
      call expect_between(error, maxval(up(:3)), 1.5_wp, 2.0_wp, "small cycle on the way up")
      call expect_between(error, up(4), 4.0_wp, 5.5_wp, "large cycle beyond")
      call expect_between(error, minval(down), 4.0_wp, 5.5_wp, "large cycle on the way down")
   end subroutine test_hysteresis

   !> The cycle through the paper's torus, with a longer delay from point to point and back: the
   !> same maxima, those of runs from the history.
   subroutine test_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: alone(:)
      type(point_type) :: points(3)
      real(wp) :: down(3), up(3)
      integer :: i

      points = near_sliding([9.5_wp, 10.0_wp, 11.0_wp], 0.5_wp, 0.8_wp)
      call largest_maxima(error, points, coarse_settings(1500.0_wp), up)
      call largest_maxima(error, points(3:1:-1), coarse_settings(1500.0_wp), down)
      call find_attractors(block(), points, coarse_settings(1500.0_wp), &
                           at_tolerance(1.0e-7_wp, "auto"), alone)
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
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: findings(:)
      type(point_type) :: points(3)
      integer :: i

      points = near_sliding([0.0_wp, 2.0_wp, 0.0_wp], 0.5_wp, 0.8_wp)
      call sweep_attractors(block(), points, coarse_settings(1000.0_wp), &
                            at_tolerance(1.0e-7_wp, "auto"), findings)
      do i = 1, 3
         call expect_success(error, findings(i)%problem)
      end do
      if (allocated(error)) return
      call expect(error, all(findings%attractor%by_exponents &
                             == [cycle_motion, fixed_point, cycle_motion]), "classes")
      call expect_close(error, maxval(findings(3)%attractor%motion%maxima), &
                        maxval(findings(1)%attractor%motion%maxima), 1.0e-4_wp, "the same cycle")
   end subroutine test_no_delay

   !> A point that cannot be run gives its reason; the next starts from where it started. Explicit
   !> steps are no longer than the delay.
   subroutine test_failed_point(error)
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: findings(:)
      type(integration_options) :: options
      type(point_type) :: points(3)

      options = at_tolerance(1.0e-7_wp, "explicit")
      options%most_steps = 20000
      points = near_sliding([10.0_wp, 1.0e-3_wp, 10.0_wp], 0.5_wp, 0.8_wp)
      call sweep_attractors(block(), points, coarse_settings(1500.0_wp), options, findings)
      call expect_success(error, findings(1)%problem)
      call expect_failure(error, findings(2)%problem, "20000 steps (most_steps) were used up")
      call expect_success(error, findings(3)%problem)
      if (allocated(error)) return
      call expect(error, findings(2)%attractor%class == undecided, "no class")
      call expect_close(error, maxval(findings(3)%attractor%motion%maxima), &
                        maxval(findings(1)%attractor%motion%maxima), 1.0e-4_wp, "the same cycle")
   end subroutine test_failed_point
end module test_attractor_points
