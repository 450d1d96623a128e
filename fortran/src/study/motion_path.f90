! SPDX-License-Identifier: BSD-3-Clause
!> A piece of a motion to be drawn: the signal over time, and over the last coordinate of the
!> section, as a line through few points.
module motion_path
   use dde, only: continuation_type, event_table, integrate, integration_options, &
                  integration_result, sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_levels, only: section_level
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: find_kept_points, follow_path

   !> Longest time between two samples, in units of time, and longest integral of a signal that is
   !> an exponential. If
   !> its mean is one, there are about as many samples by time as by its integral, and events of any
   !> height are resolved.
   real(wp), parameter :: longest_time = 0.05_wp, longest_slip = 0.05_wp

   !> Samples of a coordinate and of the component of the signal.
   type, extends(sampler_type) :: path_sampler_type
      !> Time, coordinate and component of the signal, shape (3, >= received)
      real(wp), allocatable :: rows(:, :)
      !> Number of samples received
      integer :: received = 0
      !> Time of the last one
      real(wp) :: last = 0.0_wp
      !> Longest time between two
      real(wp) :: step = longest_time
      !> Whether the signal is the exponential of its component
      logical :: is_exponential = .false.
   contains
      procedure :: take
   end type path_sampler_type

contains

   !> Follow a motion for a time, from its next passage of the section, if there is one in that
   !> time. There is no path if the run ends before its time: that of the class of the motion was
   !> another.
   subroutine follow_path(model, from, time, closeness, options, path)
      class(model_type), intent(in) :: model
      !> Where the motion is
      type(continuation_type), intent(in) :: from
      real(wp), intent(in) :: time
      !> How close the line is to the motion, as a share of its extent in the signal and the
      !> coordinate. In time it is half of that: plots over time are wide.
      real(wp), intent(in) :: closeness
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Time from the beginning of the piece, coordinate and component of the signal, shape (3,
      !> points)
      real(wp), allocatable, intent(out) :: path(:, :)
      type(continuation_type) :: here
      type(error_type), allocatable :: error
      type(event_table) :: passage
      type(integration_result) :: outcome
      type(path_sampler_type) :: samples
      real(wp) :: start

      here = from
      associate (observed => model%sizes%observed)
         passage = event_table([observed%component], level=[section_level(model)], direction=[1], &
                               terminal=[.true.])
         samples%wanted = [maxval(observed%coordinates), observed%component]
         if (samples%wanted(1) == 0) samples%wanted(1) = observed%component
         samples%is_exponential = observed%is_exponential
      end associate
      call integrate(model, here%time(1), here%time(1) + time, options, outcome, error, &
                     watcher=passage, continuation=here)
      if (allocated(error)) return
      start = here%time(1)
      samples%next = start
      samples%last = start + time
      samples%step = longest_time*options%unit_of_time
      allocate (samples%rows(3, ceiling(time/samples%step)))
      call integrate(model, start, samples%last, options, outcome, error, &
                     sampler=samples, continuation=here)
      if (allocated(error)) return
      path = samples%rows(:, :samples%received)
      path(1, :) = path(1, :) - start
      path = thinned(path, closeness)
   end subroutine follow_path

   !> Keep a sample. The next one follows after the longest time or the longest integral.
   subroutine take(self, y)
      class(path_sampler_type), intent(inout) :: self
      !> Coordinate and component of the signal
      real(wp), intent(in) :: y(:)
      real(wp) :: step

      if (self%received == size(self%rows, 2)) then
         self%rows = reshape(self%rows, [3, 2*self%received], pad=[0.0_wp])
      end if
      self%received = self%received + 1
      self%rows(:, self%received) = [self%next, y]
      if (self%next >= self%last) then
         self%next = huge(1.0_wp)
         return
      end if
      step = self%step
      if (self%is_exponential) step = min(step, longest_slip*exp(-y(2)))
      ! time goes on however large the signal is
      self%next = self%next + max(step, spacing(self%next))
      self%next = min(self%next, self%last)
   end subroutine take

   !> The points of a path that matter in a picture of it.
   pure function thinned(path, closeness) result(line)
      !> Time, coordinate and component of the signal
      real(wp), intent(in) :: path(:, :)
      real(wp), intent(in) :: closeness
      real(wp), allocatable :: line(:, :)
      real(wp) :: scaled(size(path, 1), size(path, 2))
      integer :: i, points(size(path, 2))

      do i = 1, size(path, 1)
         scaled(i, :) = path(i, :)/max(maxval(path(i, :)) - minval(path(i, :)), tiny(1.0_wp))
      end do
      scaled(1, :) = 2.0_wp*scaled(1, :)
      points = [(i, i=1, size(path, 2))]
      line = path(:, pack(points, find_kept_points(scaled, closeness)))
   end function thinned

   !> Points of a line that suffice to draw it: the first, the last, and those between them without
   !> which the line would be further than the tolerance from a point (Douglas and Peucker 1973,
   !> Cartographica 10, 112).
   pure function find_kept_points(points, tolerance) result(kept)
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
   end function find_kept_points

   !> Distance of a point from a straight line between two others.
   pure real(wp) function distance_from(point, first, last) result(distance)
      real(wp), intent(in) :: point(:)
      real(wp), intent(in) :: first(:)
      real(wp), intent(in) :: last(:)
      real(wp) :: length, share

      associate (line => last - first)
         length = dot_product(line, line)
         share = 0.0_wp
         if (length > 0.0_wp) share = dot_product(point - first, line)/length
         distance = norm2(point - first - max(0.0_wp, min(1.0_wp, share))*line)
      end associate
   end function distance_from
end module motion_path
