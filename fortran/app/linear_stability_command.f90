!> Linear stability of steady sliding at one set of parameters.
module linear_stability_command
   use block_roots, only: roots_of_block
   use block_parameters, only: block_parameters_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use linear_stability_files, only: linear_stability_settings_type, read_linear_stability, &
                                     write_linear_stability
   use program_arguments, only: stop_on
   use root_counts, only: roots_right_of
   use spring_block, only: block_characteristic
   use stability_changes, only: changes_with_epsilon, changes_with_tau, stability_change_type
   implicit none (type, external)
   private
   public :: run_linear_stability

contains

   !> Linear stability of steady sliding at one set of parameters.
   subroutine run_linear_stability(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(error_type), allocatable :: error, unknown
      type(linear_stability_settings_type) :: settings
      type(block_parameters_type) :: without_delay
      complex(wp), allocatable :: roots(:)
      type(stability_change_type), allocatable :: with_epsilon(:), with_tau(:)
      integer :: pairs(2)

      call read_linear_stability(namelist_path, settings, error)
      call stop_on(error)
      call roots_of_block(settings%parameters, settings%root_bound, roots, error)
      call stop_on(error)
      call changes_with_tau(settings%parameters, settings%tau_most, with_tau, unknown)
      if (allocated(unknown)) then
         with_epsilon = with_tau(:0)
      else
         call changes_with_epsilon(settings%parameters, settings%epsilon_most, with_epsilon, &
                                   unknown)
      end if
      without_delay = settings%parameters
      without_delay%tau = 0.0_wp
      pairs = [roots_right_of(block_characteristic(settings%parameters), 0.0_wp), &
               roots_right_of(block_characteristic(without_delay), 0.0_wp)]/2
      call write_linear_stability(output_path, settings, roots, pairs, with_tau, with_epsilon, &
                                  unknown, error)
      call stop_on(error)
   end subroutine run_linear_stability
end module linear_stability_command
