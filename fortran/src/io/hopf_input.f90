!> The plane and window of Hopf curves, from the namelist group &hopf_curves.
module hopf_input
   use dde_errors, only: error_type
   use hopf_planes, only: curve_plane, tau_of_epsilon, xi_of_epsilon
   use dde_kinds, only: wp
   use namelist_input, only: check_choice, check_count, check_number, close_namelist, not_given, &
                             open_namelist, word_length
   implicit none (type, external)
   private
   public :: hopf_settings, read_plane

   !> What the curves show: the ordinate over epsilon.
   character(len=3), parameter :: ordinates(2) = ["tau", "xi "]

   !> A plane as the namelist gives it; all nondimensional.
   type :: hopf_settings
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
   end type hopf_settings

contains

   !> Read and check a plane.
   subroutine read_plane(path, settings, plane, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(hopf_settings), intent(out) :: settings
      !> The plane they describe
      class(curve_plane), allocatable, intent(out) :: plane
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error

      call read_group(path, settings, error)
      call check_choice(error, path, "ordinate", settings%ordinate, ordinates)
      call check_number(error, path, "gamma", settings%gamma, above=0.0_wp)
      associate (x => settings%epsilon_window, y => settings%ordinate_window)
         call check_number(error, path, "epsilon_window(1)", x(1), above=-1.0_wp)
         call check_number(error, path, "epsilon_window(2)", x(2), above=max(x(1), 0.0_wp))
         if (settings%ordinate == "tau") then
            call check_number(error, path, "fixed (xi)", settings%fixed, above=0.0_wp)
            call check_number(error, path, "ordinate_window(1)", y(1), at_least=0.0_wp)
         else
            call check_number(error, path, "fixed (tau)", settings%fixed, at_least=0.0_wp)
            call check_number(error, path, "ordinate_window(1)", y(1), above=0.0_wp)
         end if
         call check_number(error, path, "ordinate_window(2)", y(2), above=y(1))
         call check_count(error, path, "cells", settings%cells, 1)
         if (settings%ordinate == "tau") then
            plane = tau_of_epsilon(settings%gamma, x, y, settings%fixed)
         else
            plane = xi_of_epsilon(settings%gamma, x, y, settings%fixed)
         end if
      end associate
   end subroutine read_plane

   !> Read the group &hopf_curves.
   subroutine read_group(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(hopf_settings), intent(out) :: settings
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
      call open_namelist(path, unit, error)
      if (allocated(error)) return
      read (unit, nml=hopf_curves, iostat=status, iomsg=reason)
      call close_namelist(path, "hopf_curves", unit, status, reason, error)
      settings = hopf_settings(ordinate, fixed, gamma, epsilon_window, ordinate_window, cells)
   end subroutine read_group
end module hopf_input
