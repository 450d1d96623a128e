!> Curves of special points of periodic orbits in two parameters. The orbits near a point are a
!> surface over its tangent plane. The curve is where a test function of the point is 0 on it: an
!> orbit is sought beside the direction of the curve, by the secant method.
module orbit_curves
   use branch_ends, only: is_closed, longer, shorter
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use orbit_change, only: difference_of, inner_product, orbit_change_type
   use orbit_mesh, only: adapted_mesh
   use orbit_passes, only: orbit_scale_type
   use orbit_refinement, only: refinement_type
   use orbit_surface, only: first_plane, frame_type, test_beside, turn_along, turn_frame
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: problem_family_type
   use special_points, only: fold, special_point_type, torus_bifurcation
   implicit none (type, external)
   private
   public :: curve_settings_type, curve_type, follow_curve

   !> How far a curve is followed, and how.
   type :: curve_settings_type
      !> The two free parameters and their units
      type(orbit_scale_type) :: scale
      !> Windows on them, shape (2, parameters)
      real(wp) :: window(2, 2) = reshape([-1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      !> First, least and longest step, in units of arclength
      real(wp) :: first_step = 0.01_wp, least_step = 1.0e-6_wp, longest_step = 0.1_wp
      !> Most points
      integer :: most_points = 200
      !> The curve ends at a Hopf curve where no component has a larger range.
      real(wp) :: least_amplitude = 0.02_wp
      !> It ends where the period is longer.
      real(wp) :: longest_period = huge(1.0_wp)
      !> Multipliers and their accuracy
      type(refinement_type) :: refinement
   end type curve_settings_type

   !> A curve.
   type :: curve_type
      !> Its points; the first is the one it starts at
      type(special_point_type), allocatable :: points(:)
      !> Why it ends: 'window', 'generalised_hopf' (folds) or 'double_hopf' (others), '1:1' or
      !> '1:2' (resonances), 'closed', 'shorter_period' (at a cycle of a part of the period),
      !> 'period', 'points', 'convergence'
      character(len=:), allocatable :: ending
      !> Points of a curve of folds before which it turns back in both parameters: cusps
      integer, allocatable :: cusps(:)
   end type curve_type

   !> Evaluations of the test function at one point, and the distance between two at which it is
   !> zero
   integer, parameter :: most_evaluations = 8
   real(wp), parameter :: share = 1.0e-9_wp
   !> Distance of two evaluations from which the slope of the test function is known
   real(wp), parameter :: resolved = 1.0e-6_wp
   !> Evaluations after which the next step is longer
   integer, parameter :: easy = 4
   !> Most that a point may lie beside its prediction, in steps
   real(wp), parameter :: most_bend = 0.5_wp
   !> Angle of a pair, in turns, so close to 0 or 1/2 that the curve ends in a resonance
   real(wp), parameter :: resonant = 0.004_wp
   !> How the intervals grow where the mesh is not accurate
   real(wp), parameter :: growth = 1.3_wp

contains

   !> Follow the curve through a special point in one of its two directions.
   subroutine follow_curve(family, settings, start, direction, curve, error)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> How far and how
      type(curve_settings_type), intent(in) :: settings
      !> The point
      type(special_point_type), intent(in) :: start
      !> 1 or -1: towards greater or smaller values of the second parameter at first
      integer, intent(in) :: direction
      !> The curve
      type(curve_type), intent(out) :: curve
      !> The point has no curve
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: failure
      type(frame_type) :: frame, next_frame
      type(special_point_type) :: next
      real(wp) :: step
      integer :: evaluations, i
      logical :: passed, passes

      allocate (curve%points(settings%most_points), curve%cusps(0))
      curve%points(1) = start
      call first_plane(family, settings%scale, start%orbit, frame%directions, error)
      if (allocated(error)) return
      call turn_along(family, settings%scale, settings%refinement%multipliers, start, frame, error)
      if (allocated(error)) return
      associate (along => frame%directions(1))
         if (along%parameters(2)*direction < 0.0_wp) along = along%times(-1.0_wp)
      end associate
      curve%ending = "points"
      passed = .false.
      step = settings%first_step
      i = 1
      do while (i < settings%most_points)
         next = curve%points(i)
         next_frame = frame
         call take_step(family, settings, step, next, next_frame, evaluations, passes, failure)
         if (allocated(failure)) then
            step = shorter*step
            passed = passed .or. passes
            if (step >= settings%least_step) cycle
            curve%ending = trim(merge("shorter_period", "convergence   ", passed))
            exit
         end if
         passed = .false.
         if (sum(frame%directions(1)%parameters*next_frame%directions(1)%parameters) < 0.0_wp &
             .and. next%kind == fold) curve%cusps = [curve%cusps, i + 1]
         frame = next_frame
         i = i + 1
         curve%points(i) = next
         if (has_ended(settings, curve%points, i, step, curve%ending)) exit
         if (evaluations <= easy) step = min(longer*step, settings%longest_step)
      end do
      call cut(curve%points, i)
   end subroutine follow_curve

   !> The next point of a curve.
   subroutine take_step(family, settings, step, point, frame, evaluations, passes, error)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> How far and how
      type(curve_settings_type), intent(in) :: settings
      !> Length of the step
      real(wp), intent(in) :: step
      !> The last point, then this one
      type(special_point_type), intent(inout) :: point
      !> Directions at the last point, then at this one
      type(frame_type), intent(inout) :: frame
      !> Evaluations of the test function
      integer, intent(out) :: evaluations
      !> Whether it passes through a shorter cycle
      logical, intent(out) :: passes
      !> The step is too long
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: move
      type(periodic_orbit_type) :: before
      integer :: i, intervals

      passes = .false.
      associate (scale => settings%scale, refinement => settings%refinement)
         intervals = point%orbit%intervals()
         if (.not. accurate(point, refinement)) then
            intervals = max(intervals, min(ceiling(growth*intervals), refinement%most_intervals))
         end if
         before = point%orbit%on_mesh(adapted_mesh(point%orbit, intervals))
         do i = 1, 2
            frame%directions(i) = frame%directions(i)%on_mesh(point%orbit, before%mesh)
         end do
         call find_beside(family, settings, before, frame, step, point, evaluations, error)
         if (allocated(error)) return
         passes = point%orbit%opposite_parts(before) > 0
         if (passes) then
            call raise(error, "the step passes through a shorter cycle")
            return
         end if
         move = difference_of(point%orbit, before, scale)
         frame%directions(1) = move%times(1.0_wp/sqrt(inner_product(before, move, move)))
         call turn_frame(family, scale, point%orbit, frame%directions, error)
         if (allocated(error)) return
         call turn_along(family, scale, refinement%multipliers, point, frame, error)
      end associate
   end subroutine take_step

   !> The root of the test function on the line beside the end of a step, by the secant method.
   subroutine find_beside(family, settings, before, frame, step, point, evaluations, error)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> How far and how
      type(curve_settings_type), intent(in) :: settings
      !> The orbit from which the step goes
      type(periodic_orbit_type), intent(in) :: before
      !> Directions there
      type(frame_type), intent(in) :: frame
      !> Length of the step
      real(wp), intent(in) :: step
      !> The point, of known kind
      type(special_point_type), intent(inout) :: point
      !> Evaluations of the test function
      integer, intent(out) :: evaluations
      !> There is none
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: at, g, g_before, move, slope

      at = 0.0_wp
      move = 0.0_wp
      slope = frame%slope
      do evaluations = 1, most_evaluations
         call test_beside(family, settings%scale, settings%refinement%multipliers, before, &
                          frame%directions, [step, at], point, g, error)
         if (allocated(error)) return
         ! at a shorter distance the difference is one of rounding errors
         if (abs(move) > resolved) slope = (g - g_before)/move
         move = -g/slope
         if (abs(move) <= share) return
         at = at + move
         g_before = g
         if (.not. abs(at) <= most_bend*step) exit
      end do
      call raise(error, "the curve bends: its next point is "//text(at)//" beside a step of " &
                 //text(step))
   end subroutine find_beside

   !> Whether the multipliers of a point are accurate. At a fold the trivial one is double: then its
   !> error is the square root of the other errors.
   pure logical function accurate(point, refinement) result(value)
      !> The point
      type(special_point_type), intent(in) :: point
      !> What is accurate
      type(refinement_type), intent(in) :: refinement

      value = point%trivial_error <= refinement%accuracy
      if (point%kind == fold) value = point%trivial_error <= sqrt(refinement%accuracy)
   end function accurate

   !> Whether a curve ends at its last point, and why.
   logical function has_ended(settings, points, last, step, reason) result(value)
      !> Its limits
      type(curve_settings_type), intent(in) :: settings
      !> Points
      type(special_point_type), intent(in) :: points(:)
      !> The last of them
      integer, intent(in) :: last
      !> Length of the last step
      real(wp), intent(in) :: step
      !> Why, where it ends
      character(len=:), allocatable, intent(inout) :: reason

      value = .true.
      associate (point => points(last), free => settings%scale%free)
         if (any(point%orbit%parameters(free) < settings%window(1, :)) &
             .or. any(point%orbit%parameters(free) > settings%window(2, :))) then
            reason = "window"
         else if (point%orbit%amplitude() < settings%least_amplitude) then
            reason = trim(merge("generalised_hopf", "double_hopf     ", point%kind == fold))
         else if (point%kind == torus_bifurcation .and. abs(point%angle()) < resonant) then
            reason = "1:1"
         else if (point%kind == torus_bifurcation .and. abs(point%angle()) > 0.5_wp - resonant) then
            reason = "1:2"
         else if (point%orbit%period > settings%longest_period) then
            reason = "period"
         else if (point%orbit%comes_to_shorter(points(last - 1)%orbit)) then
            reason = "shorter_period"
         else if (is_closed(settings%scale, points(:last)%orbit, step)) then
            reason = "closed"
         else
            value = .false.
         end if
      end associate
   end function has_ended

   !> Keep the first points.
   subroutine cut(points, count)
      !> The points
      type(special_point_type), allocatable, intent(inout) :: points(:)
      !> Their number
      integer, intent(in) :: count
      type(special_point_type), allocatable :: whole(:)
      integer :: i

      call move_alloc(points, whole)
      allocate (points(count))
      do i = 1, count
         points(i) = whole(i)
      end do
   end subroutine cut
end module orbit_curves
