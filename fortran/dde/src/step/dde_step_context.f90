! SPDX-License-Identifier: BSD-3-Clause
!> The context of a step: what every method is given to attempt one.
module dde_step_context
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
      procedure :: go_to, delayed_values, evaluate
   end type step_context

contains

   !> Let the cursor go to the step from `start`, `length` long.
   pure subroutine go_to(self, start, length)
      class(step_context), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length

      call self%cursor%set(self%problem, self%past, start, length)
   end subroutine go_to

   !> All delayed values at ascending places of the step.
   pure subroutine delayed_values(self, ahead, z)
      class(step_context), intent(inout) :: self
      !> Times since the start of the step, ascending
      real(wp), contiguous, intent(in) :: ahead(:)
      !> Delayed values, shape (number of delayed values, size(ahead))
      real(wp), intent(out) :: z(size(self%problem%lag), size(ahead))

      call self%cursor%values(self%problem, self%past, ahead, z)
   end subroutine delayed_values

   !> Right-hand side, counted.
   pure subroutine evaluate(self, t, y, z, slope)
      class(step_context), intent(inout) :: self
      real(wp), intent(in) :: t, y(self%problem%n), z(size(self%problem%lag))
      real(wp), intent(inout) :: slope(self%problem%n)

      call self%problem%rhs(t, y, z, slope)
      self%work%evaluations = self%work%evaluations + 1
   end subroutine evaluate
end module dde_step_context
