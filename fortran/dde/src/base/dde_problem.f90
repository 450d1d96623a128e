! SPDX-License-Identifier: BSD-3-Clause
!> What a user of the solver writes: an initial value problem with constant delays,
!>
!>     dy/dt = f(t, y(t), z),   z(k) = y_c(k)(t - lag(k)),   y(t0) given,   y_c(t) given for t < t0.
!>
!> Extend `dde_problem_type`, fill `n`, `lag` and `component`, and write the three deferred
!> procedures. Without delays `lag` and `component` have size zero or are not allocated, and no past
!> is kept. Delays may depend on t and y(t), by `moving_lags`, with their number in `moving`.
!>
!> Optional are - for implicit methods: `jacobian`, `lower` and `upper` of a banded one, and `rows`
!> of delayed values, - for the method `taylor`: `series` and `past_series`, with `analytic` true, -
!> for long Taylor steps where fast components are in balance: `relaxation_rate` and `slow_series`,
!> - where f saturates: `exponents`, with their number in `exponentials`, - where f is not smooth:
!> `switching` and `take_sides`, with the number of switching functions in `switches`, - where the
!> state changes at zeros of such functions: `act`, with the number of these in `acting`.
module dde_problem
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_errors, only: text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: dde_problem_type, not_given, problem_with_tangents

   !> Value in a Jacobian that is not given.
   real(wp), parameter :: not_given = -huge(1.0_wp)

   !> A system of delay differential equations; its parameters are components of the extension.
   type, abstract :: dde_problem_type
      !> Number of equations
      integer :: n = 0
      !> Delay of each delayed value z(k), > 0; the longest that a delay becomes that moves, huge if
      !> no bound is known: all of the past is then kept
      real(wp), allocatable :: lag(:)
      !> Number of the component of y that each delayed value z(k) is, 1..n
      integer, allocatable :: component(:)
      !> Number of delays that depend on time or state: those of the last delayed values
      integer :: moving = 0
      !> Diagonals of a banded Jacobian by y below and above the main one
      integer :: lower = -1, upper = -1
      !> First and last equation that contains each delayed value, shape (2, size(lag)); all
      !> equations unless they are given. A banded Jacobian needs them.
      integer, allocatable :: rows(:, :)
      !> Number of components, from the first, whose series are compared with f and at each past
      !> step. Others follow them, as small disturbances do: a transient of no account in their past
      !> is then passed over
      integer :: checked_components = huge(0)
      !> Number of exponential terms of f whose `exponents` the extension gives
      integer :: exponentials = 0
      !> Whether exponents depend on delayed values
      logical :: delayed_exponents = .true.
      !> Number of switching functions: f is smooth while none of them passes zero
      integer :: switches = 0
      !> Number of these, the last, at whose zeros the state may change
      integer :: acting = 0
      !> Whether the extension gives `series` and `past_series`
      logical :: analytic = .false.
   contains
      !> y at the initial time; may differ from the history there (a jump)
      procedure(initial_state), deferred :: initial
      !> One component before the initial time
      procedure(past_value), deferred :: history
      !> Delays that depend on time or state
      procedure :: moving_lags => no_moving_lags
      !> The shortest constant delay
      procedure, non_overridable :: shortest_lag
      !> Right-hand side f(t, y, z)
      procedure(right_hand_side), deferred :: rhs
      !> Derivatives of f by y and z; by differences unless the extension gives them
      procedure :: jacobian => no_jacobian
      !> Exponents of the exponential terms of f
      procedure :: exponents => no_exponents
      !> Switching functions of f
      procedure :: switching => no_switching
      !> Go to other sides of the switching functions
      procedure :: take_sides => no_sides
      !> Change the state where a switching function passes zero
      procedure :: act => no_act
      !> What messages call a value of the problem
      procedure :: name_of => numbered
      !> Taylor series of the solution
      procedure :: series => no_series
      !> Taylor series of one component before the initial time
      procedure :: past_series => no_past_series
      !> Rate at which the fast components approach a balance with the others
      procedure :: relaxation_rate => no_relaxation
      !> Taylor series of the solution on which they are in balance
      procedure :: slow_series => no_slow_series
   end type dde_problem_type

   abstract interface
      !> State at the initial time.
      pure subroutine initial_state(self, y)
         import :: dde_problem_type, wp
         implicit none (type, external)
         class(dde_problem_type), intent(in) :: self
         !> y(t0), shape (n)
         real(wp), intent(out) :: y(self%n)
      end subroutine initial_state

      !> Component `component` of y at time t <= t0 (t0 itself: the limit from the left).
      pure function past_value(self, t, component) result(value)
         import :: dde_problem_type, wp
         implicit none (type, external)
         class(dde_problem_type), intent(in) :: self
         !> Time
         real(wp), intent(in) :: t
         !> Index into y, one of self%component
         integer, intent(in) :: component
         real(wp) :: value
      end function past_value

      !> Right-hand side; a value that is not finite makes the solver take a smaller step.
      pure subroutine right_hand_side(self, t, y, z, dydt)
         import :: dde_problem_type, wp
         implicit none (type, external)
         class(dde_problem_type), intent(in) :: self
         !> Time
         real(wp), intent(in) :: t
         !> State, shape (n)
         real(wp), intent(in) :: y(self%n)
         !> Delayed values z(k) = y_component(k)(t - lag(k)), shape (size(lag))
         real(wp), intent(in) :: z(size(self%lag))
         !> dy/dt, shape (n)
         real(wp), intent(out) :: dydt(self%n)
      end subroutine right_hand_side
   end interface

   !> A problem that gives Taylor series of small disturbances of its solution. The solver does not
   !> call them: they are for methods that combine a problem and its disturbances into one problem,
   !> for instance for Lyapunov exponents.
   type, abstract, extends(dde_problem_type) :: problem_with_tangents
      !> Whether the extension gives `tangent_series`, and `slow_tangent_series` with `slow_series`
      logical :: analytic_tangents = .false.
   contains
      !> Taylor series of small disturbances of the solution
      procedure :: tangent_series => no_tangent_series
      !> Taylor series of small disturbances of the solution of `slow_series`
      procedure :: slow_tangent_series => no_slow_tangent_series
   end type problem_with_tangents

contains

   !> Delays of the last delayed values, which depend on time or state. Not a number unless the
   !> extension gives them.
   pure subroutine no_moving_lags(self, t, y, lag)
      class(dde_problem_type), intent(in) :: self
      !> Time, and state there, shape (n)
      real(wp), intent(in) :: t, y(self%n)
      !> The delays, >= 0 and at most those of `lag`, shape (moving)
      real(wp), intent(out) :: lag(self%moving)

      lag = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_moving_lags

   !> The shortest constant delay; huge if there is none.
   pure real(wp) function shortest_lag(self) result(shortest)
      class(dde_problem_type), intent(in) :: self

      shortest = minval(self%lag(:size(self%lag) - self%moving))
   end function shortest_lag

   !> Derivatives of the right-hand side by y and z: `not_given` unless the extension gives them.
   pure subroutine no_jacobian(self, t, y, z, by_y, by_z)
      class(dde_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      !> Delayed values, shape (size(lag))
      real(wp), intent(in) :: z(size(self%lag))
      !> Derivatives by y: element (i, j) at (i, j), shape (n, n), or at (1 + upper + i - j, j)
      !> where it is banded, shape (1 + lower + upper, n). All elements are set.
      real(wp), contiguous, intent(out) :: by_y(:, :)
      !> Derivatives by z: those of equation i at (i, k), shape (n, size(lag)), or at
      !> (1 + i - rows(1, k), k), shape (most rows, size(lag)). All elements are set.
      real(wp), contiguous, intent(out) :: by_z(:, :)

      by_y = not_given
      by_z = not_given
   end subroutine no_jacobian

   !> Exponents a of the terms of f that change as exp(a) or exp(-a): 2 u of tanh(u), n log|x| of
   !> x**n. Where |a| is large a term vanishes, or saturates what holds it, in the rounding of
   !> others, and no estimate of an error shows when a comes back. A step over which an exponent
   !> near 0 changes by much is therefore rejected. None unless the extension gives them.
   pure subroutine no_exponents(self, t, y, z, values)
      class(dde_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      !> Delayed values, shape (size(lag))
      real(wp), intent(in) :: z(size(self%lag))
      !> The exponents, shape (exponentials); one that is not finite is ignored
      real(wp), intent(out) :: values(self%exponentials)

      values = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_exponents

   !> Switching functions g of f, which is another smooth function on each side of g = 0: x of |x|.
   !> f, its derivatives and series are those of the sides that `take_sides` was given last, also
   !> beyond g = 0. None unless the extension gives them.
   pure subroutine no_switching(self, t, y, z, values)
      class(dde_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      !> Delayed values, shape (size(lag))
      real(wp), intent(in) :: z(size(self%lag))
      !> The functions, shape (switches); one that is not finite is ignored
      real(wp), intent(out) :: values(self%switches)

      values = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_switching

   !> Take other sides of the switching functions. Nothing to take unless the extension has some.
   pure subroutine no_sides(self, above)
      class(dde_problem_type), intent(inout) :: self
      !> Whether f is that where each function is > 0, shape (switches)
      logical, intent(in) :: above(:)
   end subroutine no_sides

   !> Change the state where a switching function passes zero: a reset, a bounce. The solution jumps
   !> there. Nothing changes unless the extension says so.
   pure subroutine no_act(self, number, rises, t, z, y, acts)
      class(dde_problem_type), intent(in) :: self
      !> Which of the last `acting` functions, and whether it rises through zero or falls
      integer, intent(in) :: number
      logical, intent(in) :: rises
      !> Time, and delayed values there
      real(wp), intent(in) :: t, z(size(self%lag))
      !> State before, then after it. Of functions that pass zero at one time the first acts first.
      real(wp), intent(inout) :: y(self%n)
      !> Whether the state changes where the function passes in this direction
      logical, intent(out) :: acts

      acts = .false.
   end subroutine no_act

   !> What messages call a value: its kind and number, unless the extension names it.
   function numbered(self, kind, number) result(name)
      class(dde_problem_type), intent(in) :: self
      !> y, a component; f, its slope; lag, a delay; or switching, a switching function
      character(len=*), intent(in) :: kind
      integer, intent(in) :: number
      character(len=:), allocatable :: name

      name = kind//"("//text(number)//")"
   end function numbered

   !> Taylor series of the solution in powers of s = (t' - t)/unit: since dy/ds = unit f,
   !> coefficient k + 1 of y is unit/(k + 1) times coefficient k of f. Not a number unless the
   !> extension gives it.
   pure subroutine no_series(self, t, unit, degree, z, y)
      class(dde_problem_type), intent(in) :: self
      real(wp), intent(in) :: t
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients of the delayed values
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of the solution; y(0, :) is given, the state at t
      real(wp), intent(inout) :: y(0:degree, self%n)

      y(1:, :) = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_series

   !> Taylor series of one component, as it was before the initial time, in powers of
   !> (t' - t)/unit. Not a number unless the extension gives it.
   pure subroutine no_past_series(self, t, component, unit, y)
      class(dde_problem_type), intent(in) :: self
      !> Time, at which the series begins
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), intent(in) :: unit
      !> Coefficients, shape (0:degree)
      real(wp), intent(out) :: y(0:)

      y = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_past_series

   !> Rate at which fast components approach a balance with the others from any start:
   !> y_c' = rate (balance - y_c) near it. 0 unless the extension gives it.
   pure function no_relaxation(self, t, y) result(rate)
      class(dde_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      !> The rate, in units of one over time
      real(wp) :: rate

      rate = 0.0_wp
   end function no_relaxation

   !> A better series of the slow solution, by one step of the iteration of Fraser (1988, "The
   !> steady state and equilibrium approximations: A geometrical picture", J. Chem. Phys. 88, 4732):
   !> fast components (also their values at t) are the balance minus y_c'/rate with the last y_c'.
   !> The others follow as in `series`. Not a number unless the extension gives it.
   pure subroutine no_slow_series(self, t, unit, degree, z, y)
      class(dde_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of the last iteration (at first the state at t and zeros), then better ones
      real(wp), intent(inout) :: y(0:degree, self%n)

      y = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_slow_series

   !> Taylor series of disturbances of the solution: the derivative of `series`. Not a number unless
   !> the extension gives it.
   pure subroutine no_tangent_series(self, t, unit, degree, z, y, vectors, dz, dy)
      class(problem_with_tangents), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      !> Coefficients of the delayed values and of the solution, all known
      real(wp), intent(in) :: z(0:degree, size(self%lag)), y(0:degree, self%n)
      !> Number of disturbances
      integer, intent(in) :: vectors
      !> Coefficients of the disturbances of the delayed values
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      !> Coefficients of the disturbances; dy(0, :, :) is given
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      dy(1:, :, :) = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_tangent_series

   !> A better series of disturbances of the slow solution: the derivative of one iteration of
   !> `slow_series`. Not a number unless the extension gives it.
   pure subroutine no_slow_tangent_series(self, t, unit, degree, z, before, y, vectors, dz, dy)
      class(problem_with_tangents), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of the solution before the iteration of `slow_series`, and after it
      real(wp), intent(in) :: before(0:degree, self%n), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      !> Coefficients of the disturbances before the iteration, then after it
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      dy = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_slow_tangent_series
end module dde_problem
