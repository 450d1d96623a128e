!> A state whose linear stability is computed, from a namelist.
module linear_stability_input
   use block_parameters, only: block_parameters_type, missing_parameters
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use namelist_input, only: namelist_file_type
   use value_checks, only: missing
   implicit none (type, external)
   private
   public :: linear_stability_settings_type, read_linear_stability

   !> State and bounds; all nondimensional.
   type :: linear_stability_settings_type
      !> Parameters of the block
      type(block_parameters_type) :: parameters = missing_parameters
      !> Roots with a real part above this are kept
      real(wp) :: root_bound = missing
      !> Longest delay and largest epsilon at which a change of stability is looked for
      real(wp) :: tau_most = missing, epsilon_most = missing
   end type linear_stability_settings_type

contains

   !> Read and check state and bounds.
   subroutine read_linear_stability(path, linear_stability, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(linear_stability_settings_type), intent(out) :: linear_stability
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ linear_stability

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call linear_stability%parameters%check(path, error)
   end subroutine read_linear_stability
end module linear_stability_input
