!> Lyapunov exponents of a problem, in one call.
module exponent_runs
   use dde, only: continuation_type, dde_problem_type, integration_options
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_success
   use exponent_averages, only: average_growth, exponent_type
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use mctc_env_testing, only: error_type
   implicit none (type, external)
   private
   public :: find_exponents

contains

   !> Exponents, from an earlier run where it is given.
   subroutine find_exponents(problem, settings, options, exponents, error, measured, arrived)
      class(dde_problem_type), intent(in) :: problem
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      type(exponent_type), allocatable, intent(out) :: exponents(:)
      type(error_type), allocatable, intent(inout) :: error
      type(growth_type), intent(out), optional :: measured
      type(continuation_type), intent(in), optional :: arrived
      type(failure_type), allocatable :: failure
      type(growth_type) :: found

      allocate (exponents(0))
      if (allocated(error)) return
      call measure_growth(problem, settings, options, found, failure, arrived)
      call expect_success(error, failure)
      if (allocated(error)) return
      exponents = average_growth(found%growth, found%length, settings%blocks, settings%across_flow)
      call expect(error, size(exponents) == settings%exponents, "as many exponents as asked for")
      if (present(measured)) measured = found
   end subroutine find_exponents
end module exponent_runs
