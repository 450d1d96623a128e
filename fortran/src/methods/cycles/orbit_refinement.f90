!> Multipliers of an orbit on a mesh that is fine enough for them.
module orbit_refinement
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use orbit_change, only: orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type, turn_to_tangent
   use orbit_passes, only: orbit_scale_type
   use orbit_mesh, only: adapted_mesh
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: problem_family_type
   implicit none (type, external)
   private
   public :: make_accurate, most_rounds, refinement_type

   !> What is accurate.
   type :: refinement_type
      !> Number of multipliers
      integer :: multipliers = 8
      !> Distance of the trivial multiplier from 1 beyond which the mesh is adapted and gets more
      !> intervals
      real(wp) :: accuracy = 1.0e-7_wp
      !> Most intervals
      integer :: most_intervals = 200
   contains
      !> Intervals of the next mesh where one is not accurate
      procedure :: next_intervals
   end type refinement_type

   !> Adaptions of a mesh that is not accurate, and how its intervals grow after the second
   integer, parameter :: most_rounds = 4
   real(wp), parameter :: growth = 1.3_wp

contains

   !> Intervals of the next mesh where one is not accurate.
   pure integer function next_intervals(self, intervals) result(next)
      !> What is accurate
      class(refinement_type), intent(in) :: self
      !> Intervals of that mesh
      integer, intent(in) :: intervals

      next = max(intervals, min(ceiling(growth*intervals), self%most_intervals))
   end function next_intervals

   !> Find the multipliers, on an adapted mesh where that is due or where the trivial multiplier is
   !> not accurate, and on more intervals where that is not enough.
   subroutine make_accurate(family, scale, refinement, orbit, along, multipliers, due, error)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> Free parameters
      type(orbit_scale_type), intent(in) :: scale
      !> What is accurate
      type(refinement_type), intent(in) :: refinement
      !> The orbit
      type(periodic_orbit_type), intent(inout) :: orbit
      !> Tangent of the branch at the orbit
      type(orbit_change_type), intent(inout) :: along
      !> Multipliers of the orbit
      type(multipliers_type), intent(out) :: multipliers
      !> Whether the mesh is to be adapted anyway
      logical, intent(in) :: due
      !> No multipliers
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: failure
      type(multipliers_type) :: better
      type(newton_type) :: newton
      type(orbit_change_type) :: direction(1)
      type(periodic_orbit_type) :: adapted, reference
      integer :: intervals, round

      call find_multipliers(family, orbit, refinement%multipliers, multipliers, error)
      if (allocated(error)) return
      intervals = orbit%intervals()
      do round = 1, most_rounds
         if (multipliers%trivial_error <= refinement%accuracy) then
            if (round > 1 .or. .not. due) return
         end if
         reference = orbit%on_mesh(adapted_mesh(orbit, intervals))
         direction(1) = along%on_mesh(orbit, reference%mesh)
         adapted = reference
         call correct_orbit(family, scale, reference, direction, [0.0_wp], adapted, newton, &
                            failure)
         if (allocated(failure)) return
         call turn_to_tangent(family, scale, adapted, direction(1), failure)
         if (allocated(failure)) return
         call find_multipliers(family, adapted, refinement%multipliers, better, failure)
         if (allocated(failure)) return
         orbit = adapted
         along = direction(1)
         multipliers = better
         if (round > 1) intervals = refinement%next_intervals(intervals)
      end do
   end subroutine make_accurate
end module orbit_refinement
