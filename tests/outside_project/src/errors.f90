!> A module of the user's own with a name that other projects have, too.
module errors
   use kinds, only: wp
   implicit none
   private
   public :: percent

contains

   !> A share in percent.
   pure real(wp) function percent(share)
      real(wp), intent(in) :: share

      percent = 100*share
   end function percent
end module errors
