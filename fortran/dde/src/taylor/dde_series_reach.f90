!> How far a Taylor series serves, by its last terms.
module dde_series_reach
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: series_reach

   !> Share of the length at which the last two terms reach the tolerance: for what follows them.
   real(wp), parameter :: share = 0.9_wp
   !> No farther than this: its powers must not overflow.
   real(wp), parameter :: farthest = 1.0e15_wp

contains

   !> How far, in units of the powers, the last two terms are within the tolerance and terms do not
   !> grow: those left out of a series of very small terms that do would exceed it later.
   pure subroutine series_reach(degree, coefficients, scale, reach)
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients, one series a component
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> Tolerance of each component
      real(wp), contiguous, intent(in) :: scale(:)
      !> How far; 0 where they are not finite
      real(wp), intent(out) :: reach
      real(wp) :: growth, last(0:2)
      integer :: i, k

      reach = 0.0_wp
      do i = 1, size(scale)
         reach = reach + (coefficients(degree - 1, i) + coefficients(degree, i))
      end do
      if (.not. ieee_is_finite(reach)) then
         reach = 0.0_wp
         return
      end if
      last = tiny(1.0_wp)
      do i = 1, size(scale)
         do k = 0, 2
            last(k) = max(last(k), abs(coefficients(degree - 2 + k, i))/scale(i))
         end do
      end do
      reach = exp(-max(log(last(1))/(degree - 1), log(last(2))/degree))
      growth = huge(1.0_wp)
      ! one term may vanish by chance; at the floor nothing is known
      if (last(2) > tiny(1.0_wp)) growth = max(last(1)/last(2), sqrt(last(0)/last(2)))
      reach = share*min(reach, growth, farthest)
   end subroutine series_reach
end module dde_series_reach
