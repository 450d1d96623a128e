!> Slip events of the blocks of one scene after its transient.
module slip_events_command
   use block_parameters, only: block_history_type
   use dde_errors, only: error_type
   use program_arguments, only: stop_on
   use namelist_input, only: elements
   use scene_input, only: read_histories, read_scene, scene_type
   use slip_events, only: find_slip_events, slip_event_type
   use slip_events_output, only: write_slip_events
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: run_slip_events

contains

   !> Slip events of the blocks of one scene after its transient.
   subroutine run_slip_events(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(block_history_type), allocatable :: histories(:)
      type(error_type), allocatable :: error
      type(scene_type) :: scene
      type(slip_event_type), allocatable :: events(:)

      call read_scene(namelist_path, scene, error)
      call stop_on(error)
      call read_histories(namelist_path, scene, histories, error)
      call stop_on(error)
      call find_slip_events(spring_block_type(scene%parameters, histories), &
                            elements(scene%thresholds), scene%t_transient, scene%t_end, &
                            scene%options(), events, error)
      call stop_on(error)
      call write_slip_events(output_path, scene, histories, events, error)
      call stop_on(error)
   end subroutine run_slip_events
end module slip_events_command
