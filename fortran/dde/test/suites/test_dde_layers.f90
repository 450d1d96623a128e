! SPDX-License-Identifier: BSD-3-Clause
!> Layers and stiff runs: dense output where a component decays within a step, accuracy at and
!> between the ends of stiff steps, steps longer than the delay, and the unit of the state.
module test_dde_layers
   use dde, only: integration_options, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use layer_problems, only: layer, measure_errors, relaxation
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme
   use solving, only: at_tolerance, run, solve
   use stiff_problems, only: exponential_decay, prothero_robinson
   implicit none (type, external)
   private
   public :: collect_dde_layers

   !> Methods, and the largest rate at which each is tried: explicit steps are as long as one over
   !> the rate.
   character(len=8), parameter :: methods(6) = &
      [character(len=8) :: "auto", "dop853", "bs5", "radau5", "radau9", "radau13"]
   real(wp), parameter :: largest_rate(6) = [1.0e6_wp, 1.0e3_wp, 1.0e3_wp, 1.0e6_wp, 1.0e6_wp, &
                                             1.0e6_wp]
   !> Methods of stiff runs.
   character(len=8), parameter :: stiff(4) = [methods(4:), "auto    "]

contains

   subroutine collect_dde_layers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a pulse, and one that returns", test_pulses), &
                   new_unittest("a decay without delay", test_decay), &
                   new_unittest("the unit of the state", test_unit), &
                   new_unittest("one loose component", test_loose), &
                   new_unittest("stiff accuracy", test_prothero_robinson), &
                   new_unittest("between the ends of stiff steps", test_inside), &
                   new_unittest("steps longer than the delay", test_overlap)]
   end subroutine collect_dde_layers

   !> The pulse that y1 leaves behind is in y2 a delay later, at rates over six decades. An error of
   !> y1 counts for y2 as often as the rate says: both have the same absolute tolerance,
   !> then one over the rate.
   subroutine test_pulses(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(layer) :: problem
      real(wp), parameter :: t_end(2) = [2.5_wp, 3.7_wp]
      real(wp) :: rate, tolerance
      type(integration_options) :: options
      integer :: digits, i, j, k, strict

      do i = 1, size(methods)
         do digits = 3, 12, 3
            tolerance = 10.0_wp**(-digits)
            do j = 0, 18
               rate = 1.01_wp*10.0_wp**(j/3.0_wp)
               if (rate > largest_rate(i)) exit
               do k = 1, 2
                  problem = layer(rate, merge(0.0_wp, 0.5_wp, k == 1))
                  problem%analytic = modulo(j, 2) == 0
                  do strict = 0, 1
                     options = at_tolerance(tolerance, methods(i))
                     if (strict == 1) options%absolute = tolerance/rate
                     call run(error, problem, 0.0_wp, t_end(k), options, outcome)
                     if (allocated(error)) return
                     call expect_close(error, outcome%y, problem%exact(t_end(k)), &
                                       tolerance*merge(100.0_wp + rate, 10.0_wp, strict == 0), &
                                       trim(methods(i))//" at "//text(tolerance)//", rate " &
                                       //text(rate))
                  end do
               end do
            end do
         end do
      end do
      ! here the embedded error was small by chance in a step over the layer at t = 3
      options = at_tolerance(1.0e-6_wp, "radau13")
      problem = layer(10.0_wp**(34.0_wp/15.0_wp)*1.01_wp, 0.5_wp)
      options%absolute = options%relative/problem%rate
      call run(error, problem, 0.0_wp, 3.7_wp, options, outcome)
      if (allocated(error)) return
      call expect_close(error, outcome%y, problem%exact(3.7_wp), 1.0e-5_wp, "by chance")
   end subroutine test_pulses

   !> Samples between the ends of steps; `dop853` was wrong by up to 471 tolerances.
   subroutine test_decay(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp), allocatable :: largest(:)
      real(wp) :: rate, tolerance
      integer :: digits, i, j

      do i = 1, size(methods)
         do digits = 3, 12, 3
            tolerance = 10.0_wp**(-digits)
            do j = 0, 72, 2
               rate = 1.01_wp*10.0_wp**(j/12.0_wp)
               if (rate > largest_rate(i)) exit
               call measure_errors(relaxation(rate), 3.7_wp, at_tolerance(tolerance, methods(i)), &
                                   1.0_wp/16, largest, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_between(error, largest(1)/tolerance, 0.0_wp, 100.0_wp, &
                                   trim(methods(i))//" at "//text(tolerance)//", rate "//text(rate))
            end do
         end do
      end do
   end subroutine test_decay

   !> With state and absolute tolerance in another unit the results are the same: bit by bit if it
   !> is a power of two.
   subroutine test_unit(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      type(integration_options) :: options
      type(layer) :: problem
      character(len=8), parameter :: tried(7) = [methods, "taylor  "]
      integer, parameter :: powers(4) = [-40, -7, 13, 40]
      integer :: i, j
      real(wp) :: unit

      do i = 1, size(tried)
         do j = 0, size(powers) + 1
            unit = 1.0_wp
            if (j > 0) unit = 1000.0_wp
            if (j > 0 .and. j <= size(powers)) unit = 2.0_wp**powers(j)
            problem = layer(30.0_wp, 0.5_wp)
            problem%first = unit*problem%first
            options = at_tolerance(1.0e-9_wp, tried(i))
            options%absolute = 1.0e-3_wp*unit
            call run(error, problem, 0.0_wp, 3.7_wp, options, outcome)
            if (allocated(error)) return
            if (j == 0) known = outcome
            call expect_close(error, outcome%y/unit, known%y, &
                              merge(0.0_wp, 1.0e-9_wp, j <= size(powers)), &
                              trim(tried(i))//" in units of "//text(unit)//": y")
            call expect(error, j > size(powers) .or. outcome%accepted == known%accepted, &
                        "the same steps")
         end do
      end do
   end subroutine test_unit

   !> A component of which nothing is asked changes nothing of the others.
   subroutine test_loose(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: loose, outcome
      type(integration_options) :: options
      integer :: i

      do i = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(i))
         call run(error, enzyme(), 0.0_wp, 20.0_wp, options, outcome)
         options%each_absolute = [1.0e-9_wp, 1.0e-9_wp, 1.0e-9_wp, 1.0e6_wp]
         call run(error, enzyme(), 0.0_wp, 20.0_wp, options, loose)
         if (allocated(error)) return
         call expect_between(error, loose%accepted/real(outcome%accepted, wp), 0.8_wp, 1.2_wp, &
                             methods(i))
      end do
   end subroutine test_loose

   !> y = cos t at rates up to -1e12, in steps that the solution needs and not the rate. Here the
   !> order falls to s + 1 (order reduction); the error stays within a hundred tolerances.
   subroutine test_prothero_robinson(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      integer :: i, power

      do power = 2, 12, 5
         do i = 1, size(stiff)
            call run(error, prothero_robinson(-10.0_wp**power), 0.0_wp, 10.0_wp, &
                     at_tolerance(1.0e-8_wp, stiff(i)), outcome)
            call expect_close(error, outcome%y, [cos(10.0_wp)], 1.0e-6_wp, trim(stiff(i)))
            call expect_between(error, real(outcome%accepted, wp), 5.0_wp, 800.0_wp, "steps")
         end do
      end do
   end subroutine test_prothero_robinson

   !> Samples between the ends of steps that are far longer than the time in which y follows cos t.
   !> As rounding goes, radau5 ends at 5 to 20 times the smaller tolerance, the others below 1.
   subroutine test_inside(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: tolerance(2) = [1.0e-6_wp, 1.0e-10_wp]
      real(wp) :: time(1000)
      integer :: i, j

      time = [(0.02_wp*i, i=1, size(time))]
      do j = 1, size(tolerance)
         do i = 1, size(stiff)
            call solve(prothero_robinson(-1.0e6_wp), time, at_tolerance(tolerance(j), stiff(i)), &
                       y, error)
            call expect_close(error, y(1, :), cos(time), 30.0_wp*tolerance(j), trim(stiff(i)))
         end do
      end do
   end subroutine test_inside

   !> With a delay of 1e-4 and changes on a scale of 1, ten units of time take a few dozen steps,
   !> and the exact solution is met.
   subroutine test_overlap(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponential_decay) :: problem
      type(integration_result) :: outcome
      integer :: i

      problem = exponential_decay(1.0e-4_wp)
      do i = 1, size(stiff)
         call run(error, problem, 0.0_wp, 10.0_wp, at_tolerance(1.0e-8_wp, stiff(i)), outcome)
         call expect_close(error, outcome%y, [exp(10.0_wp*problem%root)], 1.0e-8_wp, &
                           trim(stiff(i)))
         call expect_between(error, real(outcome%accepted, wp), 10.0_wp, 300.0_wp, "steps")
      end do
   end subroutine test_overlap
end module test_dde_layers
