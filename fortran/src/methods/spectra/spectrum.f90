!> Power spectral density after Welch (1967): segments that overlap, windowed, transformed by FFTW,
!> averaged. One-sided, normalised so that its integral over frequency is the variance.
module spectrum
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_ptr
   use dde_errors, only: error_type, raise, text
   use fftw, only: fftw_destroy_plan, fftw_estimate, fftw_execute_dft_r2c, fftw_plan_dft_r2c_1d
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: power_spectrum, window_of

   !> Fewest samples in a segment.
   integer, parameter :: fewest_samples = 16

contains

   !> Window values, periodic: 'hann' or 'boxcar'.
   pure function window_of(name, n) result(window)
      !> Name of the window
      character(len=*), intent(in) :: name
      !> Samples in a segment
      integer, intent(in) :: n
      real(wp) :: window(n)
      real(wp), parameter :: pi = acos(-1.0_wp)
      integer :: i

      window = 1.0_wp
      if (name == "hann") window = [(sin(pi*i/n)**2, i=0, n - 1)]
   end function window_of

   !> Spectrum of `signal`, its mean removed; the mean of `segments` segments.
   subroutine power_spectrum(signal, interval, window_name, segments, overlap, frequency, power, &
                             error)
      !> Samples, time between them
      real(wp), intent(in) :: signal(:), interval
      !> 'hann' or 'boxcar'
      character(len=*), intent(in) :: window_name
      !> Number of segments, >= 1
      integer, intent(in) :: segments
      !> Share of a segment that the next one repeats, 0 <= overlap < 1
      real(wp), intent(in) :: overlap
      !> Frequencies 0..1/(2 interval), cycles per unit of time
      real(wp), allocatable, intent(out) :: frequency(:)
      !> Power spectral density there, square of the signal's unit times unit of time
      real(wp), allocatable, intent(out) :: power(:)
      !> Too few samples
      type(error_type), allocatable, intent(out) :: error
      real(c_double), allocatable :: windowed(:)
      complex(c_double_complex), allocatable :: transform(:)
      real(wp), allocatable :: window(:)
      type(c_ptr) :: plan
      real(wp) :: mean
      integer :: first, i, length, segment

      length = int(size(signal)/(1.0_wp + (segments - 1)*(1.0_wp - overlap)))
      if (length < fewest_samples) then
         call raise(error, "power_spectrum: "//text(size(signal))//" samples make " &
                    //text(segments)//" segments of "//text(length)//"; at least " &
                    //text(fewest_samples)//" expected")
         return
      end if
      allocate (windowed(length), transform(length/2 + 1), power(length/2 + 1))
      ! only the execution of plans is safe among threads
      !$omp critical (fftw_planning)
      plan = fftw_plan_dft_r2c_1d(length, windowed, transform, fftw_estimate)
      !$omp end critical (fftw_planning)
      window = window_of(window_name, length)
      mean = sum(signal)/size(signal)
      power = 0.0_wp
      do segment = 0, segments - 1
         first = nint(segment*(1.0_wp - overlap)*length)
         first = min(first, size(signal) - length)
         windowed = window*(signal(first + 1:first + length) - mean)
         call fftw_execute_dft_r2c(plan, windowed, transform)
         power = power + real(transform)**2 + aimag(transform)**2
      end do
      !$omp critical (fftw_planning)
      call fftw_destroy_plan(plan)
      !$omp end critical (fftw_planning)
      power = power*interval/(sum(window**2)*segments)
      ! one side holds both, but for zero and the Nyquist frequency
      power(2:(length + 1)/2) = 2.0_wp*power(2:(length + 1)/2)
      frequency = [(i/(length*interval), i=0, length/2)]
   end subroutine power_spectrum
end module spectrum
