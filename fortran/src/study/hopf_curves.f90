! SPDX-License-Identifier: BSD-3-Clause
!> Hopf curves in a plane of two parameters. The number of unstable roots is counted on a grid.
!> Wherever it changes between neighbours and no known curve passes, a point of a curve is looked
!> for, and the curve is followed from there in both directions: so all curves are found but those
!> that close between the points of the grid.
module hopf_curves
   use characteristic_function, only: characteristic_type
   use dde, only: stop_requested
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use hopf_planes, only: axis_point_type, chord_of, curve_plane_type, side, turn
   implicit none (type, external)
   private
   public :: curve_point_type, trace_curves

   !> Farthest a chord may lie from the curve, and longest chord, in units of the window.
   real(wp), parameter :: chord_deviation = 1.0e-4_wp, chord_length = 0.02_wp
   !> First and least step along a curve in (place, ln omega), and its growth after an easy one.
   real(wp), parameter :: first_step = 1.0e-3_wp, least_step = 1.0e-9_wp, growth = 1.5_wp
   !> A point is on a known curve if it is so near to it, in units of the window and of omega.
   real(wp), parameter :: near = 1.0e-3_wp
   !> Most points of a curve in one direction.
   integer, parameter :: most_points = 20000
   !> A curve ends at a double root 0, where the term of second order in omega is less than this
   !> share of the largest term of Delta.
   real(wp), parameter :: least_share = 1.0e-9_wp

   !> An unbroken piece of a curve, from one end to the other, that with the lower frequency first.
   type :: piece_type
      !> Its points
      type(axis_point_type), allocatable :: points(:)
   end type piece_type

   !> One point of a Hopf curve.
   type :: curve_point_type
      !> All parameters
      real(wp), allocatable :: numbers(:)
      !> The pair, with its place in the plane
      type(axis_point_type) :: at
      !> Turns that the pair makes in the longest delay
      integer :: branch = 0
      !> Number of the piece, from 1
      integer :: piece = 0
      !> |Delta(i omega)| over its largest term
      real(wp) :: residual = 0.0_wp
      !> +1 where a growing ordinate makes the pair unstable, -1 where it makes it stable
      integer :: crossing = 0
      !> First Lyapunov coefficient, once judged: negative, supercritical
      real(wp) :: l1 = 0.0_wp
      !> Unstable roots beside the pair, once judged
      integer :: unstable_roots = 0
   end type curve_point_type

contains

   !> All pieces of curves in the window, by branch and frequency, as points.
   subroutine trace_curves(plane, x, y, roots, points, error)
      !> The plane and its window
      type(curve_plane_type), intent(in) :: plane
      !> Columns and lines of a grid in units of the window, edges included
      real(wp), intent(in) :: x(:), y(:)
      !> Number of unstable roots there
      integer, intent(in) :: roots(:, :)
      type(curve_point_type), allocatable, intent(out) :: points(:)
      !> A point was not found
      type(error_type), allocatable, intent(out) :: error
      type(piece_type), allocatable :: pieces(:)
      integer :: axis, beside(2), i, j

      allocate (pieces(0))
      do j = 1, size(y)
         do i = 1, size(x)
            do axis = 1, 2
               beside = [i, j]
               beside(axis) = beside(axis) + 1
               if (any(beside > shape(roots))) cycle
               call explain(plane, [x(i), y(j)], [x(beside(1)), y(beside(2))], roots(i, j), &
                            roots(beside(1), beside(2)), pieces, error)
               if (allocated(error)) return
            end do
         end do
      end do
      points = points_of(plane, pieces)
   end subroutine trace_curves

   !> Follow the curves between two neighbours of the grid, unless known curves that pass explain
   !> how their numbers of unstable roots differ. A real root that passes 0 is on no curve. Beside a
   !> place without a number there are none.
   subroutine explain(plane, from, to, roots_from, roots_to, pieces, error)
      type(curve_plane_type), intent(in) :: plane
      real(wp), intent(in) :: from(2), to(2)
      integer, intent(in) :: roots_from, roots_to
      type(piece_type), allocatable, intent(inout) :: pieces(:)
      type(error_type), allocatable, intent(out) :: error
      type(axis_point_type) :: start
      type(hopf_on_line_type), allocatable :: found(:)
      type(piece_type), allocatable :: longer(:)
      integer :: i, passing, pairs

      pairs = abs(roots_to - roots_from)/2
      if (pairs == 0 .or. min(roots_from, roots_to) < 0) return
      passing = sum([(crossings(pieces(i), from, to), i=1, size(pieces))])
      if (passing >= pairs) return
      call find_hopf_on_line(plane%model, plane%numbers_at(from), plane%numbers_at(to), 1, found, &
                             error)
      if (allocated(error)) return
      do i = 1, size(found)
         start = axis_point_type(plane%place_of(found(i)%numbers), found(i)%omega)
         ! at a double pair curves meet, and none has a direction
         if (found(i)%is_double) cycle
         if (is_known(pieces, start)) cycle
         allocate (longer(size(pieces) + 1))
         longer(:size(pieces)) = pieces
         call follow_both_ways(plane, start, longer(size(longer))%points)
         call move_alloc(longer, pieces)
      end do
   end subroutine explain

   !> How often a piece crosses the line between two places.
   pure integer function crossings(piece, from, to) result(number)
      type(piece_type), intent(in) :: piece
      real(wp), intent(in) :: from(2), to(2)
      integer :: i

      number = 0
      associate (p => piece%points)
         do i = 1, size(p) - 1
            if (min(p(i)%place(1), p(i + 1)%place(1)) > to(1)) cycle
            if (max(p(i)%place(1), p(i + 1)%place(1)) < from(1)) cycle
            if (min(p(i)%place(2), p(i + 1)%place(2)) > to(2)) cycle
            if (max(p(i)%place(2), p(i + 1)%place(2)) < from(2)) cycle
            if (side(from, to, p(i)%place)*side(from, to, p(i + 1)%place) <= 0.0_wp .and. &
                side(p(i)%place, p(i + 1)%place, from)*side(p(i)%place, p(i + 1)%place, to) &
                <= 0.0_wp) number = number + 1
         end do
      end associate
   end function crossings

   !> Whether a point is on a known piece.
   pure logical function is_known(pieces, point) result(value)
      type(piece_type), intent(in) :: pieces(:)
      type(axis_point_type), intent(in) :: point
      real(wp) :: share
      integer :: i, j

      value = .false.
      do i = 1, size(pieces)
         associate (p => pieces(i)%points)
            do j = 1, size(p) - 1
               if (norm2(p(j)%place - point%place) > near + chord_length) cycle
               associate (chord => p(j + 1)%place - p(j)%place)
                  share = dot_product(point%place - p(j)%place, chord) &
                          /max(dot_product(chord, chord), tiny(1.0_wp))
                  share = min(1.0_wp, max(0.0_wp, share))
                  value = norm2(p(j)%place + share*chord - point%place) <= near .and. &
                          abs(log(p(j)%omega/point%omega) &
                              + share*log(p(j + 1)%omega/p(j)%omega)) <= near &
                          + 0.5_wp*abs(log(p(j + 1)%omega/p(j)%omega))
               end associate
               if (value) return
            end do
         end associate
      end do
   end function is_known

   !> The piece through a point.
   subroutine follow_both_ways(plane, start, points)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: start
      type(axis_point_type), allocatable, intent(out) :: points(:)
      type(axis_point_type), allocatable :: back(:), onward(:)
      logical :: closed

      call follow(plane, start, 1.0_wp, onward, closed)
      allocate (back(0))
      if (.not. closed) call follow(plane, start, -1.0_wp, back, closed)
      points = [back(size(back):1:-1), start, onward]
      if (points(1)%omega > points(size(points))%omega) points = points(size(points):1:-1)
   end subroutine follow_both_ways

   !> Points of a curve from a point on until it leaves the window or comes back.
   subroutine follow(plane, start, sense, points, closed)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: start
      !> 1 or -1
      real(wp), intent(in) :: sense
      !> The points behind the start
      type(axis_point_type), allocatable, intent(out) :: points(:)
      !> Whether the curve comes back to its start
      logical, intent(out) :: closed
      type(axis_point_type) :: here, next
      real(wp) :: length, tangent(3), turned(3)
      integer :: number
      logical :: found

      allocate (points(0))
      closed = .false.
      here = start
      ! any direction gives the tangent; the sign is that of a growing abscissa
      call plane%correct(here, [1.0_wp, 0.0_wp, 0.0_wp], start%place(1), found, tangent)
      if (.not. found) then
         here = start
         call plane%correct(here, [0.0_wp, 1.0_wp, 0.0_wp], start%place(2), found, tangent)
      end if
      if (.not. found) return
      tangent = sense*tangent
      here = start
      length = first_step
      do number = 1, most_points
         do
            next = here%moved(tangent, length)
            call plane%correct(next, tangent, here%along(tangent) + length, found, turned)
            if (found) found = is_smooth(here, next, tangent, turned)
            if (found) exit
            length = 0.5_wp*length
            if (length < least_step .or. stop_requested /= 0) return
         end do
         if (any(next%place < 0.0_wp) .or. any(next%place > 1.0_wp)) then
            call add_end(plane, here, next, points)
            return
         end if
         if (is_at_double_zero(plane, next)) return
         if (number > 2 .and. passes(here, next, start)) then
            points = [points, start]
            closed = .true.
            return
         end if
         points = [points, next]
         here = next
         tangent = turned
         length = growth*length
      end do
   end subroutine follow

   !> Whether the frequency is so small that Delta(i omega) is nearly its rounding.
   logical function is_at_double_zero(plane, point) result(value)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: point
      type(characteristic_type) :: c
      complex(wp) :: s

      c = plane%function_at(point%place)
      s = cmplx(0.0_wp, point%omega, kind=wp)
      value = c%curvature_bound(s)*point%omega**2 < least_share*c%largest_term(s)
   end function is_at_double_zero

   !> Whether the chord between two points is short and looks like the curve in the plane.
   pure logical function is_smooth(here, next, tangent, turned) result(value)
      type(axis_point_type), intent(in) :: here, next
      !> Tangents at both
      real(wp), intent(in) :: tangent(3), turned(3)
      real(wp) :: chord(2), length

      chord = next%place - here%place
      length = norm2(chord)
      value = length <= chord_length .and. dot_product(tangent, turned) > 0.9_wp
      if (.not. value .or. length <= 0.0_wp) return
      ! an arc with these tangents is this far from its chord
      value = max(bend(tangent(:2), chord), bend(turned(:2), chord)) <= 4.0_wp*chord_deviation

   contains

      !> Length of a chord times the sine of its angle to a tangent.
      pure real(wp) function bend(along, chord) result(length)
         real(wp), intent(in) :: along(2), chord(2)

         length = abs(along(1)*chord(2) - along(2)*chord(1))/max(norm2(along), tiny(1.0_wp))
      end function bend
   end function is_smooth

   !> Whether a curve comes back to its start between two points.
   pure logical function passes(here, next, start) result(value)
      type(axis_point_type), intent(in) :: here, next, start
      real(wp) :: chord(3), share, way(3)

      chord = chord_of(here, next)
      way = chord_of(here, start)
      share = dot_product(way, chord)/dot_product(chord, chord)
      value = share > 0.0_wp .and. share <= 1.0_wp .and. norm2(way - share*chord) <= near
   end function passes

   !> Add the point at which a curve leaves the window between two points.
   subroutine add_end(plane, here, next, points)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: here, next
      type(axis_point_type), allocatable, intent(inout) :: points(:)
      type(axis_point_type) :: last
      real(wp) :: direction(3), edges(2), share, shares(2)
      integer :: axis
      logical :: found

      edges = merge(0.0_wp, 1.0_wp, next%place < 0.0_wp)
      shares = huge(share)
      where (next%place < 0.0_wp .or. next%place > 1.0_wp)
         shares = (edges - here%place)/(next%place - here%place)
      end where
      axis = minloc(shares, dim=1)
      share = shares(axis)
      last = axis_point_type(here%place + share*(next%place - here%place), &
                             here%omega*(next%omega/here%omega)**share)
      direction = 0.0_wp
      direction(axis) = 1.0_wp
      call plane%correct(last, direction, edges(axis), found)
      if (.not. found) return
      last%place(axis) = edges(axis)
      ! a curve that starts at the edge leaves the window at once
      if (norm2(last%place - here%place) > least_step) points = [points, last]
   end subroutine add_end

   !> All points of all pieces, these by their branch and frequency.
   function points_of(plane, pieces) result(points)
      type(curve_plane_type), intent(in) :: plane
      type(piece_type), intent(in) :: pieces(:)
      type(curve_point_type), allocatable :: points(:)
      type(curve_point_type) :: first
      real(wp), dimension(size(pieces)) :: key, omega
      integer :: i, j, k, number(size(pieces))

      do i = 1, size(pieces)
         first = point_of(plane, pieces(i)%points(1), 0)
         key(i) = first%branch
         omega(i) = first%at%omega
      end do
      key = key + 0.5_wp*omega/maxval(omega)
      do i = 1, size(pieces)
         number(i) = 1 + count(key < key(i)) + count(abs(key(:i - 1) - key(i)) <= 0.0_wp)
      end do
      allocate (points(0))
      do k = 1, size(pieces)
         i = findloc(number, k, dim=1)
         points = [points, [(point_of(plane, pieces(i)%points(j), k), j=1, size(pieces(i)%points))]]
      end do
   end function points_of

   !> A point with its residual and crossing.
   type(curve_point_type) function point_of(plane, at, piece) result(point)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: at
      integer, intent(in) :: piece
      type(characteristic_type) :: c
      complex(wp) :: s

      point%at = at
      point%piece = piece
      point%numbers = plane%numbers_at(at%place)
      s = cmplx(0.0_wp, at%omega, kind=wp)
      c = plane%function_at(at%place)
      point%branch = nint(at%omega*maxval(c%delay)/turn)
      point%residual = c%relative_residual(s)
      point%crossing = nint(sign(1.0_wp, real(c%root_by(plane%along(2), s))))
   end function point_of
end module hopf_curves
