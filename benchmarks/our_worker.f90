!> One scene in the project's own solver (compare.py). Its arguments are the method and, for a
!> problem without its Taylor series, "rhs".
program our_worker
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   use version, only: project_version
   use worker_protocol, only: answer_requests, epsilon, gamma, past, sample_time, samples, t_end, &
                              tau, xi
   implicit none (type, external)
   character(len=8) :: arguments(2)

   call get_command_argument(1, arguments(1))
   call get_command_argument(2, arguments(2))
   call answer_requests(project_version, integrate_once)

contains

   !> Integrate the block once.
   subroutine integrate_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer :: i
      type(error_type), allocatable :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      type(table_sampler) :: table

      block_model = spring_block_type( &
                    block_parameters_type(tau=tau, epsilon=epsilon, xi=xi, gamma=gamma), &
                    block_history_type(theta=past(1), u=past(2), v=exp(past(3))))
      block_model%analytic = arguments(2) /= "rhs"
      options = integration_options(method=arguments(1), relative=tolerance, absolute=tolerance)
      if (allocated(samples)) then
         table = table_sampler([index_of_theta, index_of_u, index_of_ln_v], &
                               [(sample_time(i), i=0, ubound(samples, 2))])
         call integrate(block_model, 0.0_wp, t_end, options, outcome, error, table)
         samples = table%values
      else
         call integrate(block_model, 0.0_wp, t_end, options, outcome, error)
      end if
      if (allocated(error)) failure = error%message
   end subroutine integrate_once
end program our_worker
