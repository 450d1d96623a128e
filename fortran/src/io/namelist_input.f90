!> What all namelists share: opening the file and refusing values out of range in words.
module namelist_input
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_quiet_nan, ieee_value
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: check_choice, check_count, check_number, close_namelist, not_given, open_namelist
   public :: word_length

   !> Length of a word in a namelist: far above any that is allowed, so that one too long is met and
   !> refused instead of cut.
   integer, parameter :: word_length = 256

contains

   !> What a real key holds before it is read: no number, so that a missing key is refused.
   real(wp) function not_given() result(value)
      value = ieee_value(1.0_wp, ieee_quiet_nan)
   end function not_given

   !> Open a namelist file for reading.
   subroutine open_namelist(path, unit, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Unit it is open on
      integer, intent(out) :: unit
      !> It cannot be opened
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      integer :: status

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
      !> Its message
      character(len=*), intent(in) :: reason
      !> It could not be read
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

   !> Refuse a number that is not finite or out of range; keep an earlier error.
   pure subroutine check_number(error, place, key, value, above, at_least, below, at_most)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes
      character(len=*), intent(in) :: place
      !> Key
      character(len=*), intent(in) :: key
      !> Its value
      real(wp), intent(in) :: value
      !> Exclusive lower bound
      real(wp), intent(in), optional :: above
      !> Inclusive lower bound
      real(wp), intent(in), optional :: at_least
      !> Exclusive upper bound
      real(wp), intent(in), optional :: below
      !> Inclusive upper bound
      real(wp), intent(in), optional :: at_most
      character(len=:), allocatable :: range
      logical :: fine

      if (allocated(error)) return
      fine = ieee_is_finite(value)
      range = "a finite number"
      if (present(above)) then
         range = range//" > "//text(above)
         if (fine) fine = value > above
      end if
      if (present(at_least)) then
         range = range//" >= "//text(at_least)
         if (fine) fine = value >= at_least
      end if
      if (present(below)) then
         range = range//" < "//text(below)
         if (fine) fine = value < below
      end if
      if (present(at_most)) then
         range = range//" <= "//text(at_most)
         if (fine) fine = value <= at_most
      end if
      if (fine) return
      if (ieee_is_nan(value)) range = range//" (NaN: missing, or not a number)"
      call raise(error, place//": "//key//" = "//text(value)//"; expected "//range)
   end subroutine check_number

   !> Refuse a count out of range; keep an earlier error.
   pure subroutine check_count(error, place, key, value, at_least, at_most)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes
      character(len=*), intent(in) :: place
      !> Key
      character(len=*), intent(in) :: key
      !> Its value
      integer, intent(in) :: value
      !> Least value allowed
      integer, intent(in) :: at_least
      !> Largest value allowed
      integer, intent(in), optional :: at_most

      if (allocated(error)) return
      if (value < at_least) then
         call raise(error, place//": "//key//" = "//text(value)//"; expected a whole number >= " &
                    //text(at_least))
      else if (present(at_most)) then
         if (value > at_most) call raise(error, place//": "//key//" = "//text(value) &
                                         //"; expected a whole number <= "//text(at_most))
      end if
   end subroutine check_count

   !> Refuse a word that is not among the choices; keep an earlier error.
   pure subroutine check_choice(error, place, key, value, choices)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes
      character(len=*), intent(in) :: place
      !> Key
      character(len=*), intent(in) :: key
      !> Its value
      character(len=*), intent(in) :: value
      !> Words allowed
      character(len=*), intent(in) :: choices(:)
      character(len=:), allocatable :: list
      integer :: i

      if (allocated(error) .or. any(choices == value)) return
      list = ""
      do i = 1, size(choices)
         list = list//" '"//trim(choices(i))//"'"
      end do
      call raise(error, place//": "//key//" = '"//trim(value)//"'; expected one of"//list)
   end subroutine check_choice
end module namelist_input
