!> Breaking points: where a kink (or jump) comes back through the delays, one derivative smoother at
!> each passage (Bellen and Zennaro 2003, "Numerical Methods for Delay Differential Equations",
!> sec. 2.2).
module dde_breaking_points
   use dde_time, only: elapsed, instant, later
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: breaking_points, kink_type

   !> Points closer than this share of their distance from the first kink are one.
   real(wp), parameter :: same_point = 16.0_wp*epsilon(1.0_wp)

   !> An instant where a derivative of the solution jumps.
   type :: kink_type
      !> When
      type(instant) :: at
      !> Passages through a delay since the first derivative jumped; -1 where the solution does
      integer :: passages = 0
   end type kink_type

contains

   !> Where `kinks` come back after `now` and before `finish`, ascending.
   pure function breaking_points(kinks, now, finish, lag, most_passages) result(points)
      !> Kinks so far, ascending
      type(kink_type), intent(in) :: kinks(:)
      !> The integration stands here
      type(instant), intent(in) :: now
      !> Last instant of the integration
      type(instant), intent(in) :: finish
      !> Delays, > 0
      real(wp), intent(in) :: lag(:)
      !> Passages after which a kink is smoother than the method can see
      integer, intent(in) :: most_passages
      type(kink_type), allocatable :: points(:)
      type(kink_type), allocatable :: generation(:)
      integer :: i, k

      allocate (points(0))
      if (size(kinks) == 0) return
      associate (origin => kinks(1)%at)
         generation = kinks
         do
            generation = pack(generation, generation%passages < most_passages)
            generation = [((passed(generation(i), lag(k)), k=1, size(lag)), i=1, size(generation))]
            generation = pack(generation, elapsed(generation%at, finish) > 0.0_wp)
            if (size(generation) == 0) exit
            generation = distinct(generation, origin)
            points = [points, generation]
         end do
         points = distinct(points, origin)
         points = pack(points, elapsed(now, points%at) > same_point*elapsed(origin, points%at))
      end associate
   end function breaking_points

   !> What becomes of a kink one delay later.
   elemental function passed(kink, lag) result(later_kink)
      !> The kink
      type(kink_type), intent(in) :: kink
      !> The delay
      real(wp), intent(in) :: lag
      type(kink_type) :: later_kink

      later_kink = kink_type(later(kink%at, lag), kink%passages + 1)
   end function passed

   !> The same points in ascending order, each once, as rough as the roughest that meet there.
   pure function distinct(points, origin) result(unique)
      !> Points in any order
      type(kink_type), intent(in) :: points(:)
      !> What their rounding is measured from
      type(instant), intent(in) :: origin
      type(kink_type), allocatable :: unique(:)
      type(kink_type) :: moving
      integer :: count, i, j

      unique = points
      do i = 2, size(unique)
         moving = unique(i)
         j = i - 1
         do while (j >= 1)
            if (elapsed(unique(j)%at, moving%at) >= 0.0_wp) exit
            unique(j + 1) = unique(j)
            j = j - 1
         end do
         unique(j + 1) = moving
      end do
      count = min(1, size(unique))
      do i = 2, size(unique)
         associate (last => unique(count), next => unique(i))
            if (elapsed(last%at, next%at) <= same_point*elapsed(origin, next%at)) then
               last%passages = min(last%passages, next%passages)
               cycle
            end if
         end associate
         count = count + 1
         unique(count) = unique(i)
      end do
      unique = unique(:count)
   end function distinct
end module dde_breaking_points
