!> The counts of a run, and their sum in evaluations of the explicit pair.
module test_dde_work
   use dde, only: integrate, integration_result
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use dde_work, only: operations_of_evaluation, work_type
   use expectations, only: expect, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance
   use test_problems, only: sine
   implicit none (type, external)
   private
   public :: collect_dde_work

contains

   !> All tests of this suite.
   subroutine collect_dde_work(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("three methods in turn", test_methods), &
                   new_unittest("linear systems", test_operations), &
                   new_unittest("of a run", test_run)]
   end subroutine collect_dde_work

   !> Evaluations have the cost of the method that made them.
   subroutine test_methods(error)
      type(error_type), allocatable, intent(out) :: error
      type(work_type) :: work

      work = work_type(3)
      work%evaluations = 10
      call expect_close(error, work%total(), 10.0_wp, 0.0_wp, "explicit")
      call work%set_cost(4.0_wp)
      call expect_close(error, work%total(), 10.0_wp, 0.0_wp, "none by the second")
      work%evaluations = work%evaluations + 5
      call work%set_cost(1.0_wp)
      work%evaluations = work%evaluations + 7
      call expect_close(error, work%total(), 10.0_wp + 4*5.0_wp + 7.0_wp, 0.0_wp, "after the third")
   end subroutine test_methods

   !> An evaluation is worth a number of operations for each equation.
   subroutine test_operations(error)
      type(error_type), allocatable, intent(out) :: error
      type(work_type) :: work

      work = work_type(3)
      work%evaluations = 2
      work%operations = 3*operations_of_evaluation
      call expect_close(error, work%total(), 3.0_wp, 0.0_wp, "two evaluations and a system")
   end subroutine test_operations

   !> By the explicit pair the work is the number of evaluations, by the implicit method more, and
   !> only that factorises.
   subroutine test_run(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(sine(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "explicit"), outcome, failure)
      call expect_success(error, failure)
      call expect_close(error, outcome%work, real(outcome%evaluations, wp), 0.0_wp, "explicit")
      call expect(error, outcome%factorisations == 0, "no factorisation")
      call integrate(sine(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "radau5"), outcome, failure)
      call expect_success(error, failure)
      call expect(error, outcome%work > 4.0_wp*outcome%evaluations, "implicit, with its systems")
      call expect(error, outcome%factorisations > 0, "factorisations")
   end subroutine test_run
end module test_dde_work
