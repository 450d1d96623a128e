! SPDX-License-Identifier: BSD-3-Clause
!> What the program `reference` reads and writes: cases and how their references are computed;
!> tables of text with 20 digits, more than a number in double precision holds.
module reference_files
   use cases_input, only: case_settings_type, lines_of_case, most_cases, open_cases
   use dde_errors, only: error_type, text
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use measured_run, only: run_type
   use model_history, only: shown_name
   use namelist_input, only: namelist_file_type, word_length
   use unfinished_file, only: unfinished_type
   use value_checks, only: check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: read_reference, reference_file_type, reference_settings_type

   !> How each case is computed.
   type :: reference_settings_type
      !> Method and tolerance of the reference
      character(len=word_length) :: method = ""
      real(wp) :: tolerance = missing
      !> Method and larger tolerance of the run that it is checked by
      character(len=word_length) :: check_method = ""
      real(wp) :: check_tolerance = missing
      !> Change of the values before the initial time that measures the conditioning
      real(wp) :: disturbance = missing
      !> Most steps of a run
      integer(int64) :: most_steps = missing_count
   end type reference_settings_type

   !> Between columns, and between rows.
   character(len=*), parameter :: tab = achar(9), line_end = new_line("a")
   !> Letters that hold any row.
   integer, parameter :: row_length = 512

   !> A table in the making.
   type :: reference_file_type
      private
      !> Where it stands
      type(unfinished_type) :: place
      !> Rows so far
      character(len=:), allocatable :: content
   contains
      procedure :: create, put, finish
   end type reference_file_type

contains

   !> Read and check cases and settings.
   subroutine read_reference(path, measured, reference, error)
      character(len=*), intent(in) :: path
      type(case_type), allocatable, intent(out) :: measured(:)
      type(reference_settings_type), intent(out) :: reference
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(case_settings_type), allocatable :: cases(:)
      type(namelist_file_type) :: file
      namelist /settings/ cases, reference

      allocate (cases(most_cases))
      call file%open(path, lines_of_case*most_cases)
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      ! gfortran cannot write a namelist with an array of no elements that have derived types
      cases = cases(:max(1, count(cases%name /= "")))
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call open_cases(path, cases, measured, error)
      call check_number(error, path, "most_steps", real(reference%most_steps, wp), at_least=1.0_wp)
   end subroutine read_reference

   !> Begin a file with the names of the columns: a path that cannot be written is an error before
   !> the work begins.
   subroutine create(self, path, case, error)
      class(reference_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      !> A case, whose states name the columns
      type(case_type), intent(in) :: case
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call self%place%begin(path, error)
      if (allocated(error)) return
      self%content = "case"//tab//"status"//tab//"time"
      do i = 1, case%model%n
         self%content = self%content//tab//shown_name(case%model, i)
      end do
      self%content = self%content//tab//"uncertainty"//tab//"amplification"//line_end
   end subroutine create

   !> A case at its sample times: the state, how far the state at a larger tolerance is from it, and
   !> how far that of a disturbed history, in units of the disturbance.
   subroutine put(self, case, disturbance, best, checking, disturbed)
      class(reference_file_type), intent(inout) :: self
      type(case_type), intent(in) :: case
      !> Change of the values before the initial time in the disturbed run
      real(wp), intent(in) :: disturbance
      !> The reference
      type(run_type), intent(in) :: best
      !> Solution at a larger tolerance
      type(run_type), intent(in) :: checking
      !> Solution from a disturbed history
      type(run_type), intent(in) :: disturbed
      real(wp) :: time(size(best%samples, 2))
      character(len=row_length) :: row
      character(len=:), allocatable :: form, rows
      integer :: i, j, used

      time = case%sample_times()
      allocate (character(len=row_length*size(time)) :: rows)
      used = 0
      ! 20 digits of time and state, 4 of the others
      form = "(4a,"//text(1 + size(best%samples, 1))//"(es0.19e4,a),2(es0.3e4,a))"
      do i = 1, size(time)
         write (row, form) trim(case%name), tab, trim(best%status), tab, time(i), tab, &
            (best%samples(j, i), tab, j=1, size(best%samples, 1)), &
            distance(checking%samples(:, i), best%samples(:, i)), tab, &
            distance(disturbed%samples(:, i), best%samples(:, i))/disturbance, line_end
         rows(used + 1:used + len_trim(row)) = trim(row)
         used = used + len_trim(row)
      end do
      self%content = self%content//rows(:used)
   end subroutine put

   !> Largest difference of a component, relative to the component where that is above 1.
   pure real(wp) function distance(state, from) result(value)
      real(wp), intent(in) :: state(:)
      real(wp), intent(in) :: from(:)

      value = maxval(abs(state - from)/max(1.0_wp, abs(from)))
   end function distance

   !> Write the file and give it its name; on an error nothing is left behind.
   subroutine finish(self, error)
      class(reference_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      call self%place%publish(self%content, error)
   end subroutine finish
end module reference_files
