! SPDX-License-Identifier: BSD-3-Clause
!> Cycles of the block along lines, against its Hopf points and their kinds.
module test_cycle_branches
   use block_builder, only: block_at, build_block, by_epsilon, by_tau, by_xi
   use cycle_branches, only: cycle_line_type, cycle_settings_type, cycles_type, find_cycles, &
                             left_out_type
   use cycle_curves, only: cycle_curve_type, find_curves
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use hopf_curves, only: curve_point_type
   use hopf_lines, only: hopf_on_line_type
   use hopf_points, only: hopf_point_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use special_points, only: fold, torus_bifurcation
   use traced_planes, only: find_points, new_plane
   implicit none (type, external)
   private
   public :: collect_cycle_branches

contains

   subroutine collect_cycle_branches(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("folds start at a generalised Hopf point", test_folds), &
                   new_unittest("tori start at a double Hopf point", test_tori), &
                   new_unittest("a closed branch", test_closed)]
   end subroutine collect_cycle_branches

   !> The Hopf point of a kind in the plane of epsilon and tau that is nearest to a place.
   subroutine nearest_hopf_point(xi, window, kind, place, nearest, error)
      real(wp), intent(in) :: xi, window(4)
      character(len=*), intent(in) :: kind
      real(wp), intent(in) :: place(2)
      real(wp), intent(out) :: nearest(2)
      type(error_type), allocatable, intent(inout) :: error
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: found(:)
      integer :: i

      nearest = 1000.0_wp
      call find_points(new_plane(by_tau, 0.8_wp, xi, window), points, found, error)
      if (allocated(error)) return
      do i = 1, size(found)
         associate (there => found(i)%numbers([by_epsilon, by_tau]))
            if (found(i)%kind /= kind) cycle
            if (norm2(there - place) < norm2(nearest - place)) nearest = there
         end associate
      end do
   end subroutine nearest_hopf_point

   !> The curves of a kind that start on a line end at the Hopf point of another kind.
   subroutine expect_end(line, window, kind, ending, error)
      type(cycle_settings_type), intent(in) :: line
      real(wp), intent(in) :: window(4)
      character(len=*), intent(in) :: kind, ending
      type(error_type), allocatable, intent(inout) :: error
      type(cycle_settings_type) :: settings
      type(cycle_curve_type), allocatable :: curves(:)
      type(cycles_type), allocatable :: found(:)
      type(left_out_type), allocatable :: left_out(:)
      type(failure_type), allocatable :: failure
      type(hopf_on_line_type), allocatable :: hopf(:)
      real(wp) :: known(2)
      integer :: ends, i, k

      settings = line
      settings%curve_along = [by_epsilon, by_tau]
      settings%curve_window = reshape(window, [2, 2])
      call find_cycles(settings, hopf, found, left_out, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_curves(settings, found, curves, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      ends = 0
      do i = 1, size(curves)
         do k = 1, 2
            associate (part => curves(i)%parts(k))
               if (part%points(1)%kind /= kind .or. part%ending /= ending) cycle
               ends = ends + 1
               associate (last => part%points(size(part%points))%orbit%parameters)
                  call nearest_hopf_point(last(by_xi), window, ending, &
                                          last([by_epsilon, by_tau]), known, error)
                  call expect_close(error, last([by_epsilon, by_tau]), known, 1.0e-4_wp, &
                                    "end of the curve")
               end associate
            end associate
         end do
      end do
      call expect(error, ends > 0, "a curve of kind "//kind//" with the end "//ending)
   end subroutine expect_end

   !> Where the first Lyapunov coefficient vanishes, a curve of folds of cycles begins.
   subroutine test_folds(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_end(settings_on(by_epsilon, [5.9_wp, 0.0_wp, 0.8_wp, 0.8_wp], &
                                  [0.3_wp, 0.6_wp]), &
                      [0.3_wp, 0.6_wp, 5.0_wp, 6.0_wp], fold, "generalised_hopf", error)
   end subroutine test_folds

   !> Where two pairs of roots are imaginary, a curve of torus points begins.
   subroutine test_tori(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_end(settings_on(by_tau, [0.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], &
                                  [12.0_wp, 12.8_wp]), &
                      [0.4_wp, 0.6_wp, 11.5_wp, 12.8_wp], torus_bifurcation, "double_hopf", error)
   end subroutine test_tori

   !> A line without trajectories, of a coarse mesh.
   function settings_on(along, parameters, window) result(settings)
      integer, intent(in) :: along
      !> tau, epsilon, xi, gamma, and the window on the line
      real(wp), intent(in) :: parameters(4), window(2)
      type(cycle_settings_type) :: settings

      settings%line = cycle_line_type(block_at(parameters), along, window)
      allocate (settings%starts(0))
      settings%degree = 5
      settings%intervals = 20
      settings%most_orbits = 40
   end function settings_on

   !> Cycles of three maxima exist between two folds: their branch is closed and is found once.
   subroutine test_closed(error)
      type(error_type), allocatable, intent(out) :: error
      type(cycle_settings_type) :: settings
      type(cycles_type), allocatable :: found(:)
      type(left_out_type), allocatable :: left_out(:)
      type(failure_type), allocatable :: failure
      type(hopf_on_line_type), allocatable :: hopf(:)

      settings%line = cycle_line_type(build_block(0.0_wp, 0.7_wp, 0.5_wp, 0.8_wp, v=1.1_wp), &
                                      by_tau, [4.8_wp, 5.2_wp])
      settings%starts = [5.0_wp, 5.0_wp]
      settings%most_orbits = 100
      call find_cycles(settings, hopf, found, left_out, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, size(hopf) == 0, "no Hopf point")
      call expect(error, size(found) == 1, "one branch")
      if (allocated(error)) return
      call expect(error, found(1)%branch%ending == "closed", "a closed branch")
      call expect(error, size(found(1)%points) == 2, "two special points")
      if (allocated(error)) return
      call expect(error, all(found(1)%points%kind == fold), "two folds")
      call expect(error, size(left_out) == 1, "the second start is named")
      if (allocated(error)) return
      call expect(error, left_out(1)%reason == "its cycle is on a branch", "and why")
      call expect_close(error, left_out(1)%at, 5.0_wp, 0.0_wp, "and where")
   end subroutine test_closed
end module test_cycle_branches
