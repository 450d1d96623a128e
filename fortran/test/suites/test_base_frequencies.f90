!> Labels of peaks: base, harmonic, second base, combination, or none of them.
module test_base_frequencies
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use spectral_peaks, only: base_peak, combination_peak, harmonic_peak, other_peak, peak_type, &
                             second_base_peak
   use synthetic_spectra, only: analyse, f, width
   implicit none (type, external)
   private
   public :: collect_base_frequencies

   !> Ratios to the base that are far from simple fractions: the golden mean's inverse and 2**(1/3).
   real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp), cubic = 2.0_wp**(1.0_wp/3)

contains

   !> All tests of this suite.
   subroutine collect_base_frequencies(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("harmonics", test_harmonics), &
                   new_unittest("a harmonic above the base", test_high_harmonic), &
                   new_unittest("doubled period", test_doubled), &
                   new_unittest("a base without a peak", test_missing_base), &
                   new_unittest("two bases", test_two_bases), &
                   new_unittest("a combination as second base", test_choice_of_bases), &
                   new_unittest("three bases", test_three_bases), &
                   new_unittest("simple fraction or not", test_fractions), &
                   new_unittest("too near to tell", test_too_near), &
                   new_unittest("accuracy of a multiple", test_accuracy), &
                   new_unittest("random frequencies", test_random), &
                   new_unittest("no peaks", test_no_peaks)]
   end subroutine collect_base_frequencies

   !> f, 2 f, 3 f.
   subroutine test_harmonics(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_labels(error, [1.0_wp, 0.1_wp, 0.05_wp], [1.0_wp, 2.0_wp, 3.0_wp], &
                         [base_peak, harmonic_peak, harmonic_peak], [1, 2, 3], [0, 0, 0], &
                         [1.0_wp, 0.0_wp])
   end subroutine test_harmonics

   !> The base is recognised although its second harmonic is the highest peak.
   subroutine test_high_harmonic(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_labels(error, [0.1_wp, 1.0_wp, 0.1_wp, 0.3_wp], &
                         [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], &
                         [base_peak, harmonic_peak, harmonic_peak, harmonic_peak], [1, 2, 3, 4], &
                         [0, 0, 0, 0], [1.0_wp, 0.0_wp])
   end subroutine test_high_harmonic

   !> A period doubled twice has a quarter of the highest peak's frequency as base, whichever of the
   !> others is the highest.
   subroutine test_doubled(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: others(5) = [0.5_wp, 0.1_wp, 0.03_wp, 0.2_wp, 0.01_wp]
      real(wp) :: turned(5)
      integer :: i

      do i = 0, 4
         turned = cshift(others, i)
         call expect_labels(error, [turned(:3), 1.0_wp, turned(4:)], [(0.25_wp*i, i=1, 6)], &
                            [base_peak, spread(harmonic_peak, 1, 5)], [1, 2, 3, 4, 5, 6], &
                            [0, 0, 0, 0, 0, 0], [0.25_wp, 0.0_wp])
      end do
   end subroutine test_doubled

   !> 2 f and 3 f have the base f, which is no peak.
   subroutine test_missing_base(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_labels(error, [1.0_wp, 0.5_wp], [2.0_wp, 3.0_wp], &
                         [harmonic_peak, harmonic_peak], [2, 3], [0, 0], [1.0_wp, 0.0_wp])
   end subroutine test_missing_base

   !> Lines of a torus; the second base strong or weak, combinations of either sign.
   subroutine test_two_bases(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: weak
      integer :: i

      do i = 0, 2
         weak = 0.1_wp**i
         call expect_labels(error, [0.1_wp, 0.5_wp, 1.0_wp, 0.1_wp, 0.2_wp]*[weak, weak, 1.0_wp, &
                                                                            weak, 1.0_wp], &
                            [1.0_wp - golden, golden, 1.0_wp, 1.0_wp + golden, 2.0_wp], &
                            [combination_peak, second_base_peak, base_peak, combination_peak, &
                             harmonic_peak], &
                            [1, 0, 1, 1, 2], [-1, 1, 0, 1, 0], [1.0_wp, golden])
      end do
   end subroutine test_two_bases

   !> f + 2 s, f + s and f + 3 s: with f + 2 s, the higher, as second base f + s would be nothing.
   subroutine test_choice_of_bases(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: s = 0.25_wp*golden

      call expect_labels(error, [1.0_wp, 0.2_wp, 0.3_wp, 0.1_wp], &
                         [1.0_wp, 1.0_wp + s, 1.0_wp + 2*s, 1.0_wp + 3*s], &
                         [base_peak, second_base_peak, combination_peak, combination_peak], &
                         [1, 0, -1, -2], [0, 1, 2, 3], [1.0_wp, 1.0_wp + s])
   end subroutine test_choice_of_bases

   !> A third frequency is no combination of the two higher ones.
   subroutine test_three_bases(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_labels(error, [0.5_wp, 1.0_wp, 0.2_wp, 0.1_wp], &
                         [golden, 1.0_wp, cubic, 1.0_wp + golden], &
                         [second_base_peak, base_peak, other_peak, combination_peak], &
                         [0, 1, 0, 1], [1, 0, 0, 1], [1.0_wp, golden])
   end subroutine test_three_bases

   !> 3/4 is a fraction; 0.05 of a bin beside it is none, and is told apart; 13/23 might be chance.
   subroutine test_fractions(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, [0.5_wp, 1.0_wp], f*[0.75_wp, 1.0_wp], 0.0_wp, 1, frequency, &
                   power, peaks, bases)
      call expect_close(error, bases%frequency, f*[0.25_wp, 0.0_wp], 0.005_wp*width, "bases of 3/4")
      call analyse(error, [0.5_wp, 1.0_wp], [0.75_wp*f + 0.05_wp*width, f], 0.0_wp, 1, frequency, &
                   power, peaks, bases)
      call expect_close(error, bases%frequency, [f, 0.75_wp*f + 0.05_wp*width], 0.005_wp*width, &
                        "bases beside 3/4")
      call expect(error, bases%told_apart, "told apart from 3/4")
      call analyse(error, [0.5_wp, 1.0_wp], f*[13.0_wp/23, 1.0_wp], 0.0_wp, 1, frequency, power, &
                   peaks, bases)
      call expect_close(error, bases%frequency, f*[1.0_wp, 13.0_wp/23], 0.005_wp*width, &
                        "bases of 13/23")
      call expect(error, .not. bases%told_apart, "not told apart from 13/23")
      call expect(error, all(bases%ratio == [13, 23]), "ratio "//text(bases%ratio(1))//"/" &
                  //text(bases%ratio(2)))
   end subroutine test_fractions

   !> A second line half a bin off 2 f is neither a harmonic nor seen to be none; two bins off it is
   !> a second base.
   subroutine test_too_near(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, [0.5_wp, 1.0_wp], [2*f + 0.5_wp*width, f], 0.0_wp, 1, frequency, power, &
                   peaks, bases)
      call expect(error, peaks(2)%kind == second_base_peak, "half a bin off is no harmonic")
      call expect(error, .not. bases%told_apart, "half a bin off is not told apart")
      call analyse(error, [0.5_wp, 1.0_wp], [2*f + 2.0_wp*width, f], 0.0_wp, 1, frequency, power, &
                   peaks, bases)
      call expect(error, peaks(2)%kind == second_base_peak .and. bases%told_apart, &
                  "two bins off is a second base")
   end subroutine test_too_near

   !> 0.05 of a bin off 3 f is no multiple unless the background makes it uncertain.
   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(2)
      type(bases_type) :: bases

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

   !> Where there is no peak there is nothing to label.
   subroutine test_no_peaks(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(0)
      type(bases_type) :: bases

      call label_peaks(peaks, 0.01_wp, bases)
      call expect_close(error, bases%frequency, [0.0_wp, 0.0_wp], 0.0_wp, "bases of nothing")
   end subroutine test_no_peaks

   !> Lines at multiples of f have these labels and bases.
   subroutine expect_labels(error, amplitudes, lines, kinds, multiples, second_multiples, known)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Amplitudes
      real(wp), intent(in) :: amplitudes(:)
      !> Frequencies over f
      real(wp), intent(in) :: lines(:)
      !> Kinds known
      integer, intent(in) :: kinds(:)
      !> Multiples of the first base known
      integer, intent(in) :: multiples(:)
      !> Multiples of the second base known
      integer, intent(in) :: second_multiples(:)
      !> Bases known, over f
      real(wp), intent(in) :: known(2)
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, amplitudes, f*lines, 0.0_wp, 1, frequency, power, peaks, bases)
      call expect_close(error, real(peaks%kind, wp), real(kinds, wp), 0.0_wp, "kinds of peaks")
      call expect_close(error, real(peaks%multiple(1), wp), real(multiples, wp), 0.0_wp, &
                        "multiples")
      call expect_close(error, real(peaks%multiple(2), wp), real(second_multiples, wp), 0.0_wp, &
                        "multiples of the second base")
      call expect_close(error, bases%frequency/f, known, 0.005_wp*width/f, "bases over f")
   end subroutine expect_labels
end module test_base_frequencies
