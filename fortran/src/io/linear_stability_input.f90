!> A state whose linear stability is asked for, from the namelist group &linear_stability.
module linear_stability_input
   use block_parameters, only: block_parameters_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist
   use value_checks, only: check_number
   implicit none (type, external)
   private
   public :: linear_stability_settings_type, read_linear_stability

   !> What is asked for; all nondimensional.
   type :: linear_stability_settings_type
      !> Parameters of the block
      type(block_parameters_type) :: parameters
      !> Roots with a real part above this are kept
      real(wp) :: root_bound
      !> Longest delay and largest epsilon at which a change of stability is looked for
      real(wp) :: tau_most, epsilon_most
   end type linear_stability_settings_type

contains

   !> Read and check what is asked for.
   subroutine read_linear_stability(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(linear_stability_settings_type), intent(out) :: settings
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error

      call read_group(path, settings, error)
      call settings%parameters%check(path, error)
      call check_number(error, path, "root_bound", settings%root_bound, at_most=0.0_wp)
      call check_number(error, path, "tau_most", settings%tau_most, above=0.0_wp)
      call check_number(error, path, "epsilon_most", settings%epsilon_most, above=0.0_wp)
   end subroutine read_linear_stability

   !> Read the group &linear_stability.
   subroutine read_group(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(linear_stability_settings_type), intent(out) :: settings
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      real(wp) :: tau, epsilon, xi, gamma, root_bound, tau_most, epsilon_most
      integer :: status, unit
      namelist /linear_stability/ tau, epsilon, xi, gamma, root_bound, tau_most, epsilon_most

      tau = not_given()
      epsilon = tau
      xi = tau
      gamma = tau
      root_bound = tau
      tau_most = tau
      epsilon_most = tau
      call open_namelist(path, "linear_stability", unit, error)
      if (allocated(error)) return
      read (unit, nml=linear_stability, iostat=status, iomsg=reason)
      call close_namelist(path, "linear_stability", unit, status, reason, error)
      settings = linear_stability_settings_type( &
                 block_parameters_type(tau=tau, epsilon=epsilon, xi=xi, gamma=gamma), &
                 root_bound=root_bound, tau_most=tau_most, epsilon_most=epsilon_most)
   end subroutine read_group
end module linear_stability_input
