!> The norm in which errors are measured: root mean square over scales.
module dde_norm
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: hopeless, scaled_norm

   !> Elements above this are so far off that their squares need not be taken.
   real(wp), parameter :: hopeless = 1.0e100_wp

contains

   !> Root mean square of x/scale; huge where an element is hopeless, not a number where one is not
   !> finite.
   pure function scaled_norm(n, x, scale) result(norm)
      !> How many
      integer, intent(in) :: n
      !> Elements
      real(wp), intent(in) :: x(n)
      !> Their scales, > 0
      real(wp), intent(in) :: scale(n)
      real(wp) :: norm
      integer :: i

      norm = 0.0_wp
      do i = 1, n
         if (.not. ieee_is_finite(x(i))) then
            norm = ieee_value(1.0_wp, ieee_quiet_nan)
            return
         end if
         if (abs(x(i))/hopeless > scale(i)) then
            norm = huge(1.0_wp)
         else if (norm < huge(1.0_wp)) then
            norm = norm + (x(i)/scale(i))**2
         end if
      end do
      if (norm < huge(1.0_wp)) norm = sqrt(norm/n)
   end function scaled_norm
end module dde_norm
