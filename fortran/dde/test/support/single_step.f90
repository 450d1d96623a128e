!> One step without delays, as tests look at it.
module single_step
   use dde_cursor, only: cursor_type
   use dde_history, only: history_type
   use dde_interpolant, only: newton_value
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_time, only: instant_at
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: interpolated, take_step

contains

   !> Take one step from the initial state, dense output included.
   pure subroutine take_step(problem, t, h, step, estimate, relative, absolute)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Start
      real(wp), intent(in) :: t
      !> Length
      real(wp), intent(in) :: h
      !> The step of some method, new; taken on return
      class(step_type), intent(inout) :: step
      !> Its error estimate
      real(wp), intent(out) :: estimate
      !> Relative tolerance; 0 if not given
      real(wp), intent(in), optional :: relative
      !> Absolute tolerance; 1 if not given
      real(wp), intent(in), optional :: absolute
      type(cursor_type) :: cursor
      type(history_type) :: past
      type(work_type) :: work
      real(wp) :: a, r

      a = 1.0_wp
      r = 0.0_wp
      if (present(absolute)) a = absolute
      if (present(relative)) r = relative
      past = history_type(problem, instant_at(t))
      cursor = cursor_type(problem)
      call cursor%set(problem, past, instant_at(t), h)
      call step%restart(problem, past, cursor, work)
      call step%attempt(problem, past, cursor, tolerance_type(problem%n, r, a), work, estimate)
      call step%complete(problem, past, cursor, work)
      call step%extend(problem, past, cursor, work)
   end subroutine take_step

   !> Dense output of all components at place s of the step, 0..1.
   pure function interpolated(step, s) result(y)
      !> The step
      class(step_type), intent(in) :: step
      !> Place
      real(wp), intent(in) :: s
      real(wp) :: y(size(step%y))
      real(wp) :: a(0:size(step%nodes))
      integer :: i

      do i = 1, size(y)
         call step%interpolant(i, a)
         y(i) = newton_value(size(step%nodes), step%nodes, a, s)
      end do
   end function interpolated
end module single_step
