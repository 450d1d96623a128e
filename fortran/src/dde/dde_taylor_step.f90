!> One step by the Taylor series of the solution, for problems that give it. The last coefficients
!> tell how long it may be, so that hardly a step is rejected; the series is its own dense output,
!> and serves as the past beyond the end of the step as far as it converges.
module dde_taylor_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
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
   !> Share of the length at which the last two terms reach the tolerance: for what follows them.
   real(wp), parameter :: share = 0.9_wp
   !> How long the series serves at most, in units of how long those of the delayed values do: it
   !> solves an equation whose delayed values depart from the solution there.
   real(wp), parameter :: beyond = 2.5_wp
   !> The unit of a series is the length that the one before allowed, at most this times the length
   !> that its step had: powers of it must not overflow where a solution is a polynomial.
   real(wp), parameter :: growth = 1000.0_wp
   !> Cost of a series over that of a right-hand side, over its degree (instructions and time of the
   !> spring block).
   real(wp), parameter :: cost_of_degree = 0.75_wp
   !> Steps that one measurement of stiffness serves.
   integer, parameter :: steps_a_measurement = 2

   !> The series from the start of the current step on.
   type, extends(step_type) :: taylor_step_type
      !> Unit of time of its powers; 0 before the first series
      real(wp), private :: unit = 0.0_wp
      !> Coefficients of the solution and of its delayed values, shapes (0:degree, n) and
      !> (0:degree, number of delayed values)
      real(wp), allocatable, private :: series(:, :), delayed(:, :)
      !> Whether the series is that of the step before the present state
      logical, private :: passed = .false.
      !> All components, and those that are delayed anywhere
      integer, allocatable, private :: all(:), kept(:)
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
      integer :: degree, i

      degree = max(lowest_degree, min(highest_degree, nint(degree_at_one - log10(tolerance))))
      step%name = "taylor"
      step%order = degree
      step%error_order = degree
      step%foresees = .true.
      step%measured = measured
      step%evaluation_cost = cost_of_degree*degree
      associate (n => problem%n, delays => size(problem%lag))
         allocate (step%nodes(degree), source=0.0_wp)
         allocate (step%series(0:degree, n), step%delayed(0:degree, delays))
         allocate (step%y(n), step%y_new(n), step%slope(n), step%z(delays, 1))
         allocate (step%by_y(n, n), step%by_z(n, delays))
      end associate
      step%all = [(i, i=1, problem%n)]
      step%kept = pack(step%all, [(any(problem%component == i), i=1, problem%n)])
      call problem%initial(step%y)
   end function new_step

   !> The slope has been evaluated, the last step has no say.
   pure subroutine reset(self)
      !> The step
      class(taylor_step_type), intent(inout) :: self

      self%passed = .false.
      self%since = 0
   end subroutine reset

   !> The series, and how long the step may be: as its last two terms allow, which those left out
   !> follow, and as long as the past serves.
   pure subroutine look_ahead(self, problem, past, t, relative, absolute, h)
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
      !> Length of the step: proposed, then possible
      real(wp), intent(inout) :: h
      real(wp) :: past_serves

      self%unit = merge(min(self%ideal, growth*self%h), h, self%ideal > 0.0_wp)
      self%ideal = 0.0_wp
      self%passed = .false.
      self%series(0, :) = self%y
      call past%series(problem, self%unit, self%delayed, past_serves, self%known)
      call problem%series(t, self%unit, self%order, self%delayed, self%series)
      self%evaluations = self%evaluations + 1
      self%slope = self%series(1, :)/self%unit
      if (.not. all(ieee_is_finite(self%series(self%order - 1:, :)))) return
      ! what the past does not know of the solution enters one degree higher
      self%known = min(self%known + 1, self%order)
      self%ideal = self%unit*within(self, self%order, self%all, relative, absolute)
      self%serves = self%unit*within(self, self%known, self%kept, relative, absolute)
      if (self%serves/beyond > past_serves) self%serves = beyond*past_serves
      h = min(self%ideal, past_serves)
   end subroutine look_ahead

   !> How far, in units of its powers, two terms of the series are within the tolerance.
   pure function within(self, degree, components, relative, absolute) result(reach)
      !> The step
      class(taylor_step_type), intent(in) :: self
      !> Degree of the second term
      integer, intent(in) :: degree
      !> Of which components
      integer, intent(in) :: components(:)
      !> Relative tolerance
      real(wp), intent(in) :: relative
      !> Absolute tolerance
      real(wp), intent(in) :: absolute
      real(wp) :: reach
      real(wp) :: scale, terms(2)
      integer :: i

      terms = tiny(1.0_wp)
      do i = 1, size(components)
         associate (c => components(i))
            scale = absolute + relative*abs(self%y(c))
            terms(1) = max(terms(1), abs(self%series(degree - 1, c))/scale)
            terms(2) = max(terms(2), abs(self%series(degree, c))/scale)
         end associate
      end do
      reach = share*exp(-max(log(terms(1))/(degree - 1), log(terms(2))/degree))
   end function within

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
      integer :: i

      self%t = t
      self%h = h
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. self%ideal > 0.0_wp) return
      ! beyond this, terms that have vanished in a very short step would count
      self%serves = min(self%serves, growth*h)
      do i = 1, problem%n
         self%y_new(i) = end_of_series(self%order, self%series(:, i), h/self%unit)
      end do
      if (all(ieee_is_finite(self%y_new))) error = 0.0_wp
   end subroutine attempt

   !> Value of a series at s.
   pure function end_of_series(degree, series, s) result(value)
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients
      real(wp), intent(in) :: series(0:degree)
      !> Place, in units of its powers
      real(wp), intent(in) :: s
      real(wp) :: value
      integer :: k

      value = series(degree)
      do k = degree - 1, 0, -1
         value = series(k) + s*value
      end do
   end function end_of_series

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

      if (.not. self%measured) return
      self%since = modulo(self%since, steps_a_measurement) + 1
      if (self%since > 1) return
      call problem%jacobian(self%t, self%y, self%delayed(0, :), self%by_y, self%by_z)
      changed = 0.0_wp
      do i = 1, problem%n
         changed = changed + self%by_y(:, i)*self%series(self%order, i)
      end do
      self%rate = maxval(abs(changed))/max(tiny(1.0_wp), maxval(abs(self%series(self%order, :))))
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

      a(0) = self%series(0, i)
      power = 1.0_wp
      do k = 1, self%order
         power = power*(self%h/self%unit)
         a(k) = power*self%series(k, i)
      end do
   end subroutine interpolant

   !> The rate at which the highest term of the series would change.
   pure function stiffness(self) result(value)
      !> The step
      class(taylor_step_type), intent(in) :: self
      real(wp) :: value

      value = self%rate
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
      integer :: k

      slope = self%slope
      if (.not. self%passed) return
      slope = 0.0_wp
      do k = self%order, 1, -1
         slope = k*self%series(k, :) + (self%h/self%unit)*slope
      end do
      slope = slope/self%unit
   end function slope_here
end module dde_taylor_step
