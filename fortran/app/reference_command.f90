! SPDX-License-Identifier: BSD-3-Clause
!> Reference solutions of cases in quadruple precision, each with the evidence of its own
!> uncertainty and of how much the case magnifies a disturbance of its history.
module reference_command
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use measured_case, only: case_type
   use measured_run, only: measure_run, run_type
   use progress, only: progress_type
   use reference_files, only: read_reference, reference_file_type, reference_settings_type
   implicit none (type, external)
   private
   public :: run_reference

contains

   !> Run the command.
   subroutine run_reference(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(case_type), allocatable :: cases(:)
      type(progress_type) :: report
      type(reference_file_type) :: file
      type(reference_settings_type) :: settings
      type(run_type) :: best, checking, disturbed
      integer :: i

      call read_reference(namelist_path, cases, settings, error)
      if (allocated(error)) return
      call file%create(output_path, cases(1), error)
      if (allocated(error)) return
      associate (options => settings)
         best = run_type(trim(options%method), options%tolerance)
         disturbed = best
         checking = run_type(trim(options%check_method), options%check_tolerance)
         report = progress_type("references", parts=3*size(cases))
         do i = 1, size(cases)
            call report%begin_part(3*i - 2)
            call measure_run(cases(i), 0.0_wp, options%most_steps, best, report)
            call report%begin_part(3*i - 1)
            call measure_run(cases(i), 0.0_wp, options%most_steps, checking, report)
            call report%begin_part(3*i)
            call measure_run(cases(i), options%disturbance, options%most_steps, disturbed, report)
            call file%put(cases(i), options%disturbance, best, checking, disturbed)
         end do
      end associate
      call file%finish(error)
   end subroutine run_reference
end module reference_command
