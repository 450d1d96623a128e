!> That series of a problem which are not those of its right-hand side or history are refused, and
!> that rounding errors and jumps are not.
module test_dde_series_check
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: integrate, integration_result, refused
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_failure
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: collect_dde_series_check

   !> What is wrong with the series.
   enum, bind(c)
      enumerator :: nothing, no_unit, other_value, no_past_unit, no_past
   end enum

   !> y' = -rate (y - z), y = past exp(growth t) for t < 0, and 1 more from a time on.
   type, extends(constant_past) :: misprint
      real(wp) :: growth = 0.0_wp, jump_at = huge(1.0_wp)
      integer :: wrong = nothing
   contains
      procedure :: history => exponential
      procedure :: rhs => relaxation
      procedure :: series => series_of_relaxation
      procedure :: past_series => series_of_exponential
   end type misprint

contains

   subroutine collect_dde_series_check(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("wrong series", test_wrong), &
                   new_unittest("rounding errors", test_rounding), &
                   new_unittest("jumps of the history", test_jumps)]
   end subroutine collect_dde_series_check

   !> The message names the series, the component, the time and both values. A method that does not
   !> read series does not refuse them.
   subroutine test_wrong(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: methods(2) = [character(len=6) :: "taylor", "auto"]
      type(integration_result) :: outcome
      integer :: i

      call run(error, delayed(nothing), 0.0_wp, 3.0_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome)
      call run(error, delayed(no_unit), 0.0_wp, 3.0_wp, at_tolerance(1.0e-9_wp, "radau9"), outcome)
      do i = 1, size(methods)
         call refuse(error, no_unit, methods(i), "series: coefficient 1 of component 1 over unit")
         call refuse(error, no_unit, methods(i), "at t = 0.0, rhs gives 1.0; the same expected")
         call refuse(error, other_value, methods(i), "past_series: component 1 from t = -1.0 on " &
                     //"is 6.0 at t = -1.0, history gives 3.0; the same expected")
         call refuse(error, no_past_unit, methods(i), "past_series: component 1 from t = -1.0 on")
         call refuse(error, no_past, methods(i), "is NaN at t = -1.0, history gives 3.0")
      end do
   end subroutine test_wrong

   !> With rate 1e12 the right-hand side of 0.3 and 0.1 + 0.2 is a rounding error: the series has
   !> another one.
   subroutine test_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(misprint) :: problem

      problem = delayed(nothing)
      problem%growth = 0.0_wp
      problem%past = [0.1_wp]
      problem%past = problem%past + 0.2_wp
      problem%first = [0.3_wp]
      problem%rate = 1.0e12_wp
      call run(error, problem, 0.0_wp, 0.5_wp, at_tolerance(1.0e-9_wp, "auto"), outcome)
   end subroutine test_rounding

   !> A jump shortly after the first delayed time, which the series does not have.
   subroutine test_jumps(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(misprint) :: problem
      integer :: digits

      do digits = 1, 10
         problem = delayed(nothing)
         problem%jump_at = -1.0_wp + 10.0_wp**(-digits)
         call run(error, problem, 0.0_wp, 0.5_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome)
      end do
   end subroutine test_jumps

   !> The problem with delay 1, from y = 2, z = 3, which grows.
   pure type(misprint) function delayed(wrong) result(problem)
      integer, intent(in) :: wrong

      call fill(problem, 1, [3.0_wp*exp(1.0_wp)], [2.0_wp], [1.0_wp], [1])
      problem%analytic = .true.
      problem%growth = 1.0_wp
      problem%wrong = wrong
   end function delayed

   !> A run is refused in these words.
   subroutine refuse(error, wrong, method, words)
      type(error_type), allocatable, intent(inout) :: error
      integer, intent(in) :: wrong
      character(len=*), intent(in) :: method, words
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(delayed(wrong), 0.0_wp, 3.0_wp, at_tolerance(1.0e-9_wp, method), outcome, &
                     failure)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
   end subroutine refuse

   pure function exponential(self, t, component) result(value)
      class(misprint), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component)*exp(self%growth*t) + merge(1.0_wp, 0.0_wp, t >= self%jump_at)
   end function exponential

   pure subroutine series_of_exponential(self, t, component, unit, y)
      class(misprint), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: component
      real(wp), intent(out) :: y(0:)
      integer :: k

      y(0) = self%past(component)*exp(self%growth*t)
      if (self%wrong == other_value) y(0) = 2*y(0)
      if (self%wrong == no_past) y(0) = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 1, ubound(y, 1)
         y(k) = merge(1.0_wp, unit, self%wrong == no_past_unit)*self%growth/k*y(k - 1)
      end do
   end subroutine series_of_exponential

   pure subroutine relaxation(self, t, y, z, dydt)
      class(misprint), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -self%rate*(y - z)
   end subroutine relaxation

   pure subroutine series_of_relaxation(self, t, unit, degree, z, y)
      class(misprint), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, 1) = merge(1.0_wp, unit, self%wrong == no_unit)/(k + 1) &
                       *(self%rate*z(k, 1) - self%rate*y(k, 1))
      end do
   end subroutine series_of_relaxation
end module test_dde_series_check
