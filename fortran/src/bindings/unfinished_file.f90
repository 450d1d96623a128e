! SPDX-License-Identifier: BSD-3-Clause
!> Files that appear only when they are complete, by the C library (unfinished_file.c): gfortran's
!> own output does not report a full disk, and no Fortran says why a file cannot be written.
!>
!> A file is written under another name, one for each run, and renamed when it is on the disk. A run
!> that begins removes unfinished files of earlier ones, so that nothing remains of a killed run.
!> Several runs may write the same file at once, for instance when a workflow was killed and its
!> programs go on. The last one to begin writes the file; the others find nothing to rename.
module unfinished_file
   use, intrinsic :: iso_c_binding, only: c_char, c_null_char, c_size_t
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64
   implicit none (type, external)
   private
   public :: check_place, unfinished_type

   !> What to do where a file cannot be written; the end of a message.
   character(len=*), parameter :: remedy = &
      "; check that its folder exists, is writable and has free space, then run again"
   !> End of a text in C.
   character(kind=c_char), parameter :: nul = c_null_char
   !> Letters of a reason in C.
   integer, parameter :: letters = 256

   !> A file that is not complete.
   type :: unfinished_type
      !> Path of the complete file
      character(len=:), allocatable :: path
      !> Path until then
      character(len=:), allocatable :: part
   contains
      procedure :: begin, fail, publish, discard
   end type unfinished_type

   interface
      subroutine file_check(path, why) bind(c)
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: why(*)
      end subroutine file_check

      subroutine file_begin(path, part, why) bind(c)
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), part(*)
         character(kind=c_char), intent(out) :: why(*)
      end subroutine file_begin

      subroutine file_room(part, why) bind(c)
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: part(*)
         character(kind=c_char), intent(out) :: why(*)
      end subroutine file_room

      subroutine file_publish(part, path, content, length, why) bind(c)
         import :: c_char, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: part(*), path(*), content(*)
         integer(c_size_t), value :: length
         character(kind=c_char), intent(out) :: why(*)
      end subroutine file_publish

      subroutine file_remove(path) bind(c, name="remove")
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end subroutine file_remove
   end interface

contains

   !> Refuse a path at which no file can be written.
   subroutine check_place(path, error)
      !> Path of the complete file
      character(len=*), intent(in) :: path
      !> Why it cannot
      type(error_type), allocatable, intent(out) :: error
      character(len=letters) :: why

      call file_check(path//nul, why)
      call explain(path, why, error)
   end subroutine check_place

   !> The error of a reason that is not empty; what to do, where the reason does not say it.
   subroutine explain(path, why, error)
      character(len=*), intent(in) :: path, why
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason

      reason = why(:index(why, nul) - 1)
      if (reason == "") return
      if (index(reason, ";") == 0) reason = reason//remedy
      call raise(error, path//": cannot write: "//reason)
   end subroutine explain

   !> Create the unfinished file, in place of those of earlier runs.
   subroutine begin(self, path, error)
      class(unfinished_type), intent(inout) :: self
      !> Path of the complete file
      character(len=*), intent(in) :: path
      !> Why it cannot be written
      type(error_type), allocatable, intent(out) :: error
      character(len=letters) :: why
      integer(int64) :: now

      call system_clock(now)
      self%path = path
      self%part = path//"."//text(now)//".part"
      call file_begin(path//nul, self%part//nul, why)
      call explain(path, why, error)
   end subroutine begin

   !> The error of a library that could not write to the file: what the system says when the file is
   !> to become longer; otherwise the words of the library, which keeps the system's to itself.
   subroutine fail(self, words, error)
      class(unfinished_type), intent(in) :: self
      !> What the library says
      character(len=*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error
      character(len=letters) :: why

      call file_room(self%part//nul, why)
      call explain(self%path, why, error)
      if (.not. allocated(error)) call explain(self%path, words//nul, error)
   end subroutine fail

   !> Complete the file and give it its name; on an error nothing is left behind.
   subroutine publish(self, content, error)
      class(unfinished_type), intent(in) :: self
      !> What is still to be written
      character(len=*), intent(in) :: content
      !> Why it cannot be written, for instance because another run has begun to
      type(error_type), allocatable, intent(out) :: error
      character(len=letters) :: why

      call file_publish(self%part//nul, self%path//nul, content, len(content, kind=c_size_t), why)
      call explain(self%path, why, error)
      call self%discard()
   end subroutine publish

   !> Leave nothing behind.
   subroutine discard(self)
      class(unfinished_type), intent(in) :: self

      call file_remove(self%part//nul)
   end subroutine discard
end module unfinished_file
