!> Namelists of surveys and of measurements, and the values that are refused.
module test_io_surveys
   use attractors, only: attractor_settings_type
   use cases_input, only: read_cases
   use dde, only: integration_options
   use dde_errors, only: failure_type => error_type
   use exponents_input, only: exponents_settings_type, read_exponents
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use measure_input, only: measure_settings_type, read_measure
   use measured_case, only: case_type
   use namelist_refusals, only: above_0, above_minus_1, expect_refusals, from_0, from_0_count, &
                                from_1, from_2, line_length, of_spectrum, of_tolerance, &
                                spoiled => spoiled_key
   use observation_input, only: read_observation
   use points_input, only: points_settings_type, read_points
   use scene_input, only: scene_type
   implicit none (type, external)
   private
   public :: collect_io_surveys

contains

   !> All tests of this suite.
   subroutine collect_io_surveys(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("observation", test_observation), &
         new_unittest("points", test_points), &
         new_unittest("exponents", test_exponents), &
         new_unittest("cases", test_cases), &
         new_unittest("measurements", test_measure)]
   end subroutine collect_io_surveys

   !> The group &observation.
   subroutine test_observation(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, observation_reader, "observation", [ &
         character(len=line_length) :: "t_transient = 100.0", "t_observed = 200.0", &
         "t_lasting = 50.0", "t_turning = 20.0", "t_path = 5.0", "interval = 5.0", &
         "exponents = 4", "zero_level = 1.0e-4", "longest_bar = 1.0e-3", "doublings = 0", &
         "sample_interval = 0.1", "window = 'hann'", "segments = 2", "overlap = 0.5", &
         "peak_floor = 1.0e-6", "peak_prominence = 10.0", "tolerance = 1.0e-6", &
         "method = 'auto'", "most_steps = 100000"], [of_tolerance, of_spectrum, &
         spoiled("t_transient", "0.0", "t_transient = 0.0"//above_0), &
         spoiled("t_observed", "0.0", "t_observed = 0.0"//above_0), &
         spoiled("t_lasting", "-1.0", "t_lasting = -1.0"//from_0), &
         spoiled("t_turning", "-1.0", "t_turning = -1.0"//from_0), &
         spoiled("t_path", "-1.0", "t_path = -1.0"//from_0), &
         spoiled("t_path", "1.1e5", "t_path = 110000.0"//from_0), &
         spoiled("interval", "0.0", "interval = 0.0"//above_0), &
         spoiled("exponents", "1", "exponents = 1"//from_2), &
         spoiled("exponents", "65", "exponents = 65; expected a whole number <= 64"), &
         spoiled("zero_level", "-1.0", "zero_level = -1.0"//from_0), &
         spoiled("longest_bar", "0.0", "longest_bar = 0.0"//above_0), &
         spoiled("doublings", "-1", "doublings = -1"//from_0_count), &
         spoiled("doublings", "11", "doublings = 11; expected a whole number <= 10"), &
         spoiled("sample_interval", "0.0", "sample_interval = 0.0"//above_0//" <= 200.0"), &
         spoiled("sample_interval", "200.1", "sample_interval = 200.1"//above_0//" <= 200.0"), &
         spoiled("sample_interval", "1e-9", "number of samples t_observed/sample_interval"), &
         spoiled("method", "'radau'", "method = 'radau'; expected one of 'auto'"), &
         spoiled("most_steps", "0", "most_steps = 0"//from_1)])
   end subroutine test_observation

   !> Reads how attractors are observed.
   subroutine observation_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(attractor_settings_type) :: settings
      type(integration_options) :: options

      call read_observation(path, settings, options, failure)
   end subroutine observation_reader

   !> The group &points.
   subroutine test_points(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: part = "; expected first and last, 1 <= first <= last <= 3"

      call expect_refusals(error, points_reader, "points", [character(len=line_length) :: &
         "name = 'a part'", "epsilon_window = 0.1, 0.5", "epsilon_count = 3", &
         "epsilon_part = 2, 3", "tau_window = 0.0, 10.0", "tau_count = 3", "tau_part = 1, 1", &
         "xi_window = 0.8, 0.8", "xi_count = 1", "xi_part = 1, 1", "gamma_window = 0.8, 1.0e8", &
         "gamma_count = 1", "gamma_part = 1, 1", "theta = 0.0", "u = 0.0", "v = 1.1", &
         "sweep = 'up'", "refinements = 0", "kept = 100"], [ &
         spoiled("name", "'"//repeat("a", 129)//"'", "letters of name = 129; expected"), &
         spoiled("xi_window", "0.0, 0.8", "xi_window = 0.0"//above_0), &
         spoiled("xi_part", "1, 2", "xi_part = 1, 2; expected first and last"), &
         spoiled("gamma_window", "0.8, 0.0", "gamma_window = 0.0"//above_0), &
         spoiled("gamma_count", "0", "gamma_count = 0"//from_1), &
         spoiled("epsilon_window", "-1.0, 0.5", "epsilon_window = -1.0"//above_minus_1), &
         spoiled("epsilon_window", "0.5, -2.0", "epsilon_window = -2.0"//above_minus_1), &
         spoiled("epsilon_window", "0.5", "epsilon_window = NaN"//above_minus_1), &
         spoiled("tau_window", "-0.1, 5.0", "tau_window = -0.1"//from_0), &
         spoiled("tau_window", "5.0, NaN", "tau_window = NaN"//from_0), &
         spoiled("epsilon_count", "0", "epsilon_count = 0"//from_1), &
         spoiled("epsilon_count", "100001", "epsilon_count = 100001; expected a whole"), &
         spoiled("tau_count", "0", "tau_count = 0"//from_1), &
         spoiled("tau_count", "100001", "tau_count = 100001; expected a whole number <= 100000"), &
         spoiled("epsilon_part", "0, 1", "epsilon_part = 0, 1"//part), &
         spoiled("epsilon_part", "2, 1", "epsilon_part = 2, 1"//part), &
         spoiled("tau_part", "1, 4", "tau_part = 1, 4"//part), &
         spoiled("tau_part", "4, 4", "tau_part = 4, 4"//part), &
         spoiled("theta", "0.0, 0.5", "u(2) = NaN; expected a finite number"), &
         spoiled("u", "0.0, 0.5", "theta(2) = NaN; expected a finite number"), &
         spoiled("u", "0.0, 0.5, theta = 0.0, 0.5", "v(2) = NaN"//above_0), &
         spoiled("v", "0.0", "v(1) = 0.0"//above_0), &
         spoiled("v", "1001*1.1", "namelist group &points: "), &
         spoiled("sweep", "'left'", "sweep = 'left'; expected one of 'none' 'up' 'down'"), &
         spoiled("tau_part", "1, 2", "sweep = 'up' along 2 parameters; expected at most one"), &
         spoiled("v", "1.1, 1.5, u = 0.0, 0.0, theta = 0.0, 0.0", "'up' from 2 histories;"), &
         spoiled("refinements", "-1", "refinements = -1"//from_0_count), &
         spoiled("refinements", "5", "refinements = 5; expected a whole number <= 4"), &
         spoiled("refinements", "1", "refinements = 1 in a sweep; expected 0"), &
         spoiled("kept", "-1", "kept = -1"//from_0_count), &
         spoiled("kept", "100001", "kept = 100001; expected a whole number <= 100000")])
   end subroutine test_points

   !> Reads points of a plane.
   subroutine points_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(points_settings_type) :: settings

      call read_points(path, settings, failure)
   end subroutine points_reader

   !> The group &exponents of a scene with a transient of 200.
   subroutine test_exponents(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, exponents_reader, "exponents", [character(len=line_length) :: &
         "count = 3", "t_end = 500.0", "t_turning = 100.0", "interval = 0.5", "blocks = 10", &
         "zero_level = 1.0e-5"], [ &
         spoiled("count", "1", "count = 1"//from_2), &
         spoiled("count", "65", "count = 65; expected a whole number <= 64"), &
         spoiled("t_end", "200.0", "t_end = 200.0; expected a finite number > 200.0"), &
         spoiled("t_turning", "-1.0", "t_turning = -1.0"//from_0), &
         spoiled("interval", "0.0", "interval = 0.0"//above_0), &
         spoiled("blocks", "1", "blocks = 1"//from_2), &
         spoiled("zero_level", "-1.0", "zero_level = -1.0"//from_0), &
         spoiled("zero_level", "0.0, check_tolerances = 1e-5, 0.1", "check_tolerances(2) = 0.1"), &
         spoiled("zero_level", "0.0, check_steps = 0.2, 0.0", "check_steps(2) = 0.0"//above_0)])
   end subroutine test_exponents

   !> Reads how exponents are measured.
   subroutine exponents_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(exponents_settings_type) :: settings
      type(scene_type) :: scene

      scene%t_transient = 200
      call read_exponents(path, scene, settings, failure)
   end subroutine exponents_reader

   !> The group &cases_list.
   subroutine test_cases(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, cases_reader, "cases_list", [character(len=line_length) :: &
         "name = 'decay', 'stiff'", "tau = 0.0, 1.0", "epsilon = 0.3, 0.7", "xi = 0.8, 0.5", &
         "gamma = 0.8, 100.0", "theta = 0.1, 0.0", "u = 0.2, 0.0", "v = 1.5, 1.1", &
         "t_end = 20.0, 5.0", "sample_interval = 0.5, 0.5"], [ &
         spoiled("tau", "-1.0, 1.0", "case 'decay': tau = -1.0"//from_0), &
         spoiled("epsilon", "0.3, -1.0", "case 'stiff': epsilon = -1.0"//above_minus_1), &
         spoiled("xi", "0.0, 0.5", "xi = 0.0"//above_0), &
         spoiled("gamma", "0.8", "case 'stiff': gamma = NaN"//above_0), &
         spoiled("gamma", "0.0, 0.8", "gamma = 0.0"//above_0), &
         spoiled("theta", "Infinity, 0.0", "theta = Inf; expected a finite number"), &
         spoiled("u", "0.0, NaN", "case 'stiff': u = NaN; expected a finite number"), &
         spoiled("v", "0.0, 1.1", "v = 0.0"//above_0), &
         spoiled("t_end", "0.0, 5.0", "t_end = 0.0"//above_0), &
         spoiled("sample_interval", "30.0, 0.5", "sample_interval = 30.0"//above_0//" <= 20.0"), &
         spoiled("sample_interval", "0.0, 0.5", "sample_interval = 0.0"//above_0//" <= 20.0"), &
         spoiled("sample_interval", "1e-7, 0.5", "number of samples t_end/sample_interval"), &
         spoiled("name", "'decay', 'decay'", "name = 'decay' twice; expected each once"), &
         spoiled("name", "'"//repeat("a", 65)//"', 'b'", "name of 65 letters; expected 1 to 64"), &
         spoiled("name", "'', ''", "name: no case; expected at least one")])
   end subroutine test_cases

   !> Reads cases.
   subroutine cases_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(case_type), allocatable :: cases(:)

      call read_cases(path, cases, failure)
   end subroutine cases_reader

   !> The group &measure.
   subroutine test_measure(error)
      !> The first failure
      type(error_type), allocatable, intent(out) :: error

      call expect_refusals(error, measure_reader, "measure", [character(len=line_length) :: &
         "methods = 'auto', 'rk4_cubic'", "tolerances = 1.0e-6, 1.0e-9", "steps = 0.01", &
         "most_steps = 1000", "repeats = 2", "least_seconds = 1.0e-4"], [ &
         spoiled("methods", "'euler'", "methods = 'euler'; expected one of 'auto' "), &
         spoiled("methods", "'auto', 'rk4_cubicx'", "methods = 'rk4_cubicx'; expected"), &
         spoiled("tolerances", "1e-3, 9.9e-14", "tolerances = 9.9E-014; expected a finite"), &
         spoiled("tolerances", "1e-3, 0.11", "tolerances = 0.11; expected a finite number"), &
         spoiled("steps", "0.1, 0.0", "steps = 0.0"//above_0), &
         spoiled("most_steps", "0", "most_steps = 0"//from_1), &
         spoiled("repeats", "-1", "repeats = -1"//from_0_count), &
         spoiled("least_seconds", "-1.0", "least_seconds = -1.0"//from_0)])
   end subroutine test_measure

   !> Reads what is measured.
   subroutine measure_reader(path, failure)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      type(measure_settings_type) :: settings

      call read_measure(path, settings, failure)
   end subroutine measure_reader
end module test_io_surveys
