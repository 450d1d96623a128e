!> Attractors of the delayed block on a grid of its parameters, from one history or several, or
!> along a sweep, with their classes.
program attractors_program
   use attractor_points, only: find_attractors, finding_type, point_type, sweep_attractors
   use attractors, only: attractor_settings_type
   use attractors_files, only: read_attractors, write_attractors
   use block_parameters, only: block_history_type
   use dde, only: integration_options
   use dde_errors, only: error_type
   use points_input, only: points_settings_type
   use progress, only: progress_type
   use program_arguments, only: get_paths, stop_on
   implicit none (type, external)
   character(len=:), allocatable :: namelist_path, output_path
   type(attractor_settings_type) :: settings
   type(error_type), allocatable :: error
   type(finding_type), allocatable :: findings(:)
   type(integration_options) :: options
   type(points_settings_type) :: points
   type(block_history_type), allocatable :: histories(:)
   type(point_type), allocatable :: list(:)
   type(progress_type) :: report

   call get_paths(namelist_path, output_path)
   call read_attractors(namelist_path, settings, options, points, histories, error)
   call stop_on(error)
   list = points%list(histories)
   report = progress_type("attractors of "//trim(points%name))
   if (points%sweep == "none") then
      call find_attractors(list, settings, options, findings, report, points%columns(), &
                           points%refinements)
   else
      call sweep_attractors(list, settings, options, findings, report)
   end if
   call write_attractors(output_path, points, list, settings, options, findings, error)
   call stop_on(error)
end program attractors_program
