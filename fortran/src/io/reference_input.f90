!> Cases and how their references are computed, from a namelist.
module reference_input
   use block_parameters, only: block_history_type, block_parameters_type, missing_history, &
                               missing_parameters
   use cases_input, only: case_section_type, join_cases, keep_given, most_cases
   use dde, only: methods
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use namelist_input, only: namelist_file_type, word_length
   use value_checks, only: check_choice, check_number, missing, missing_count
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
   subroutine read_reference(path, list, reference, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), allocatable, intent(out) :: list(:)
      !> The settings
      type(reference_settings_type), intent(out) :: reference
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type), allocatable :: parameters(:)
      type(block_history_type), allocatable :: histories(:)
      type(case_section_type), allocatable :: cases(:)
      type(namelist_file_type) :: file
      namelist /settings/ cases, parameters, histories, reference

      allocate (cases(most_cases))
      allocate (parameters(most_cases), source=missing_parameters)
      allocate (histories(most_cases), source=missing_history)
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      call keep_given(cases, parameters, histories)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call join_cases(path, cases, parameters, histories, list, error)
      call check_choice(error, path, "method", reference%method, methods)
      call check_choice(error, path, "check_method", reference%check_method, methods)
      call check_number(error, path, "tolerance", reference%tolerance, above=0.0_wp)
      call check_number(error, path, "check_tolerance", reference%check_tolerance, &
                        above=reference%tolerance)
      call check_number(error, path, "disturbance", reference%disturbance, above=0.0_wp)
      call check_number(error, path, "most_steps", real(reference%most_steps, wp), at_least=1.0_wp)
   end subroutine read_reference
end module reference_input
