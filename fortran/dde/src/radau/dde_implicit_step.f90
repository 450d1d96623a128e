! SPDX-License-Identifier: BSD-3-Clause
!> One step of a Radau IIA method as method of steps. An attempt is written once, in attempt.inc and
!> attempt_parts.inc, and compiled for one to four equations and for any number, with each number of
!> stages. Of three equations the latter takes 1.6 to 1.8 times the instructions.
module dde_implicit_step
   use dde_attempts_of_any, only: attempt_any_3, attempt_any_5, attempt_any_7
   use dde_attempts_of_few, only: attempt_1_3, attempt_1_5, attempt_1_7, attempt_2_3, attempt_2_5, &
                                  attempt_2_7, attempt_3_3, attempt_3_5, attempt_3_7, attempt_4_3, &
                                  attempt_4_5, attempt_4_7
   use dde_implicit_state, only: implicit_cost, implicit_state
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: implicit_cost, implicit_step_type

   !> The step.
   type, extends(implicit_state) :: implicit_step_type
   contains
      procedure :: attempt
   end type implicit_step_type

contains

   !> Attempt a step: iterate, check the result, estimate its error.
   subroutine attempt(self, context, error)
      class(implicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error
      integer :: equations

      equations = min(5, context%problem%n)
      ! a problem with a band
      if (context%problem%lower >= 0) equations = 5
      select case (10*equations + self%method%stages)
      case (13)
         call attempt_1_3(self, context, error)
      case (15)
         call attempt_1_5(self, context, error)
      case (17)
         call attempt_1_7(self, context, error)
      case (23)
         call attempt_2_3(self, context, error)
      case (25)
         call attempt_2_5(self, context, error)
      case (27)
         call attempt_2_7(self, context, error)
      case (33)
         call attempt_3_3(self, context, error)
      case (35)
         call attempt_3_5(self, context, error)
      case (37)
         call attempt_3_7(self, context, error)
      case (43)
         call attempt_4_3(self, context, error)
      case (45)
         call attempt_4_5(self, context, error)
      case (47)
         call attempt_4_7(self, context, error)
      case (53)
         call attempt_any_3(self, context, error, size(self%y))
      case (55)
         call attempt_any_5(self, context, error, size(self%y))
      case default
         call attempt_any_7(self, context, error, size(self%y))
      end select
   end subroutine attempt
end module dde_implicit_step
