! SPDX-License-Identifier: BSD-3-Clause
!> What a run leaves in its results.
module delaykit_outcomes
   use dde, only: continuation_type, event_table, find_jacobian, integration_result
   use dde_errors, only: text
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use results, only: results_type
   use tangent_problem, only: allocate_slopes
   implicit none (type, external)
   private
   public :: put_events, put_linear_part, put_outcome, put_past, put_samples, put_switched

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

   !> The equations at a constant past, and their derivatives that are not 0.
   subroutine put_linear_part(data, model, t)
      type(results_type), intent(inout) :: data
      !> The model with its past
      type(model_type), intent(in) :: model
      !> Time
      real(wp), intent(in) :: t
      real(wp), allocatable :: by_y(:, :), by_z(:, :), entries(:, :)
      real(wp) :: rate(model%n), z(size(model%lag))
      integer :: i, j, number, rows, shift

      z = model%past(model%component)
      call model%rhs(t, model%past, z, rate)
      call allocate_slopes(model, by_y, by_z)
      call find_jacobian(model, t, model%past, z, by_y, by_z)
      number = count(abs(by_y) > 0.0_wp) + count(abs(by_z) > 0.0_wp)
      allocate (entries(number, 4))
      number = 0
      do j = 1, size(by_y, 2)
         shift = merge(j - 1 - model%upper, 0, model%lower >= 0)
         do i = 1, size(by_y, 1)
            if (abs(by_y(i, j)) > 0.0_wp) call put(i + shift, j, 0.0_wp, by_y(i, j))
         end do
      end do
      do j = 1, size(by_z, 2)
         shift = 0
         if (model%lower >= 0) shift = model%rows(1, j) - 1
         do i = 1, size(by_z, 1)
            if (abs(by_z(i, j)) > 0.0_wp) then
               call put(i + shift, model%component(j), model%lag(j), by_z(i, j))
            end if
         end do
      end do
      call data%column(data%dimension("state", model%n), "rate", rate, "right-hand side")
      rows = data%dimension("entry", number)
      call data%column(rows, "row", entries(:, 1), "number of the equation, from 1")
      call data%column(rows, "column", entries(:, 2), "number of the state, from 1")
      call data%column(rows, "lag", entries(:, 3), "time for which the state is delayed")
      call data%column(rows, "value", entries(:, 4), "derivative")

   contains

      !> Keep a derivative.
      subroutine put(row, column, lag, value)
         integer, intent(in) :: row, column
         real(wp), intent(in) :: lag, value

         number = number + 1
         entries(number, :) = [real(row, wp), real(column, wp), lag, value]
      end subroutine put
   end subroutine put_linear_part

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
