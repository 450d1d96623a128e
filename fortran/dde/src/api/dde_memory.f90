!> Whether memory can be had, asked before it is allocated: a failed allocation would end the
!> program.
module dde_memory
   use dde_kinds, only: int64, wp
   use, intrinsic :: iso_fortran_env, only: int8
   implicit none (type, external)
   private
   public :: bytes_of, lacks

   !> Bytes of a real number.
   integer, parameter :: bytes_of_real = storage_size(1.0_wp)/8

contains

   !> Bytes of some real numbers; their count may be larger than the largest integer.
   pure real(wp) function bytes_of(reals) result(bytes)
      !> Number of real numbers
      real(wp), intent(in) :: reals

      bytes = bytes_of_real*reals
   end function bytes_of

   !> Whether memory cannot be allocated now. Where the system promises more memory than it
   !> has, it may still end the program when the memory is filled.
   logical function lacks(bytes) result(value)
      !> Bytes needed
      real(wp), intent(in) :: bytes
      ! volatile, or the compiler leaves out memory that nobody reads
      integer(int8), allocatable, volatile :: memory(:)
      integer :: status

      value = bytes > real(huge(1_int64), wp)
      if (value) return
      allocate (memory(int(bytes, int64)), stat=status)
      value = status /= 0
   end function lacks
end module dde_memory
