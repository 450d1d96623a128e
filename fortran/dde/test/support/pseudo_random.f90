! SPDX-License-Identifier: BSD-3-Clause
!> Numbers that look random and are the same in every run (Park and Miller 1988).
module pseudo_random
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: uniform

   !> Modulus and factor of the generator.
   integer(int64), parameter :: modulus = 2147483647_int64, factor = 16807_int64

contains

   !> Evenly spread numbers between `least` and `most`; each seed has a sequence of its own.
   pure function uniform(seed, count, least, most) result(numbers)
      !> 1..2147483646
      integer, intent(in) :: seed
      integer, intent(in) :: count
      real(wp), intent(in) :: least, most
      real(wp) :: numbers(count)
      integer(int64) :: state
      integer :: i

      state = seed
      do i = 1, 3
         state = modulo(factor*state, modulus)
      end do
      do i = 1, count
         state = modulo(factor*state, modulus)
         numbers(i) = least + (most - least)*real(state, wp)/real(modulus, wp)
      end do
   end function uniform
end module pseudo_random
