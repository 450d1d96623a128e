! SPDX-License-Identifier: BSD-3-Clause
!> Power spectral densities in threads and of few samples (tests/test_spectrum.py has their values);
!> lines of sums of sines and noise: where the peaks are, how high, and above what; their labels by
!> fundamental frequencies; and whether a spectrum is one of lines or of a continuum.
module test_spectrum
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use omp_lib, only: omp_get_num_threads
   use pseudo_random, only: uniform
   use spectral_density, only: power_spectrum
   use spectral_peaks, only: base_peak, combination_peak, find_peaks, harmonic_peak, other_peak, &
                             peak_type, second_base_peak
   use spectrum_verdict, only: continuum_share, line_share, spectrum_kind, spectrum_kind_name
   implicit none (type, external)
   private
   public :: collect_spectrum

   !> Samples in a segment and time between them: a bin is 1/200.
   integer, parameter :: length = 4000
   real(wp), parameter :: interval = 0.05_wp, width = 1.0_wp/(length*interval)
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Fundamental frequency, between two bins.
   real(wp), parameter :: f = 0.4017_wp
   !> Ratios to the base that are far from simple fractions: the golden mean's inverse and 2**(1/3).
   real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp), cubic = 2.0_wp**(1.0_wp/3)
   !> The lines of a torus over f.
   real(wp), parameter :: torus(5) = [1.0_wp, golden, 2.0_wp, 1.0_wp + golden, 1.0_wp - golden]

   !> A spectrum with its labelled peaks and their bases.
   type :: analysed_type
      real(wp), allocatable :: frequency(:), power(:)
      type(peak_type), allocatable :: peaks(:)
      type(bases_type) :: bases
   end type analysed_type

contains

   subroutine collect_spectrum(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("in threads, and of few samples", test_threads), &
                   new_unittest("frequency and height of a peak", test_interpolation), &
                   new_unittest("background of a peak", test_background), &
                   new_unittest("peaks by hand", test_peaks), &
                   new_unittest("labels of peaks", test_labels), &
                   new_unittest("fractions and multiples", test_accuracy), &
                   new_unittest("random frequencies", test_random), &
                   new_unittest("share of the lines", test_shares), &
                   new_unittest("kinds of spectra", test_kinds)]
   end subroutine collect_spectrum

   !> Spectra of all lengths made in four threads are those made one after the other. Segments of
   !> fewer than 16 samples are refused with their number.
   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      integer, parameter :: shortest = 100, longest = 1200
      real(wp), allocatable :: frequency(:), power(:)
      real(wp) :: alone(shortest:longest), signal(longest), together(shortest:longest)
      integer :: i, threads

      signal = uniform(5, longest, -1.0_wp, 1.0_wp)
      do i = shortest, longest
         alone(i) = highest(i)
      end do
      threads = 0
      !$omp parallel do num_threads(4) schedule(dynamic, 1) reduction(max: threads)
      do i = shortest, longest
         threads = omp_get_num_threads()
         together(i) = highest(i)
      end do
      !$omp end parallel do
      call expect(error, threads > 1, "more than one thread")
      call expect_close(error, together, alone, 0.0_wp, "highest power")
      call power_spectrum(signal(:32), 0.05_wp, "hann", 3, 0.5_wp, frequency, power, failure)
      call expect_success(error, failure)
      call power_spectrum(signal(:31), 0.05_wp, "hann", 3, 0.5_wp, frequency, power, failure)
      call expect_failure(error, failure, "31 samples make 3 segments of 15; at least 16 expected")

   contains

      !> The highest power in the spectrum of the first samples.
      real(wp) function highest(samples) result(value)
         integer, intent(in) :: samples
         type(failure_type), allocatable :: none
         real(wp), allocatable :: at(:), found(:)

         call power_spectrum(signal(:samples), 0.05_wp, "hann", 3, 0.5_wp, at, found, none)
         value = maxval(found)
      end function highest
   end subroutine test_threads

   !> Labelled peaks of a sum of sines and noise, over segments that overlap by half. A peak must
   !> exceed what the default configuration asks for.
   subroutine analyse(error, amplitudes, lines, noise, segments, found)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: amplitudes(:), lines(:), noise
      integer, intent(in) :: segments
      type(analysed_type), intent(out) :: found
      type(failure_type), allocatable :: failure
      real(wp), allocatable :: signal(:)
      integer :: i, n

      n = length*(segments + 1)/2
      signal = [(sum(amplitudes*cos(turn*lines*i*interval + amplitudes)), i=1, n)] &
               + uniform(7, n, -noise, noise)
      call power_spectrum(signal, interval, "hann", segments, 0.5_wp, found%frequency, &
                          found%power, failure)
      call expect_success(error, failure)
      found%peaks = find_peaks(found%frequency, found%power, 1.0e-6_wp, 10.0_wp)
      call label_peaks(found%peaks, width, found%bases)
   end subroutine analyse

   !> Wherever a line lies between two bins, its frequency is found to 1e-5 of a bin and its height,
   !> A^2/2 times 2/3 of the length, to 1e-5 (the line at minus the frequency is what is left).
   subroutine test_interpolation(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: amplitude = 0.7_wp
      type(analysed_type) :: found
      real(wp) :: known
      integer :: i

      do i = 0, 20
         known = (80.0_wp + 0.05_wp*i)*width
         call analyse(error, [amplitude], [known], 0.0_wp, 1, found)
         call expect_close(error, (found%peaks%frequency - known)/width, [0.0_wp], 1.0e-5_wp, &
                           "misfit of the frequency in bins")
         call expect_close(error, found%peaks%power/(amplitude**2/3.0_wp*length*interval), &
                           [1.0_wp], 1.0e-5_wp, "height over the known one")
         call expect_close(error, (found%frequency(found%peaks%bin) - known)/width, [0.0_wp], &
                           0.5001_wp, "bin")
      end do
   end subroutine test_interpolation

   !> The lowest of bins 3 to 8 away, on the side where that is higher.
   subroutine test_background(error)
      type(error_type), allocatable, intent(out) :: error
      type(analysed_type) :: found
      real(wp) :: by_hand(25)
      integer :: i

      by_hand = [(0.01_wp + abs(i - 12)*1.0e-6_wp, i=1, 25)]
      by_hand(12) = 100.0_wp
      by_hand([3, 10, 21]) = 1.0e-9_wp
      by_hand(4:9) = by_hand(4:9)*2.0_wp
      by_hand(6) = 0.015_wp
      found%peaks = find_peaks([(real(i, wp), i=1, 25)], by_hand, 1.0e-2_wp, 10.0_wp)
      call expect_close(error, found%peaks%background*found%peaks%power, [0.015_wp], 1.0e-10_wp, &
                        "background by hand")
      ! density of the noise: variance 1/3 over 10 cycles per unit of time
      call analyse(error, [3.0_wp], [f], 1.0_wp, 15, found)
      i = maxloc(found%peaks%power, dim=1)
      call expect_close(error, found%peaks(i)%background*found%peaks(i)%power/(1.0_wp/30.0_wp), &
                        0.6_wp, 0.3_wp, "background in noise over the noise")
   end subroutine test_background

   !> Peaks below the floor are left out. A shoulder of 45 beside a peak of 100, behind a valley of
   !> 40, is a peak at a prominence of 1.1 but not of 1.2; what lies beyond higher ground does not
   !> count. A plateau is one peak, a slope to either end none. Zero frequency and the bin beside it
   !> do not count.
   subroutine test_peaks(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: apart(11) = 1.0e-3_wp*[0, 0, 1000, 100000, 1000, 2, 500, 2, 0, 7000, 0]
      real(wp), parameter :: shoulder(14) = 1.0e-3_wp*[0, 100, 1000, 10000, 100000, 50000, 40000, &
                                                       45000, 10000, 30000, 1000, 100, 10, 1]

      call expect_bins(error, apart, 1.0e-3_wp, 10.0_wp, [4, 7, 10])
      call expect_bins(error, apart, 1.0e-2_wp, 10.0_wp, [4, 10])
      call expect_bins(error, shoulder, 1.0e-6_wp, 1.1_wp, [5, 8, 10])
      call expect_bins(error, shoulder, 1.0e-6_wp, 1.2_wp, [5, 10])
      ! the shoulder on the other side
      call expect_bins(error, [0.0_wp, shoulder(14:2:-1)], 1.0e-6_wp, 1.2_wp, [6, 11])
      call expect_bins(error, real([90, 10, 20, 70, 70, 20, 1, 30], wp), 1.0e-6_wp, 2.0_wp, [4])
      call expect_bins(error, real([0, 50, 10, 90, 10, 5], wp), 1.0e-6_wp, 1.0_wp, [4])
      call expect_bins(error, real([90, 80, 30, 20, 10, 5], wp), 1.0e-6_wp, 2.0_wp, [integer ::])
   end subroutine test_peaks

   !> The peaks of a spectrum are in these bins.
   subroutine expect_bins(error, power, floor, prominence, bins)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: power(:)
      !> Least height over the highest peak's, and over the higher of the two valleys
      real(wp), intent(in) :: floor, prominence
      integer, intent(in) :: bins(:)
      type(peak_type), allocatable :: peaks(:)
      integer :: i

      allocate (peaks, source=find_peaks([(real(i, wp), i=1, size(power))], power, floor, &
                                         prominence))
      call expect_close(error, real(peaks%bin, wp), real(bins, wp), 0.0_wp, "bins of peaks")
   end subroutine expect_bins

   !> f, 2 f, 3 f; f although 2 f is the highest peak; f although it is no peak. A period doubled
   !> twice has a quarter of the highest peak's frequency as base, whichever of the others is the
   !> highest. On a torus the second base is strong or weak, combinations have either sign. Of
   !> f + 2 s, f + s and f + 3 s: with f + 2 s, the higher, as second base f + s would be nothing. A
   !> third frequency is no combination of the two higher ones.
   subroutine test_labels(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: others(5) = [0.5_wp, 0.1_wp, 0.03_wp, 0.2_wp, 0.01_wp]
      real(wp), parameter :: s = 0.25_wp*golden
      integer, parameter :: none(6) = 0
      real(wp) :: turned(5), weak
      integer :: i

      call check([1.0_wp, 0.1_wp, 0.05_wp], [1.0_wp, 2.0_wp, 3.0_wp], [1, 2, 3], none(:3), &
                 [1.0_wp, 0.0_wp])
      call check([0.1_wp, 1.0_wp, 0.1_wp, 0.3_wp], [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], &
                 [1, 2, 3, 4], none(:4), [1.0_wp, 0.0_wp])
      call check([1.0_wp, 0.5_wp], [2.0_wp, 3.0_wp], [2, 3], none(:2), [1.0_wp, 0.0_wp])
      do i = 0, 4
         turned = cshift(others, i)
         call check([turned(:3), 1.0_wp, turned(4:)], 0.25_wp*[1, 2, 3, 4, 5, 6], &
                    [1, 2, 3, 4, 5, 6], none, [0.25_wp, 0.0_wp])
      end do
      do i = 0, 2
         weak = 0.1_wp**i
         call check([0.1_wp, 0.5_wp, 1.0_wp, 0.1_wp, 0.2_wp]*[weak, weak, 1.0_wp, weak, 1.0_wp], &
                    [1.0_wp - golden, golden, 1.0_wp, 1.0_wp + golden, 2.0_wp], &
                    [1, 0, 1, 1, 2], [-1, 1, 0, 1, 0], [1.0_wp, golden])
      end do
      call check([1.0_wp, 0.2_wp, 0.3_wp, 0.1_wp], &
                 [1.0_wp, 1.0_wp + s, 1.0_wp + 2*s, 1.0_wp + 3*s], [1, 0, -1, -2], [0, 1, 2, 3], &
                 [1.0_wp, 1.0_wp + s])
      call check([0.5_wp, 1.0_wp, 0.2_wp, 0.1_wp], [golden, 1.0_wp, cubic, 1.0_wp + golden], &
                 [0, 1, 0, 1], [1, 0, 0, 1], [1.0_wp, golden])

   contains

      !> Lines at multiples of f are these multiples of these bases; none of them is another line.
      subroutine check(amplitudes, lines, first, second, known)
         real(wp), intent(in) :: amplitudes(:), lines(:), known(2)
         integer, intent(in) :: first(:), second(:)
         type(analysed_type) :: found
         integer :: kinds(size(first))

         kinds = merge(harmonic_peak, combination_peak, second == 0)
         where (first == 1 .and. second == 0) kinds = base_peak
         where (first == 0) kinds = merge(second_base_peak, other_peak, second == 1)
         call analyse(error, amplitudes, f*lines, 0.0_wp, 1, found)
         if (allocated(error)) return
         call expect_close(error, real([found%peaks%kind, found%peaks%multiple(1), &
                                        found%peaks%multiple(2)], wp), &
                           real([kinds, first, second], wp), 0.0_wp, "kinds and multiples")
         call expect_close(error, found%bases%frequency/f, known, 0.005_wp*width/f, "bases over f")
      end subroutine check
   end subroutine test_labels

   !> 13/23 might be chance: it is a second base that is not told apart. 0.05 of a bin off 3 f is no
   !> multiple unless the background makes it uncertain.
   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      type(analysed_type) :: found
      type(peak_type) :: peaks(2)
      type(bases_type) :: bases

      call analyse(error, [0.5_wp, 1.0_wp], f*[13.0_wp/23, 1.0_wp], 0.0_wp, 1, found)
      call expect_close(error, found%bases%frequency, f*[1.0_wp, 13.0_wp/23], 0.005_wp*width, &
                        "bases of 13/23")
      call expect(error, all(found%bases%ratio == [13, 23]), "ratio "//text(found%bases%ratio(1)) &
                  //"/"//text(found%bases%ratio(2)))
      peaks%frequency = [0.5_wp, 1.5005_wp]
      peaks%power = [9.0_wp, 1.0_wp]
      call label_peaks(peaks, 0.01_wp, bases)
      call expect(error, peaks(2)%kind == second_base_peak, "0.05 of a bin off 3 f is no multiple")
      peaks(2)%background = 0.0025_wp
      call label_peaks(peaks, 0.01_wp, bases)
      call expect(error, peaks(2)%kind == harmonic_peak .and. peaks(2)%multiple(1) == 3, &
                  "with a twentieth of its amplitude beside it, it is")
   end subroutine test_accuracy

   !> Of pairs of frequencies drawn at random beside a base, as few as stated have a common base
   !> with it or leave that open, and few explain each other.
   subroutine test_random(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: trials = 2000
      type(peak_type) :: peaks(4)
      type(bases_type) :: bases
      real(wp) :: drawn(2*trials)
      integer :: shared, explained, i, open

      shared = 0
      open = 0
      explained = 0
      drawn = uniform(3, 2*trials, 0.1_wp, 3.0_wp)
      do i = 1, trials
         peaks%frequency = [1.0_wp, drawn(2*i - 1), drawn(2*i), 3.0_wp]
         peaks%power = [9.0_wp, 5.0_wp, 1.0_wp, 0.1_wp]
         call label_peaks(peaks, 0.01_wp, bases)
         if (peaks(2)%multiple(2) == 0) then
            shared = shared + 1
         else if (.not. any(peaks%kind == other_peak)) then
            explained = explained + 1
         end if
         if (.not. bases%told_apart) open = open + 1
      end do
      ! 2 % and 10 %, and what lies within a bin of a multiple
      call expect_between(error, 100.0_wp*shared/trials, 0.5_wp, 3.0_wp, "% with a common base")
      call expect_between(error, 100.0_wp*open/trials, 5.0_wp, 13.0_wp, "% left open")
      ! 3 %
      call expect_between(error, 100.0_wp*explained/trials, 1.0_wp, 5.0_wp, "% explained")
   end subroutine test_random

   !> By hand: a line in bin 20 that holds 3/2 of its height, one in bin 40 that finds less than
   !> that in its 9 bins, two at 70 and 75 that share 14 bins, and 1 in every other bin. Lines with
   !> 0.55 of the power in noise of 1/3.
   subroutine test_shares(error)
      type(error_type), allocatable, intent(out) :: error
      type(analysed_type) :: found
      type(peak_type) :: peaks(4)
      real(wp) :: power(100)

      power = 1.0_wp
      power(16:24) = [1.0_wp, 1.0_wp, 1.0_wp, 20.0_wp, 80.0_wp, 20.0_wp, 1.0_wp, 1.0_wp, 1.0_wp]
      power([40, 70, 75]) = [64.0_wp, 40.0_wp, 18.0_wp]
      peaks%bin = [20, 40, 70, 75]
      peaks%power = [80.0_wp, 64.0_wp, 40.0_wp, 20.0_wp]
      peaks%kind = [base_peak, harmonic_peak, other_peak, harmonic_peak]
      ! 120 of 126; 72 of 72; 70 of 90 wanted, a third of it to the labelled one
      call expect_close(error, sum(power), 336.0_wp, 0.0_wp, "all")
      call expect_close(error, line_share(power, peaks), (120.0_wp + 72.0_wp + 70.0_wp/3)/336, &
                        1.0e-15_wp, "share of the lines")
      call expect_close(error, continuum_share(power, peaks), &
                        1.0_wp - (120.0_wp + 72.0_wp + 70.0_wp)/336, 1.0e-15_wp, &
                        "share outside the lines")
      call analyse(error, [1.0_wp, 0.3_wp, 0.1_wp], f*[1.0_wp, 2.0_wp, 3.0_wp], 1.0_wp, 8, found)
      call expect_close(error, [line_share(found%power, found%peaks), &
                                continuum_share(found%power, found%peaks)], &
                        [0.55_wp, 1.0_wp/3]/(0.55_wp + 1.0_wp/3), 0.03_wp, "shares in noise")
   end subroutine test_shares

   !> Periodic: harmonics, also of a doubled period; a second base of 2e-6 of the power does not
   !> count, one of ten times that does. Quasiperiodic: a torus, its second base strong, weak or the
   !> highest; 0.05 of a bin off 3/4 f; a third base of 2e-5 of the power does
   !> not count. Undecided: three frequencies; half a bin off 2 f and 13/23 f. A continuum: noise,
   !> alone and with lines that hold less than 98 %, and peaks that fall to a half within five bins.
   !> Noise of 2.5e-4 of the power changes nothing. Without power there is no spectrum.
   subroutine test_kinds(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(3)
      type(bases_type) :: bases
      real(wp) :: power(400)
      real(wp), parameter :: three(3) = [1.0_wp, golden, cubic]
      real(wp), parameter :: harmonics(3) = [1.0_wp, 2.0_wp, 3.0_wp]
      integer :: i

      call check("periodic", [1.0_wp, 0.7_wp], [1.0_wp, 0.75_wp], 0.0_wp)
      call check("periodic", [1.0_wp, 0.0014_wp], three(:2), 0.0_wp)
      call check("periodic", [1.0_wp, 0.3_wp, 0.1_wp], harmonics, 0.02_wp)
      call check("quasiperiodic", [1.0_wp, 0.0045_wp], three(:2), 0.0_wp)
      call check("quasiperiodic", [1.0_wp, 0.02_wp, 0.3_wp, 0.01_wp, 0.01_wp], torus, 0.0_wp)
      call check("quasiperiodic", [1.0_wp, 0.2_wp, 0.2_wp], &
                 [1.0_wp, 1.0_wp + 0.1_wp*golden, 1.0_wp - 0.1_wp*golden], 0.0_wp)
      call check("quasiperiodic", [1.0_wp, 0.5_wp], [1.0_wp, 0.75_wp + 0.05_wp*width/f], 0.0_wp)
      call check("quasiperiodic", [1.0_wp, 0.5_wp, 0.005_wp], three, 0.0_wp)
      call check("quasiperiodic", [1.0_wp, 0.5_wp, 0.3_wp, 0.1_wp, 0.1_wp], torus, 0.02_wp)
      call check("undecided", [1.0_wp, 0.5_wp, 0.016_wp], three, 0.0_wp)
      call check("undecided", [1.0_wp, 0.5_wp], [1.0_wp, 2.0_wp + 0.5_wp*width/f], 0.0_wp)
      call check("undecided", [1.0_wp, 0.5_wp], [1.0_wp, 13.0_wp/23], 0.0_wp)
      call check("undecided", [1.0_wp, 0.3_wp], harmonics(:2), 0.15_wp)
      call check("continuum", [1.0_wp, 0.3_wp], harmonics(:2), 0.25_wp)
      call check("continuum", [0.0_wp], [1.0_wp], 1.0_wp)
      power = [(sum(1.0_wp/(1.0_wp + ((i - [100, 200, 300])/5.0_wp)**2)), i=1, 400)]
      peaks%bin = [100, 200, 300]
      peaks%power = power(peaks%bin)
      peaks%kind = [base_peak, harmonic_peak, harmonic_peak]
      call expect_kind(power, peaks, bases, "continuum", "broad peaks")
      call expect_kind(power, peaks(:0), bases, "continuum", "no peaks")
      power = 0.0_wp
      call expect_kind(power, peaks(:0), bases, "none", "no power")
      call expect_close(error, continuum_share(power, peaks(:0)), 0.0_wp, 0.0_wp, "no share")

   contains

      !> Sines at multiples of f, and noise up to a value, make a spectrum of this kind.
      subroutine check(known, amplitudes, lines, noise)
         character(len=*), intent(in) :: known
         real(wp), intent(in) :: amplitudes(:), lines(:), noise
         type(analysed_type) :: found

         call analyse(error, amplitudes, f*lines, noise, 8, found)
         call expect_kind(found%power, found%peaks, found%bases, known, "a line at " &
                          //text(lines(size(lines)))//" f, noise "//text(noise))
      end subroutine check

      !> A spectrum is of this kind.
      subroutine expect_kind(power, peaks, bases, known, what)
         real(wp), intent(in) :: power(:)
         type(peak_type), intent(in) :: peaks(:)
         type(bases_type), intent(in) :: bases
         character(len=*), intent(in) :: known, what

         call expect(error, spectrum_kind_name(spectrum_kind(power, peaks, bases)) == known, &
                     what//": "//known)
      end subroutine expect_kind
   end subroutine test_kinds
end module test_spectrum
