!> The choice of `auto` between the explicit and the implicit method while a run goes on.
!>
!> Explicit steps that are held back (by stability, or by a short delay) vote for the implicit
!> method, short implicit steps for the explicit one. A method that makes less time for its work
!> than the other did is left at once. A change that failed is not tried again before as much work
!> is done as it costs, twice as much after each further failure in a row, at most all work so far.
module dde_switch
   use dde_problem, only: dde_problem_type
   use dde_slow_series, only: least_balance
   use dde_step, only: step_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: switch_type

   !> How much longer the next try of a method waits after one more that failed; no longer than for
   !> as much work as was done so far.
   real(wp), parameter :: longer = 2.0_wp
   !> Above this, in units of the shortest delay, the delay limits an explicit step so far that an
   !> implicit one is cheaper: of the pair, and along a series.
   real(wp), parameter :: beyond_the_delay = 1.5_wp, beyond_with_series = 4.0_wp
   !> Votes to leave the explicit method, two from each step that is held back and one back from
   !> each that is not; no more than twice as many are kept.
   integer, parameter :: most_votes = 8
   !> Implicit steps in a row that must agree to a return.
   integer, parameter :: least_to_return = 3
   !> Steps over which a pace is taken; the first few implicit ones grow.
   integer, parameter :: window = 6
   !> They have grown once the next is no longer than this times the step, after so many at least.
   real(wp), parameter :: growing = 1.2_wp
   integer, parameter :: least_grown = 3

   !> Tries of a method.
   type :: tries_type
      !> Failures in a row
      integer :: failures = 0
      !> Work before which there is no other try
      real(wp) :: not_before = 0.0_wp
   contains
      !> Take in how a try ended
      procedure :: ended
   end type tries_type

   !> Evidence for a change of method.
   type :: switch_type
      !> Cost of a change: what a failed try of the implicit method takes
      real(wp) :: price = 0.0_wp
      !> Work to be done after a failed try of each method until the next, and work at which that
      !> may be
      type(tries_type), private :: of_explicit, of_implicit
      !> Whether the method in use took over from the other, its steps since then, and the work done
      !> before
      logical, private :: took_over = .false.
      integer, private :: taken = 0
      real(wp), private :: work_before = 0.0_wp
      !> What speaks for the other method
      integer, private :: votes = 0
      !> Steps, time gone and work done when it began, in the window of the present pace
      integer, private :: steps = 0
      real(wp), private :: gone = 0.0_wp, work_then = 0.0_wp
      !> Time per work that each method made before it was left
      real(wp), private :: explicit_pace = 0.0_wp, implicit_pace = 0.0_wp
   contains
      !> Take in a step, and see whether the other method should take over
      procedure :: judge
      procedure, private :: judge_explicit, judge_implicit
   end type switch_type

contains

   !> Take in an accepted step, and see whether the other method should take over.
   pure subroutine judge(self, problem, step, work, shortest_delay, h_next, left, other)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step, accepted and complete
      class(step_type), intent(in) :: step
      !> Work done so far
      real(wp), intent(in) :: work
      !> Shortest delay, where an implicit step may be longer than it
      real(wp), intent(in) :: shortest_delay
      !> Length that step control proposes for the next step
      real(wp), intent(in) :: h_next
      !> Time left to the end of the run, as far as there is one
      real(wp), intent(in) :: left
      !> The answer
      logical, intent(out) :: other
      logical :: delay_limits

      delay_limits = h_next/merge(beyond_with_series, beyond_the_delay, problem%analytic) &
                     > shortest_delay
      self%gone = self%gone + step%h
      self%steps = self%steps + 1
      self%taken = self%taken + 1
      if (step%constants%implicit) then
         call self%judge_implicit(problem, step, work, delay_limits, h_next, other)
         if (modulo(self%steps, window) == 0) call start_window(self, work)
      else
         call self%judge_explicit(problem, step, work, delay_limits, left, other)
         if (self%votes == 0 .and. .not. (self%took_over .and. self%taken < window)) then
            call start_window(self, work)
         end if
      end if
      if (.not. other) return
      call start_window(self, work)
      self%votes = 0
      self%taken = 0
      self%took_over = .true.
      self%work_before = work
   end subroutine judge

   !> Take in how a try of a method ended.
   pure subroutine ended(self, failed, price, work)
      !> The tries
      class(tries_type), intent(inout) :: self
      !> Whether it failed
      logical, intent(in) :: failed
      !> What a try costs
      real(wp), intent(in) :: price
      !> Work done so far
      real(wp), intent(in) :: work

      self%failures = merge(self%failures + 1, 0, failed)
      if (failed) then
         self%not_before = work + min(price*longer**min(self%failures - 1, 20), work)
      end if
   end subroutine ended

   !> A new window for the pace.
   pure subroutine start_window(self, work)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> Work done so far
      real(wp), intent(in) :: work

      self%steps = 0
      self%gone = 0.0_wp
      self%work_then = work
   end subroutine start_window

   !> Whether an explicit step is the last before a change.
   pure subroutine judge_explicit(self, problem, step, work, delay_limits, left, other)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> Work done so far
      real(wp), intent(in) :: work
      !> Whether the delay limits steps
      logical, intent(in) :: delay_limits
      !> Time left to the end of the run
      real(wp), intent(in) :: left
      !> The answer
      logical, intent(out) :: other
      logical :: slower
      real(wp) :: pace

      ! searches for a slow series that failed are no cost of later steps
      pace = self%gone/merge(step%constants%evaluation_cost*self%steps, &
                             max(1.0_wp, work - self%work_then), problem%analytic)
      self%votes = merge(min(self%votes + 2, 2*most_votes), max(0, self%votes - 1), &
                         step%stiff() .or. delay_limits)
      other = self%votes >= most_votes .and. left > 2*self%price*pace &
              .and. work >= self%of_implicit%not_before
      slower = self%took_over .and. self%taken == window .and. pace < self%implicit_pace
      other = other .or. slower
      if (.not. other) return
      self%explicit_pace = pace
      if (self%took_over) then
         call self%of_explicit%ended(slower .or. work - self%work_before < self%price, self%price, &
                                     work)
      end if
   end subroutine judge_explicit

   !> Whether an implicit step is the last before a change: where a step of the other method may be
   !> as long, and where it makes less than the other did.
   pure subroutine judge_implicit(self, problem, step, work, delay_limits, h_next, other)
      !> Evidence so far
      class(switch_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> Work done so far
      real(wp), intent(in) :: work
      !> Whether the delay limits explicit steps
      logical, intent(in) :: delay_limits
      !> Length proposed for the next
      real(wp), intent(in) :: h_next
      !> The answer
      logical, intent(out) :: other
      logical :: slower
      real(wp) :: pace

      pace = self%gone/max(1.0_wp, work - self%work_then)
      if (self%taken <= window) then
         ! so far, and as steps of the present length would make it
         slower = pace*max(1.0_wp, step%h*self%steps/self%gone) < self%explicit_pace &
                  .and. self%taken >= least_grown .and. h_next <= growing*step%h
      else
         slower = pace < self%explicit_pace .and. modulo(self%steps, window) == 0
      end if
      self%votes = merge(self%votes + 1, 0, &
                         (.not. step%stiff() .or. in_balance(problem, step)) &
                         .and. .not. delay_limits)
      other = slower .or. self%votes >= least_to_return .and. work >= self%of_explicit%not_before
      if (.not. other) return
      self%implicit_pace = pace
      call self%of_implicit%ended(self%taken <= window .and. pace < self%explicit_pace, &
                                  self%price, work)
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
