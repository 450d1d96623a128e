! SPDX-License-Identifier: BSD-3-Clause
!> Time as an unevaluated sum of two numbers. A step far below spacing(t) still changes it
!> (error-free sums of Knuth and Dekker).
module dde_time
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: ascending, instant, elapsed, later, too_short

   !> Steps up to this share of the time no longer move a time.
   real(wp), parameter :: least_step = 1.0e-140_wp

   !> A point in time, hi + lo with |lo| at most half a unit in the last place of hi.
   type :: instant
      !> Leading part: the time as an ordinary number
      real(wp) :: hi = 0.0_wp
      !> What rounding took from it
      real(wp) :: lo = 0.0_wp
   end type instant

contains

   !> Numbers of times in ascending order; equal times keep their order. Halves are merged.
   pure recursive function ascending(times) result(order)
      !> Times from one start
      real(wp), intent(in) :: times(:)
      integer :: order(size(times))
      integer, allocatable :: numbers(:)
      integer :: half, i, j, k
      logical :: first

      order = 1
      half = size(times)/2
      if (half == 0) return
      numbers = [ascending(times(:half)), half + ascending(times(half + 1:))]
      i = 1
      do k = 1, size(times)
         j = half + 1 + k - i
         first = times(numbers(min(i, half))) <= times(numbers(min(j, size(times))))
         first = (first .or. j > size(times)) .and. i <= half
         order(k) = numbers(merge(i, j, first))
         if (first) i = i + 1
      end do
   end function ascending

   !> Length up to which a step is too short, between the start and the end of a run. The end may
   !> be far beyond the time that the run reaches.
   pure real(wp) function too_short(start, now, finish) result(length)
      !> The start of the run, the present, and the end of the run
      real(wp), intent(in) :: start, now, finish

      length = least_step*max(abs(start), abs(now), min(abs(finish), 1.0_wp))
   end function too_short

   !> The time `step` after `point` (before it where step is negative).
   elemental function later(point, step) result(moved)
      !> Where to start
      type(instant), intent(in) :: point
      !> Signed distance
      real(wp), intent(in) :: step
      type(instant) :: moved
      real(wp) :: total, part, rest

      total = point%hi + step
      part = total - point%hi
      rest = (point%hi - (total - part)) + (step - part) + point%lo
      moved%hi = total + rest
      moved%lo = rest - (moved%hi - total)
   end function later

   !> Signed time from one time to another.
   elemental function elapsed(from, to) result(span)
      !> Start
      type(instant), intent(in) :: from
      !> End
      type(instant), intent(in) :: to
      real(wp) :: span
      real(wp) :: difference, part, rest

      difference = to%hi - from%hi
      part = difference - to%hi
      rest = (to%hi - (difference - part)) - (from%hi + part)
      span = difference + (rest + (to%lo - from%lo))
   end function elapsed
end module dde_time
