! SPDX-License-Identifier: BSD-3-Clause
!> All methods against exact solutions and published values, and how errors fall with the length of
!> the steps and with the tolerance (tables in the texts cited in
!> test_problems; piecewise polynomials by hand).
module test_dde_solutions
   use dde, only: dde_problem_type, integration_options, methods
   use dde_dop853, only: dop853
   use dde_explicit_step, only: explicit_step_type
   use dde_interpolant, only: newton_state
   use expectations, only: expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme, infection, mackey_glass, published_enzyme, &
                                 published_infection
   use single_step, only: take_step
   use solving, only: at_tolerance, solve
   use test_problems, only: linear, sine, wille_baker
   use undelayed_problems, only: swing, undelayed
   implicit none (type, external)
   private
   public :: collect_dde_solutions

   !> Times of samples over 14 delays of `sine`.
   real(wp), parameter :: sampling = 0.37_wp
   integer, parameter :: samples = 60

contains

   subroutine collect_dde_solutions(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exact solutions", test_exact), &
                   new_unittest("published values", test_published), &
                   new_unittest("interpolants join smoothly", test_smooth_joint), &
                   new_unittest("many steps of one length", test_fixed_steps), &
                   new_unittest("error per tolerance", test_tolerance)]
   end subroutine collect_dde_solutions

   !> Piecewise polynomials with and without a jump at t = 0; sin t, with a history that varies; and
   !> two delays, whose breaking points lie so close that some Taylor steps are of the size of
   !> rounding.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp), parameter :: times(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]
      real(wp), parameter :: turns(4) = [pi/6, 5*pi/6, 13*pi/6, 20.0_wp]

      call compare(error, "linear", linear(), times, &
                   [0.0_wp, -0.5_wp, 19.0_wp/120, 10493.0_wp/518400], [1.0e-12_wp, 1.0e-9_wp])
      call compare(error, "linear with a jump", linear(past=[0.0_wp]), times, &
                   [1.0_wp, 0.0_wp, 5.0_wp/24, 19223.0_wp/362880], [1.0e-12_wp, 1.0e-9_wp])
      call compare(error, "sine", sine(), turns, sin(turns), [5.0e-12_wp, 1.0e-9_wp])
      call compare(error, "two delays", wille_baker(), [1.0_wp], &
                   [2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], [1.0e-12_wp, 1.0e-6_wp])
      call compare(error, "two delays", wille_baker(), [5.0_wp], &
                   [767.0_wp/40, 176.42257844738032_wp, 190.34420193607042_wp], &
                   [1.0e-10_wp, 1.0e-6_wp])
   end subroutine test_exact

   !> Two delays of one component, with an invariant; enzyme kinetics; the chaotic equation of
   !> Mackey and Glass, before chaos shows.
   subroutine test_published(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)

      call compare(error, "infection", infection(), [40.0_wp], published_infection, &
                   [1.0e-10_wp, 2.0e-8_wp])
      call solve(infection(), [17.3_wp, 40.0_wp], at_tolerance(1.0e-12_wp), y, error)
      call expect_close(error, sum(y, dim=1), [6.1_wp, 6.1_wp], 1.0e-13_wp, "sum of all")
      call compare(error, "enzyme", enzyme(), [160.0_wp], published_enzyme, [1.0e-8_wp, 1.0e-6_wp])
      call compare(error, "mackey-glass", mackey_glass(), [50.0_wp, 100.0_wp, 200.0_wp], &
                   [1.060954362898_wp, 1.013724016524_wp, 1.186718107117_wp], &
                   [1.0e-10_wp, 2.0e-7_wp])
   end subroutine test_published

   !> Solutions by all methods: by explicit ones at tolerance 1e-13, by implicit ones at 1e-11.
   subroutine compare(error, name, problem, times, known, within)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: name
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: times(:)
      !> Solution, n numbers for each time
      real(wp), intent(in) :: known(:)
      !> Largest error of explicit methods and of `auto`, and of implicit ones
      real(wp), intent(in) :: within(2)
      real(wp), allocatable :: y(:, :)
      integer :: class, i

      do i = 1, size(methods)
         if (methods(i) == "bs5" .or. methods(i) == "taylor" .and. .not. problem%analytic) cycle
         class = merge(2, 1, index(methods(i), "radau") == 1)
         call solve(problem, times, at_tolerance(merge(1.0e-11_wp, 1.0e-13_wp, class == 2), &
                                                 methods(i)), y, error)
         if (allocated(error)) return
         call expect_close(error, reshape(y, [size(y)]), known, within(class), &
                           name//" by "//methods(i))
      end do
   end subroutine compare

   !> The interpolant has the value and the slope of the solution at both ends of its step.
   subroutine test_smooth_joint(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(undelayed) :: problem
      real(wp), parameter :: h = 0.75_wp
      real(wp) :: a(0:7), estimate, lacking, slope(2, 0:1), y(2, 0:1)
      integer :: i, place

      problem = swing()
      call step%set_up(problem, dop853(), lacking)
      call take_step(problem, 0.0_wp, h, step, estimate)
      do i = 1, 2
         call step%interpolant(i, a)
         do place = 0, 1
            call newton_state(step%nodes, a, real(place, wp), y(i, place), slope(i, place))
         end do
      end do
      call expect_close(error, y(:, 0), [1.0_wp, 0.0_wp], 0.0_wp, "start")
      call expect_close(error, y(:, 1), step%y_new, 2.0e-16_wp, "end")
      call expect_close(error, slope(:, 0)/h, [0.0_wp, -1.0_wp], 1.0e-15_wp, "slope at the start")
      call expect_close(error, slope(:, 1)/h, [step%y_new(2), -step%y_new(1)], 1.0e-15_wp, &
                        "slope at the end")
   end subroutine test_smooth_joint

   !> With delays, and steps of lengths that the delay is no multiple of, global errors fall as the
   !> step's order promises; with an interpolant of low order they would not.
   subroutine test_fixed_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      character(len=6), parameter :: pairs(2) = ["dop853", "bs5   "]
      integer, parameter :: orders(2) = [8, 5]
      real(wp) :: misfit(2)
      integer :: i, j

      do j = 1, size(pairs)
         do i = 1, 2
            options = at_tolerance(1.0_wp, pairs(j))
            options%first_step = 0.65_wp/3**(i - 1)
            options%longest_step = options%first_step
            call solve_sine(options, misfit(i), error)
         end do
         call expect_between(error, log(misfit(1)/misfit(2))/log(3.0_wp), orders(j) - 1.0_wp, &
                             orders(j) + 0.5_wp, "order of "//pairs(j))
      end do
   end subroutine test_fixed_steps

   !> The error follows the tolerance over seven decades: between 0.05 and 1 times it by
   !> the pair of order 8, up to 5 times by that of order 5. With the kinks and two delays of the
   !> infection problem it stays below 3 times the tolerance.
   subroutine test_tolerance(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp) :: misfit, tolerance
      integer :: i

      do i = 6, 12
         tolerance = 10.0_wp**(-i)
         call solve_sine(at_tolerance(tolerance), misfit, error)
         call expect_between(error, misfit/tolerance, 0.05_wp, 1.0_wp, "error per tolerance")
         tolerance = 10.0_wp**(3 - i)
         call solve_sine(at_tolerance(tolerance, "bs5"), misfit, error)
         call expect_between(error, misfit/tolerance, 0.2_wp, 5.0_wp, "error of bs5 per tolerance")
      end do
      do i = 3, 10
         tolerance = 10.0_wp**(-i)
         call solve(infection(), [40.0_wp], at_tolerance(tolerance), y, error)
         call expect_between(error, maxval(abs(y(:, 1) - published_infection))/tolerance, 0.0_wp, &
                             3.0_wp, "error per tolerance")
      end do
   end subroutine test_tolerance

   !> Largest error of `sine` over all samples.
   subroutine solve_sine(options, misfit, error)
      type(integration_options), intent(in) :: options
      real(wp), intent(out) :: misfit
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: y(:, :)
      real(wp) :: time(samples)
      integer :: i

      time = [(sampling*i, i=1, samples)]
      call solve(sine(), time, options, y, error)
      misfit = maxval(abs(y(1, :) - sin(time)))
   end subroutine solve_sine
end module test_dde_solutions
