!> Power spectral density: Parseval's theorem, a direct Fourier sum, lines and noise of known power.
module test_spectrum
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use omp_lib, only: omp_get_num_threads
   use pseudo_random, only: uniform
   use spectrum, only: power_spectrum, window_of
   implicit none (type, external)
   private
   public :: collect_spectrum

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   subroutine collect_spectrum(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("windows", test_windows), &
                   new_unittest("direct sum", test_direct_sum), &
                   new_unittest("Parseval's theorem", test_parseval), &
                   new_unittest("lines", test_lines), &
                   new_unittest("mean of overlapping segments", test_overlap), &
                   new_unittest("white noise", test_noise), &
                   new_unittest("in threads", test_threads), &
                   new_unittest("too few samples", test_too_short)]
   end subroutine collect_spectrum

   !> Hann: 0 at the start, 1/2 at a quarter, 1 in the middle, mean square 3/8; boxcar: 1.
   subroutine test_windows(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: hann(:)

      allocate (hann, source=window_of("hann", 400))
      call expect_close(error, hann([1, 101, 201, 301]), [0.0_wp, 0.5_wp, 1.0_wp, 0.5_wp], &
                        1.0e-15_wp, "Hann")
      call expect_close(error, hann(2:200), hann(400:202:-1), 1.0e-15_wp, "Hann, other half")
      call expect_close(error, sum(hann**2)/400, 0.375_wp, 1.0e-14_wp, "mean square")
      call expect_close(error, window_of("boxcar", 3), [1.0_wp, 1.0_wp, 1.0_wp], 0.0_wp, "boxcar")
   end subroutine test_windows

   !> Each bin, from 0 in steps of 1/(length interval), against its Fourier sum written out.
   subroutine test_direct_sum(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: frequency(:), known(:), power(:), signal(:), window(:)
      integer :: i, m, n

      do n = 33, 34
         signal = 2.0_wp + uniform(n, n, -1.0_wp, 1.0_wp)
         call spectrum_of(error, signal, 0.2_wp, "hann", 1, 0.0_wp, frequency, power)
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

   !> Without a window the integral is the variance, for odd and even lengths, and for segments that
   !> do not overlap.
   subroutine test_parseval(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: lengths(5) = [16, 17, 1000, 1001, 4096]
      real(wp), allocatable :: frequency(:), power(:), signal(:)
      integer :: i

      do i = 1, size(lengths)
         signal = 3.0_wp + uniform(i, lengths(i), -1.0_wp, 2.0_wp)
         ! the highest frequency that an even length can hold, strong
         signal(::2) = signal(::2) + 4.0_wp
         call spectrum_of(error, signal, 0.05_wp, "boxcar", 1, 0.0_wp, frequency, power)
         call expect_close(error, sum(power)*frequency(2)/variance(signal), 1.0_wp, 1.0e-12_wp, &
                           "integral over variance of "//text(lengths(i))//" samples")
      end do
      signal = uniform(8, 800, 0.0_wp, 1.0_wp)
      signal(:100) = 3.0_wp*signal(:100)
      call spectrum_of(error, signal, 0.05_wp, "boxcar", 8, 0.0_wp, frequency, power)
      call expect_close(error, frequency(2), 0.2_wp, 1.0e-15_wp, "width of a bin")
      call expect_close(error, sum(power)*frequency(2)/variance(signal), 1.0_wp, 1.0e-12_wp, &
                        "integral over variance of 8 segments")
   end subroutine test_parseval

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
      call spectrum_of(error, signal, interval, "hann", 1, 0.0_wp, frequency, power)
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

   !> Of 4 blocks without a mean, segments of 2 that overlap by half begin at blocks 1, 2 and 3: the
   !> spectrum is the mean of theirs.
   subroutine test_overlap(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: block = 60
      real(wp), allocatable :: frequency(:), mean(:), power(:), signal(:)
      integer :: i

      allocate (signal, source=uniform(5, 4*block, -1.0_wp, 1.0_wp))
      do i = 1, 4
         associate (part => signal((i - 1)*block + 1:i*block))
            part = i*(part - sum(part)/block)
         end associate
      end do
      allocate (mean(block + 1), source=0.0_wp)
      do i = 0, 2
         call spectrum_of(error, signal(i*block + 1:(i + 2)*block), 0.5_wp, "hann", 1, 0.0_wp, &
                          frequency, power)
         if (allocated(error)) return
         mean = mean + power/3.0_wp
      end do
      call spectrum_of(error, signal, 0.5_wp, "hann", 3, 0.5_wp, frequency, power)
      call expect_close(error, power, mean, 1.0e-13_wp, "power")
   end subroutine test_overlap

   !> White noise: the level is variance times 2 interval, its scatter 1/sqrt(K) over K segments
   !> that do not overlap, and what Welch found for Hann windows that overlap by half.
   subroutine test_noise(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: interval = 0.05_wp
      real(wp), allocatable :: signal(:)

      allocate (signal, source=uniform(3, 65536, -1.0_wp, 1.0_wp))
      call expect_close(error, variance(signal), 1.0_wp/3, 0.01_wp, "variance of the noise")
      call expect_noise(error, signal, interval, "boxcar", 1, 0.0_wp, 1.0_wp)
      call expect_noise(error, signal, interval, "boxcar", 16, 0.0_wp, 0.25_wp)
      call expect_noise(error, signal, interval, "hann", 16, 0.5_wp, &
                        sqrt((1.0_wp + 2.0_wp*15.0_wp/16.0_wp/36.0_wp)/16.0_wp))
   end subroutine test_noise

   !> Level and scatter (over the mean) of a spectrum of white noise.
   subroutine expect_noise(error, signal, interval, window_name, segments, overlap, scatter)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: signal(:), interval, overlap, scatter
      character(len=*), intent(in) :: window_name
      integer, intent(in) :: segments
      real(wp), allocatable :: frequency(:), power(:)
      character(len=:), allocatable :: what

      call spectrum_of(error, signal, interval, window_name, segments, overlap, frequency, power)
      if (allocated(error)) return
      what = " of "//text(segments)//" segments over the known one"
      associate (inner => power(4:size(power) - 2), level => 2.0_wp*interval*variance(signal))
         call expect_close(error, sum(inner)/size(inner)/level, 1.0_wp, 0.02_wp, "level"//what)
         call expect_close(error, sqrt(variance(inner))/level/scatter, 1.0_wp, 0.05_wp, &
                           "scatter"//what)
         call expect_close(error, sum(inner(:size(inner)/4))/(size(inner)/4)/level, 1.0_wp, &
                           0.05_wp, "level of the lowest quarter"//what)
      end associate
   end subroutine expect_noise

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

   !> A spectrum that must not fail.
   subroutine spectrum_of(error, signal, interval, window_name, segments, overlap, frequency, power)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: signal(:), interval, overlap
      character(len=*), intent(in) :: window_name
      integer, intent(in) :: segments
      real(wp), allocatable, intent(out) :: frequency(:), power(:)
      type(failure_type), allocatable :: failure

      call power_spectrum(signal, interval, window_name, segments, overlap, frequency, power, &
                          failure)
      call expect_success(error, failure)
      call expect(error, size(frequency) == size(power), "a frequency for each power")
   end subroutine spectrum_of

   !> Mean square of the distance to the mean.
   pure real(wp) function variance(x) result(value)
      real(wp), intent(in) :: x(:)

      value = sum((x - sum(x)/size(x))**2)/size(x)
   end function variance
end module test_spectrum
