!> Namelists that are read, and what is refused: by the one way in which all are read, and values
!> with which a program could not compute anything.
module test_namelists
   use attractors, only: attractor_settings_type
   use attractors_input, only: read_attractors
   use block_cycles, only: cycle_settings_type
   use block_parameters, only: block_history_type
   use cycles_input, only: read_cycles
   use dde, only: integration_options
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_failure, expect_success
   use exponents_input, only: exponents_settings_type, read_exponents
   use hopf_input, only: hopf_settings_type, read_plane
   use hopf_planes, only: curve_plane_type
   use linear_stability_input, only: linear_stability_settings_type, read_linear_stability
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use measure_input, only: measure_settings_type, read_measure
   use measured_case, only: case_type
   use points_input, only: points_settings_type
   use scene_input, only: read_scene, scene_type
   use spectrum_input, only: read_spectrum_settings, spectrum_settings_type
   use velocity_step, only: step_protocol_type
   use velocity_step_input, only: read_protocol
   implicit none (type, external)
   private
   public :: collect_namelists

   !> File that the readers read.
   character(len=*), parameter :: path = "test_namelists.nml"
   !> Length of a line.
   integer, parameter :: l = 48
   !> Lines of good namelists.
   character(len=*), parameter :: scene(*) = [character(len=l) :: &
      "scene%name = 'torus'", "scene%parameters%tau = 10.0", "scene%parameters%epsilon = 0.5", &
      "scene%parameters%xi = 0.8", "scene%parameters%gamma = 0.8", "scene%history%theta = 0.0", &
      "scene%history%u = 0.0", "scene%history%v = 1.1", "scene%t_end = 30.0", &
      "scene%t_transient = 5.0", "scene%sample_interval = 0.25", "scene%tolerance = 1.0e-9", &
      "scene%method = 'auto'", "scene%variables = 'theta', 'u', 'v'"]
   character(len=*), parameter :: exponents(*) = [character(len=l) :: scene, &
      "exponents%count = 3", "exponents%t_end = 500.0", "exponents%t_turning = 100.0", &
      "exponents%interval = 0.5", "exponents%blocks = 10", "exponents%zero_level = 1.0e-5"]
   character(len=*), parameter :: spectrum(*) = [character(len=l) :: &
      "trajectory = 'a.nc'", "spectrum%window = 'hann'", "spectrum%segments = 8", &
      "spectrum%overlap = 0.5", "spectrum%peak_floor = 1.0e-6", "spectrum%peak_prominence = 10.0"]
   character(len=*), parameter :: plane(*) = [character(len=l) :: &
      "hopf_curves%ordinate = 'tau'", "hopf_curves%fixed = 0.5", "hopf_curves%gamma = 0.8", &
      "hopf_curves%epsilon_window = 0.0, 1.0", "hopf_curves%ordinate_window = 0.5, 3.0", &
      "hopf_curves%cells = 20"]
   character(len=*), parameter :: line(*) = [character(len=l) :: &
      "cycles%along = 'tau'", "cycles%window = 1.0, 9.0", "cycles%parameters%epsilon = 0.7", &
      "cycles%parameters%xi = 0.5", "cycles%parameters%gamma = 0.8", "cycles%starts = 5.0, 7.0", &
      "cycles%v = 1.1", "cycles%t_transient = 500.0", "cycles%degree = 7", &
      "cycles%intervals = 20", "cycles%longest_period = 100.0", "cycles%most_orbits = 5", &
      "cycles%epsilon_window = 0.0, 1.5", "cycles%tau_window = 0.0, 20.0"]
   character(len=*), parameter :: stability(*) = [character(len=l) :: &
      "linear_stability%parameters%tau = 10.0", "linear_stability%parameters%epsilon = 0.5", &
      "linear_stability%parameters%xi = 0.8", "linear_stability%parameters%gamma = 0.8", &
      "linear_stability%root_bound = -1.0", "linear_stability%tau_most = 30.0", &
      "linear_stability%epsilon_most = 2.0"]
   character(len=*), parameter :: protocol(*) = [character(len=l) :: &
      "velocity_step%law%mu0 = 0.6", "velocity_step%law%a = 0.01", "velocity_step%law%b = 0.015", &
      "velocity_step%law%dc = 1.0e-5", "velocity_step%law%v0 = 1.0e-6", &
      "velocity_step%law%b_state = 10.0", "velocity_step%delta_v = 9.0e-6", &
      "velocity_step%slip_before = 5.0", "velocity_step%slip_after = 10.0", &
      "velocity_step%tolerance = 1.0e-8", "velocity_step%samples = 100"]
   character(len=*), parameter :: survey(*) = [character(len=l) :: &
      "observation%t_transient = 100.0", "observation%t_observed = 200.0", &
      "observation%t_lasting = 50.0", "observation%t_turning = 20.0", "observation%t_path = 5.0", &
      "observation%interval = 5.0", "observation%exponents = 4", &
      "observation%zero_level = 1.0e-4", "observation%longest_bar = 1.0e-3", &
      "observation%doublings = 0", "observation%sample_interval = 0.1", &
      "observation%window = 'hann'", "observation%segments = 2", "observation%overlap = 0.5", &
      "observation%peak_floor = 1.0e-6", "observation%peak_prominence = 10.0", &
      "solver%tolerance = 1.0e-6", "solver%method = 'auto'", "solver%most_steps = 100000", &
      "points%name = 'a part'", "points%epsilon%window = 0.1, 0.5", "points%epsilon%count = 3", &
      "points%epsilon%part = 2, 3", "points%tau%window = 0.0, 10.0", "points%tau%count = 3", &
      "points%tau%part = 1, 1", "points%xi%window = 0.8, 0.8", "points%xi%count = 1", &
      "points%xi%part = 1, 1", "points%gamma%window = 0.8, 1.0e8", "points%gamma%count = 1", &
      "points%gamma%part = 1, 1", "histories%theta = 0.0", "histories%u = 0.0", &
      "histories%v = 1.1", "points%sweep = 'up'", "points%refinements = 0", "points%kept = 100"]
   character(len=*), parameter :: measured(*) = [character(len=l) :: &
      "cases%name = 'decay', 'stiff'", "parameters%tau = 0.0, 1.0", &
      "parameters%epsilon = 0.3, 0.7", "parameters%xi = 0.8, 0.5", &
      "parameters%gamma = 0.8, 100.0", "histories%theta = 0.1, 0.0", "histories%u = 0.2, 0.0", &
      "histories%v = 1.5, 1.1", "cases%t_end = 20.0, 5.0", "cases%sample_interval = 0.5, 0.5", &
      "measure%methods = 'auto', 'rk4_cubic'", "measure%tolerances = 1.0e-6, 1.0e-9", &
      "measure%steps = 0.01", "measure%most_steps = 1000", "measure%repeats = 2", &
      "measure%least_seconds = 1.0e-4"]

contains

   !> All tests of this suite.
   subroutine collect_namelists(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("good namelists", test_good), &
                   new_unittest("keys", test_keys), &
                   new_unittest("scene and exponents", test_scene), &
                   new_unittest("spectrum, planes and lines", test_curves), &
                   new_unittest("velocity step", test_velocity_step), &
                   new_unittest("attractors", test_attractors), &
                   new_unittest("measured cases", test_measured)]
   end subroutine collect_namelists

   !> Read a namelist in which the lines of some keys are replaced.
   subroutine read_changed(section, lines, changes, failure)
      !> Name of the good namelist
      character(len=*), intent(in) :: section
      !> Lines of the good namelist
      character(len=*), intent(in) :: lines(:)
      !> Lines that replace those of the same key or stand beside the others, with "; " between
      character(len=*), intent(in) :: changes
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(attractor_settings_type) :: observation
      type(block_history_type), allocatable :: histories(:)
      type(case_type), allocatable :: cases(:)
      type(curve_plane_type) :: curve_plane
      type(cycle_settings_type) :: cycles
      type(exponents_settings_type) :: exponents_read
      type(hopf_settings_type) :: hopf_curves
      type(integration_options) :: options
      type(linear_stability_settings_type) :: linear_stability
      type(measure_settings_type) :: measure
      type(points_settings_type) :: points
      type(scene_type) :: scene_read
      type(spectrum_settings_type) :: settings
      type(step_protocol_type) :: velocity_step
      character(len=:), allocatable :: trajectory
      integer :: i, unit

      open (newunit=unit, file=path, status="replace", action="write")
      write (unit, "(a)") "&settings"
      do i = 1, size(lines)
         if (index("; "//changes, "; "//lines(i) (:index(lines(i), "=") - 1)) > 0) cycle
         write (unit, "(a)") trim(lines(i))
      end do
      do i = 1, len(changes)
         if (changes(i:i) == ";") then
            write (unit, "()")
         else
            write (unit, "(a)", advance="no") changes(i:i)
         end if
      end do
      write (unit, "(/, a)") "/"
      close (unit)
      select case (section)
      case ("scene")
         call read_scene(path, scene_read, failure)
      case ("exponents")
         call read_exponents(path, scene_read, exponents_read, failure)
      case ("spectrum")
         call read_spectrum_settings(path, trajectory, settings, failure)
      case ("plane")
         call read_plane(path, hopf_curves, curve_plane, failure)
      case ("line")
         call read_cycles(path, cycles, failure)
      case ("stability")
         call read_linear_stability(path, linear_stability, failure)
      case ("protocol")
         call read_protocol(path, velocity_step, failure)
      case ("survey")
         call read_attractors(path, observation, options, points, histories, failure)
      case default
         call read_measure(path, cases, measure, failure)
      end select
      open (newunit=unit, file=path, status="old", action="readwrite")
      close (unit, status="delete")
   end subroutine read_changed

   !> A changed namelist is refused with words that name file, key, value and range.
   subroutine refused(error, section, lines, changes, words)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Name of the good namelist
      character(len=*), intent(in) :: section
      !> Lines of the good namelist
      character(len=*), intent(in) :: lines(:)
      !> Lines that are different
      character(len=*), intent(in) :: changes
      !> Words of the message
      character(len=*), intent(in) :: words
      type(failure_type), allocatable :: failure

      call read_changed(section, lines, changes, failure)
      call expect_failure(error, failure, path//": ")
      call expect_failure(error, failure, words)
   end subroutine refused

   !> Good namelists are read; without any one of their lines they are refused, but for a list and a
   !> path that may be left out.
   subroutine test_good(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call check_all("scene", scene)
      call check_all("exponents", exponents)
      call check_all("spectrum", spectrum)
      call check_all("plane", plane)
      call check_all("line", line)
      call check_all("stability", stability)
      call check_all("protocol", protocol)
      call check_all("survey", survey)
      call check_all("measured", measured)

   contains

      !> One namelist.
      subroutine check_all(section, lines)
         !> Name of the namelist
         character(len=*), intent(in) :: section
         !> Lines of the namelist
         character(len=*), intent(in) :: lines(:)
         type(failure_type), allocatable :: failure
         integer :: i

         call read_changed(section, lines, "", failure)
         call expect_success(error, failure)
         do i = 1, size(lines)
            if (index(lines(i), "cycles%starts") == 1 .or. index(lines(i), "trajectory") == 1) cycle
            call read_changed(section, pack(lines, lines /= lines(i)), "", failure)
            call expect(error, allocated(failure), section//" without "//trim(lines(i)))
         end do
      end subroutine check_all
   end subroutine test_good

   !> Keys that are unknown or missing, and numbers that are none.
   subroutine test_keys(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(scene_type) :: scene_read
      character(len=*), parameter :: group = "namelist group &settings: "

      call read_scene("no-such-file.nml", scene_read, failure)
      call expect_failure(error, failure, "no-such-file.nml: ")
      call refused(error, "scene", scene, "scene%colour = 1.0", group)
      call refused(error, "scene", scene, "scene%colour = 1.0", "colour")
      call refused(error, "scene", scene, "scene%t_end = 'much'", group)
      call refused(error, "scene", scene, "scene%t_end = 1.0, 2.0", group)
      call refused(error, "scene", scene, "scene%t_end = NaN", &
                   "scene%t_end = NaN; expected a finite number (NaN: missing, or not a number)")
      call refused(error, "scene", scene, "scene%t_end = -Infinity", "expected a finite number")
      call refused(error, "plane", pack(plane, index(plane, "cells") == 0), "", &
                   "hopf_curves%cells is missing; expected a whole number")
   end subroutine test_keys

   !> Scenes and exponents that cannot be computed or stored.
   subroutine test_scene(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: s = "scene", e = "exponents"
      character(len=*), parameter :: above_0 = "; expected a finite number > 0.0"

      call refused(error, s, scene, "scene%parameters%tau = -1.0", &
                   "scene 'torus': tau = -1.0; expected a finite number >= 0.0")
      call refused(error, s, scene, "scene%history%v = 0.0", "v = 0.0"//above_0)
      call refused(error, s, scene, "scene%t_end = 0.0", "t_end = 0.0"//above_0)
      call refused(error, s, scene, "scene%t_transient = 30.0", " >= 0.0 < 30.0")
      call refused(error, s, scene, "scene%sample_interval = 0.0", above_0//" <= 30.0")
      call refused(error, s, scene, "scene%sample_interval = 1e-9", "number of samples")
      call refused(error, s, scene, "scene%method = 'explicitx'", "'explicitx'; expected one of")
      call refused(error, s, scene, "scene%variables = 'V'", "'V'; expected one of 'theta'")
      call refused(error, s, scene, "scene%variables = '', 'v'", "variables = ''; expected one of")
      call refused(error, s, scene, "scene%variables = 'v', 'v'", "'v' twice; expected")
      call refused(error, s, scene, "scene%name = '"//repeat("a", 65)//"'", "65 letters")
      call refused(error, e, exponents, "exponents%count = 1", "count = 1; expected")
      call refused(error, e, exponents, "exponents%blocks = 1", "blocks = 1; expected")
      call refused(error, e, exponents, "exponents%t_end = 5.0", "number > 5.0")
      call refused(error, e, exponents, "exponents%t_turning = -1.0", "t_turning = -1.0;")
   end subroutine test_scene

   !> Spectra, planes and lines that cannot be computed.
   subroutine test_curves(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: h = "hopf_curves%", s = "spectrum"

      call refused(error, s, spectrum, "spectrum%window = 'x'", "one of 'hann' 'boxcar'")
      call refused(error, s, spectrum, "spectrum%segments = 0", "segments = 0; expected")
      call refused(error, s, spectrum, "spectrum%overlap = 1.0", "overlap = 1.0; expected")
      call refused(error, "plane", plane, h//"ordinate = 'taux'", "expected one of 'tau'")
      call refused(error, "plane", plane, h//"fixed = 0.0", "fixed (xi) = 0.0; expected")
      call refused(error, "plane", plane, h//"epsilon_window = -0.5, 0.0", &
                   "epsilon_window(2) = 0.0; expected")
      call refused(error, "plane", plane, h//"ordinate_window = 0.5, 0.5", &
                   "ordinate_window(2) = 0.5; expected")
      call refused(error, "plane", plane, h//"ordinate = 'xi'; "//h//"ordinate_window = 0.0, 1.0", &
                   "ordinate_window(1) = 0.0; expected")
      call refused(error, "plane", plane, h//"cells = 0", "cells = 0; expected")
      call refused(error, "line", line, "cycles%along = 'v'; cycles%parameters%tau = 1.0", &
                   "expected one of 'tau' 'epsilon'")
      call refused(error, "line", line, "cycles%window = 1.0, 1.0", "window(2) = 1.0; expected")
      call refused(error, "line", line, "cycles%starts = 0.5", "starts = 0.5; expected")
      call refused(error, "line", line, "cycles%degree = 10", "degree = 10; expected")
      call refused(error, "line", line, "cycles%tau_window = 1.0, 0.5", "tau_window(2) = 0.5;")
      call refused(error, "line", line, "cycles%along = 'xi'; cycles%parameters%tau = 1.0", &
                   "epsilon_window and tau_window; expected only where")
      call refused(error, "stability", stability, "linear_stability%parameters%xi = 0.0", &
                   "xi = 0.0; expected")
   end subroutine test_curves

   !> Velocity steps without a meaning.
   subroutine test_velocity_step(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: p = "protocol", v = "velocity_step%"

      call refused(error, p, protocol, v//"law%dc = 0.0", "dc = 0.0; expected")
      call refused(error, p, protocol, v//"law%v0 = 0.0", "v0 = 0.0; expected")
      call refused(error, p, protocol, v//"delta_v = -1.0", "delta_v = -1.0; expected")
      call refused(error, p, protocol, v//"slip_after = 0.0", "slip_after = 0.0; expected")
      call refused(error, p, protocol, v//"samples = 1", "samples = 1; expected")
   end subroutine test_velocity_step

   !> Observations and points that cannot be computed or stored.
   subroutine test_attractors(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: o = "observation%", p = "points%", s = "survey"
      character(len=*), parameter :: two = "histories%theta = 0.0, 0.5; "// &
                                     "histories%u = 0.0, 0.5; histories%v = 1.1, 1.5"

      call refused(error, s, survey, o//"t_observed = 0.0", "observation: t_observed = 0.0;")
      call refused(error, s, survey, o//"exponents = 1", "exponents = 1; expected")
      call refused(error, s, survey, o//"doublings = 11", "doublings = 11; expected")
      call refused(error, s, survey, o//"sample_interval = 1e-9", "number of samples")
      call refused(error, s, survey, o//"window = 'x'", "window = 'x'; expected one of")
      call refused(error, s, survey, "solver%method = 'radau'", "'radau'; expected one of")
      call refused(error, s, survey, "solver%tolerance = 0.0", "tolerance = 0.0; expected")
      call refused(error, s, survey, "solver%most_steps = 0", "most_steps = 0.0; expected")
      call refused(error, s, survey, p//"name = '"//repeat("a", 129)//"'", "whole number <= 128")
      call refused(error, s, survey, p//"xi%window = 0.0, 0.8", "xi%window = 0.0; expected")
      call refused(error, s, survey, p//"tau%count = 0", "tau%count = 0; expected")
      call refused(error, s, survey, p//"tau%part = 1, 4", "1 <= first <= last <= 3")
      call refused(error, s, survey, "histories%u = 0.0, 0.5", "history 2: theta is missing;")
      call refused(error, s, survey, "histories%v = 0.0", "history 1: v = 0.0; expected")
      call refused(error, s, survey, "histories%v = 1001*1.1", "namelist group &settings")
      call refused(error, s, survey, p//"sweep = 'left'", "'left'; expected one of 'none'")
      call refused(error, s, survey, p//"tau%part = 1, 2", "'up' along 2 parameters;")
      call refused(error, s, survey, two, "'up' from 2 histories; expected one")
      call refused(error, s, survey, p//"refinements = 5", "refinements = 5; expected")
      call refused(error, s, survey, p//"refinements = 1", "1 in a sweep; expected 0")
      call refused(error, s, survey, p//"kept = -1", "kept = -1; expected")
      call refused(error, s, survey, p//"epsilon%count = 100000; "//p// &
                   "epsilon%part = 1, 100000; "//p//"tau%count = 20; "//p//"tau%part = 1, 20", &
                   "number of points = ")
   end subroutine test_attractors

   !> Cases and runs that cannot be computed.
   subroutine test_measured(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: m = "measured"

      call refused(error, m, measured, "parameters%tau = -1.0, 1.0", "case 'decay': tau = -1.0;")
      call refused(error, m, measured, "parameters%gamma = 0.8", "parameters(2)%gamma = NaN;")
      call refused(error, m, measured, "histories%v = 0.0, 1.1", "v = 0.0; expected")
      call refused(error, m, measured, "cases%sample_interval = 30.0, 0.5", " > 0.0 <= 20.0")
      call refused(error, m, measured, "cases%sample_interval = 1e-7, 0.5", "number of samples")
      call refused(error, m, measured, "cases%name = 'decay', 'decay'", "'decay' twice; expected")
      call refused(error, m, measured, "cases%name = '', ''", "no case; expected at least one")
      call refused(error, m, measured, "measure%methods = 'auto', 'euler'", "'euler'; expected one")
      call refused(error, m, measured, "measure%tolerances = 1e-3, 0.0", "tolerances = 0.0;")
      call refused(error, m, measured, "measure%steps = -1.0", "steps = -1.0; expected")
      call refused(error, m, measured, "measure%repeats = -1", "repeats = -1; expected")
   end subroutine test_measured
end module test_namelists
