!> Trajectory of one scene: the delayed block integrated from its history to t_end.
module trajectory_command
   use block_parameters, only: block_history_type
   use dde, only: integrate, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use program_arguments, only: stop_on
   use scene_input, only: read_histories, read_scene, scene_type
   use spring_block, only: spring_block_type
   use trajectory_output, only: trajectory_writer_type
   implicit none (type, external)
   private
   public :: run_trajectory

contains

   !> Trajectory of one scene: the delayed block integrated from its history to t_end.
   subroutine run_trajectory(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(block_history_type), allocatable :: histories(:)
      type(error_type), allocatable :: error
      type(integration_result) :: outcome
      type(scene_type) :: scene
      type(spring_block_type) :: block_model
      type(trajectory_writer_type) :: writer

      call read_scene(namelist_path, scene, error)
      call stop_on(error)
      call read_histories(namelist_path, scene, histories, error)
      call stop_on(error)

      block_model = spring_block_type(scene%parameters, histories)
      writer = trajectory_writer_type(output_path, scene, histories)
      call stop_on(writer%file%error)
      call integrate(block_model, 0.0_wp, scene%t_end, scene%options(), outcome, error, writer)
      if (allocated(error)) call writer%file%discard()
      call stop_on(error)
      call writer%finish(outcome, error)
      call stop_on(error)
   end subroutine run_trajectory
end module trajectory_command
