!> Renaming and removing files, by the C library.
module files
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   use errors, only: error_type, raise
   implicit none (type, external)
   private
   public :: remove_file, rename_file

   interface
      integer(c_int) function c_rename(from, to) result(value) bind(c, name="rename")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function c_rename

      integer(c_int) function c_remove(path) result(value) bind(c, name="remove")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove
   end interface

contains

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
end module files
