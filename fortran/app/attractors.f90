!> Attractors of the delayed block on a grid of its parameters, from one history or several, or
!> along a sweep, with their classes.
program attractors_program
   use attractor_points, only: find_attractors, finding_type, sweep_attractors
   use attractors, only: attractor_settings_type
   use attractors_output, only: write_attractors
   use dde, only: integration_options
   use dde_errors, only: error_type
   use observation_input, only: read_observation
   use points_input, only: points_settings_type, read_points
   use progress, only: progress_type
   use program_arguments, only: get_paths, stop_on
   implicit none (type, external)
   character(len=:), allocatable :: namelist_path, output_path
   type(attractor_settings_type) :: settings
   type(error_type), allocatable :: error
   type(finding_type), allocatable :: findings(:)
   type(integration_options) :: options
   type(points_settings_type) :: asked
   type(progress_type) :: report

   call get_paths(namelist_path, output_path, error)
   call stop_on(error)
   call read_observation(namelist_path, settings, options, error)
   call stop_on(error)
   call read_points(namelist_path, asked, error)
   call stop_on(error)
   report = progress_type("attractors of "//trim(asked%name))
   if (asked%sweep == "none") then
      call find_attractors(asked%points, settings, options, findings, report, asked%columns, &
                           asked%refinements)
   else
      call sweep_attractors(asked%points, settings, options, findings, report)
   end if
   call report%finish()
   call write_attractors(output_path, asked, settings, options, findings, error)
   call stop_on(error)
end program attractors_program
