!> Slip events of the blocks of one scene after its transient.
program slip_events_program
   use block_parameters, only: block_history_type
   use dde_errors, only: error_type
   use program_arguments, only: get_paths, stop_on
   use scene_input, only: read_histories, read_scene, scene_type
   use slip_events, only: find_slip_events, slip_event_type
   use slip_events_output, only: write_slip_events
   use spring_block, only: spring_block_type
   implicit none (type, external)
   character(len=:), allocatable :: namelist_path, output_path
   type(block_history_type), allocatable :: histories(:)
   type(error_type), allocatable :: error
   type(scene_type) :: scene
   type(slip_event_type), allocatable :: events(:)

   call get_paths(namelist_path, output_path)
   call read_scene(namelist_path, scene, error)
   call stop_on(error)
   call read_histories(namelist_path, scene, histories, error)
   call stop_on(error)
   call find_slip_events(spring_block_type(scene%parameters, histories), scene%t_transient, &
                         scene%t_end, scene%options(), events, error)
   call stop_on(error)
   call write_slip_events(output_path, scene, histories, events, error)
   call stop_on(error)
end program slip_events_program
