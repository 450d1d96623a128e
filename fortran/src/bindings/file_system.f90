!> Writing, renaming and removing files, by the C library (file_accessors.c): gfortran's own
!> formatted output does not report a full disk, and no Fortran says why a file cannot be written.
!> Paths end with `nul`. An answer is 0 (done), `missing` (the file or its folder), `occupied`, or
!> the number of an error.
module file_system
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_size_t
   implicit none (type, external)
   private
   public :: file_is_same, file_is_special, file_place, file_remove, file_remove_marked, &
             file_rename, file_room, file_write, missing, nul, occupied, reason_of

   !> There is no such path; there is something that is no regular file.
   integer, parameter :: missing = -1, occupied = -2
   !> End of a path.
   character(kind=c_char), parameter :: nul = c_null_char

   interface
      !> Whether a file can be made or replaced.
      integer(c_int) function file_place(path) result(answer) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function file_place

      !> 1 where two paths lead to one file.
      integer(c_int) function file_is_same(one, other) result(value) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: one(*), other(*)
      end function file_is_same

      !> 1 where a folder, a device or a pipe is.
      integer(c_int) function file_is_special(path) result(value) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function file_is_special

      !> Whether a file that is there could be longer by some bytes.
      integer(c_int) function file_room(path, bytes) result(answer) bind(c)
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         integer(c_size_t), value :: bytes
      end function file_room

      !> Write a file that is there (1), and is not longer than this, or a new one where nothing is.
      integer(c_int) function file_write(path, content, length, there) result(answer) bind(c)
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), content(*)
         integer(c_size_t), value :: length
         integer(c_int), value :: there
      end function file_write

      !> Give a file another name in its folder, replacing what had it, all or nothing, also when
      !> the power fails.
      integer(c_int) function file_rename(from, to) result(answer) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function file_rename

      !> Remove a file if it is there.
      integer(c_int) function file_remove(path) result(status) bind(c, name="remove")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function file_remove

      !> Remove the files whose path is `path`, a point, digits and hyphens, and `ending`.
      subroutine file_remove_marked(path, ending) bind(c)
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), ending(*)
      end subroutine file_remove_marked

      subroutine file_reason(answer, words, length) bind(c)
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         integer(c_int), value :: answer
         character(kind=c_char), intent(out) :: words(*)
         integer(c_size_t), value :: length
      end subroutine file_reason
   end interface

contains

   !> What the system says of the number of an error.
   function reason_of(answer) result(words)
      !> The number
      integer, intent(in) :: answer
      character(len=:), allocatable :: words
      character(len=256) :: said

      call file_reason(answer, said, len(said, kind=c_size_t))
      words = said(:index(said, nul) - 1)
   end function reason_of
end module file_system
