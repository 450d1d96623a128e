!> One step by the Taylor series of the solution, for problems that give it. The last coefficients
!> tell how long it may be, so that hardly a step is rejected; the series is its own dense output,
!> and serves as the past beyond the end of the step as far as it converges.
module dde_taylor_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_taylor_series, only: taylor_series
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: taylor_step_type

   !> Degree = this - log10(tolerance), near the one with the least cost for an accuracy: Jorba and
   !> Zou 2005, "A software package for the numerical integration of ODEs by means of high-order
   !> Taylor methods", sec. 3.2, have 1 - ln(tolerance)/2.
   real(wp), parameter :: degree_at_one = 5.0_wp
   !> Lowest degree.
   integer, parameter :: lowest_degree = 6
   !> How far the series is tried as the past, in units of the length it allows its own step.
   real(wp), parameter :: beyond = 1.2_wp
   !> The unit of a series is the length that the one before allowed, at most this times the length
   !> that its step had: powers of it must not overflow where a solution is a polynomial.
   real(wp), parameter :: growth = 1000.0_wp
   !> Cost of a series over that of a right-hand side, over its degree (instructions and time of the
   !> spring block).
   real(wp), parameter :: cost_of_degree = 0.75_wp
   !> Steps that one measurement of stiffness serves.
   integer, parameter :: steps_a_measurement = 2

   !> A step along the series from its start on.
   type, extends(step_type) :: taylor_step_type
      !> The series
      type(taylor_series), private :: series
      !> Whether the series is that of the step before the present state
      logical, private :: passed = .false.
      !> Whether its stiffness will be asked for
      logical, private :: measured = .false.
      !> Derivatives of the right-hand side at the start by y and z
      real(wp), allocatable, private :: by_y(:, :), by_z(:, :)
      !> Steps since they were evaluated
      integer, private :: since = 0
      !> Rate of change of the highest term by them
      real(wp), private :: rate = 0.0_wp
   contains
      procedure :: reset
      procedure :: look_ahead
      procedure :: attempt
      procedure :: complete
      procedure :: interpolant
      procedure :: stiffness
      procedure :: advance
      procedure :: slope_here
   end type taylor_step_type

   interface taylor_step_type
      module procedure :: new_step
   end interface taylor_step_type

contains

   !> Storage, and the state at the first instant.
   pure function new_step(problem, tolerance, measured) result(step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Relative or absolute tolerance, the larger
      real(wp), intent(in) :: tolerance
      !> Whether its stiffness will be asked for
      logical, intent(in) :: measured
      type(taylor_step_type) :: step
      integer :: degree

      degree = max(lowest_degree, min(highest_degree, nint(degree_at_one - log10(tolerance))))
      step%name = "taylor"
      step%order = degree
      step%error_order = degree
      step%foresees = .true.
      step%measured = measured
      step%evaluation_cost = cost_of_degree*degree
      associate (n => problem%n, delays => size(problem%lag))
         allocate (step%nodes(degree), source=0.0_wp)
         allocate (step%y(n), step%y_new(n), step%slope(n), step%z(delays, 1))
         allocate (step%by_y(n, n), step%by_z(n, delays))
      end associate
      step%series = taylor_series(problem, degree)
      call problem%initial(step%y)
   end function new_step

   !> The slope has been evaluated, the last step has no say.
   pure subroutine reset(self)
      !> The step
      class(taylor_step_type), intent(inout) :: self

      self%passed = .false.
      self%since = 0
   end subroutine reset

   !> The series, and how long the step may be: as the series allows, and as long as the past
   !> serves.
   pure subroutine look_ahead(self, problem, past, t, relative, absolute, longest, h)
      !> The step
      class(taylor_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing the step
      type(history_type), intent(inout) :: past
      !> Start of the step
      real(wp), intent(in) :: t
      !> Relative tolerance
      real(wp), intent(in) :: relative
      !> Absolute tolerance
      real(wp), intent(in) :: absolute
      !> Longest step of use
      real(wp), intent(in) :: longest
      !> Length of the step: proposed, then possible
      real(wp), intent(inout) :: h
      real(wp) :: past_serves, possible, scale(problem%n), unit
      logical :: passing

      unit = merge(min(self%ideal, growth*self%h), h, self%ideal > 0.0_wp)
      self%passed = .false.
      scale = absolute + relative*abs(self%y)
      passing = .true.
      associate (series => self%series)
         do
            series%unit = unit
            call past%series(problem, passing, series%unit, series%delayed, past_serves)
            call series%expand(problem, t, scale, self%evaluations, self%y)
            possible = min(series%reach, past_serves, longest)
            call past%confirm(series%delayed, series%unit, relative, absolute, possible)
            if (possible > 0.0_wp .or. .not. passing) exit
            passing = .false.
         end do
         self%ideal = series%reach
         self%slope = series%coefficients(1, :)/series%unit
      end associate
      self%serves = beyond*self%ideal
      if (self%ideal > 0.0_wp) h = possible
   end subroutine look_ahead

   !> Try the step of length `h` from t: the error is within the tolerance.
   pure subroutine attempt(self, problem, past, t, h, relative, absolute, error)
      !> The step
      class(taylor_step_type), intent(inout) :: self
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
      !> 0, or not a number where the series is not finite
      real(wp), intent(out) :: error

      self%t = t
      self%h = h
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. self%ideal > 0.0_wp) return
      ! beyond this, terms that have vanished in a very short step would count
      self%serves = min(self%serves, growth*h)
      self%y_new = self%series%state(h)
      if (all(ieee_is_finite(self%y_new))) error = 0.0_wp
   end subroutine attempt

   !> Now and then the rate of change that the highest term shows: large eigenvalues rule it,
   !> however little of them is in the solution.
   pure subroutine complete(self, problem, past)
      !> The step
      class(taylor_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      real(wp) :: changed(problem%n)
      integer :: i

      if (self%series%slow%holds .or. .not. self%measured) return
      self%since = modulo(self%since, steps_a_measurement) + 1
      if (self%since > 1) return
      associate (last => self%series%coefficients(self%order, :))
         call problem%jacobian(self%t, self%y, self%series%delayed(0, :), self%by_y, self%by_z)
         changed = 0.0_wp
         do i = 1, problem%n
            changed = changed + self%by_y(:, i)*last(i)
         end do
         self%rate = maxval(abs(changed))/max(tiny(1.0_wp), maxval(abs(last)))
      end associate
   end subroutine complete

   !> The series of component `i`.
   pure subroutine interpolant(self, i, a)
      !> The step
      class(taylor_step_type), intent(in) :: self
      !> Which component
      integer, intent(in) :: i
      !> Newton coefficients over `nodes`, which are all 0
      real(wp), intent(out) :: a(0:)

      real(wp) :: power
      integer :: k

      associate (series => self%series)
         a(0) = series%coefficients(0, i)
         power = 1.0_wp
         do k = 1, series%degree
            power = power*(self%h/series%unit)
            a(k) = power*series%coefficients(k, i)
         end do
      end associate
   end subroutine interpolant

   !> The rate at which the highest term of the series would change; none where a transient will
   !> end soon, and on a slow solution only that which limits the step where nothing else does.
   pure function stiffness(self) result(value)
      !> The step
      class(taylor_step_type), intent(in) :: self
      real(wp) :: value

      associate (slow => self%series%slow)
         if (slow%holds) then
            value = merge(self%order/self%ideal, 0.0_wp, slow%steady)
         else
            value = merge(0.0_wp, self%rate, slow%in_transient())
         end if
      end associate
   end function stiffness

   !> The end becomes the start.
   pure subroutine advance(self)
      !> The step
      class(taylor_step_type), intent(inout) :: self

      self%y = self%y_new
      self%passed = .true.
   end subroutine advance

   !> After a step the derivative of its series at the end.
   pure function slope_here(self) result(slope)
      !> The step
      class(taylor_step_type), intent(in) :: self
      real(wp) :: slope(size(self%y))

      slope = self%slope
      if (self%passed) slope = self%series%slope(self%h)
   end function slope_here
end module dde_taylor_step
