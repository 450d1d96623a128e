! SPDX-License-Identifier: BSD-3-Clause
!> Measured runs: cases solved by several methods at several tolerances, with what each run gave and
!> what it cost. A run that fails is a row with its reason.
module measure_command
   use dde_errors, only: error_type
   use measure_files, only: measure_settings_type, read_measure, write_measured_runs
   use dde_kinds, only: wp
   use measured_case, only: case_type
   use measured_run, only: measure_run, run_type, time_runs
   use progress, only: progress_type
   implicit none (type, external)
   private
   public :: run_measure

contains

   !> Run the command.
   subroutine run_measure(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(case_type), allocatable :: cases(:)
      type(measure_settings_type) :: settings
      type(progress_type) :: report
      type(run_type), allocatable :: runs(:)
      integer :: i, j, last, n

      call read_measure(namelist_path, cases, settings, error)
      if (allocated(error)) return
      n = size(settings%runs())
      allocate (runs(n*size(cases)))
      report = progress_type("measured runs", parts=2*size(cases))
      do i = 1, size(cases)
         call report%begin_part(2*i - 1)
         last = n*i
         runs(last - n + 1:last) = settings%runs()
         do j = 1, n
            call measure_run(cases(i), 0.0_wp, settings%most_steps, runs(last - n + j))
            call report%advance(j, n)
         end do
         call report%begin_part(2*i)
         call time_runs(cases(i), settings%most_steps, settings%repeats, settings%least_seconds, &
                        runs(last - n + 1:last), report)
      end do
      call write_measured_runs(output_path, cases, runs, error)
   end subroutine run_measure
end module measure_command
