!> Lyapunov exponents of one scene, at its own tolerance, at others, and with shorter steps.
module exponents_command
   use block_parameters, only: block_history_type
   use dde, only: integration_options
   use dde_errors, only: error_type
   use exponents_files, only: exponents_settings_type, read_exponents, write_exponents
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use program_arguments, only: stop_on
   use progress, only: progress_type
   use scene_input, only: read_histories, scene_type
   use spring_block, only: spring_block_type
   use steady_sliding, only: comes_to_rest
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
      type(block_history_type), allocatable :: histories(:)
      type(error_type), allocatable :: error
      type(exponents_settings_type) :: settings
      type(growth_type), allocatable :: measured(:)
      type(integration_options), allocatable :: options(:)
      type(progress_type) :: report
      type(scene_type) :: scene
      type(spring_block_type) :: block_model
      integer :: i
      logical :: rest ! where no exponent is that of the flow

      call read_exponents(namelist_path, scene, settings, error)
      call stop_on(error)
      call read_histories(namelist_path, scene, histories, error)
      call stop_on(error)
      block_model = spring_block_type(scene%parameters, histories)
      options = settings%options_of_runs(scene%options())
      allocate (measured(size(options)))
      call comes_to_rest(block_model, scene%t_transient, settings%t_end, options(1), rest, error)
      call stop_on(error)
      report = progress_type("exponents of "//trim(scene%name), parts=size(options))
      do i = 1, size(options)
         call report%begin_part(i)
         call measure_growth(block_model, &
                             growth_settings_type(settings%count, scene%t_transient, &
                                                  settings%t_end, settings%t_turning, &
                                                  settings%interval, settings%blocks, &
                                                  across_flow=.not. rest), &
                             options(i), measured(i), error, progress=report)
         if (allocated(error)) exit
      end do
      call stop_on(error)
      call write_exponents(output_path, scene, histories, settings, options, measured, error)
      call stop_on(error)
   end subroutine run_exponents
end module exponents_command
