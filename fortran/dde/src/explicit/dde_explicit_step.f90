! SPDX-License-Identifier: BSD-3-Clause
!> One step of an explicit Runge-Kutta pair. It is at most as long as the shortest delay, so that
!> all delayed values lie in the past.
module dde_explicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_bogacki_shampine, only: bogacki_shampine
   use dde_dop853, only: dop853
   use dde_explicit_pair, only: evaluate, explicit_pair, lanes, slope_count
   use dde_controller, only: method_constants
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: explicit_step_type

   !> Stages of the current step. Components fill blocks of lanes; unused lanes of the last are 0.
   type, extends(step_type) :: explicit_step_type
      !> The pair
      class(explicit_pair), allocatable :: pair
      !> Slopes of the step and its dense output, shape (lanes, blocks, slopes)
      real(wp), allocatable :: k(:, :, :)
      !> State at the start of the step and at its end, shape (lanes, blocks)
      real(wp), allocatable :: start(:, :), finish(:, :)
      !> Argument of the last stage, and of one of the dense output, shape (lanes, blocks)
      real(wp), allocatable :: stage(:, :), dense_stage(:, :)
      !> Delayed values at the places of the step and of its dense output, shape (delayed values,
      !> places), and these as times since the start of the step
      real(wp), allocatable :: delayed(:, :), dense_delayed(:, :)
      real(wp), allocatable, private :: times(:), dense_times(:)
      !> Errors of the embedded methods, shape (lanes, blocks, methods)
      real(wp), allocatable :: embedded(:, :, :)
      !> Whether all slopes so far are finite
      logical :: finite = .true.
   contains
      procedure :: set_up, attempt, interpolant, stiff, advance
   end type explicit_step_type

contains

   !> Storage, and the state at the initial time.
   subroutine set_up(self, problem, name)
      class(explicit_step_type), intent(out) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Name of the pair
      character(len=*), intent(in) :: name
      integer :: blocks

      if (name == "bs5") then
         allocate (self%pair, source=bogacki_shampine())
      else
         allocate (self%pair, source=dop853())
      end if
      self%constants = method_constants(name=name, order=self%pair%order, &
                                        error_order=self%pair%order)
      call self%allocate_state(problem)
      self%nodes = self%pair%nodes
      blocks = (problem%n + lanes - 1)/lanes
      allocate (self%k(lanes, blocks, slope_count), source=0.0_wp)
      allocate (self%start(lanes, blocks), self%finish(lanes, blocks), source=0.0_wp)
      allocate (self%stage(lanes, blocks), self%dense_stage(lanes, blocks), source=0.0_wp)
      allocate (self%embedded(lanes, blocks, 2))
      associate (places => size(self%pair%places), dense_places => size(self%pair%dense_places))
         allocate (self%delayed(size(problem%lag), places), self%times(places))
         allocate (self%dense_delayed(size(problem%lag), dense_places))
         allocate (self%dense_times(dense_places))
      end associate
   end subroutine set_up

   !> Attempt a step. `error` is the estimate in units of the tolerance, at its end and, where they
   !> are read, at the places between, or not finite if an evaluation was not.
   pure subroutine attempt(self, context, error)
      class(explicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error
      real(wp) :: error_between

      self%t = context%cursor%t
      self%h = context%cursor%h
      call copy(size(self%y), self%y, self%start)
      call copy(size(self%y), self%slope, self%k)
      self%times = self%h*self%pair%places
      call context%delayed_values(self%times, self%delayed)
      self%finite = all(ieee_is_finite(self%slope))
      if (self%finite) then
         call self%pair%take_stages(context, self%h, size(self%k, 2), self%start, self%delayed, &
                                    self%k, self%stage, self%finish, self%finite)
      end if
      call copy(size(self%y), self%finish, self%y_new)
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (self%finite .and. all(ieee_is_finite(self%y_new)))) return
      call evaluate(context, context%cursor%inside(self%t + self%h), self%y_new, &
                    self%delayed(:, size(self%times)), self%k(:, :, self%pair%stages + 1), &
                    self%finite)
      if (.not. self%finite) return
      associate (tolerance => context%tolerance)
         self%scale = tolerance%absolute + tolerance%relative*max(abs(self%y), abs(self%y_new))
         call self%pair%find_error(size(self%y), size(self%k, 2), self%k, self%h, self%scale, &
                                   tolerance%level, self%embedded, error)
         if (error > 1.0_wp .or. size(self%dense_times) == 0 .or. .not. context%between) return
         self%dense_times = self%h*self%pair%dense_places
         call context%delayed_values(self%dense_times, self%dense_delayed)
         call self%pair%take_dense_stages(context, self%h, size(self%k, 2), self%start, &
                                          self%dense_delayed, self%k, self%dense_stage, self%finite)
         call self%pair%find_dense_error(size(self%y), size(self%k, 2), self%k, self%h, &
                                         self%scale, tolerance%level, self%dense_stage, &
                                         error_between)
         error = max(error, error_between)
         if (.not. self%finite) error = ieee_value(1.0_wp, ieee_quiet_nan)
      end associate
   end subroutine attempt

   !> Copy n numbers. Either side may be stored in lanes.
   pure subroutine copy(n, from, to)
      integer, intent(in) :: n
      real(wp), intent(in) :: from(n)
      real(wp), intent(inout) :: to(n)

      to = from
   end subroutine copy

   !> Whether stability limits the step: its length times the difference of the slopes of the last
   !> stage and at the end over the distance of their arguments, both at the end of the step (Hairer
   !> and Wanner 1996, sec. IV.2), in units of the tolerance.
   pure logical function stiff(self) result(value)
      class(explicit_step_type), intent(in) :: self
      real(wp) :: distance, rise

      associate (last => self%pair%stages, n => size(self%scale))
         rise = largest_difference(n, self%k(:, :, last), self%k(:, :, last + 1), self%scale)
         distance = largest_difference(n, self%stage, self%finish, self%scale)
      end associate
      value = self%h*rise > self%pair%limited_by_stability*distance
   end function stiff

   !> Largest difference of n numbers, in units of a scale.
   pure real(wp) function largest_difference(n, a, b, scale) result(largest)
      integer, intent(in) :: n
      real(wp), intent(in) :: a(n), b(n), scale(n)
      integer :: i

      largest = 0.0_wp
      do i = 1, n
         largest = max(largest, abs(b(i) - a(i))/scale(i))
      end do
   end function largest_difference

   !> The end becomes the start of the next step, and its slope the first one.
   pure subroutine advance(self)
      class(explicit_step_type), intent(inout) :: self

      self%y = self%y_new
      call copy(size(self%y), self%k(:, :, self%pair%stages + 1), self%slope)
   end subroutine advance

   !> Dense output of component `i` over an accepted step, before `advance`.
   pure subroutine interpolant(self, i, a)
      class(explicit_step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), contiguous, intent(out) :: a(0:)
      real(wp) :: slopes(slope_count)

      slopes = self%k(1 + modulo(i - 1, lanes), 1 + (i - 1)/lanes, :)
      call self%pair%find_coefficients(slopes, self%h, self%y(i), self%y_new(i), a)
   end subroutine interpolant
end module dde_explicit_step
