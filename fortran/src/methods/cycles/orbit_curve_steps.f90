!> Steps along a curve of special points of periodic orbits: the next point is sought beside the
!> direction of the curve, by the secant method.
module orbit_curve_steps
   use branch_ends, only: follow_settings_type, most_rounds, refinement_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use orbit_change, only: orbit_change_type
   use orbit_mesh, only: adapted_mesh
   use orbit_surface, only: frame_type, test_beside, turn_along
   use periodic_orbit, only: periodic_orbit_type
   use special_points, only: fold, judge_point, special_point_type
   implicit none (type, external)
   private
   public :: frame_on, is_accurate, take_step

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
      type(periodic_orbit_type) :: before
      real(wp) :: ahead, g, most_beside
      integer :: intervals, more, round

      passes = .false.
      evaluations = 0
      ahead = step
      most_beside = most_bend*max(step, settings%least_step)
      associate (refinement => settings%refinement)
         intervals = point%orbit%intervals()
         do round = 1, most_rounds
            before = point%orbit%on_mesh(adapted_mesh(point%orbit, intervals))
            frame = frame_on(frame, point%orbit, before)
            call find_beside(settings, before, frame, ahead, most_beside, point, more, &
                             error)
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
               call judge_point(settings, point, g, error)
               if (allocated(error)) return
            end if
            if (is_accurate(point, refinement)) exit
            if (round > 1) intervals = refinement%next_intervals(intervals)
            ahead = 0.0_wp
         end do
         call turn_along(settings, point, frame, error)
      end associate
   end subroutine take_step

   !> The root of the test function on the line beside the end of a step, by the secant method.
   subroutine find_beside(settings, before, frame, ahead, most, point, evaluations, error)
      type(follow_settings_type), intent(in) :: settings
      type(periodic_orbit_type), intent(in) :: before
      !> Directions there, and the slope of the test function, which is improved
      type(frame_type), intent(inout) :: frame
      real(wp), intent(in) :: ahead
      !> Most that the root may lie beside it
      real(wp), intent(in) :: most
      type(special_point_type), intent(inout) :: point
      integer, intent(out) :: evaluations
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: change
      real(wp) :: at, g, g_before, move

      point%orbit = before
      change = frame%directions(1)%times(ahead)
      at = 0.0_wp
      move = 0.0_wp
      do evaluations = 1, most_evaluations
         call change%add_to(point%orbit, settings%family)
         call test_beside(settings, before, frame%directions, [ahead, at], point, g, error)
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
end module orbit_curve_steps
