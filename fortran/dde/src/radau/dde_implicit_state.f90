! SPDX-License-Identifier: BSD-3-Clause
!> What a step of a Radau IIA method keeps from attempt to attempt, and what does not depend on how
!> an attempt finds its stages. Where the step is longer than a delay, its own collocation
!> polynomial is the past.
module dde_implicit_state
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_collocation, only: difference_weights, lagrange_factors, lagrange_weights, shape_bump
   use dde_controller, only: method_constants
   use dde_jacobian, only: difference, jacobian_type, size_of
   use dde_memory, only: find_lacking
   use dde_problem, only: dde_problem_type
   use dde_radau_tableau, only: inverse_of_a, most_stages, radau_iia, radau_tableau
   use dde_stage_systems, only: stage_systems
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_systems, only: real_system
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: implicit_cost, implicit_state, iterations_of_three, iterations_per_stage
   public :: largest_remainder, least_hidden

   !> Iterations allowed: this many, and more for each stage above three.
   real(wp), parameter :: iterations_of_three = 7.0_wp, iterations_per_stage = 2.5_wp
   !> Remaining error of the iteration, in units of the tolerance, at which it ends. A larger one
   !> disturbs the error estimate at loose tolerances.
   real(wp), parameter :: largest_remainder = 0.02_wp
   !> A step is far too long if this share of the last term of its polynomial is above the
   !> tolerance: there the embedded error can be small by chance.
   real(wp), parameter :: least_hidden = 0.003_wp
   !> Contraction below which the next step uses the same Jacobian.
   real(wp), parameter :: good_contraction = 1.0e-3_wp
   !> Up to this ratio the step size is kept, and the factors with it.
   real(wp), parameter :: keep_length = 1.2_wp
   !> Below this value of step size times norm of the Jacobian the problem is not stiff.
   real(wp), parameter :: least_stiff = 8.0_wp
   !> Cost of an evaluation within this method over one within the explicit pair.
   real(wp), parameter :: implicit_cost = 3.0_wp

   !> The last attempt, and what the next one may use again. Arrays over stages have the same shape
   !> for all methods.
   type, abstract, extends(step_type) :: implicit_state
      !> The method
      type(radau_tableau) :: method
      !> Factors of the Lagrange weights over 0 and c
      real(wp) :: factors(most_stages) = 0.0_wp
      !> Weights of the increments in the slope at the end, times the step size, and the sum of
      !> their absolute values
      real(wp) :: end_weights(most_stages) = 0.0_wp, sum_of_end_weights = 0.0_wp
      !> Weights of the increments in the Newton coefficients of the collocation polynomial: rows
      !> are increments, columns degrees
      real(wp) :: differences(most_stages, most_stages) = 0.0_wp
      !> Newton coefficients, over `nodes`, of the polynomial whose derivative vanishes at all c
      real(wp), allocatable :: bump(:)
      !> Derivative of `bump` at 0
      real(wp) :: bump_slope = 0.0_wp
      !> Tolerance that the error estimate is held to, and over that of the step
      real(wp) :: asked = 1.0_wp, asked_over_level = 1.0_wp
      !> The tolerance asked for over that of the error between the ends
      real(wp) :: asked_over_inside = 1.0_wp
      !> Derivatives of the right-hand side, and whether the last can be used again
      type(jacobian_type) :: jacobian
      logical :: jacobian_is_good = .false.
      !> Factors of the systems of all stages
      type(stage_systems) :: systems
      !> The Jacobian at the end of the step, and its real system; allocatable, since gfortran 12
      !> and 14 free but one of two components of a type
      type(jacobian_type), allocatable :: jacobian_at_end
      type(real_system), allocatable :: system_at_end
      !> Increments Y - y at the stages of the last attempt and of the last accepted step, shape (n,
      !> stages)
      real(wp), allocatable :: increments(:, :), last_increments(:, :)
      !> Length of the last accepted step; 0 when its polynomial must not be extrapolated
      real(wp) :: last_h = 0.0_wp
      !> Slope of the polynomial at the end, and the error of the embedded method, shape (n)
      real(wp), allocatable :: end_slope(:), error_vector(:)
      !> Delayed values at the stages, shape (delayed values, stages)
      real(wp), allocatable :: delayed(:, :)
      !> Whether delayed values lie in the step
      logical :: coupled = .false.
      !> Place of each stage's delayed values in this step, in units of h; <= 0 in the past; shape
      !> (delayed values, stages)
      real(wp), allocatable :: own_place(:, :)
      !> Weights of the stage increments in those, shape (stages, delayed values, stages)
      real(wp), allocatable :: own_weights(:, :, :)
      !> Contraction theta of the last iteration
      real(wp) :: contraction = 1.0_wp
      !> Remaining error over the last correction, theta/(1 - theta). It grows with each step that
      !> does not measure theta.
      real(wp) :: remainder = 1.0_wp
   contains
      procedure :: set_up, reset, interpolant, stiff, advance, place_delays, place_moving
      procedure :: differentiate_moving
   end type implicit_state

contains

   !> Storage, and the constants that follow from the method.
   subroutine set_up(self, problem, stages, level, lacking)
      class(implicit_state), intent(out) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Number of stages
      integer, intent(in) :: stages
      !> Level of the tolerance
      real(wp), intent(in) :: level
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking
      real(wp) :: a_inverse(stages, stages)

      lacking = find_lacking(size_of_step(problem, stages))
      if (lacking > 0.0_wp) return
      self%method = radau_iia(stages)
      self%constants = method_constants(order=2*stages - 1, error_order=stages + 1, &
                                        implicit=.true., evaluation_cost=implicit_cost, &
                                        predictive=.true., largest_kept_ratio=keep_length)
      call self%allocate_state(problem)
      associate (n => problem%n, delays => size(problem%lag), s => stages)
         allocate (self%error_vector(n), self%end_slope(n))
         allocate (self%jacobian_at_end, self%system_at_end)
         allocate (self%increments(n, s), self%last_increments(n, s))
         allocate (self%delayed(delays, s))
         allocate (self%own_place(delays, s), source=0.0_wp)
         allocate (self%own_weights(s, delays, s))
         self%systems = stage_systems(self%method, n)
      end associate
      ! the estimate has order s, the polynomial s + 1, the ends more: with this tolerance of the
      ! estimate, errors are near the tolerance of the step, as with the explicit method
      self%asked = level**((stages + 1.0_wp)/(stages + 2.0_wp))
      self%asked_over_level = self%asked/level
      self%asked_over_inside = self%asked/level**(real(stages, wp)/(stages + 1))
      self%nodes = [0.0_wp, self%method%c(:stages)]
      self%factors(:stages) = lagrange_factors(self%nodes)
      self%differences(:stages, :stages) = difference_weights(self%nodes)
      call shape_bump(self%method%c(:stages), self%bump, self%bump_slope)
      a_inverse = inverse_of_a(self%method)
      self%end_weights(:stages) = a_inverse(stages, :)
      self%sum_of_end_weights = sum(abs(a_inverse(stages, :)))
   end subroutine set_up

   !> Real numbers of a step, at most, counted from its components.
   pure real(wp) function size_of_step(problem, stages) result(reals)
      class(dde_problem_type), intent(in) :: problem
      integer, intent(in) :: stages
      real(wp) :: above, below, delays, height, n

      n = problem%n
      delays = size(problem%lag)
      height = n
      below = n - 1
      above = n - 1
      if (problem%lower >= 0) then
         below = problem%lower
         above = problem%upper
      end if
      if (allocated(problem%rows) .and. delays > 0) then
         height = maxval(problem%rows(2, :) - problem%rows(1, :)) + 1
         ! delayed values in the step widen the band
         below = max(below, real(maxval(problem%rows(2, :) - problem%component), wp))
         above = max(above, real(maxval(problem%component - problem%rows(1, :)), wp))
      end if
      ! two Jacobians, a real system for each, and a complex one for each pair of stages
      reals = 2*(n*min(n, 1 + below + above) + height*delays) &
              + n*min(n, 1 + 2*below + above)*(2 + (stages - 1)) + n*2*(8*stages + 16) &
              + delays*2*stages**2
      ! and one of all stages
      if (delays > 0) reals = reals + n*stages*min(n*stages, stages*(2*below + above + 3))
   end function size_of_step

   !> Polynomial, Jacobian and factors of earlier steps are not used again.
   pure subroutine reset(self)
      class(implicit_state), intent(inout) :: self

      self%last_h = 0.0_wp
      self%jacobian_is_good = .false.
      self%contraction = 1.0_wp
      self%remainder = 1.0_wp
   end subroutine reset

   !> Values of constant delays of stages that lie in the past, and the places of those in the step
   !> itself.
   pure subroutine place_delays(self, context)
      class(implicit_state), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp) :: places(most_stages)
      integer :: i, k, past

      associate (s => self%method%stages, h => context%cursor%h, &
                 lag => context%problem%lag(:size(context%problem%lag) - context%problem%moving))
         places = self%method%c*h
         if (self%coupled) self%own_place(:, :) = 0.0_wp
         ! the last stage is at the end
         self%coupled = any(lag < h)
         if (.not. self%coupled) then
            call context%delayed_values(places(:s), self%delayed)
            return
         end if
         do k = 1, size(lag)
            past = 0
            do i = 1, s
               self%own_place(k, i) = self%method%c(i) - lag(k)/h
               if (self%own_place(k, i) > 0.0_wp) then
                  call lagrange_weights(s, self%nodes, self%factors, self%own_place(k, i), &
                                        self%own_weights(:, k, i))
               else
                  past = i
               end if
            end do
            if (past == 0) cycle
            call context%cursor%values_of(context%problem, context%past, k, k, past, places, k, &
                                          size(self%delayed, 1), self%delayed)
         end do
      end associate
   end subroutine place_delays

   !> The values of a stage whose delays move, where they lie in the past, and the places of those
   !> in the step itself. Without a delay that is the stage.
   pure subroutine place_moving(self, context, i, t, y)
      class(implicit_state), intent(inout) :: self
      type(step_context), intent(inout) :: context
      !> Number of the stage, its time and state
      integer, intent(in) :: i
      real(wp), intent(in) :: t, y(:)
      real(wp) :: lag(context%problem%moving)
      logical :: good
      integer :: j, k

      call context%cursor%find_lags(context%problem, t, y, lag, good)
      if (.not. good) lag = ieee_value(1.0_wp, ieee_quiet_nan)
      associate (problem => context%problem, past => context%past, cursor => context%cursor)
         do j = 1, size(lag)
            k = size(self%delayed, 1) - size(lag) + j
            self%own_place(k, i) = 0.0_wp
            if (past%pieces%is_open(j)) then
               self%own_place(k, i) = self%method%c(i) - max(0.0_wp, lag(j))/cursor%h
            end if
            if (self%own_place(k, i) > 0.0_wp) then
               call lagrange_weights(self%method%stages, self%nodes, self%factors, &
                                     self%own_place(k, i), self%own_weights(:, k, i))
            else if (good) then
               call cursor%read_piece(problem, past, j, self%method%c(i)*cursor%h, lag(j), &
                                      self%y(problem%component(k)), self%delayed(k, i))
            else
               self%delayed(k, i) = lag(j)
            end if
         end do
      end associate
   end subroutine place_moving

   !> Derivatives by the state of a stage's values whose delays move, by differences: the slope of
   !> the solution there times that of the delay.
   pure subroutine differentiate_moving(self, context, i, t, y, increments, by_y)
      class(implicit_state), intent(in) :: self
      type(step_context), intent(inout) :: context
      !> Number of the stage, its time and state
      integer, intent(in) :: i
      real(wp), intent(in) :: t, y(:)
      !> Increments of all stages, shape (n, stages)
      real(wp), contiguous, intent(in) :: increments(:, :)
      !> The derivatives, shape (moving, n)
      real(wp), contiguous, intent(out) :: by_y(:, :)
      real(wp) :: lag(size(by_y, 1)), moved(size(y)), moved_lag(size(by_y, 1)), z, z_moved
      integer :: j, k

      call context%problem%moving_lags(t, y, lag)
      moved = y
      by_y = 0.0_wp
      do k = 1, size(y)
         moved(k) = y(k) + difference*size_of(context%tolerance, k, y(k))
         call context%problem%moving_lags(t, moved, moved_lag)
         do j = 1, size(lag)
            if (.not. abs(moved_lag(j) - lag(j)) > 0.0_wp) cycle
            call read_moving(self, context, i, j, lag(j), y, increments, z)
            call read_moving(self, context, i, j, moved_lag(j), y, increments, z_moved)
            by_y(j, k) = (z_moved - z)/(moved(k) - y(k))
         end do
         moved(k) = y(k)
      end do
   end subroutine differentiate_moving

   !> The value of moving delay number j at a stage, for any delay, in the past or in the step.
   pure subroutine read_moving(self, context, i, j, lag, y, increments, z)
      class(implicit_state), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: i, j
      real(wp), intent(in) :: lag
      !> State of the stage, and increments of all
      real(wp), intent(in) :: y(:)
      real(wp), contiguous, intent(in) :: increments(:, :)
      real(wp), intent(out) :: z
      real(wp) :: place, weights(most_stages)

      associate (h => context%cursor%h, s => self%method%stages, problem => context%problem)
         place = self%method%c(i) - max(0.0_wp, lag)/h
         associate (component => problem%component(size(problem%lag) - problem%moving + j))
            if (context%past%pieces%is_open(j) .and. place > 0.0_wp) then
               call lagrange_weights(s, self%nodes, self%factors, place, weights(:s))
               z = self%y(component) + sum(weights(:s)*increments(component, :))
            else
               call context%cursor%read_piece(problem, context%past, j, self%method%c(i)*h, lag, &
                                              self%y(component), z)
            end if
         end associate
      end associate
   end subroutine read_moving

   !> Collocation polynomial of component `i` plus a multiple of the bump, which gives it the slope
   !> at the start and one order more.
   pure subroutine interpolant(self, i, a)
      class(implicit_state), intent(in) :: self
      integer, intent(in) :: i
      real(wp), contiguous, intent(out) :: a(0:)
      integer :: j, k

      a(:) = (self%method%real_eigenvalue*self%error_vector(i)/self%bump_slope)*self%bump
      associate (increments => self%increments)
         do k = 1, self%method%stages
            do j = 1, self%method%stages
               a(k) = a(k) + self%differences(j, k)*increments(i, j)
            end do
         end do
      end associate
      a(0) = self%y(i)
   end subroutine interpolant

   !> Whether the step is long in units of one over the norm of the Jacobian.
   pure logical function stiff(self) result(value)
      class(implicit_state), intent(in) :: self

      value = .not. self%h*maxval(self%jacobian%row_sums) < least_stiff
   end function stiff

   !> The end becomes the start. Jacobian and factors are kept if the iteration converged fast.
   pure subroutine advance(self)
      class(implicit_state), intent(inout) :: self

      self%slope(:) = self%end_slope
      self%y(:) = self%y_new
      self%last_increments(:, :) = self%increments
      self%last_h = self%h
      self%jacobian_is_good = self%contraction <= good_contraction
   end subroutine advance
end module dde_implicit_state
