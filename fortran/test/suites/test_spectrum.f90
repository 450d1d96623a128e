! SPDX-License-Identifier: BSD-3-Clause
!> Power spectral density in threads and of few samples. tests/test_spectrum.py has its values.
module test_spectrum
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use omp_lib, only: omp_get_num_threads
   use pseudo_random, only: uniform
   use spectrum, only: power_spectrum
   implicit none (type, external)
   private
   public :: collect_spectrum

contains

   subroutine collect_spectrum(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("in threads", test_threads), &
                   new_unittest("too few samples", test_too_short)]
   end subroutine collect_spectrum

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
end module test_spectrum
