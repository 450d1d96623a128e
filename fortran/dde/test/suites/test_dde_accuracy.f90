! SPDX-License-Identifier: BSD-3-Clause
!> Errors by all methods on a table of problems: they follow the tolerance.
module test_dde_accuracy
   use dde, only: dde_problem_type, integration_options, methods
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use layer_problems, only: layer, measure_errors, relaxation
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme, infection, mackey_glass, published_enzyme, &
                                 published_infection
   use solving, only: at_tolerance, solve
   use stiff_problems, only: exponential_decay, follower, prothero_robinson
   use test_problems, only: constant_past, linear, sine, wille_baker
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_accuracy

   !> Methods whose steps are as long as one over the rate of a decay; the last reads series.
   character(len=8), parameter :: explicit(4) = [character(len=8) :: "explicit", "bs5", "dop853", &
                                                 "taylor"]

contains

   subroutine collect_dde_accuracy(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("errors follow the tolerance", test_exact), &
                   new_unittest("published values", test_published)]
   end subroutine collect_dde_accuracy

   !> Errors at and between the ends of steps, in tolerances; and the number of steps. Implicit
   !> methods solve what is stiff, and `auto` and `taylor` where fast components are in balance. A
   !> delay of 1e-4 is shorter than steps. Of layers the pulse that y1 leaves behind is in y2 a
   !> delay later, where an error of y1 counts as often as the rate says: the absolute tolerance is
   !> one over the rate. At the last rate the embedded error of radau13 was small by chance in a
   !> step over the layer at t = 3.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      class(constant_past), allocatable :: problem
      integer :: digits, i, j
      real(wp) :: most, rates(14), tolerance

      rates = [1.01_wp*10.0_wp**[(j/2.0_wp, j=0, 12)], 1.01_wp*10.0_wp**(34.0_wp/15)]
      do i = 1, size(methods)
         do digits = 3, 12, 3
            tolerance = 10.0_wp**(-digits)
            call check("sine", sine(), 20.0_wp, [2.0_wp, 5.0_wp])
            call check("oscillator", swing(), 20.0_wp, [4.0_wp, 4.0_wp])
            do j = 1, size(rates)
               if (any(methods(i) == explicit) .and. rates(j) > 1.1e3_wp) cycle
               call check("decay", relaxation(rates(j)), 3.7_wp, [4.0_wp, 10.0_wp])
               problem = layer(rates(j), merge(0.0_wp, 0.5_wp, modulo(j, 3) == 0))
               problem%analytic = modulo(j, 2) == 0 .or. methods(i) == "taylor"
               call check("layer", problem, 3.7_wp, [5.0_wp, 20.0_wp], strict=rates(j))
            end do
            if (any(methods(i) == explicit(:3))) cycle
            do j = 2, 12, 5
               most = merge(60.0_wp, 2.0_wp, index(methods(i), "radau") > 0)
               call check("follower", follower(10.0_wp**j, start=2.0_wp), 20.0_wp, [most, most], &
                          400)
               call check("Prothero and Robinson", prothero_robinson(-10.0_wp**j), 10.0_wp, &
                          [50.0_wp, 50.0_wp], 400)
            end do
            call check("a short delay", exponential_decay(1.0e-4_wp), 10.0_wp, [2.0_wp, 2.0_wp], &
                       100)
         end do
      end do

   contains

      !> One row of the table.
      subroutine check(name, problem, t_end, most, most_steps, strict)
         character(len=*), intent(in) :: name
         class(constant_past), intent(in) :: problem
         real(wp), intent(in) :: t_end
         !> Largest errors at the ends of steps and between them
         real(wp), intent(in) :: most(2)
         !> Largest number of steps down to a tolerance of 1e-6
         integer, intent(in), optional :: most_steps
         !> Relative over absolute tolerance; 1 if not given
         real(wp), intent(in), optional :: strict
         real(wp), parameter :: shares(2) = [1.0_wp, 1.0_wp/16]
         type(failure_type), allocatable :: failure
         type(integration_options) :: options
         real(wp), allocatable :: largest(:)
         integer :: k, steps

         if (allocated(error) .or. methods(i) == "taylor" .and. .not. problem%analytic) return
         options = at_tolerance(tolerance, methods(i))
         if (present(strict)) options%absolute = tolerance/strict
         do k = 1, 2
            call measure_errors(problem, t_end, options, shares(k), largest, failure, steps)
            call expect_success(error, failure)
            call expect_between(error, maxval(largest)/tolerance, 0.0_wp, most(k), &
                                name//" by "//trim(methods(i))//" at "//text(tolerance) &
                                //merge(", ends    ", ", between ", k == 1)//text(problem%p(1)))
         end do
         if (present(most_steps) .and. digits <= 6) then
            call expect(error, steps <= most_steps, text(steps)//" steps, "//name//methods(i))
         end if
      end subroutine check
   end subroutine test_exact

   !> Published solutions, and piecewise polynomials by hand, with and without a jump at t = 0. The
   !> delays of the last have breaking points so close that some steps are of the size of rounding.
   subroutine test_published(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: times(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]
      real(wp), allocatable :: y(:, :)
      real(wp) :: tolerance
      integer :: i

      call compare("linear", linear(), times, &
                   [0.0_wp, -0.5_wp, 19.0_wp/120, 10493.0_wp/518400], [1.0e-12_wp, 1.0e-9_wp])
      call compare("linear with a jump", linear(past=[0.0_wp]), times, &
                   [1.0_wp, 0.0_wp, 5.0_wp/24, 19223.0_wp/362880], [1.0e-12_wp, 1.0e-9_wp])
      call compare("two delays", wille_baker(), [1.0_wp], &
                   [2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], [1.0e-12_wp, 1.0e-6_wp])
      call compare("two delays", wille_baker(), [5.0_wp], &
                   [767.0_wp/40, 176.42257844738032_wp, 190.34420193607042_wp], &
                   [1.0e-10_wp, 1.0e-6_wp])
      call compare("infection", infection(), [40.0_wp], published_infection, &
                   [1.0e-10_wp, 2.0e-8_wp])
      call compare("enzyme", enzyme(), [160.0_wp], published_enzyme, [1.0e-8_wp, 1.0e-6_wp])
      call compare("mackey-glass", mackey_glass(), [50.0_wp, 100.0_wp, 200.0_wp], &
                   [1.060954362898_wp, 1.013724016524_wp, 1.186718107117_wp], &
                   [1.0e-10_wp, 2.0e-7_wp])
      call solve(infection(), [17.3_wp, 40.0_wp], at_tolerance(1.0e-12_wp), y, error)
      call expect_close(error, sum(y, dim=1), [6.1_wp, 6.1_wp], 1.0e-13_wp, "an invariant")
      do i = 3, 10
         tolerance = 10.0_wp**(-i)
         call solve(infection(), [40.0_wp], at_tolerance(tolerance), y, error)
         call expect_between(error, maxval(abs(y(:, 1) - published_infection))/tolerance, 0.0_wp, &
                             3.0_wp, "error per tolerance")
      end do

   contains

      !> By explicit methods at tolerance 1e-13, by implicit ones at 1e-11.
      subroutine compare(name, problem, times, known, within)
         character(len=*), intent(in) :: name
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: times(:)
         !> Solution, n numbers for each time
         real(wp), intent(in) :: known(:)
         !> Largest error of explicit methods and of `auto`, and of implicit ones
         real(wp), intent(in) :: within(2)
         integer :: class

         do i = 1, size(methods)
            if (methods(i) == "bs5" .or. methods(i) == "taylor" .and. .not. problem%analytic) cycle
            class = merge(2, 1, index(methods(i), "radau") == 1)
            call solve(problem, times, at_tolerance(merge(1.0e-11_wp, 1.0e-13_wp, class == 2), &
                                                    methods(i)), y, error)
            call expect_close(error, reshape(y, [size(y)]), known, within(class), &
                              name//" by "//methods(i))
         end do
      end subroutine compare
   end subroutine test_published
end module test_dde_accuracy
