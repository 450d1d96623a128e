! SPDX-License-Identifier: BSD-3-Clause
!> Growth of tangent vectors and Lyapunov exponents of a problem, in one call, and a receiver that
!> keeps the progress reported to it.
module exponent_runs
   use dde, only: continuation_type, dde_problem_type, integration_options
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_success
   use exponent_averages, only: average_growth, exponent_type
   use lyapunov_spectrum, only: growth_settings_type, growth_type, interval_observer_type, &
                                measure_growth
   use mctc_env_testing, only: error_type
   use progress_receiver, only: progress_receiver_type
   implicit none (type, external)
   private
   public :: find_exponents, measure, recorder

   !> Reports, call by call.
   type, extends(progress_receiver_type) :: recorder
      !> Pieces done, and pieces in all
      integer, allocatable :: done(:), total(:)
   contains
      procedure :: advance
   end type recorder

contains

   !> Keep a report.
   subroutine advance(self, done, total)
      class(recorder), intent(inout) :: self
      integer, intent(in) :: done, total

      if (.not. allocated(self%done)) allocate (self%done(0), self%total(0))
      self%done = [self%done, done]
      self%total = [self%total, total]
   end subroutine advance

   !> Exponents, and the growth from which they are.
   subroutine find_exponents(problem, settings, options, exponents, error, measured)
      class(dde_problem_type), intent(in) :: problem
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      type(exponent_type), allocatable, intent(out) :: exponents(:)
      type(error_type), allocatable, intent(inout) :: error
      type(growth_type), intent(out) :: measured

      allocate (exponents(0))
      call measure(error, problem, settings, options, measured)
      if (allocated(error)) return
      exponents = average_growth(measured%growth, measured%length, settings%batches, &
                                 settings%across_flow)
      call expect(error, size(exponents) == settings%exponents, "as many exponents as asked for")
   end subroutine find_exponents

   !> Growth that must be measured.
   subroutine measure(error, problem, settings, options, measured, arrived, progress, observer)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: problem
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      type(growth_type), intent(out) :: measured
      type(continuation_type), intent(in), optional :: arrived
      class(progress_receiver_type), intent(inout), optional :: progress
      class(interval_observer_type), intent(inout), optional :: observer
      type(failure_type), allocatable :: failure

      if (allocated(error)) return
      call measure_growth(problem, settings, options, measured, failure, arrived, progress, &
                          observer)
      call expect_success(error, failure)
   end subroutine measure
end module exponent_runs
