! SPDX-License-Identifier: BSD-3-Clause
!> The context of a step: what every method is given to attempt one.
module dde_step_context
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_cursor, only: cursor_type
   use dde_history, only: history_type
   use dde_problem, only: dde_problem_type
   use dde_time, only: instant
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: step_context

   !> The context of a step. The run that owns it makes a new one for each problem.
   type :: step_context
      !> The problem
      class(dde_problem_type), pointer :: problem => null()
      !> The past
      type(history_type) :: past
      !> The cursor in the past, on the step
      type(cursor_type) :: cursor
      !> Tolerance of each component
      type(tolerance_type) :: tolerance
      !> Whether values between start and end of the step are read
      logical :: between = .true.
      !> Work so far
      type(work_type) :: work
   contains
      procedure :: go_to, delayed_values, moving_values, evaluate, evaluate_stage
   end type step_context

contains

   !> Let the cursor go to the step from `start`, `length` long.
   pure subroutine go_to(self, start, length)
      class(step_context), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length

      self%past%running = .false.
      call self%cursor%set(self%problem, self%past, start, length)
   end subroutine go_to

   !> All values of constant delays at ascending places of the step.
   pure subroutine delayed_values(self, ahead, z)
      class(step_context), intent(inout) :: self
      !> Times since the start of the step, ascending
      real(wp), contiguous, intent(in) :: ahead(:)
      !> Delayed values, shape (number of delayed values, size(ahead))
      real(wp), intent(inout) :: z(size(self%problem%lag), size(ahead))

      call self%cursor%values(self%problem, self%past, ahead, z)
   end subroutine delayed_values

   !> Right-hand side where delays move. It is not a number where one is out of its bounds.
   pure subroutine evaluate_moving(self, t, y, z, slope)
      class(step_context), intent(inout) :: self
      real(wp), intent(in) :: t, y(self%problem%n)
      real(wp), intent(inout) :: z(size(self%problem%lag)), slope(self%problem%n)
      logical :: good

      call self%moving_values(t, y, z, good)
      if (good) then
         call self%problem%rhs(t, y, z, slope)
      else
         slope = ieee_value(1.0_wp, ieee_quiet_nan)
      end if
   end subroutine evaluate_moving

   !> The values of delays that move, at a state of the step.
   pure subroutine moving_values(self, t, y, z, good)
      class(step_context), intent(inout) :: self
      real(wp), intent(in) :: t, y(self%problem%n)
      real(wp), intent(inout) :: z(size(self%problem%lag))
      !> Whether the delays are finite and in their bounds
      logical, intent(out) :: good

      call self%cursor%moving_values(self%problem, self%past, t, y, z, good)
   end subroutine moving_values

   !> Right-hand side, counted.
   pure subroutine evaluate(self, t, y, z, slope)
      class(step_context), intent(inout) :: self
      real(wp), intent(in) :: t, y(self%problem%n)
      !> Delayed values; those of delays that move are set
      real(wp), intent(inout) :: z(size(self%problem%lag))
      real(wp), intent(inout) :: slope(self%problem%n)

      call self%evaluate_stage(self%problem%moving > 0, t, y, z, slope)
   end subroutine evaluate

   !> Right-hand side, counted, where it is known whether delays move. Values that were found
   !> otherwise are not set.
   pure subroutine evaluate_stage(self, moves, t, y, z, slope)
      class(step_context), intent(inout) :: self
      !> Whether to set those that move: 4 % of the instructions of a run if it is found out in each
      !> stage
      logical, intent(in) :: moves
      real(wp), intent(in) :: t, y(self%problem%n)
      real(wp), intent(inout) :: z(size(self%problem%lag)), slope(self%problem%n)

      if (moves) then
         call evaluate_moving(self, t, y, z, slope)
      else
         call self%problem%rhs(t, y, z, slope)
      end if
      self%work%evaluations = self%work%evaluations + 1
   end subroutine evaluate_stage
end module dde_step_context
