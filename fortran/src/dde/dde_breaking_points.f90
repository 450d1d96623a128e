!> Breaking points: where a kink (or jump) at the first instant comes back through the delays, one
!> derivative smoother at each passage (Bellen and Zennaro 2003, "Numerical Methods for Delay
!> Differential Equations", sec. 2.2).
module dde_breaking_points
   use dde_time, only: elapsed, instant, later
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: breaking_points

   !> Points closer than this share of their distance from the origin are one.
   real(wp), parameter :: same_point = 16.0_wp*epsilon(1.0_wp)

contains

   !> The instants origin + sum of up to `passages` delays that lie before `finish`, ascending.
   pure function breaking_points(origin, finish, lag, passages) result(points)
      !> First instant of the integration
      type(instant), intent(in) :: origin
      !> Last instant of the integration
      type(instant), intent(in) :: finish
      !> Delays, > 0
      real(wp), intent(in) :: lag(:)
      !> Passages after which the kink is smoother than the method can see
      integer, intent(in) :: passages
      type(instant), allocatable :: points(:)
      type(instant), allocatable :: generation(:)
      integer :: i, k, passage

      allocate (points(0))
      generation = [origin]
      do passage = 1, passages
         generation = [((later(generation(i), lag(k)), k=1, size(lag)), i=1, size(generation))]
         generation = pack(generation, elapsed(generation, finish) > 0.0_wp)
         generation = distinct(generation, origin)
         if (size(generation) == 0) exit
         points = [points, generation]
      end do
      points = distinct(points, origin)
   end function breaking_points

   !> The same points in ascending order, each once.
   pure function distinct(points, origin) result(unique)
      !> Points in any order
      type(instant), intent(in) :: points(:)
      !> What their rounding is measured from
      type(instant), intent(in) :: origin
      type(instant), allocatable :: unique(:)
      type(instant) :: moving
      integer :: count, i, j

      unique = points
      do i = 2, size(unique)
         moving = unique(i)
         j = i - 1
         do while (j >= 1)
            if (elapsed(unique(j), moving) >= 0.0_wp) exit
            unique(j + 1) = unique(j)
            j = j - 1
         end do
         unique(j + 1) = moving
      end do
      count = min(1, size(unique))
      do i = 2, size(unique)
         if (elapsed(unique(count), unique(i)) <= same_point*elapsed(origin, unique(i))) cycle
         count = count + 1
         unique(count) = unique(i)
      end do
      unique = unique(:count)
   end function distinct
end module dde_breaking_points
