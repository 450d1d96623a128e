! SPDX-License-Identifier: BSD-3-Clause
!> The program in quadruple precision: `spring_block_quad reference NAMELIST OUTPUT`.
program spring_block_quad
   use program_arguments, only: command_type, run_command
   use reference_command, only: run_reference
   implicit none (type, external)

   call run_command([command_type("reference", run_reference, &
                                  "Reference solutions with their uncertainty")])
end program spring_block_quad
