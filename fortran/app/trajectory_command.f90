!> Trajectory of one scene: its model integrated from its history to t_end.
module trajectory_command
   use dde, only: integrate, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_history, only: history_type
   use model_problem, only: model_type
   use program_arguments, only: stop_on
   use scene_input, only: read_scene, scene_type
   use trajectory_output, only: trajectory_writer_type
   implicit none (type, external)
   private
   public :: run_trajectory

contains

   !> Trajectory of one scene: its model integrated from its history to t_end.
   subroutine run_trajectory(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(history_type) :: history
      type(error_type), allocatable :: error
      type(integration_result) :: outcome
      type(scene_type) :: scene
      type(model_type) :: model
      type(trajectory_writer_type) :: writer

      call read_scene(namelist_path, scene, model, history, error)
      call stop_on(error)
      writer = trajectory_writer_type(output_path, scene, model, history)
      call stop_on(writer%file%error)
      call integrate(model, 0.0_wp, scene%t_end, scene%options(), outcome, error, writer)
      if (allocated(error)) call writer%file%discard()
      call stop_on(error)
      call writer%finish(outcome, error)
      call stop_on(error)
   end subroutine run_trajectory
end module trajectory_command
