! SPDX-License-Identifier: BSD-3-Clause
!> Power spectrum of the signal over a trajectory after its transient, with its peaks labelled.
module spectrum_command
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: error_type, text
   use dde_kinds, only: int64, wp
   use even_slope, only: finer, smoothed_slope, undo_smoothing
   use recorded_signal, only: signal_type
   use request, only: request_type, word_length
   use results, only: results_type
   use spectral_peaks, only: base_peak, combination_peak, find_peaks, harmonic_peak, other_peak, &
                             peak_type, second_base_peak
   use spectral_density, only: power_spectrum
   use spectrum_verdict, only: continuum_share, line_share, spectrum_kind, spectrum_kind_name
   use value_checks, only: check_choice, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: run_spectrum

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
      !> Number of the block of a chain
      integer :: block = 1
   end type spectrum_settings_type

   !> Kinds of peaks
   integer, parameter :: kinds(5) = [base_peak, harmonic_peak, second_base_peak, &
                                     combination_peak, other_peak]
   !> Names of the kinds
   character(len=*), parameter :: kind_names(5) = [character(len=12) :: "base", "harmonic", &
                                                   "second_base", "combination", "other"]

contains

   !> Run the command.
   subroutine run_spectrum(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)
      type(spectrum_settings_type) :: settings
      type(signal_type) :: recorded
      real(wp), allocatable :: frequency(:), power(:), v(:)
      real(wp) :: interval
      integer :: first

      call read_settings(given, path, settings, error)
      if (allocated(error)) return
      call given%read_signal(path, settings%block, recorded, error)
      if (allocated(error)) return
      interval = recorded%sample_interval
      first = count(recorded%t < recorded%t_transient*(1.0_wp - epsilon(1.0_wp))) + 1
      v = recorded%v(first:)
      if (allocated(recorded%u)) then
         interval = interval/finer
         v = recorded%slope_at_rest + smoothed_slope( &
             recorded%t(first:), recorded%u(first:), v - recorded%slope_at_rest, interval)
      end if
      call power_spectrum(v, interval, settings%window, settings%segments, settings%overlap, &
                          frequency, power, error)
      if (allocated(error) .and. path /= "") error%message = path//": "//error%message
      if (allocated(error)) return
      if (allocated(recorded%u)) call undo_smoothing(interval, frequency, power)
      peaks = find_peaks(frequency, power, settings%peak_floor, settings%peak_prominence)
      call label_peaks(peaks, frequency(2), bases)
      call put_spectrum(data, trim(recorded%scene), trim(recorded%signal), settings, frequency, &
                        power, sum((v - sum(v)/size(v))**2)/size(v), peaks, bases)
   end subroutine run_spectrum

   !> Read and check source and method of a spectrum.
   subroutine read_settings(given, trajectory_path, spectrum, error)
      class(request_type), intent(inout) :: given
      !> Trajectory file to read
      character(len=:), allocatable, intent(out) :: trajectory_path
      !> The method
      type(spectrum_settings_type), intent(out) :: spectrum
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=4096) :: trajectory
      namelist /settings/ trajectory, spectrum
      namelist /without_path/ spectrum

      trajectory = ""
      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=without_path, delim="quote")
      call given%check(error)
      call check_choice(error, given%place//"spectrum: ", "window", spectrum%window, &
                        ["hann  ", "boxcar"])
      call check_count(error, given%place//"spectrum: ", "block", spectrum%block, at_least=1)
      call check_count(error, given%place//"spectrum: ", "segments", spectrum%segments, &
                       at_least=1)
      trajectory_path = trim(trajectory)
   end subroutine read_settings

   !> A spectrum with its labelled peaks and what it is.
   subroutine put_spectrum(data, scene, signal, settings, frequency, power, variance, peaks, bases)
      class(results_type), intent(inout) :: data
      !> Name of the scene
      character(len=*), intent(in) :: scene
      !> Name of the signal
      character(len=*), intent(in) :: signal
      type(spectrum_settings_type), intent(in) :: settings
      real(wp), intent(in) :: frequency(:)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Variance of the signal
      real(wp), intent(in) :: variance
      type(peak_type), intent(in) :: peaks(:)
      !> Fundamental frequencies of the spectrum
      type(bases_type), intent(in) :: bases
      integer :: base, bins, rows

      call data%attribute("title", "Power spectrum of "//signal)
      bins = data%dimension("frequency", size(frequency))
      rows = data%dimension("peak", size(peaks), "peak_frequency", "peak_")
      call data%column(bins, "frequency", frequency, "frequency, cycles per unit of time")
      call data%column(bins, "power", power, "one-sided power spectral density of "//signal)
      call data%column(rows, "frequency", peaks%frequency, "interpolated frequency of the peak")
      call data%column(rows, "power", peaks%power, "interpolated height of the peak")
      call data%flags(rows, "kind", peaks%kind, kind_names, "what the peak is", kinds)
      call data%column(rows, "multiple", peaks%multiple(1), &
                       "multiple of the first fundamental frequency")
      call data%column(rows, "second_multiple", peaks%multiple(2), &
                       "multiple of the second fundamental frequency, added to the first's")
      base = data%dimension("base", count(bases%frequency > 0.0_wp))
      call data%column(base, "base_frequency", pack(bases%frequency, bases%frequency > 0.0_wp), &
                       "fundamental frequencies of the peaks")
      call data%attribute("scene", scene)
      call data%attribute("signal", trim(signal))
      call data%attribute("window", trim(settings%window))
      call data%attribute("segments", int(settings%segments, int64))
      call data%attribute("overlap", settings%overlap)
      call data%attribute("peak_floor", settings%peak_floor)
      call data%attribute("peak_prominence", settings%peak_prominence)
      call data%attribute("variance", variance)
      call data%attribute("line_share", line_share(power, peaks))
      call data%attribute("continuum_share", continuum_share(power, peaks))
      if (bases%frequency(2) > 0.0_wp) then
         call data%attribute("combination_order", int(bases%order, int64))
         call data%attribute("ratio_of_bases", text(bases%ratio(1))//"/"//text(bases%ratio(2)))
         call data%attribute("bases_told_apart", trim(merge("yes", "no ", bases%told_apart)))
      end if
      call data%attribute("spectrum_kind", spectrum_kind_name(spectrum_kind(power, peaks, bases)))
   end subroutine put_spectrum
end module spectrum_command
