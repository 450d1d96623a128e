! SPDX-License-Identifier: BSD-3-Clause
!> Steps by Taylor series: their length, slow series and transients, pasts of other methods; and
!> that series of a problem which are not those of its right-hand side or history are refused, but
!> rounding errors and jumps are not.
module test_dde_taylor
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use chain_of_blocks, only: chain
   use dde, only: continuation_type, integrate, integration_options, integration_result, refused, &
                  value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use dde_slow_series, only: series_reach
   use dde_taylor_step, only: taylor_step_type
   use expectations, only: expect, expect_close, expect_failure
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use single_step, only: take_taylor_step
   use solving, only: at_tolerance, run, solve
   use stiff_problems, only: follower
   use test_problems, only: constant_past, fill, sine
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_taylor

   !> What is wrong with the series of `misprint`.
   enum, bind(c)
      enumerator :: nothing, no_unit, other_value, no_past_unit, no_past, later_term, &
         later_past_term
   end enum

   !> The method itself, and the one that begins with it.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "]

contains

   subroutine collect_dde_taylor(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("how far series reach", test_reach), &
                   new_unittest("steps that are held back", test_held_back), &
                   new_unittest("the past of other methods", test_pasts), &
                   new_unittest("a transient", test_transient), &
                   new_unittest("chains", test_chains), &
                   new_unittest("wrong series", test_wrong), &
                   new_unittest("wrong slow series", test_slow), &
                   new_unittest("rounding errors and jumps", test_jumps)]
   end subroutine collect_dde_taylor

   !> Very small terms that grow do not reach as far as the tolerance would let them: exp(4 s) - 1
   !> in units of 1e-30, whose terms grow up to s = 2. One that vanishes, or all, are no limit.
   subroutine test_reach(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: reach, series(0:8, 1)
      integer :: k

      series(:, 1) = [(1.0e-30_wp*4.0_wp**k/gamma(k + 1.0_wp), k=0, 8)]
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect_close(error, reach, 0.9_wp*2.0_wp, 1.0e-14_wp, "eight over four")
      series(7, 1) = 0.0_wp
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect_close(error, reach, 0.9_wp*sqrt(7*8/16.0_wp), 1.0e-14_wp, "a term vanishes")
      series(:, 1) = 1.0_wp
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect_close(error, reach, 0.9_wp*1.0e-6_wp**(1.0_wp/7), 1.0e-14_wp, "all terms 1")
      series(1:, 1) = 0.0_wp
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect(error, reach > 1.0e14_wp, "a constant")
   end subroutine test_reach

   !> The step that the tolerance allows is not held back, a hundredth of it is.
   subroutine test_held_back(error)
      type(error_type), allocatable, intent(out) :: error
      type(taylor_step_type) :: step
      real(wp) :: estimate
      integer :: digits

      do digits = 3, 13, 2
         call take_taylor_step(swing(), 10.0_wp**(-digits), 1.0_wp, step, estimate, .true.)
         call expect(error, .not. step%stiff(), "free at 1e-"//text(digits))
         call take_taylor_step(swing(), 10.0_wp**(-digits), 0.01_wp, step, estimate, .true.)
         call expect(error, step%stiff(), "held back at 1e-"//text(digits))
      end do
   end subroutine test_held_back

   !> y = sin t by one method after the other, each on the past that the one before has left.
   subroutine test_pasts(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(integration_result) :: outcome
      character(len=8), parameter :: methods(6) = ["explicit", "taylor  ", "radau9  ", "taylor  ", &
                                                   "explicit", "taylor  "]
      integer :: i

      do i = 1, size(methods)
         call run(error, sine(), continuation%time(1), 2.3_wp*i, &
                  at_tolerance(1.0e-11_wp, methods(i)), outcome, continuation=continuation)
         if (allocated(error)) return
         call expect_close(error, outcome%y, [sin(2.3_wp*i)], 1.0e-9_wp, &
                           methods(i)//" in run "//text(i))
         call expect_close(error, continuation%slope, [cos(2.3_wp*i)], 1.0e-8_wp, &
                           "slope after "//methods(i))
      end do
   end subroutine test_pasts

   !> A transient towards the balance is followed as long as it is seen; one delay later it changes
   !> y2 by 1/rate, which is followed where it counts.
   subroutine test_transient(error)
      type(error_type), allocatable, intent(out) :: error
      type(follower) :: problem
      real(wp), allocatable :: y(:, :)
      real(wp) :: exact(2, 7), times(7)
      integer :: i, j

      do j = 3, 9, 2
         problem = follower(10.0_wp**j, start=2.0_wp)
         times = [[1.0_wp, 3.0_wp, 10.0_wp, 30.0_wp]*10.0_wp**(-j), 1.001_wp, 1.1_wp, 1.5_wp]
         do i = 1, size(times)
            call problem%exact(problem%p, times(i), exact(:, i))
         end do
         do i = 1, size(both)
            call solve(problem, times, at_tolerance(1.0e-10_wp, both(i)), y, error)
            if (allocated(error)) return
            call expect_close(error, y(1, :4), exact(1, :4), 1.0e-8_wp, both(i)//" at once")
            call expect_close(error, y(2, 5:), exact(2, 5:), 1.0e-9_wp, &
                              both(i)//" at rate 1e"//text(j))
         end do
      end do
   end subroutine test_transient

   !> 50 delays that differ by 1 %: the explicit method confirms the solution, and takes more steps.
   !> Without delayed values over several steps of the past series take five times as many. Blocks
   !> almost without mass: slow series in few steps, and the implicit method.
   subroutine test_chains(error)
      type(error_type), allocatable, intent(out) :: error

      call compare(chain(50, spread=0.01_wp), 100.0_wp, 1.0e-10_wp, "dop853", 1.0e-6_wp)
      call compare(chain(50, spread=0.01_wp), 100.0_wp, 1.0e-10_wp, "dop853", 1.0e-9_wp)
      call compare(chain(7, gamma=1.0e8_wp), 30.0_wp, 1.0e-11_wp, "radau13", 1.0e-8_wp, most=100)

   contains

      !> By series at a tolerance as by another method at a tighter one, in fewer steps.
      subroutine compare(problem, t_end, tight, method, tolerance, most)
         type(chain), intent(in) :: problem
         real(wp), intent(in) :: t_end, tight, tolerance
         character(len=*), intent(in) :: method
         !> Number of steps, that of the other method if not given
         integer, intent(in), optional :: most
         type(chain) :: analytic
         type(integration_result) :: known, outcome

         analytic = problem
         analytic%analytic = .true.
         call run(error, problem, 0.0_wp, t_end, at_tolerance(tight, method), known)
         call run(error, analytic, 0.0_wp, t_end, at_tolerance(tolerance, "taylor"), outcome)
         call expect_close(error, outcome%y, known%y, 10*tolerance, "beside "//method)
         if (present(most)) known%accepted = most
         call expect(error, outcome%accepted < known%accepted, "steps: "//text(outcome%accepted))
      end subroutine compare
   end subroutine test_chains

   !> The message names the series, the component, the time and both values. A method that does not
   !> read series does not refuse them. A run that goes on looks again: at the series of what it
   !> stored, too.
   subroutine test_wrong(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: of_solution = "series: the slope of component 1 is "
      type(continuation_type) :: good
      type(integration_result) :: outcome
      integer :: i

      call run(error, misprint(nothing), 0.0_wp, 1.5_wp, at_tolerance(1.0e-9_wp, "taylor"), &
               outcome, continuation=good)
      call run(error, misprint(no_unit), 0.0_wp, 3.0_wp, at_tolerance(1.0e-9_wp, "radau9"), outcome)
      do i = 1, size(both)
         call refuse(no_unit, both(i), of_solution)
         call refuse(no_unit, both(i), "(wrong from about coefficient 1 on)")
         call refuse(later_term, both(i), "(wrong from about coefficient 3 on)")
         call refuse(other_value, both(i), "past_series: component 1 is ")
         call refuse(other_value, both(i), ", history gives ")
         call refuse(no_past_unit, both(i), "past_series: component 1 is ")
         call refuse(later_past_term, both(i), "past_series: component 1 is ")
      end do
      call refuse(no_past, "taylor", "not finite", reason=value_not_finite)
      call refuse(later_term, "taylor", of_solution, good)

   contains

      subroutine refuse(wrong, method, words, continuation, reason)
         integer, intent(in) :: wrong
         character(len=*), intent(in) :: method, words
         type(continuation_type), intent(inout), optional :: continuation
         !> `refused` if not given
         integer, intent(in), optional :: reason
         type(failure_type), allocatable :: failure
         real(wp) :: t_start
         integer :: known

         t_start = 0.0_wp
         if (present(continuation)) t_start = continuation%time(1)
         known = refused
         if (present(reason)) known = reason
         call integrate(misprint(wrong), t_start, 3.0_wp, at_tolerance(1.0e-9_wp, method), &
                        outcome, failure, continuation=continuation)
         call expect_failure(error, failure, words)
         call expect(error, outcome%reason == known, "the reason")
      end subroutine refuse
   end subroutine test_wrong

   !> A slow series that is not that of the equations is not used: the run is as that by Radau.
   subroutine test_slow(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome, reference

      call run(error, follower(1.0e6_wp, 0.0_wp, wrong_by=1.0e-3_wp), 0.0_wp, 3.0_wp, &
               at_tolerance(1.0e-9_wp, "auto"), outcome)
      call run(error, follower(1.0e6_wp, 0.0_wp), 0.0_wp, 3.0_wp, &
               at_tolerance(1.0e-11_wp, "radau9"), reference)
      call expect_close(error, outcome%y, reference%y, 1.0e-8_wp, "a wrong slow series")
   end subroutine test_slow

   !> With rate 1e12 the right-hand side of 0.3 and 0.1 + 0.2 is a rounding error: the series has
   !> another one. A jump shortly after the first delayed time, which the series does not have: the
   !> run lands on it where it is declared, and is refused where not.
   subroutine test_jumps(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(constant_past) :: problem
      real(wp) :: tenth
      integer :: digits

      problem = misprint(nothing)
      tenth = 0.1_wp
      problem%first = [0.3_wp]
      problem%p(:3) = [1.0e12_wp, tenth + 0.2_wp, 0.0_wp]
      call run(error, problem, 0.0_wp, 0.5_wp, at_tolerance(1.0e-9_wp, "auto"), outcome)
      problem = misprint(nothing)
      options = at_tolerance(1.0e-9_wp, "taylor")
      do digits = 1, 10
         problem%p(4) = -1.0_wp + 10.0_wp**(-digits)
         options%break_at = [problem%p(4)]
         call run(error, problem, 0.0_wp, 0.5_wp, options, outcome)
      end do
      call integrate(problem, 0.0_wp, 0.5_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome, failure)
      call expect_failure(error, failure, "the same expected, or a jump in break_at")
   end subroutine test_jumps

   !> y' = -rate (y - z) with delay 1, from y = 2, z = 3; y = past exp(growth t) for t < 0, and 1
   !> more from a time on. Parameters: rate, past, growth, time of the jump, and what is wrong.
   type(constant_past) function misprint(wrong) result(problem)
      integer, intent(in) :: wrong

      call fill(problem, 1, first=[2.0_wp], lag=[1.0_wp], component=[1], &
                p=[1.0_wp, 3.0_wp*exp(1.0_wp), 1.0_wp, huge(1.0_wp), real(wrong, wp)])
      problem%f => relax
      problem%terms => series_of_relaxation
      problem%exact => exponential
      problem%past_terms => series_of_exponential
      problem%analytic = .true.
   end function misprint

   pure subroutine exponential(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = p(2)*exp(p(3)*t) + merge(1.0_wp, 0.0_wp, t >= p(4))
   end subroutine exponential

   pure subroutine series_of_exponential(p, t, unit, y)
      real(wp), intent(in) :: p(:), t, unit
      real(wp), intent(out) :: y(0:)
      integer :: k

      y(0) = p(2)*exp(p(3)*t)
      if (nint(p(5)) == other_value) y(0) = 2*y(0)
      if (nint(p(5)) == no_past) y(0) = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 1, ubound(y, 1)
         y(k) = merge(1.0_wp, unit, nint(p(5)) == no_past_unit)*p(3)/k*y(k - 1)
      end do
      if (t >= p(4)) y(0) = y(0) + 1.0_wp
      if (nint(p(5)) == later_past_term) y(2) = 1.1_wp*y(2)
   end subroutine series_of_exponential

   pure subroutine relax(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = -p(1)*(y - z)
   end subroutine relax

   pure subroutine series_of_relaxation(p, t, unit, z, y)
      real(wp), intent(in) :: p(:), t, unit, z(0:, :)
      real(wp), intent(inout) :: y(0:, :)
      integer :: k

      do k = 0, ubound(y, 1) - 1
         y(k + 1, 1) = merge(1.0_wp, unit, nint(p(5)) == no_unit)/(k + 1) &
                       *(p(1)*z(k, 1) - p(1)*y(k, 1))
         if (nint(p(5)) == later_term .and. k == 2) y(3, 1) = 1.1_wp*y(3, 1)
      end do
   end subroutine series_of_relaxation
end module test_dde_taylor
