!> Periodic orbits near a special point, as a surface over the tangent plane of two parameters.
module orbit_surface
   use branch_ends, only: follow_settings_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use orbit_change, only: amplitude_direction, inner_product, orbit_change_type, &
                           parameter_direction
   use orbit_equations, only: correct_orbit, find_tangents, newton_type
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: free_family_type
   use special_points, only: fold, judge_point, special_point_type
   implicit none (type, external)
   private
   public :: first_plane, frame_type, test_beside, turn_along

   !> Where a curve goes, at a point of it.
   type :: frame_type
      !> Along the curve, and beside it on the surface of orbits; orthonormal
      type(orbit_change_type) :: directions(2)
      !> Derivative of the test function beside the curve
      real(wp) :: slope = 0.0_wp
   end type frame_type

   !> Distance of the evaluations for the derivative of the test function
   real(wp), parameter :: beside = 1.0e-4_wp

contains

   !> Turn the directions at a point: along the first the test function does not change.
   subroutine turn_along(settings, point, frame, error)
      !> Problems and number of multipliers
      type(follow_settings_type), intent(in) :: settings
      !> The point
      type(special_point_type), intent(in) :: point
      !> Orthonormal directions, near the tangent plane; the first keeps its sense
      type(frame_type), intent(inout) :: frame
      !> There are none
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: plane(2)
      real(wp) :: g(2), slope(2)
      integer :: i, j

      call turn_frame(settings%family, point%orbit, frame%directions, error)
      if (allocated(error)) return
      do i = 1, 2
         do j = 1, 2
            call test_near(settings, point, frame, (3 - 2*j)*beside*[2 - i, i - 1], &
                           g(j), error)
            if (allocated(error)) return
         end do
         slope(i) = (g(1) - g(2))/(2.0_wp*beside)
      end do
      associate (across => slope/norm2(slope))
         plane(1) = combination(frame%directions, sign(1.0_wp, slope(2))*[across(2), -across(1)])
         plane(2) = combination(frame%directions, across)
      end associate
      frame = frame_type(plane, norm2(slope))
   end subroutine turn_along

   !> Orthonormal directions of the tangent plane at an orbit.
   subroutine first_plane(family, orbit, plane, error)
      !> Problems and free parameters
      type(free_family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> The directions
      type(orbit_change_type), intent(out) :: plane(2)
      !> There are none
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: rough(2)

      ! at a fold the amplitude determines the orbit, not the parameter
      rough = [amplitude_direction(orbit, 2), parameter_direction(orbit, 2)]
      call turn_frame(family, orbit, rough, error)
      plane = rough
   end subroutine first_plane

   !> Turn two directions into orthonormal ones of the tangent plane; the first keeps its direction
   !> in it.
   subroutine turn_frame(family, orbit, directions, error)
      type(free_family_type), intent(in) :: family
      type(periodic_orbit_type), intent(in) :: orbit
      type(orbit_change_type), intent(inout) :: directions(2)
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: plane(2)

      call find_tangents(family, orbit, directions, plane, error)
      if (allocated(error)) return
      associate (first => plane(1), second => plane(2))
         first = first%times(1.0_wp/sqrt(inner_product(orbit, first, first)))
         second = second%plus(first, -inner_product(orbit, first, second))
         second = second%times(1.0_wp/sqrt(inner_product(orbit, second, second)))
      end associate
      directions = plane
   end subroutine turn_frame

   !> The test function at a place of the plane near a point.
   subroutine test_near(settings, point, frame, place, g, error)
      type(follow_settings_type), intent(in) :: settings
      type(special_point_type), intent(in) :: point
      type(frame_type), intent(in) :: frame
      real(wp), intent(in) :: place(2)
      real(wp), intent(out) :: g
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: move
      type(special_point_type) :: near

      near = point
      move = combination(frame%directions, place)
      call move%add_to(near%orbit, settings%family)
      call test_beside(settings, point%orbit, frame%directions, place, near, g, error)
   end subroutine test_near

   !> The orbit at a place of the plane about an orbit, and the test function of a point there.
   subroutine test_beside(settings, before, directions, place, point, g, error)
      !> Problems and number of multipliers
      type(follow_settings_type), intent(in) :: settings
      !> The orbit
      type(periodic_orbit_type), intent(in) :: before
      !> Directions of the plane
      type(orbit_change_type), intent(in) :: directions(2)
      !> Place
      real(wp), intent(in) :: place(2)
      !> The point, of known kind; its orbit is first an approximation
      type(special_point_type), intent(inout) :: point
      !> The test function
      real(wp), intent(out) :: g
      !> There is no orbit
      type(error_type), allocatable, intent(out) :: error
      type(newton_type) :: newton
      type(orbit_change_type) :: plane(2)

      g = 0.0_wp
      call correct_orbit(settings%family, before, directions, place, point%orbit, newton, error)
      if (allocated(error)) return
      if (point%kind /= fold) then
         call judge_point(settings, point, g, error)
         return
      end if
      ! at a fold there is a tangent along which no parameter changes
      call find_tangents(settings%family, point%orbit, directions, plane, error)
      if (allocated(error)) return
      g = plane(1)%parameters(1)*plane(2)%parameters(2) &
          - plane(1)%parameters(2)*plane(2)%parameters(1)
   end subroutine test_beside

   !> A linear combination of two changes.
   type(orbit_change_type) function combination(changes, factors) result(change)
      type(orbit_change_type), intent(in) :: changes(2)
      real(wp), intent(in) :: factors(2)

      change = changes(1)%times(factors(1))
      change = change%plus(changes(2), factors(2))
   end function combination
end module orbit_surface
