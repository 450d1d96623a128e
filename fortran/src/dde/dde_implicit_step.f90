!> One step of a Radau IIA method as method of steps, by simplified Newton iteration (Hairer and
!> Wanner 1996, sec. IV.8). Where the step is longer than a delay, its own collocation polynomial is
!> the history.
module dde_implicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_collocation, only: divide_differences, lagrange_weights, shape_bump
   use dde_history, only: history_type
   use dde_interpolant, only: newton_value
   use dde_norm, only: scaled_norm
   use dde_problem, only: dde_problem_type
   use dde_radau_tableau, only: radau_iia, radau_tableau
   use dde_stage_systems, only: stage_systems
   use dde_step, only: step_type
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: implicit_step_type

   !> Iterations allowed: this many, and more for each stage above three.
   real(wp), parameter :: iterations_of_three = 7.0_wp, iterations_per_stage = 2.5_wp
   !> Contraction below which the Jacobian serves another step.
   real(wp), parameter :: good_contraction = 1.0e-3_wp
   !> Ratio of step lengths up to which it pays to keep length and factors.
   real(wp), parameter :: keep_length = 1.2_wp

   !> Stages and factors of the current step.
   type, extends(step_type) :: implicit_step_type
      !> The method
      type(radau_tableau) :: method
      !> Newton coefficients, over `nodes`, of the polynomial whose derivative vanishes at all c
      real(wp), allocatable :: bump(:)
      !> Its derivative at 0
      real(wp) :: bump_slope = 0.0_wp
      !> Derivatives of the right-hand side by y and z, shapes (n, n) and (n, delayed values)
      real(wp), allocatable :: by_y(:, :), by_z(:, :)
      !> Systems of the iteration
      type(stage_systems) :: systems
      !> Increments Y - y at the stages, and their transforms, shape (n, stages)
      real(wp), allocatable :: increments(:, :), transforms(:, :)
      !> Slopes at the stages, shape (n, stages)
      real(wp), allocatable :: slopes(:, :)
      !> Delayed values at the stages, shape (delayed values, stages)
      real(wp), allocatable :: delayed(:, :)
      !> Place of each stage's delayed values in this step, in units of h; <= 0 in the past
      real(wp), allocatable :: own_place(:, :)
      !> Newton coefficients of the increments over this and the last accepted step, (0:stages, n)
      real(wp), allocatable :: differences(:, :), last_differences(:, :)
      !> Length of the last accepted step; 0 when its polynomial says nothing on this one
      real(wp) :: last_h = 0.0_wp
      !> Filtered error of the embedded method, shape (n)
      real(wp), allocatable :: error_vector(:)
      !> Whether the Jacobian belongs to the start of this step, and whether it still serves
      logical :: jacobian_fresh = .false., jacobian_serves = .false.
      !> Contraction theta of the last iteration
      real(wp) :: contraction = 1.0_wp
      !> What is left after a correction, over the correction: theta/(1 - theta), or a guess that
      !> loses trust with each step that did not measure it
      real(wp) :: remainder = 1.0_wp
   contains
      procedure :: reset
      procedure :: factorisations
      procedure :: attempt
      procedure :: complete
      procedure :: extend
      procedure :: interpolant
      procedure :: stiffness
      procedure :: advance
      procedure, private :: place_delays, prepare, predict, iterate, slopes_at_stages, estimate
   end type implicit_step_type

   interface implicit_step_type
      module procedure :: new_step
   end interface implicit_step_type

contains

   !> Storage, and the constants that follow from the method.
   pure function new_step(problem, stages) result(step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Number of stages: 3, 5 or 7
      integer, intent(in) :: stages
      type(implicit_step_type) :: step
      integer :: delays, n

      n = problem%n
      delays = size(problem%lag)
      step%method = radau_iia(stages)
      write (step%name, "(a,i0)") "radau", 2*stages - 1
      step%order = 2*stages - 1
      step%error_order = stages + 1
      step%implicit = .true.
      step%predictive = .true.
      step%hold = keep_length
      step%nodes = [0.0_wp, step%method%c]
      allocate (step%y(n), step%y_new(n), step%slope(n), step%z(delays), step%error_vector(n))
      allocate (step%by_y(n, n), step%by_z(n, delays))
      allocate (step%increments(n, stages), step%transforms(n, stages), step%slopes(n, stages))
      allocate (step%delayed(delays, stages), step%own_place(delays, stages))
      allocate (step%differences(0:stages, n), step%last_differences(0:stages, n))
      step%systems = stage_systems(step%method, n)
      call shape_bump(step%method%c, step%bump, step%bump_slope)
      call problem%initial(step%y)
   end function new_step

   !> Polynomial, Jacobian and factors from before do not serve.
   pure subroutine reset(self)
      !> The step
      class(implicit_step_type), intent(inout) :: self

      self%last_h = 0.0_wp
      self%jacobian_serves = .false.
      self%jacobian_fresh = .false.
      self%contraction = 1.0_wp
      self%remainder = 1.0_wp
   end subroutine reset

   !> Those of the systems and those before.
   pure function factorisations(self) result(count)
      !> The step
      class(implicit_step_type), intent(in) :: self
      integer(int64) :: count

      count = self%factorised_before + self%systems%factorisations
   end function factorisations

   !> Try the step of length `h` from t.
   pure subroutine attempt(self, problem, past, t, h, relative, absolute, error)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Start of the step
      real(wp), intent(in) :: t
      !> Length of the step
      real(wp), intent(in) :: h
      !> Relative tolerance
      real(wp), intent(in) :: relative
      !> Absolute tolerance
      real(wp), intent(in) :: absolute
      !> Estimated error in units of the tolerance
      real(wp), intent(out) :: error
      real(wp) :: scale(size(self%y)), asked
      logical :: converged, finite, singular

      self%t = t
      self%h = h
      ! the estimate has order s, the method of steps s + 1 inside and more at the ends: asked for
      ! this, errors come out near the tolerance, as they do with the explicit method
      asked = max(relative, absolute)**((self%method%stages + 1.0_wp)/(self%method%stages + 2.0_wp))
      scale = asked/max(relative, absolute)*(absolute + relative*abs(self%y))
      call self%place_delays(problem, past)
      call self%prepare(problem, past, singular)
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (singular) return
      call self%predict()
      call self%iterate(problem, scale, asked, converged, finite)
      if (converged) then
         call self%estimate(problem, scale, error)
      else if (finite) then
         error = huge(1.0_wp)
      end if
      if (ieee_is_finite(error)) then
         if (error <= 1.0_wp) return
      end if
      if (.not. self%jacobian_fresh) self%jacobian_serves = .false.
   end subroutine attempt

   !> Delayed values of all stages, and where they lie in this very step.
   pure subroutine place_delays(self, problem, past)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      integer :: i

      if (size(problem%lag) == 0) return
      do i = 1, self%method%stages
         self%own_place(:, i) = self%method%c(i) - problem%lag/self%h
         call past%values(problem, self%method%c(i)*self%h, self%delayed(:, i))
      end do
   end subroutine place_delays

   !> Jacobian and factors, as far as the last ones do not serve.
   pure subroutine prepare(self, problem, past, singular)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Whether there is no Jacobian or a system has no solution
      logical, intent(out) :: singular

      singular = .false.
      if (.not. self%jacobian_serves) then
         if (size(self%z) > 0) call past%values(problem, 0.0_wp, self%z)
         call problem%jacobian(self%t, self%y, self%z, self%by_y, self%by_z)
         self%systems%h = 0.0_wp
         singular = .not. (all(ieee_is_finite(self%by_y)) .and. all(ieee_is_finite(self%by_z)))
         if (singular) return
         self%jacobian_serves = .true.
         self%jacobian_fresh = .true.
      end if
      if (abs(self%systems%h - self%h) > 0.0_wp .or. self%systems%coupled &
          .or. any(self%own_place > 0.0_wp)) then
         call self%systems%prepare(self%method, self%h, self%by_y, self%by_z, problem%component, &
                                   self%own_place, singular)
      end if
   end subroutine prepare

   !> Start of the iteration: the last step's polynomial carried on, or no change.
   pure subroutine predict(self)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      real(wp) :: ahead
      integer :: i, k

      self%increments = 0.0_wp
      if (self%last_h > 0.0_wp) then
         do i = 1, self%method%stages
            ahead = 1.0_wp + self%method%c(i)*self%h/self%last_h
            do k = 1, size(self%y)
               self%increments(k, i) = newton_value(self%nodes(:self%method%stages), &
                                                    self%last_differences(:, k), ahead) &
                                       - newton_value(self%nodes(:self%method%stages), &
                                                      self%last_differences(:, k), 1.0_wp)
            end do
         end do
      end if
      self%transforms = matmul(self%increments, transpose(self%method%t_inverse))
   end subroutine predict

   !> Simplified Newton iteration for the stage increments.
   pure subroutine iterate(self, problem, scale, tolerance, converged, finite)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Scale of each component
      real(wp), intent(in) :: scale(:)
      !> Tolerance of the error estimate
      real(wp), intent(in) :: tolerance
      !> Whether it converged
      logical, intent(out) :: converged
      !> Whether all evaluations were finite
      logical, intent(out) :: finite
      real(wp) :: change(size(scale), self%method%stages)
      real(wp) :: last_norm, last_rate, limit, norm, rate, rounding
      integer :: i, iteration, most

      converged = .false.
      most = int(iterations_of_three + (self%method%stages - 3)*iterations_per_stage)
      limit = max(10.0_wp*epsilon(1.0_wp)/tolerance, min(0.03_wp, sqrt(tolerance)))
      ! the stiff residual is a small difference of large numbers: below this all is rounding
      rounding = 4.0_wp*epsilon(1.0_wp)*maxval(abs(self%y))/minval(scale)
      self%remainder = max(self%remainder, epsilon(1.0_wp))**0.8_wp
      last_norm = 0.0_wp
      last_rate = 1.0_wp
      do iteration = 1, most
         call self%slopes_at_stages(problem, finite)
         if (.not. finite) return
         change = self%systems%correct(self%method, self%slopes, self%increments, self%transforms)
         norm = scaled_norm(reshape(change, [size(change)]), [(scale, i=1, size(change, 2))])
         finite = ieee_is_finite(norm)
         if (.not. finite) return
         if (iteration > 1) then
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
         self%transforms = self%transforms + change
         self%increments = matmul(self%transforms, transpose(self%method%t))
         ! one correction alone is trusted only where it is no larger than the tolerance
         if ((self%remainder*norm <= limit .and. (iteration > 1 .or. norm <= 1.0_wp)) &
             .or. norm <= rounding) then
            converged = .true.
            exit
         end if
      end do
      self%safety = 0.9_wp*(2*most + 1.0_wp)/(2*most + min(iteration, most))
   end subroutine iterate

   !> Slopes of all stages.
   pure subroutine slopes_at_stages(self, problem, finite)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Whether all are finite
      logical, intent(out) :: finite
      integer :: i, k

      do i = 1, self%method%stages
         do k = 1, size(problem%lag)
            if (.not. self%own_place(k, i) > 0.0_wp) cycle
            associate (component => problem%component(k))
               self%delayed(k, i) = self%y(component) &
                                    + sum(lagrange_weights(self%nodes, self%own_place(k, i)) &
                                          *self%increments(component, :))
            end associate
         end do
         call problem%rhs(self%t + self%method%c(i)*self%h, self%y + self%increments(:, i), &
                          self%delayed(:, i), self%slopes(:, i))
      end do
      self%evaluations = self%evaluations + self%method%stages
      finite = all(ieee_is_finite(self%slopes))
   end subroutine slopes_at_stages

   !> Error of the embedded method of order s, filtered by the real system so that stiff components
   !> do not drown it (Hairer and Wanner 1996, eq. (IV.8.20)).
   pure subroutine estimate(self, problem, scale, error)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Scale of each component
      real(wp), intent(in) :: scale(:)
      !> Estimated error in units of the tolerance
      real(wp), intent(out) :: error
      real(wp) :: raw(size(scale))

      raw = matmul(self%increments, self%method%e)/self%h
      self%error_vector = self%slope + raw
      call self%systems%filter(self%error_vector)
      error = scaled_norm(self%error_vector, scale)
      if (error >= 1.0_wp .and. .not. self%last_h > 0.0_wp) then
         ! at a start, once more through the filter
         call problem%rhs(self%t, self%y + self%error_vector, self%z, self%error_vector)
         self%evaluations = self%evaluations + 1
         if (all(ieee_is_finite(self%error_vector))) then
            self%error_vector = self%error_vector + raw
            call self%systems%filter(self%error_vector)
            error = scaled_norm(self%error_vector, scale)
         end if
      end if
      self%y_new = self%y + self%increments(:, self%method%stages)
      if (.not. all(ieee_is_finite([error, self%y_new]))) error = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine estimate

   !> Newton coefficients of the collocation polynomial.
   pure subroutine complete(self, problem, past)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      integer :: k

      do k = 1, problem%n
         self%differences(0, k) = 0.0_wp
         self%differences(1:, k) = self%increments(k, :)
         call divide_differences(self%nodes, self%differences(:, k))
      end do
   end subroutine complete

   !> Nothing more to evaluate.
   pure subroutine extend(self, problem, past)
      !> The step
      class(implicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
   end subroutine extend

   !> Collocation polynomial of component `i` and the multiple of the bump that gives it the slope
   !> at the start: one order more.
   pure subroutine interpolant(self, i, a)
      !> The step
      class(implicit_step_type), intent(in) :: self
      !> Which component
      integer, intent(in) :: i
      !> Newton coefficients over `nodes`
      real(wp), intent(out) :: a(0:)

      a = self%method%real_eigenvalue*self%error_vector(i)/self%bump_slope*self%bump
      a(0:self%method%stages) = a(0:self%method%stages) + self%differences(:, i)
      a(0) = self%y(i)
   end subroutine interpolant

   !> Norm of the Jacobian.
   pure function stiffness(self) result(value)
      !> The step
      class(implicit_step_type), intent(in) :: self
      real(wp) :: value

      value = maxval(sum(abs(self%by_y), dim=2))
   end function stiffness

   !> The end becomes the start; polynomial, Jacobian and factors serve on as far as they are good.
   pure subroutine advance(self)
      !> The step
      class(implicit_step_type), intent(inout) :: self

      self%slope = matmul(self%increments, self%systems%a_inverse(self%method%stages, :))/self%h
      self%y = self%y_new
      self%last_differences = self%differences
      self%last_h = self%h
      self%jacobian_fresh = .false.
      self%jacobian_serves = self%contraction <= good_contraction
   end subroutine advance
end module dde_implicit_step
