! SPDX-License-Identifier: BSD-3-Clause
!> Errors of dense output on a layer (dense.py). Arguments: the method and the layer; parameters of
!> the task are rates. Each has a row: the largest errors at the ends of steps and between them, of
!> the component where the second exceeds the first, or the tolerance, by the largest factor.
program dense_worker
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: integration_options
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use layer_problems, only: layer, measure_errors, relaxation, solved
   use worker_protocol, only: answer_requests, parameters, read_task, samples, t_end
   implicit none (type, external)
   !> Share of a step between two samples
   real(wp), parameter :: between = 1.0_wp/16
   character(len=16) :: method, name

   call get_command_argument(1, method)
   call get_command_argument(2, name)
   call read_task()
   call answer_requests(DDE_VERSION, 1, measure_all)

contains

   !> Both errors at all rates; not a number where a run failed.
   subroutine measure_all(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer :: i, worst
      real(wp), allocatable :: at_steps(:), within(:)
      type(error_type), allocatable :: error
      class(solved), allocatable :: problem
      type(integration_options) :: options

      options = integration_options(method=method, relative=tolerance, absolute=tolerance)
      ! as documented for a series, which shows no jump
      if (method == "taylor" .and. name == "switch") options%break_at = [1.0_wp]
      deallocate (samples)
      allocate (samples(2, size(parameters)), source=ieee_value(tolerance, ieee_quiet_nan))
      do i = 1, size(parameters)
         call set_problem(parameters(i), problem)
         call measure_errors(problem, t_end, options, 1.0_wp, at_steps, error)
         if (allocated(error)) cycle
         call measure_errors(problem, t_end, options, between, within, error)
         if (allocated(error)) cycle
         worst = maxloc(within/max(at_steps, tolerance), dim=1)
         samples(:, i) = [at_steps(worst), within(worst)]
      end do
   end subroutine measure_all

   !> The layer with a rate.
   subroutine set_problem(rate, problem)
      real(wp), intent(in) :: rate
      class(solved), allocatable, intent(out) :: problem

      select case (name)
      case ("decay")
         problem = relaxation(rate)
      case ("switch")
         problem = relaxation(rate, 1.0_wp)
      case ("pulse")
         problem = layer(rate)
      case default
         problem = layer(rate, 0.5_wp)
      end select
      problem%analytic = method == "taylor"
   end subroutine set_problem
end program dense_worker
