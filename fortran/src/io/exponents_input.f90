!> A scene and how its exponents are measured, from a namelist.
module exponents_input
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use namelist_input, only: namelist_file_type
   use scene_input, only: check_scene, scene_type
   use value_checks, only: absent, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: exponents_settings_type, read_exponents

   !> What is measured.
   type :: exponents_settings_type
      !> Number of exponents, that of the flow among them
      integer :: count = missing_count
      !> Time at which measuring ends
      real(wp) :: t_end = missing
      !> Time before measuring in which the vectors turn
      real(wp) :: t_turning = missing
      !> Longest time between two orthonormalisations
      real(wp) :: interval = missing
      !> Number of blocks
      integer :: blocks = missing_count
      !> An exponent this close to zero has no sign
      real(wp) :: zero_level = missing
      !> Tolerances at which all is measured once more
      real(wp) :: check_tolerances(8) = absent
      !> Longest steps with which all is measured once more
      real(wp) :: check_steps(8) = absent
   end type exponents_settings_type

contains

   !> Read and check a scene and the settings of its exponents.
   subroutine read_exponents(path, scene, exponents, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(out) :: scene
      !> The settings
      type(exponents_settings_type), intent(out) :: exponents
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ scene, exponents

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_scene(path, scene, error)
      call check_count(error, path, "exponents%blocks", exponents%blocks, at_least=2)
   end subroutine read_exponents
end module exponents_input
