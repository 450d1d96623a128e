!> Reference files: tables of text with 20 digits, more than a number in double precision holds.
!> Whole or absent: written under another name, renamed when complete.
module reference_output
   use errors, only: error_type, raise
   use files, only: remove_file, rename_file
   use kinds, only: wp
   use measured_case, only: case_type
   use measured_run, only: run_type
   implicit none (type, external)
   private
   public :: reference_file

   !> Ending of a file that is not complete.
   character(len=*), parameter :: unfinished = ".part"
   !> Between columns.
   character(len=*), parameter :: tab = achar(9)

   !> A table in the making; after the first error all further calls do nothing.
   type :: reference_file
      private
      !> Path of the complete file
      character(len=:), allocatable :: path
      !> Unit it is open on
      integer :: unit = -1
      !> First error met
      type(error_type), allocatable, public :: error
   contains
      !> Begin a file
      procedure :: create
      !> The rows of a case
      procedure :: put
      !> Complete the file
      procedure :: finish
      procedure, private :: note
   end type reference_file

contains

   !> Begin a file with the names of the columns.
   subroutine create(self, path)
      !> The file
      class(reference_file), intent(inout) :: self
      !> Its path once complete
      character(len=*), intent(in) :: path
      character(len=256) :: reason
      integer :: status

      self%path = path
      open (newunit=self%unit, file=path//unfinished, status="replace", action="write", &
            iostat=status, iomsg=reason)
      call self%note(status, reason)
      if (allocated(self%error)) return
      write (self%unit, "(*(a))", iostat=status, iomsg=reason) "case", tab, "status", tab, "time", &
         tab, "theta", tab, "u", tab, "ln_v", tab, "uncertainty", tab, "amplification"
      call self%note(status, reason)
   end subroutine create

   !> A case at its sample times: the state, how far the state at a larger tolerance is from it, and
   !> how far that of a disturbed history, in units of the disturbance.
   subroutine put(self, case, disturbance, best, checking, disturbed)
      !> The file
      class(reference_file), intent(inout) :: self
      !> The case
      type(case_type), intent(in) :: case
      !> Change of theta and u and relative change of v for t <= 0 in the disturbed run
      real(wp), intent(in) :: disturbance
      !> The reference
      type(run_type), intent(in) :: best
      !> The same at a larger tolerance
      type(run_type), intent(in) :: checking
      !> The same from a disturbed history
      type(run_type), intent(in) :: disturbed
      real(wp) :: time(size(best%samples, 2))
      character(len=256) :: reason
      integer :: i, status

      time = case%sample_times()
      do i = 1, size(time)
         if (allocated(self%error)) return
         write (self%unit, "(4a,4(es0.19e4,a),es0.3e4,a,es0.3e4)", iostat=status, iomsg=reason) &
            trim(case%name), tab, trim(best%status), tab, time(i), tab, best%samples(1, i), tab, &
            best%samples(2, i), tab, best%samples(3, i), tab, &
            distance(checking%samples(:, i), best%samples(:, i)), tab, &
            distance(disturbed%samples(:, i), best%samples(:, i))/disturbance
         call self%note(status, reason)
      end do
   end subroutine put

   !> Largest difference of a component, relative to the component where that is above 1.
   pure real(wp) function distance(state, from) result(value)
      !> A state
      real(wp), intent(in) :: state(:)
      !> Another
      real(wp), intent(in) :: from(:)

      value = maxval(abs(state - from)/max(1.0_wp, abs(from)))
   end function distance

   !> Keep the first error and leave nothing behind.
   subroutine note(self, status, reason)
      !> The file
      class(reference_file), intent(inout) :: self
      !> I/O status
      integer, intent(in) :: status
      !> Its message
      character(len=*), intent(in) :: reason
      integer :: closed

      if (status == 0 .or. allocated(self%error)) return
      call raise(self%error, self%path//": cannot write: "//trim(reason))
      close (self%unit, iostat=closed)
      if (closed == 0) call remove_file(self%path//unfinished)
   end subroutine note

   !> Close the file and give it its name; on an error nothing is left behind.
   subroutine finish(self, error)
      !> The file
      class(reference_file), intent(inout) :: self
      !> First error met
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      integer :: status

      if (.not. allocated(self%error)) then
         close (self%unit, iostat=status, iomsg=reason)
         call self%note(status, reason)
      end if
      if (.not. allocated(self%error)) then
         call rename_file(self%path//unfinished, self%path, self%error)
         if (allocated(self%error)) call remove_file(self%path//unfinished)
      end if
      if (allocated(self%error)) allocate (error, source=self%error)
   end subroutine finish
end module reference_output
