! SPDX-License-Identifier: BSD-3-Clause
!> Events of the blocks of one scene after its transient.
module slip_events_command
   use dde_errors, only: error_type
   use model_chain, only: blocks_in_order
   use model_history, only: signal_name
   use request, only: elements, request_type
   use results, only: results_type
   use scene_request, only: read_scene, scene_type
   use slip_events, only: find_slip_events, slip_event_type
   implicit none (type, external)
   private
   public :: run_slip_events

contains

   !> Run the command.
   subroutine run_slip_events(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      type(slip_event_type), allocatable :: events(:)

      call read_scene(given, scene, error)
      if (allocated(error)) return
      call find_slip_events(scene%problem, elements(scene%thresholds), scene%t_transient, &
                            scene%t_end, scene%options(), events, error)
      if (.not. allocated(error)) call put_events(data, scene, events)
   end subroutine run_slip_events

   !> The events of a scene.
   subroutine put_events(data, scene, events)
      class(results_type), intent(inout) :: data
      type(scene_type), intent(in) :: scene
      type(slip_event_type), intent(in) :: events(:)
      integer :: rows
      integer, allocatable :: order(:)
      character(len=:), allocatable :: name

      name = signal_name(scene%problem)
      call data%attribute("title", "Events: times with "//name//" above a threshold")
      rows = data%dimension("event", size(events), coordinates="onset")
      call scene%put(data)
      call data%attribute("t_transient", scene%t_transient)
      call data%attribute("t_end", scene%t_end)
      call data%attribute("tolerance", scene%tolerance)
      call data%attribute("method", trim(scene%method))
      if (scene%model%blocks > 1) then
         order = blocks_in_order(scene%model%blocks, trim(scene%model%ends))
         call data%column(rows, "number_of_block", order(events%place), &
                          "number of the block in the chain")
      end if
      call data%column(rows, "threshold", events%threshold, name//" above which there is an event")
      call data%column(rows, "onset", events%onset, &
                       "time at which "//name//" rises through the threshold")
      call data%column(rows, "recurrence_time", events%recurrence_time, "time to the next onset")
      call data%column(rows, "duration", events%duration, "time above the threshold")
      call data%column(rows, "slip", events%slip, "integral of "//name//" over the duration")
      call data%column(rows, "peak_velocity", events%peak_velocity, &
                       "largest "//name//" of the event")
      call data%column(rows, "least_velocity", events%least_velocity, &
                       "least "//name//" up to the next onset")
   end subroutine put_events
end module slip_events_command
