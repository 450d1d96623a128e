! SPDX-License-Identifier: BSD-3-Clause
!> Curves of special points of cycles over two parameters.
module cycle_curves
   use branch_ends, only: follow_settings_type
   use cycle_branches, only: cycle_settings_type, cycles_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_family, only: family_type
   use model_modes, only: mode_of
   use model_problem, only: model_type
   use orbit_curves, only: curve_type, follow_curve
   use orbit_mesh, only: adapted_mesh
   use progress_receiver, only: progress_receiver_type
   use special_points, only: branching, special_point_type
   implicit none (type, external)
   private
   public :: cycle_curve_type, find_curves

   !> A curve in both directions from the point at which it starts.
   type :: cycle_curve_type
      !> In both directions from the point
      type(curve_type) :: parts(2)
   end type cycle_curve_type

   !> A point is on a curve if it is so near in the parameter along the line, in units of the
   !> window, and in the period, as a share.
   real(wp), parameter :: near = 1.0e-2_wp
   !> Trivial multipliers are accurate to this: curves are drawn, not tabulated.
   real(wp), parameter :: accuracy = 1.0e-5_wp
   !> A curve ends at a Hopf curve where no component has a larger range.
   real(wp), parameter :: least_amplitude = 0.02_wp
   !> A curve starts with a third of the intervals of its point, but not with less than the first of
   !> these; most intervals and points
   integer, parameter :: first_intervals = 50, most_intervals = 120, most_points = 200

contains

   !> Follow the curves of all special points on the branches of a line, each once.
   subroutine find_curves(settings, found, curves, error, progress)
      type(cycle_settings_type), intent(in) :: settings
      type(cycles_type), intent(in) :: found(:)
      type(cycle_curve_type), allocatable, intent(out) :: curves(:)
      !> A point has no curve
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of the number of branches done
      class(progress_receiver_type), intent(inout), optional :: progress
      type(follow_settings_type) :: how
      type(cycle_curve_type), allocatable :: all(:)
      type(model_type) :: block
      type(special_point_type) :: start
      integer :: count, i, intervals, j, k

      allocate (all(sum([(size(found(i)%points), i=1, size(found))])))
      count = 0
      if (allocated(settings%curve_window)) then
         associate (window => settings%curve_window)
            block = mode_of(settings%line%model, 1)
            how%family = family_type(block, settings%curve_along, window(2, :) - window(1, :))
         end associate
         how%window = settings%curve_window
         how%longest_period = settings%longest_period
         how%most_points = most_points
         how%least_amplitude = least_amplitude
         how%refinement%accuracy = accuracy
         how%refinement%most_intervals = most_intervals
         do i = 1, size(found)
            if (present(progress)) call progress%advance(i - 1, size(found))
            do j = 1, size(found(i)%points)
               associate (point => found(i)%points(j))
                  if (point%kind == branching) cycle
                  if (any([(passes(settings, all(k), point), k=1, count)])) cycle
                  count = count + 1
                  start = point
                  intervals = point%orbit%intervals()
                  intervals = min(intervals, max(first_intervals, intervals/3))
                  start%orbit = point%orbit%on_mesh(adapted_mesh(point%orbit, intervals))
                  do k = 1, 2
                     call follow_curve(how, start, 2*k - 3, all(count)%parts(k), error)
                     if (allocated(error)) return
                  end do
               end associate
            end do
         end do
      end if
      allocate (curves, source=all(:count))
   end subroutine find_curves

   !> Whether a curve passes a point on the line.
   pure logical function passes(settings, curve, point) result(value)
      type(cycle_settings_type), intent(in) :: settings
      type(cycle_curve_type), intent(in) :: curve
      type(special_point_type), intent(in) :: point
      real(wp) :: share
      integer :: across, i, k

      value = .false.
      if (curve%parts(1)%points(1)%kind /= point%kind) return
      associate (along => settings%line%along, window => settings%line%window)
         across = sum(settings%curve_along) - along
         do k = 1, 2
            do i = 1, size(curve%parts(k)%points) - 1
               associate (a => curve%parts(k)%points(i)%orbit, &
                          b => curve%parts(k)%points(i + 1)%orbit, &
                          here => point%orbit%parameters)
                  if ((a%parameters(across) - here(across)) &
                      *(b%parameters(across) - here(across)) > 0.0_wp) cycle
                  share = (here(across) - a%parameters(across)) &
                          /(b%parameters(across) - a%parameters(across))
                  value = value .or. &
                          (abs((1.0_wp - share)*a%parameters(along) + share*b%parameters(along) &
                               - here(along)) < near*(window(2) - window(1)) .and. &
                           abs((1.0_wp - share)*a%period + share*b%period - point%orbit%period) &
                           < near*point%orbit%period)
               end associate
            end do
         end do
      end associate
   end function passes
end module cycle_curves
