!> The choice between the explicit and the implicit method while a run goes on: by h times the
!> stiffness, which each step measures at no cost in evaluations, and by what the last change gave.
module dde_switch
   use dde_step, only: step_type
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: switch_type

   !> Above this, stability limits an explicit step.
   real(wp), parameter :: limited_by_stability = 2.5_wp
   !> Below this, an explicit step may be as long as the implicit one is.
   real(wp), parameter :: worth_returning = 8.0_wp
   !> Above this, in units of the shortest delay, the delay limits an explicit step.
   real(wp), parameter :: beyond_the_delay = 1.5_wp
   !> Implicit steps in a row that must agree to a return.
   integer, parameter :: steps_to_return = 3
   !> Votes that it takes to leave the explicit method, two from each step that speaks for it and
   !> one back from each that does not: at first, how much more after a vain try, and at most.
   integer, parameter :: least_patience = 8, less_willing = 4, most_patience = 512
   !> The pace of the implicit method is taken over this many steps, the first time after as many
   !> that it needs to grow them.
   integer, parameter :: window = 6

   !> Evidence for a change of method.
   type :: switch_type
      !> What speaks for the other method
      integer :: votes = 0
      !> Votes that it takes to leave the explicit method
      integer :: patience = least_patience
      !> Evaluations when that window began
      integer(int64) :: evaluations_then = 0
      !> Implicit steps since
      integer :: steps = 0
      !> Time gone in the present window
      real(wp) :: gone = 0.0_wp
      !> Time per cost that the explicit method made before it was left
      real(wp) :: explicit_pace = 0.0_wp
   contains
      !> Whether the other method should take over
      procedure :: wanted
   end type switch_type

contains

   !> Whether the method other than that of the accepted `step` should take over.
   pure subroutine wanted(self, step, shortest_delay, h_next, other)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> The step, accepted and complete
      class(step_type), intent(in) :: step
      !> Shortest delay: an explicit step is no longer
      real(wp), intent(in) :: shortest_delay
      !> Length that step control proposes for the next step
      real(wp), intent(in) :: h_next
      !> The answer
      logical, intent(out) :: other
      real(wp) :: measure, pace

      measure = step%h*step%stiffness()
      self%gone = self%gone + step%h
      if (step%implicit) then
         self%steps = self%steps + 1
         self%votes = merge(self%votes + 1, 0, measure < worth_returning &
                            .and. h_next/beyond_the_delay < shortest_delay)
         pace = self%gone/(step%evaluation_cost*(step%evaluations - self%evaluations_then))
         other = self%votes >= steps_to_return
         if (modulo(self%steps, window) == 0) then
            if (self%steps > window) other = other .or. pace < self%explicit_pace
            self%gone = 0.0_wp
            self%evaluations_then = step%evaluations
         end if
         if (other) then
            self%patience = merge(least_patience, min(less_willing*self%patience, most_patience), &
                                  pace > self%explicit_pace)
         end if
      else
         if (measure > limited_by_stability .or. h_next/beyond_the_delay > shortest_delay) then
            self%votes = self%votes + 2
         else
            self%votes = max(0, self%votes - 1)
         end if
         if (self%votes == 0) then
            self%gone = 0.0_wp
            self%evaluations_then = step%evaluations
         end if
         other = self%votes >= self%patience
         if (other) then
            self%explicit_pace = self%gone &
                                 /(step%evaluation_cost*max(1_int64, step%evaluations &
                                                            - self%evaluations_then))
         end if
      end if
      if (other) then
         self%votes = 0
         self%steps = 0
         self%gone = 0.0_wp
         self%evaluations_then = step%evaluations
      end if
   end subroutine wanted
end module dde_switch
