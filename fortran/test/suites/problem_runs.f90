!> Runs that must not fail.
module problem_runs
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, table_sampler
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect_success
   use mctc_env_testing, only: error_type
   implicit none (type, external)
   private
   public :: run

contains

   !> Integrate from 0, or from where an earlier run ended.
   subroutine run(problem, t_end, options, outcome, error, samples, events, continuation)
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_end
      type(integration_options), intent(in) :: options
      type(integration_result), intent(out) :: outcome
      type(error_type), allocatable, intent(inout) :: error
      type(table_sampler), intent(inout), optional :: samples
      type(event_table), intent(inout), optional :: events
      type(continuation_type), intent(inout), optional :: continuation
      type(failure_type), allocatable :: failure
      real(wp) :: start

      start = 0.0_wp
      if (present(continuation)) start = continuation%time(1)
      call integrate(problem, start, t_end, options, outcome, failure, samples, events, &
                     continuation)
      call expect_success(error, failure)
   end subroutine run
end module problem_runs
