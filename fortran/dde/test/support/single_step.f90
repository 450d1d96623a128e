! SPDX-License-Identifier: BSD-3-Clause
!> One step without delays, as tests look at it.
module single_step
   use dde_cursor, only: cursor_type
   use dde_history, only: history_type
   use dde_interpolant, only: newton_state
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_time, only: instant
   use dde_taylor_step, only: taylor_step_type
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: interpolated, new_context, take_step, take_taylor_step

contains

   !> The context of a step at the initial time, its past empty.
   function new_context(problem, t, h, relative, absolute) result(context)
      class(dde_problem_type), intent(in), target :: problem
      real(wp), intent(in) :: t, h
      !> Relative and absolute tolerance
      real(wp), intent(in) :: relative, absolute
      type(step_context) :: context

      context%problem => problem
      context%past = history_type(problem, instant(t))
      context%cursor = cursor_type(problem)
      context%tolerance = tolerance_type(problem%n, relative, absolute)
      context%work = work_type(equations=problem%n)
      call context%go_to(instant(t), h)
   end function new_context

   !> Take one step from the initial state, dense output included.
   subroutine take_step(problem, t, h, step, estimate, relative, absolute)
      class(dde_problem_type), intent(in), target :: problem
      real(wp), intent(in) :: t, h
      class(step_type), intent(inout) :: step
      real(wp), intent(out) :: estimate
      !> Relative tolerance; 0 if not given
      real(wp), intent(in), optional :: relative
      !> Absolute tolerance; 1 if not given
      real(wp), intent(in), optional :: absolute
      type(step_context) :: context
      real(wp) :: a, r

      a = 1.0_wp
      r = 0.0_wp
      if (present(absolute)) a = absolute
      if (present(relative)) r = relative
      context = new_context(problem, t, h, r, a)
      call step%restart(context)
      call step%attempt(context, estimate)
   end subroutine take_step

   !> Take one Taylor step of length `h`, or of `h` times that which the series allows.
   subroutine take_taylor_step(problem, tolerance, h, step, estimate, in_shares)
      class(dde_problem_type), intent(in), target :: problem
      real(wp), intent(in) :: tolerance, h
      type(taylor_step_type), intent(out) :: step
      real(wp), intent(out) :: estimate
      !> Whether h is such a share; not if not given
      logical, intent(in), optional :: in_shares
      type(step_context) :: context
      real(wp) :: lacking, length

      call step%set_up(problem, tolerance, lacking)
      context = new_context(problem, 0.0_wp, 1.0e3_wp, 0.0_wp, tolerance)
      length = 1.0e-6_wp
      call step%propose(context, length)
      context%cursor%h = h
      if (present(in_shares)) context%cursor%h = h*length
      call step%attempt(context, estimate)
   end subroutine take_taylor_step

   !> Dense output of all components at place s of the step, 0..1.
   pure function interpolated(step, s) result(y)
      class(step_type), intent(in) :: step
      real(wp), intent(in) :: s
      real(wp) :: y(size(step%y))
      real(wp) :: a(0:size(step%nodes)), slope
      integer :: i

      do i = 1, size(y)
         call step%interpolant(i, a)
         call newton_state(step%nodes, a, s, y(i), slope)
      end do
   end function interpolated
end module single_step
