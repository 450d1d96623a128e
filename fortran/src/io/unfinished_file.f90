!> Files that are whole or absent: written under another name, renamed when complete. What a killed
!> run left under that name is removed. Of several runs that write the same file, as when a workflow
!> was killed and its programs live on, the last to begin does so; the others end with an error.
module unfinished_file
   use errors, only: error_type, raise
   use files, only: number_of_file, remove_file, rename_file
   use kinds, only: int64
   implicit none (type, external)
   private
   public :: remedy, unfinished_type

   !> What to do where a file cannot be written; the end of a message.
   character(len=*), parameter :: remedy = &
      "; see that its folder is there, can be written and has room, then run again"

   !> A file that is not complete.
   type :: unfinished_type
      private
      !> Path of the complete file
      character(len=:), allocatable, public :: path
      !> Number of the file under the other name; 0 before it is there
      integer(int64) :: number = 0
   contains
      !> Path until the file is complete
      procedure :: other_path
      !> The file was created under its other path; a second call does nothing
      procedure :: created
      !> Refuse to go on where another run has begun to write the file
      procedure :: check
      !> Give the complete file its name
      procedure :: publish
      !> Leave nothing behind
      procedure :: discard
      procedure, private :: is_ours
   end type unfinished_type

   interface unfinished_type
      module procedure :: new_unfinished
   end interface unfinished_type

contains

   !> Nothing is there under the other name.
   function new_unfinished(path) result(file)
      !> Path of the complete file
      character(len=*), intent(in) :: path
      type(unfinished_type) :: file

      file%path = path
      call remove_file(file%other_path())
   end function new_unfinished

   !> Path until the file is complete.
   pure function other_path(self) result(path)
      !> The file
      class(unfinished_type), intent(in) :: self
      character(len=:), allocatable :: path

      path = self%path//".part"
   end function other_path

   !> Remember which file was created under the other path, the first time.
   subroutine created(self)
      !> The file
      class(unfinished_type), intent(inout) :: self

      if (self%number == 0) self%number = number_of_file(self%other_path())
   end subroutine created

   !> Refuse to go on where another run has begun to write the file.
   subroutine check(self, error)
      !> The file
      class(unfinished_type), intent(in) :: self
      !> The other run has the file
      type(error_type), allocatable, intent(out) :: error

      if (self%is_ours()) return
      call raise(error, self%path//": another run began to write it; only the last one does")
   end subroutine check

   !> Give the complete file its name; on an error nothing is left behind.
   subroutine publish(self, error)
      !> The file
      class(unfinished_type), intent(inout) :: self
      !> It cannot be renamed
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: failure

      call self%check(error)
      if (allocated(error)) return
      call rename_file(self%other_path(), self%path, failure)
      if (.not. allocated(failure)) return
      call raise(error, failure%message//"; remove what is there, then run again")
      call self%discard()
   end subroutine publish

   !> Leave nothing behind, but for what another run writes.
   subroutine discard(self)
      !> The file
      class(unfinished_type), intent(inout) :: self

      if (self%is_ours()) call remove_file(self%other_path())
   end subroutine discard

   !> Whether the file under the other path is still the one that was created.
   logical function is_ours(self) result(value)
      !> The file
      class(unfinished_type), intent(in) :: self

      value = number_of_file(self%other_path()) == self%number
      if (self%number == 0) value = .false.
   end function is_ours
end module unfinished_file
