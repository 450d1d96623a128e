!> What the solver refuses before it starts, and that its message names the value met.
module test_dde_refusals
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
   use dde, only: integrate, integration_options, integration_result, refused, table_sampler
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use test_problems, only: wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_refusals

contains

   !> All tests of this suite.
   subroutine collect_dde_refusals(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("nothing to refuse", test_good), &
                   new_unittest("problems", test_problems), &
                   new_unittest("ends", test_ends), &
                   new_unittest("options", test_options)]
   end subroutine collect_dde_refusals

   !> What the other tests spoil is accepted as it stands.
   subroutine test_good(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome

      call integrate(good(), 1.0_wp, 2.0_wp, options, outcome, failure)
      call expect_success(error, failure)
      options%method = "explicit"
      options%relative = 0.0_wp
      call integrate(good(), 1.0_wp, 2.0_wp, options, outcome, failure)
      call expect_success(error, failure)
   end subroutine test_good

   !> At least one equation; delays that are positive numbers, each of one component.
   subroutine test_problems(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      problem%n = -3
      call refuse_problem(error, problem, "n = -3 equations")
      problem%n = 0
      call refuse_problem(error, problem, "n = 0 equations")
      problem = good()
      deallocate (problem%lag)
      call refuse_problem(error, problem, "not allocated")
      problem = good()
      deallocate (problem%component)
      call refuse_problem(error, problem, "not allocated")
      call refuse_problem(error, good([1.0_wp, 0.2_wp, 0.5_wp]), &
                          "3 delays for 2 delayed components")
      call refuse_problem(error, good([1.0_wp, 0.0_wp]), "lag(2) = 0.0")
      call refuse_problem(error, good([1.0_wp, -1.5_wp]), "lag(2) = -1.5")
      call refuse_problem(error, good([not_a_number(), 1.0_wp]), "lag(1) = NaN")
      call refuse_problem(error, good([infinity(), 1.0_wp]), "lag(1) = Inf")
      call refuse_problem(error, good(component=[0, 2]), "component(1) = 0; 1..3 expected")
      call refuse_problem(error, good(component=[1, 4]), "component(2) = 4; 1..3 expected")
   end subroutine test_problems

   !> The end is a finite number after the start, and the start is finite.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options

      call expect_refusal(error, good(), 1.0_wp, 0.5_wp, options, "t_end = 0.5")
      call expect_refusal(error, good(), 1.0_wp, not_a_number(), options, "t_end = NaN")
      call expect_refusal(error, good(), 1.0_wp, infinity(), options, "t_end = Inf")
      call expect_refusal(error, good(), not_a_number(), 2.0_wp, options, ">= NaN")
      call expect_refusal(error, good(), -infinity(), 2.0_wp, options, ">= -Inf")
   end subroutine test_ends

   !> Tolerances, limits and the method are in their ranges.
   subroutine test_options(error)
      type(error_type), allocatable, intent(out) :: error

      call refuse(error, integration_options(relative=-0.5_wp), "relative = -0.5")
      call refuse(error, integration_options(relative=not_a_number()), "relative = NaN")
      call refuse(error, integration_options(relative=infinity()), "relative = Inf")
      call refuse(error, integration_options(absolute=0.0_wp), "absolute = 0.0")
      call refuse(error, integration_options(absolute=-2.0_wp), "absolute = -2.0")
      call refuse(error, integration_options(absolute=not_a_number()), "absolute = NaN")
      call refuse(error, integration_options(absolute=infinity()), "absolute = Inf")
      call refuse(error, integration_options(first_step=-0.5_wp), "first_step = -0.5")
      call refuse(error, integration_options(first_step=not_a_number()), "first_step = NaN")
      call refuse(error, integration_options(longest_step=0.0_wp), "longest_step = 0.0")
      call refuse(error, integration_options(longest_step=-1.0_wp), "longest_step = -1.0")
      call refuse(error, integration_options(longest_step=not_a_number()), "longest_step = NaN")
      call refuse(error, integration_options(past_kept=-0.5_wp), "past_kept = -0.5")
      call refuse(error, integration_options(past_kept=infinity()), "past_kept = Inf")
      call refuse(error, integration_options(method="euler"), "method = 'euler'; one of auto, " &
                  //"explicit, taylor, radau5, radau9, radau13 expected")
   end subroutine test_options

   !> A problem is refused in these words.
   subroutine refuse_problem(error, problem, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      type(wille_baker), intent(in) :: problem
      !> Part of the message
      character(len=*), intent(in) :: words

      call expect_refusal(error, problem, 1.0_wp, 2.0_wp, integration_options(), words)
   end subroutine refuse_problem

   !> Options are refused in these words.
   subroutine refuse(error, options, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Part of the message
      character(len=*), intent(in) :: words

      call expect_refusal(error, good(), 1.0_wp, 2.0_wp, options, words)
   end subroutine refuse

   !> A run is refused in these words, and takes no sample.
   subroutine expect_refusal(error, problem, t_start, t_end, options, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      type(wille_baker), intent(in) :: problem
      !> Initial and final time
      real(wp), intent(in) :: t_start, t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Part of the message
      character(len=*), intent(in) :: words
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(table_sampler) :: table

      table = table_sampler([1], [1.0_wp])
      call integrate(problem, t_start, t_end, options, outcome, failure, table)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
      call expect(error, table%received == 0, "no sample is taken")
   end subroutine expect_refusal

   !> A problem with nothing to refuse but what is given.
   pure type(wille_baker) function good(lag, component) result(problem)
      !> Delays
      real(wp), intent(in), optional :: lag(:)
      !> Their components
      integer, intent(in), optional :: component(:)

      problem = wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], &
                            past=[1.0_wp, 1.0_wp, 1.0_wp], first=[1.0_wp, 1.0_wp, 1.0_wp])
      if (present(lag)) problem%lag = lag
      if (present(component)) problem%component = component
   end function good

   !> No number.
   pure real(wp) function not_a_number() result(value)
      value = ieee_value(value, ieee_quiet_nan)
   end function not_a_number

   !> Beyond all numbers.
   pure real(wp) function infinity() result(value)
      value = ieee_value(value, ieee_positive_inf)
   end function infinity
end module test_dde_refusals
