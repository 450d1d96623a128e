!> Stiff runs of the implicit methods and of `auto`: accuracy at and between the ends of steps,
!> events, and steps longer than the delay.
module test_dde_stiff
   use dde, only: event_table, integration_result
   use dde_kinds, only: wp
   use expectations, only: expect_between, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run, solve
   use stiff_problems, only: exponential_decay, prothero_robinson
   implicit none (type, external)
   private
   public :: collect_dde_stiff

   !> Methods under test.
   character(len=8), parameter :: methods(4) = ["radau5  ", "radau9  ", "radau13 ", "auto    "]
   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_dde_stiff(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("stiff accuracy", test_prothero_robinson), &
                   new_unittest("between the ends of stiff steps", test_inside), &
                   new_unittest("steps longer than the delay", test_overlap), &
                   new_unittest("events of stiff relaxation", test_events)]
   end subroutine collect_dde_stiff

   !> y = cos t at rates up to -1e12, in steps that the solution needs and not the rate. Here the
   !> order falls to s + 1 (order reduction); the error stays within a hundred tolerances.
   subroutine test_prothero_robinson(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      integer :: i, power

      do power = 2, 12, 5
         do i = 1, size(methods)
            call run(error, prothero_robinson(-10.0_wp**power), 0.0_wp, 10.0_wp, &
                     at_tolerance(1.0e-8_wp, methods(i)), outcome)
            call expect_close(error, outcome%y, [cos(10.0_wp)], 1.0e-6_wp, trim(methods(i)))
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
         do i = 1, size(methods)
            call solve(prothero_robinson(-1.0e6_wp), time, at_tolerance(tolerance(j), methods(i)), &
                       y, error)
            call expect_close(error, y(1, :), cos(time), 30.0_wp*tolerance(j), trim(methods(i)))
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
      do i = 1, size(methods)
         call run(error, problem, 0.0_wp, 10.0_wp, at_tolerance(1.0e-8_wp, methods(i)), outcome)
         call expect_close(error, outcome%y, [exp(10.0_wp*problem%root)], 1.0e-8_wp, &
                           trim(methods(i)))
         call expect_between(error, real(outcome%accepted, wp), 10.0_wp, 300.0_wp, "steps")
      end do
   end subroutine test_overlap

   !> cos t = 1/2 with a rate of -1e6, in steps far longer than its inverse.
   subroutine test_events(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         table = event_table([1], [0.5_wp], [0])
         call run(error, prothero_robinson(-1.0e6_wp), 0.0_wp, 10.0_wp, &
                  at_tolerance(1.0e-10_wp, methods(i)), outcome, watcher=table)
         call expect_close(error, table%time(:table%received)%hi, &
                           [pi/3, 5*pi/3, 7*pi/3], 1.0e-8_wp, methods(i))
      end do
   end subroutine test_events
end module test_dde_stiff
