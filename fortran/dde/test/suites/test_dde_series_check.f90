! SPDX-License-Identifier: BSD-3-Clause
!> That series of a problem which are not those of its right-hand side or history are refused, and
!> that rounding errors and jumps are not.
module test_dde_series_check
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: continuation_type, integrate, integration_options, integration_result, refused, &
                  value_not_finite
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_close, expect_failure
   use fast_problems, only: follower
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: collect_dde_series_check

   !> What is wrong with the series.
   enum, bind(c)
      enumerator :: nothing, no_unit, other_value, no_past_unit, no_past, later_term, &
         later_past_term
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

   !> A slow series that does not solve the equations.
   type, extends(follower) :: off_balance
   contains
      procedure :: slow_series => wrong_slow_series
   end type off_balance

contains

   subroutine collect_dde_series_check(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("wrong series", test_wrong), &
                   new_unittest("continued runs", test_continued), &
                   new_unittest("wrong slow series", test_slow), &
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
         call refuse(error, no_unit, methods(i), "series: the slope of component 1 is ")
         call refuse(error, no_unit, methods(i), "(wrong from about coefficient 1 on)")
         call refuse(error, later_term, methods(i), "(wrong from about coefficient 3 on)")
         call refuse(error, other_value, methods(i), "past_series: component 1 is ")
         call refuse(error, other_value, methods(i), ", history gives ")
         call refuse(error, no_past_unit, methods(i), "past_series: component 1 is ")
         call refuse(error, later_past_term, methods(i), "past_series: component 1 is ")
      end do
      call refuse(error, no_past, "taylor", "not finite", value_not_finite)
   end subroutine test_wrong

   !> A run that goes on looks again: at the series of what it stored, too.
   subroutine test_continued(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call run(error, delayed(nothing), 0.0_wp, 1.5_wp, at_tolerance(1.0e-9_wp, "taylor"), &
               outcome, continuation=continuation)
      if (allocated(error)) return
      call integrate(delayed(later_term), 1.5_wp, 3.0_wp, at_tolerance(1.0e-9_wp, "taylor"), &
                     outcome, failure, continuation=continuation)
      call expect_failure(error, failure, "series: the slope of component 1 is ")
   end subroutine test_continued

   !> A slow series that is not that of the equations is not used: the run is as that by Radau.
   subroutine test_slow(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome, reference
      type(off_balance) :: problem

      problem%follower = follower(1.0e6_wp, 0.0_wp)
      call run(error, problem, 0.0_wp, 3.0_wp, at_tolerance(1.0e-9_wp, "auto"), outcome)
      call run(error, problem, 0.0_wp, 3.0_wp, at_tolerance(1.0e-11_wp, "radau9"), reference)
      call expect_close(error, outcome%y, reference%y, 1.0e-8_wp, "a wrong slow series")
   end subroutine test_slow

   !> The series of the follower, the second component off from coefficient 2 on.
   pure subroutine wrong_slow_series(self, t, unit, degree, z, y)
      class(off_balance), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      call self%follower%slow_series(t, unit, degree, z, y)
      y(2, 2) = 1.1_wp*y(2, 2) + 1.0e-3_wp*unit**2
   end subroutine wrong_slow_series

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

   !> A jump shortly after the first delayed time, which the series does not have: the run lands on
   !> it where it is declared, and is refused where not.
   subroutine test_jumps(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(misprint) :: problem
      integer :: digits

      do digits = 1, 10
         problem = delayed(nothing)
         problem%jump_at = -1.0_wp + 10.0_wp**(-digits)
         options = at_tolerance(1.0e-9_wp, "taylor")
         options%break_at = [problem%jump_at]
         call run(error, problem, 0.0_wp, 0.5_wp, options, outcome)
      end do
      call integrate(problem, 0.0_wp, 0.5_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome, failure)
      call expect_failure(error, failure, "the same expected, or a jump in break_at")
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
   subroutine refuse(error, wrong, method, words, reason)
      type(error_type), allocatable, intent(inout) :: error
      integer, intent(in) :: wrong
      character(len=*), intent(in) :: method, words
      !> `refused` if not given
      integer, intent(in), optional :: reason
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(delayed(wrong), 0.0_wp, 3.0_wp, at_tolerance(1.0e-9_wp, method), outcome, &
                     failure)
      call expect_failure(error, failure, words)
      if (present(reason)) then
         call expect(error, outcome%reason == reason, "the reason")
      else
         call expect(error, outcome%reason == refused, "the reason is `refused`")
      end if
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
      if (t >= self%jump_at) y(0) = y(0) + 1.0_wp
      if (self%wrong == later_past_term) y(2) = 1.1_wp*y(2)
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
         if (self%wrong == later_term .and. k == 2) y(3, 1) = 1.1_wp*y(3, 1)
      end do
   end subroutine series_of_relaxation
end module test_dde_series_check
