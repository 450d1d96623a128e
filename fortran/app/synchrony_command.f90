!> The growth of disturbances of chains that move as one block, by the stiffness of their modes.
module synchrony_command
   use dde_errors, only: error_type
   use lyapunov_spectrum, only: growth_settings_type
   use model_history, only: history_type
   use model_problem, only: model_type
   use program_arguments, only: stop_on
   use progress, only: progress_type
   use scene_input, only: scene_type
   use synchrony_files, only: read_synchrony, synchrony_settings_type, write_synchrony
   use transverse_growth, only: find_zeros, measure_transverse_growth, transverse_growth_type, &
                                zero_type
   use transverse_multipliers, only: find_transverse_cycle, transverse_cycle_type
   implicit none (type, external)
   private
   public :: run_synchrony

contains

   !> The growth of disturbances of chains that move as one block, by the stiffness of their modes.
   subroutine run_synchrony(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      !> Parts of the way between two values of s for multipliers, which cost less
      integer, parameter :: parts = 10

      type(error_type), allocatable :: error
      type(growth_settings_type) :: how
      type(progress_type) :: report
      type(history_type) :: history
      type(model_type) :: model
      type(scene_type) :: scene
      type(synchrony_settings_type) :: settings
      type(transverse_cycle_type) :: on_cycle
      type(transverse_growth_type), allocatable :: growth(:)
      type(zero_type), allocatable :: zeros(:)

      call read_synchrony(namelist_path, scene, model, history, settings, error)
      call stop_on(error)
      report = progress_type("synchrony of "//trim(scene%name))
      how = growth_settings_type(t_begin=scene%t_transient, t_end=settings%t_end, &
                                 t_turning=settings%t_turning, interval=settings%interval, &
                                 blocks=settings%batches)
      call measure_transverse_growth(model, settings%values(1), how, scene%options(), growth, &
                                     error, report)
      call stop_on(error)
      call find_zeros(model, how, scene%options(), growth, zeros, error)
      call stop_on(error)
      call find_transverse_cycle(model, settings%t_end, scene%options(), settings%values(parts), &
                                 on_cycle)
      call write_synchrony(output_path, scene, model, history, settings, growth, zeros, on_cycle, &
                           error)
      call stop_on(error)
   end subroutine run_synchrony
end module synchrony_command
