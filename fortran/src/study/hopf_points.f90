! SPDX-License-Identifier: BSD-3-Clause
!> What happens along Hopf curves: the first Lyapunov coefficient and the roots that are unstable
!> beside the pair on the axis, and the points at which the kind of the bifurcation changes.
module hopf_points
   use characteristic_function, only: characteristic_of, characteristic_type
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: stop_requested
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: axis_point_type, chord_of, curve_plane_type, side, turn
   use hopf_unfoldings, only: unfold_double_hopf, unfold_generalised_hopf, unfolding_type
   use model_problem, only: model_type
   use hopf_normal_form, only: first_lyapunov_coefficient
   use root_counts, only: roots_right_of
   use sign_change, only: sign_change_type
   implicit none (type, external)
   private
   public :: find_hopf_points, hopf_point_type, judge_points, kind_length

   !> Letters of a kind of point.
   integer, parameter :: kind_length = 20
   !> A coefficient this much smaller than that of the next point is 0 but for rounding.
   real(wp), parameter :: rounded = 1.0e-10_wp
   !> The coefficient passes through 0, not through a pole, where it is this much smaller than those
   !> of its neighbours.
   real(wp), parameter :: small_coefficient = 1.0e-7_wp
   !> Frequencies of two pairs differ by more than this share.
   real(wp), parameter :: least_difference = 1.0e-3_wp
   !> Steps of the way to a point at which two pairs are on the axis.
   integer, parameter :: most_steps = 60
   real(wp), parameter :: last_distance = 1.0e-14_wp

   !> A point at which two pairs of roots are imaginary, or the coefficient is 0, or the delay is 0.
   type :: hopf_point_type
      !> 'generalised_hopf', 'double_hopf', 'hopf_without_delay', or 'without_normal_form' where one
      !> more root is on the axis, as by a symmetry
      character(len=kind_length) :: kind = ""
      !> All parameters
      real(wp), allocatable :: numbers(:)
      !> Frequency of the pair, and of the second one (0: none)
      real(wp) :: omega(2) = 0.0_wp
      !> Turns that the pairs make in the longest delay (-1: none)
      integer :: branch(2) = -1
      !> First Lyapunov coefficients of the pairs
      real(wp) :: l1(2) = 0.0_wp
      !> Unstable roots beside these
      integer :: unstable_roots = 0
      !> Normal form of a generalised or double Hopf point
      type(unfolding_type) :: unfolding
   end type hopf_point_type

contains

   !> First Lyapunov coefficients, not a number where 0 or 2 i omega is a root, too, and numbers of
   !> unstable roots of points on curves.
   subroutine judge_points(plane, points)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(inout) :: points(:)
      type(error_type), allocatable :: singular
      type(model_type) :: model
      integer :: i

      do i = 1, size(points)
         if (stop_requested /= 0) return
         model = plane%model_at(points(i)%numbers)
         associate (point => points(i))
            call first_lyapunov_coefficient(model, point%at%omega, point%l1, singular)
            if (allocated(singular)) point%l1 = ieee_value(point%l1, ieee_quiet_nan)
            point%unstable_roots = roots_right_of(characteristic_of(model), 0.0_wp, &
                                                 [point%at%omega])
         end associate
      end do
   end subroutine judge_points

   !> All special points on curves that have been judged.
   subroutine find_hopf_points(plane, points, found, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(in) :: points(:)
      !> Special points
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      type(axis_point_type) :: at, other
      real(wp) :: l1
      integer :: i, j

      allocate (found(0))
      do i = 1, size(points) - 1
         if (points(i)%piece /= points(i + 1)%piece) cycle
         ! a curve begins or ends where its delay becomes 0
         if (has_delay(points(i)) .eqv. has_delay(points(i + 1))) cycle
         at = points(merge(i + 1, i, has_delay(points(i))))%at
         call add_point(found, "hopf_without_delay", plane, at, [at%omega])
      end do
      do i = 1, size(points) - 1
         if (points(i)%piece /= points(i + 1)%piece) cycle
         if (changes_sign(points(i:i + 1)%l1)) then
            call find_zero_of_l1(plane, points(i:i + 1), at, l1, error)
            if (allocated(error)) return
            if (abs(l1) <= small_coefficient*maxval(abs(points(i:i + 1)%l1))) then
               call add_point(found, "generalised_hopf", plane, at, [at%omega], &
                              direction_of(points(i:i + 1)%at))
            end if
         end if
         do j = i + 1, size(points) - 1
            if (points(j)%piece /= points(j + 1)%piece) cycle
            if (.not. cross(points(i:i + 1)%at, points(j:j + 1)%at)) cycle
            call find_meeting(plane, points(i:i + 1)%at, points(j:j + 1)%at, at, other)
            associate (low => min(at%omega, other%omega), high => max(at%omega, other%omega))
               if (high - low <= least_difference*high) cycle
               call add_point(found, "double_hopf", plane, at, [low, high])
            end associate
         end do
      end do

   contains

      !> Whether a point has a delay that is not 0.
      pure logical function has_delay(point) result(value)
         type(curve_point_type), intent(in) :: point

         value = any(plane%model%delays(point%numbers) > 0.0_wp)
      end function has_delay
   end subroutine find_hopf_points

   !> Whether two coefficients differ in sign, and neither is 0 but for rounding.
   pure logical function changes_sign(l1) result(value)
      real(wp), intent(in) :: l1(2)

      value = product(l1) < 0.0_wp .and. minval(abs(l1)) > rounded*maxval(abs(l1))
   end function changes_sign

   !> The point of a curve at a share of the way between two points.
   type(axis_point_type) function point_between(plane, ends, share) result(point)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: ends(2)
      real(wp), intent(in) :: share
      real(wp) :: chord(3)
      logical :: found

      chord = direction_of(ends)
      point%place = (1.0_wp - share)*ends(1)%place + share*ends(2)%place
      point%omega = ends(1)%omega**(1.0_wp - share)*ends(2)%omega**share
      call plane%correct(point, chord, point%along(chord), found)
   end function point_between

   !> The direction from one point to another in (place, ln omega), of length 1.
   pure function direction_of(ends) result(direction)
      type(axis_point_type), intent(in) :: ends(2)
      real(wp) :: direction(3)

      direction = chord_of(ends(1), ends(2))
      direction = direction/norm2(direction)
   end function direction_of

   !> The point between two others of a curve at which the coefficient changes its sign.
   subroutine find_zero_of_l1(plane, ends, at, l1, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(in) :: ends(2)
      type(axis_point_type), intent(out) :: at
      !> The coefficient there: not small at a pole
      real(wp), intent(out) :: l1
      type(error_type), allocatable, intent(out) :: error
      type(sign_change_type) :: change
      real(wp) :: moved, share
      integer :: i

      change = sign_change_type(values=ends%l1)
      do i = 1, most_steps
         share = change%next()
         at = point_between(plane, ends%at, share)
         call first_lyapunov_coefficient(plane%model_at(plane%numbers_at(at%place)), at%omega, l1, &
                                         error)
         if (allocated(error)) return
         call change%narrow(share, l1, moved)
         if (moved <= last_distance .or. abs(l1) <= tiny(l1)) exit
      end do
   end subroutine find_zero_of_l1

   !> Whether two chords cross in the plane.
   pure logical function cross(one, other) result(value)
      type(axis_point_type), intent(in) :: one(2), other(2)

      associate (a => one(1)%place, b => one(2)%place, c => other(1)%place, d => other(2)%place)
         value = side(a, b, c)*side(a, b, d) <= 0.0_wp .and. side(c, d, a)*side(c, d, b) < 0.0_wp
      end associate
   end function cross

   !> Where two curves meet, near where their chords do: the points on both go along the tangents
   !> until they are at the same place.
   subroutine find_meeting(plane, one, other, at, there)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: one(2), other(2)
      !> The meeting on both curves
      type(axis_point_type), intent(out) :: at, there
      real(wp) :: determinant, tangents(3, 2), way(2)
      integer :: i
      logical :: found(2)

      at = one(1)
      there = other(1)
      tangents(:, 1) = direction_of(one)
      tangents(:, 2) = direction_of(other)
      do i = 1, most_steps
         way = there%place - at%place
         if (i > 1 .and. maxval(abs(way)) <= last_distance) exit
         associate (a => tangents(:2, 1), b => tangents(:2, 2))
            determinant = a(1)*b(2) - a(2)*b(1)
            way = [way(1)*b(2) - way(2)*b(1), way(1)*a(2) - way(2)*a(1)]/determinant
         end associate
         call advance(at, tangents(:, 1), way(1), found(1))
         call advance(there, tangents(:, 2), way(2), found(2))
         if (.not. all(found)) exit
      end do

   contains

      !> Go along a curve.
      subroutine advance(point, tangent, length, found)
         type(axis_point_type), intent(inout) :: point
         real(wp), intent(inout) :: tangent(3)
         real(wp), intent(in) :: length
         logical, intent(out) :: found
         real(wp) :: before(3), value

         before = tangent
         value = point%along(before) + length
         point = point%moved(before, length)
         call plane%correct(point, before, value, found, tangent)
      end subroutine advance
   end subroutine find_meeting

   !> Append a point with its coefficients and its normal form.
   subroutine add_point(found, kind, plane, at, omega, direction)
      type(hopf_point_type), allocatable, intent(inout) :: found(:)
      character(len=*), intent(in) :: kind
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: at
      !> Frequencies of the pairs, ascending
      real(wp), intent(in) :: omega(:)
      !> Direction of the curve of a generalised Hopf point
      real(wp), intent(in), optional :: direction(3)
      type(characteristic_type) :: c
      type(error_type), allocatable :: singular
      type(hopf_point_type) :: point
      type(model_type) :: model
      integer :: i

      point%kind = kind
      point%numbers = plane%numbers_at(at%place)
      model = plane%model_at(point%numbers)
      c = characteristic_of(model)
      point%unstable_roots = roots_right_of(c, 0.0_wp, omega)
      point%branch(:size(omega)) = nint(omega*maxval(c%delay)/turn)
      point%omega(:size(omega)) = omega
      do i = 1, size(omega)
         call first_lyapunov_coefficient(model, omega(i), point%l1(i), singular)
         if (allocated(singular)) exit
      end do
      if (.not. allocated(singular)) then
         if (kind == "generalised_hopf") then
            call unfold_generalised_hopf(plane, at, direction, point%unfolding, singular)
         else if (kind == "double_hopf") then
            call unfold_double_hopf(plane, point%numbers, point%omega, point%unfolding, singular)
         end if
      end if
      if (allocated(singular)) then
         point%kind = "without_normal_form"
         point%l1 = ieee_value(0.0_wp, ieee_quiet_nan)
      end if
      found = [found, point]
   end subroutine add_point
end module hopf_points
