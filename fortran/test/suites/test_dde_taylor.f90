!> The method by Taylor series: its series, the length of its steps, the past it reads and leaves,
!> and when `auto` takes it.
module test_dde_taylor
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use block_builder, only: build_block
   use dde, only: continuation_type, integrate, integration_options, integration_result, &
                  step_underflow, value_not_finite
   use dde_step_context, only: step_context
   use dde_taylor_series, only: taylor_series
   use dde_taylor_step, only: taylor_step_type
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme, mackey_glass
   use single_step, only: interpolated, new_context
   use solving, only: at_tolerance, solve
   use spring_block, only: spring_block_type
   use test_problems, only: linear, sine, wille_baker
   use undelayed_problems, only: blow_up, without_delays
   implicit none (type, external)
   private
   public :: collect_dde_taylor

   !> The method itself, and the one that begins with it.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "]

contains

   !> All tests of this suite.
   subroutine collect_dde_taylor(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("order", test_order), &
                   new_unittest("length of a step", test_length), &
                   new_unittest("slope", test_slope), &
                   new_unittest("series of the block", test_block_series), &
                   new_unittest("piecewise polynomials", test_polynomials), &
                   new_unittest("a history that varies", test_sine), &
                   new_unittest("two delays", test_two_delays), &
                   new_unittest("mackey-glass", test_mackey_glass), &
                   new_unittest("the block by other methods", test_block), &
                   new_unittest("error follows tolerance", test_proportional), &
                   new_unittest("the past of other methods", test_pasts), &
                   new_unittest("no series", test_refusal), &
                   new_unittest("a singularity", test_singularity), &
                   new_unittest("a series that is not finite", test_not_finite)]
   end subroutine collect_dde_taylor

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

   !> All coefficients of that series are 1, so that the last but one reaches the tolerance first.
   subroutine test_length(error)
      type(error_type), allocatable, intent(out) :: error
      type(taylor_step_type) :: step
      real(wp) :: allowed, tolerance
      integer :: degree

      do degree = 8, 20
         tolerance = 10.0_wp**(7 - degree)
         call take_step(tolerance, 0.25_wp, step, allowed)
         call expect_close(error, allowed/(0.9_wp*tolerance**(1.0_wp/(degree - 1))), 1.0_wp, &
                           1.0e-12_wp, "length at degree "//text(degree))
      end do
   end subroutine test_length

   !> 1 + 3 s - 2 s^2 in powers of half a unit of time; what later terms are does not matter at 0.
   subroutine test_slope(error)
      type(error_type), allocatable, intent(out) :: error
      type(taylor_series) :: series

      series%degree = 3
      series%unit = 0.5_wp
      allocate (series%coefficients(0:3, 1))
      series%coefficients(:, 1) = [1.0_wp, 3.0_wp, -2.0_wp, 0.0_wp]
      call expect_close(error, series%slope(0.0_wp), [6.0_wp], 1.0e-15_wp, "at the start")
      call expect_close(error, series%slope(0.25_wp), [2.0_wp], 1.0e-15_wp, "in the middle")
      series%coefficients(3, 1) = ieee_value(1.0_wp, ieee_quiet_nan)
      call expect_close(error, series%slope(0.0_wp), [6.0_wp], 1.0e-15_wp, "where one is no number")
   end subroutine test_slope

   !> One step of y' = y^2 from y(0) = 1.
   subroutine take_step(tolerance, h, step, allowed)
      !> Absolute tolerance, which sets the degree
      real(wp), intent(in) :: tolerance
      !> Length
      real(wp), intent(in) :: h
      !> The step, taken
      type(taylor_step_type), intent(out) :: step
      !> How long it might have been
      real(wp), intent(out), optional :: allowed
      type(blow_up), target :: problem
      type(step_context) :: context
      real(wp) :: estimate, length

      problem = blow_up(n=1, past=[1.0_wp], first=[1.0_wp])
      call without_delays(problem)
      step = taylor_step_type(problem, tolerance)
      context = new_context(problem, 0.0_wp, 1.0_wp, 0.0_wp, tolerance)
      length = 0.5_wp*h
      call step%propose(context, length)
      if (present(allowed)) allowed = length
      context%cursor%h = h
      call step%attempt(context, estimate)
      call step%extend(context)
   end subroutine take_step

   !> The series of the block, with a delayed value that is a polynomial, solves its equations: its
   !> derivative is the right-hand side, but for what follows the last term.
   subroutine test_block_series(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 20
      real(wp), parameter :: gamma(4) = [0.05_wp, 0.8_wp, 3.0_wp, 20.0_wp], s = 0.5_wp
      real(wp), parameter :: w(4) = [0.7_wp, -1.0_wp, 0.1_wp, 1.5_wp]
      type(spring_block_type) :: problem
      real(wp) :: coefficient(0:degree, 3), found(3), rises(0:degree - 1, 3), slope(3), unit
      real(wp), allocatable :: delayed(:, :)
      integer :: delays, i, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.3_wp*i, xi=0.4_wp + 0.2_wp*i, &
                                  gamma=gamma(i), v=1.1_wp)
            allocate (delayed(0:degree, delays), source=0.0_wp)
            if (delays > 0) delayed(:3, 1) = [0.2_wp, -0.1_wp, 0.03_wp, 0.01_wp]
            coefficient = 0.0_wp
            coefficient(0, :) = [0.4_wp, -0.3_wp, w(i)]
            unit = 0.1_wp/max(1.0_wp, gamma(i)**2)
            call problem%series(0.0_wp, unit, degree, delayed, coefficient)
            call problem%rhs(0.0_wp, polynomial(coefficient, s), polynomial(delayed, s), slope)
            rises = spread([(real(k, wp), k=1, degree)], 2, 3)*coefficient(1:, :)
            found = polynomial(rises, s)/unit
            call expect_close(error, found/maxval(abs(slope)), slope/maxval(abs(slope)), &
                              1.0e-13_wp, "slope for gamma = "//text(gamma(i)))
            deallocate (delayed)
         end do
      end do
   end subroutine test_block_series

   !> Polynomials at s.
   pure function polynomial(coefficient, s) result(value)
      !> Coefficients, shape (0:degree, polynomials)
      real(wp), intent(in) :: coefficient(0:, :)
      !> Place
      real(wp), intent(in) :: s
      real(wp) :: value(size(coefficient, 2))
      integer :: k

      value = 0.0_wp
      do k = ubound(coefficient, 1), 0, -1
         value = coefficient(k, :) + s*value
      end do
   end function polynomial

   !> y' = -y(t-1) with y = 1, and with y = 0, before t = 0, where y(0) = 1.
   subroutine test_polynomials(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: times(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]
      integer :: i

      do i = 1, size(both)
         call solve(linear(n=1, lag=[1.0_wp], component=[1], past=[1.0_wp], first=[1.0_wp]), &
                    times, at_tolerance(1.0e-12_wp, both(i)), y, error)
         call expect_close(error, y(1, :), [0.0_wp, -0.5_wp, 19.0_wp/120, 10493.0_wp/518400], &
                           1.0e-13_wp, both(i)//", kink")
         call solve(linear(n=1, lag=[1.0_wp], component=[1], past=[0.0_wp], first=[1.0_wp]), &
                    times, at_tolerance(1.0e-12_wp, both(i)), y, error)
         call expect_close(error, y(1, :), [1.0_wp, 0.0_wp, 5.0_wp/24, 19223.0_wp/362880], &
                           1.0e-13_wp, both(i)//", jump")
      end do
   end subroutine test_polynomials

   !> y' = -y(t - pi/2) with the history sin t goes on as sin t.
   subroutine test_sine(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: times(4) = [0.5_wp, 2.6_wp, 7.0_wp, 20.0_wp]
      integer :: i

      do i = 1, size(both)
         call solve(sine(), times, at_tolerance(1.0e-12_wp, both(i)), y, error)
         call expect_close(error, y(1, :), sin(times), 5.0e-12_wp, both(i))
      end do
   end subroutine test_sine

   !> Wille and Baker's two delays, whose breaking points lie so close that some steps are of the
   !> size of rounding.
   subroutine test_two_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem
      real(wp), allocatable :: y(:, :)
      integer :: i

      problem = wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], &
                            past=[1.0_wp, 1.0_wp, 1.0_wp], first=[1.0_wp, 1.0_wp, 1.0_wp])
      do i = 1, size(both)
         call solve(problem, [1.0_wp, 5.0_wp], at_tolerance(1.0e-12_wp, both(i)), y, error)
         call expect_close(error, y(:, 1), [2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], &
                           1.0e-12_wp, both(i)//", y(1)")
         call expect_close(error, y(:, 2), [767.0_wp/40, 176.42257844738032_wp, &
                                            190.34420193607042_wp], 1.0e-10_wp, both(i)//", y(5)")
      end do
   end subroutine test_two_delays

   !> The chaotic equation of Mackey and Glass, before chaos shows.
   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error
      type(mackey_glass) :: problem
      real(wp), allocatable :: y(:, :)
      integer :: i

      problem = mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], first=[1.2_wp])
      do i = 1, size(both)
         call solve(problem, [50.0_wp, 100.0_wp, 200.0_wp], at_tolerance(1.0e-13_wp, both(i)), y, &
                    error)
         call expect_close(error, y(1, :), [1.060954362898_wp, 1.013724016524_wp, &
                                            1.186718107117_wp], 1.0e-10_wp, both(i))
      end do
   end subroutine test_mackey_glass

   !> The torus of the paper: as by the implicit method of order 13, without a rejection, with a
   !> series a step, and with less than a sixth as many of them as the explicit pair evaluates
   !> right-hand sides; `auto` stays with it.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: explicit, known, outcome
      integer :: i

      call integrate(torus(), 0.0_wp, 100.0_wp, at_tolerance(1.0e-13_wp, "radau13"), known, failure)
      call expect_success(error, failure)
      call integrate(torus(), 0.0_wp, 100.0_wp, at_tolerance(1.0e-10_wp), explicit, failure)
      call expect_success(error, failure)
      do i = 1, size(both)
         call integrate(torus(), 0.0_wp, 100.0_wp, at_tolerance(1.0e-10_wp, both(i)), outcome, &
                        failure)
         call expect_success(error, failure)
         call expect_close(error, outcome%y, known%y, 1.0e-8_wp, both(i))
         call expect(error, outcome%rejected == 0, both(i)//" rejects no step")
         call expect(error, outcome%implicit_steps == 0, both(i)//" takes no implicit step")
         call expect_between(error, real(outcome%evaluations, wp), real(outcome%accepted, wp), &
                             real(explicit%evaluations, wp)/6, both(i)//", series")
      end do
   end subroutine test_block

   !> The error at t = 100 stays below 100 times the tolerance, and falls with it.
   subroutine test_proportional(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: known, outcome
      integer :: i

      call integrate(torus(), 0.0_wp, 100.0_wp, at_tolerance(1.0e-13_wp, "radau13"), known, failure)
      call expect_success(error, failure)
      do i = 2, 12
         call integrate(torus(), 0.0_wp, 100.0_wp, at_tolerance(10.0_wp**(-i), "taylor"), outcome, &
                        failure)
         call expect_success(error, failure)
         call expect_close(error, outcome%y, known%y, 100*10.0_wp**(-i), "1e-"//text(i))
      end do
   end subroutine test_proportional

   !> y = sin t by one method after the other, each on the past that the one before has left.
   subroutine test_pasts(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      character(len=8), parameter :: methods(6) = ["explicit", "taylor  ", "radau9  ", "taylor  ", &
                                                   "explicit", "taylor  "]
      integer :: i

      do i = 1, size(methods)
         call integrate(sine(), continuation%time(1), 2.3_wp*i, &
                        at_tolerance(1.0e-11_wp, methods(i)), outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
         call expect_close(error, outcome%y, [sin(2.3_wp*i)], 1.0e-9_wp, &
                           methods(i)//" in run "//text(i))
         call expect_close(error, continuation%slope, [cos(2.3_wp*i)], 1.0e-8_wp, &
                           "slope after "//methods(i))
      end do
   end subroutine test_pasts

   !> A problem that gives no series has no such method, and `auto` begins without.
   subroutine test_refusal(error)
      type(error_type), allocatable, intent(out) :: error
      type(enzyme) :: problem
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      real(wp) :: series(0:6, 4), z(0:6, 1)

      problem = enzyme(n=4, lag=[4.0_wp], component=[4], &
                       past=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp], &
                       first=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      call integrate(problem, 0.0_wp, 1.0_wp, integration_options(method="taylor"), outcome, &
                     failure)
      call expect_failure(error, failure, "method = 'taylor' for a problem that gives no Taylor " &
                          //"series (analytic = .false.)")
      call integrate(problem, 0.0_wp, 1.0_wp, integration_options(), outcome, failure)
      call expect_success(error, failure)
      z = 0.0_wp
      series = 0.0_wp
      call problem%series(0.0_wp, 1.0_wp, 6, z, series)
      call expect(error, all(ieee_is_nan(series(1:, :))), "there is no series of the solution")
   end subroutine test_refusal

   !> y = 1/(1 - t) has no value at t = 1.
   subroutine test_singularity(error)
      type(error_type), allocatable, intent(out) :: error
      type(blow_up) :: problem
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      problem = blow_up(n=1, past=[1.0_wp], first=[1.0_wp])
      call without_delays(problem)
      call integrate(problem, 0.0_wp, 2.0_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome, failure)
      call expect(error, outcome%reason == step_underflow, "the reason is `step_underflow`")
      call expect_close(error, outcome%t, 1.0_wp, 1.0e-8_wp, "t")
   end subroutine test_singularity

   !> The block takes no v beyond e^300.
   subroutine test_not_finite(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, &
                                 v=1.0e131_wp), &
                     0.0_wp, 1.0_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome, failure)
      call expect(error, outcome%reason == value_not_finite, "the reason is `value_not_finite`")
      call expect(error, outcome%accepted == 0, "no step passed")
   end subroutine test_not_finite

   !> The torus of the paper.
   type(spring_block_type) function torus() result(problem)
      problem = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.5_wp)
   end function torus
end module test_dde_taylor
