! SPDX-License-Identifier: BSD-3-Clause
!> Trajectory of one scene: its model integrated from its history to t_end.
module trajectory_command
   use dde, only: integrate, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use scene_input, only: read_scene, scene_type
   use trajectory_output, only: trajectory_writer_type
   implicit none (type, external)
   private
   public :: run_trajectory

contains

   !> Run the command.
   subroutine run_trajectory(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(scene_type) :: scene
      type(trajectory_writer_type) :: writer

      call read_scene(namelist_path, scene, error)
      if (allocated(error)) return
      writer = trajectory_writer_type(output_path, scene)
      if (allocated(writer%file%error)) then
         error = writer%file%error
         return
      end if
      call integrate(scene%problem, 0.0_wp, scene%t_end, scene%options(), outcome, error, writer)
      if (allocated(error)) call writer%file%discard()
      if (allocated(error)) return
      call writer%finish(outcome, error)
   end subroutine run_trajectory
end module trajectory_command
