! SPDX-License-Identifier: BSD-3-Clause
!> Reading of namelist files. Every program reads one group, &settings, into variables of derived
!> types: the keys are their components, as scene%t_end. A component without a value keeps its
!> default, `missing` where it must be given. So each key stands once, in its type.
module namelist_input
   use, intrinsic :: iso_fortran_env, only: output_unit
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use process, only: end_at_once
   use value_checks, only: absent, missing_count
   implicit none (type, external)
   private
   public :: elements, element_length, help, namelist_file_type, word_length

   !> Length of a word in a namelist: far above any that is allowed, so that one too long is met and
   !> refused instead of cut.
   integer, parameter :: word_length = 256
   !> Length of a word in a list.
   integer, parameter :: element_length = 32
   !> Length and usual number of lines that hold a namelist with all its keys.
   integer, parameter :: line_length = 1024, usual_lines = 2000
   !> In place of a path: the keys of the group are written, and the program ends.
   character(len=*), parameter :: help = "--help"
   !> The group.
   character(len=*), parameter :: group = "settings"

   !> A namelist file that is read. Between `open` and `close` the group is read from `unit`, and
   !> then written to `copy`, by which `close` finds what was not given.
   type :: namelist_file_type
      !> Path of the file
      character(len=:), allocatable :: path
      !> Unit it is open on
      integer :: unit = -1
      !> I/O status and message of the read
      integer :: status = 0
      character(len=256) :: reason = ""
      !> Why it is not open, if it is not
      type(error_type), allocatable, private :: failure
      !> All keys with the values read
      character(len=line_length), allocatable :: copy(:)
   contains
      procedure :: open => open_file, close => close_file
   end type namelist_file_type

contains

   !> Open a namelist file for reading the group.
   subroutine open_file(self, path, lines)
      class(namelist_file_type), intent(out) :: self
      character(len=*), intent(in) :: path
      !> Number of lines of its copy, if it may have more than usual
      integer, intent(in), optional :: lines

      self%path = path
      if (present(lines)) then
         allocate (self%copy(lines))
      else
         allocate (self%copy(usual_lines))
      end if
      if (path == help) then
         open (newunit=self%unit, status="scratch", action="readwrite", iostat=self%status, &
               iomsg=self%reason)
         if (self%status == 0) write (self%unit, "(3a)") "&", group, " /"
         if (self%status == 0) rewind (self%unit)
      else
         open (newunit=self%unit, file=path, status="old", action="read", iostat=self%status, &
               iomsg=self%reason)
      end if
      if (self%status /= 0) call raise(self%failure, path//": "//trim(self%reason))
   end subroutine open_file

   !> Close the file after reading the group.
   subroutine close_file(self, error)
      class(namelist_file_type), intent(in) :: self
      !> The file or the group could not be read, or a number is missing or not finite
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      integer :: status

      if (allocated(self%failure)) then
         allocate (error, source=self%failure)
         return
      end if
      close (self%unit, iostat=status, iomsg=reason)
      if (self%status < 0) then
         call raise(error, self%path//": namelist group &"//group//": not in the file, a value " &
                    //"of another type, too many values, or no / at the end")
      else if (self%status > 0) then
         call raise(error, self%path//": namelist group &"//group//": "//trim(self%reason))
      else if (status /= 0) then
         call raise(error, self%path//": cannot be closed: "//trim(reason))
      else if (self%path == help) then
         call show_keys(self%copy)
      else
         call check_numbers(self%path, self%copy, error)
      end if
   end subroutine close_file

   !> Refuse numbers that are not finite and numbers that were not given.
   subroutine check_numbers(path, lines, error)
      character(len=*), intent(in) :: path
      !> All keys and their values, as Fortran writes a namelist with strings in quotes
      character(len=*), intent(in) :: lines(:)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: key
      integer :: at, i

      do i = 2, findloc(lines, " /", dim=1) - 1
         at = index(lines(i), "=")
         if (at > 0) key = in_small_letters(trim(adjustl(lines(i) (:at - 1))))
         associate (values => lines(i) (at + 1:))
            if (index(values, """") > 0) cycle
            if (index(values, "NaN") > 0) then
               call raise(error, path//": "//key//" = NaN; expected a finite number " &
                          //"(NaN: missing, or not a number)")
            else if (index(values, "Inf") > 0) then
               call raise(error, path//": "//key//" = "//trim(adjustl(values)) &
                          //" expected a finite number")
            else if (index(values, text(missing_count)) > 0) then
               call raise(error, path//": "//key//" is missing; expected a whole number")
            end if
         end associate
         if (allocated(error)) return
      end do
   end subroutine check_numbers

   !> Write all keys with their values, and end the program.
   subroutine show_keys(lines)
      !> All keys and their values, as Fortran writes a namelist
      character(len=*), intent(in) :: lines(:)
      character(len=:), allocatable :: value
      integer :: at, i

      do i = 2, findloc(lines, " /", dim=1) - 1
         at = index(lines(i), "=")
         value = lines(i) (at + 1:)
         if (index(value, "NaN") > 0 .or. index(value, text(missing_count)) > 0) then
            value = "must be given"
         end if
         write (output_unit, "(3a)") in_small_letters(lines(i) (:at)), " ", trim(value)
      end do
      flush (output_unit)
      call end_at_once(0)
   end subroutine show_keys

   !> Text in small letters.
   pure function in_small_letters(words) result(small)
      character(len=*), intent(in) :: words
      character(len=len(words)) :: small
      integer :: i

      small = words
      do i = 1, len(words)
         if (lge(words(i:i), "A") .and. lle(words(i:i), "Z")) then
            small(i:i) = achar(iachar(words(i:i)) + iachar("a") - iachar("A"))
         end if
      end do
   end function in_small_letters

   !> The elements of a list that were given.
   pure function elements(list) result(given)
      !> The list, `absent` beyond its last element
      real(wp), intent(in) :: list(:)
      real(wp), allocatable :: given(:)

      given = pack(list, list < absent)
   end function elements
end module namelist_input
