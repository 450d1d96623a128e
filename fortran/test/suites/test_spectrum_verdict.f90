!> What a spectrum is called: lines of one fundamental frequency, of two, or a continuum.
module test_spectrum_verdict
   use base_frequencies, only: bases_type
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use spectral_peaks, only: base_peak, harmonic_peak, other_peak, peak_type
   use spectrum_verdict, only: continuum_share, line_share, spectrum_kind, spectrum_kind_name
   use synthetic_spectra, only: analyse, f, width
   implicit none (type, external)
   private
   public :: collect_spectrum_verdict

   !> Ratios to the base that are far from simple fractions: the golden mean's inverse and 2**(1/3).
   real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp), cubic = 2.0_wp**(1.0_wp/3)
   !> The lines of a torus over f.
   real(wp), parameter :: torus(5) = [1.0_wp, golden, 2.0_wp, 1.0_wp + golden, 1.0_wp - golden]

contains

   !> All tests of this suite.
   subroutine collect_spectrum_verdict(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("share of the lines", test_shares), &
                   new_unittest("broad peaks are no lines", test_broad_peaks), &
                   new_unittest("periodic", test_one_base), &
                   new_unittest("quasiperiodic", test_two_bases), &
                   new_unittest("three bases", test_three_bases), &
                   new_unittest("nearly commensurate", test_nearly_commensurate), &
                   new_unittest("lines that do not count", test_negligible), &
                   new_unittest("continuum", test_continuum), &
                   new_unittest("lines in noise", test_lines_in_noise), &
                   new_unittest("no power and no peaks", test_nothing)]
   end subroutine collect_spectrum_verdict

   !> By hand: a line in bin 20 that holds 3/2 of its height, one in bin 40 that finds less than
   !> that in its 9 bins, two at 70 and 75 that share 14 bins, and 1 in every other bin.
   subroutine test_shares(error)
      type(error_type), allocatable, intent(out) :: error
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
   end subroutine test_shares

   !> Peaks that fall to a half within five bins are a continuum although all power is near peaks
   !> at f, 2 f and 3 f.
   subroutine test_broad_peaks(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(3)
      type(bases_type) :: bases
      real(wp) :: power(400)
      integer :: i

      power = [(sum(1.0_wp/(1.0_wp + ((i - [100, 200, 300])/5.0_wp)**2)), i=1, 400)]
      peaks%bin = [100, 200, 300]
      peaks%power = power(peaks%bin)
      peaks%kind = [base_peak, harmonic_peak, harmonic_peak]
      call expect_kind(error, power, peaks, bases, "continuum", "broad peaks")
   end subroutine test_broad_peaks

   !> Harmonics, also of a doubled period, nothing else.
   subroutine test_one_base(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_sines(error, [1.0_wp, 0.3_wp, 0.1_wp], [1.0_wp, 2.0_wp, 3.0_wp], 0.0_wp, &
                        "periodic", "f, 2 f, 3 f")
      call expect_sines(error, [1.0_wp, 0.3_wp, 0.1_wp], [1.0_wp, 0.5_wp, 1.5_wp], 0.0_wp, &
                        "periodic", "f, f/2, 3 f/2")
      call expect_sines(error, [1.0_wp, 0.7_wp], [1.0_wp, 0.75_wp], 0.0_wp, "periodic", "f, 3 f/4")
   end subroutine test_one_base

   !> A torus, its second base strong, weak or the highest.
   subroutine test_two_bases(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_sines(error, [1.0_wp, 0.5_wp, 0.3_wp, 0.1_wp, 0.1_wp], torus, 0.0_wp, &
                        "quasiperiodic", "a torus")
      call expect_sines(error, [1.0_wp, 0.02_wp, 0.3_wp, 0.01_wp, 0.01_wp], torus, 0.0_wp, &
                        "quasiperiodic", "a torus, weak")
      call expect_sines(error, [1.0_wp, 2.0_wp, 0.3_wp, 0.1_wp, 0.1_wp], torus, 0.0_wp, &
                        "quasiperiodic", "a torus, strong")
      call expect_sines(error, [1.0_wp, 0.2_wp, 0.2_wp], [1.0_wp, 1.0_wp + 0.1_wp*golden, &
                                                          1.0_wp - 0.1_wp*golden], 0.0_wp, &
                        "quasiperiodic", "sidebands")
   end subroutine test_two_bases

   !> Three frequencies are not two, and no continuum either.
   subroutine test_three_bases(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_sines(error, [1.0_wp, 0.5_wp, 0.4_wp], [1.0_wp, golden, cubic], 0.0_wp, &
                        "undecided", "three bases")
      call expect_sines(error, [1.0_wp, 0.5_wp, 0.02_wp], [1.0_wp, golden, cubic], 0.0_wp, &
                        "undecided", "three bases, one weak")
   end subroutine test_three_bases

   !> Half a bin off 2 f and at 13/23 f it cannot be told; 0.05 of a bin off 3/4 f it can.
   subroutine test_nearly_commensurate(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_sines(error, [1.0_wp, 0.5_wp], [1.0_wp, 2.0_wp + 0.5_wp*width/f], 0.0_wp, &
                        "undecided", "half a bin off 2 f")
      call expect_sines(error, [1.0_wp, 0.5_wp], [1.0_wp, 13.0_wp/23], 0.0_wp, "undecided", &
                        "13/23 f")
      call expect_sines(error, [1.0_wp, 0.5_wp], [1.0_wp, 0.75_wp + 0.05_wp*width/f], 0.0_wp, &
                        "quasiperiodic", "0.05 of a bin off 3/4 f")
   end subroutine test_nearly_commensurate

   !> A second base of 2e-6 of the power does not count, nor does a third of 2e-5; of ten times that
   !> they do.
   subroutine test_negligible(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_sines(error, [1.0_wp, 0.0014_wp], [1.0_wp, golden], 0.0_wp, "periodic", &
                        "f and a trace")
      call expect_sines(error, [1.0_wp, 0.0045_wp], [1.0_wp, golden], 0.0_wp, "quasiperiodic", &
                        "f and more than a trace")
      call expect_sines(error, [1.0_wp, 0.5_wp, 0.005_wp], [1.0_wp, golden, cubic], 0.0_wp, &
                        "quasiperiodic", "two and a trace")
      call expect_sines(error, [1.0_wp, 0.5_wp, 0.016_wp], [1.0_wp, golden, cubic], 0.0_wp, &
                        "undecided", "two and more than a trace")
   end subroutine test_negligible

   !> Noise, alone and with lines that hold less than 98 %.
   subroutine test_continuum(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_sines(error, [0.0_wp], [1.0_wp], 1.0_wp, "continuum", "noise")
      call expect_sines(error, [1.0_wp, 0.3_wp], [1.0_wp, 2.0_wp], 0.25_wp, "continuum", &
                        "two lines in noise of 4 % of the power")
      call expect_sines(error, [1.0_wp, 0.3_wp], [1.0_wp, 2.0_wp], 0.15_wp, "undecided", &
                        "two lines in noise of 1.4 % of the power")
   end subroutine test_continuum

   !> Noise of 2.5e-4 of the power changes no verdict; the shares are the known ones.
   subroutine test_lines_in_noise(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)

      call expect_sines(error, [1.0_wp, 0.3_wp, 0.1_wp], [1.0_wp, 2.0_wp, 3.0_wp], 0.02_wp, &
                        "periodic", "f, 2 f, 3 f in noise")
      call expect_sines(error, [1.0_wp, 0.5_wp, 0.3_wp, 0.1_wp, 0.1_wp], torus, 0.02_wp, &
                        "quasiperiodic", "a torus in noise")
      call analyse(error, [1.0_wp, 0.3_wp, 0.1_wp], f*[1.0_wp, 2.0_wp, 3.0_wp], 1.0_wp, 8, &
                   frequency, power, peaks, bases)
      ! 0.55 of the power in the lines, 1/3 in the noise
      call expect_close(error, line_share(power, peaks), 0.55_wp/(0.55_wp + 1.0_wp/3), 0.03_wp, &
                        "share of the lines")
      call expect_close(error, continuum_share(power, peaks), (1.0_wp/3)/(0.55_wp + 1.0_wp/3), &
                        0.03_wp, "share of the noise")
   end subroutine test_lines_in_noise

   !> Without power there is no spectrum; power without a peak is a continuum.
   subroutine test_nothing(error)
      type(error_type), allocatable, intent(out) :: error
      type(peak_type) :: peaks(0)
      type(bases_type) :: bases
      real(wp) :: power(20)

      power = 0.0_wp
      call expect_kind(error, power, peaks, bases, "none", "no power")
      call expect_close(error, continuum_share(power, peaks), 0.0_wp, 0.0_wp, "share of no power")
      power = 1.0_wp
      call expect_kind(error, power, peaks, bases, "continuum", "no peaks")
   end subroutine test_nothing

   !> Sines at multiples of f, and noise, make a spectrum of this kind.
   subroutine expect_sines(error, amplitudes, lines, noise, known, what)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Amplitudes
      real(wp), intent(in) :: amplitudes(:)
      !> Frequencies over f
      real(wp), intent(in) :: lines(:)
      !> Greatest value of the noise
      real(wp), intent(in) :: noise
      !> Name of the kind
      character(len=*), intent(in) :: known
      !> What it is
      character(len=*), intent(in) :: what
      real(wp), allocatable :: frequency(:), power(:)
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)

      call analyse(error, amplitudes, f*lines, noise, 8, frequency, power, peaks, bases)
      if (allocated(error)) return
      call expect_kind(error, power, peaks, bases, known, what)
   end subroutine expect_sines

   !> A spectrum is of this kind.
   subroutine expect_kind(error, power, peaks, bases, known, what)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Labelled peaks
      type(peak_type), intent(in) :: peaks(:)
      !> Their bases
      type(bases_type), intent(in) :: bases
      !> Name of the kind
      character(len=*), intent(in) :: known
      !> What it is
      character(len=*), intent(in) :: what
      character(len=:), allocatable :: name

      name = spectrum_kind_name(spectrum_kind(power, peaks, bases))
      call expect(error, name == known, what//": "//known//", not "//name)
   end subroutine expect_kind
end module test_spectrum_verdict
