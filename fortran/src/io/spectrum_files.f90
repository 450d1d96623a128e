! SPDX-License-Identifier: BSD-3-Clause
!> What the program `spectrum` reads and writes: a trajectory, source and method of a spectrum; the
!> spectrum.
module spectrum_files
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use base_frequencies, only: bases_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64, wp
   use namelist_input, only: namelist_file_type, word_length
   use netcdf, only: nf90_close, nf90_get_att, nf90_get_var, nf90_global, nf90_inq_dimid, &
                     nf90_inq_varid, nf90_inquire_dimension, nf90_inquire_variable, nf90_noerr, &
                     nf90_nowrite, nf90_open, nf90_strerror
   use output_file, only: output_file_type
   use spectral_peaks, only: base_peak, combination_peak, harmonic_peak, other_peak, peak_type, &
                             second_base_peak
   use spectrum_verdict, only: continuum_share, line_share, spectrum_kind, spectrum_kind_name
   use value_checks, only: check_choice, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: read_spectrum_settings, read_trajectory, spectrum_settings_type, trajectory_type, &
             write_spectrum

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

   !> The signal of a trajectory.
   type :: trajectory_type
      !> Name of the scene
      character(len=64) :: scene = ""
      !> Longest time between samples
      real(wp) :: sample_interval = 0.0_wp
      !> Time up to which the transient lasts
      real(wp) :: t_transient = 0.0_wp
      !> Times of the samples, from t = 0 on
      real(wp), allocatable :: t(:)
      !> Name of the signal, and its values
      character(len=64) :: signal = ""
      real(wp), allocatable :: v(:)
      !> Where times are uneven, the state that grows by the integral of the signal less
      !> `slope_at_rest` times the time
      real(wp), allocatable :: u(:)
      real(wp) :: slope_at_rest = 0.0_wp
   end type trajectory_type

   !> What to do with a file that is damaged; the end of a message.
   character(len=*), parameter :: unread = &
      " cannot be read (remove the file; the next run makes it again)"

contains

   !> Read and check source and method of a spectrum.
   subroutine read_spectrum_settings(path, trajectory_path, spectrum, error)
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
      call file%open(path)
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=without_path, delim="quote")
      call file%close(error)
      call check_choice(error, path//": spectrum", "window", spectrum%window, ["hann  ", "boxcar"])
      call check_count(error, path//": spectrum", "block", spectrum%block, at_least=1)
      call check_count(error, path//": spectrum", "segments", spectrum%segments, at_least=1)
      trajectory_path = trim(trajectory)
   end subroutine read_spectrum_settings

   !> Read times and signal, and its integral where the times are uneven.
   subroutine read_trajectory(path, block, trajectory, error)
      character(len=*), intent(in) :: path
      !> Number of the block of a chain
      integer, intent(in) :: block
      !> What was read
      type(trajectory_type), intent(out) :: trajectory
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=64) :: integral
      integer :: dimension, file, length, status

      call check(nf90_open(path, nf90_nowrite, file), &
                 "cannot be opened (remove it; the next run makes it again)")
      if (allocated(error)) return
      call check(nf90_get_att(file, nf90_global, "scene", trajectory%scene), "attribute 'scene'")
      call check(nf90_get_att(file, nf90_global, "sample_interval", trajectory%sample_interval), &
                 "attribute 'sample_interval'")
      call check(nf90_get_att(file, nf90_global, "t_transient", trajectory%t_transient), &
                 "attribute 't_transient'")
      call check(nf90_inq_dimid(file, "t", dimension), "dimension 't'")
      if (.not. allocated(error)) then
         call check(nf90_inquire_dimension(file, dimension, len=length), "dimension 't'")
      end if
      call check(nf90_get_att(file, nf90_global, "signal", trajectory%signal), "attribute 'signal'")
      call read_variable(trim(trajectory%signal), trajectory%v)
      call read_variable("t", trajectory%t)
      if (.not. allocated(error)) then
         if ((length - 1.5_wp)*trajectory%sample_interval > trajectory%t(length)) then
            integral = ""
            call check(nf90_get_att(file, nf90_global, "integral", integral), &
                       "attribute 'integral'")
            call check(nf90_get_att(file, nf90_global, "integral_slope", &
                                    trajectory%slope_at_rest), "attribute 'integral_slope'")
            if (.not. allocated(error)) call read_variable(trim(integral), trajectory%u)
         end if
      end if
      status = nf90_close(file)

   contains

      !> Read one variable.
      subroutine read_variable(name, values)
         character(len=*), intent(in) :: name
         real(wp), allocatable, intent(out) :: values(:)
         integer :: dimensions, id

         call check(nf90_inq_varid(file, name, id), "holds no variable '"//name &
                    //"' (add it to the variables of its scene)")
         if (allocated(error)) return
         allocate (values(length))
         call check(nf90_inquire_variable(file, id, ndims=dimensions), "variable '"//name//"'")
         if (allocated(error)) return
         if (dimensions == 1) then
            call check(nf90_get_var(file, id, values), "variable '"//name//"'")
         else
            call check(nf90_get_var(file, id, values, start=[block, 1], count=[1, length]), &
                       "block "//text(block)//" of variable '"//name//"'")
         end if
         if (allocated(error)) return
         if (.not. all(ieee_is_finite(values))) then
            call raise(error, path//": variable '"//name//"' holds values that are not finite")
         end if
      end subroutine read_variable

      !> Keep the first error: what failed, and what to do where that does not say it.
      subroutine check(outcome, what)
         integer, intent(in) :: outcome
         character(len=*), intent(in) :: what
         character(len=:), allocatable :: words

         if (outcome == nf90_noerr .or. allocated(error)) return
         words = what
         if (index(what, "(") == 0) words = what//unread
         call raise(error, path//": "//words//": "//trim(nf90_strerror(outcome)))
      end subroutine check
   end subroutine read_trajectory

   !> Write a spectrum with its labelled peaks and what it is.
   subroutine write_spectrum(path, scene, signal, settings, frequency, power, variance, peaks, &
                             bases, error)
      character(len=*), intent(in) :: path
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
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: base, bins, rows

      call file%create(path, "Power spectrum of "//signal)
      bins = file%dimension("frequency", size(frequency))
      rows = file%dimension("peak", size(peaks), "peak_frequency", "peak_")
      call file%column(bins, "frequency", frequency, "frequency, cycles per unit of time")
      call file%column(bins, "power", power, "one-sided power spectral density of "//signal)
      call file%column(rows, "frequency", peaks%frequency, "interpolated frequency of the peak")
      call file%column(rows, "power", peaks%power, "interpolated height of the peak")
      call file%flags(rows, "kind", peaks%kind, kind_names, "what the peak is", kinds)
      call file%column(rows, "multiple", peaks%multiple(1), &
                       "multiple of the first fundamental frequency")
      call file%column(rows, "second_multiple", peaks%multiple(2), &
                       "multiple of the second fundamental frequency, added to the first's")
      base = file%dimension("base", count(bases%frequency > 0.0_wp))
      call file%column(base, "base_frequency", pack(bases%frequency, bases%frequency > 0.0_wp), &
                       "fundamental frequencies of the peaks")
      call file%attribute("scene", scene)
      call file%attribute("signal", trim(signal))
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
end module spectrum_files
