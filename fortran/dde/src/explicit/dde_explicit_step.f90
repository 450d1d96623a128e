!> One step of the explicit pair 8(5,3) of Dormand and Prince (dde_explicit_stages). It is at most
!> as long as the shortest delay, so that all delayed values lie in the past.
module dde_explicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_explicit_stages, only: dense_coefficients, dense_places, dense_stages, error_853, &
                                  evaluate, lanes, places, slope_count, take_stages
   use dde_method_constants, only: method_constants
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: explicit_step_type

   !> Above this value of step size times rate of change, stability limits a step.
   real(wp), parameter :: limited_by_stability = 2.5_wp

   !> Stages of the current step. Components fill blocks of lanes; unused lanes of the last are 0.
   type, extends(step_type) :: explicit_step_type
      !> Slopes 1 to 13 of the step and 14 to 16 of its dense output, shape (lanes, blocks, 16)
      real(wp), allocatable :: k(:, :, :)
      !> State at the start of the step and at its end, shape (lanes, blocks)
      real(wp), allocatable :: start(:, :), finish(:, :)
      !> Argument of the current stage, and of the last of the step, shape (lanes, blocks)
      real(wp), allocatable :: stage(:, :), last_stage(:, :)
      !> Delayed values at `places` and `dense_places`
      real(wp), allocatable :: delayed(:, :), dense_delayed(:, :)
      !> Errors of the embedded methods of orders 3 and 5, shape (lanes, blocks)
      real(wp), allocatable :: e3(:, :), e5(:, :)
      !> Whether all slopes so far are finite
      logical :: finite = .true.
   contains
      procedure :: attempt, complete, extend, interpolant, stiff, advance
   end type explicit_step_type

   interface explicit_step_type
      module procedure :: new_step
   end interface explicit_step_type

contains

   !> Storage, and the state at the initial time.
   pure function new_step(problem) result(step)
      class(dde_problem_type), intent(in) :: problem
      type(explicit_step_type) :: step
      integer :: blocks

      step%constants = method_constants(name="explicit", order=8, error_order=8)
      call step%allocate_state(problem)
      step%nodes = real([0, 1, 0, 1, 0, 1, 0], wp)
      blocks = (problem%n + lanes - 1)/lanes
      allocate (step%k(lanes, blocks, slope_count), source=0.0_wp)
      allocate (step%start(lanes, blocks), step%finish(lanes, blocks), source=0.0_wp)
      allocate (step%stage(lanes, blocks), step%last_stage(lanes, blocks), source=0.0_wp)
      allocate (step%e3(lanes, blocks), step%e5(lanes, blocks))
      allocate (step%delayed(size(problem%lag), size(places)))
      allocate (step%dense_delayed(size(problem%lag), size(dense_places)))
   end function new_step

   !> Attempt a step. `error` is the 853 estimate in units of the tolerance, or not finite if an
   !> evaluation was not.
   pure subroutine attempt(self, context, error)
      class(explicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error

      self%t = context%cursor%t
      self%h = context%cursor%h
      call copy(size(self%y), self%y, self%start)
      call copy(size(self%y), self%slope, self%k)
      call context%delayed_values(self%h*places, self%delayed)
      self%finite = all(ieee_is_finite(self%slope))
      if (self%finite) then
         call take_stages(context, self%h, size(self%k, 2), self%start, self%delayed, self%k, &
                          self%stage, self%last_stage, self%finish, self%finite)
      end if
      call copy(size(self%y), self%finish, self%y_new)
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (self%finite .and. all(ieee_is_finite(self%y_new)))) return
      associate (tolerance => context%tolerance)
         self%scale = tolerance%absolute + tolerance%relative*max(abs(self%y), abs(self%y_new))
         call error_853(size(self%y), size(self%k, 2), self%k, self%h, self%scale, &
                        tolerance%level, self%e3, self%e5, error)
      end associate
   end subroutine attempt

   !> Copy n numbers. Either side may be stored in lanes.
   pure subroutine copy(n, from, to)
      integer, intent(in) :: n
      real(wp), intent(in) :: from(n)
      real(wp), intent(inout) :: to(n)

      to = from
   end subroutine copy

   !> Slope 13, at the end of an accepted step.
   pure subroutine complete(self, context)
      class(explicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context

      call evaluate(context, context%cursor%inside(self%t + self%h), self%y_new, &
                    self%delayed(:, size(places)), self%k(:, :, 13), self%finite)
   end subroutine complete

   !> Whether stability limits the step: its length times |k13 - k12| over the distance of their
   !> arguments, both at the end of the step (Hairer and Wanner 1996, sec. IV.2), in units of the
   !> tolerance.
   pure logical function stiff(self) result(value)
      class(explicit_step_type), intent(in) :: self
      real(wp) :: distance, rise
      integer :: block, i, lane

      distance = 0.0_wp
      rise = 0.0_wp
      do i = 1, size(self%scale)
         lane = 1 + modulo(i - 1, lanes)
         block = 1 + (i - 1)/lanes
         rise = max(rise, abs(self%k(lane, block, 13) - self%k(lane, block, 12))/self%scale(i))
         distance = max(distance, abs(self%finish(lane, block) - self%last_stage(lane, block)) &
                                  /self%scale(i))
      end do
      value = self%h*rise > limited_by_stability*distance
   end function stiff

   !> The end becomes the start of the next step. Its slope is slope 13 of this one.
   pure subroutine advance(self)
      class(explicit_step_type), intent(inout) :: self

      self%y = self%y_new
      call copy(size(self%y), self%k(:, :, 13), self%slope)
   end subroutine advance

   !> Slopes 14 to 16 of an accepted step.
   pure subroutine extend(self, context)
      class(explicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context

      call context%delayed_values(self%h*dense_places, self%dense_delayed)
      call dense_stages(context, self%h, size(self%k, 2), self%start, self%dense_delayed, self%k, &
                        self%stage, self%finite)
   end subroutine extend

   !> Dense output of component `i` over an accepted and extended step, before `advance`.
   pure subroutine interpolant(self, i, a)
      class(explicit_step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), contiguous, intent(out) :: a(0:)
      real(wp) :: slopes(slope_count)

      slopes = self%k(1 + modulo(i - 1, lanes), 1 + (i - 1)/lanes, :)
      call dense_coefficients(slopes, self%h, self%y(i), self%y_new(i), a(0:7))
   end subroutine interpolant
end module dde_explicit_step
