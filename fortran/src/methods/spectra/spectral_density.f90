! SPDX-License-Identifier: BSD-3-Clause
!> Power spectral density after Welch (1967): segments that overlap, windowed, transformed by FFTW,
!> averaged. One-sided, normalised so that its integral over frequency is the variance.
module spectral_density
   use dde_errors, only: error_type, raise, text
   use fourier_transform, only: transform_real
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
      complex(wp), allocatable :: transform(:)
      real(wp), allocatable :: window(:)
      real(wp) :: mean
      integer :: first, i, length, segment

      length = int(size(signal)/(1.0_wp + (segments - 1)*(1.0_wp - overlap)))
      if (length < fewest_samples) then
         call raise(error, "power_spectrum: "//text(size(signal))//" samples make " &
                    //text(segments)//" segments of "//text(length)//"; at least " &
                    //text(fewest_samples)//" expected")
         return
      end if
      allocate (transform(length/2 + 1), power(length/2 + 1))
      window = window_of(window_name, length)
      mean = sum(signal)/size(signal)
      power = 0.0_wp
      do segment = 0, segments - 1
         first = nint(segment*(1.0_wp - overlap)*length)
         first = min(first, size(signal) - length)
         call transform_real(window*(signal(first + 1:first + length) - mean), transform)
         power = power + real(transform)**2 + aimag(transform)**2
      end do
      power = power*interval/(sum(window**2)*segments)
      ! one side holds both, but for zero and the Nyquist frequency
      power(2:(length + 1)/2) = 2.0_wp*power(2:(length + 1)/2)
      frequency = [(i/(length*interval), i=0, length/2)]
   end subroutine power_spectrum
end module spectral_density
