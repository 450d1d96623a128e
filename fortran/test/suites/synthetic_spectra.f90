!> Spectra of sums of sines and noise.
module synthetic_spectra
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type
   use pseudo_random, only: uniform
   use spectral_peaks, only: find_peaks, peak_type
   use spectrum, only: power_spectrum
   implicit none (type, external)
   private
   public :: analyse, f, interval, least_height, least_prominence, length, width

   !> Samples in a segment and time between them: a bin is 1/200.
   integer, parameter :: length = 4000
   real(wp), parameter :: interval = 0.05_wp, width = 1.0_wp/(length*interval)
   !> One turn.
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Fundamental frequency, between two bins.
   real(wp), parameter :: f = 0.4017_wp
   !> What a peak must exceed, as in the default configuration.
   real(wp), parameter :: least_height = 1.0e-6_wp, least_prominence = 10.0_wp

contains

   !> Labelled peaks of a sum of sines and noise, over segments that overlap by half.
   subroutine analyse(error, amplitudes, lines, noise, segments, frequency, power, peaks, bases)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Amplitudes
      real(wp), intent(in) :: amplitudes(:)
      !> Frequencies
      real(wp), intent(in) :: lines(:)
      !> Greatest value of the noise
      real(wp), intent(in) :: noise
      !> Number of segments
      integer, intent(in) :: segments
      !> Frequencies of the spectrum
      real(wp), allocatable, intent(out) :: frequency(:)
      !> The spectrum
      real(wp), allocatable, intent(out) :: power(:)
      !> Its peaks
      type(peak_type), allocatable, intent(out) :: peaks(:)
      !> Their bases
      type(bases_type), intent(out) :: bases
      type(failure_type), allocatable :: failure
      real(wp), allocatable :: signal(:)
      integer :: i, n

      n = length*(segments + 1)/2
      signal = [(sum(amplitudes*cos(turn*lines*i*interval + amplitudes)), i=1, n)] &
               + uniform(7, n, -noise, noise)
      call power_spectrum(signal, interval, "hann", segments, 0.5_wp, frequency, power, failure)
      call expect_success(error, failure)
      peaks = find_peaks(frequency, power, least_height, least_prominence)
      call label_peaks(peaks, width, bases)
   end subroutine analyse
end module synthetic_spectra
