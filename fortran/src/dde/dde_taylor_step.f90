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
   real(wp), parameter :: share = 0.85_wp
   !> Cost of a series over that of a right-hand side, over its degree (instructions and time of the
   !> spring block).
   real(wp), parameter :: cost_of_degree = 0.75_wp

   !> The series from the start of the current step on.
   type, extends(step_type) :: taylor_step_type
      !> Unit of time of its powers; 0 before the first series
      real(wp), private :: unit = 0.0_wp
      !> Coefficients of the solution and of its delayed values, shapes (0:degree, n) and
      !> (0:degree, number of delayed values)
      real(wp), allocatable, private :: series(:, :), delayed(:, :)
      !> Slope at the end of the step times that unit, shape (n)
      real(wp), allocatable, private :: rise(:)
      !> Whether a component is delayed anywhere, shape (n)
      logical, allocatable, private :: kept(:)
      !> Derivatives of the right-hand side at the start by y and z
      real(wp), allocatable, private :: by_y(:, :), by_z(:, :)
      !> Rate of change of the highest term by them
      real(wp), private :: rate = 0.0_wp
      !> Length up to which the series is within the tolerance
      real(wp), private :: converges = 0.0_wp
   contains
      procedure :: look_ahead
      procedure :: attempt
      procedure :: complete
      procedure :: extend
      procedure :: interpolant
      procedure :: stiffness
      procedure :: advance
   end type taylor_step_type

   interface taylor_step_type
      module procedure :: new_step
   end interface taylor_step_type

contains

   !> Storage, and the state at the first instant.
   pure function new_step(problem, tolerance) result(step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Relative or absolute tolerance, the larger
      real(wp), intent(in) :: tolerance
      type(taylor_step_type) :: step
      integer :: degree, i

      degree = max(lowest_degree, min(highest_degree, nint(degree_at_one - log10(tolerance))))
      step%name = "taylor"
      step%order = degree
      step%error_order = degree
      step%foresees = .true.
      step%evaluation_cost = cost_of_degree*degree
      associate (n => problem%n, delays => size(problem%lag))
         allocate (step%nodes(degree), source=0.0_wp)
         allocate (step%series(0:degree, n), step%delayed(0:degree, delays))
         allocate (step%y(n), step%y_new(n), step%slope(n), step%z(delays, 1), step%rise(n))
         allocate (step%by_y(n, n), step%by_z(n, delays))
      end associate
      step%kept = [(any(problem%component == i), i=1, problem%n)]
      call problem%initial(step%y)
   end function new_step

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
      real(wp) :: last(2), last_kept(2), past_serves, reached(2)
      integer :: i

      self%unit = merge(self%converges, h, self%converges > 0.0_wp)
      self%converges = 0.0_wp
      self%series(0, :) = self%y
      past_serves = h
      call past%series(problem, self%unit, self%delayed, past_serves)
      call problem%series(t, self%unit, self%order, self%delayed, self%series)
      self%evaluations = self%evaluations + 1
      if (.not. all(ieee_is_finite(self%series(self%order - 1:, :)))) return
      last = tiny(1.0_wp)
      last_kept = tiny(1.0_wp)
      do i = 1, problem%n
         reached = abs(self%series(self%order - 1:self%order, i))/(absolute + relative*abs(self%y(i)))
         last = max(last, reached)
         if (self%kept(i)) last_kept = max(last_kept, reached)
      end do
      self%converges = self%unit*within(self%order, last)
      self%serves = self%unit*within(self%order, last_kept)
      self%ideal = self%converges
      h = min(self%converges, past_serves)
   end subroutine look_ahead

   !> How far, in units of its powers, the last two terms of a series are within the tolerance.
   pure real(wp) function within(degree, last)
      !> Degree of the series
      integer, intent(in) :: degree
      !> The coefficients over the tolerance
      real(wp), intent(in) :: last(2)

      within = share*exp(-max(log(last(1))/(degree - 1), log(last(2))/degree))
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
      if (.not. self%converges > 0.0_wp) return
      do i = 1, problem%n
         call end_of_series(self%order, self%series(:, i), h/self%unit, self%y_new(i), self%rise(i))
      end do
      if (all(ieee_is_finite(self%y_new))) error = 0.0_wp
   end subroutine attempt

   !> Value of a series at s, and its derivative by s.
   pure subroutine end_of_series(degree, series, s, value, slope)
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients
      real(wp), intent(in) :: series(0:degree)
      !> Place, in units of its powers
      real(wp), intent(in) :: s
      !> Value
      real(wp), intent(out) :: value
      !> Derivative
      real(wp), intent(out) :: slope
      integer :: k

      value = series(degree)
      slope = 0.0_wp
      do k = degree - 1, 0, -1
         slope = value + s*slope
         value = series(k) + s*value
      end do
   end subroutine end_of_series

   !> The rate of change that the highest term shows: large eigenvalues rule it, however little of
   !> them is in the solution.
   pure subroutine complete(self, problem, past)
      !> The step
      class(taylor_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      real(wp) :: changed(problem%n)
      integer :: i

      call problem%jacobian(self%t, self%y, self%delayed(0, :), self%by_y, self%by_z)
      changed = 0.0_wp
      do i = 1, problem%n
         changed = changed + self%by_y(:, i)*self%series(self%order, i)
      end do
      self%rate = maxval(abs(changed))/max(tiny(1.0_wp), maxval(abs(self%series(self%order, :))))
   end subroutine complete

   !> Nothing more to evaluate.
   pure subroutine extend(self, problem, past)
      !> The step
      class(taylor_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
   end subroutine extend

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

      self%slope = self%rise/self%unit
      self%y = self%y_new
   end subroutine advance
end module dde_taylor_step
