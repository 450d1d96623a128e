!> Cases and how their references are computed, from a namelist.
module reference_input
   use cases_input, only: check_cases, missing_case, most_cases
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use namelist_input, only: namelist_file_type, word_length
   use value_checks, only: check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: read_reference, reference_settings_type

   !> How each case is computed.
   type :: reference_settings_type
      !> Method and tolerance of the reference
      character(len=word_length) :: method = ""
      real(wp) :: tolerance = missing
      !> Method and larger tolerance of the run that it is checked by
      character(len=word_length) :: check_method = ""
      real(wp) :: check_tolerance = missing
      !> Change of theta and u, and relative change of v, for t <= 0, that measures the conditioning
      real(wp) :: disturbance = missing
      !> Most steps of a run
      integer(int64) :: most_steps = missing_count
   end type reference_settings_type

contains

   !> Read and check cases and settings.
   subroutine read_reference(path, cases, reference, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), allocatable, intent(out) :: cases(:)
      !> The settings
      type(reference_settings_type), intent(out) :: reference
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ cases, reference

      allocate (cases(most_cases), source=missing_case)
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      cases = pack(cases, cases%name /= "")
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_cases(path, cases, error)
      call check_number(error, path, "most_steps", real(reference%most_steps, wp), at_least=1.0_wp)
   end subroutine read_reference
end module reference_input
