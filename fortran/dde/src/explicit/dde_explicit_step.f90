! SPDX-License-Identifier: BSD-3-Clause
!> One step of an explicit Runge-Kutta pair. It is at most as long as the shortest constant delay,
!> so that these delayed values lie in the past. Where a delay that moves reaches into the step,
!> it is repeated with the dense output of the last pass until that no longer changes.
module dde_explicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_controller, only: method_constants
   use dde_explicit_pair, only: explicit_pair, slope_count
   use dde_memory, only: find_lacking
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_tolerance, only: all_finite
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: explicit_step_type

   !> Most passes of a step, and the change of its dense output, in units of the tolerance, up to
   !> which it does not change.
   integer, parameter :: most_passes = 10
   real(wp), parameter :: least_change = 0.03_wp

   !> Stages of the current step.
   type, extends(step_type) :: explicit_step_type
      !> The pair
      class(explicit_pair), allocatable :: pair
      !> Slopes of the step and its dense output, shape (slopes, n)
      real(wp), allocatable :: k(:, :)
      !> The newest slope, and the arguments of the last stage and of one of the dense output, shape
      !> (n)
      real(wp), allocatable, dimension(:) :: newest, stage, aside
      !> Errors of the embedded methods, shape (n, methods)
      real(wp), allocatable :: embedded(:, :)
      !> Delayed values at the places of the step or of its dense output, shape (delayed values,
      !> places)
      real(wp), allocatable :: delayed(:, :)
      !> Whether the first slope is finite
      logical :: finite = .true.
   contains
      procedure :: set_up, reset, attempt, interpolant, stiff, advance
   end type explicit_step_type

contains

   !> Storage, and the state at the initial time.
   subroutine set_up(self, problem, pair, lacking)
      class(explicit_step_type), intent(out) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The pair
      class(explicit_pair), intent(in) :: pair
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking

      ! at most so many for each component and delayed value
      lacking = find_lacking(52.0_wp*(problem%n + size(problem%lag)))
      if (lacking > 0.0_wp) return
      allocate (self%pair, source=pair)
      call self%pair%set_up(self%nodes)
      self%constants = method_constants(order=self%pair%order, error_order=self%pair%order)
      call self%allocate_state(problem)
      associate (n => problem%n)
         allocate (self%k(slope_count, n), source=0.0_wp)
         allocate (self%newest(n), self%stage(n), self%aside(n), self%embedded(n, 2))
      end associate
      allocate (self%delayed(size(problem%lag), self%pair%places))
   end subroutine set_up

   !> Take up the first slope.
   pure subroutine reset(self)
      class(explicit_step_type), intent(inout) :: self

      self%finite = all_finite(size(self%slope), self%slope)
      self%k(1, :) = self%slope
   end subroutine reset

   !> Attempt a step. `error` is the estimate in units of the tolerance, at its end and, where they
   !> are read, at the places between, or not finite if an evaluation was not.
   pure subroutine attempt(self, context, error)
      class(explicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error
      logical :: finite

      self%t = context%cursor%t
      self%h = context%cursor%h
      finite = self%finite
      if (context%problem%moving > 0) then
         call repeat_step(self, context, finite, error)
      else if (finite) then
         call self%pair%take_step(context, context%problem%n, self%h, self%y, self%delayed, &
                                  self%k, self%newest, self%stage, self%aside, self%y_new, &
                                  self%scale, self%embedded, finite, error)
      end if
      if (.not. finite) error = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine attempt

   !> The step, repeated where delays reach into it.
   pure subroutine repeat_step(self, context, finite, error)
      type(explicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      !> Whether all slopes so far are finite, then all of the step
      logical, intent(inout) :: finite
      real(wp), intent(inout) :: error
      real(wp) :: change
      integer :: pass

      do pass = 1, most_passes
         if (.not. finite) return
         call context%cursor%begin_step()
         call self%pair%take_step(context, context%problem%n, self%h, self%y, self%delayed, &
                                  self%k, self%newest, self%stage, self%aside, self%y_new, &
                                  self%scale, self%embedded, finite, error)
         if (.not. (finite .and. context%cursor%reaches_in)) return
         ! without an error within the tolerance the dense output is not known
         call self%offer(context, error > 1.0_wp, change)
         if (change <= least_change) return
      end do
      error = huge(1.0_wp)
   end subroutine repeat_step

   !> Whether stability limits the step: its length times the difference of the slopes of the last
   !> stage and at the end over the distance of their arguments, both at the end of the step (Hairer
   !> and Wanner 1996, sec. IV.2), in units of the tolerance.
   pure logical function stiff(self) result(value)
      class(explicit_step_type), intent(in) :: self
      real(wp) :: distance, rise
      integer :: i

      distance = 0.0_wp
      rise = 0.0_wp
      associate (last => self%pair%stages)
         do i = 1, size(self%scale)
            rise = max(rise, abs(self%k(last + 1, i) - self%k(last, i))/self%scale(i))
            distance = max(distance, abs(self%y_new(i) - self%stage(i))/self%scale(i))
         end do
      end associate
      value = self%h*rise > self%pair%limited_by_stability*distance
   end function stiff

   !> The end becomes the start of the next step, and its slope the first one.
   pure subroutine advance(self)
      class(explicit_step_type), intent(inout) :: self
      integer :: i

      do i = 1, size(self%y)
         self%y(i) = self%y_new(i)
         self%slope(i) = self%k(self%pair%stages + 1, i)
         self%k(1, i) = self%slope(i)
      end do
   end subroutine advance

   !> Dense output of component `i` over an accepted step, before `advance`.
   pure subroutine interpolant(self, i, a)
      class(explicit_step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), contiguous, intent(out) :: a(0:)

      call self%pair%find_coefficients(self%k(:, i), self%h, self%y(i), self%y_new(i), a)
   end subroutine interpolant
end module dde_explicit_step
