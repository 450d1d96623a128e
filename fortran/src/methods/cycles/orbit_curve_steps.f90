! SPDX-License-Identifier: BSD-3-Clause
!> Steps along a curve of special points of periodic orbits: the orbits near a point are a surface
!> over the tangent plane of two parameters; the next point is sought on it beside the direction of
!> the curve, by the secant method.
module orbit_curve_steps
   use branch_ends, only: follow_settings_type, refinement_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use orbit_change, only: amplitude_direction, inner_product, orbit_change_type, &
                           parameter_direction
   use orbit_equations, only: correct_orbit, find_tangents, newton_type
   use orbit_mesh, only: adapted_mesh
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   use special_points, only: fold, judge_point, special_point_type
   implicit none (type, external)
   private
   public :: first_plane, frame_on, frame_type, is_accurate, take_step, turn_along

   !> Where a curve goes, at a point of it.
   type :: frame_type
      !> Along the curve, and beside it on the surface of orbits; orthonormal
      type(orbit_change_type) :: directions(2)
      !> Derivative of the test function beside the curve
      real(wp) :: slope = 0.0_wp
   end type frame_type

   !> Distance of the evaluations for the derivative of the test function
   real(wp), parameter :: beside = 1.0e-6_wp
   !> Evaluations of the test function at one point, and the distance between two at which it is
   !> zero
   integer, parameter :: most_evaluations = 8
   real(wp), parameter :: share = 1.0e-9_wp
   !> Distance of two evaluations from which the slope of the test function is known
   real(wp), parameter :: resolved = 1.0e-6_wp
   !> Most that a point may lie beside its prediction, in steps
   real(wp), parameter :: most_bend = 0.5_wp

contains

   !> The next point of a curve, on a mesh that is adapted to it until it is accurate.
   subroutine take_step(settings, step, point, frame, evaluations, passes, error)
      !> How far and how
      type(follow_settings_type), intent(in) :: settings
      !> Length of the step
      real(wp), intent(in) :: step
      !> The last point, then this one
      type(special_point_type), intent(inout) :: point
      !> Directions at the last point, then at this one
      type(frame_type), intent(inout) :: frame
      !> Evaluations of the test function
      integer, intent(out) :: evaluations
      !> Whether the curve passes through a shorter cycle
      logical, intent(out) :: passes
      !> The step is too long
      type(error_type), allocatable, intent(out) :: error
      type(newton_type) :: newton
      type(periodic_orbit_type) :: before
      real(wp) :: ahead, g, g_found, most_beside
      integer :: intervals, more, round

      passes = .false.
      evaluations = 0
      ahead = step
      most_beside = most_bend*max(step, settings%least_step)
      associate (refinement => settings%refinement)
         intervals = point%orbit%intervals()
         do round = 1, refinement%most_rounds
            before = point%orbit%on_mesh(adapted_mesh(point%orbit, intervals))
            frame = frame_on(frame, point%orbit, before)
            call find_beside(settings, before, frame, ahead, most_beside, point, newton, g_found, &
                             more, error)
            if (allocated(error)) return
            if (round == 1) then
               evaluations = more
               passes = point%orbit%opposite_parts(before) > 0
               if (passes) then
                  call raise(error, "the step passes through a shorter cycle")
                  return
               end if
            end if
            if (point%kind == fold) then
               call judge_point(settings, point, newton%linear, g, error)
               if (allocated(error)) return
            end if
            if (is_accurate(point, refinement)) exit
            if (round > 1) intervals = refinement%next_intervals(intervals)
            ahead = 0.0_wp
         end do
         call turn_along(settings, point, newton%linear, frame, error, g_found)
      end associate
   end subroutine take_step

   !> The root of the test function on the line beside the end of a step, by the secant method.
   subroutine find_beside(settings, before, frame, ahead, most, point, newton, g, evaluations, &
                          error)
      type(follow_settings_type), intent(in) :: settings
      type(periodic_orbit_type), intent(in) :: before
      !> Directions there, and the slope of the test function, which is improved
      type(frame_type), intent(inout) :: frame
      real(wp), intent(in) :: ahead
      !> Most that the root may lie beside it
      real(wp), intent(in) :: most
      type(special_point_type), intent(inout) :: point
      !> What corrected its orbit
      type(newton_type), intent(out) :: newton
      !> The test function there
      real(wp), intent(out) :: g
      integer, intent(out) :: evaluations
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: change
      real(wp) :: at, g_before, move

      point%orbit = before
      change = frame%directions(1)%times(ahead)
      at = 0.0_wp
      move = 0.0_wp
      do evaluations = 1, most_evaluations
         call change%add_to(point%orbit, settings%family)
         call test_beside(settings, before, frame%directions, [ahead, at], point, newton, g, error)
         if (allocated(error)) return
         ! at a shorter distance the difference is one of rounding errors
         if (abs(move) > resolved) frame%slope = (g - g_before)/move
         move = -g/frame%slope
         if (abs(move) <= share) return
         change = frame%directions(2)%times(move)
         at = at + move
         g_before = g
         if (.not. abs(at) <= most) exit
      end do
      call raise(error, "the curve bends: its next point is "//text(at)//" beside a step of " &
                 //text(ahead))
   end subroutine find_beside

   !> Directions on the mesh of another orbit.
   type(frame_type) function frame_on(frame, orbit, other) result(value)
      !> The directions
      type(frame_type), intent(in) :: frame
      !> The orbit they belong to, and that on the other mesh
      type(periodic_orbit_type), intent(in) :: orbit, other
      integer :: i

      value%slope = frame%slope
      do i = 1, 2
         value%directions(i) = frame%directions(i)%on_mesh(orbit, other%mesh)
      end do
   end function frame_on

   !> Whether the multipliers of a point are accurate. At a fold the trivial one is double: then its
   !> error is the square root of the other errors.
   pure logical function is_accurate(point, refinement) result(value)
      !> The point
      type(special_point_type), intent(in) :: point
      !> What is accurate
      type(refinement_type), intent(in) :: refinement

      value = point%trivial_error <= refinement%accuracy
      if (point%kind == fold) value = point%trivial_error <= sqrt(refinement%accuracy)
   end function is_accurate

   !> Turn the directions at a point: along the first the test function does not change.
   subroutine turn_along(settings, point, linear, frame, error, known)
      !> Problems and number of multipliers
      type(follow_settings_type), intent(in) :: settings
      !> The point
      type(special_point_type), intent(in) :: point
      !> Linear equations about its orbit
      type(orbit_passes_type), intent(in) :: linear
      !> Orthonormal directions, near the tangent plane; the first keeps its sense
      type(frame_type), intent(inout) :: frame
      !> There are none
      type(error_type), allocatable, intent(out) :: error
      !> The test function there, if it is known
      real(wp), intent(in), optional :: known
      type(orbit_change_type) :: plane(2)
      real(wp) :: g, g_here, slope(2)
      integer :: i

      call turn_frame(point%orbit, linear, frame%directions, error)
      if (allocated(error)) return
      if (present(known)) then
         g_here = known
      else
         call test_near(settings, point, frame, [0.0_wp, 0.0_wp], g_here, error)
         if (allocated(error)) return
      end if
      do i = 1, 2
         call test_near(settings, point, frame, beside*[2 - i, i - 1], g, error)
         if (allocated(error)) return
         slope(i) = (g - g_here)/beside
      end do
      associate (across => slope/norm2(slope))
         plane(1) = combination(frame%directions, sign(1.0_wp, slope(2))*[across(2), -across(1)])
         plane(2) = combination(frame%directions, across)
      end associate
      frame = frame_type(plane, norm2(slope))
   end subroutine turn_along

   !> Orthonormal directions of the tangent plane at an orbit.
   subroutine first_plane(orbit, linear, plane, error)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Linear equations about it
      type(orbit_passes_type), intent(in) :: linear
      !> The directions
      type(orbit_change_type), intent(out) :: plane(2)
      !> There are none
      type(error_type), allocatable, intent(out) :: error

      ! at a fold the amplitude determines the orbit, not the parameter
      plane(1) = amplitude_direction(orbit, 2)
      plane(2) = parameter_direction(orbit, 2)
      call turn_frame(orbit, linear, plane, error)
   end subroutine first_plane

   !> Turn two directions into orthonormal ones of the tangent plane; the first keeps its direction
   !> in it.
   subroutine turn_frame(orbit, linear, directions, error)
      type(periodic_orbit_type), intent(in) :: orbit
      type(orbit_passes_type), intent(in) :: linear
      type(orbit_change_type), intent(inout) :: directions(2)
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: plane(2)

      call find_tangents(orbit, linear, directions, plane, error)
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
      type(newton_type) :: newton
      type(orbit_change_type) :: move
      type(special_point_type) :: near

      near = point
      move = combination(frame%directions, place)
      call move%add_to(near%orbit, settings%family)
      call test_beside(settings, point%orbit, frame%directions, place, near, newton, g, error)
   end subroutine test_near

   !> The orbit at a place of the plane about an orbit, and the test function of a point there.
   subroutine test_beside(settings, before, directions, place, point, newton, g, error)
      type(follow_settings_type), intent(in) :: settings
      type(periodic_orbit_type), intent(in) :: before
      type(orbit_change_type), intent(in) :: directions(2)
      real(wp), intent(in) :: place(2)
      !> The point, of known kind; its orbit is first an approximation
      type(special_point_type), intent(inout) :: point
      !> What corrected its orbit
      type(newton_type), intent(out) :: newton
      real(wp), intent(out) :: g
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: plane(2)

      g = 0.0_wp
      call correct_orbit(settings%family, before, directions, place, point%orbit, newton, error)
      if (allocated(error)) return
      if (point%kind /= fold) then
         call judge_point(settings, point, newton%linear, g, error)
         return
      end if
      ! at a fold there is a tangent along which no parameter changes
      call find_tangents(point%orbit, newton%linear, directions, plane, error)
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
end module orbit_curve_steps
