!> Namelists that are read, and the values that are refused.
module test_io_refusals
   use dde_errors, only: failure_type => error_type
   use hopf_input, only: hopf_settings_type, read_plane
   use hopf_planes, only: curve_plane_type
   use linear_stability_input, only: linear_stability_settings_type, read_linear_stability
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use namelist_refusals, only: above_0, above_minus_1, expect_refusals, from_0, from_1, from_2, &
                                line_length, of_block, of_spectrum, of_tolerance, &
                                spoiled => spoiled_key
   use scene_input, only: read_scene, scene_type
   use spectrum_input, only: read_spectrum_settings, spectrum_settings_type
   use velocity_step, only: step_protocol_type
   use velocity_step_input, only: read_protocol
   implicit none (type, external)
   private
   public :: collect_io_refusals

contains

   !> All tests of this suite.
   subroutine collect_io_refusals(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("scene", test_scene), &
         new_unittest("spectrum", test_spectrum), &
         new_unittest("plane of tau", test_plane_of_tau), &
         new_unittest("plane of xi", test_plane_of_xi), &
         new_unittest("linear stability", test_linear_stability), &
         new_unittest("velocity step", test_velocity_step)]
   end subroutine collect_io_refusals

   !> The group &scene.
   subroutine test_scene(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, scene_reader, "scene", [character(len=line_length) :: &
         "name = 'torus'", "tau = 10.0", "epsilon = 0.5", "xi = 0.8", "gamma = 0.8", &
         "history%theta = 0.0", "history%u = 0.0", "history%v = 1.1", "t_end = 30.0", &
         "t_transient = 5.0", "sample_interval = 0.25", "tolerance = 1.0e-9", "method = 'auto'", &
         "variables = 'theta', 'u', 'v'"], [of_block, of_tolerance, &
         spoiled("tau", "-1.0", "scene 'torus': tau"), &
         spoiled("history%v", "0.0", "history%v = 0.0"//above_0), &
         spoiled("t_end", "0.0", "t_end = 0.0"//above_0), &
         spoiled("t_end", "-1.0", "t_end = -1.0"//above_0), &
         spoiled("t_transient", "-1.0", "t_transient = -1.0"//from_0//" < 30.0"), &
         spoiled("t_transient", "30.0", "t_transient = 30.0"//from_0//" < 30.0"), &
         spoiled("sample_interval", "0.0", "sample_interval = 0.0"//above_0//" <= 30.0"), &
         spoiled("sample_interval", "30.1", "sample_interval = 30.1"//above_0//" <= 30.0"), &
         spoiled("sample_interval", "1e-9", "number of samples t_end/sample_interval"), &
         spoiled("method", "'other'", "method = 'other'; expected one of 'auto' 'explicit'"), &
         spoiled("method", "'explicitx'", "method = 'explicitx'; expected one of"), &
         spoiled("variables", "'w'", "variables = 'w'; expected one of 'theta' 'u' 'v'"), &
         spoiled("variables", "'thetas'", "variables = 'thetas'; expected one of"), &
         spoiled("variables", "'', 'v'", "variables = ''; expected one of"), &
         spoiled("variables", "'V'", "variables = 'V'; expected one of"), &
         spoiled("variables", "'v', 'v'", "variables = 'v' twice; expected each once"), &
         spoiled("variables", "'u', 'v', 'u', 'w'", "namelist group &scene: "), &
         spoiled("name", "'"//repeat("a", 65)//"'", "name of 65 letters; expected 1 to 64")])
   end subroutine test_scene

   !> Reads a scene.
   subroutine scene_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(scene_type) :: scene

      call read_scene(path, scene, failure)
   end subroutine scene_reader

   !> The group &spectrum.
   subroutine test_spectrum(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, spectrum_reader, "spectrum", [character(len=line_length) :: &
         "trajectory = 'a.nc'", "window = 'hann'", "segments = 8", "overlap = 0.5", &
         "peak_floor = 1.0e-6", "peak_prominence = 10.0"], of_spectrum)
   end subroutine test_spectrum

   !> Reads the settings of a spectrum.
   subroutine spectrum_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(spectrum_settings_type) :: settings

      call read_spectrum_settings(path, settings, failure)
   end subroutine spectrum_reader

   !> The group &hopf_curves with curves tau(epsilon).
   subroutine test_plane_of_tau(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, plane_reader, "hopf_curves", plane_lines("tau"), [of_plane(), &
         spoiled("fixed", "0.0", "fixed (xi) = 0.0"//above_0), &
         spoiled("fixed", "-1.0", "fixed (xi) = -1.0"//above_0), &
         spoiled("ordinate_window", "-1.0, 3.0", "ordinate_window(1) = -1.0"//from_0)])
   end subroutine test_plane_of_tau

   !> The group &hopf_curves with curves xi(epsilon).
   subroutine test_plane_of_xi(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, plane_reader, "hopf_curves", plane_lines("xi"), [of_plane(), &
         spoiled("fixed", "-1.0", "fixed (tau) = -1.0"//from_0), &
         spoiled("ordinate_window", "0.0, 3.0", "ordinate_window(1) = 0.0"//above_0)])
   end subroutine test_plane_of_xi

   !> A good plane.
   pure function plane_lines(ordinate) result(lines)
      !> Its ordinate
      character(len=*), intent(in) :: ordinate
      character(len=line_length) :: lines(6)

      lines = [character(len=line_length) :: "ordinate = '"//ordinate//"'", "fixed = 0.5", &
               "gamma = 0.8", "epsilon_window = 0.0, 1.0", "ordinate_window = 0.5, 3.0", &
               "cells = 20"]
   end function plane_lines

   !> Refused settings of both planes.
   pure function of_plane() result(table)
      type(spoiled), allocatable :: table(:)

      table = [spoiled("ordinate", "'other'", "ordinate = 'other'; expected one of 'tau' 'xi'"), &
         spoiled("ordinate", "'taux'", "ordinate = 'taux'; expected one of"), &
         spoiled("gamma", "0.0", "gamma = 0.0"//above_0), &
         spoiled("gamma", "-1.0", "gamma = -1.0"//above_0), &
         spoiled("epsilon_window", "-1.0, 1.0", "epsilon_window(1) = -1.0"//above_minus_1), &
         spoiled("epsilon_window", "-0.5, 0.0", "epsilon_window(2) = 0.0"//above_0), &
         spoiled("epsilon_window", "0.5, 0.5", "epsilon_window(2) = 0.5; expected a finite"), &
         spoiled("ordinate_window", "0.5, 0.5", "ordinate_window(2) = 0.5; expected a finite"), &
         spoiled("cells", "0", "cells = 0"//from_1)]
   end function of_plane

   !> Reads a plane.
   subroutine plane_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(curve_plane_type) :: plane
      type(hopf_settings_type) :: settings

      call read_plane(path, settings, plane, failure)
   end subroutine plane_reader

   !> The group &linear_stability.
   subroutine test_linear_stability(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, linear_stability_reader, "linear_stability", &
         [character(len=line_length) :: "tau = 10.0", "epsilon = 0.5", "xi = 0.8", "gamma = 0.8", &
         "root_bound = -1.0", "tau_most = 30.0", "epsilon_most = 2.0"], [of_block, &
         spoiled("root_bound", "0.1", "root_bound = 0.1; expected a finite number <= 0.0"), &
         spoiled("tau_most", "0.0", "tau_most = 0.0"//above_0), &
         spoiled("epsilon_most", "0.0", "epsilon_most = 0.0"//above_0)])
   end subroutine test_linear_stability

   !> Reads what is asked of linear stability.
   subroutine linear_stability_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(linear_stability_settings_type) :: settings

      call read_linear_stability(path, settings, failure)
   end subroutine linear_stability_reader

   !> The group &velocity_step.
   subroutine test_velocity_step(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, protocol_reader, "velocity_step", [character(len=line_length) :: &
         "mu0 = 0.6", "a = 0.01", "b = 0.015", "dc = 1.0e-5", "v0 = 1.0e-6", "b_state = 10.0", &
         "delta_v = 9.0e-6", "slip_before = 5.0", "slip_after = 10.0", "tolerance = 1.0e-8", &
         "samples = 100"], [of_tolerance, &
         spoiled("mu0", "-1.0", "mu0 = -1.0"//from_0), &
         spoiled("a", "-1.0", "a = -1.0"//from_0), &
         spoiled("b", "-1.0", "b = -1.0"//from_0), &
         spoiled("dc", "0.0", "dc = 0.0"//above_0), &
         spoiled("v0", "0.0", "v0 = 0.0"//above_0), &
         spoiled("b_state", "0.0", "b_state = 0.0"//above_0), &
         spoiled("delta_v", "0.0", "delta_v = 0.0"//above_0), &
         spoiled("slip_before", "0.0", "slip_before = 0.0"//above_0), &
         spoiled("slip_after", "0.0", "slip_after = 0.0"//above_0), &
         spoiled("samples", "1", "samples = 1"//from_2)])
   end subroutine test_velocity_step

   !> Reads a protocol of velocity steps.
   subroutine protocol_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(step_protocol_type) :: protocol

      call read_protocol(path, protocol, failure)
   end subroutine protocol_reader
end module test_io_refusals
