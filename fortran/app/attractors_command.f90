! SPDX-License-Identifier: BSD-3-Clause
!> Attractors of a model on a grid of its parameters, from one history or several, or
!> along a sweep, with their classes.
module attractors_command
   use attractor_points, only: find_attractors, finding_type, point_type, sweep_attractors
   use attractors, only: attractor_settings_type
   use attractors_files, only: read_attractors, write_attractors
   use dde, only: integration_options
   use dde_errors, only: error_type
   use model_history, only: history_type
   use model_problem, only: model_type
   use points_input, only: points_settings_type
   use progress, only: progress_type
   implicit none (type, external)
   private
   public :: run_attractors

contains

   !> Run the command.
   subroutine run_attractors(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(finding_type), allocatable :: findings(:)
      type(integration_options) :: options
      type(points_settings_type) :: points
      type(history_type) :: history
      type(model_type) :: model
      type(point_type), allocatable :: list(:)
      type(progress_type) :: report

      call read_attractors(namelist_path, settings, options, points, model, history, error)
      if (allocated(error)) return
      list = points%list(model, history)
      report = progress_type("attractors of "//trim(points%name))
      if (points%sweep == "none") then
         call find_attractors(model, list, settings, options, findings, report, points%columns(), &
                              points%refinements)
      else
         call sweep_attractors(model, list, settings, options, findings, report)
      end if
      call write_attractors(output_path, points, model, history, list, settings, options, &
                            findings, error)
   end subroutine run_attractors
end module attractors_command
