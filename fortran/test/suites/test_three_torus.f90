! SPDX-License-Identifier: BSD-3-Clause
!> Motions with known frequencies: 3-tori by exponents and by the section, and what is none.
module test_three_torus
   use analytic_models, only: analytic_model
   use base_frequencies, only: bases_type, label_peaks
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use exponent_runs, only: find_exponents
   use exponent_averages, only: exponent_type
   use lyapunov_spectrum, only: growth_settings_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: class_by_exponents, three_torus, torus
   use pseudo_random, only: uniform
   use section_motion, only: find_third_phase, not_measured, torus_roughness
   use solving, only: at_tolerance
   use spectral_peaks, only: find_peaks, other_peak, peak_type
   use spectrum, only: power_spectrum
   implicit none (type, external)
   private
   public :: collect_three_torus

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Three frequencies: no combination of them with small whole numbers is 0.
   real(wp), parameter :: known(3) = [0.113_wp, 0.113_wp/sqrt(3.0_wp), 0.113_wp*sqrt(0.85_wp)]
   !> Strength and length of the delay.
   real(wp), parameter :: strength = 0.3_wp, lag = 1.0_wp
   !> How far the made-up motions reach.
   real(wp), parameter :: reach(2) = [1.0_wp, 1.0_wp]

   !> Uncoupled oscillators, w = 2 pi f:
   !>
   !>     z' = z (1 + i w - |z|^2) + strength [exp(i w lag) z(t - lag) - z],
   !>
   !> each on its cycle z = exp(i w t). The state is Re z and Im z of each in turn.
   type, extends(analytic_model) :: oscillators_type
      !> Their frequencies
      real(wp), allocatable :: frequency(:)
   contains
      procedure :: history
      procedure :: slope => slope_of
   end type oscillators_type

contains

   subroutine collect_three_torus(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exponents of oscillators", test_exponents), &
                   new_unittest("third phase of a 3-torus", test_third_phase), &
                   new_unittest("no phases", test_no_phases)]
   end subroutine collect_three_torus

   !> So many oscillators.
   pure type(oscillators_type) function oscillators(n) result(problem)
      integer, intent(in) :: n
      integer :: i

      problem%frequency = known(:n)
      call problem%fill(spread(0.0_wp, 1, 2*n), spread(lag, 1, 2*n), [(i, i=1, 2*n)])
   end function oscillators

   !> On the cycles.
   pure function history(self, t, component) result(value)
      class(oscillators_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = cos(turn*self%frequency((component + 1)/2)*t &
                  - merge(0.0_wp, 0.25_wp*turn, modulo(component, 2) == 1))
   end function history

   !> Their equation by real and imaginary parts.
   pure function slope_of(self, y, z) result(slope)
      class(oscillators_type), intent(in) :: self
      complex(wp), intent(in) :: y(:), z(:)
      complex(wp) :: slope(size(y))
      integer :: i

      do i = 1, self%n, 2
         associate (a => y(i), b => y(i + 1), w => turn*self%frequency((i + 1)/2))
            slope(i) = a*(1.0_wp - strength - a**2 - b**2) - w*b &
                       + strength*(cos(w*lag)*z(i) - sin(w*lag)*z(i + 1))
            slope(i + 1) = b*(1.0_wp - strength - a**2 - b**2) + w*a &
                           + strength*(sin(w*lag)*z(i) + cos(w*lag)*z(i + 1))
         end associate
      end do
   end function slope_of

   !> Two and three oscillators: a zero exponent each, the next one is the root of
   !> s + 2 + strength = strength exp(-s lag) that a disturbance of |z| has.
   subroutine test_exponents(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      integer, parameter :: classes(2:3) = [torus, three_torus]
      integer :: i, n
      real(wp) :: s

      s = -1.0_wp
      do i = 1, 50
         s = s - (s + 2.0_wp + strength*(1.0_wp - exp(-s*lag)))/(1.0_wp + strength*lag*exp(-s*lag))
      end do
      do n = 2, 3
         call find_exponents( &
            oscillators(n), &
            growth_settings_type(exponents=n + 1, t_begin=50.0_wp, t_end=450.0_wp, &
                                 t_turning=40.0_wp, interval=2.0_wp, across_flow=.true.), &
            at_tolerance(1.0e-8_wp, "auto"), exponents, error)
         if (allocated(error)) return
         call expect_close(error, exponents%value, [(0.0_wp, i=1, n), s], 1.0e-6_wp, "exponents")
         call expect(error, class_by_exponents(exponents, 3.0e-5_wp, 1.0e-3_wp) == classes(n), &
                     "class")
      end do
   end subroutine test_exponents

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
      call find_third_phase(points, times, reach, bases%frequency, &
                            [peaks%frequency, 0.777_wp*frequency(1), 0.91_wp*frequency(1)], &
                            third, roughness)
   end subroutine find_third

   !> The third base is a combination of the three known frequencies, the third taken once. It may
   !> move the section by 0.15 only: less than a fiftieth of its variance. There is none of two
   !> frequencies, whatever lines are tried, and none beside the logistic map in chaos, which may be
   !> weak.
   subroutine test_third_phase(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: most = 6, n = 2000
      real(wp), parameter :: none(n) = 0.0_wp
      real(wp) :: map(n), misfit, roughness, third
      integer :: i, j

      call find_third(error, known, 1.0_wp, none, third, roughness)
      if (allocated(error)) return
      call expect_between(error, roughness, 0.0_wp, torus_roughness, "roughness")
      misfit = minval([((abs(abs(i*known(1) + j*known(2) + known(3)) - third), i=-most, most), &
                        j=-most, most)])
      call expect_between(error, misfit, 0.0_wp, 1.0e-6_wp, "combination of the known ones")
      call find_third(error, known, 0.15_wp, none, third, roughness)
      call expect(error, third > 0.0_wp, "a weak third phase")
      call expect_between(error, roughness, 0.0_wp, 0.25_wp*0.15_wp**2, "roughness")
      call find_third(error, known(:2), 1.0_wp, none, third, roughness)
      call expect_close(error, [third, roughness], [0.0_wp, not_measured], 0.0_wp, "of a torus")
      map(1) = 0.3_wp
      do i = 2, n
         map(i) = 4.0_wp*map(i - 1)*(1.0_wp - map(i - 1))
      end do
      do i = 1, 3
         call find_third(error, known(:2), 1.0_wp, 0.1_wp*5.5_wp**(i - 1)*map, third, roughness)
         call expect_close(error, third, 0.0_wp, 0.0_wp, "no third phase of two")
      end do
      call find_third(error, known, 0.15_wp, 3.0_wp*map, third, roughness)
      call expect_close(error, third, 0.0_wp, 0.0_wp, "no third phase of three")
   end subroutine test_third_phase

   !> Without a second phase, or without lines, there is no third.
   subroutine test_no_phases(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 200
      real(wp) :: points(2, n), roughness, third, times(n)
      integer :: i

      points = reshape(uniform(3, 2*n, -1.0_wp, 1.0_wp), [2, n])
      times = [(i/known(1), i=1, n)]
      call find_third_phase(points, times, reach, [known(1), 0.0_wp], known(3:), third, roughness)
      call expect_close(error, [third, roughness], [0.0_wp, not_measured], 0.0_wp, "one phase")
      call find_third_phase(points, times, reach, known(:2), known(:0), third, roughness)
      call expect_close(error, [third, roughness], [0.0_wp, not_measured], 0.0_wp, "no lines")
   end subroutine test_no_phases
end module test_three_torus
