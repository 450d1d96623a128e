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
                   new_unittest("number of equations", test_equations), &
                   new_unittest("delays not set", test_not_allocated), &
                   new_unittest("as many delays as components", test_sizes), &
                   new_unittest("delays", test_delays), &
                   new_unittest("delays without a number", test_delays_not_finite), &
                   new_unittest("delayed components", test_components), &
                   new_unittest("end", test_end), &
                   new_unittest("ends without a number", test_end_not_finite), &
                   new_unittest("tolerances", test_tolerances), &
                   new_unittest("tolerances without a number", test_tolerances_not_finite), &
                   new_unittest("first step", test_first_step), &
                   new_unittest("longest step", test_longest_step), &
                   new_unittest("past that is kept", test_past_kept), &
                   new_unittest("method", test_method)]
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

   !> At least one equation.
   subroutine test_equations(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      problem%n = 0
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "n = 0 equations")
      problem%n = -3
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "n = -3 equations")
   end subroutine test_equations

   !> Delays and components that were never set.
   subroutine test_not_allocated(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      deallocate (problem%lag)
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "not allocated")
      problem = good()
      deallocate (problem%component)
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "not allocated")
   end subroutine test_not_allocated

   !> Each delay belongs to one component.
   subroutine test_sizes(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      problem%lag = [1.0_wp, 0.2_wp, 0.5_wp]
      call expect_refusal(error, problem, 2.0_wp, integration_options(), &
                          "3 delays for 2 delayed components")
   end subroutine test_sizes

   !> Delays are positive.
   subroutine test_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      problem%lag(2) = 0.0_wp
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "lag(2) = 0.0")
      problem%lag(2) = -1.5_wp
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "lag(2) = -1.5")
   end subroutine test_delays

   !> Delays are finite numbers.
   subroutine test_delays_not_finite(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      problem%lag = not_a_number()
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "lag(1) = NaN")
      problem%lag = infinity()
      call expect_refusal(error, problem, 2.0_wp, integration_options(), "lag(1) = Inf")
   end subroutine test_delays_not_finite

   !> Delayed components are components.
   subroutine test_components(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = good()
      problem%component(1) = 0
      call expect_refusal(error, problem, 2.0_wp, integration_options(), &
                          "component(1) = 0; 1..3 expected")
      problem%component = [1, 4]
      call expect_refusal(error, problem, 2.0_wp, integration_options(), &
                          "component(2) = 4; 1..3 expected")
   end subroutine test_components

   !> The end lies after the start, which is at 1 here.
   subroutine test_end(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 0.5_wp, integration_options(), "t_end = 0.5")
      call expect_refusal(error, good(), -7.0_wp, integration_options(), "t_end = -7.0")
   end subroutine test_end

   !> The end is a finite number, and so is the start.
   subroutine test_end_not_finite(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), not_a_number(), integration_options(), "t_end = NaN")
      call expect_refusal(error, good(), infinity(), integration_options(), "t_end = Inf")
      call expect_refusal(error, good(), 2.0_wp, integration_options(), ">= NaN", not_a_number())
      call expect_refusal(error, good(), 2.0_wp, integration_options(), ">= -Inf", -infinity())
   end subroutine test_end_not_finite

   !> Tolerances: relative >= 0, absolute > 0.
   subroutine test_tolerances(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 2.0_wp, integration_options(relative=-0.5_wp), &
                          "relative = -0.5")
      call expect_refusal(error, good(), 2.0_wp, integration_options(absolute=0.0_wp), &
                          "absolute = 0.0")
      call expect_refusal(error, good(), 2.0_wp, integration_options(absolute=-2.0_wp), &
                          "absolute = -2.0")
   end subroutine test_tolerances

   !> Tolerances are numbers.
   subroutine test_tolerances_not_finite(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 2.0_wp, integration_options(relative=not_a_number()), &
                          "relative = NaN")
      call expect_refusal(error, good(), 2.0_wp, integration_options(absolute=not_a_number()), &
                          "absolute = NaN")
      call expect_refusal(error, good(), 2.0_wp, integration_options(relative=infinity()), &
                          "relative = Inf")
      call expect_refusal(error, good(), 2.0_wp, integration_options(absolute=infinity()), &
                          "absolute = Inf")
   end subroutine test_tolerances_not_finite

   !> The first step is a number and not negative.
   subroutine test_first_step(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 2.0_wp, integration_options(first_step=-0.5_wp), &
                          "first_step = -0.5")
      call expect_refusal(error, good(), 2.0_wp, integration_options(first_step=not_a_number()), &
                          "first_step = NaN")
   end subroutine test_first_step

   !> The longest step is positive.
   subroutine test_longest_step(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 2.0_wp, integration_options(longest_step=0.0_wp), &
                          "longest_step = 0.0")
      call expect_refusal(error, good(), 2.0_wp, integration_options(longest_step=-1.0_wp), &
                          "longest_step = -1.0")
      call expect_refusal(error, good(), 2.0_wp, integration_options(longest_step=not_a_number()), &
                          "longest_step = NaN")
   end subroutine test_longest_step

   !> The past that is kept is finite and not negative.
   subroutine test_past_kept(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 2.0_wp, integration_options(past_kept=-0.5_wp), &
                          "past_kept = -0.5")
      call expect_refusal(error, good(), 2.0_wp, integration_options(past_kept=infinity()), &
                          "past_kept = Inf")
   end subroutine test_past_kept

   !> The method is one of those there are.
   subroutine test_method(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, good(), 2.0_wp, integration_options(method="euler"), &
                          "method = 'euler'; one of auto, explicit, taylor, radau5, radau9, " &
                          //"radau13 expected")
   end subroutine test_method

   !> The run is refused in these words, and takes no sample.
   subroutine expect_refusal(error, problem, t_end, options, words, t_start)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      type(wille_baker), intent(in) :: problem
      !> Final time
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Part of the message
      character(len=*), intent(in) :: words
      !> Initial time; 1 if not given
      real(wp), intent(in), optional :: t_start
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(table_sampler) :: table
      real(wp) :: first

      first = 1.0_wp
      if (present(t_start)) first = t_start
      table = table_sampler([1], [1.0_wp])
      call integrate(problem, first, t_end, options, outcome, failure, table)
      call expect_failure(error, failure, words)
      call expect(error, outcome%reason == refused, "the reason is `refused`")
      call expect(error, table%received == 0, "no sample is taken")
   end subroutine expect_refusal

   !> A problem with nothing to refuse.
   pure type(wille_baker) function good() result(problem)
      problem = wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], &
                            past=[1.0_wp, 1.0_wp, 1.0_wp], first=[1.0_wp, 1.0_wp, 1.0_wp])
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
