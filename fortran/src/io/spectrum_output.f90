!> Spectrum files.
module spectrum_output
   use errors, only: error_type
   use kinds, only: int64, wp
   use netcdf_output, only: output_file
   use spectral_peaks, only: base_peak, harmonic_peak, is_periodic, other_peak, peak_type
   use spectrum_input, only: spectrum_settings
   implicit none (type, external)
   private
   public :: write_spectrum

contains

   !> Write a spectrum with its labelled peaks.
   subroutine write_spectrum(path, scene, settings, frequency, power, variance, peaks, share, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Name of the scene
      character(len=*), intent(in) :: scene
      !> How it was made
      type(spectrum_settings), intent(in) :: settings
      !> Frequencies
      real(wp), intent(in) :: frequency(:)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Variance of the signal
      real(wp), intent(in) :: variance
      !> Labelled peaks
      type(peak_type), intent(in) :: peaks(:)
      !> Share of the power in the base frequency and its harmonics
      real(wp), intent(in) :: share
      !> It could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file) :: file
      integer :: bins, f, k, m, p, pf, pp, rows

      call file%create(path, "Power spectrum of the velocity v")
      bins = file%dimension("frequency", size(frequency))
      rows = file%dimension("peak", size(peaks))
      f = file%real_variable("frequency", bins, "frequency, cycles per unit of time", "1")
      p = file%real_variable("power", bins, "one-sided power spectral density of v", "1")
      pf = file%real_variable("peak_frequency", rows, "interpolated frequency of the peak", "1")
      pp = file%real_variable("peak_power", rows, "interpolated height of the peak", "1")
      k = file%integer_variable("peak_kind", rows, "what the peak is")
      call file%attribute("flag_values", flag_text(), k)
      call file%attribute("flag_meanings", "base harmonic other", k)
      m = file%integer_variable("peak_multiple", rows, &
                                "multiple of the base frequency, 0 for others")
      call file%attribute("scene", scene)
      call file%attribute("window", trim(settings%window))
      call file%attribute("segments", int(settings%segments, int64))
      call file%attribute("overlap", settings%overlap)
      call file%attribute("peak_floor", settings%peak_floor)
      call file%attribute("peak_prominence", settings%peak_prominence)
      call file%attribute("variance", variance)
      call file%attribute("line_share", share)
      call file%attribute("signal", trim(merge("periodic    ", "not periodic", &
                                               is_periodic(peaks, share))))
      call file%put(f, frequency)
      call file%put(p, power)
      call file%put(pf, peaks%frequency)
      call file%put(pp, peaks%power)
      call file%put(k, peaks%kind)
      call file%put(m, peaks%multiple)
      call file%finish(error)
   end subroutine write_spectrum

   !> The kinds as numbers in words, in the order of their meanings.
   pure function flag_text() result(flags)
      character(len=8) :: flags

      write (flags, "(i0,1x,i0,1x,i0)") base_peak, harmonic_peak, other_peak
   end function flag_text
end module spectrum_output
