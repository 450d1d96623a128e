!> Files that appear only when they are complete: they are written under another name and renamed
!> at the end. Each run has its own other name. When it begins, it removes unfinished files of
!> earlier runs for the same path, so that nothing remains of a killed run. Several runs may write
!> the same file at once, for instance when a workflow was killed and its programs go on. The last
!> one to begin writes the file: an older run finds nothing to rename.
module unfinished_file
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64
   use file_system, only: file_place, file_remove, file_remove_marked, file_rename, file_room, &
                          file_write, missing, nul, occupied, reason_of
   implicit none (type, external)
   private
   public :: check_place, remedy, unfinished_type

   !> What to do where a file cannot be written; the end of a message.
   character(len=*), parameter :: remedy = &
      "; check that its folder exists, is writable and has free space, then run again"
   !> Bytes that a library writes at once, at most: the largest chunk of NetCDF.
   integer(int64), parameter :: longest_write = 2**24
   !> End of the other name.
   character(len=*), parameter :: ending = ".part"

   !> A file that is not complete.
   type :: unfinished_type
      !> Path of the complete file
      character(len=:), allocatable :: path
      !> Path until then
      character(len=:), allocatable :: other_path
      !> Whether the file was written once
      logical, private :: there = .false.
   contains
      procedure :: begin, write => write_all, publish, why_not_written, discard
      procedure, private :: conclude
   end type unfinished_type

contains

   !> Refuse a path at which no file can be written.
   subroutine check_place(path, error)
      !> Path of the complete file
      character(len=*), intent(in) :: path
      !> Why it cannot
      type(error_type), allocatable, intent(out) :: error

      call explain(path, file_place(path//nul), error)
   end subroutine check_place

   !> The error of an answer that is not 0.
   subroutine explain(path, answer, error)
      character(len=*), intent(in) :: path
      integer, intent(in) :: answer
      type(error_type), allocatable, intent(out) :: error

      select case (answer)
      case (0)
         return
      case (missing)
         call raise(error, path//": cannot write: the folder does not exist"//remedy)
      case (occupied)
         call raise(error, path//": cannot write: a folder, a device or a link is there; " &
                    //"expected a file, or nothing")
      case default
         call raise(error, path//": cannot write: "//reason_of(answer)//remedy)
      end select
   end subroutine explain

   !> Choose the other path and remove unfinished files of earlier runs. The caller creates the file
   !> at once and only once: a file that has disappeared was removed by a later run.
   subroutine begin(self, path, error)
      class(unfinished_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      integer(int64) :: now

      call system_clock(now)
      self%path = path
      self%other_path = path//"."//text(now)//ending
      call file_remove_marked(path//nul, ending//nul)
      call check_place(path, error)
   end subroutine begin

   !> Write all of the file; on an error nothing is left behind.
   subroutine write_all(self, content, error)
      class(unfinished_type), intent(inout) :: self
      !> All of it, not shorter than before
      character(len=*), intent(in) :: content
      !> Error if the file cannot be written, or another run has begun to write it
      type(error_type), allocatable, intent(out) :: error

      call self%conclude(file_write(self%other_path//nul, content, len(content, kind=int64), &
                                    merge(1, 0, self%there)), error)
      self%there = .true.
   end subroutine write_all

   !> Give the complete file its name; on an error nothing is left behind.
   subroutine publish(self, error)
      class(unfinished_type), intent(in) :: self
      !> Error if the file cannot be renamed, or another run has begun to write it
      type(error_type), allocatable, intent(out) :: error

      call self%conclude(file_rename(self%other_path//nul, self%path//nul), error)
   end subroutine publish

   !> Why a library, which keeps the reason to itself, could not write to the file: what the system
   !> says when the file is to become longer; otherwise the words of the library.
   function why_not_written(self, words) result(reason)
      class(unfinished_type), intent(in) :: self
      character(len=*), intent(in) :: words
      character(len=:), allocatable :: reason
      integer :: answer

      reason = words
      answer = file_room(self%other_path//nul, longest_write)
      if (answer > 0) reason = reason_of(answer)
   end function why_not_written

   !> Leave nothing behind.
   subroutine discard(self)
      class(unfinished_type), intent(in) :: self
      integer :: status

      status = file_remove(self%other_path//nul)
   end subroutine discard

   !> The error of an answer that is not 0, after which nothing is left behind.
   subroutine conclude(self, answer, error)
      class(unfinished_type), intent(in) :: self
      integer, intent(in) :: answer
      type(error_type), allocatable, intent(out) :: error

      if (answer == 0) return
      call self%discard()
      call check_place(self%path, error)
      if (allocated(error)) return
      if (answer == missing) then
         call raise(error, self%path//": another run has started to write this file; only the " &
                    //"last one keeps it")
      else
         call explain(self%path, answer, error)
      end if
   end subroutine conclude
end module unfinished_file
