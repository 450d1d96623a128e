!> The plane and window of Hopf curves, from the namelist group &hopf_curves.
module hopf_input
   use block_family, only: along_tau, along_xi
   use block_parameters, only: check_quantity
   use dde_errors, only: error_type
   use hopf_planes, only: curve_plane_type
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use value_checks, only: check_choice, check_count, check_number
   implicit none (type, external)
   private
   public :: hopf_settings_type, read_plane

   !> What the curves show: the ordinate over epsilon.
   character(len=3), parameter :: ordinates(2) = ["tau", "xi "]

   !> A plane as the namelist gives it; all nondimensional.
   type :: hopf_settings_type
      !> 'tau' or 'xi'
      character(len=word_length) :: ordinate = ""
      !> Value of the other of the two
      real(wp) :: fixed
      !> Frequency of the block
      real(wp) :: gamma
      !> Window on epsilon
      real(wp) :: epsilon_window(2)
      !> Window on the ordinate
      real(wp) :: ordinate_window(2)
      !> Cells of the map of unstable pairs along each side of the window
      integer :: cells = 0
   end type hopf_settings_type

contains

   !> Read and check a plane.
   subroutine read_plane(path, settings, plane, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(hopf_settings_type), intent(out) :: settings
      !> The plane they describe
      type(curve_plane_type), intent(out) :: plane
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=3) :: other

      call read_group(path, settings, error)
      call check_choice(error, path, "ordinate", settings%ordinate, ordinates)
      call check_quantity(error, path, "gamma", settings%gamma)
      associate (x => settings%epsilon_window, y => settings%ordinate_window)
         call check_quantity(error, path, "epsilon", x(1), "epsilon_window(1)")
         call check_number(error, path, "epsilon_window(2)", x(2), above=max(x(1), 0.0_wp))
         other = merge("xi ", "tau", settings%ordinate == "tau")
         call check_quantity(error, path, trim(other), settings%fixed, "fixed ("//trim(other)//")")
         call check_quantity(error, path, trim(settings%ordinate), y(1), "ordinate_window(1)")
         call check_number(error, path, "ordinate_window(2)", y(2), above=y(1))
         call check_count(error, path, "cells", settings%cells, 1)
         plane%epsilon_window = x
         plane%ordinate_window = y
         plane%fixed%gamma = settings%gamma
         if (settings%ordinate == "tau") then
            plane%along = along_tau
            plane%fixed%xi = settings%fixed
         else
            plane%along = along_xi
            plane%fixed%tau = settings%fixed
         end if
      end associate
   end subroutine read_plane

   !> Read the group &hopf_curves.
   subroutine read_group(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(hopf_settings_type), intent(out) :: settings
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=len(settings%ordinate)) :: ordinate
      character(len=256) :: reason
      real(wp) :: fixed, gamma, epsilon_window(2), ordinate_window(2)
      integer :: cells, status, unit
      namelist /hopf_curves/ ordinate, fixed, gamma, epsilon_window, ordinate_window, cells

      ordinate = ""
      fixed = not_given()
      gamma = fixed
      epsilon_window = fixed
      ordinate_window = fixed
      cells = 0
      call open_namelist(path, "hopf_curves", unit, error)
      if (allocated(error)) return
      read (unit, nml=hopf_curves, iostat=status, iomsg=reason)
      call close_namelist(path, "hopf_curves", unit, status, reason, error)
      settings = hopf_settings_type(ordinate=ordinate, fixed=fixed, gamma=gamma, cells=cells, &
                                    epsilon_window=epsilon_window, &
                                    ordinate_window=ordinate_window)
   end subroutine read_group
end module hopf_input
