!> Files of events.
module slip_events_output
   use dde_errors, only: error_type
   use model_chain, only: blocks_in_order
   use model_history, only: history_type, signal_name
   use model_problem, only: model_type
   use netcdf_output, only: output_file_type
   use scene_input, only: put_scene, scene_type
   use slip_events, only: slip_event_type
   implicit none (type, external)
   private
   public :: write_slip_events

contains

   !> Write the events of a scene.
   subroutine write_slip_events(path, scene, model, history, events, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(in) :: scene
      !> Its model
      type(model_type), intent(in) :: model
      !> Its history
      type(history_type), intent(in) :: history
      !> Events of the scene
      type(slip_event_type), intent(in) :: events(:)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows
      integer, allocatable :: order(:)
      character(len=:), allocatable :: name

      call file%create(path, "Events: times with "//signal_name(model)//" above a threshold")
      rows = file%dimension("event", size(events), coordinates="onset")
      call put_scene(file, scene, model, history)
      call file%attribute("t_transient", scene%t_transient)
      call file%attribute("t_end", scene%t_end)
      call file%attribute("tolerance", scene%tolerance)
      call file%attribute("method", trim(scene%method))
      if (model%shape%blocks > 1) then
         order = blocks_in_order(model%shape%blocks, trim(model%ends))
         call file%column(rows, "number_of_block", order(events%place), &
                          "number of the block in the chain")
      end if
      name = signal_name(model)
      call file%column(rows, "threshold", events%threshold, name//" above which there is an event")
      call file%column(rows, "onset", events%onset, &
                       "time at which "//name//" rises through the threshold")
      call file%column(rows, "recurrence_time", events%recurrence_time, "time to the next onset")
      call file%column(rows, "duration", events%duration, "time above the threshold")
      call file%column(rows, "slip", events%slip, "integral of "//name//" over the duration")
      call file%column(rows, "peak_velocity", events%peak_velocity, &
                       "largest "//name//" of the event")
      call file%column(rows, "least_velocity", events%least_velocity, &
                       "least "//name//" up to the next onset")
      call file%finish(error)
   end subroutine write_slip_events
end module slip_events_output
