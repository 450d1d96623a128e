! SPDX-License-Identifier: BSD-3-Clause
!> Events of the blocks of one scene after its transient.
module slip_events_command
   use dde_errors, only: error_type
   use namelist_input, only: elements
   use scene_input, only: read_scene, scene_type
   use slip_events, only: find_slip_events, slip_event_type
   use slip_events_output, only: write_slip_events
   implicit none (type, external)
   private
   public :: run_slip_events

contains

   !> Run the command.
   subroutine run_slip_events(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      type(slip_event_type), allocatable :: events(:)

      call read_scene(namelist_path, scene, error)
      if (allocated(error)) return
      call find_slip_events(scene%problem, elements(scene%thresholds), scene%t_transient, &
                            scene%t_end, scene%options(), events, error)
      if (allocated(error)) return
      call write_slip_events(output_path, scene, events, error)
   end subroutine run_slip_events
end module slip_events_command
