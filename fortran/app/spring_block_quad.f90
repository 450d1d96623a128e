! SPDX-License-Identifier: BSD-3-Clause
!> The program in quadruple precision: `spring_block_quad reference NAMELIST OUTPUT`.
program spring_block_quad
   use command, only: command_type
   use program_arguments, only: run_command
   use reference_command, only: run_reference
   use request, only: request_type
   use text_table, only: text_table_type
   implicit none (type, external)

   type(request_type) :: given
   type(text_table_type) :: data

   call run_command([command_type("reference", run_reference, &
                                  "Reference solutions with their uncertainty")], given, data)
end program spring_block_quad
