!> Kinks, and ascending lists of them.
module dde_kinks
   use dde_time, only: elapsed, instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: coincide, kink_type, merged, same_point, sorted

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

   !> Two ascending lists as one. Points that coincide become one, with the fewest passages.
   pure function merged(one, other, origin) result(points)
      !> Ascending points
      type(kink_type), intent(in) :: one(:)
      !> More of them
      type(kink_type), intent(in) :: other(:)
      !> What their rounding is measured from
      type(instant), intent(in) :: origin
      type(kink_type), allocatable :: points(:)
      type(kink_type) :: point
      integer :: count, i, j
      logical :: first

      allocate (points(size(one) + size(other)))
      count = 0
      i = 1
      j = 1
      do while (i <= size(one) .or. j <= size(other))
         first = j > size(other)
         if (.not. first .and. i <= size(one)) first = elapsed(one(i)%at, other(j)%at) > 0.0_wp
         if (first) then
            point = one(i)
            i = i + 1
         else
            point = other(j)
            j = j + 1
         end if
         if (count > 0) then
            if (coincide(points(count), point, origin)) then
               call points(count)%take_in(point)
               cycle
            end if
         end if
         count = count + 1
         points(count) = point
      end do
      if (count < size(points)) points = points(:count)
   end function merged

   !> Points in ascending order, each once.
   pure recursive function sorted(points, origin) result(ascending)
      !> Points in any order
      type(kink_type), intent(in) :: points(:)
      !> What their rounding is measured from
      type(instant), intent(in) :: origin
      type(kink_type), allocatable :: ascending(:)

      if (size(points) < 2) then
         ascending = points
      else
         associate (half => size(points)/2)
            ascending = merged(sorted(points(:half), origin), sorted(points(half + 1:), origin), &
                               origin)
         end associate
      end if
   end function sorted
end module dde_kinks
