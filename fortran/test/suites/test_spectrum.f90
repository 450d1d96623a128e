! SPDX-License-Identifier: BSD-3-Clause
!> Power spectral density: a direct Fourier sum, lines of known power, and threads.
module test_spectrum
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use omp_lib, only: omp_get_num_threads
   use pseudo_random, only: uniform
   use spectrum, only: power_spectrum
   implicit none (type, external)
   private
   public :: collect_spectrum

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   subroutine collect_spectrum(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("direct sum", test_direct_sum), &
                   new_unittest("lines", test_lines), &
                   new_unittest("in threads", test_threads), &
                   new_unittest("too few samples", test_too_short)]
   end subroutine collect_spectrum

   !> Each bin, from 0 in steps of 1/(length interval), against its Fourier sum written out.
   subroutine test_direct_sum(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), known(:), power(:), signal(:), window(:)
      integer :: i, m, n

      do n = 33, 34
         signal = 2.0_wp + uniform(n, n, -1.0_wp, 1.0_wp)
         call spectrum_of(error, signal, 0.2_wp, frequency, power)
         window = [(0.5_wp - 0.5_wp*cos(turn*i/n), i=0, n - 1)]
         signal = window*(signal - sum(signal)/n)
         known = [(2.0_wp*0.2_wp/sum(window**2) &
                   *abs(sum(signal*exp(cmplx(0.0_wp, [(-turn*i*m/n, i=0, n - 1)], kind=wp))))**2, &
                   m=0, n/2)]
         known(1) = 0.5_wp*known(1)
         if (n == 34) known(18) = 0.5_wp*known(18)
         call expect_close(error, power, known, 1.0e-14_wp, "power of "//text(n)//" samples")
         call expect_close(error, frequency, [(m/(n*0.2_wp), m=0, n/2)], 1.0e-14_wp, "frequencies")
      end do
   end subroutine test_direct_sum

   !> Sines of known amplitude between the bins: each line holds half its amplitude squared, all
   !> together the variance.
   subroutine test_lines(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 4000
      real(wp), parameter :: interval = 0.05_wp, amplitudes(3) = [1.0_wp, 0.3_wp, 2.0e-3_wp]
      real(wp), parameter :: bins(3) = [100.3_wp, 271.5_wp, 700.87_wp]
      real(wp), allocatable :: frequency(:), power(:)
      real(wp) :: signal(n)
      integer :: i, j

      signal = [(7.0_wp + sum(amplitudes*sin(turn*bins*i/n + [0.3_wp, 1.0_wp, 2.0_wp])), i=1, n)]
      call spectrum_of(error, signal, interval, frequency, power)
      if (allocated(error)) return
      call expect_close(error, sum(power)*frequency(2)/(0.5_wp*sum(amplitudes**2)), 1.0_wp, &
                        1.0e-3_wp, "integral over variance")
      do j = 1, size(bins)
         associate (bin => nint(bins(j)) + 1)
            call expect_close(error, sum(power(bin - 8:bin + 8))*frequency(2) &
                              /(0.5_wp*amplitudes(j)**2), 1.0_wp, 1.0e-3_wp, &
                              "power of line "//text(j)//" over half its amplitude squared")
         end associate
      end do
   end subroutine test_lines

   !> Spectra of all lengths made in four threads are those made one after the other.
   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: shortest = 100, longest = 1200
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

   contains

      !> The highest power in the spectrum of the first samples.
      real(wp) function highest(samples) result(value)
         integer, intent(in) :: samples
         type(failure_type), allocatable :: failure
         real(wp), allocatable :: frequency(:), power(:)

         call power_spectrum(signal(:samples), 0.05_wp, "hann", 3, 0.5_wp, frequency, power, &
                             failure)
         value = maxval(power)
      end function highest
   end subroutine test_threads

   !> Segments of fewer than 16 samples are refused with their number.
   subroutine test_too_short(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp), allocatable :: frequency(:), power(:)

      call power_spectrum(uniform(1, 100, 0.0_wp, 1.0_wp), 1.0_wp, "hann", 16, 0.5_wp, frequency, &
                          power, failure)
      call expect_failure(error, failure, "100 samples make 16 segments of 11; at least 16")
      call power_spectrum(uniform(1, 16, 0.0_wp, 1.0_wp), 1.0_wp, "hann", 1, 0.0_wp, frequency, &
                          power, failure)
      call expect_success(error, failure)
   end subroutine test_too_short

   !> A spectrum of one segment that must not fail.
   subroutine spectrum_of(error, signal, interval, frequency, power)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: signal(:), interval
      real(wp), allocatable, intent(out) :: frequency(:), power(:)
      type(failure_type), allocatable :: failure

      call power_spectrum(signal, interval, "hann", 1, 0.0_wp, frequency, power, failure)
      call expect_success(error, failure)
   end subroutine spectrum_of
end module test_spectrum
