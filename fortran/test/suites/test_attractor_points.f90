! SPDX-License-Identifier: BSD-3-Clause
!> Attractors at many points: trouble at one is none of the others'. On sweeps coexisting motions
!> show, and a sweep goes through a change between delay and none. Grids that are computed only
!> where neighbours differ, on made-up maps of kinds.
module test_attractor_points
   use attractor_points, only: find_attractors, finding_type, point_type, sweep_attractors
   use attractor_searches, only: coarse_settings
   use attractors, only: attractor_settings_type
   use block_builder, only: build_block
   use dde, only: integration_options
   use dde_errors, only: text
   use dde_kinds, only: wp
   use exponent_runs, only: recorder
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use motion_classes, only: fixed_point, undecided
   use refined_grid, only: refined_grid_type, uncertain
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_attractor_points

contains

   subroutine collect_attractor_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("on a grid", test_grid), &
                   new_unittest("a point that cannot be run", test_problem), &
                   new_unittest("sweeps along branches", test_sweeps), &
                   new_unittest("sweep after a failed point", test_failed_point), &
                   new_unittest("sizes", test_sizes), &
                   new_unittest("regions", test_regions), &
                   new_unittest("single points", test_points)]
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

   !> Motions are followed from point to point. At tau = 7, xi = 0.5 the small cycle vanishes in a
   !> saddle-node at epsilon = 0.331; beyond it there is a large cycle, which exists below, too. The
   !> cycle of the paper's torus has the maxima of runs from the history also where the delay grows
   !> or shrinks, and so have a cycle without delay, steady sliding with a short one, and the first
   !> again.
   subroutine test_sweeps(error)
      type(error_type), allocatable, intent(out) :: error
      type(point_type) :: points(4)
      real(wp) :: alone(4), down(4), up(4)

      points = near_sliding(7.0_wp, [0.31_wp, 0.32_wp, 0.325_wp, 0.337_wp], 0.5_wp)
      call largest_maxima(points, 3000.0_wp, .true., up)
      call largest_maxima(points(4:1:-1), 3000.0_wp, .true., down)
      call expect_between(error, maxval(up(:3)), 1.5_wp, 2.0_wp, "small cycle on the way up")
      call expect_between(error, up(4), 4.0_wp, 5.5_wp, "large cycle beyond")
      call expect_between(error, minval(down), 4.0_wp, 5.5_wp, "large cycle on the way down")
      points = near_sliding([9.5_wp, 10.0_wp, 11.0_wp, 10.0_wp], 0.5_wp, 0.8_wp)
      call largest_maxima(points, 1500.0_wp, .true., up)
      call largest_maxima(points, 1500.0_wp, .false., alone)
      call expect_close(error, up, alone, 1.0e-4_wp, "maxima of a longer and a shorter delay")
      points = near_sliding([0.0_wp, 2.0_wp, 0.0_wp, 2.0_wp], 0.5_wp, 0.8_wp)
      call largest_maxima(points, 1000.0_wp, .true., up)
      call largest_maxima(points, 1000.0_wp, .false., alone)
      call expect_close(error, up, alone, 1.0e-4_wp, "maxima with and without delay")
      call expect(error, all((up > 1.0_wp) .eqv. [.true., .false., .true., .false.]), "cycles")

   contains

      !> Largest maximum of v at each point, 1 of a fixed point, on a sweep or from the history.
      subroutine largest_maxima(some, t_transient, on_sweep, largest)
         type(point_type), intent(in) :: some(:)
         real(wp), intent(in) :: t_transient
         logical, intent(in) :: on_sweep
         real(wp), intent(out) :: largest(:)
         type(finding_type), allocatable :: findings(:)
         integer :: i

         if (on_sweep) then
            call sweep_attractors(block(), some, coarse_settings(t_transient), &
                                  at_tolerance(1.0e-7_wp, "auto"), findings)
         else
            call find_attractors(block(), some, coarse_settings(t_transient), &
                                 at_tolerance(1.0e-7_wp, "auto"), findings)
         end if
         do i = 1, size(some)
            call expect_success(error, findings(i)%problem)
            associate (found => findings(i)%attractor)
               largest(i) = 1.0_wp
               if (found%by_exponents /= fixed_point) largest(i) = maxval(found%motion%maxima)
            end associate
         end do
      end subroutine largest_maxima
   end subroutine test_sweeps

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

   !> Refine a map, and find another one. No point is asked for twice, more and more have a kind.
   subroutine refine(error, map, refinements, found, grid)
      type(error_type), allocatable, intent(inout) :: error
      integer, intent(in) :: map(:, :), refinements, found(:, :)
      type(refined_grid_type), intent(out) :: grid
      integer, allocatable :: wanted(:)
      integer :: asked(size(map)), kinds(size(map)), settled

      grid = refined_grid_type(size(map, 1), size(map, 2), refinements)
      kinds = reshape(map, [size(map)])
      asked = 0
      settled = 0
      do
         call grid%next(wanted)
         if (size(wanted) == 0) exit
         asked(wanted) = asked(wanted) + 1
         call grid%put(wanted, kinds(wanted))
         call expect(error, grid%settled() >= settled, "points with a kind")
         settled = grid%settled()
      end do
      call expect(error, grid%settled() == size(map), "all points have a kind")
      call expect(error, all(asked == merge(1, 0, reshape(grid%computed, [size(map)]))), &
                  "computed once")
      call expect(error, all(grid%kinds == found), "the kinds after "//text(refinements))
   end subroutine refine

   !> Maps of one kind: lines, single points, and numbers of lines that the distance does not
   !> divide. Every 2**refinements-th line is computed, and the last one if it is not among them.
   subroutine test_sizes(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer, allocatable :: map(:, :)
      integer :: columns, lines, refinements

      do refinements = 0, 4
         do lines = 1, 19
            do columns = 1, 19
               allocate (map(columns, lines), source=1)
               call refine(error, map, refinements, map, grid)
               associate (first => 1 + ([columns, lines] + 2**refinements - 2)/2**refinements)
                  call expect(error, count(grid%computed) == product(first), &
                              text(columns)//" x "//text(lines)//" points")
               end associate
               deallocate (map)
            end do
         end do
      end do
   end subroutine test_sizes

   !> Regions larger than the first distance are found exactly, at less cost; one of any shape is
   !> followed from a single point of the first lines.
   subroutine test_regions(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer :: disc(74, 51), half(74, 51), i, j, refinements, several(74, 51), snake(33, 33)

      do j = 1, 51
         do i = 1, 74
            disc(i, j) = merge(2, 1, (i - 30)**2 + (j - 22)**2 < 17**2)
            half(i, j) = merge(2, 1, 3*i + 7*j > 251)
            several(i, j) = 1 + (i + 2*j)/60 + 5*((3*i - j + 60)/100)
         end do
      end do
      snake = 1
      snake(9:30, 10) = 2
      snake(30, 10:22) = 2
      snake(4:30, 22) = 2
      snake(4, 22:32) = 2
      snake(4:20, 32) = 2
      do refinements = 1, 4
         call refine(error, disc, refinements, disc, grid)
         call expect(error, 10*count(grid%computed) < 7*size(disc), "cost of the disc")
         call refine(error, half, refinements, half, grid)
         call expect(error, 10*count(grid%computed) < 6*size(half), "cost of the half")
         call refine(error, several, refinements, several, grid)
         if (refinements > 3) cycle
         snake(9, 9) = 1
         call refine(error, snake, refinements, merge(1, 1, snake > 0), grid)
         snake(9, 9) = 2
         call refine(error, snake, refinements, snake, grid)
      end do
   end subroutine test_regions

   !> An island of one point is found if it is on the first lines, and only then. A point whose kind
   !> is uncertain says nothing of those beside it.
   subroutine test_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer :: found(9, 9), i, j, map(9, 9)

      do j = 1, 9
         do i = 1, 9
            map = 1
            found = 1
            map(i, j) = 2
            if (modulo(i, 4) == 1 .and. modulo(j, 4) == 1) found = map
            call refine(error, map, 2, found, grid)
         end do
      end do
      map = 1
      map(5, 5) = uncertain
      call refine(error, map, 1, map, grid)
      call expect(error, all(grid%computed(4:6, 4:6)), "all around it are computed")
      map = uncertain
      call refine(error, map, 3, map, grid)
      call expect(error, all(grid%computed), "all are computed")
   end subroutine test_points
end module test_attractor_points
