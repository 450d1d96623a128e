!> Single periodic orbits for tests: corrected, or those that a trajectory of the block has reached.
module orbit_runs
   use block_family, only: block_family_type, vector_of
   use collocation_basis, only: collocation_basis_type
   use dde, only: continuation_type, integrate, integration_result
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect_success
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use mctc_env_testing, only: error_type
   use orbit_change, only: orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type
   use orbit_mesh, only: adapted_mesh
   use orbit_passes, only: orbit_scale_type
   use orbit_start, only: orbit_of_trajectory
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: problem_family_type
   use solving, only: at_tolerance
   use spring_block, only: index_of_ln_v, spring_block_type
   implicit none (type, external)
   private
   public :: correct, cycle_of_block

contains

   !> Correct an orbit at fixed parameters.
   subroutine correct(family, orbit, newton, failure)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(inout) :: orbit
      !> The method
      type(newton_type), intent(inout) :: newton
      !> No convergence
      type(failure_type), allocatable, intent(out) :: failure
      type(orbit_change_type) :: no_direction(0)
      type(orbit_scale_type) :: none
      type(periodic_orbit_type) :: reference
      real(wp) :: no_distance(0)

      allocate (none%free(0), none%unit(0))
      reference = orbit
      call correct_orbit(family, none, reference, no_direction, no_distance, orbit, newton, failure)
   end subroutine correct

   !> The orbit of a block that a trajectory has reached, with its multipliers.
   subroutine cycle_of_block(block, t_end, degree, points, intervals, orbit, multipliers, error)
      !> The block
      type(spring_block_type), intent(in) :: block
      !> Time of the trajectory
      real(wp), intent(in) :: t_end
      !> Degree, kind of points and intervals
      integer, intent(in) :: degree, points, intervals
      !> The orbit
      type(periodic_orbit_type), intent(out) :: orbit
      !> Its multipliers
      type(multipliers_type), intent(out) :: multipliers
      type(error_type), allocatable, intent(inout) :: error
      type(block_family_type) :: family
      type(continuation_type) :: arrived
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(newton_type) :: newton
      integer :: i

      call integrate(block, 0.0_wp, t_end, at_tolerance(1.0e-9_wp, "auto"), outcome, failure, &
                     continuation=arrived)
      call expect_success(error, failure)
      if (allocated(error)) return
      call orbit_of_trajectory(block, at_tolerance(1.0e-9_wp, "auto"), arrived, index_of_ln_v, &
                               100.0_wp, collocation_basis_type(degree, points), intervals, orbit, &
                               failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      orbit%parameters = vector_of(block%parameters)
      do i = 1, 2
         call correct(family, orbit, newton, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         if (i == 1) orbit = orbit%on_mesh(adapted_mesh(orbit, intervals))
      end do
      call find_multipliers(family, orbit, 6, multipliers, failure)
      call expect_success(error, failure)
   end subroutine cycle_of_block
end module orbit_runs
