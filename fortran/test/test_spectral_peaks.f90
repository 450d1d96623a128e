!> Peaks of a spectrum: where, how high, and what each is.
module test_spectral_peaks
   use errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use spectral_peaks, only: base_peak, find_peaks, harmonic_peak, is_periodic, label_peaks, &
                             line_share, other_peak, peak_type
   use spectrum, only: power_spectrum
   implicit none (type, external)
   private
   public :: collect_spectral_peaks

   !> Samples and time between them: a bin is 1/200.
   integer, parameter :: n = 4000
   real(wp), parameter :: interval = 0.05_wp, width = 1.0_wp/(n*interval)
   !> One turn.
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Base frequency, between two bins.
   real(wp), parameter :: f = 0.4017_wp
   !> What a peak must exceed, as in the default configuration.
   real(wp), parameter :: least_height = 1.0e-6_wp, least_prominence = 10.0_wp

contains

   !> All tests of this suite.
   subroutine collect_spectral_peaks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("frequency and height", test_interpolation), &
                   new_unittest("floor", test_floor), &
                   new_unittest("prominence", test_prominence), &
                   new_unittest("plateau and edges", test_plateau), &
                   new_unittest("harmonics and another line", test_labels), &
                   new_unittest("a harmonic above the base", test_high_harmonic), &
                   new_unittest("low lines that are no base", test_low_lines), &
                   new_unittest("multiples within a bin", test_multiples), &
                   new_unittest("share of the lines", test_line_share), &
                   new_unittest("periodic or not", test_periodic), &
                   new_unittest("no peaks", test_no_peaks)]
   end subroutine collect_spectral_peaks

   !> Wherever a line lies between two bins, its frequency is found to 0.05 of a bin and its height,
   !> A^2/2 times 2/3 of the length, to 8 in a hundred (a parabola through the logarithms of a Hann
   !> window's lobe at -3/2, -1/2 and 1/2 overshoots by 7.7).
   subroutine test_interpolation(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: amplitude = 0.7_wp
      real(wp), allocatable :: frequency(:), power(:)
      type(peak_type), allocatable :: peaks(:)
      real(wp) :: known
      integer :: i

      do i = 0, 20
         known = (80.0_wp + 0.05_wp*i)*width
         call analyse(error, [amplitude], [known], 0.0_wp, frequency, power, peaks)
         call expect(error, size(peaks) == 1, "one peak for one line, but "//text(size(peaks)))
         if (allocated(error)) return
         call expect_close(error, (peaks(1)%frequency - known)/width, 0.0_wp, 0.05_wp, &
                           "misfit of the frequency in bins")
         call expect_close(error, peaks(1)%power/(amplitude**2/3.0_wp*n*interval), 1.0_wp, &
                           0.08_wp, "height over the known one")
         call expect_close(error, frequency(peaks(1)%bin)/width, known/width, 0.5001_wp, "bin")
      end do
   end subroutine test_interpolation

   !> Peaks below the floor are left out.
   subroutine test_floor(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: power(11) = [0.0_wp, 0.0_wp, 1.0_wp, 100.0_wp, 1.0_wp, 2.0e-3_wp, &
                                          0.5_wp, 2.0e-3_wp, 0.0_wp, 7.0_wp, 0.0_wp]

      call expect_bins(error, power, 1.0e-3_wp, 10.0_wp, [4, 7, 10])
      call expect_bins(error, power, 1.0e-2_wp, 10.0_wp, [4, 10])
      call expect_bins(error, power, 0.5_wp, 10.0_wp, [4])
   end subroutine test_floor

   !> A shoulder of 45 beside a peak of 100, behind a valley of 40, is a peak at a prominence of 1.1
   !> but not of 1.2; what lies beyond higher ground does not count.
   subroutine test_prominence(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: power(14) = [0.0_wp, 0.1_wp, 1.0_wp, 10.0_wp, 100.0_wp, 50.0_wp, &
                                          40.0_wp, 45.0_wp, 10.0_wp, 30.0_wp, 1.0_wp, 0.1_wp, &
                                          0.01_wp, 0.001_wp]

      call expect_bins(error, power, 1.0e-6_wp, 1.1_wp, [5, 8, 10])
      call expect_bins(error, power, 1.0e-6_wp, 1.2_wp, [5, 10])
      call expect_bins(error, power, 1.0e-6_wp, 3.5_wp, [5])
      ! the shoulder on the other side
      call expect_bins(error, [0.0_wp, power(14:2:-1)], 1.0e-6_wp, 1.2_wp, [6, 11])
   end subroutine test_prominence

   !> A plateau is one peak, a slope to either end none; zero frequency and the bin beside it, where
   !> the mean was, do not count.
   subroutine test_plateau(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_bins(error, [9.0_wp, 1.0_wp, 2.0_wp, 7.0_wp, 7.0_wp, 2.0_wp, 0.1_wp, 3.0_wp], &
                       1.0e-6_wp, 2.0_wp, [4])
      call expect_bins(error, [0.0_wp, 5.0_wp, 1.0_wp, 9.0_wp, 1.0_wp, 0.5_wp], 1.0e-6_wp, 1.0_wp, &
                       [4])
      call expect_bins(error, [9.0_wp, 8.0_wp, 3.0_wp, 2.0_wp, 1.0_wp, 0.5_wp], 1.0e-6_wp, 2.0_wp, &
                       [integer ::])
   end subroutine test_plateau

   !> f, 2 f, 3 f and sqrt 2 f, the last between base and second harmonic.
   subroutine test_labels(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, [1.0_wp, 0.2_wp, 0.1_wp, 0.05_wp], f*[1.0_wp, sqrt(2.0_wp), 2.0_wp, &
                                                                3.0_wp], 0.0_wp, frequency, power, &
                   peaks)
      call expect_labels(error, peaks, [base_peak, other_peak, harmonic_peak, harmonic_peak], &
                         [1, 0, 2, 3])
      if (allocated(error)) return
      call expect_close(error, peaks%frequency/f, [1.0_wp, sqrt(2.0_wp), 2.0_wp, 3.0_wp], &
                        0.05_wp*width/f, "frequency over f")
   end subroutine test_labels

   !> The base is recognised although its second harmonic is the highest peak.
   subroutine test_high_harmonic(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, [0.1_wp, 1.0_wp, 0.1_wp, 0.3_wp], f*[1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], &
                   0.0_wp, frequency, power, peaks)
      call expect_labels(error, peaks, [base_peak, harmonic_peak, harmonic_peak, harmonic_peak], &
                         [1, 2, 3, 4])
   end subroutine test_high_harmonic

   !> Lower lines of which the highest is no multiple are not the base.
   subroutine test_low_lines(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, [0.1_wp, 0.1_wp, 1.0_wp, 0.1_wp], f*[0.55_wp, 0.7_wp, 1.0_wp, 2.0_wp], &
                   0.0_wp, frequency, power, peaks)
      call expect_labels(error, peaks, [other_peak, other_peak, base_peak, harmonic_peak], &
                         [0, 0, 1, 2])
   end subroutine test_low_lines

   !> A peak three bins off a multiple is none, one half a bin off is one.
   subroutine test_multiples(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(4)

      peaks%frequency = [0.5_wp, 1.03_wp, 1.505_wp, 1.97_wp]
      peaks%power = [9.0_wp, 3.0_wp, 2.0_wp, 1.0_wp]
      call label_peaks(peaks, 0.01_wp)
      call expect_labels(error, peaks, [base_peak, other_peak, harmonic_peak, other_peak], &
                         [1, 0, 3, 0])
   end subroutine test_multiples

   !> By hand: 9 bins around a line in bin 20 and 9 around one in bin 40, of 1 each but for the
   !> lines and another, which does not count.
   subroutine test_line_share(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(3)
      real(wp) :: power(100)

      power = 1.0_wp
      power([20, 40, 70]) = [83.0_wp, 13.0_wp, 8.0_wp]
      peaks%bin = [20, 40, 70]
      peaks%kind = [base_peak, harmonic_peak, other_peak]
      call expect_close(error, line_share(power, peaks), 112.0_wp/201, 1.0e-15_wp, "share")
      call expect_close(error, line_share(power, peaks(:1)), 91.0_wp/201, 1.0e-15_wp, &
                        "share of the base")
   end subroutine test_line_share

   !> Base and harmonics make a periodic signal; another line or noise does not.
   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(peak_type), allocatable :: in_noise(:), peaks(:)

      call analyse(error, [1.0_wp, 0.3_wp, 0.1_wp], f*[1.0_wp, 2.0_wp, 0.5_wp + sqrt(3.0_wp)], &
                   0.0_wp, frequency, power, peaks)
      call expect(error, .not. is_periodic(peaks, 1.0_wp), "with another line they are not")
      call analyse(error, [1.0_wp, 0.3_wp, 0.1_wp], f*[1.0_wp, 2.0_wp, 3.0_wp], 0.0_wp, frequency, &
                   power, peaks)
      call expect(error, is_periodic(peaks, line_share(power, peaks)), "f, 2 f, 3 f are periodic")
      call expect_between(error, line_share(power, peaks), 0.999_wp, 1.0_wp, "share of the lines")
      call analyse(error, [1.0_wp, 0.3_wp, 0.1_wp], f*[1.0_wp, 2.0_wp, 3.0_wp], 1.0_wp, frequency, &
                   power, in_noise)
      ! 0.55 of the power in the lines, 1/3 in the noise, of which 27 bins of 2001 count
      call expect_close(error, line_share(power, peaks), &
                        (0.55_wp + 9.0_wp/2001)/(0.55_wp + 1.0_wp/3), 0.02_wp, &
                        "share of the lines in noise")
      call expect(error, .not. is_periodic(peaks, line_share(power, peaks)), &
                  "nor are they with noise")
   end subroutine test_periodic

   !> Where there is no peak there is no period, and nothing to label.
   subroutine test_no_peaks(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type), allocatable :: peaks(:)

      allocate (peaks(0))
      call label_peaks(peaks, 0.01_wp)
      call expect(error, .not. is_periodic(peaks, 1.0_wp), "nothing is not periodic")
   end subroutine test_no_peaks

   !> Labelled peaks of a sum of sines and noise.
   subroutine analyse(error, amplitudes, lines, noise, frequency, power, peaks)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Amplitudes
      real(wp), intent(in) :: amplitudes(:)
      !> Frequencies
      real(wp), intent(in) :: lines(:)
      !> Greatest value of the noise
      real(wp), intent(in) :: noise
      !> Frequencies of the spectrum
      real(wp), allocatable, intent(out) :: frequency(:)
      !> The spectrum
      real(wp), allocatable, intent(out) :: power(:)
      !> Its peaks
      type(peak_type), allocatable, intent(out) :: peaks(:)
      type(failure_type), allocatable :: failure
      real(wp) :: signal(n)
      integer :: i

      signal = [(sum(amplitudes*cos(turn*lines*i*interval + amplitudes)), i=1, n)] &
               + uniform(7, n, -noise, noise)
      call power_spectrum(signal, interval, "hann", 1, 0.0_wp, frequency, power, failure)
      call expect_success(error, failure)
      peaks = find_peaks(frequency, power, least_height, least_prominence)
      call label_peaks(peaks, width)
   end subroutine analyse

   !> The peaks of a spectrum are in these bins.
   subroutine expect_bins(error, power, floor, prominence, bins)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Spectrum
      real(wp), intent(in) :: power(:)
      !> Least height over the highest peak's
      real(wp), intent(in) :: floor
      !> Least height over the higher of the two valleys
      real(wp), intent(in) :: prominence
      !> Bins known
      integer, intent(in) :: bins(:)
      type(peak_type), allocatable :: peaks(:)
      integer :: i

      allocate (peaks, source=find_peaks([(real(i, wp), i=1, size(power))], power, floor, &
                                         prominence))
      call expect_close(error, real(peaks%bin, wp), real(bins, wp), 0.0_wp, "bins of peaks")
   end subroutine expect_bins

   !> Peaks have these labels.
   subroutine expect_labels(error, peaks, kinds, multiples)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Peaks
      type(peak_type), intent(in) :: peaks(:)
      !> Kinds known
      integer, intent(in) :: kinds(:)
      !> Multiples known
      integer, intent(in) :: multiples(:)

      call expect_close(error, real(peaks%kind, wp), real(kinds, wp), 0.0_wp, "kinds of peaks")
      call expect_close(error, real(peaks%multiple, wp), real(multiples, wp), 0.0_wp, "multiples")
   end subroutine expect_labels
end module test_spectral_peaks
