! SPDX-License-Identifier: BSD-3-Clause
!> Made-up sections whose motion is known.
module test_section_motion
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use section_motion, only: drifts, not_measured, period_of_tail, section_roughness, &
                             torus_roughness
   implicit none (type, external)
   private
   public :: collect_section_motion

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Two fundamental frequencies, their ratio the golden mean's inverse.
   real(wp), parameter :: f1 = 0.37_wp, f2 = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)*f1
   real(wp), parameter :: both(2) = [f1, f2]
   !> How far the made-up motions reach.
   real(wp), parameter :: reach(2) = [1.0_wp, 0.5_wp]

contains

   subroutine collect_section_motion(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("cycles", test_cycles), &
                   new_unittest("torus of one loop", test_one_loop), &
                   new_unittest("torus of several loops", test_several_loops), &
                   new_unittest("noise", test_noise), &
                   new_unittest("logistic map", test_logistic), &
                   new_unittest("the last points of a cycle", test_tail), &
                   new_unittest("drift of maxima", test_drift)]
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

   !> Cycles of 1, 2, 7 and 128 loops have this number; one of 129 is none.
   subroutine test_cycles(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      integer, parameter :: n = 600, periods(4) = [1, 2, 7, 128]

      do i = 1, size(periods)
         call expect(error, period_of_tail(cycle(periods(i), n), reach, .false.) == periods(i), &
                     "a cycle of "//text(periods(i)))
      end do
      call expect(error, period_of_tail(cycle(129, n), reach, .false.) == 0, "129 are too many")
   end subroutine test_cycles

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
   !> roughness is its share.
   subroutine test_noise(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 1000
      real(wp), parameter :: shares(2) = [0.02_wp, 0.10_wp]
      real(wp) :: most, times(n)
      integer :: i

      times = turns(n)
      ! twice the variance in the mean over a thousand pairs, within four standard errors
      call expect_between(error, roughness(noise(9, 1.0_wp, n), times, both), 0.85_wp, 1.15_wp, &
                          "noise")
      do i = 1, size(shares)
         ! (1 + 0.04)/2 and 0.36/2 over the squares of the reach against 2/3 of most^2/2 each
         most = sqrt(3.0_wp*shares(i)/(1.0_wp - shares(i))*(0.52_wp + 0.18_wp/0.25_wp) &
                     /(1.0_wp + 1.0_wp/0.25_wp))
         call expect_between(error, roughness(loop(f2*times) + noise(4, most, n), times, both), &
                             0.8_wp*shares(i), 1.2_wp*shares(i), "noise of "//text(shares(i)))
      end do
   end subroutine test_noise

   !> The logistic map in full chaos and in two bands, beside a part that is smooth in both phases.
   subroutine test_logistic(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 1000
      real(wp), parameter :: r(2) = [4.0_wp, 3.6_wp]
      real(wp) :: map(n), points(2, n), times(n)
      integer :: i, k

      times = turns(n)
      do k = 1, size(r)
         map(1) = 0.3_wp
         do i = 2, n
            map(i) = r(k)*map(i - 1)*(1.0_wp - map(i - 1))
         end do
         points(1, :) = map
         points(2, :) = 0.1_wp*sin(turn*f2*times)
         ! two bands in turn are a smooth function of half the frequency, but for their width
         call expect(error, roughness(points, times, [0.5_wp*f1, f2]) > torus_roughness, &
                     "the logistic map at "//text(r(k)))
      end do
   end subroutine test_logistic

   !> A cycle is reached where the last points repeat within 1e-5, closer and closer, whatever came
   !> before; a slow drift is none, and neither are points that move away from it.
   subroutine test_tail(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 300, period = 7
      real(wp) :: points(2, n)
      integer :: i

      points = cycle(period, n)
      points(:, :100) = noise(6, 1.0_wp, 100)
      call expect(error, period_of_tail(points, reach, .false.) == period, "after noise")
      call expect(error, period_of_tail(points(:, :127), reach, .false.) == 0, &
                  "too few repetitions")
      call expect(error, period_of_tail(points(:, :128), reach, .false.) == period, "just enough")
      do i = 1, n
         points(1, i) = points(1, i) + exp(-0.05_wp*i)
      end do
      call expect(error, period_of_tail(points(:, :150), reach, .false.) == 0, "on the way")
      call expect(error, period_of_tail(points(:, :250), reach, .true.) == period, "near")
      call expect(error, period_of_tail(points, reach, .false.) == period, "approached")
      points = cycle(period, n)
      do i = 1, n
         points(1, i) = points(1, i) + 4.0e-8_wp*exp(0.02_wp*i)
      end do
      call expect(error, period_of_tail(points, reach, .false.) == 0, "moving away")
      points = cycle(period, n)
      do i = 1, n
         points(1, i) = points(1, i) + 1.0e-5_wp*i
      end do
      call expect(error, period_of_tail(points, reach, .false.) == 0, "drift")
      points = 0.0_wp
      points(1, :) = [(3.0e-6_wp*reach(1)*cos(2.0_wp*i), i=1, n)]
      do i = n - 20, n
         call expect(error, period_of_tail(points(:, :i), reach, .false.) == 1, &
                     "distances that swing")
      end do
   end subroutine test_tail

   !> Maxima that grow drift, however slowly; noise, a cycle, a beat and a change below 1e-3 do not.
   subroutine test_drift(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 240
      real(wp) :: ramp(n)
      integer :: drifting, i

      ramp = [(real(i, wp)/n, i=1, n)]
      call expect(error, drifts(1.0_wp + 0.01_wp*ramp), "a ramp")
      call expect(error, drifts(exp(-3.0_wp*ramp)), "a decay")
      call expect(error, drifts(1.0_wp + 0.5_wp*ramp + uniform(1, n, -0.2_wp, 0.2_wp)), &
                  "a ramp with noise")
      call expect(error, drifts(2.0_wp + 0.1_wp*exp(2.0_wp*ramp)*sin(20.0_wp*turn*ramp)), &
                  "growing swings")
      call expect(error, .not. drifts(1.0_wp + 1.0e-4_wp*ramp), "a small change")
      call expect(error, .not. drifts(1.0_wp + 0.5_wp*sin(20.0_wp*turn*ramp)), "a beat")
      call expect(error, .not. drifts(ramp(:11)), "too few")
      drifting = count([(drifts(uniform(i, n, 0.0_wp, 1.0_wp)), i=1, 500)])
      call expect(error, drifting <= 2, "noise")
   end subroutine test_drift
end module test_section_motion
