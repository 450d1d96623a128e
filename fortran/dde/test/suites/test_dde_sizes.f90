!> Components of different size: one beside another that is huge or tiny, and tolerances of each.
module test_dde_sizes
   use dde, only: integrate, integration_options, integration_result
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: logistic_beside, relaxing
   use solving, only: at_tolerance
   use test_problems, only: fill
   implicit none (type, external)
   private
   public :: collect_dde_sizes

   !> Methods that do not need a series.
   character(len=8), parameter :: methods(5) = [character(len=8) :: "explicit", "radau5", &
                                                "radau9", "radau13", "auto"]

contains

   !> All tests of this suite.
   subroutine collect_dde_sizes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a component beside", test_beside), &
                   new_unittest("tolerances of components", test_each), &
                   new_unittest("refused tolerances of components", test_refused)]
   end subroutine collect_dde_sizes

   !> A component that is no part of the equation does not change how it is solved.
   subroutine test_beside(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: alone, beside
      type(logistic_beside) :: problem
      real(wp), parameter :: sizes(4) = [1.0e-15_wp, 1.0e9_wp, 1.0e12_wp, 1.0e15_wp]
      integer :: digits, i, k

      do i = 1, size(methods)
         do digits = 3, 12, 3
            call fill(problem, 2, [1.2_wp, 1.0_wp], [1.2_wp, 1.0_wp], [1.0_wp], [1])
            call integrate(problem, 0.0_wp, 100.0_wp, &
                           at_tolerance(10.0_wp**(-digits), methods(i)), alone, failure)
            call expect_success(error, failure)
            do k = 1, size(sizes)
               problem%first(2) = sizes(k)
               call integrate(problem, 0.0_wp, 100.0_wp, &
                              at_tolerance(10.0_wp**(-digits), methods(i)), beside, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, beside%y(1), alone%y(1), 0.01_wp*10.0_wp**(-digits), &
                                 trim(methods(i))//" at 1e-"//text(digits)//" beside " &
                                 //text(sizes(k)))
            end do
         end do
      end do
   end subroutine test_beside

   !> A stiff component of size 1e-30 beside one of size 1 is as exact as one of size 1.
   subroutine test_each(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: large, small
      type(relaxing) :: problem
      integer :: i

      do i = 1, size(methods)
         call fill(problem, 2, [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp])
         allocate (problem%lag(0), problem%component(0))
         problem%unit = 1.0_wp
         call integrate(problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-8_wp, methods(i)), large, &
                        failure)
         call expect_success(error, failure)
         problem%unit = 1.0e-30_wp
         problem%first(1) = 1.0e-30_wp
         options = at_tolerance(1.0e-8_wp, methods(i))
         options%each_absolute = [1.0e-38_wp, 1.0e-8_wp]
         options%each_relative = [1.0e-8_wp, 1.0e-8_wp]
         call integrate(problem, 0.0_wp, 1.0_wp, options, small, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         call expect_close(error, small%y(2), large%y(2), 1.0e-8_wp, "y2 by "//methods(i))
         call expect_close(error, small%y(1)*1.0e30_wp, large%y(1), 1.0e-7_wp, "y1 by "//methods(i))
         call expect_close(error, large%y(1), sqrt(large%y(2)**2 + 1.0e-3_wp*large%y(2)), &
                           1.0e-5_wp, "the slow solution")
         deallocate (problem%lag, problem%component)
      end do
   end subroutine test_each

   !> As many tolerances as equations, each one that can be.
   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options

      options%each_absolute = [1.0e-8_wp]
      call refuse(error, options, "1 tolerances each_absolute for 2 equations")
      options%each_absolute = [1.0e-8_wp, 0.0_wp]
      call refuse(error, options, "each_absolute(2) = 0.0; finite and > 0 expected")
      deallocate (options%each_absolute)
      options%each_relative = [-1.0_wp, 0.0_wp]
      call refuse(error, options, "each_relative(1) = -1.0; finite and >= 0 expected")
   end subroutine test_refused

   !> These options are refused in these words.
   subroutine refuse(error, options, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The options
      type(integration_options), intent(in) :: options
      !> Part of the message
      character(len=*), intent(in) :: words
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(relaxing) :: problem

      call fill(problem, 2, [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp])
      allocate (problem%lag(0), problem%component(0))
      call integrate(problem, 0.0_wp, 1.0_wp, options, outcome, failure)
      call expect_failure(error, failure, words)
      call expect(error, .not. allocated(outcome%y), "nothing is integrated")
   end subroutine refuse
end module test_dde_sizes
