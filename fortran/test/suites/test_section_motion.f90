! SPDX-License-Identifier: BSD-3-Clause
!> Made-up sections whose motion is known: cycles, tori with two and three phases, noise and chaos.
module test_section_motion
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use section_motion, only: drifts, find_third_phase, not_measured, period_of_tail, &
                             section_roughness, torus_roughness
   use spectral_density, only: power_spectrum
   use spectral_peaks, only: find_peaks, other_peak, peak_type
   implicit none (type, external)
   private
   public :: collect_section_motion

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Two fundamental frequencies, their ratio the golden mean's inverse.
   real(wp), parameter :: f1 = 0.37_wp, f2 = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)*f1
   real(wp), parameter :: both(2) = [f1, f2]
   !> Three: no combination of them with small whole numbers is 0.
   real(wp), parameter :: three(3) = 0.113_wp*[1.0_wp, 1.0_wp/sqrt(3.0_wp), sqrt(0.85_wp)]
   !> How far the made-up motions reach.
   real(wp), parameter :: reach(2) = [1.0_wp, 0.5_wp]

contains

   subroutine collect_section_motion(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("torus of one loop", test_one_loop), &
                   new_unittest("torus of several loops", test_several_loops), &
                   new_unittest("noise and the logistic map", test_noise), &
                   new_unittest("cycles", test_tail), &
                   new_unittest("drift of maxima", test_drift), &
                   new_unittest("third phase of a 3-torus", test_third_phase)]
   end subroutine collect_section_motion

   !> Roughness of a section.
   pure real(wp) function roughness(points, times, bases) result(value)
      real(wp), intent(in) :: points(:, :), times(:), bases(2)

      value = section_roughness(points, times, reach, bases)
   end function roughness

   !> A number of times, one each turn of the first phase.
   pure function turns(n) result(times)
      integer, intent(in) :: n
      real(wp) :: times(n)
      integer :: i

      times = [(1000.0_wp + i/f1, i=1, n)]
   end function turns

   !> Points of a cycle: random ones that come again.
   pure function cycle(period, n) result(points)
      integer, intent(in) :: period, n
      real(wp) :: points(2, n)
      real(wp) :: one(2, period)
      integer :: i

      one = reshape(uniform(5, 2*period, -1.0_wp, 1.0_wp), [2, period])
      points = one(:, [(1 + modulo(i, period), i=1, n)])
   end function cycle

   !> A closed curve that is no circle, by its phase in turns.
   pure function loop(phase) result(points)
      real(wp), intent(in) :: phase(:)
      real(wp) :: points(2, size(phase))

      points(1, :) = cos(turn*phase) + 0.2_wp*cos(2.0_wp*turn*phase)
      points(2, :) = 0.6_wp*sin(turn*phase + 0.4_wp)
   end function loop

   !> Two numbers in each point, even around zero.
   pure function noise(seed, most, n) result(points)
      integer, intent(in) :: seed
      real(wp), intent(in) :: most
      integer, intent(in) :: n
      real(wp) :: points(2, n)

      points = reshape(uniform(seed, 2*n, -most, most), [2, n])
   end function noise

   !> A point each turn, when the first phase is 0, also where a turn takes longer or shorter by the
   !> second phase. A torus is not seen with another second frequency, nor without.
   subroutine test_one_loop(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 300
      real(wp) :: times(n)

      times = turns(n)
      ! neighbours are less than a turn/300 apart on a curve of length about 5
      call expect_between(error, roughness(loop(f2*times), times, both), 0.0_wp, 1.0e-3_wp, &
                          "a torus")
      call expect(error, roughness(loop(f2*times), times, [f1, 0.413_wp*f1]) > torus_roughness, &
                  "another second frequency")
      call expect_close(error, roughness(loop(f2*times), times, [f1, 0.0_wp]), not_measured, &
                        0.0_wp, "no second frequency")
      times = times + 0.1_wp/f1*sin(turn*f2*times)
      call expect_between(error, roughness(loop(f2*times), times, both), 0.0_wp, 1.0e-2_wp, &
                          "a torus with uneven turns")
   end subroutine test_one_loop

   !> The section is met three times a turn, each time on a loop of its own. Two loops in turn: half
   !> the frequency is a base; of the whole one the points are no function.
   subroutine test_several_loops(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 600
      real(wp), parameter :: first_phase(0:2) = [0.0_wp, 0.3_wp, 0.55_wp]
      real(wp), parameter :: place(0:2) = [0.0_wp, 2.5_wp, -1.5_wp]
      real(wp) :: points(2, n), times(n)
      integer :: i, k

      times = [(((i + first_phase(k))/f1, k=0, 2), i=1, n/3)]
      points = loop(f2*times)
      points(1, :) = points(1, :) + [((place(k), k=0, 2), i=1, n/3)]
      call expect_between(error, roughness(points, times, both), 0.0_wp, torus_roughness, &
                          "a torus of three loops")
      times = turns(n)
      points = loop(f2*times)
      points(2, :) = points(2, :) + [((-1)**i*0.7_wp, i=1, n)]
      call expect_between(error, roughness(points, times, [0.5_wp*f1, f2]), 0.0_wp, &
                          torus_roughness, "a doubled torus")
      call expect(error, roughness(points, times, both) > torus_roughness, &
                  "no function of the whole turn")
   end subroutine test_several_loops

   !> Points in random order have roughness 1. Noise that holds 2 or 10 per cent of the variance:
   !> roughness is its share. The logistic map in full chaos and in two bands, beside a part that is
   !> smooth in both phases: two bands in turn are smooth in half the frequency but for their width.
   subroutine test_noise(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 1000
      real(wp), parameter :: shares(2) = [0.02_wp, 0.10_wp], r(2) = [4.0_wp, 3.6_wp]
      real(wp) :: most, points(2, n), times(n)
      integer :: i

      times = turns(n)
      ! twice the variance in the mean over a thousand pairs, within four standard errors
      call expect_between(error, roughness(noise(9, 1.0_wp, n), times, both), 0.85_wp, 1.15_wp, &
                          "noise")
      do i = 1, 2
         ! (1 + 0.04)/2 and 0.36/2 over the squares of the reach against 2/3 of most^2/2 each
         most = sqrt(3.0_wp*shares(i)/(1.0_wp - shares(i))*(0.52_wp + 0.18_wp/0.25_wp) &
                     /(1.0_wp + 1.0_wp/0.25_wp))
         call expect_between(error, roughness(loop(f2*times) + noise(4, most, n), times, both), &
                             0.8_wp*shares(i), 1.2_wp*shares(i), "noise of "//text(shares(i)))
         points(1, :) = logistic(r(i), n)
         points(2, :) = 0.1_wp*sin(turn*f2*times)
         call expect(error, roughness(points, times, [0.5_wp*f1, f2]) > torus_roughness, &
                     "the logistic map at "//text(r(i)))
      end do
   end subroutine test_noise

   !> Points of the logistic map.
   pure function logistic(r, n) result(map)
      real(wp), intent(in) :: r
      integer, intent(in) :: n
      real(wp) :: map(n)
      integer :: i

      map(1) = 0.3_wp
      do i = 2, n
         map(i) = r*map(i - 1)*(1.0_wp - map(i - 1))
      end do
   end function logistic

   !> Cycles of up to 128 loops have this number. A cycle is reached where the last points repeat
   !> within 1e-5, closer and closer, whatever came before; a slow drift is none, and neither are
   !> points that move away from it.
   subroutine test_tail(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 300, period = 7, periods(5) = [1, 2, 7, 128, 129]
      real(wp) :: at(n), points(2, n)
      integer :: i

      do i = 1, size(periods)
         call expect(error, period_of_tail(cycle(periods(i), 600), reach, .false.) &
                     == merge(periods(i), 0, periods(i) < 129), "a cycle of "//text(periods(i)))
      end do
      at = [(real(i, wp), i=1, n)]
      points = cycle(period, n)
      points(:, :100) = noise(6, 1.0_wp, 100)
      call check(points, period, "after noise")
      call check(points(:, :127), 0, "too few repetitions")
      call check(points(:, :128), period, "just enough")
      points(1, :) = points(1, :) + exp(-0.05_wp*at)
      call check(points(:, :150), 0, "on the way")
      call expect(error, period_of_tail(points(:, :250), reach, .true.) == period, "near")
      call check(points, period, "approached")
      points = cycle(period, n)
      points(1, :) = points(1, :) + 4.0e-8_wp*exp(0.02_wp*at)
      call check(points, 0, "moving away")
      points = cycle(period, n)
      points(1, :) = points(1, :) + 1.0e-5_wp*at
      call check(points, 0, "drift")
      points = 0.0_wp
      points(1, :) = 3.0e-6_wp*cos(2.0_wp*at)
      do i = n - 20, n
         call check(points(:, :i), 1, "distances that swing")
      end do

   contains

      subroutine check(some, known, what)
         real(wp), intent(in) :: some(:, :)
         integer, intent(in) :: known
         character(len=*), intent(in) :: what

         call expect(error, period_of_tail(some, reach, .false.) == known, what)
      end subroutine check
   end subroutine test_tail

   !> Maxima that grow drift, however slowly; noise, a cycle, a beat and a change below 1e-3 do not.
   subroutine test_drift(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 240
      real(wp) :: ramp(n)
      integer :: i

      ramp = [(real(i, wp)/n, i=1, n)]
      call expect(error, all([drifts(1.0_wp + 0.01_wp*ramp), drifts(exp(-3.0_wp*ramp)), &
                              drifts(1.0_wp + 0.5_wp*ramp + uniform(1, n, -0.2_wp, 0.2_wp)), &
                              drifts(2.0_wp + 0.1_wp*exp(2.0_wp*ramp)*sin(20.0_wp*turn*ramp))]), &
                  "a ramp, a decay, a ramp with noise, growing swings")
      call expect(error, .not. any([drifts(1.0_wp + 1.0e-4_wp*ramp), drifts(ramp(:11)), &
                                    drifts(1.0_wp + 0.5_wp*sin(20.0_wp*turn*ramp))]), &
                  "a small change, too few, a beat")
      call expect(error, count([(drifts(uniform(i, n, 0.0_wp, 1.0_wp)), i=1, 500)]) <= 2, "noise")
   end subroutine test_drift

   !> Look for a third phase in motion that is a sum of cosines with these frequencies: v is known
   !> by its spectrum, the section is met when the first phase is 0.
   subroutine find_third(error, frequency, amplitude, noise, third, roughness)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: frequency(:)
      !> Amplitude of the last one beside 1; a part of the section that is chaotic, shape (points)
      real(wp), intent(in) :: amplitude, noise(:)
      real(wp), intent(out) :: third, roughness
      type(bases_type) :: bases
      type(failure_type), allocatable :: failure
      type(peak_type), allocatable :: peaks(:)
      integer, parameter :: samples = 40000
      real(wp), parameter :: interval = 0.5_wp
      real(wp) :: ln_v(samples), points(2, size(noise)), t(samples), times(size(noise))
      real(wp), allocatable :: at(:), power(:)
      integer :: i, last

      last = size(frequency)
      t = [(i*interval, i=1, samples)]
      ln_v = cos(turn*frequency(1)*t) + 0.4_wp*cos(turn*frequency(2)*t)
      if (last > 2) ln_v = ln_v + 0.3_wp*amplitude*cos(turn*frequency(last)*t + 1.0_wp)
      call power_spectrum(exp(ln_v), interval, "hann", 8, 0.5_wp, at, power, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      peaks = find_peaks(at, power, 1.0e-6_wp, 10.0_wp)
      call label_peaks(peaks, at(2), bases)
      peaks = pack(peaks, peaks%kind == other_peak)
      times = [(i/frequency(1), i=1, size(noise))]
      associate (a => turn*frequency(2)*times, b => turn*frequency(last)*times + 1.0_wp)
         points(1, :) = cos(a) + amplitude*sin(b) + noise
         points(2, :) = sin(a)*(1.0_wp + amplitude*cos(b))
      end associate
      call find_third_phase(points, times, [1.0_wp, 1.0_wp], bases%frequency, &
                            [peaks%frequency, 0.777_wp*frequency(1), 0.91_wp*frequency(1)], &
                            third, roughness)
   end subroutine find_third

   !> The third base is a combination of the three known frequencies, the third taken once. It may
   !> move the section by 0.15 only: less than a fiftieth of its variance. There is none of two
   !> frequencies, whatever lines are tried, none beside the logistic map in chaos, which may be
   !> weak, and none without a second phase or without lines.
   subroutine test_third_phase(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: most = 6, n = 2000
      real(wp), parameter :: none(n) = 0.0_wp
      real(wp) :: misfit, points(2, n), roughness, third
      integer :: i, j

      call find_third(error, three, 1.0_wp, none, third, roughness)
      if (allocated(error)) return
      call expect_between(error, roughness, 0.0_wp, torus_roughness, "roughness")
      misfit = minval([((abs(abs(i*three(1) + j*three(2) + three(3)) - third), i=-most, most), &
                        j=-most, most)])
      call expect_between(error, misfit, 0.0_wp, 1.0e-6_wp, "combination of the known ones")
      call find_third(error, three, 0.15_wp, none, third, roughness)
      call expect(error, third > 0.0_wp, "a weak third phase")
      call expect_between(error, roughness, 0.0_wp, 0.25_wp*0.15_wp**2, "roughness")
      call find_third(error, three(:2), 1.0_wp, none, third, roughness)
      call expect_close(error, [third, roughness], [0.0_wp, not_measured], 0.0_wp, "of a torus")
      do i = 0, 2
         call find_third(error, three(:2), 1.0_wp, 0.1_wp*5.5_wp**i*logistic(4.0_wp, n), third, &
                         roughness)
         call expect_close(error, third, 0.0_wp, 0.0_wp, "no third phase of two")
      end do
      call find_third(error, three, 0.15_wp, 3.0_wp*logistic(4.0_wp, n), third, roughness)
      call expect_close(error, third, 0.0_wp, 0.0_wp, "no third phase of three")
      points = noise(3, 1.0_wp, n)
      do i = 0, 1
         call find_third_phase(points, turns(n), reach, [three(1), i*three(2)], three(3 + i:), &
                               third, roughness)
         call expect_close(error, [third, roughness], [0.0_wp, not_measured], 0.0_wp, &
                           "one phase or no lines")
      end do
   end subroutine test_third_phase
end module test_section_motion
