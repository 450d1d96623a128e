!> Runs one suite of unit tests, named by the first argument; without one, all of them.
program tester
   use, intrinsic :: iso_fortran_env, only: error_unit
   use mctc_env_testing, only: new_testsuite, run_testsuite, testsuite_type
   use test_attractor_points, only: collect_attractor_points
   use test_attractor_sweep, only: collect_attractor_sweep
   use test_attractors, only: collect_attractors
   use test_base_frequencies, only: collect_base_frequencies
   use test_block_cycles, only: collect_block_cycles
   use test_block_parameters, only: collect_block_parameters
   use test_dde_extremes, only: collect_dde_extremes
   use test_dde_gsl, only: collect_dde_gsl
   use test_dde_implicit, only: collect_dde_implicit
   use test_dde_reentrant, only: collect_dde_reentrant
   use test_dde_slow_series, only: collect_dde_slow_series
   use test_dde_stiff, only: collect_dde_stiff
   use test_dde_switch, only: collect_dde_switch
   use test_dde_taylor, only: collect_dde_taylor
   use test_exponents, only: collect_exponents
   use test_extreme_gamma, only: collect_extreme_gamma
   use test_floquet_multipliers, only: collect_floquet_multipliers
   use test_friction_law, only: collect_friction_law
   use test_gsl_roots, only: collect_gsl_roots
   use test_hopf_condition, only: collect_hopf_condition
   use test_hopf_curves, only: collect_hopf_curves
   use test_hopf_points, only: collect_hopf_points
   use test_hopf_unfoldings, only: collect_hopf_unfoldings
   use test_linear_stability, only: collect_linear_stability
   use test_lyapunov_spectrum, only: collect_lyapunov_spectrum
   use test_measured_run, only: collect_measured_run
   use test_motion_classes, only: collect_motion_classes
   use test_motion_path, only: collect_motion_path
   use test_normal_forms, only: collect_normal_forms
   use test_orbit_branches, only: collect_orbit_branches
   use test_orbit_curves, only: collect_orbit_curves
   use test_periodic_orbits, only: collect_periodic_orbits
   use test_progress, only: collect_progress
   use test_refined_grid, only: collect_refined_grid
   use test_section_motion, only: collect_section_motion
   use test_slip_events, only: collect_slip_events
   use test_spectral_peaks, only: collect_spectral_peaks
   use test_spectrum, only: collect_spectrum
   use test_spectrum_verdict, only: collect_spectrum_verdict
   use test_spring_block, only: collect_spring_block
   use test_stability_changes, only: collect_stability_changes
   use test_steady_sliding, only: collect_steady_sliding
   use test_tangent_runs, only: collect_tangent_runs
   use test_tangent_series, only: collect_tangent_series
   use test_tangents, only: collect_tangents
   use test_thinned_line, only: collect_thinned_line
   use test_three_torus, only: collect_three_torus
   use test_torus_normal_form, only: collect_torus_normal_form
   use test_velocity_step, only: collect_velocity_step
   implicit none (type, external)
   type(testsuite_type), allocatable :: suites(:)
   character(len=32) :: wanted
   integer :: failed, i, run

   allocate (suites, source=[new_testsuite("attractor_points", collect_attractor_points), &
                             new_testsuite("attractor_sweep", collect_attractor_sweep), &
                             new_testsuite("attractors", collect_attractors), &
                             new_testsuite("base_frequencies", collect_base_frequencies), &
                             new_testsuite("block_cycles", collect_block_cycles), &
                             new_testsuite("block_parameters", collect_block_parameters), &
                             new_testsuite("dde_extremes", collect_dde_extremes), &
                             new_testsuite("dde_gsl", collect_dde_gsl), &
                             new_testsuite("dde_implicit", collect_dde_implicit), &
                             new_testsuite("dde_reentrant", collect_dde_reentrant), &
                             new_testsuite("dde_slow_series", collect_dde_slow_series), &
                             new_testsuite("dde_stiff", collect_dde_stiff), &
                             new_testsuite("dde_switch", collect_dde_switch), &
                             new_testsuite("dde_taylor", collect_dde_taylor), &
                             new_testsuite("exponents", collect_exponents), &
                             new_testsuite("extreme_gamma", collect_extreme_gamma), &
                             new_testsuite("floquet_multipliers", collect_floquet_multipliers), &
                             new_testsuite("friction_law", collect_friction_law), &
                             new_testsuite("gsl_roots", collect_gsl_roots), &
                             new_testsuite("hopf_condition", collect_hopf_condition), &
                             new_testsuite("hopf_curves", collect_hopf_curves), &
                             new_testsuite("hopf_points", collect_hopf_points), &
                             new_testsuite("hopf_unfoldings", collect_hopf_unfoldings), &
                             new_testsuite("linear_stability", collect_linear_stability), &
                             new_testsuite("lyapunov_spectrum", collect_lyapunov_spectrum), &
                             new_testsuite("measured_run", collect_measured_run), &
                             new_testsuite("motion_classes", collect_motion_classes), &
                             new_testsuite("motion_path", collect_motion_path), &
                             new_testsuite("normal_forms", collect_normal_forms), &
                             new_testsuite("orbit_branches", collect_orbit_branches), &
                             new_testsuite("orbit_curves", collect_orbit_curves), &
                             new_testsuite("periodic_orbits", collect_periodic_orbits), &
                             new_testsuite("progress", collect_progress), &
                             new_testsuite("refined_grid", collect_refined_grid), &
                             new_testsuite("section_motion", collect_section_motion), &
                             new_testsuite("slip_events", collect_slip_events), &
                             new_testsuite("spectral_peaks", collect_spectral_peaks), &
                             new_testsuite("spectrum", collect_spectrum), &
                             new_testsuite("spectrum_verdict", collect_spectrum_verdict), &
                             new_testsuite("spring_block", collect_spring_block), &
                             new_testsuite("stability_changes", collect_stability_changes), &
                             new_testsuite("steady_sliding", collect_steady_sliding), &
                             new_testsuite("tangent_runs", collect_tangent_runs), &
                             new_testsuite("tangent_series", collect_tangent_series), &
                             new_testsuite("tangents", collect_tangents), &
                             new_testsuite("thinned_line", collect_thinned_line), &
                             new_testsuite("three_torus", collect_three_torus), &
                             new_testsuite("torus_normal_form", collect_torus_normal_form), &
                             new_testsuite("velocity_step", collect_velocity_step)])
   wanted = ""
   if (command_argument_count() > 0) call get_command_argument(1, wanted)
   failed = 0
   run = 0
   do i = 1, size(suites)
      if (wanted /= "" .and. wanted /= suites(i)%name) cycle
      write (error_unit, "(2a)") "Testing: ", suites(i)%name
      call run_testsuite(suites(i)%collect, error_unit, failed)
      run = run + 1
   end do
   ! the variables of a program live on after its end, where a leak checker would count them
   deallocate (suites)
   if (run == 0) error stop "no suite of that name"
   if (failed > 0) error stop "some tests failed"
end program tester
