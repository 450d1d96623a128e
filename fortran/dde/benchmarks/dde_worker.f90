! SPDX-License-Identifier: BSD-3-Clause
!> One scene in this solver (workers.py). Arguments: the method and, for a problem without its
!> Taylor series, "rhs".
program dde_worker
   use block_problem, only: spring_block
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use worker_protocol, only: answer_requests, epsilon, gamma, past, sample_time, samples, t_end, &
                              tau, xi
   implicit none (type, external)
   character(len=8) :: arguments(2)

   call get_command_argument(1, arguments(1))
   call get_command_argument(2, arguments(2))
   call answer_requests(DDE_VERSION, integrate_once)

contains

   !> Integrate the block once.
   subroutine integrate_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer :: i
      type(error_type), allocatable :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(spring_block) :: problem
      type(table_sampler) :: table

      problem = spring_block(tau, epsilon, xi, gamma, past)
      problem%analytic = arguments(2) /= "rhs"
      options = integration_options(method=arguments(1), relative=tolerance, absolute=tolerance)
      if (allocated(samples)) then
         table = table_sampler([1, 2, 3], [(sample_time(i), i=0, ubound(samples, 2))])
         call integrate(problem, 0.0_wp, t_end, options, outcome, error, table)
         samples = table%values
      else
         call integrate(problem, 0.0_wp, t_end, options, outcome, error)
      end if
      if (allocated(error)) failure = error%message
   end subroutine integrate_once
end program dde_worker
