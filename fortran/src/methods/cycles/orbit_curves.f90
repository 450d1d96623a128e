! SPDX-License-Identifier: BSD-3-Clause
!> Curves of special points of periodic orbits in two parameters. The orbits near a point are a
!> surface over its tangent plane. The curve is where a test function of the point is 0 on it.
module orbit_curves
   use branch_ends, only: follow_settings_type, is_closed, longer_step, shorter
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use orbit_curve_steps, only: first_plane, frame_on, frame_type, is_accurate, take_step, &
                                turn_along
   use orbit_linearisation, only: linearise_orbit
   use orbit_mesh, only: adapted_mesh
   use orbit_passes, only: orbit_passes_type
   use sign_change, only: sign_change_type
   use special_points, only: cusp, fold, special_point_type, torus_bifurcation
   implicit none (type, external)
   private
   public :: curve_type, follow_curve

   !> A curve.
   type :: curve_type
      !> Points of the curve; the first is the one it starts at
      type(special_point_type), allocatable :: points(:)
      !> Why it ends: 'window', 'generalised_hopf' (folds) or 'double_hopf' (others), '1:1' or
      !> '1:2' (resonances), 'closed', 'shorter_period' (at a cycle of a part of the period),
      !> 'period', 'intervals' (more than the most are needed), 'points', 'convergence'
      character(len=:), allocatable :: ending
      !> Points where a curve of folds turns back in both parameters
      type(special_point_type), allocatable :: cusps(:)
   end type curve_type

   !> Evaluations after which the next step is longer
   integer, parameter :: easy = 4
   !> Angle of a pair, in turns, so close to 0 or 1/2 that the curve ends in a resonance
   real(wp), parameter :: resonant = 0.004_wp
   !> Intervals of the second mesh for a cusp over those of the first
   real(wp), parameter :: finer = 1.5_wp
   !> Iterations of the search for a cusp, and the share of the step to which it goes
   integer, parameter :: most_iterations = 40
   real(wp), parameter :: share_at_cusp = 1.0e-6_wp

contains

   !> Follow the curve through a special point in one of its two directions.
   subroutine follow_curve(settings, start, direction, curve, error)
      !> How far and how
      type(follow_settings_type), intent(in) :: settings
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
      type(orbit_passes_type) :: linear
      type(special_point_type) :: next
      real(wp) :: step
      integer :: evaluations, i
      logical :: ended, passed, passes, turns

      allocate (curve%points(settings%most_points), curve%cusps(0))
      curve%points(1) = start
      call linearise_orbit(settings%family, start%orbit, linear, error)
      if (allocated(error)) return
      call first_plane(start%orbit, linear, frame%directions, error)
      if (allocated(error)) return
      call turn_along(settings, start, linear, frame, error)
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
         call take_step(settings, step, next, next_frame, evaluations, passes, failure)
         if (allocated(failure)) then
            step = shorter*step
            passed = passed .or. passes
            if (step >= settings%least_step) cycle
            curve%ending = trim(merge("shorter_period", "convergence   ", passed))
            exit
         end if
         passed = .false.
         curve%points(i + 1) = next
         i = i + 1
         ended = has_ended(settings, curve%points, i, step, curve%ending)
         turns = dot_product(frame%directions(1)%parameters, next_frame%directions(1)%parameters) &
                 < 0.0_wp
         ! at a generalised Hopf point, too, the parameters turn back, with the other phase
         if (start%kind == fold .and. turns .and. curve%ending /= "generalised_hopf") then
            call find_cusp(settings, curve%points(i - 1), frame, step, curve%cusps)
         end if
         if (ended) exit
         frame = next_frame
         if (evaluations <= easy) step = longer_step(step, settings%longest_step, next%orbit)
      end do
      curve%points = curve%points(:i)
   end subroutine follow_curve

   !> Find the cusp on a curve of folds within a step from a point, on two meshes, and append it.
   subroutine find_cusp(settings, before, frame, step, cusps)
      type(follow_settings_type), intent(in) :: settings
      type(special_point_type), intent(in) :: before
      type(frame_type), intent(in) :: frame
      real(wp), intent(in) :: step
      type(special_point_type), allocatable, intent(inout) :: cusps(:)
      type(error_type), allocatable :: error
      type(special_point_type) :: coarse, fine, first

      call locate_cusp(settings, before, frame, step, coarse, error)
      if (allocated(error)) return
      first = before
      first%orbit = before%orbit%on_mesh(adapted_mesh(before%orbit, &
                                                         nint(finer*before%orbit%intervals())))
      call locate_cusp(settings, first, frame_on(frame, before%orbit, first%orbit), step, &
                       fine, error)
      if (allocated(error)) return
      associate (free => settings%family%free)
         fine%mesh_error = maxval(abs(fine%orbit%parameters(free) - coarse%orbit%parameters(free)))
      end associate
      fine%kind = cusp
      cusps = [cusps, fine]
   end subroutine find_cusp

   !> The point within a step at which the direction of a curve of folds has no part along the
   !> parameters.
   subroutine locate_cusp(settings, before, frame, step, point, error)
      type(follow_settings_type), intent(in) :: settings
      type(special_point_type), intent(in) :: before
      type(frame_type), intent(in) :: frame
      real(wp), intent(in) :: step
      type(special_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      type(sign_change_type) :: change
      real(wp) :: at, g, moved
      integer :: i

      change%places = [0.0_wp, step]
      change%values(1) = sum(frame%directions(1)%parameters**2)
      call part_along(step, change%values(2))
      if (allocated(error)) return
      if (change%values(2) > 0.0_wp) then
         call raise(error, "cusp: the curve does not turn back within a step of "//text(step))
         return
      end if
      do i = 1, most_iterations
         at = change%next()
         call part_along(at, g)
         if (allocated(error)) return
         call change%narrow(at, g, moved)
         if (moved <= share_at_cusp*step) return
      end do
      call raise(error, "cusp: not found within "//text(most_iterations)//" iterations")

   contains

      !> The point after a part of the step, and the part of its direction along the parameters.
      subroutine part_along(length, value)
         real(wp), intent(in) :: length
         !> Inner product of the parameters' parts of the directions
         real(wp), intent(out) :: value
         type(frame_type) :: turned
         integer :: evaluations
         logical :: passes

         value = 0.0_wp
         point = before
         turned = frame
         call take_step(settings, length, point, turned, evaluations, passes, error)
         if (allocated(error)) return
         value = dot_product(frame%directions(1)%parameters, turned%directions(1)%parameters)
      end subroutine part_along
   end subroutine locate_cusp

   !> Whether a curve ends at its last point, and why.
   logical function has_ended(settings, points, last, step, reason) result(value)
      type(follow_settings_type), intent(in) :: settings
      type(special_point_type), intent(in) :: points(:)
      integer, intent(in) :: last
      real(wp), intent(in) :: step
      character(len=:), allocatable, intent(inout) :: reason

      value = .true.
      associate (point => points(last))
         if (settings%is_outside(point%orbit)) then
            reason = "window"
         else if (point%orbit%amplitude() < settings%least_amplitude) then
            reason = trim(merge("generalised_hopf", "double_hopf     ", point%kind == fold))
         else if (point%kind == torus_bifurcation .and. abs(point%angle()) < resonant) then
            reason = "1:1"
         else if (point%kind == torus_bifurcation .and. abs(point%angle()) > 0.5_wp - resonant) then
            reason = "1:2"
         else if (point%orbit%period > settings%longest_period) then
            reason = "period"
         else if (.not. is_accurate(point, settings%refinement)) then
            reason = "intervals"
         else if (point%orbit%comes_to_shorter(points(last - 1)%orbit)) then
            reason = "shorter_period"
         else if (is_closed(settings%family, points(:last)%orbit, step)) then
            reason = "closed"
         else
            value = .false.
         end if
      end associate
   end function has_ended
end module orbit_curves
