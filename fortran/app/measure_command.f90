!> Measured runs: cases solved by several methods at several tolerances, with what each run gave and
!> what it cost. A run that fails is a row with its reason.
module measure_command
   use dde_errors, only: error_type
   use measure_files, only: measure_settings_type, measured_runs_type, read_measure, &
                            write_measured_runs
   use dde_kinds, only: wp
   use measured_case, only: case_type
   use measured_run, only: measure_run, time_runs
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
      type(measured_runs_type), allocatable :: measured(:)
      type(progress_type) :: report
      integer :: i, j

      call read_measure(namelist_path, cases, settings, error)
      if (allocated(error)) return
      allocate (measured(size(cases)))
      report = progress_type("measured runs", parts=2*size(cases))
      do i = 1, size(cases)
         call report%begin_part(2*i - 1)
         measured(i)%case = cases(i)
         measured(i)%runs = settings%runs()
         do j = 1, size(measured(i)%runs)
            call measure_run(cases(i), 0.0_wp, settings%most_steps, measured(i)%runs(j))
            call report%advance(j, size(measured(i)%runs))
         end do
         call report%begin_part(2*i)
         call time_runs(cases(i), settings%most_steps, settings%repeats, settings%least_seconds, &
                        measured(i)%runs, report)
      end do
      call write_measured_runs(output_path, measured, error)
   end subroutine run_measure
end module measure_command
