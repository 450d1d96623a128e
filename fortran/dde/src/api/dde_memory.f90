!> Whether memory can be had, asked before it is allocated: a failed allocation would end the
!> program.
module dde_memory
   use dde_kinds, only: int64, wp
   use, intrinsic :: iso_fortran_env, only: int8
   implicit none (type, external)
   private
   public :: bytes_of, lacks, small

   !> Bytes of a real number.
   integer, parameter :: bytes_of_real = storage_size(1.0_wp)/8
   !> Amounts up to this one are not asked for: that would take too long.
   real(wp), parameter :: small = 65536.0_wp
   !> Where Linux tells how many kilobytes a program can fill: it lets programs allocate more.
   character(len=*), parameter :: meminfo = "/proc/meminfo", name_there = "MemAvailable:"

contains

   !> Bytes of some real numbers; their count may be larger than the largest integer.
   pure real(wp) function bytes_of(reals) result(bytes)
      !> Number of real numbers
      real(wp), intent(in) :: reals

      bytes = bytes_of_real*reals
   end function bytes_of

   !> Whether there is not as much memory now. A system that promises more than it has, and does
   !> not tell what it has, may still end the program when the memory is filled.
   logical function lacks(bytes) result(value)
      !> Bytes needed
      real(wp), intent(in) :: bytes
      ! volatile, or the compiler leaves out memory that nobody reads
      integer(int8), allocatable, volatile :: memory(:)
      integer :: status

      value = .false.
      if (bytes <= small) return
      value = bytes > available()
      if (value) return
      allocate (memory(int(bytes, int64)), stat=status)
      value = status /= 0
   end function lacks

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
