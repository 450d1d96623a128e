! SPDX-License-Identifier: BSD-3-Clause
!> Steps by Taylor series: order and length, slow series and the balance they keep, pasts of other
!> methods.
module test_dde_taylor
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use chain_of_blocks, only: chain
   use dde, only: continuation_type, integration_result
   use dde_errors, only: text
   use dde_problem, only: dde_problem_type
   use dde_slow_series, only: series_reach
   use dde_step_context, only: step_context
   use dde_taylor_series, only: taylor_series
   use dde_taylor_step, only: taylor_step_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close
   use fast_problems, only: follower
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: mackey_glass
   use single_step, only: interpolated, new_context
   use solving, only: at_tolerance, run, solve
   use test_problems, only: sine
   use undelayed_problems, only: blow_up, undelayed
   implicit none (type, external)
   private
   public :: collect_dde_taylor

   !> The method itself, and the one that begins with it.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "]

contains

   subroutine collect_dde_taylor(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("order", test_order), &
                   new_unittest("slope", test_slope), &
                   new_unittest("the past of other methods", test_pasts), &
                   new_unittest("how far series reach", test_reach), &
                   new_unittest("a follower", test_follower), &
                   new_unittest("a transient", test_transient), &
                   new_unittest("the choice of auto", test_choice), &
                   new_unittest("chains", test_chains)]
   end subroutine collect_dde_taylor

   !> `auto` takes series where delays are few, and where they are many below 1e-5.
   subroutine test_choice(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_method(chain(1), 1.0e-2_wp, "taylor")
      call expect_method(mackey_glass(), 1.0e-5_wp, "bs5")
      call expect_method(mackey_glass(), 1.0e-6_wp, "taylor")

   contains

      !> As many steps and evaluations as by the method.
      subroutine expect_method(problem, tolerance, method)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: tolerance
         character(len=*), intent(in) :: method
         class(dde_problem_type), allocatable :: analytic
         type(integration_result) :: known, outcome

         allocate (analytic, source=problem)
         analytic%analytic = .true.
         call run(error, analytic, 0.0_wp, 50.0_wp, at_tolerance(tolerance, method), known)
         call run(error, analytic, 0.0_wp, 50.0_wp, at_tolerance(tolerance, "auto"), outcome)
         if (allocated(error)) return
         call expect(error, outcome%accepted == known%accepted &
                     .and. outcome%evaluations == known%evaluations, method)
      end subroutine expect_method
   end subroutine test_choice

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
         if (allocated(error)) return
         call expect_close(error, outcome%y, known%y, 10*tolerance, "beside "//method)
         if (present(most)) known%accepted = most
         call expect(error, outcome%accepted < known%accepted, "steps: "//text(outcome%accepted))
      end subroutine compare
   end subroutine test_chains

   !> y' = y^2, y(0) = 1 has the series 1 + t + t^2 + ...: all places of a step show its first
   !> terms, so that the error falls with the power degree + 1 of the step.
   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      type(taylor_step_type) :: step
      real(wp), parameter :: h = 0.25_wp
      integer :: degree, k, place

      do degree = 6, 20
         call take_step(10.0_wp**(7 - degree), h, step)
         call expect_close(error, real(step%constants%order, wp), real(degree, wp), 0.0_wp, &
                           "degree")
         call expect_close(error, step%y_new, [sum([(h**k, k=0, degree)])], 1.0e-15_wp, "end")
         do place = 0, 4
            associate (s => 0.25_wp*place)
               call expect_close(error, interpolated(step, s), [sum([((s*h)**k, k=0, degree)])], &
                                 1.0e-15_wp, "place "//text(s)//" at degree "//text(degree))
            end associate
         end do
      end do
   end subroutine test_order

   !> 1 + 3 s - 2 s^2 in powers of half a unit of time; what later terms are does not matter at 0.
   subroutine test_slope(error)
      type(error_type), allocatable, intent(out) :: error
      type(taylor_series) :: series

      series%degree = 3
      series%unit = 0.5_wp
      allocate (series%coefficients(0:3, 1))
      series%coefficients(:, 1) = [1.0_wp, 3.0_wp, -2.0_wp, 0.0_wp]
      call expect_close(error, [series%slope_of(1, 0.0_wp)], [6.0_wp], 1.0e-15_wp, "at the start")
      call expect_close(error, [series%slope_of(1, 0.25_wp)], [2.0_wp], 1.0e-15_wp, "in the middle")
      series%coefficients(3, 1) = ieee_value(1.0_wp, ieee_quiet_nan)
      call expect_close(error, [series%slope_of(1, 0.0_wp)], [6.0_wp], 1.0e-15_wp, &
                        "where one is no number")
   end subroutine test_slope

   !> One step of y' = y^2 from y(0) = 1.
   subroutine take_step(tolerance, h, step)
      real(wp), intent(in) :: tolerance, h
      type(taylor_step_type), intent(out) :: step
      type(undelayed), target :: problem
      type(step_context) :: context
      real(wp) :: estimate, lacking, length

      problem = blow_up()
      call step%set_up(problem, tolerance, lacking)
      context = new_context(problem, 0.0_wp, 1.0_wp, 0.0_wp, tolerance)
      length = 0.5_wp*h
      call step%propose(context, length)
      context%cursor%h = h
      call step%attempt(context, estimate)
   end subroutine take_step

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
         call expect_close(error, outcome%y, [sin(2.3_wp*i)], 1.0e-9_wp, &
                           methods(i)//" in run "//text(i))
         call expect_close(error, continuation%slope, [cos(2.3_wp*i)], 1.0e-8_wp, &
                           "slope after "//methods(i))
      end do
   end subroutine test_pasts

   !> Very small terms that grow do not reach as far as the tolerance would let them; one that
   !> vanishes, or all, are no limit.
   subroutine test_reach(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: reach, series(0:8, 1)
      integer :: k

      ! exp(4 s) - 1 in units of 1e-30: terms grow up to s = 2 and beyond fall
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

   !> The exact solution within ten tolerances, whatever the rate, in few steps.
   subroutine test_follower(error)
      type(error_type), allocatable, intent(out) :: error
      type(follower) :: problem
      type(integration_result) :: outcome
      real(wp), parameter :: rate(5) = [1.0e2_wp, 1.0e4_wp, 1.0e6_wp, 1.0e9_wp, 1.0e12_wp]
      integer :: i, j, k

      do i = 1, size(rate)
         problem = follower(rate(i), start=2.0_wp)
         do j = 4, 12, 2
            do k = 1, 2
               call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(10.0_wp**(-j), both(k)), &
                        outcome)
               call expect_close(error, outcome%y, problem%exact(20.0_wp), 10*10.0_wp**(-j), &
                                 trim(both(k))//" at rate "//text(rate(i))//", 1e-"//text(j))
               call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 400.0_wp, &
                                   "steps at rate "//text(rate(i))//", 1e-"//text(j))
            end do
         end do
      end do
   end subroutine test_follower

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
         times = [[1.0_wp, 3.0_wp, 10.0_wp, 30.0_wp]/problem%rate, 1.001_wp, 1.1_wp, 1.5_wp]
         do i = 1, size(times)
            exact(:, i) = problem%exact(times(i))
         end do
         do i = 1, size(both)
            call solve(problem, times, at_tolerance(1.0e-10_wp, both(i)), y, error)
            call expect_close(error, y(1, :4), exact(1, :4), 1.0e-8_wp, both(i)//" at once")
            call expect_close(error, y(2, 5:), exact(2, 5:), 1.0e-9_wp, &
                              both(i)//" at rate 1e"//text(j))
         end do
      end do
   end subroutine test_transient
end module test_dde_taylor
