!> How exponents of a scene are measured, from the namelist group &exponents.
module exponents_input
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use dde_errors, only: error_type, text
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist
   use scene_input, only: scene_type
   use solver_checks, only: check_tolerance
   use value_checks, only: check_count, check_number
   implicit none (type, external)
   private
   public :: check_growth, exponents_settings_type, read_exponents

   !> Most tolerances and most lengths of steps to check by.
   integer, parameter :: most_checks = 8
   !> Most exponents and blocks.
   integer, parameter :: most_exponents = 64, most_blocks = 1000

   !> What is measured.
   type :: exponents_settings_type
      !> Number of exponents, that of the flow among them
      integer :: exponents = 0
      !> Time at which measuring ends
      real(wp) :: t_end = 0.0_wp
      !> Time before measuring in which the vectors turn
      real(wp) :: t_turning = 0.0_wp
      !> Longest time between two orthonormalisations
      real(wp) :: interval = 0.0_wp
      !> Number of blocks
      integer :: blocks = 0
      !> An exponent this close to zero has no sign
      real(wp) :: zero_level = 0.0_wp
      !> Tolerances at which all is measured once more
      real(wp), allocatable :: check_tolerances(:)
      !> Longest steps with which all is measured once more
      real(wp), allocatable :: check_steps(:)
   end type exponents_settings_type

contains

   !> Read and check the settings of a scene.
   subroutine read_exponents(path, scene, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(in) :: scene
      !> The settings
      type(exponents_settings_type), intent(out) :: settings
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call read_group(path, settings, error)
      if (allocated(error)) return
      call check_growth(error, path, "count", settings%exponents, settings%t_turning, &
                        settings%interval, settings%zero_level)
      call check_count(error, path, "blocks", settings%blocks, at_least=2, at_most=most_blocks)
      call check_number(error, path, "t_end", settings%t_end, above=scene%t_transient)
      do i = 1, size(settings%check_tolerances)
         call check_tolerance(error, path, "check_tolerances("//text(i)//")", &
                              settings%check_tolerances(i))
      end do
      do i = 1, size(settings%check_steps)
         call check_number(error, path, "check_steps("//text(i)//")", settings%check_steps(i), &
                           above=0.0_wp)
      end do
   end subroutine read_exponents

   !> Refuse what of the growth of tangent vectors cannot be measured; keep an earlier error.
   pure subroutine check_growth(error, path, key, exponents, t_turning, interval, zero_level)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Key of the number of exponents
      character(len=*), intent(in) :: key
      !> Number of exponents, that of the flow among them
      integer, intent(in) :: exponents
      !> Time before measuring in which the vectors turn
      real(wp), intent(in) :: t_turning
      !> Longest time between two orthonormalisations
      real(wp), intent(in) :: interval
      !> An exponent this close to zero has no sign
      real(wp), intent(in) :: zero_level

      call check_count(error, path, key, exponents, at_least=2, at_most=most_exponents)
      call check_number(error, path, "t_turning", t_turning, at_least=0.0_wp)
      call check_number(error, path, "interval", interval, above=0.0_wp)
      call check_number(error, path, "zero_level", zero_level, at_least=0.0_wp)
   end subroutine check_growth

   !> Read the group &exponents.
   subroutine read_group(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(exponents_settings_type), intent(out) :: settings
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      real(wp), dimension(most_checks) :: check_steps, check_tolerances
      real(wp) :: interval, t_end, t_turning, zero_level
      character(len=256) :: reason
      integer :: blocks, count, status, unit
      namelist /exponents/ count, t_end, t_turning, interval, blocks, zero_level, &
         check_tolerances, check_steps

      count = 0
      blocks = 0
      t_end = not_given()
      t_turning = t_end
      interval = t_end
      zero_level = t_end
      check_tolerances = t_end
      check_steps = t_end
      call open_namelist(path, "exponents", unit, error)
      if (allocated(error)) return
      read (unit, nml=exponents, iostat=status, iomsg=reason)
      call close_namelist(path, "exponents", unit, status, reason, error)
      settings = exponents_settings_type( &
                 exponents=count, t_end=t_end, t_turning=t_turning, interval=interval, &
                 blocks=blocks, zero_level=zero_level, &
                 check_tolerances=pack(check_tolerances, .not. ieee_is_nan(check_tolerances)), &
                 check_steps=pack(check_steps, .not. ieee_is_nan(check_steps)))
   end subroutine read_group
end module exponents_input
