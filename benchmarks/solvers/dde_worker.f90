! SPDX-License-Identifier: BSD-3-Clause
!> One problem in this solver (workers.py). Arguments: the method, and what the problem gives
!> besides f. If the method is `f`, f is evaluated again and again. Without an interval its row are
!> accepted steps, all steps and evaluations.
program dde_worker
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use peer_problems, only: breaks, finest, moves, prepare, problem, units
   use worker_protocol, only: answer_requests, interval, samples, t_end
   implicit none (type, external)
   character(len=16) :: arguments(2)
   integer :: i

   do i = 1, size(arguments)
      call get_command_argument(i, arguments(i))
   end do
   call prepare(trim(arguments(2)))
   call answer_requests(DDE_VERSION, problem%n, run_once)

contains

   !> Integrate the problem once.
   subroutine run_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer :: i
      type(error_type), allocatable :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(table_sampler) :: table

      options = integration_options(method=arguments(1), relative=tolerance, absolute=tolerance)
      if (moves) then
         options%break_at = breaks
         options%each_absolute = tolerance*finest
      end if
      if (arguments(1) == "f") then
         call evaluate([(1.0_wp, i=1, problem%n)], [(1.0_wp, i=1, size(problem%lag))], &
                       outcome%evaluations)
      else if (allocated(samples) .and. interval > 0.0_wp) then
         table = table_sampler([(i, i=1, problem%n)], samples(0, :))
         call integrate(problem, 0.0_wp, t_end, options, outcome, error, table)
         samples(1:, :) = table%values/spread(units, 2, size(samples, 2))
      else
         call integrate(problem, 0.0_wp, t_end, options, outcome, error)
      end if
      if (allocated(samples) .and. .not. interval > 0.0_wp) then
         associate (steps => outcome%accepted + outcome%rejected)
            samples = reshape(1.0_wp*[outcome%accepted, steps, outcome%evaluations], [3, 1])
         end associate
      end if
      if (allocated(error)) failure = error%message
   end subroutine run_once

   !> Evaluate f so often that it takes some time, and say how often.
   subroutine evaluate(state, z, times)
      real(wp), intent(in) :: state(:), z(:)
      integer(int64), intent(out) :: times
      real(wp) :: slope(size(state)), y(size(state))
      integer(int64) :: i

      y = state
      times = max(10, 100000/(size(state) + size(z)))
      do i = 1, times
         call problem%rhs(0.0_wp, y, z, slope)
         y = y + 1.0e-3_wp*slope
      end do
      if (.not. abs(sum(y)) < huge(y)) error stop "dde_worker: f is not finite"
   end subroutine evaluate
end program dde_worker
