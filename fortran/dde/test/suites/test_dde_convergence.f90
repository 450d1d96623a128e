!> How errors fall with the length of the steps and with the tolerance, on problems with exact
!> solutions.
module test_dde_convergence
   use dde, only: dde_problem_type, integration_options
   use dde_explicit_step, only: explicit_step_type
   use dde_step, only: step_type
   use expectations, only: expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: infection
   use single_step, only: interpolated, take_step
   use solving, only: at_tolerance, solve
   use test_problems, only: sine
   use undelayed_problems, only: blow_up, oscillator, without_delays
   implicit none (type, external)
   private
   public :: collect_dde_convergence

   !> Places in the interior of a step.
   real(wp), parameter :: places(7) = [0.07_wp, 0.21_wp, 0.33_wp, 0.45_wp, 0.62_wp, 0.71_wp, &
                                       0.94_wp]
   !> Times of samples over 14 delays of `sine`.
   real(wp), parameter :: sampling = 0.37_wp
   integer, parameter :: samples = 60

contains

   !> All tests of this suite.
   subroutine collect_dde_convergence(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("one step of an oscillator", test_oscillator), &
                   new_unittest("one step of y' = y**2", test_nonlinear), &
                   new_unittest("interpolants join smoothly", test_smooth_joint), &
                   new_unittest("many steps of one length", test_fixed_steps), &
                   new_unittest("error per tolerance", test_tolerance), &
                   new_unittest("error per tolerance, two delays", test_tolerance_two_delays)]
   end subroutine collect_dde_convergence

   !> Halving h divides the error of a step by 2**9, that inside the step and the estimate by 2**8.
   subroutine test_oscillator(error)
      type(error_type), allocatable, intent(out) :: error
      type(oscillator) :: problem
      type(explicit_step_type) :: step
      real(wp) :: estimate(3), h, misfit(3), misfit_inside(3)
      integer :: i, j

      problem = oscillator(n=2, past=[1.0_wp, 0.0_wp], first=[1.0_wp, 0.0_wp])
      call without_delays(problem)
      do i = 1, 3
         h = 0.5_wp**i
         step = explicit_step_type(problem)
         call take_step(problem, 0.0_wp, h, step, estimate(i), absolute=1.0e-24_wp)
         misfit(i) = norm2(step%y_new - [cos(h), -sin(h)])
         misfit_inside(i) = maxval([(norm2(interpolated(step, places(j)) - &
                                           [cos(h*places(j)), -sin(h*places(j))]), &
                                     j=1, size(places))])
      end do
      call expect_slope(error, misfit(:2), 9.0_wp, 9.1_wp, "order of the step")
      call expect_slope(error, misfit_inside, 7.95_wp, 8.1_wp, "order inside the step")
      call expect_slope(error, estimate, 7.95_wp, 8.1_wp, "order of the estimate")
      call expect_between(error, misfit(2), 0.0_wp, 1.0e-12_wp, "error of the step")
      call expect_between(error, misfit_inside(3), 0.0_wp, 1.0e-12_wp, "error inside the step")
   end subroutine test_oscillator

   !> The same for a problem that is not linear.
   subroutine test_nonlinear(error)
      type(error_type), allocatable, intent(out) :: error
      type(blow_up) :: problem
      type(explicit_step_type) :: step
      real(wp) :: estimate(3), h, inside(1), misfit(3), misfit_inside(3)
      integer :: i, j

      problem = blow_up(n=1, past=[1.0_wp], first=[1.0_wp])
      call without_delays(problem)
      do i = 1, 3
         h = 0.25_wp*0.5_wp**i
         step = explicit_step_type(problem)
         call take_step(problem, 0.0_wp, h, step, estimate(i), absolute=1.0e-24_wp)
         misfit(i) = abs(step%y_new(1) - 1.0_wp/(1.0_wp - h))
         misfit_inside(i) = 0.0_wp
         do j = 1, size(places)
            inside = interpolated(step, places(j))
            misfit_inside(i) = max(misfit_inside(i), &
                                   abs(inside(1) - 1.0_wp/(1.0_wp - h*places(j))))
         end do
      end do
      call expect_slope(error, misfit(:2), 9.2_wp, 9.9_wp, "order of the step")
      call expect_slope(error, misfit_inside, 8.0_wp, 8.5_wp, "order inside the step")
      call expect_slope(error, estimate, 8.0_wp, 8.2_wp, "order of the estimate")
   end subroutine test_nonlinear

   !> The interpolant has the value and the slope of the solution at both ends of its step.
   subroutine test_smooth_joint(error)
      type(error_type), allocatable, intent(out) :: error
      type(oscillator) :: problem
      type(explicit_step_type) :: step
      real(wp), parameter :: h = 0.75_wp
      real(wp) :: estimate, slope(2)
      integer :: i

      problem = oscillator(n=2, past=[1.0_wp, 0.0_wp], first=[1.0_wp, 0.0_wp])
      call without_delays(problem)
      step = explicit_step_type(problem)
      call take_step(problem, 0.0_wp, h, step, estimate)
      call expect_close(error, interpolated(step, 0.0_wp), [1.0_wp, 0.0_wp], 0.0_wp, "start")
      call expect_close(error, interpolated(step, 1.0_wp), step%y_new, 2.0e-16_wp, "end")
      slope = [(slope_of(step, i, 0.0_wp)/h, i=1, 2)]
      call expect_close(error, slope, [0.0_wp, -1.0_wp], 1.0e-15_wp, "slope at the start")
      slope = [(slope_of(step, i, 1.0_wp)/h, i=1, 2)]
      call expect_close(error, slope, [step%y_new(2), -step%y_new(1)], 1.0e-15_wp, &
                        "slope at the end")
   end subroutine test_smooth_joint

   !> With delays, and steps of lengths that the delay is no multiple of, global errors fall as the
   !> step's order promises; with an interpolant of low order they would not.
   subroutine test_fixed_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      real(wp) :: misfit(2)
      integer :: i

      do i = 1, 2
         options = at_tolerance(1.0_wp)
         options%first_step = 0.65_wp/3**(i - 1)
         options%longest_step = options%first_step
         call solve_sine(options, misfit(i), error)
      end do
      call expect_between(error, log(misfit(1)/misfit(2))/log(3.0_wp), 7.0_wp, 8.5_wp, "order")
   end subroutine test_fixed_steps

   !> The error is proportional to the tolerance over seven decades: between 0.2 and 1 times it.
   subroutine test_tolerance(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: misfit, tolerance
      integer :: i

      do i = 6, 12
         tolerance = 10.0_wp**(-i)
         call solve_sine(at_tolerance(tolerance), misfit, error)
         call expect_between(error, misfit/tolerance, 0.2_wp, 1.0_wp, "error per tolerance")
      end do
   end subroutine test_tolerance

   !> The infection problem with its kinks and two delays stays below 3 times the tolerance.
   subroutine test_tolerance_two_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(infection) :: problem
      real(wp), parameter :: published(3) = [0.0912491205664_wp, 0.0202995003351_wp, &
                                             5.9884513791_wp]
      real(wp), allocatable :: y(:, :)
      real(wp) :: tolerance
      integer :: i

      problem = infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], &
                          past=[5.0_wp, 0.1_wp, 1.0_wp], first=[5.0_wp, 0.1_wp, 1.0_wp])
      do i = 3, 10
         tolerance = 10.0_wp**(-i)
         call solve(problem, [40.0_wp], at_tolerance(tolerance), y, error)
         call expect_between(error, maxval(abs(y(:, 1) - published))/tolerance, 0.0_wp, 3.0_wp, &
                             "error per tolerance")
      end do
   end subroutine test_tolerance_two_delays

   !> Largest error of `sine` over all samples.
   subroutine solve_sine(options, misfit, error)
      !> Tolerances and limits
      type(integration_options), intent(in) :: options
      !> Largest error
      real(wp), intent(out) :: misfit
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(sine) :: problem
      real(wp), allocatable :: y(:, :)
      real(wp) :: time(samples)
      integer :: i

      problem = sine()
      time = [(sampling*i, i=1, samples)]
      call solve(problem, time, options, y, error)
      misfit = maxval(abs(y(1, :) - sin(time)))
   end subroutine solve_sine

   !> Each value is the one before divided by 2 to a power between `least` and `most`.
   subroutine expect_slope(error, values, least, most, what)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Values at halved steps
      real(wp), intent(in) :: values(:)
      !> Least power
      real(wp), intent(in) :: least
      !> Greatest power
      real(wp), intent(in) :: most
      !> What the power is
      character(len=*), intent(in) :: what
      integer :: i

      do i = 2, size(values)
         call expect_between(error, log(values(i - 1)/values(i))/log(2.0_wp), least, most, what)
      end do
   end subroutine expect_slope

   !> Derivative of component c of the interpolant by s, by the rule of products.
   pure real(wp) function slope_of(step, c, s) result(slope)
      !> The step
      class(step_type), intent(in) :: step
      !> Component
      integer, intent(in) :: c
      !> Place
      real(wp), intent(in) :: s
      real(wp) :: coefficients(0:size(step%nodes))
      logical :: others(size(step%nodes))
      integer :: i, j

      call step%interpolant(c, coefficients)
      slope = 0.0_wp
      do j = 1, size(step%nodes)
         do i = 1, j
            others = .true.
            others(i) = .false.
            slope = slope + coefficients(j)*product(s - step%nodes(:j), others(:j))
         end do
      end do
   end function slope_of
end module test_dde_convergence
