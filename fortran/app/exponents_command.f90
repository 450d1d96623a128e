!> Lyapunov exponents of one scene, at its own tolerance, at others, and with shorter steps.
module exponents_command
   use dde, only: integration_options
   use dde_errors, only: error_type
   use exponents_files, only: exponents_settings_type, read_exponents, write_exponents
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use model_history, only: history_type
   use model_problem, only: model_type
   use program_arguments, only: stop_on
   use progress, only: progress_type
   use rest, only: comes_to_rest
   use scene_input, only: scene_type
   implicit none (type, external)
   private
   public :: run_exponents

contains

   !> Lyapunov exponents of one scene, at its own tolerance, at others, and with shorter steps.
   subroutine run_exponents(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(history_type) :: history
      type(error_type), allocatable :: error
      type(exponents_settings_type) :: settings
      type(growth_type), allocatable :: measured(:)
      type(integration_options), allocatable :: options(:)
      type(progress_type) :: report
      type(scene_type) :: scene
      type(model_type) :: model
      integer :: i
      logical :: at_rest ! where no exponent is that of the flow

      call read_exponents(namelist_path, scene, model, history, settings, error)
      call stop_on(error)
      options = settings%options_of_runs(scene%options())
      allocate (measured(size(options)))
      call comes_to_rest(model, scene%t_transient, settings%t_end, options(1), at_rest, error)
      call stop_on(error)
      report = progress_type("exponents of "//trim(scene%name), parts=size(options))
      do i = 1, size(options)
         call report%begin_part(i)
         call measure_growth(model, &
                             growth_settings_type(settings%count, scene%t_transient, &
                                                  settings%t_end, settings%t_turning, &
                                                  settings%interval, settings%batches, &
                                                  across_flow=.not. at_rest), &
                             options(i), measured(i), error, progress=report)
         if (allocated(error)) exit
      end do
      call stop_on(error)
      call write_exponents(output_path, scene, model, history, settings, options, measured, error)
      call stop_on(error)
   end subroutine run_exponents
end module exponents_command
