!> Events of the blocks of one scene after its transient.
module slip_events_command
   use dde_errors, only: error_type
   use model_history, only: history_type
   use model_problem, only: model_type
   use namelist_input, only: elements
   use program_arguments, only: stop_on
   use scene_input, only: read_scene, scene_type
   use slip_events, only: find_slip_events, slip_event_type
   use slip_events_output, only: write_slip_events
   implicit none (type, external)
   private
   public :: run_slip_events

contains

   !> Events of the blocks of one scene after its transient.
   subroutine run_slip_events(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(history_type) :: history
      type(model_type) :: model
      type(error_type), allocatable :: error
      type(scene_type) :: scene
      type(slip_event_type), allocatable :: events(:)

      call read_scene(namelist_path, scene, model, history, error)
      call stop_on(error)
      call find_slip_events(model, elements(scene%thresholds), scene%t_transient, scene%t_end, &
                            scene%options(), events, error)
      call stop_on(error)
      call write_slip_events(output_path, scene, model, history, events, error)
      call stop_on(error)
   end subroutine run_slip_events
end module slip_events_command
