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
      !> Work so far
      type(work_type) :: work
   contains
      !> Go to a step
      procedure :: go_to
      !> All delayed values at places of the step
      procedure :: delayed_values
      !> Right-hand side, counted
      procedure :: evaluate
   end type step_context

contains

   !> Let the cursor go to the step from `start`, `length` long.
   pure subroutine go_to(self, start, length)
      !> The context
      class(step_context), intent(inout) :: self
      !> Start of the step
      type(instant), intent(in) :: start
      !> Length of the step
      real(wp), intent(in) :: length

      call self%cursor%set(self%problem, self%past, start, length)
   end subroutine go_to

   !> All delayed values at ascending places of the step.
   pure subroutine delayed_values(self, ahead, z)
      !> The context
      class(step_context), intent(inout) :: self
      !> Times since the start of the step, ascending, at most 16
      real(wp), contiguous, intent(in) :: ahead(:)
      !> Delayed values, shape (number of delayed values, size(ahead))
      real(wp), contiguous, intent(out) :: z(:, :)

      call self%cursor%values(self%problem, self%past, ahead, z)
   end subroutine delayed_values

   !> Right-hand side, counted.
   pure subroutine evaluate(self, t, y, z, slope)
      !> The context
      class(step_context), intent(inout) :: self
      !> Time
      real(wp), intent(in) :: t
      !> State
      real(wp), intent(in) :: y(self%problem%n)
      !> Delayed values
      real(wp), intent(in) :: z(size(self%problem%lag))
      !> Slope
      real(wp), intent(inout) :: slope(self%problem%n)

      call self%problem%rhs(t, y, z, slope)
      self%work%evaluations = self%work%evaluations + 1
   end subroutine evaluate
end module dde_step_context
