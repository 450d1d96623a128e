!> Files of slip events.
module slip_events_output
   use block_attributes, only: put_scene
   use block_parameters, only: block_history_type
   use chain, only: blocks_in_order
   use dde_errors, only: error_type
   use netcdf_output, only: output_file_type
   use scene_input, only: scene_type
   use slip_events, only: slip_event_type
   implicit none (type, external)
   private
   public :: write_slip_events

contains

   !> Write the events of a scene.
   subroutine write_slip_events(path, scene, histories, events, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(in) :: scene
      !> Values for t <= 0 of each block
      type(block_history_type), intent(in) :: histories(:)
      !> Slip events of the scene
      type(slip_event_type), intent(in) :: events(:)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows
      integer, allocatable :: order(:)

      call file%create(path, "Slip events of the spring block: times with v above a threshold")
      rows = file%dimension("event", size(events), coordinates="onset")
      call put_scene(file, scene, histories)
      call file%attribute("t_transient", scene%t_transient)
      call file%attribute("t_end", scene%t_end)
      call file%attribute("tolerance", scene%tolerance)
      call file%attribute("method", trim(scene%method))
      if (scene%parameters%is_chain()) then
         order = blocks_in_order(scene%parameters%blocks, scene%parameters%ends)
         call file%column(rows, "number_of_block", order(events%place), &
                          "number of the block in the chain")
      end if
      call file%column(rows, "threshold", events%threshold, "velocity above which a block slips")
      call file%column(rows, "onset", events%onset, "time at which v rises through the threshold")
      call file%column(rows, "recurrence_time", events%recurrence_time, "time to the next onset")
      call file%column(rows, "duration", events%duration, "time above the threshold")
      call file%column(rows, "slip", events%slip, "integral of v over the duration")
      call file%column(rows, "peak_velocity", events%peak_velocity, "largest v of the event")
      call file%column(rows, "least_velocity", events%least_velocity, &
                       "least v up to the next onset")
      call file%finish(error)
   end subroutine write_slip_events
end module slip_events_output
