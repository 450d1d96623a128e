!> What a spectrum is made from and how, from the namelist group &spectrum.
module spectrum_input
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use value_checks, only: check_choice, check_count, check_number
   implicit none (type, external)
   private
   public :: check_spectrum, read_spectrum_settings, spectrum_settings_type

   !> Windows to choose from.
   character(len=6), parameter :: windows(2) = ["hann  ", "boxcar"]

   !> Source and method of a spectrum.
   type :: spectrum_settings_type
      !> Trajectory file to read
      character(len=4096) :: trajectory = ""
      !> 'hann' or 'boxcar'
      character(len=word_length) :: window = ""
      !> Number of Welch segments
      integer :: segments = 0
      !> Share of a segment that the next one repeats
      real(wp) :: overlap
      !> Least height of a peak over the highest peak's
      real(wp) :: peak_floor
      !> Least height of a peak over the valleys beside it
      real(wp) :: peak_prominence
   end type spectrum_settings_type

contains

   !> Read and check the settings.
   subroutine read_spectrum_settings(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(spectrum_settings_type), intent(out) :: settings
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error

      call read_group(path, settings, error)
      if (.not. allocated(error) .and. settings%trajectory == "") then
         call raise(error, path//": trajectory = ''; expected the path of a trajectory file")
      end if
      call check_spectrum(error, path, settings%window, settings%segments, settings%overlap, &
                          settings%peak_floor, settings%peak_prominence)
   end subroutine read_spectrum_settings

   !> Refuse a spectrum that cannot be made; keep an earlier error.
   pure subroutine check_spectrum(error, path, window, segments, overlap, peak_floor, &
                                  peak_prominence)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Name of the window
      character(len=*), intent(in) :: window
      !> Number of Welch segments
      integer, intent(in) :: segments
      !> Share of a segment that the next one repeats
      real(wp), intent(in) :: overlap
      !> Least height of a peak over the highest peak's
      real(wp), intent(in) :: peak_floor
      !> Least height of a peak over the valleys beside it
      real(wp), intent(in) :: peak_prominence

      call check_choice(error, path, "window", window, windows)
      call check_count(error, path, "segments", segments, at_least=1)
      call check_number(error, path, "overlap", overlap, at_least=0.0_wp, below=1.0_wp)
      call check_number(error, path, "peak_floor", peak_floor, above=0.0_wp, at_most=1.0_wp)
      call check_number(error, path, "peak_prominence", peak_prominence, at_least=1.0_wp)
   end subroutine check_spectrum

   !> Read the group &spectrum.
   subroutine read_group(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(spectrum_settings_type), intent(out) :: settings
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=len(settings%trajectory)) :: trajectory
      character(len=len(settings%window)) :: window
      character(len=256) :: reason
      real(wp) :: overlap, peak_floor, peak_prominence
      integer :: segments, status, unit
      namelist /spectrum/ trajectory, window, segments, overlap, peak_floor, peak_prominence

      trajectory = ""
      window = ""
      segments = 0
      overlap = not_given()
      peak_floor = overlap
      peak_prominence = overlap
      call open_namelist(path, "spectrum", unit, error)
      if (allocated(error)) return
      read (unit, nml=spectrum, iostat=status, iomsg=reason)
      call close_namelist(path, "spectrum", unit, status, reason, error)
      settings = spectrum_settings_type(trajectory=trajectory, window=window, segments=segments, &
                                        overlap=overlap, peak_floor=peak_floor, &
                                        peak_prominence=peak_prominence)
   end subroutine read_group
end module spectrum_input
