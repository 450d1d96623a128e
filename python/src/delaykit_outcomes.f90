! SPDX-License-Identifier: BSD-3-Clause
!> What a run leaves in its results.
module delaykit_outcomes
   use dde, only: continuation_type, event_table, integration_result
   use dde_errors, only: text
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use results, only: results_type
   implicit none (type, external)
   private
   public :: put_events, put_outcome, put_past, put_samples, put_switched

contains

   !> Times and states.
   subroutine put_samples(data, time, values)
      type(results_type), intent(inout) :: data
      real(wp), intent(in) :: time(:), values(:, :)
      integer :: rows

      rows = data%dimension("t", size(time))
      call data%column(rows, "t", time, "time")
      call data%table([data%dimension("state", size(values, 1)), rows], "y", values, "states")
   end subroutine put_samples

   !> Events.
   subroutine put_events(data, watcher)
      type(results_type), intent(inout) :: data
      type(event_table), intent(in) :: watcher
      integer :: rows

      if (watcher%received == 0) return
      rows = data%dimension("event", watcher%received)
      call data%column(rows, "event_time", watcher%time(:watcher%received)%hi, "time of the event")
      call data%column(rows, "event_which", watcher%which(:watcher%received), &
                       "number of the event, from 1")
      call data%table([data%dimension("state", size(watcher%y, 1)), rows], "event_y", &
                      watcher%y(:, :watcher%received), "state at the event")
   end subroutine put_events

   !> What the solver did, and where it ended.
   subroutine put_outcome(data, outcome, now, switches)
      type(results_type), intent(inout) :: data
      type(integration_result), intent(in) :: outcome
      type(continuation_type), intent(in) :: now
      !> Number of terms that are not smooth
      integer, intent(in) :: switches

      call data%column(data%dimension("count", 9), "counts", &
                       [real(wp) :: outcome%reason, outcome%accepted, outcome%rejected, &
                        outcome%implicit_steps, outcome%evaluations, outcome%factorisations, &
                        outcome%breaking_points, switches, outcome%untracked], &
                       "1 where an event ended the run, steps accepted, rejected and implicit, " &
                       //"evaluations, factorisations, breaking points, terms that are not " &
                       //"smooth, kinks passed over where delays move")
      call data%attribute("method_at_end", trim(now%method))
   end subroutine put_outcome

   !> How often each term that is not smooth switched.
   subroutine put_switched(data, model, outcome)
      type(results_type), intent(inout) :: data
      type(model_type), intent(in) :: model
      type(integration_result), intent(in) :: outcome
      integer :: i

      do i = 1, model%switches
         call data%attribute("switched", model%name_of("switching", i)//achar(9) &
                             //text(outcome%switched(i)))
      end do
   end subroutine put_switched

   !> The past in polynomials, with which another run can begin: dense output.
   subroutine put_past(data, now)
      type(results_type), intent(inout) :: data
      type(continuation_type), intent(in) :: now
      integer :: kinks, nodes, rows, steps

      rows = data%dimension("dense_pair", 2)
      kinks = data%dimension("dense_kink", size(now%passages))
      steps = data%dimension("dense_step", size(now%step_length))
      nodes = data%dimension("dense_node", size(now%nodes, 1))
      call data%column(rows, "dense_origin", now%origin, "initial time of the first run")
      call data%column(rows, "dense_end", now%time, "final time")
      call data%column(data%dimension("state", size(now%y)), "dense_state", now%y, "final state")
      call data%table([rows, kinks], "dense_kink_time", now%kink, "where a derivative jumps")
      call data%column(kinks, "dense_passages", now%passages, "passages through a delay")
      call data%column(kinks, "dense_generation", now%generation, "passages since the cause")
      call data%table([rows, steps], "dense_start", now%step_start, "start of the step")
      call data%column(steps, "dense_length", now%step_length, "length of the step")
      call data%column(steps, "dense_valid_for", now%valid_for, &
                       "time for which its polynomial is valid")
      call data%table([nodes, steps], "dense_nodes", now%nodes, "Newton nodes")
      call data%table([data%dimension("dense_coefficient", size(now%coefficients, 1) &
                                      *size(now%kept)), steps], "dense_coefficients", &
                      reshape(now%coefficients, [size(now%coefficients, 1)*size(now%kept), &
                                                 size(now%step_length)]), &
                      "Newton coefficients, state after state")
   end subroutine put_past
end module delaykit_outcomes
