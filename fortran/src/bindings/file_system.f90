!> Writing, renaming and removing files, by the C library: gfortran's own formatted output does not
!> report a full disk, and no Fortran reports why a file cannot be written.
module file_system
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int, c_null_char, c_ptr, c_size_t
   implicit none (type, external)
   private
   public :: is_same_file, is_special, missing, occupied, place_of_file, reason_of, remove_file, &
             remove_marked, rename_file, room_in_file, write_file

   !> Answers beside 0 (done) and the numbers of errors: there is no such path; there is something
   !> that is no regular file.
   integer, parameter :: missing = -1, occupied = -2

   interface
      integer(c_int) function c_place(folder, path) result(value) bind(c, name="file_place")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: folder(*), path(*)
      end function c_place

      integer(c_int) function c_is_same(one, other) result(value) bind(c, name="file_is_same")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: one(*), other(*)
      end function c_is_same

      integer(c_int) function c_is_special(path) result(value) bind(c, name="file_is_special")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_is_special

      integer(c_int) function c_room(path, length) result(value) bind(c, name="file_room")
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         integer(c_size_t), value :: length
      end function c_room

      integer(c_int) function c_write(path, content, length, there) result(value) &
         bind(c, name="file_write")
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), content(*)
         integer(c_size_t), value :: length
         integer(c_int), value :: there
      end function c_write

      integer(c_int) function c_rename(folder, from, to) result(value) bind(c, name="file_rename")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: folder(*), from(*), to(*)
      end function c_rename

      integer(c_int) function c_remove(path) result(value) bind(c, name="remove")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove

      subroutine c_remove_marked(folder, name, ending) bind(c, name="file_remove_marked")
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: folder(*), name(*), ending(*)
      end subroutine c_remove_marked

      type(c_ptr) function c_strerror(number) result(words) bind(c, name="strerror")
         import :: c_int, c_ptr
         implicit none (type, external)
         integer(c_int), value :: number
      end function c_strerror

      integer(c_size_t) function c_strlen(words) result(length) bind(c, name="strlen")
         import :: c_ptr, c_size_t
         implicit none (type, external)
         type(c_ptr), value :: words
      end function c_strlen
   end interface

contains

   !> Whether a file can be made or replaced: 0, `missing` (its folder), `occupied` or an error.
   integer function place_of_file(path) result(answer)
      !> Path of the file
      character(len=*), intent(in) :: path

      answer = c_place(folder_of(path)//c_null_char, path//c_null_char)
   end function place_of_file

   !> Whether two paths lead to one file.
   logical function is_same_file(one, other) result(value)
      !> One path
      character(len=*), intent(in) :: one
      !> The other
      character(len=*), intent(in) :: other

      value = c_is_same(one//c_null_char, other//c_null_char) == 1
   end function is_same_file

   !> Whether something is at a path that is no regular file: a folder, a device or a pipe.
   logical function is_special(path) result(value)
      !> The path
      character(len=*), intent(in) :: path

      value = c_is_special(path//c_null_char) == 1
   end function is_special

   !> Whether a file that is there could be longer: 0, `missing` or an error.
   integer function room_in_file(path, bytes) result(answer)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> How much longer
      integer, intent(in) :: bytes

      answer = c_room(path//c_null_char, int(bytes, c_size_t))
   end function room_in_file

   !> Write a file that is there, and is not longer than this, or a new one where nothing is: 0,
   !> `missing` (the file, or its folder) or an error.
   integer function write_file(path, content, there) result(answer)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> All of it
      character(len=*), intent(in) :: content
      !> Whether the file is there
      logical, intent(in) :: there

      answer = c_write(path//c_null_char, content, len(content, kind=c_size_t), &
                       merge(1_c_int, 0_c_int, there))
   end function write_file

   !> Give a file another name in its folder, replacing what had it, all or nothing, also when the
   !> power fails: 0, `missing` or an error.
   integer function rename_file(from, to) result(answer)
      !> Present path
      character(len=*), intent(in) :: from
      !> New path in the same folder
      character(len=*), intent(in) :: to

      answer = c_rename(folder_of(to)//c_null_char, from//c_null_char, to//c_null_char)
   end function rename_file

   !> Remove a file if it is there.
   subroutine remove_file(path)
      !> Path of the file
      character(len=*), intent(in) :: path
      integer(c_int) :: status

      status = c_remove(path//c_null_char)
   end subroutine remove_file

   !> Remove the files whose path is `path`, a point, digits and hyphens, and `ending`.
   subroutine remove_marked(path, ending)
      !> How their paths begin
      character(len=*), intent(in) :: path
      !> How they end
      character(len=*), intent(in) :: ending

      call c_remove_marked(folder_of(path)//c_null_char, &
                           path(index(path, "/", back=.true.) + 1:)//c_null_char, &
                           ending//c_null_char)
   end subroutine remove_marked

   !> The folder of a path, with a slash at its end.
   pure function folder_of(path) result(folder)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: folder

      folder = path(:index(path, "/", back=.true.))
      if (folder == "") folder = "./"
   end function folder_of

   !> What the system says of the number of an error.
   function reason_of(answer) result(words)
      !> The number
      integer, intent(in) :: answer
      character(len=:), allocatable :: words
      character(kind=c_char), pointer :: letters(:)
      type(c_ptr) :: said
      integer :: i

      said = c_strerror(int(answer, c_int))
      call c_f_pointer(said, letters, [c_strlen(said)])
      allocate (character(len=size(letters)) :: words)
      do i = 1, size(letters)
         words(i:i) = letters(i)
      end do
   end function reason_of
end module file_system
