!> What a spectrum is made from and how, from a namelist.
module spectrum_input
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use namelist_input, only: namelist_file_type, word_length
   use value_checks, only: check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: read_spectrum_settings, spectrum_settings_type

   !> Method of a spectrum.
   type :: spectrum_settings_type
      !> 'hann' or 'boxcar'
      character(len=word_length) :: window = ""
      !> Number of Welch segments
      integer :: segments = missing_count
      !> Share of a segment that the next one repeats
      real(wp) :: overlap = missing
      !> Least height of a peak over the highest peak's
      real(wp) :: peak_floor = missing
      !> Least height of a peak over the valleys beside it
      real(wp) :: peak_prominence = missing
   end type spectrum_settings_type

contains

   !> Read and check source and method of a spectrum.
   subroutine read_spectrum_settings(path, trajectory_path, spectrum, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Trajectory file to read
      character(len=:), allocatable, intent(out) :: trajectory_path
      !> The method
      type(spectrum_settings_type), intent(out) :: spectrum
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=4096) :: trajectory
      type(namelist_file_type) :: file
      namelist /settings/ trajectory, spectrum
      namelist /without_path/ spectrum

      trajectory = ""
      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=without_path, delim="quote")
      call file%close(error)
      call check_count(error, path//": spectrum", "segments", spectrum%segments, at_least=1)
      trajectory_path = trim(trajectory)
   end subroutine read_spectrum_settings
end module spectrum_input
