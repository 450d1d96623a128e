! SPDX-License-Identifier: BSD-3-Clause
!> Peaks of a power spectrum: where they are and how high.
module spectral_peaks
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: base_peak, combination_peak, find_peaks, harmonic_peak, other_peak, peak_type
   public :: second_base_peak

   !> What a peak is: f1, m f1, f2, m f1 + n f2 with n /= 0, or none of these.
   enum, bind(c)
      enumerator :: base_peak, harmonic_peak, second_base_peak, combination_peak, other_peak
   end enum

   !> Bins on either side of a peak that show the background: beyond the main lobe of a line through
   !> a Hann window.
   integer, parameter :: nearest_beside = 3, farthest_beside = 8

   !> One peak.
   type :: peak_type
      !> Bin of the local maximum
      integer :: bin = 0
      !> Interpolated frequency
      real(wp) :: frequency = 0.0_wp
      !> Interpolated height
      real(wp) :: power = 0.0_wp
      !> Power of what lies beside it, over its height
      real(wp) :: background = 0.0_wp
      !> base_peak, harmonic_peak, second_base_peak, combination_peak or other_peak
      integer :: kind = other_peak
      !> m and n in m f1 + n f2; 0 and 0 for other peaks
      integer :: multiple(2) = 0
   end type peak_type

contains

   !> Local maxima that stand out: above `floor` times the highest, and above both valleys that part
   !> them from higher ground by the factor `prominence`.
   pure function find_peaks(frequency, power, floor, prominence) result(peaks)
      !> Frequencies, evenly spaced from 0; power spectral density
      real(wp), intent(in) :: frequency(:), power(:)
      !> Least height over the highest peak's, > 0
      real(wp), intent(in) :: floor
      !> Least height over the higher of the two valleys, >= 1
      real(wp), intent(in) :: prominence
      type(peak_type), allocatable :: peaks(:)
      real(wp) :: highest, valley
      integer :: i

      allocate (peaks(0))
      highest = maxval(power(2:))
      do i = 3, size(power) - 1
         if (power(i) <= power(i - 1) .or. power(i) < power(i + 1)) cycle
         if (power(i) < floor*highest) cycle
         valley = max(valley_beside(power, i, -1), valley_beside(power, i, 1))
         if (power(i) < prominence*valley) cycle
         peaks = [peaks, interpolated_peak(frequency, power, i)]
      end do
   end function find_peaks

   !> Lowest power between bin i and the next higher ground in one direction (or the end).
   pure real(wp) function valley_beside(power, i, direction) result(valley)
      real(wp), intent(in) :: power(:)
      integer, intent(in) :: i, direction
      integer :: j

      valley = power(i)
      j = i + direction
      do while (j >= 2 .and. j <= size(power))
         if (power(j) > power(i)) exit
         valley = min(valley, power(j))
         j = j + direction
      end do
   end function valley_beside

   !> Frequency and height of a line through a Hann window, exactly, from the amplitudes in three
   !> bins: x bins beside the middle one they are as (1 - x)(2 - x), 4 - x**2 and (1 + x)(2 + x),
   !> the middle one being sin(pi x)/(pi x (1 - x**2)) of the height's.
   pure type(peak_type) function interpolated_peak(frequency, power, i) result(peak)
      real(wp), intent(in) :: frequency(:), power(:)
      integer, intent(in) :: i
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: amplitudes(3), lobe, shift

      amplitudes = sqrt(power(i - 1:i + 1))
      shift = 2.0_wp*(amplitudes(3) - amplitudes(1)) &
              /(amplitudes(1) + 2.0_wp*amplitudes(2) + amplitudes(3))
      lobe = 1.0_wp/(1.0_wp - shift**2)
      if (abs(shift) > sqrt(epsilon(shift))) lobe = lobe*sin(pi*shift)/(pi*shift)
      peak%bin = i
      peak%frequency = frequency(i) + shift*(frequency(2) - frequency(1))
      peak%power = power(i)/lobe**2
      peak%background = background_beside(power, i)/peak%power
   end function interpolated_peak

   !> Lowest power on the side of a peak where that is higher.
   pure real(wp) function background_beside(power, i) result(background)
      real(wp), intent(in) :: power(:)
      integer, intent(in) :: i
      real(wp) :: above, below

      associate (last => size(power))
         above = minval(power(min(last, i + nearest_beside):min(last, i + farthest_beside)))
      end associate
      below = minval(power(max(2, i - farthest_beside):max(2, i - nearest_beside)))
      background = min(power(i), max(above, below))
   end function background_beside
end module spectral_peaks
