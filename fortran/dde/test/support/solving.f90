!> Runs of the solver that tests compare with what is known.
module solving
   use dde, only: dde_problem_type, integrate, integration_options, integration_result, &
                  table_sampler
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type
   implicit none (type, external)
   private
   public :: at_tolerance, solve

contains

   !> Options for relative and absolute tolerance alike.
   pure type(integration_options) function at_tolerance(tolerance, method) result(options)
      !> Relative and absolute tolerance
      real(wp), intent(in) :: tolerance
      !> Method; the explicit one if not given
      character(len=*), intent(in), optional :: method

      options%method = "explicit"
      if (present(method)) options%method = method
      options%relative = tolerance
      options%absolute = tolerance
   end function at_tolerance

   !> All components at given times from dense output, from t = 0 to the last of them.
   subroutine solve(problem, time, options, values, error)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Times, ascending
      real(wp), intent(in) :: time(:)
      !> Tolerances and limits
      type(integration_options), intent(in) :: options
      !> Solution, shape (n, times)
      real(wp), allocatable, intent(out) :: values(:, :)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(integration_result) :: outcome
      type(failure_type), allocatable :: failure
      type(table_sampler) :: table
      integer :: i

      table = table_sampler([(i, i=1, problem%n)], time)
      call integrate(problem, 0.0_wp, time(size(time)), options, outcome, failure, table)
      values = table%values
      call expect_success(error, failure)
   end subroutine solve
end module solving
