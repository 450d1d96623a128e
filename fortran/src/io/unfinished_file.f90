!> Files that appear only when they are complete: they are written under another name and renamed
!> at the end. Each run has its own other name. When it begins, it removes unfinished files of
!> earlier runs for the same path, so that nothing remains of a killed run. Several runs may write
!> the same file at once, for instance when a workflow was killed and its programs go on. The last
!> one to begin writes the file: an older run finds nothing to rename.
module unfinished_file
   use dde_errors, only: error_type, raise, text
   use file_system, only: missing, occupied, place_of_file, reason_of, remove_file, remove_marked, &
                          rename_file, room_in_file, write_file
   use dde_kinds, only: int64
   use process, only: number_of_process
   implicit none (type, external)
   private
   public :: check_place, remedy, unfinished_type

   !> What to do where a file cannot be written; the end of a message.
   character(len=*), parameter :: remedy = &
      "; check that its folder exists, is writable and has free space, then run again"
   !> Bytes that a library writes at once, at most: the largest chunk of NetCDF.
   integer, parameter :: longest_write = 2**24
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
      !> Choose the other path and remove unfinished files of earlier runs
      procedure :: begin
      !> Write all of the file
      procedure :: write => write_all
      !> Give the complete file its name
      procedure :: publish
      !> Why a library could not write to it
      procedure :: why_not_written
      !> Leave nothing behind
      procedure :: discard
      procedure, private :: conclude
   end type unfinished_type

contains

   !> Refuse a path at which no file can be written.
   subroutine check_place(path, error)
      !> Path of the complete file
      character(len=*), intent(in) :: path
      !> Why it cannot
      type(error_type), allocatable, intent(out) :: error

      call explain(path, place_of_file(path), error)
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
      !> Path of the complete file
      character(len=*), intent(in) :: path
      !> Error if the file cannot be written there
      type(error_type), allocatable, intent(out) :: error
      integer(int64) :: now

      call system_clock(now)
      self%path = path
      ! processes on two computers may have the same number; the clock makes the names differ
      self%other_path = path//"."//text(number_of_process())//"-"//text(now)//ending
      call remove_marked(path, ending)
      call check_place(path, error)
   end subroutine begin

   !> Write all of the file; on an error nothing is left behind.
   subroutine write_all(self, content, error)
      class(unfinished_type), intent(inout) :: self
      !> All of it, not shorter than before
      character(len=*), intent(in) :: content
      !> Error if the file cannot be written, or another run has begun to write it
      type(error_type), allocatable, intent(out) :: error

      call self%conclude(write_file(self%other_path, content, self%there), error)
      self%there = .true.
   end subroutine write_all

   !> Give the complete file its name; on an error nothing is left behind.
   subroutine publish(self, error)
      class(unfinished_type), intent(in) :: self
      !> Error if the file cannot be renamed, or another run has begun to write it
      type(error_type), allocatable, intent(out) :: error

      call self%conclude(rename_file(self%other_path, self%path), error)
   end subroutine publish

   !> Why a library, which keeps the reason to itself, could not write to the file: what the system
   !> says when the file is to become longer; otherwise the words of the library.
   function why_not_written(self, words) result(reason)
      class(unfinished_type), intent(in) :: self
      !> The library's own words
      character(len=*), intent(in) :: words
      character(len=:), allocatable :: reason
      integer :: answer

      reason = words
      answer = room_in_file(self%other_path, longest_write)
      if (answer > 0) reason = reason_of(answer)
   end function why_not_written

   !> Leave nothing behind.
   subroutine discard(self)
      class(unfinished_type), intent(in) :: self

      call remove_file(self%other_path)
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
