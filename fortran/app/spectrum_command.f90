! SPDX-License-Identifier: BSD-3-Clause
!> Power spectrum of the signal over a trajectory after its transient, with its peaks labelled.
module spectrum_command
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use even_slope, only: finer, smoothed_slope, undo_smoothing
   use program_arguments, only: check_input
   use spectral_peaks, only: find_peaks, peak_type
   use spectrum, only: power_spectrum
   use spectrum_files, only: read_spectrum_settings, read_trajectory, spectrum_settings_type, &
                             trajectory_type, write_spectrum
   implicit none (type, external)
   private
   public :: run_spectrum

contains

   !> Run the command.
   subroutine run_spectrum(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: trajectory_path
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)
      type(spectrum_settings_type) :: settings
      type(trajectory_type) :: trajectory
      real(wp), allocatable :: frequency(:), power(:), v(:)
      real(wp) :: interval
      integer :: first

      call read_spectrum_settings(namelist_path, trajectory_path, settings, error)
      if (allocated(error)) return
      call check_input(trajectory_path, output_path)
      call read_trajectory(trajectory_path, settings%block, trajectory, error)
      if (allocated(error)) return

      interval = trajectory%sample_interval
      first = count(trajectory%t < trajectory%t_transient*(1.0_wp - epsilon(1.0_wp))) + 1
      v = trajectory%v(first:)
      if (allocated(trajectory%u)) then
         interval = interval/finer
         v = trajectory%slope_at_rest + smoothed_slope( &
             trajectory%t(first:), trajectory%u(first:), v - trajectory%slope_at_rest, interval)
      end if
      call power_spectrum(v, interval, settings%window, settings%segments, settings%overlap, &
                          frequency, power, error)
      if (allocated(error)) error%message = trajectory_path//": "//error%message
      if (allocated(error)) return
      if (allocated(trajectory%u)) call undo_smoothing(interval, frequency, power)
      peaks = find_peaks(frequency, power, settings%peak_floor, settings%peak_prominence)
      call label_peaks(peaks, frequency(2), bases)
      call write_spectrum(output_path, trim(trajectory%scene), trim(trajectory%signal), settings, &
                          frequency, power, sum((v - sum(v)/size(v))**2)/size(v), peaks, bases, &
                          error)
   end subroutine run_spectrum
end module spectrum_command
