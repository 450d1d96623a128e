!> The choice between the explicit and the implicit method while a run goes on: by what holds
!> explicit steps back, which each step tells at no cost in evaluations, and by what the last change
!> gave.
module dde_switch
   use dde_problem, only: dde_problem_type
   use dde_slow_series, only: least_balance
   use dde_step, only: step_type
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: switch_type

   !> Above this, in units of the shortest delay, the delay limits an explicit step so far that an
   !> implicit one is cheaper: of the pair, and along a series.
   real(wp), parameter :: beyond_the_delay = 1.5_wp, beyond_with_series = 4.0_wp
   !> Implicit steps in a row that must agree to a return: at first, how many more after a vain
   !> one, and at most.
   integer, parameter :: least_to_return = 3, less_returning = 4, most_to_return = 192
   !> Votes that it takes to leave the explicit method, two from each step that speaks for it and
   !> one back from each that does not: at first, how much more after a vain try, and at most.
   integer, parameter :: least_patience = 8, less_willing = 2, most_patience = 128
   !> It is left only if explicit steps as they are would cost more than this up to the end of the
   !> run, twice what a vain try may cost.
   real(wp), parameter :: worth_a_try = 700.0_wp
   !> The pace of the implicit method is taken over this many steps; the first few grow.
   integer, parameter :: window = 6
   !> They have grown once the next is no longer than this times the step, after so many at least.
   real(wp), parameter :: growing = 1.2_wp
   integer, parameter :: least_grown = 3

   !> Evidence for a change of method.
   type :: switch_type
      !> What speaks for the other method
      integer :: votes = 0
      !> Votes that it takes to leave the explicit method
      integer :: patience = least_patience
      !> Implicit steps that it takes to return
      integer :: steps_to_return = least_to_return
      !> Evaluations when that window began
      integer(int64) :: evaluations_then = 0
      !> Steps since the method, or the present votes, began
      integer :: steps = 0
      !> Time gone in the present window
      real(wp) :: gone = 0.0_wp
      !> Time per cost that each method made before it was left
      real(wp) :: explicit_pace = 0.0_wp, implicit_pace = 0.0_wp
      !> Whether a return to a slow series is on trial
      logical :: on_trial = .false.
   contains
      !> Whether the other method should take over
      procedure :: wanted
   end type switch_type

contains

   !> Whether the method other than that of the accepted `step` should take over.
   pure subroutine wanted(self, problem, step, shortest_delay, h_next, left, other)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step, accepted and complete
      class(step_type), intent(in) :: step
      !> Shortest delay: an explicit step is no longer
      real(wp), intent(in) :: shortest_delay
      !> Length that step control proposes for the next step
      real(wp), intent(in) :: h_next
      !> Time left to the end of the run, as far as there is one
      real(wp), intent(in) :: left
      !> The answer
      logical, intent(out) :: other
      logical :: delay_limits
      real(wp) :: pace

      delay_limits = h_next/merge(beyond_with_series, beyond_the_delay, problem%analytic) &
                     > shortest_delay
      self%gone = self%gone + step%h
      self%steps = self%steps + 1
      if (step%implicit) then
         call judge_implicit(self, step%mild() .and. .not. delay_limits, &
                             in_balance(problem, step) .and. .not. delay_limits, &
                             step%h, h_next, pace_of(self, step), other)
      else if (self%on_trial) then
         other = self%steps == window
         if (other) other = pace_of(self, step) < self%implicit_pace
         self%on_trial = self%steps < window
         if (.not. self%on_trial) then
            self%steps_to_return = merge(min(less_returning*self%steps_to_return, most_to_return), &
                                         least_to_return, other)
         end if
      else
         self%votes = merge(self%votes + 2, max(0, self%votes - 1), &
                            step%held_back() .or. delay_limits)
         other = self%votes >= self%patience
         if (other) then
            ! vain searches for a slow series are no cost of later steps
            pace = merge(self%gone/(step%evaluation_cost*self%steps), pace_of(self, step), &
                         step%foresees)
            other = left > worth_a_try*pace
            if (other) self%explicit_pace = pace
         end if
      end if
      if (other) self%votes = 0
      if (other .or. self%votes == 0 .and. .not. (step%implicit .or. self%on_trial)) self%steps = 0
      if (self%steps == 0 .or. step%implicit .and. modulo(self%steps, window) == 0) then
         self%gone = 0.0_wp
         self%evaluations_then = step%evaluations
      end if
   end subroutine wanted

   !> Time per cost in the present window.
   pure real(wp) function pace_of(self, step) result(pace)
      !> Evidence so far
      class(switch_type), intent(in) :: self
      !> The last step
      class(step_type), intent(in) :: step

      pace = self%gone &
             /(step%evaluation_cost*max(1_int64, step%evaluations - self%evaluations_then))
   end function pace_of

   !> Whether a step of the implicit method is the last before a return: where a step of the other
   !> may be as long, and where it makes less than the other did.
   pure subroutine judge_implicit(self, mild, balanced, h, h_next, pace, other)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> Whether the step is no longer than an explicit one might be
      logical, intent(in) :: mild
      !> Whether a slow series might serve it
      logical, intent(in) :: balanced
      !> Its length
      real(wp), intent(in) :: h
      !> Length proposed for the next
      real(wp), intent(in) :: h_next
      !> Time per cost in the present window
      real(wp), intent(in) :: pace
      !> The answer
      logical, intent(out) :: other
      logical :: slower

      self%votes = merge(self%votes + 1, 0, mild .or. balanced)
      other = self%votes >= merge(least_to_return, self%steps_to_return, mild)
      self%on_trial = other .and. .not. mild
      if (self%on_trial) self%implicit_pace = pace
      if (self%steps <= window) then
         ! the pace that steps of the present length would make
         slower = pace*h*self%steps/self%gone < self%explicit_pace &
                  .and. self%steps >= least_grown .and. h_next <= growing*h
      else
         slower = pace < self%explicit_pace .and. modulo(self%steps, window) == 0
      end if
      other = other .or. slower
      if (other) then
         self%patience = merge(least_patience, min(less_willing*self%patience, most_patience), &
                               pace > self%explicit_pace .and. self%steps > window)
      end if
   end subroutine judge_implicit

   !> Whether fast components are in balance all along a step, for a problem that gives its series.
   pure logical function in_balance(problem, step) result(value)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step, accepted
      class(step_type), intent(in) :: step

      value = problem%analytic .and. step%h*problem%relaxation_rate(step%t + step%h, step%y_new) &
              > least_balance
   end function in_balance
end module dde_switch
