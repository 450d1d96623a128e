! SPDX-License-Identifier: BSD-3-Clause
!> The growth of disturbances of chains that move as one block, by the stiffness of their modes.
module synchrony_command
   use dde_errors, only: error_type
   use lyapunov_spectrum, only: growth_settings_type
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

   !> Run the command.
   subroutine run_synchrony(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      !> Parts of the way between two values of s for multipliers, which cost less
      integer, parameter :: parts = 10

      type(growth_settings_type) :: how
      type(progress_type) :: report
      type(scene_type) :: scene
      type(synchrony_settings_type) :: settings
      type(transverse_cycle_type) :: on_cycle
      type(transverse_growth_type), allocatable :: growth(:)
      type(zero_type), allocatable :: zeros(:)

      call read_synchrony(namelist_path, scene, settings, error)
      if (allocated(error)) return
      report = progress_type("synchrony of "//trim(scene%name))
      how = growth_settings_type(t_begin=scene%t_transient, t_end=settings%t_end, &
                                 t_turning=settings%t_turning, interval=settings%interval, &
                                 blocks=settings%batches)
      call measure_transverse_growth(scene%problem, settings%values(1), how, scene%options(), &
                                     growth, error, report)
      if (allocated(error)) return
      call find_zeros(scene%problem, how, scene%options(), growth, zeros, error)
      if (allocated(error)) return
      call find_transverse_cycle(scene%problem, settings%t_end, scene%options(), &
                                 settings%values(parts), on_cycle)
      call write_synchrony(output_path, scene, settings, growth, zeros, on_cycle, error)
   end subroutine run_synchrony
end module synchrony_command
