!> The plane and window of Hopf curves, from a namelist.
module hopf_input
   use block_family, only: along_tau, along_xi
   use block_parameters, only: check_quantity
   use dde_errors, only: error_type
   use hopf_planes, only: curve_plane_type
   use dde_kinds, only: wp
   use namelist_input, only: namelist_file_type, word_length
   use value_checks, only: missing, missing_count
   implicit none (type, external)
   private
   public :: hopf_settings_type, read_plane

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
      type(namelist_file_type) :: file
      namelist /settings/ hopf_curves

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_quantity(error, path, "gamma", hopf_curves%gamma)
      plane%epsilon_window = hopf_curves%epsilon_window
      plane%ordinate_window = hopf_curves%ordinate_window
      plane%fixed%gamma = hopf_curves%gamma
      if (hopf_curves%ordinate == "tau") then
         plane%along = along_tau
         plane%fixed%xi = hopf_curves%fixed
      else
         plane%along = along_xi
         plane%fixed%tau = hopf_curves%fixed
      end if
   end subroutine read_plane

   !> Name of the parameter that is fixed beside gamma.
   pure function name_of_fixed(self) result(name)
      class(hopf_settings_type), intent(in) :: self
      character(len=:), allocatable :: name

      name = trim(merge("xi ", "tau", self%ordinate == "tau"))
   end function name_of_fixed
end module hopf_input
