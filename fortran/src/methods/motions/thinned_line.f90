!> A line through many points drawn with few of them: Douglas and Peucker (1973), Cartographica 10,
!> 112.
module thinned_line
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: kept_points

contains

   !> Which points to keep: the first, the last, and those between them without which the line would
   !> be further than the tolerance from a point.
   pure function kept_points(points, tolerance) result(kept)
      !> Points in order, shape (dimensions, points)
      real(wp), intent(in) :: points(:, :)
      !> Largest distance of a point from the line
      real(wp), intent(in) :: tolerance
      logical :: kept(size(points, 2))
      real(wp) :: distance(size(points, 2))
      integer :: farthest, first, i, last

      kept = .false.
      if (size(kept) == 0) return
      kept([1, size(kept)]) = .true.
      first = 1
      do while (first < size(kept))
         last = first + findloc(kept(first + 1:), .true., dim=1)
         do i = first + 1, last - 1
            distance(i) = distance_from(points(:, i), points(:, first), points(:, last))
         end do
         farthest = first + maxloc(distance(first + 1:last - 1), dim=1)
         if (last - first > 1) kept(farthest) = distance(farthest) > tolerance
         ! a point that was kept parts the line: look again at its first part
         if (.not. any(kept(first + 1:last - 1))) first = last
      end do
   end function kept_points

   !> Distance of a point from a straight line between two others.
   pure real(wp) function distance_from(point, first, last) result(distance)
      !> The point
      real(wp), intent(in) :: point(:)
      !> One end of the line
      real(wp), intent(in) :: first(:)
      !> The other end
      real(wp), intent(in) :: last(:)
      real(wp) :: length, share

      associate (line => last - first)
         length = dot_product(line, line)
         share = 0.0_wp
         if (length > 0.0_wp) share = dot_product(point - first, line)/length
         distance = norm2(point - first - max(0.0_wp, min(1.0_wp, share))*line)
      end associate
   end function distance_from
end module thinned_line
