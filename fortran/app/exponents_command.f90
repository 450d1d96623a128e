! SPDX-License-Identifier: BSD-3-Clause
!> Lyapunov exponents of one scene, at its own tolerance, at others, and with shorter steps.
module exponents_command
   use dde, only: integration_options
   use dde_errors, only: error_type
   use exponents_files, only: exponents_settings_type, read_exponents, write_exponents
   use lyapunov_spectrum, only: expect_smooth, growth_settings_type, growth_type, measure_growth
   use progress, only: progress_type
   use rest, only: judge_flow
   use scene_input, only: scene_type
   implicit none (type, external)
   private
   public :: run_exponents

contains

   !> Run the command.
   subroutine run_exponents(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(exponents_settings_type) :: settings
      type(growth_type), allocatable :: measured(:)
      type(integration_options), allocatable :: options(:)
      type(progress_type) :: report
      type(scene_type) :: scene
      integer :: i
      logical :: neutral

      call read_exponents(namelist_path, scene, settings, error)
      if (.not. allocated(error)) call expect_smooth(scene%problem, error)
      if (allocated(error)) return
      options = settings%options_of_runs(scene%options())
      allocate (measured(size(options)))
      call judge_flow(scene%problem, scene%t_transient, settings%t_end, options(1), neutral, error)
      if (allocated(error)) return
      report = progress_type("exponents of "//trim(scene%name), parts=size(options))
      do i = 1, size(options)
         call report%begin_part(i)
         call measure_growth(scene%problem, &
                             growth_settings_type(settings%count, scene%t_transient, &
                                                  settings%t_end, settings%t_turning, &
                                                  settings%interval, settings%batches, &
                                                  across_flow=neutral .and. settings%count > 1), &
                             options(i), measured(i), error, progress=report)
         if (allocated(error)) return
      end do
      call write_exponents(output_path, scene, settings, options, measured, error)
   end subroutine run_exponents
end module exponents_command
