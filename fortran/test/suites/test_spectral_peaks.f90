!> Peaks of a spectrum: where, how high, and above what.
module test_spectral_peaks
   use base_frequencies, only: bases_type
   use dde_errors, only: text
   use expectations, only: expect, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use spectral_peaks, only: find_peaks, peak_type
   use synthetic_spectra, only: analyse, f, interval, length, width
   implicit none (type, external)
   private
   public :: collect_spectral_peaks

contains

   !> All tests of this suite.
   subroutine collect_spectral_peaks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("frequency and height", test_interpolation), &
                   new_unittest("background", test_background), &
                   new_unittest("floor", test_floor), &
                   new_unittest("prominence", test_prominence), &
                   new_unittest("plateau and edges", test_plateau)]
   end subroutine collect_spectral_peaks

   !> Wherever a line lies between two bins, its frequency is found to 1e-5 of a bin and its height,
   !> A^2/2 times 2/3 of the length, to 1e-5 (the line at minus the frequency is what is left).
   subroutine test_interpolation(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: amplitude = 0.7_wp
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)
      real(wp) :: known
      integer :: i

      do i = 0, 20
         known = (80.0_wp + 0.05_wp*i)*width
         call analyse(error, [amplitude], [known], 0.0_wp, 1, frequency, power, peaks, &
                      bases)
         call expect(error, size(peaks) == 1, "one peak for one line, but "//text(size(peaks)))
         if (allocated(error)) return
         call expect_close(error, (peaks(1)%frequency - known)/width, 0.0_wp, 1.0e-5_wp, &
                           "misfit of the frequency in bins")
         call expect_close(error, peaks(1)%power/(amplitude**2/3.0_wp*length*interval), 1.0_wp, &
                           1.0e-5_wp, "height over the known one")
         call expect_close(error, frequency(peaks(1)%bin)/width, known/width, 0.5001_wp, "bin")
      end do
   end subroutine test_interpolation

   !> The lowest of bins 3 to 8 away, on the side where that is higher.
   subroutine test_background(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)
      real(wp) :: by_hand(25)
      integer :: i

      by_hand = [(0.01_wp + abs(i - 12)*1.0e-6_wp, i=1, 25)]
      by_hand(12) = 100.0_wp
      by_hand([3, 10, 21]) = 1.0e-9_wp
      by_hand(4:9) = by_hand(4:9)*2.0_wp
      by_hand(6) = 0.015_wp
      peaks = find_peaks([(real(i, wp), i=1, 25)], by_hand, 1.0e-2_wp, 10.0_wp)
      call expect(error, size(peaks) == 1, "one peak by hand")
      if (allocated(error)) return
      call expect_close(error, peaks(1)%background, 0.015_wp/peaks(1)%power, 1.0e-12_wp, &
                        "background by hand")
      ! density of the noise: variance 1/3 over 10 cycles per unit of time
      call analyse(error, [3.0_wp], [f], 1.0_wp, 15, frequency, power, peaks, bases)
      i = maxloc(peaks%power, dim=1)
      call expect_close(error, peaks(i)%background*peaks(i)%power/(1.0_wp/30.0_wp), 0.6_wp, &
                        0.3_wp, "background in noise over the noise")
   end subroutine test_background

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
end module test_spectral_peaks
