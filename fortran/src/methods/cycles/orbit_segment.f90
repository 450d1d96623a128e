!> The periodic orbits between two of a branch.
module orbit_segment
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use orbit_change, only: difference_of, inner_product, orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type
   use orbit_passes, only: orbit_scale_type
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: problem_family_type
   implicit none (type, external)
   private
   public :: orbit_on, segment_between, segment_type

   !> The orbits between two of a branch, in the direction from the first to the second.
   type :: segment_type
      !> First and second orbit, on one mesh
      type(periodic_orbit_type) :: ends(2)
      !> Direction, of norm 1
      type(orbit_change_type) :: along(1)
      !> Distance of the two
      real(wp) :: length = 0.0_wp
   end type segment_type

contains

   !> The segment between two orbits, on the mesh of the first.
   type(segment_type) function segment_between(first, second, scale) result(segment)
      !> The orbits
      type(periodic_orbit_type), intent(in) :: first, second
      !> Free parameters
      type(orbit_scale_type), intent(in) :: scale

      segment%ends(1) = first
      segment%ends(2) = second%on_mesh(first%mesh)
      segment%along(1) = difference_of(segment%ends(2), first, scale)
      associate (d => segment%along(1))
         segment%length = sqrt(inner_product(first, d, d))
         d%nodes = d%nodes/segment%length
         d%period = d%period/segment%length
         d%parameters = d%parameters/segment%length
      end associate
   end function segment_between

   !> The orbit at a place on a segment.
   subroutine orbit_on(family, scale, segment, place, orbit, error)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> Free parameters
      type(orbit_scale_type), intent(in) :: scale
      !> The segment
      type(segment_type), intent(in) :: segment
      !> Place, 0..1
      real(wp), intent(in) :: place
      !> The orbit
      type(periodic_orbit_type), intent(out) :: orbit
      !> There is none
      type(error_type), allocatable, intent(out) :: error
      type(newton_type) :: newton

      associate (first => segment%ends(1), second => segment%ends(2))
         orbit = first
         orbit%nodes = (1.0_wp - place)*first%nodes + place*second%nodes
         orbit%period = (1.0_wp - place)*first%period + place*second%period
         orbit%parameters = (1.0_wp - place)*first%parameters + place*second%parameters
         call correct_orbit(family, scale, first, segment%along, [place*segment%length], &
                            orbit, newton, error)
      end associate
   end subroutine orbit_on
end module orbit_segment
