!> How references are computed, from the namelist group &reference.
module reference_input
   use dde, only: methods
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use value_checks, only: check_choice, check_count, check_number
   implicit none (type, external)
   private
   public :: read_reference, reference_settings_type

   !> How each case is computed.
   type :: reference_settings_type
      !> Method and tolerance of the reference
      character(len=10) :: method = ""
      real(wp) :: tolerance = 0.0_wp
      !> Method and larger tolerance of the run that it is checked by
      character(len=10) :: check_method = ""
      real(wp) :: check_tolerance = 0.0_wp
      !> Change of theta and u, and relative change of v, for t <= 0, that measures the conditioning
      real(wp) :: disturbance = 0.0_wp
      !> Most steps of a run
      integer(int64) :: most_steps = 0
   end type reference_settings_type

contains

   !> Read and check the settings.
   subroutine read_reference(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(reference_settings_type), intent(out) :: settings
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: check_method, method
      real(wp) :: tolerance, check_tolerance, disturbance
      character(len=256) :: reason
      integer :: most_steps, status, unit
      namelist /reference/ method, tolerance, check_method, check_tolerance, disturbance, most_steps

      method = ""
      check_method = ""
      tolerance = not_given()
      check_tolerance = not_given()
      disturbance = not_given()
      most_steps = -1
      call open_namelist(path, "reference", unit, error)
      if (allocated(error)) return
      read (unit, nml=reference, iostat=status, iomsg=reason)
      call close_namelist(path, "reference", unit, status, reason, error)
      call check_choice(error, path, "method", method, methods)
      call check_choice(error, path, "check_method", check_method, methods)
      call check_number(error, path, "tolerance", tolerance, at_least=1.0e-22_wp, &
                        at_most=1.0e-10_wp)
      call check_number(error, path, "check_tolerance", check_tolerance, above=tolerance, &
                        at_most=1.0e-10_wp)
      call check_number(error, path, "disturbance", disturbance, above=0.0_wp, &
                        at_most=1.0e-10_wp)
      call check_count(error, path, "most_steps", most_steps, 1)
      settings = reference_settings_type(method=method(:10), tolerance=tolerance, &
                                         check_method=check_method(:10), &
                                         check_tolerance=check_tolerance, &
                                         disturbance=disturbance, most_steps=int(most_steps, int64))
   end subroutine read_reference
end module reference_input
