!> Spectrum files.
module spectrum_output
   use base_frequencies, only: bases_type
   use dde_errors, only: error_type, text
   use dde_kinds, only: int64, wp
   use netcdf_output, only: output_file_type
   use spectral_peaks, only: base_peak, combination_peak, harmonic_peak, other_peak, peak_type, &
                             second_base_peak
   use spectrum_input, only: spectrum_settings_type
   use spectrum_verdict, only: continuum_share, line_share, spectrum_kind, spectrum_kind_name
   implicit none (type, external)
   private
   public :: write_spectrum

   !> Kinds of peaks
   integer, parameter :: kinds(5) = [base_peak, harmonic_peak, second_base_peak, &
                                     combination_peak, other_peak]
   !> Their names
   character(len=*), parameter :: kind_names(5) = [character(len=12) :: "base", "harmonic", &
                                                   "second_base", "combination", "other"]

contains

   !> Write a spectrum with its labelled peaks and what it is.
   subroutine write_spectrum(path, scene, settings, frequency, power, variance, peaks, bases, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Name of the scene
      character(len=*), intent(in) :: scene
      !> How it was made
      type(spectrum_settings_type), intent(in) :: settings
      !> Frequencies
      real(wp), intent(in) :: frequency(:)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Variance of the signal
      real(wp), intent(in) :: variance
      !> Labelled peaks
      type(peak_type), intent(in) :: peaks(:)
      !> Their fundamental frequencies
      type(bases_type), intent(in) :: bases
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: base, bins, rows

      call file%create(path, "Power spectrum of the velocity v")
      bins = file%dimension("frequency", size(frequency))
      rows = file%dimension("peak", size(peaks), coordinates="peak_frequency")
      call file%column(bins, "frequency", frequency, "frequency, cycles per unit of time")
      call file%column(bins, "power", power, "one-sided power spectral density of v")
      call file%column(rows, "peak_frequency", peaks%frequency, &
                       "interpolated frequency of the peak")
      call file%column(rows, "peak_power", peaks%power, "interpolated height of the peak")
      call file%flags(rows, "peak_kind", peaks%kind, kind_names, "what the peak is", kinds)
      call file%column(rows, "peak_multiple", peaks%multiple(1), &
                       "multiple of the first fundamental frequency")
      call file%column(rows, "peak_second_multiple", peaks%multiple(2), &
                       "multiple of the second fundamental frequency, added to the first's")
      base = file%dimension("base", count(bases%frequency > 0.0_wp))
      call file%column(base, "base_frequency", pack(bases%frequency, bases%frequency > 0.0_wp), &
                       "fundamental frequencies of the peaks")
      call file%attribute("scene", scene)
      call file%attribute("window", trim(settings%window))
      call file%attribute("segments", int(settings%segments, int64))
      call file%attribute("overlap", settings%overlap)
      call file%attribute("peak_floor", settings%peak_floor)
      call file%attribute("peak_prominence", settings%peak_prominence)
      call file%attribute("variance", variance)
      call file%attribute("line_share", line_share(power, peaks))
      call file%attribute("continuum_share", continuum_share(power, peaks))
      if (bases%frequency(2) > 0.0_wp) then
         call file%attribute("combination_order", int(bases%order, int64))
         call file%attribute("ratio_of_bases", text(bases%ratio(1))//"/"//text(bases%ratio(2)))
         call file%attribute("bases_told_apart", trim(merge("yes", "no ", bases%told_apart)))
      end if
      call file%attribute("spectrum_kind", spectrum_kind_name(spectrum_kind(power, peaks, bases)))
      call file%finish(error)
   end subroutine write_spectrum
end module spectrum_output
