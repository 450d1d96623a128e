! SPDX-License-Identifier: BSD-3-Clause
!> Hopf curves in one plane of parameters, their special points, and the number of unstable roots.
module hopf_command
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use hopf_curves, only: curve_point_type, trace_curves
   use hopf_files, only: hopf_settings_type, read_plane, write_curves
   use hopf_planes, only: curve_plane_type, middles
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use model_roots, only: check_rest
   implicit none (type, external)
   private
   public :: run_hopf

contains

   !> Run the command.
   subroutine run_hopf(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(hopf_settings_type) :: settings
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: special(:)
      integer, allocatable :: roots(:, :)
      real(wp), allocatable :: grid(:)

      call read_plane(namelist_path, settings, plane, error)
      if (allocated(error)) return
      ! the edges of the window, and the middles of the cells
      grid = [0.0_wp, middles([0.0_wp, 1.0_wp], settings%cells), 1.0_wp]
      roots = plane%unstable_roots(grid, grid)
      if (all(roots < 0)) call check_rest(plane%model, error)
      if (allocated(error)) return
      call trace_curves(plane, grid, grid, roots, points, error)
      if (allocated(error)) return
      call judge_points(plane, points)
      call find_hopf_points(plane, points, special, error)
      if (stop_requested /= 0) call raise(error, "Hopf curves: interrupted")
      if (allocated(error)) return
      call write_curves(output_path, settings, plane, points, special, &
                        roots(2:settings%cells + 1, 2:settings%cells + 1), error)
   end subroutine run_hopf
end module hopf_command
