!> Numbers that double precision holds. A program compiled in quadruple precision rounds its inputs
!> to them, so that it solves the very problem that the program in double precision solves.
module double_numbers
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: as_double, evenly_spaced

   !> Double precision, also where `wp` is another.
   integer, parameter :: double = selected_real_kind(15, 307)

contains

   !> The nearest number of double precision; a number of double precision stays what it is.
   elemental function as_double(number) result(rounded)
      !> A number within the range of double precision
      real(wp), intent(in) :: number
      real(wp) :: rounded

      rounded = real(real(number, double), wp)
   end function as_double

   !> Times 0, interval, 2 interval, ... up to `last`.
   pure function evenly_spaced(interval, last) result(time)
      !> Distance, > 0
      real(wp), intent(in) :: interval
      !> Last time, >= interval
      real(wp), intent(in) :: last
      real(wp), allocatable :: time(:)
      integer :: i

      ! the quotient may be one rounding below a whole number
      time = [(as_double(i*interval), i=0, floor(last/interval*(1.0_wp + 1.0e-12_wp)))]
      time(size(time)) = min(time(size(time)), last)
   end function evenly_spaced
end module double_numbers
