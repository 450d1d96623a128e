!> The plane and window of Hopf curves, from a namelist.
module hopf_input
   use block_family, only: along_tau, along_xi
   use block_parameters, only: check_quantity
   use dde_errors, only: error_type
   use hopf_planes, only: curve_plane_type
   use dde_kinds, only: wp
   use namelist_input, only: namelist_file_type, word_length
   use value_checks, only: check_choice, check_count, check_number, missing, missing_count
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
      real(wp) :: fixed = missing
      !> Frequency of the block
      real(wp) :: gamma = missing
      !> Window on epsilon
      real(wp) :: epsilon_window(2) = missing
      !> Window on the ordinate
      real(wp) :: ordinate_window(2) = missing
      !> Cells of the map of unstable pairs along each side of the window
      integer :: cells = missing_count
   contains
      !> Name of the parameter that is fixed beside gamma
      procedure :: other => name_of_fixed
   end type hopf_settings_type

contains

   !> Read and check a plane.
   subroutine read_plane(path, hopf_curves, plane, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(hopf_settings_type), intent(out) :: hopf_curves
      !> The plane they describe
      type(curve_plane_type), intent(out) :: plane
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: ordinate, other
      type(namelist_file_type) :: file
      namelist /settings/ hopf_curves

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_choice(error, path, "ordinate", hopf_curves%ordinate, ordinates)
      if (allocated(error)) return
      ordinate = trim(hopf_curves%ordinate)
      other = hopf_curves%other()
      associate (x => hopf_curves%epsilon_window, y => hopf_curves%ordinate_window)
         call check_quantity(error, path, "gamma", hopf_curves%gamma)
         call check_quantity(error, path, "epsilon", x(1), "epsilon_window(1)")
         call check_number(error, path, "epsilon_window(2)", x(2), above=max(x(1), 0.0_wp))
         call check_quantity(error, path, other, hopf_curves%fixed, "fixed ("//other//")")
         call check_quantity(error, path, ordinate, y(1), "ordinate_window(1)")
         call check_number(error, path, "ordinate_window(2)", y(2), above=y(1))
         call check_count(error, path, "cells", hopf_curves%cells, 1)
         plane%epsilon_window = x
         plane%ordinate_window = y
         plane%fixed%gamma = hopf_curves%gamma
         if (ordinate == "tau") then
            plane%along = along_tau
            plane%fixed%xi = hopf_curves%fixed
         else
            plane%along = along_xi
            plane%fixed%tau = hopf_curves%fixed
         end if
      end associate
   end subroutine read_plane

   !> Name of the parameter that is fixed beside gamma.
   pure function name_of_fixed(self) result(name)
      class(hopf_settings_type), intent(in) :: self
      character(len=:), allocatable :: name

      name = trim(merge("xi ", "tau", self%ordinate == "tau"))
   end function name_of_fixed
end module hopf_input
