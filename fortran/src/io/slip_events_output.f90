! SPDX-License-Identifier: BSD-3-Clause
!> Files of events.
module slip_events_output
   use dde_errors, only: error_type
   use model_chain, only: blocks_in_order
   use model_history, only: signal_name
   use output_file, only: output_file_type
   use scene_input, only: scene_type
   use slip_events, only: slip_event_type
   implicit none (type, external)
   private
   public :: write_slip_events

contains

   !> Write the events of a scene.
   subroutine write_slip_events(path, scene, events, error)
      character(len=*), intent(in) :: path
      type(scene_type), intent(in) :: scene
      type(slip_event_type), intent(in) :: events(:)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows
      integer, allocatable :: order(:)
      character(len=:), allocatable :: name

      name = signal_name(scene%problem)
      call file%create(path, "Events: times with "//name//" above a threshold")
      rows = file%dimension("event", size(events), coordinates="onset")
      call scene%put(file)
      call file%attribute("t_transient", scene%t_transient)
      call file%attribute("t_end", scene%t_end)
      call file%attribute("tolerance", scene%tolerance)
      call file%attribute("method", trim(scene%method))
      if (scene%model%blocks > 1) then
         order = blocks_in_order(scene%model%blocks, trim(scene%model%ends))
         call file%column(rows, "number_of_block", order(events%place), &
                          "number of the block in the chain")
      end if
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
