! SPDX-License-Identifier: BSD-3-Clause
!> One problem in this solver (workers.py). Arguments: the method, and what the problem gives
!> besides f (peers.py).
program dde_worker
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use peer_problems, only: problem_of
   use test_problems, only: constant_past
   use worker_protocol, only: answer_requests, read_scene, sample_time, samples, t_end
   implicit none (type, external)
   character(len=16) :: arguments(2)
   class(constant_past), allocatable :: problem
   integer :: i

   do i = 1, size(arguments)
      call get_command_argument(i, arguments(i))
   end do
   call read_scene()
   call problem_of(trim(arguments(2)), problem)
   call answer_requests(DDE_VERSION, problem%n, integrate_once)

contains

   !> Integrate the problem once.
   subroutine integrate_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer :: i
      type(error_type), allocatable :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(table_sampler) :: table

      options = integration_options(method=arguments(1), relative=tolerance, absolute=tolerance)
      if (allocated(samples)) then
         table = table_sampler([(i, i=1, problem%n)], [(sample_time(i), i=0, ubound(samples, 2))])
         call integrate(problem, 0.0_wp, t_end, options, outcome, error, table)
         samples = table%values
      else
         call integrate(problem, 0.0_wp, t_end, options, outcome, error)
      end if
      if (allocated(error)) failure = error%message
   end subroutine integrate_once
end program dde_worker
