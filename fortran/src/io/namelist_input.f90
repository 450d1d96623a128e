!> What all namelists share: opening the file, closing it, and what a missing key holds.
module namelist_input
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use namelist_text, only: check_given_once
   implicit none (type, external)
   private
   public :: close_namelist, not_given, open_namelist, word_length

   !> Length of a word in a namelist: far above any that is allowed, so that one too long is met and
   !> refused instead of cut.
   integer, parameter :: word_length = 256

contains

   !> What a real key holds before it is read: no number, so that a missing key is refused.
   real(wp) function not_given() result(value)
      value = ieee_value(1.0_wp, ieee_quiet_nan)
   end function not_given

   !> Open a namelist file for reading a group.
   subroutine open_namelist(path, group, unit, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Namelist group, in small letters
      character(len=*), intent(in) :: group
      !> Unit it is open on
      integer, intent(out) :: unit
      !> Error if the file cannot be opened, or the group or a key of it is given twice
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      integer :: status

      call check_given_once(path, group, error)
      if (allocated(error)) return
      open (newunit=unit, file=path, status="old", action="read", iostat=status, iomsg=reason)
      if (status /= 0) call raise(error, path//": "//trim(reason))
   end subroutine open_namelist

   !> Close the file after reading a group; say what went wrong, if anything did.
   subroutine close_namelist(path, group, unit, status, reason, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Namelist group
      character(len=*), intent(in) :: group
      !> Unit it is open on
      integer, intent(in) :: unit
      !> I/O status of the read
      integer, intent(in) :: status
      !> Message of the read
      character(len=*), intent(in) :: reason
      !> Error if the group could not be read
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: close_reason
      integer :: close_status

      close (unit, iostat=close_status, iomsg=close_reason)
      if (status < 0) then
         call raise(error, path//": no complete namelist group &"//group//" in it")
      else if (status > 0) then
         call raise(error, path//": namelist group &"//group//": "//trim(reason))
      else if (close_status /= 0) then
         call raise(error, path//": cannot be closed: "//trim(close_reason))
      end if
   end subroutine close_namelist
end module namelist_input
