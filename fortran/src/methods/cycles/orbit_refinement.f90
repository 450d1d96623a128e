!> Multipliers of an orbit on a mesh that is fine enough for them.
module orbit_refinement
   use branch_ends, only: follow_settings_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use orbit_change, only: orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type, turn_to_tangent
   use orbit_mesh, only: adapted_mesh
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: make_accurate, most_rounds

   !> Adaptions of a mesh that is not accurate; its intervals grow after the second
   integer, parameter :: most_rounds = 4

contains

   !> Find the multipliers, on an adapted mesh where that is due or where the trivial multiplier is
   !> not accurate, and on more intervals where that is not enough.
   subroutine make_accurate(settings, orbit, along, multipliers, due, error)
      !> Problems, and what is accurate
      type(follow_settings_type), intent(in) :: settings
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

      associate (family => settings%family, refinement => settings%refinement)
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
            call correct_orbit(family, reference, direction, [0.0_wp], adapted, newton, &
                               failure)
            if (allocated(failure)) return
            call turn_to_tangent(family, adapted, direction(1), failure)
            if (allocated(failure)) return
            call find_multipliers(family, adapted, refinement%multipliers, better, failure)
            if (allocated(failure)) return
            orbit = adapted
            along = direction(1)
            multipliers = better
            if (round > 1) intervals = refinement%next_intervals(intervals)
         end do
      end associate
   end subroutine make_accurate
end module orbit_refinement
