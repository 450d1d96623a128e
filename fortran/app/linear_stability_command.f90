! SPDX-License-Identifier: BSD-3-Clause
!> Linear stability of a model at rest, at one set of parameters.
module linear_stability_command
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use linear_stability_files, only: linear_stability_settings_type, read_linear_stability, &
                                     write_linear_stability
   use model_problem, only: model_type
   use model_roots, only: count_roots, find_model_roots
   use stability_changes, only: changes_type, find_changes, roots_without_delay
   implicit none (type, external)
   private
   public :: run_linear_stability

contains

   !> Run the command.
   subroutine run_linear_stability(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(changes_type), allocatable :: changes(:)
      type(linear_stability_settings_type) :: settings
      type(model_type) :: model
      complex(wp), allocatable :: roots(:)
      integer :: i

      call read_linear_stability(namelist_path, settings, model, error)
      if (allocated(error)) return
      call find_model_roots(model, settings%root_bound, roots, error)
      if (allocated(error)) return
      allocate (changes(count(settings%along /= "")))
      do i = 1, size(changes)
         changes(i)%along = model%number_of(settings%along(i))
         call find_changes(model, settings%windows(:, i), changes(i), error)
         if (allocated(error)) return
      end do
      call write_linear_stability(output_path, settings, model, roots, &
                                  [count_roots(model, 0.0_wp), roots_without_delay(model)], &
                                  changes, error)
   end subroutine run_linear_stability
end module linear_stability_command
