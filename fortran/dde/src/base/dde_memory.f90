! SPDX-License-Identifier: BSD-3-Clause
!> Whether memory can be had, asked before it is allocated: a failed allocation would end the
!> program.
module dde_memory
   use dde_kinds, only: int64, wp
   use, intrinsic :: iso_fortran_env, only: int8
   implicit none (type, external)
   private
   public :: bytes_of_real, find_lacking, small

   !> Bytes of a real number.
   integer, parameter :: bytes_of_real = storage_size(1.0_wp)/8
   !> Up to so many real numbers are not asked for: that would take too long.
   real(wp), parameter :: small = 8192.0_wp
   !> Where Linux tells how many kilobytes a program can fill: it lets programs allocate more.
   character(len=*), parameter :: meminfo = "/proc/meminfo", name_there = "MemAvailable:"

contains

   !> Bytes of some real numbers if there is not as much memory now, else 0. A system that promises
   !> more than it has, and does not tell what it has, may still end the program when the memory is
   !> filled.
   real(wp) function find_lacking(reals) result(lacking)
      !> Number of real numbers, which may be larger than the largest integer
      real(wp), intent(in) :: reals
      ! volatile, or the compiler leaves out memory that nobody reads
      integer(int8), allocatable, volatile :: memory(:)
      real(wp) :: bytes
      integer :: status

      lacking = 0.0_wp
      if (reals <= small) return
      bytes = bytes_of_real*reals
      status = 0
      if (bytes <= available()) allocate (memory(int(bytes, int64)), stat=status)
      if (status /= 0 .or. .not. allocated(memory)) lacking = bytes
   end function find_lacking

   !> Bytes that a program can fill now; where the system does not tell, the largest integer.
   real(wp) function available() result(bytes)
      character(len=16) :: name
      integer(int64) :: kilobytes
      integer :: status, unit

      bytes = real(huge(1_int64), wp)
      open (newunit=unit, file=meminfo, action="read", status="old", iostat=status)
      if (status /= 0) return
      do
         read (unit, *, iostat=status) name, kilobytes
         if (status /= 0) exit
         if (name == name_there) then
            bytes = 1024.0_wp*kilobytes
            exit
         end if
      end do
      close (unit)
   end function available
end module dde_memory
