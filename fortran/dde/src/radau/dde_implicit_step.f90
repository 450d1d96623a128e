! SPDX-License-Identifier: BSD-3-Clause
!> One step of a Radau IIA method as method of steps, by simplified Newton iteration (Hairer and
!> Wanner 1996, sec. IV.8). Where the step is longer than a delay, its own collocation polynomial is
!> the past. The embedded error estimate overlooks very stiff components, so that `confirm` and
!> `find_error_inside` check the step, too.
module dde_implicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_collocation, only: add_up, difference_weights, shape_bump
   use dde_jacobian, only: jacobian_type
   use dde_controller, only: method_constants
   use dde_memory, only: find_lacking
   use dde_problem, only: dde_problem_type
   use dde_radau_tableau, only: radau_iia, radau_tableau
   use dde_stage_iteration, only: stage_iteration
   use dde_stage_systems, only: fill_end
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_systems, only: real_system
   use dde_tolerance, only: all_finite, hopeless, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: implicit_cost, implicit_step_type

   !> Contraction below which the next step uses the same Jacobian.
   real(wp), parameter :: good_contraction = 1.0e-3_wp
   !> Up to this ratio the step size is kept, and the factors with it.
   real(wp), parameter :: keep_length = 1.2_wp
   !> Below this value of step size times norm of the Jacobian the problem is not stiff.
   real(wp), parameter :: least_stiff = 8.0_wp
   !> A step is far too long if this share of the last term of its polynomial is above the
   !> tolerance: there the embedded error can be small by chance.
   real(wp), parameter :: least_hidden = 0.003_wp
   !> Cost of an evaluation within this method over one within the explicit pair.
   real(wp), parameter :: implicit_cost = 3.0_wp

   !> Stages and factors of the current step.
   type, extends(step_type) :: implicit_step_type
      !> The method
      type(radau_tableau) :: method
      !> Newton coefficients, over `nodes`, of the polynomial whose derivative vanishes at all c
      real(wp), allocatable :: bump(:)
      !> Derivative of `bump` at 0
      real(wp) :: bump_slope = 0.0_wp
      !> Derivatives of the right-hand side
      type(jacobian_type) :: jacobian
      !> Stages of the step and the iteration that finds them
      type(stage_iteration) :: stages
      !> Weights of the increments in the Newton coefficients 1 to stages, shape (stages, stages)
      real(wp), allocatable :: differences(:, :)
      !> Increments of the last accepted step, shape (n, stages)
      real(wp), allocatable :: last_increments(:, :)
      !> Length of the last accepted step; 0 when its polynomial must not be extrapolated
      real(wp) :: last_h = 0.0_wp
      !> Error of the embedded method, filtered and not, and without the slope, shape (n)
      real(wp), allocatable :: error_vector(:), unfiltered(:), raw(:)
      !> Tolerance that the error estimate is held to, and over that of the step
      real(wp), private :: asked = 1.0_wp, asked_over_level = 1.0_wp
      !> The tolerance asked for over that of the error between the ends
      real(wp), private :: asked_over_inside = 1.0_wp
      !> The Jacobian at the end of the step, and its real system
      type(jacobian_type), allocatable, private :: jacobian_at_end
      type(real_system), allocatable, private :: system_at_end
      !> Whether the last Jacobian can be used again
      logical :: jacobian_is_good = .false.
   contains
      procedure :: set_up, reset, attempt, interpolant, stiff, advance
      procedure, private :: confirm, estimate, find_error_inside, prepare
   end type implicit_step_type

contains

   !> Storage, and the constants that follow from the method.
   subroutine set_up(self, problem, stages, level, lacking)
      class(implicit_step_type), intent(out) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Number of stages
      integer, intent(in) :: stages
      !> Level of the tolerance
      real(wp), intent(in) :: level
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking

      lacking = find_lacking(size_of_step(problem, stages))
      if (lacking > 0.0_wp) return
      self%method = radau_iia(stages)
      self%constants = method_constants(order=2*stages - 1, error_order=stages + 1, &
                                        implicit=.true., evaluation_cost=implicit_cost, &
                                        predictive=.true., largest_kept_ratio=keep_length)
      call self%allocate_state(problem)
      self%nodes = [0.0_wp, self%method%c]
      associate (n => problem%n, delays => size(problem%lag))
         allocate (self%error_vector(n), self%raw(n), self%unfiltered(n))
         allocate (self%jacobian_at_end, self%system_at_end)
         allocate (self%last_increments(n, stages))
         self%stages = stage_iteration(self%method, n, delays)
      end associate
      ! the estimate has order s, the polynomial s + 1, the ends more: with this tolerance of the
      ! estimate, errors are near the tolerance of the step, as with the explicit method
      self%asked = level**((stages + 1.0_wp)/(stages + 2.0_wp))
      self%asked_over_level = self%asked/level
      self%asked_over_inside = self%asked/level**(real(stages, wp)/(stages + 1))
      self%differences = difference_weights([0.0_wp, self%method%c])
      call shape_bump(self%method%c, self%bump, self%bump_slope)
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
      class(implicit_step_type), intent(inout) :: self

      self%last_h = 0.0_wp
      self%jacobian_is_good = .false.
      self%stages%contraction = 1.0_wp
      self%stages%remainder = 1.0_wp
   end subroutine reset

   !> Attempt a step: iterate, check the result, estimate its error.
   pure subroutine attempt(self, context, error)
      class(implicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error
      logical :: converged, finite, singular

      self%t = context%cursor%t
      self%h = context%cursor%h
      call context%tolerance%scale(self%y, self%scale)
      self%scale(:) = self%asked_over_level*self%scale
      call self%stages%place_delays(context, self%method)
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      do
         if (.not. self%last_h > 0.0_wp) call context%delayed_values([0.0_wp], self%z)
         call self%stages%start(self%method, self%last_increments, self%last_h, self%h)
         call self%prepare(context, singular)
         converged = .false.
         if (.not. singular) then
            call self%stages%iterate(context, self%method, self%y, self%scale, self%asked, &
                                     self%safety, converged, finite)
         end if
         if (converged) call self%confirm(context, converged)
         if (converged .or. .not. self%last_h > 0.0_wp) exit
         ! the extrapolated polynomial may be too far off or the Jacobian too old: start again
         self%last_h = 0.0_wp
         self%jacobian_is_good = .false.
      end do
      if (converged) then
         call self%estimate(context, error)
         if (ieee_is_finite(error)) then
            call self%find_error_inside(error)
            if (error <= 1.0_wp) return
         end if
      else if (.not. singular) then
         if (finite) error = huge(1.0_wp)
      end if
      self%jacobian_is_good = .false.
   end subroutine attempt

   !> Jacobian and factors, where the last ones cannot be used. The Jacobian is evaluated at the
   !> expected middle stage, which is nearer to all stages than the start of the step.
   pure subroutine prepare(self, context, singular)
      class(implicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      !> Whether there is no Jacobian or a system has no solution
      logical, intent(out) :: singular
      logical :: finite
      real(wp) :: longest

      singular = .false.
      longest = merge(self%h, 0.0_wp, self%stages%coupled)
      if (.not. self%jacobian_is_good .or. self%jacobian%known_to < longest) then
         call self%stages%expect_delayed(context%problem%component, self%y)
         associate (middle => (self%method%stages + 1)/2)
            self%stages%argument(:) = self%y + self%stages%increments(:, middle)
            call self%jacobian%evaluate(context%problem, context%tolerance, context%work, &
                                        self%t + self%method%c(middle)*self%h, &
                                        self%stages%argument, self%stages%delayed(:, middle), &
                                        2*longest, finite)
         end associate
         self%stages%systems%h = 0.0_wp
         singular = .not. finite
         if (singular) return
         self%jacobian_is_good = .true.
      end if
      if (.not. abs(self%stages%systems%h - self%h) > 0.0_wp) return
      call self%stages%systems%prepare(self%method, self%h, self%jacobian, &
                                       context%problem%component, self%stages%own_place, &
                                       self%stages%own_weights, context%work, singular)
   end subroutine prepare

   !> Whether the last stage solves its equation by the Jacobian there too. If the Jacobian of the
   !> iteration is far too large, corrections are small without a solution.
   pure subroutine confirm(self, context, confirmed)
      class(implicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      logical, intent(out) :: confirmed
      real(wp) :: allowed, t_end
      logical :: finite, singular

      confirmed = .false.
      t_end = context%cursor%inside(self%t + self%h)
      associate (stages => self%stages, y_end => self%stages%argument, &
                 slope => self%stages%end_slope, misfit => self%unfiltered, &
                 last => self%method%stages)
         y_end(:) = self%y + stages%increments(:, last)
         call stages%find_end_slope(self%h)
         call context%evaluate(t_end, y_end, stages%delayed(:, last), misfit)
         if (.not. all_finite(size(misfit), misfit)) return
         misfit(:) = misfit - slope
         ! a part of the tolerance, and what rounding does to the slope
         allowed = 0.1_wp + 4.0_wp*epsilon(1.0_wp)*maxval(abs(y_end)/self%scale) &
                   *stages%sum_of_end_weights
         confirmed = self%h*scaled_norm(size(misfit), misfit, self%scale) &
                     <= self%method%real_eigenvalue*allowed
         if (confirmed) return
         call self%jacobian_at_end%evaluate(context%problem, context%tolerance, context%work, &
                                            t_end, y_end, stages%delayed(:, last), &
                                            merge(self%h, 0.0_wp, stages%coupled), finite)
         if (.not. finite) return
         call fill_end(self%system_at_end, self%method, self%h, self%jacobian_at_end, &
                       context%problem%component, stages%own_place)
         call self%system_at_end%factorise(singular)
         context%work%operations = context%work%operations &
                                   + self%system_at_end%factor_operations
         if (singular) return
         call self%system_at_end%solve(misfit)
         confirmed = scaled_norm(size(misfit), misfit, self%scale) <= allowed
      end associate
   end subroutine confirm

   !> Error of the embedded method of order s. The real system filters it: otherwise stiff
   !> components would dominate it (Hairer and Wanner 1996, eq. (IV.8.20)).
   pure subroutine estimate(self, context, error)
      class(implicit_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error
      real(wp) :: t

      call add_up(size(self%raw), self%method%stages, self%method%e, self%stages%increments, &
                  self%h, self%raw)
      self%error_vector(:) = self%slope + self%raw
      self%unfiltered(:) = self%error_vector
      call self%stages%systems%filter(self%error_vector)
      error = scaled_norm(size(self%y), self%error_vector, self%scale)
      self%y_new(:) = self%y + self%stages%increments(:, self%method%stages)
      if (.not. all_finite(size(self%y_new), self%y_new)) error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (error >= 1.0_wp .and. .not. self%last_h > 0.0_wp) then
         ! at a start it is filtered again. The slope at the start may be that of an
         ! earlier polynomial, so that only the change of the right-hand side by the error is added
         t = context%cursor%inside(self%t)
         associate (slope => self%stages%argument)
            call context%evaluate(t, self%y, self%z, slope)
            call context%evaluate(t, self%y + self%error_vector, self%z, self%error_vector)
            if (.not. (all_finite(size(slope), slope) &
                       .and. all_finite(size(slope), self%error_vector))) return
            self%error_vector = (self%error_vector - slope) + (self%slope + self%raw)
         end associate
         self%unfiltered = self%error_vector
         call self%stages%systems%filter(self%error_vector)
         error = scaled_norm(size(self%y), self%error_vector, self%scale)
      end if
   end subroutine estimate

   !> Replace the error by that between the ends, in units of the tolerance, if that is larger. A
   !> stiff component that follows the others at once is right at the stages however long the step,
   !> and its embedded error is filtered away. So the last term of the polynomial there, of size
   !> h**s, is compared with tol**(s/(s + 1)). `unfiltered` is replaced by the hidden part of that
   !> term.
   pure subroutine find_error_inside(self, error)
      class(implicit_step_type), intent(inout) :: self
      real(wp), intent(inout) :: error
      real(wp) :: bound, doubled, inside
      integer :: k

      associate (s => self%method%stages, hidden => self%unfiltered, h => self%h, &
                 last_term => self%raw)
         call add_up(size(hidden), s, self%differences(:, s), self%stages%increments, 1.0_wp, &
                     last_term)
         ! the filter does not change the errors of components that are not stiff
         doubled = 2.0_wp*(self%method%real_eigenvalue/h)
         do k = 1, size(last_term)
            hidden(k) = max(0.0_wp, abs(hidden(k)) - doubled*abs(self%error_vector(k))) &
                        /max(abs(hidden(k)), tiny(1.0_wp))*last_term(k)
         end do
         bound = self%method%bulge*self%asked_over_inside
         inside = bound*min(scaled_norm(size(hidden), hidden, self%scale), hopeless)
         ! below 1 its power is smaller still
         if (inside > min(error, 1.0_wp)) error = max(error, inside**((s + 1.0_wp)/s))
         if (error > 1.0_wp) return
         inside = least_hidden*bound*min(scaled_norm(size(hidden), last_term, self%scale), hopeless)
         if (inside > 1.0_wp) error = inside
      end associate
   end subroutine find_error_inside

   !> Collocation polynomial of component `i` plus a multiple of the bump, which gives it the slope
   !> at the start and one order more.
   pure subroutine interpolant(self, i, a)
      class(implicit_step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), contiguous, intent(out) :: a(0:)
      integer :: j, k

      a(:) = (self%method%real_eigenvalue*self%error_vector(i)/self%bump_slope)*self%bump
      associate (increments => self%stages%increments)
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
      class(implicit_step_type), intent(in) :: self

      value = .not. self%h*maxval(self%jacobian%row_sums) < least_stiff
   end function stiff

   !> The end becomes the start. Jacobian and factors are kept if the iteration converged fast.
   pure subroutine advance(self)
      class(implicit_step_type), intent(inout) :: self

      self%slope(:) = self%stages%end_slope
      self%y(:) = self%y_new
      self%last_increments(:, :) = self%stages%increments
      self%last_h = self%h
      self%jacobian_is_good = self%stages%contraction <= good_contraction
   end subroutine advance
end module dde_implicit_step
