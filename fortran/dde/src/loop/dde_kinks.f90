!> Kinks, and ascending lists of them.
module dde_kinks
   use dde_time, only: ascending, elapsed, instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: coincide, each_once, kink_type, same_point, sorted

   !> Points are one if their distance is below this share of their distance from the first kink.
   real(wp), parameter :: same_point = 16.0_wp*epsilon(1.0_wp)

   !> A time where a derivative of the solution jumps.
   type :: kink_type
      !> When
      type(instant) :: at
      !> Passages through a delay since the first derivative jumped; -1 where the solution does
      integer :: passages = 0
      !> Passages since its cause, which is the initial time or a time that the user gave
      integer :: generation = 0
   contains
      procedure :: take_in
   end type kink_type

contains

   !> Take in another kink at the same time.
   pure subroutine take_in(self, other)
      class(kink_type), intent(inout) :: self
      type(kink_type), intent(in) :: other

      self%passages = min(self%passages, other%passages)
      self%generation = min(self%generation, other%generation)
   end subroutine take_in

   !> Whether a kink and the next one are the same point.
   pure logical function coincide(kink, next, origin) result(value)
      !> A kink, and one that is not before it
      type(kink_type), intent(in) :: kink, next
      !> What their rounding is measured from
      type(instant), intent(in) :: origin

      value = elapsed(kink%at, next%at) <= same_point*abs(elapsed(origin, next%at))
   end function coincide

   !> An ascending list in which points that coincide become one, with the fewest passages.
   pure function each_once(ordered, origin) result(points)
      !> Ascending points
      type(kink_type), intent(in) :: ordered(:)
      !> What their rounding is measured from
      type(instant), intent(in) :: origin
      type(kink_type), allocatable :: points(:)
      integer :: count, i

      points = ordered
      count = 0
      do i = 1, size(ordered)
         if (count > 0) then
            if (coincide(points(count), ordered(i), origin)) then
               call points(count)%take_in(ordered(i))
               cycle
            end if
         end if
         count = count + 1
         points(count) = ordered(i)
      end do
      points = points(:count)
   end function each_once

   !> Points in any order as an ascending list, each once.
   pure function sorted(points, origin) result(list)
      !> Points in any order
      type(kink_type), intent(in) :: points(:)
      !> What their rounding is measured from
      type(instant), intent(in) :: origin
      type(kink_type), allocatable :: list(:)

      list = each_once(points(ascending(elapsed(origin, points%at))), origin)
   end function sorted
end module dde_kinks
