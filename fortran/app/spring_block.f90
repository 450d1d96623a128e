! SPDX-License-Identifier: BSD-3-Clause
!> The program: `spring_block COMMAND NAMELIST OUTPUT`. Each command is a file in `commands/`.
program spring_block_program
   use all_commands, only: list_commands
   use fftw_transform, only: transform_by_fftw
   use file_request, only: file_request_type
   use fourier_transform, only: transform_real
   use gsl_distribution, only: quantile_by_gsl
   use output_file, only: output_file_type
   use program_arguments, only: run_command
   use student_distribution, only: student_quantile
   implicit none (type, external)

   type(file_request_type) :: given
   type(output_file_type) :: data

   transform_real => transform_by_fftw
   student_quantile => quantile_by_gsl
   call run_command(list_commands(), given, data)
end program spring_block_program
