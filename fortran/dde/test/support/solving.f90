! SPDX-License-Identifier: BSD-3-Clause
!> Runs of the solver that tests compare with what is known.
module solving
   use dde, only: continuation_type, dde_problem_type, event_watcher_type, integrate, &
                  integration_options, integration_result, sampler_type, table_sampler
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type
   implicit none (type, external)
   private
   public :: at_tolerance, run, solve

contains

   !> Options for relative and absolute tolerance alike.
   pure type(integration_options) function at_tolerance(tolerance, method) result(options)
      !> Relative and absolute tolerance
      real(wp), intent(in) :: tolerance
      !> Method; the explicit pair of order 8 if not given
      character(len=*), intent(in), optional :: method

      options%method = "dop853"
      if (present(method)) options%method = method
      options%relative = tolerance
      options%absolute = tolerance
   end function at_tolerance

   !> Integrate to a good end.
   subroutine run(error, problem, t_start, t_end, options, outcome, sampler, watcher, continuation)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_start, t_end
      type(integration_options), intent(in) :: options
      type(integration_result), intent(out) :: outcome
      class(sampler_type), intent(inout), optional :: sampler
      class(event_watcher_type), intent(inout), optional :: watcher
      type(continuation_type), intent(inout), optional :: continuation
      type(failure_type), allocatable :: failure

      call integrate(problem, t_start, t_end, options, outcome, failure, sampler, watcher, &
                     continuation)
      call expect_success(error, failure)
      ! a test compares it after a failure, too
      if (.not. allocated(outcome%y)) allocate (outcome%y(0))
   end subroutine run

   !> All components at given times from dense output, from t = 0 to the last of them.
   subroutine solve(problem, time, options, values, error)
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: time(:)
      type(integration_options), intent(in) :: options
      real(wp), allocatable, intent(out) :: values(:, :)
      type(error_type), allocatable, intent(inout) :: error
      type(integration_result) :: outcome
      type(table_sampler) :: table
      integer :: i

      table = table_sampler([(i, i=1, problem%n)], time)
      call run(error, problem, 0.0_wp, time(size(time)), options, outcome, table)
      values = table%values
   end subroutine solve
end module solving
