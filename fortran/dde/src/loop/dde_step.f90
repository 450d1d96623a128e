!> The face that all step methods share: given the state, a step and the past, a new state, an error
!> estimate and an interpolant. The integrator does not ask which method it is.
module dde_step
   use dde_history, only: history_type
   use dde_problem, only: dde_problem_type
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: step_type

   !> One step of some method.
   type, abstract :: step_type
      !> Name of the method
      character(len=8) :: name = ""
      !> Order of the method
      integer :: order = 0
      !> Power of the step length that the error estimate falls with
      integer :: error_order = 0
      !> Whether the method is implicit: steps may then be longer than the shortest delay
      logical :: implicit = .false.
      !> Newton nodes of its interpolant, and whether all of them are 0
      real(wp), allocatable :: nodes(:)
      logical :: powers = .false.
      !> State at the start of the step, shape (n)
      real(wp), allocatable :: y(:)
      !> State at its end, shape (n)
      real(wp), allocatable :: y_new(:)
      !> Slope at the start of the step, shape (n)
      real(wp), allocatable :: slope(:)
      !> Tolerance of each component, shape (n)
      real(wp), allocatable :: scale(:)
      !> Delayed values at one place, shape (number of delayed values, 1)
      real(wp), allocatable :: z(:, :)
      !> Start of the step as an ordinary number
      real(wp) :: t = 0.0_wp
      !> Length of the step
      real(wp) :: h = 0.0_wp
      !> Times that the right-hand side is asked for lie between these: it may jump where the step
      !> starts and ends
      real(wp) :: earliest = -huge(1.0_wp), latest = huge(1.0_wp)
      !> Share of the ideal length that the next step should have
      real(wp) :: safety = 0.9_wp
      !> A ratio of lengths between 1 and this does not pay a change of length
      real(wp) :: hold = 1.0_wp
      !> Whether the method foresees how long a step may be
      logical :: foresees = .false.
      !> How long from its start on the interpolant of the step serves, if longer than the step
      real(wp) :: serves = 0.0_wp
      !> Whether step control should foresee the error from the last two (predictive control)
      logical :: predictive = .false.
      !> Length that such a method would have taken if nothing else had limited it; 0 where it knows
      !> of none
      real(wp) :: ideal = 0.0_wp
      !> Cost of an evaluation over that of the explicit pair
      real(wp) :: evaluation_cost = 1.0_wp
      !> Right-hand sides, or Taylor series, evaluated so far
      integer(int64) :: evaluations = 0
      !> What work was done before this method took over, less what it takes for that of its own
      real(wp) :: earlier_work = 0.0_wp
      !> Matrices factorised before this method took over
      integer(int64) :: factorised_before = 0
   contains
      !> What was done so far, in evaluations of the explicit pair
      procedure :: work
      !> A time of the step that lies between its ends
      procedure :: inside
      !> Slope at the present state
      procedure :: slope_here
      !> Evaluate the slope at the start
      procedure :: restart
      !> Forget what was learnt before the start
      procedure :: reset
      !> Matrices factorised so far
      procedure :: factorisations
      !> Set how long the step may be, for a method that foresees it
      procedure :: look_ahead
      !> Try a step
      procedure(try_step), deferred :: attempt
      !> What an accepted step still owes the next one
      procedure :: complete
      !> What only its interpolant needs
      procedure :: extend
      !> Interpolant of one component over an accepted, extended step
      procedure(dense_output), deferred :: interpolant
      !> Whether more than the change of the solution limits an accepted, complete step
      procedure :: held_back
      !> Whether an explicit step might be as long
      procedure :: mild
      !> Make the end of an accepted step the start of the next
      procedure(next_step), deferred :: advance
   end type step_type

   abstract interface
      !> Try the step of length `h` from t; `error` is the estimate in units of the tolerance (step
      !> good when <= 1), huge where an iteration failed, not finite where an evaluation was not.
      pure subroutine try_step(self, problem, past, t, h, tolerance, error)
         import :: dde_problem_type, history_type, step_type, tolerance_type, wp
         implicit none (type, external)
         !> The step
         class(step_type), intent(inout) :: self
         !> The problem
         class(dde_problem_type), intent(in) :: problem
         !> The past, facing this step
         type(history_type), intent(inout) :: past
         !> Start of the step
         real(wp), intent(in) :: t
         !> Length of the step
         real(wp), intent(in) :: h
         !> Tolerance of each component
         type(tolerance_type), intent(in) :: tolerance
         !> Estimated error in units of the tolerance
         real(wp), intent(out) :: error
      end subroutine try_step

      !> Interpolant of one component over an accepted and extended step, before `advance`.
      pure subroutine dense_output(self, i, a)
         import :: step_type, wp
         implicit none (type, external)
         !> The step
         class(step_type), intent(in) :: self
         !> Which component
         integer, intent(in) :: i
         !> Newton coefficients over `nodes`
         real(wp), contiguous, intent(out) :: a(0:)
      end subroutine dense_output

      !> The end of an accepted step becomes the start of the next.
      pure subroutine next_step(self)
         import :: step_type
         implicit none (type, external)
         !> The step
         class(step_type), intent(inout) :: self
      end subroutine next_step
   end interface

contains

   !> Most methods do little but evaluate.
   pure real(wp) function work(self) result(done)
      !> The step
      class(step_type), intent(in) :: self

      done = self%earlier_work + self%evaluation_cost*self%evaluations
   end function work

   !> A time of the step that lies between its ends.
   pure real(wp) function inside(self, t) result(time)
      !> The step
      class(step_type), intent(in) :: self
      !> A time from its start to its end
      real(wp), intent(in) :: t

      time = max(self%earliest, min(self%latest, t))
   end function inside

   !> Evaluate the slope at the start of the step that `past` faces.
   pure subroutine restart(self, problem, past, t)
      !> The step
      class(step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Start of the step
      real(wp), intent(in) :: t

      call past%values(problem, [0.0_wp], self%z)
      call problem%rhs(self%inside(t), self%y, self%z, self%slope)
      self%evaluations = self%evaluations + 1
      call self%reset()
   end subroutine restart

   !> Most methods take the length that they are given, and see from the error what it should be.
   pure subroutine look_ahead(self, problem, past, t, tolerance, longest, h)
      !> The step
      class(step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing the step
      type(history_type), intent(inout) :: past
      !> Start of the step
      real(wp), intent(in) :: t
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Longest step of use
      real(wp), intent(in) :: longest
      !> Length of the step: proposed, then possible
      real(wp), intent(inout) :: h
   end subroutine look_ahead

   !> Slope at the present state, from the left: the last step leaves it as that of the next start.
   pure function slope_here(self) result(slope)
      !> The step
      class(step_type), intent(in) :: self
      real(wp) :: slope(size(self%y))

      slope = self%slope
   end function slope_here

   !> Nothing is learnt by a method that does not say so.
   pure subroutine reset(self)
      !> The step
      class(step_type), intent(inout) :: self
   end subroutine reset

   !> Nothing is owed by a method that does not say so.
   pure subroutine complete(self, problem, past)
      !> The step
      class(step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
   end subroutine complete

   !> Its interpolant needs nothing more by a method that does not say so.
   pure subroutine extend(self, problem, past)
      !> The step
      class(step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
   end subroutine extend

   !> An implicit method is not held back.
   pure logical function held_back(self) result(value)
      !> The step
      class(step_type), intent(in) :: self

      value = .false.
   end function held_back

   !> An explicit method need not ask.
   pure logical function mild(self) result(value)
      !> The step
      class(step_type), intent(in) :: self

      value = .true.
   end function mild

   !> Only implicit methods factorise.
   pure function factorisations(self) result(count)
      !> The step
      class(step_type), intent(in) :: self
      integer(int64) :: count

      count = self%factorised_before
   end function factorisations
end module dde_step
