! SPDX-License-Identifier: BSD-3-Clause
!> CPU time of a chain of blocks (chain_of_blocks) per unit of time and block. Arguments: number of
!> blocks, gamma, tolerance, method, end of the run; optional: relative spread of the delays, 1 for
!> a problem with Taylor series or 0, 1 for a banded Jacobian or 0, delay.
program chain_costs
   use chain_of_blocks, only: chain
   use dde, only: integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   implicit none (type, external)
   character(len=32) :: argument(9)
   integer :: blocks, i
   real(wp) :: finish, gamma, spread, start, t_end, tau, tolerance
   type(chain) :: problem
   type(error_type), allocatable :: error
   type(integration_options) :: options
   type(integration_result) :: outcome

   argument(6:) = [character(len=32) :: "0", "1", "1", "10"]
   if (command_argument_count() < 5) then
      error stop "chain_costs BLOCKS GAMMA TOLERANCE METHOD T_END [SPREAD [SERIES [BAND [DELAY]]]]"
   end if
   do i = 1, command_argument_count()
      call get_command_argument(i, argument(i))
   end do
   read (argument(1), *) blocks
   read (argument(2), *) gamma
   read (argument(3), *) tolerance
   read (argument(5), *) t_end
   read (argument(6), *) spread
   read (argument(9), *) tau
   problem = chain(blocks, gamma=gamma, tau=tau, spread=spread)
   problem%analytic = argument(7) == "1"
   if (argument(8) == "1") then
      problem%lower = 4
      problem%upper = 3
   end if
   options = integration_options(method=argument(4) (:8), relative=tolerance, absolute=tolerance)
   call cpu_time(start)
   call integrate(problem, 0.0_wp, t_end, options, outcome, error)
   call cpu_time(finish)
   if (allocated(error)) error stop "chain_costs: "//error%message
   print "(a, f0.2, a, i0, a, i0, a)", "microseconds per unit of time and block: ", &
      1.0e6_wp*(finish - start)/(t_end*blocks), "; steps: ", outcome%accepted, ", ", &
      outcome%switches, " changes of method"
end program chain_costs
