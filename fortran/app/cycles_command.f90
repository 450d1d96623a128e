! SPDX-License-Identifier: BSD-3-Clause
!> Cycles along a line of parameters: stable and unstable branches, their special points, and curves
!> of these over two parameters.
module cycles_command
   use cycle_branches, only: cycle_settings_type, cycles_type, find_cycles, left_out_type
   use cycle_curves, only: cycle_curve_type, find_curves
   use cycles_files, only: read_cycles, write_cycles
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise
   use hopf_lines, only: hopf_on_line_type
   use progress, only: progress_type
   implicit none (type, external)
   private
   public :: run_cycles

contains

   !> Run the command.
   subroutine run_cycles(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(cycle_settings_type) :: settings
      type(cycle_curve_type), allocatable :: curves(:)
      type(cycles_type), allocatable :: found(:)
      type(hopf_on_line_type), allocatable :: hopf(:)
      type(left_out_type), allocatable :: left_out(:)
      type(progress_type) :: report

      call read_cycles(namelist_path, settings, error)
      if (allocated(error)) return
      report = progress_type("branches of cycles")
      call find_cycles(settings, hopf, found, left_out, error, report)
      if (allocated(error)) return
      report = progress_type("curves of their special points")
      call find_curves(settings, found, curves, error, report)
      if (allocated(error)) return
      if (stop_requested /= 0) call raise(error, "cycles: interrupted")
      if (allocated(error)) return
      call write_cycles(output_path, settings, hopf, found, left_out, curves, error)
   end subroutine run_cycles
end module cycles_command
