! SPDX-License-Identifier: BSD-3-Clause
!> The stages of a Radau IIA step, and the simplified Newton iteration that finds them (Hairer and
!> Wanner 1996, sec. IV.8).
module dde_stage_iteration
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_collocation, only: add_up, combine, lagrange_factors, lagrange_weights, stage_lanes
   use dde_step_context, only: step_context
   use dde_radau_tableau, only: radau_tableau
   use dde_stage_systems, only: stage_systems
   use dde_tolerance, only: all_finite, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: stage_iteration

   !> Iterations allowed: this many, and more for each stage above three.
   real(wp), parameter :: iterations_of_three = 7.0_wp, iterations_per_stage = 2.5_wp

   !> Remaining error of the iteration, in units of the tolerance, at which it ends. A larger one
   !> disturbs the error estimate at loose tolerances.
   real(wp), parameter :: largest_remainder = 0.02_wp

   !> Stages of the current step.
   type :: stage_iteration
      !> Systems of the iteration
      type(stage_systems) :: systems
      !> Nodes of the collocation polynomial: 0 and c, and the factors of its Lagrange weights
      real(wp), allocatable, private :: x(:), factors(:)
      !> Weights of the increments in the slope at the end, times the step size, and the sum of
      !> their absolute values
      real(wp), allocatable, private :: end_weights(:)
      real(wp) :: sum_of_end_weights = 0.0_wp
      !> Increments Y - y at the stages, and their transforms, shape (n, stages)
      real(wp), allocatable :: increments(:, :), transforms(:, :)
      !> Slopes at the stages, shape (n, stages)
      real(wp), allocatable :: slopes(:, :)
      !> State at a stage, and the slope of the polynomial at the end, shape (n)
      real(wp), allocatable :: argument(:), end_slope(:)
      !> Last correction of the transforms, and the scales of its elements, shape (n, stages)
      real(wp), allocatable, private :: change(:, :), scales(:, :)
      !> Delayed values at the stages, shape (delayed values, stages)
      real(wp), allocatable :: delayed(:, :)
      !> Times of the stages since the start of the step, shape (stages)
      real(wp), allocatable, private :: places(:)
      !> Whether delayed values lie in the step
      logical :: coupled = .false.
      !> Place of each stage's delayed values in this step, in units of h; <= 0 in the past
      real(wp), allocatable :: own_place(:, :)
      !> Weights of the stage increments in those, shape (stages, delayed values, stages)
      real(wp), allocatable :: own_weights(:, :, :)
      !> Contraction theta of the last iteration
      real(wp) :: contraction = 1.0_wp
      !> Remaining error over the last correction, theta/(1 - theta). It grows with each step that
      !> does not measure theta.
      real(wp) :: remainder = 1.0_wp
   contains
      procedure :: place_delays, start, expect_delayed, iterate, find_end_slope
      procedure, private :: slopes_at_stages
   end type stage_iteration

   interface stage_iteration
      module procedure :: new_iteration
   end interface stage_iteration

contains

   !> Storage.
   pure function new_iteration(method, n, delays) result(iteration)
      type(radau_tableau), intent(in) :: method
      integer, intent(in) :: n, delays
      type(stage_iteration) :: iteration

      associate (s => method%stages)
         allocate (iteration%increments(n, s), iteration%transforms(n, s), iteration%slopes(n, s))
         allocate (iteration%argument(n), iteration%end_slope(n))
         allocate (iteration%change(n, s), iteration%scales(n, s))
         allocate (iteration%delayed(delays, s), iteration%own_place(delays, s))
         allocate (iteration%own_weights(s, delays, s), iteration%places(s))
      end associate
      iteration%x = [0.0_wp, method%c]
      iteration%factors = lagrange_factors(iteration%x)
      iteration%systems = stage_systems(method, n)
      iteration%end_weights = iteration%systems%a_inverse(method%stages, :)
      iteration%sum_of_end_weights = sum(abs(iteration%end_weights))
   end function new_iteration

   !> Delayed values of stages that lie in the past, and the places of those in the step itself.
   pure subroutine place_delays(self, context, method)
      class(stage_iteration), intent(inout) :: self
      type(step_context), intent(inout) :: context
      type(radau_tableau), intent(in) :: method
      integer :: i, k, past

      associate (lag => context%problem%lag, h => context%cursor%h)
         self%places(:) = method%c*h
         ! the last stage is at the end
         self%coupled = any(lag < h)
         self%own_place(:, :) = 0.0_wp
         if (.not. self%coupled) then
            call context%delayed_values(self%places, self%delayed)
            return
         end if
         do k = 1, size(lag)
            past = 0
            do i = 1, method%stages
               self%own_place(k, i) = method%c(i) - lag(k)/h
               if (self%own_place(k, i) > 0.0_wp) then
                  call lagrange_weights(method%stages, self%x, self%factors, &
                                        self%own_place(k, i), self%own_weights(:, k, i))
               else
                  past = i
               end if
            end do
            if (past == 0) cycle
            call context%cursor%values_of(context%problem, context%past, k, k, past, self%places, &
                                          k, size(lag), self%delayed)
         end do
      end associate
   end subroutine place_delays

   !> Start of the iteration: the last step's polynomial extrapolated, or no change.
   pure subroutine start(self, method, last_increments, last_h, h)
      class(stage_iteration), intent(inout) :: self
      type(radau_tableau), intent(in) :: method
      !> Increments of the last step, shape (n, stages)
      real(wp), contiguous, intent(in) :: last_increments(:, :)
      !> Length of the last step; 0 where its polynomial must not be extrapolated
      real(wp), intent(in) :: last_h
      real(wp), intent(in) :: h
      real(wp) :: of_stage(stage_lanes), weights(stage_lanes, stage_lanes)
      integer :: i

      if (.not. last_h > 0.0_wp) then
         self%increments = 0.0_wp
         self%transforms = 0.0_wp
         return
      end if
      associate (s => method%stages, n => size(self%increments, 1))
         do i = 1, s
            call lagrange_weights(s, self%x, self%factors, 1.0_wp + method%c(i)*h/last_h, of_stage)
            weights(i, :s - 1) = of_stage(:s - 1)
            ! measured from the end of the last step
            weights(i, s) = of_stage(s) - 1.0_wp
         end do
         weights(s + 1:, :s) = 0.0_wp
         call combine(n, s, weights, last_increments, self%increments)
         call combine(n, s, self%systems%t_inverse, self%increments, self%transforms)
      end associate
   end subroutine start

   !> Delayed values that lie in this step, from the present increments.
   pure subroutine expect_delayed(self, components, y)
      class(stage_iteration), intent(inout) :: self
      integer, intent(in) :: components(:)
      real(wp), intent(in) :: y(:)
      real(wp) :: total
      integer :: i, j, k

      if (.not. self%coupled) return
      do i = 1, size(self%own_place, 2)
         do k = 1, size(self%own_place, 1)
            if (.not. self%own_place(k, i) > 0.0_wp) cycle
            total = y(components(k))
            do j = 1, size(self%own_place, 2)
               total = total + self%increments(components(k), j)*self%own_weights(j, k, i)
            end do
            self%delayed(k, i) = total
         end do
      end do
   end subroutine expect_delayed

   !> Simplified Newton iteration for the stage increments.
   pure subroutine iterate(self, context, method, y, scale, tolerance, safety, converged, &
                           finite)
      class(stage_iteration), intent(inout) :: self
      type(step_context), intent(inout) :: context
      type(radau_tableau), intent(in) :: method
      real(wp), contiguous, intent(in) :: y(:), scale(:)
      !> Tolerance of the error estimate
      real(wp), intent(in) :: tolerance
      !> Factor below the step size at which the error would be equal to the tolerance; it is
      !> smaller after many iterations
      real(wp), intent(inout) :: safety
      logical, intent(out) :: converged, finite
      real(wp) :: last_norm, last_rate, limit, norm, rate, rounding
      integer :: iteration, most, stage

      converged = .false.
      most = int(iterations_of_three + (method%stages - 3)*iterations_per_stage)
      limit = max(10.0_wp*epsilon(1.0_wp)/tolerance, &
                  min(largest_remainder, 2.0_wp*sqrt(tolerance)))
      ! the stiff residual is a small difference of large numbers: below this it is rounding
      rounding = 4.0_wp*epsilon(1.0_wp)*maxval(abs(y)/scale)
      do stage = 1, method%stages
         self%scales(:, stage) = scale
      end do
      last_norm = 0.0_wp
      last_rate = 1.0_wp
      do iteration = 1, most
         call self%slopes_at_stages(context, method, y, finite)
         if (.not. finite) return
         call self%systems%correct(method, self%slopes, self%transforms, context%work, self%change)
         norm = scaled_norm(size(self%change), self%change, self%scales)
         finite = ieee_is_finite(norm)
         if (.not. (finite .and. norm < huge(1.0_wp))) return
         if (iteration == 1) then
            ! these count if this is the only iteration
            self%contraction = 0.0_wp
            if (norm <= 1.0_wp) self%remainder = max(self%remainder, epsilon(1.0_wp))**0.8_wp
         else
            rate = norm/last_norm
            self%contraction = merge(rate, sqrt(rate*last_rate), iteration == 2)
            last_rate = rate
            if (self%contraction < 0.99_wp) then
               self%remainder = self%contraction/(1.0_wp - self%contraction)
               if (self%remainder*norm*self%contraction**(most - 1 - iteration) > limit &
                   .and. norm > rounding) exit
            else if (norm > rounding) then
               exit
            end if
         end if
         last_norm = max(norm, epsilon(1.0_wp))
         self%transforms(:, :) = self%transforms + self%change
         call combine(size(y), method%stages, self%systems%t, self%transforms, self%increments)
         ! a single correction must not exceed the tolerance
         if ((self%remainder*norm <= limit .and. (iteration > 1 .or. norm <= 1.0_wp)) &
             .or. norm <= rounding) then
            converged = .true.
            exit
         end if
      end do
      safety = 0.9_wp*(2*most + 1.0_wp)/(2*most + min(iteration, most))
   end subroutine iterate

   !> Slope of the collocation polynomial at the end of a step of length `h`.
   pure subroutine find_end_slope(self, h)
      class(stage_iteration), intent(inout) :: self
      real(wp), intent(in) :: h

      call add_up(size(self%end_slope), size(self%end_weights), self%end_weights, &
                  self%increments, h, self%end_slope)
   end subroutine find_end_slope

   !> Slopes of all stages.
   pure subroutine slopes_at_stages(self, context, method, y, finite)
      class(stage_iteration), intent(inout) :: self
      type(step_context), intent(inout) :: context
      type(radau_tableau), intent(in) :: method
      real(wp), contiguous, intent(in) :: y(:)
      logical, intent(out) :: finite
      real(wp) :: t, t_end
      integer :: i

      call self%expect_delayed(context%problem%component, y)
      associate (cursor => context%cursor)
         t = cursor%inside(cursor%t)
         t_end = cursor%inside(cursor%t + cursor%h)
         do i = 1, method%stages
            self%argument(:) = y + self%increments(:, i)
            call context%evaluate(merge(t_end, t + method%c(i)*cursor%h, i == method%stages), &
                                  self%argument, self%delayed(:, i), self%slopes(:, i))
         end do
      end associate
      finite = all_finite(size(self%slopes), self%slopes)
   end subroutine slopes_at_stages
end module dde_stage_iteration
