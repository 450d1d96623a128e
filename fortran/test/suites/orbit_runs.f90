! SPDX-License-Identifier: BSD-3-Clause
!> Periodic orbits and branches for tests: made up, corrected, or reached by a trajectory.
module orbit_runs
   use block_builder, only: index_of_ln_v
   use branch_ends, only: follow_settings_type
   use collocation_basis, only: collocation_basis_type
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, integration_result
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_success
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use mctc_env_testing, only: error_type
   use model_family, only: fixed_model
   use model_modes, only: mode_of
   use model_problem, only: model_type
   use orbit_branch, only: branch_type, follow_branch
   use orbit_change, only: orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type
   use orbit_linearisation, only: linearise_orbit
   use orbit_mesh, only: adapted_mesh, uniform_mesh
   use orbit_passes, only: orbit_passes_type
   use orbit_points, only: find_special_points
   use orbit_start, only: orbit_at_hopf_point, orbit_of_trajectory
   use periodic_orbit, only: periodic_orbit_type
   use solving, only: at_tolerance, run
   use special_points, only: special_point_type
   implicit none (type, external)
   private
   public :: branch_from, branch_from_hopf, correct, cycle_of_block, last_maxima, multipliers_of, &
             new_orbit, orbit_of_block, sine_orbit

contains

   !> An orbit on a uniform mesh, without its nodes.
   pure type(periodic_orbit_type) function new_orbit(degree, intervals, period, parameters) &
      result(orbit)
      integer, intent(in) :: degree, intervals
      real(wp), intent(in) :: period, parameters(:)

      orbit%basis = collocation_basis_type(degree)
      orbit%mesh = uniform_mesh(intervals)
      orbit%period = period
      orbit%parameters = parameters
   end function new_orbit

   !> An orbit of made_circle, one turn of a sine, before its correction.
   pure type(periodic_orbit_type) function sine_orbit(degree, intervals, amplitude, period, &
                                                      parameters) result(orbit)
      integer, intent(in) :: degree, intervals
      real(wp), intent(in) :: amplitude, period, parameters(3)

      orbit = new_orbit(degree, intervals, period, parameters)
      associate (s => orbit%node_times())
         orbit%nodes = reshape(amplitude*sin(2.0_wp*acos(-1.0_wp)*s), [1, size(s)])
      end associate
   end function sine_orbit

   !> Correct an orbit at fixed parameters.
   subroutine correct(model, orbit, newton, failure)
      !> The model, which keeps delays of 0
      class(model_type), intent(in) :: model
      type(periodic_orbit_type), intent(inout) :: orbit
      type(newton_type), intent(inout) :: newton
      type(failure_type), allocatable, intent(out) :: failure
      type(orbit_change_type) :: no_direction(0)
      type(periodic_orbit_type) :: reference

      reference = orbit
      call correct_orbit(fixed_model(model), reference, no_direction, [real(wp) ::], orbit, &
                         newton, failure)
   end subroutine correct

   !> Maxima of a component of a run in the last part of its time.
   subroutine last_maxima(problem, component, t_end, last, maxima, error)
      class(dde_problem_type), intent(in) :: problem
      integer, intent(in) :: component
      !> Its end, and the time before it
      real(wp), intent(in) :: t_end, last
      real(wp), allocatable, intent(out) :: maxima(:)
      type(error_type), allocatable, intent(inout) :: error
      type(event_table) :: found
      type(integration_result) :: outcome

      found = event_table(component=[component], level=[0.0_wp], direction=[-1], of_slope=[.true.])
      if (.not. allocated(error)) then
         call run(error, problem, 0.0_wp, t_end, at_tolerance(1.0e-8_wp), outcome, watcher=found)
      end if
      associate (n => found%received)
         maxima = pack(found%y(component, :n), found%time(:n)%hi > t_end - last)
      end associate
   end subroutine last_maxima

   !> The orbit of a block that a trajectory has reached, before its correction.
   subroutine orbit_of_block(block, t_end, degree, intervals, orbit, error)
      type(model_type), intent(in) :: block
      real(wp), intent(in) :: t_end
      integer, intent(in) :: degree, intervals
      type(periodic_orbit_type), intent(out) :: orbit
      type(error_type), allocatable, intent(inout) :: error
      type(continuation_type) :: arrived
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call run(error, block, 0.0_wp, t_end, at_tolerance(1.0e-9_wp, "auto"), outcome, &
               continuation=arrived)
      if (allocated(error)) return
      call orbit_of_trajectory(block, at_tolerance(1.0e-9_wp, "auto"), arrived, index_of_ln_v, &
                               100.0_wp, collocation_basis_type(degree), intervals, orbit, failure)
      call expect_success(error, failure)
      orbit%parameters = block%numbers
   end subroutine orbit_of_block

   !> The orbit of a block that a trajectory has reached, corrected, with its multipliers.
   subroutine cycle_of_block(block, t_end, degree, intervals, orbit, multipliers, error)
      type(model_type), intent(in) :: block
      real(wp), intent(in) :: t_end
      integer, intent(in) :: degree, intervals
      type(periodic_orbit_type), intent(out) :: orbit
      type(multipliers_type), intent(out) :: multipliers
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(newton_type) :: newton
      integer :: i

      call orbit_of_block(block, t_end, degree, intervals, orbit, error)
      do i = 1, 2
         if (allocated(error)) return
         call correct(mode_of(block, 1), orbit, newton, failure)
         call expect_success(error, failure)
         if (i == 1) orbit = orbit%on_mesh(adapted_mesh(orbit, intervals))
      end do
      call multipliers_of(mode_of(block, 1), orbit, 6, multipliers, error)
   end subroutine cycle_of_block

   !> Multipliers of an orbit of a model.
   subroutine multipliers_of(model, orbit, wanted, multipliers, error)
      class(model_type), intent(in) :: model
      type(periodic_orbit_type), intent(in) :: orbit
      integer, intent(in) :: wanted
      type(multipliers_type), intent(out) :: multipliers
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(orbit_passes_type) :: linear

      if (allocated(error)) return
      call linearise_orbit(fixed_model(model), orbit, linear, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_multipliers(linear, wanted, multipliers, failure)
      call expect_success(error, failure)
   end subroutine multipliers_of

   !> A branch from an orbit, and its special points.
   subroutine branch_from(orbit, settings, direction, branch, special, error, tangent)
      type(periodic_orbit_type), intent(in) :: orbit
      type(follow_settings_type), intent(in) :: settings
      integer, intent(in) :: direction
      type(branch_type), intent(out) :: branch
      type(special_point_type), allocatable, intent(out) :: special(:)
      type(error_type), allocatable, intent(inout) :: error
      type(orbit_change_type), intent(in), optional :: tangent
      type(failure_type), allocatable :: failure, reasons(:)
      integer, allocatable :: missed(:)

      if (allocated(error)) return
      call follow_branch(settings, orbit, direction, branch, failure, tangent)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_special_points(settings, branch, special, missed, reasons)
      call expect(error, size(missed) == 0, "all special points found")
   end subroutine branch_from

   !> The branch from a Hopf point.
   subroutine branch_from_hopf(settings, parameters, omega, amplitude, branch, special, error)
      type(follow_settings_type), intent(in) :: settings
      real(wp), intent(in) :: parameters(:), omega, amplitude
      type(branch_type), intent(out) :: branch
      type(special_point_type), allocatable, intent(out) :: special(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(orbit_change_type) :: tangent
      type(periodic_orbit_type) :: orbit

      call orbit_at_hopf_point(settings%family, parameters, omega, amplitude, &
                               collocation_basis_type(5), 20, orbit, tangent, failure)
      call expect_success(error, failure)
      call branch_from(orbit, settings, 1, branch, special, error, tangent)
   end subroutine branch_from_hopf
end module orbit_runs
