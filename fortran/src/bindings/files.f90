!> Writing, renaming and removing files, by the C library: gfortran's own formatted output does not
!> tell of a full disk.
module files
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_long_long, c_null_char, &
                                          c_ptr, c_size_t
   use errors, only: error_type, raise
   use kinds, only: int64
   implicit none (type, external)
   private
   public :: number_of_file, remove_file, rename_file, write_file

   interface
      integer(c_int) function c_rename(from, to) result(value) bind(c, name="rename")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function c_rename

      type(c_ptr) function c_open(path, mode) result(stream) bind(c, name="fopen")
         import :: c_char, c_ptr
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), mode(*)
      end function c_open

      integer(c_size_t) function c_write(content, size, count, stream) result(written) &
         bind(c, name="fwrite")
         import :: c_char, c_ptr, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: content(*)
         integer(c_size_t), value :: size, count
         type(c_ptr), value :: stream
      end function c_write

      integer(c_int) function c_close(stream) result(value) bind(c, name="fclose")
         import :: c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: stream
      end function c_close

      integer(c_int) function c_remove(path) result(value) bind(c, name="remove")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove

      integer(c_long_long) function c_number(path) result(value) bind(c, name="number_of_file")
         import :: c_char, c_long_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_number
   end interface

contains

   !> Write a file of text, replacing what was there.
   subroutine write_file(path, content, error)
      !> Its path
      character(len=*), intent(in) :: path
      !> All of it
      character(len=*), intent(in) :: content
      !> It could not be opened or not be written to the end
      type(error_type), allocatable, intent(out) :: error
      type(c_ptr) :: stream
      integer(c_size_t) :: length, written
      integer(c_int) :: closed

      length = len(content, kind=c_size_t)
      written = 0
      closed = 0
      stream = c_open(path//c_null_char, "wb"//c_null_char)
      if (c_associated(stream)) then
         written = c_write(content, 1_c_size_t, length, stream)
         closed = c_close(stream)
      end if
      if (.not. c_associated(stream) .or. written < length .or. closed /= 0) then
         call raise(error, path//": cannot write")
      end if
   end subroutine write_file

   !> Give a file another name, replacing what had it: all or nothing.
   subroutine rename_file(from, to, error)
      !> Present path
      character(len=*), intent(in) :: from
      !> New path on the same file system
      character(len=*), intent(in) :: to
      !> It could not be done
      type(error_type), allocatable, intent(out) :: error

      if (c_rename(from//c_null_char, to//c_null_char) /= 0) then
         call raise(error, "cannot rename '"//from//"' to '"//to//"'")
      end if
   end subroutine rename_file

   !> Remove a file if it is there.
   subroutine remove_file(path)
      !> Its path
      character(len=*), intent(in) :: path
      integer(c_int) :: status

      status = c_remove(path//c_null_char)
   end subroutine remove_file

   !> The number that tells a file from all others of its file system; 0 where there is none.
   integer(int64) function number_of_file(path) result(value)
      !> Its path
      character(len=*), intent(in) :: path

      value = c_number(path//c_null_char)
   end function number_of_file
end module files
