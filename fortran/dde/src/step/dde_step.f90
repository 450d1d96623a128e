! SPDX-License-Identifier: BSD-3-Clause
!> A step of some method. A method attempts the step on which the cursor stands, estimates its
!> error, and gives the polynomial of an accepted step. The run chooses the step size, counts the
!> steps and stores the polynomials. METHODS.md tells how to write a method.
module dde_step
   use dde_controller, only: controller_type, method_constants
   use dde_cursor, only: cursor_type
   use dde_errors, only: error_type
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree, newton_state
   use dde_problem, only: dde_problem_type
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: step_type

   !> One step.
   type, abstract :: step_type
      !> Constants of the method
      type(method_constants) :: constants
      !> Newton nodes of its polynomial, and whether all of them are 0
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
      !> Start of the last attempt, as an ordinary number
      real(wp) :: t = 0.0_wp
      !> Length of the last attempt
      real(wp) :: h = 0.0_wp
      !> Factor below the step size at which the error would be equal to the tolerance
      real(wp) :: safety = 0.9_wp
      !> Time from the start of the step for which its polynomial is valid, if longer than the step
      real(wp) :: valid_for = 0.0_wp
   contains
      procedure :: allocate_state, restart, renew, reset, propose, next_length
      procedure :: refuse_series, slope_here, state_at, delayed_at, offer, stiff
      procedure(attempt_step), deferred :: attempt
      procedure(give_polynomial), deferred :: interpolant
      procedure(go_to_end), deferred :: advance
   end type step_type

   abstract interface
      !> Attempt the step on which the cursor stands. `error` is the estimate in units of the
      !> tolerance: the step is accepted if it is at most 1. It is huge if an iteration failed and
      !> not finite if an evaluation was not.
      subroutine attempt_step(self, context, error)
         import :: step_context, step_type, wp
         implicit none (type, external)
         class(step_type), intent(inout) :: self
         !> The context of the step
         type(step_context), intent(inout) :: context
         !> Estimated error in units of the tolerance
         real(wp), intent(out) :: error
      end subroutine attempt_step

      !> Polynomial of one component over an accepted step, before `advance`.
      pure subroutine give_polynomial(self, i, a)
         import :: step_type, wp
         implicit none (type, external)
         class(step_type), intent(in) :: self
         !> Number of the component
         integer, intent(in) :: i
         !> Newton coefficients over `nodes`
         real(wp), contiguous, intent(out) :: a(0:)
      end subroutine give_polynomial

      !> The end of an accepted step becomes the start of the next.
      pure subroutine go_to_end(self)
         import :: step_type
         implicit none (type, external)
         class(step_type), intent(inout) :: self
      end subroutine go_to_end
   end interface

contains

   !> Storage of what all steps have, and the state at the initial time.
   pure subroutine allocate_state(self, problem)
      class(step_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem

      associate (n => problem%n, delays => size(problem%lag))
         allocate (self%y(n), self%y_new(n), self%slope(n), self%scale(n), self%z(delays, 1))
      end associate
      call problem%initial(self%y)
   end subroutine allocate_state

   !> After an attempt of the first step: refuse series of the problem that do not solve its
   !> equations. A method without series has nothing to refuse.
   pure subroutine refuse_series(self, context, error)
      class(step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      type(error_type), allocatable, intent(out) :: error
   end subroutine refuse_series

   !> Evaluate the slope at the start of the step on which the cursor stands.
   pure subroutine restart(self, context)
      class(step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context

      call context%delayed_values([0.0_wp], self%z)
      call context%evaluate(context%cursor%inside(context%cursor%t), self%y, self%z, self%slope)
      call self%reset()
   end subroutine restart

   !> Begin a step at a breaking point: its slope is not that of the end of the last step.
   pure subroutine renew(self, context)
      class(step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context

      call self%restart(context)
   end subroutine renew

   !> Forget what earlier steps have shown: nothing, unless a method says so.
   pure subroutine reset(self)
      class(step_type), intent(inout) :: self
   end subroutine reset

   !> The step size remains as it is unless a method knows better before it attempts the step.
   pure subroutine propose(self, context, h)
      class(step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      !> Step size: proposed so far, then by the method
      real(wp), intent(inout) :: h
   end subroutine propose

   !> Step control proposes the next step size from the error, unless a method knows better.
   pure subroutine next_length(self, control, h, error)
      class(step_type), intent(in) :: self
      type(controller_type), intent(inout) :: control
      !> Length of the step, replaced by the next
      real(wp), intent(inout) :: h
      !> Error of the step in units of the tolerance, 0..1
      real(wp), intent(in) :: error

      call control%accept(self%constants, self%safety, h, error)
   end subroutine next_length

   !> Whether stability rather than accuracy limits explicit steps here. A method that cannot see it
   !> reports none.
   pure logical function stiff(self) result(value)
      class(step_type), intent(in) :: self

      value = .false.
   end function stiff

   !> State at a place of an accepted step, before `advance`.
   pure subroutine state_at(self, place, y)
      class(step_type), intent(in) :: self
      !> Place, 0..1
      real(wp), intent(in) :: place
      real(wp), intent(out) :: y(:)
      real(wp) :: coefficients(0:highest_degree), slope
      integer :: i

      associate (dense => coefficients(:size(self%nodes)))
         do i = 1, size(y)
            call self%interpolant(i, dense)
            call newton_state(self%nodes, dense, place, y(i), slope)
         end do
      end associate
   end subroutine state_at

   !> Delayed values at a time of an accepted step, before `advance`: some may lie within the step.
   pure subroutine delayed_at(self, problem, past, cursor, time, z)
      class(step_type), intent(in) :: self
      class(dde_problem_type), intent(in) :: problem
      type(history_type), intent(in) :: past
      !> The cursor, on the step
      type(cursor_type), intent(inout) :: cursor
      !> Time since the start of the step
      real(wp), intent(in) :: time
      !> Delayed values, shape (number of delayed values, 1)
      real(wp), intent(inout) :: z(:, :)
      real(wp) :: here(problem%n), lag(size(problem%lag)), y(problem%n)
      integer :: j, k

      call cursor%values(problem, past, [time], z)
      associate (constant => size(lag) - problem%moving)
         lag(:constant) = problem%lag(:constant)
         if (problem%moving > 0) then
            call self%state_at(time/self%h, here)
            call problem%moving_lags(cursor%t + time, here, lag(constant + 1:))
         end if
         do k = 1, size(lag)
            j = k - constant
            if (j > 0) then
               if (lag(k) >= time .or. .not. past%pieces%is_open(j)) then
                  call cursor%read_piece(problem, past, j, time, lag(k), &
                                         here(problem%component(k)), z(k, 1))
                  cycle
               end if
            end if
            if (lag(k) >= time) cycle
            call self%state_at((time - max(0.0_wp, lag(k)))/self%h, y)
            z(k, 1) = y(problem%component(k))
         end do
      end associate
   end subroutine delayed_at

   !> Let delays that move read an attempted step: the past gets its polynomials.
   pure subroutine offer(self, context, rough, change)
      class(step_type), intent(in) :: self
      type(step_context), intent(inout) :: context
      !> Whether only the cubic polynomial of the step is known
      logical, intent(in) :: rough
      !> Largest change since they were offered last in this step, in units of the tolerance; huge
      !> if they were not
      real(wp), intent(out) :: change
      real(wp) :: coefficients(0:highest_degree)
      integer :: degree, i, place
      logical :: known

      degree = size(self%nodes)
      known = context%past%running
      call context%past%open_running(context%cursor%start, self%h, self%nodes, self%powers, place)
      change = merge(0.0_wp, huge(1.0_wp), known)
      associate (kept => context%past%kept, a => context%past%stored(place)%a)
         do i = 1, size(kept)
            call self%interpolant(kept(i), coefficients(:degree))
            if (rough) coefficients(4:) = 0.0_wp
            associate (new => coefficients(:degree), old => a(:degree, i))
               change = max(change, sum(abs(new - old))/self%scale(kept(i)))
               old = new
            end associate
         end do
      end associate
   end subroutine offer

   !> Slope at the present state, from the left: `advance` sets the slope at the next start.
   pure function slope_here(self) result(slope)
      class(step_type), intent(in) :: self
      real(wp) :: slope(size(self%y))

      slope = self%slope
   end function slope_here
end module dde_step
