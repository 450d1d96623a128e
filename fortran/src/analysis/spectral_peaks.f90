!> Peaks of a power spectrum and what each is: the base frequency, a harmonic of it, or another.
module spectral_peaks
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: base_peak, find_peaks, harmonic_peak, is_periodic, label_peaks, line_share, other_peak
   public :: peak_type

   !> What a peak is.
   enum, bind(c)
      enumerator :: base_peak, harmonic_peak, other_peak
   end enum

   !> A peak is the m-th multiple of the base frequency within this many bins, and as many more per
   !> m as interpolation may have misplaced the base.
   real(wp), parameter :: bins_of_a_multiple = 0.5_wp, bins_of_the_base = 0.02_wp
   !> Half width, in bins, of a line through a Hann window.
   integer, parameter :: line_half_width = 4

   !> Share of the power that the lines of a periodic signal hold at least.
   real(wp), parameter :: periodic_share = 0.99_wp

   !> One peak.
   type :: peak_type
      !> Bin of the local maximum
      integer :: bin = 0
      !> Interpolated frequency
      real(wp) :: frequency = 0.0_wp
      !> Interpolated height
      real(wp) :: power = 0.0_wp
      !> base_peak, harmonic_peak or other_peak
      integer :: kind = other_peak
      !> Multiple of the base frequency; 0 for other peaks
      integer :: multiple = 0
   end type peak_type

contains

   !> Local maxima that stand out: above `floor` times the highest, and above both valleys that part
   !> them from higher ground by the factor `prominence`.
   pure function find_peaks(frequency, power, floor, prominence) result(peaks)
      !> Frequencies, evenly spaced from 0
      real(wp), intent(in) :: frequency(:)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
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
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Bin of the peak
      integer, intent(in) :: i
      !> -1 or 1
      integer, intent(in) :: direction
      integer :: j

      valley = power(i)
      j = i + direction
      do while (j >= 2 .and. j <= size(power))
         if (power(j) > power(i)) exit
         valley = min(valley, power(j))
         j = j + direction
      end do
   end function valley_beside

   !> Vertex of the parabola through the logarithms of three bins, which is where a line through a
   !> Hann window peaks to about a hundredth of a bin (Gasior and Gonzalez 2004).
   pure type(peak_type) function interpolated_peak(frequency, power, i) result(peak)
      !> Frequencies
      real(wp), intent(in) :: frequency(:)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Bin of the maximum
      integer, intent(in) :: i
      real(wp) :: bins(3), bend, shift

      peak%bin = i
      bins = log(max(power(i - 1:i + 1), tiny(1.0_wp)))
      bend = bins(1) - 2.0_wp*bins(2) + bins(3)
      shift = 0.0_wp
      if (bend < 0.0_wp) shift = 0.5_wp*(bins(1) - bins(3))/bend
      peak%frequency = frequency(i) + shift*(frequency(2) - frequency(1))
      peak%power = exp(bins(2) - 0.25_wp*(bins(1) - bins(3))*shift)
   end function interpolated_peak

   !> Label all peaks. The base is the highest peak, or the lowest peak of which that one is a
   !> multiple.
   pure subroutine label_peaks(peaks, resolution)
      !> Peaks, frequency ascending
      type(peak_type), intent(inout) :: peaks(:)
      !> Width of a bin
      real(wp), intent(in) :: resolution
      integer :: base, highest, i

      if (size(peaks) == 0) return
      highest = maxloc(peaks%power, dim=1)
      do base = 1, highest
         if (multiple_of(peaks(highest)%frequency, peaks(base)%frequency, resolution) > 0) exit
      end do
      do i = 1, size(peaks)
         peaks(i)%multiple = multiple_of(peaks(i)%frequency, peaks(base)%frequency, resolution)
         peaks(i)%kind = merge(harmonic_peak, other_peak, peaks(i)%multiple > 0)
      end do
      peaks(base)%kind = base_peak
   end subroutine label_peaks

   !> m when frequency = m base within the resolution, otherwise 0.
   pure integer function multiple_of(frequency, base, resolution) result(m)
      !> Frequency in question
      real(wp), intent(in) :: frequency
      !> Base frequency
      real(wp), intent(in) :: base
      !> Width of a bin
      real(wp), intent(in) :: resolution

      m = nint(frequency/base)
      if (abs(frequency - m*base) > (bins_of_a_multiple + bins_of_the_base*m)*resolution) m = 0
   end function multiple_of

   !> Share of the power that lies in the lines at the base frequency and its multiples.
   pure real(wp) function line_share(power, peaks) result(share)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Labelled peaks
      type(peak_type), intent(in) :: peaks(:)
      logical :: in_line(size(power))
      integer :: i

      in_line = .false.
      do i = 1, size(peaks)
         if (peaks(i)%kind == other_peak) cycle
         in_line(max(1, peaks(i)%bin - line_half_width): &
                 min(size(power), peaks(i)%bin + line_half_width)) = .true.
      end do
      share = 0.0_wp
      if (sum(power) > 0.0_wp) share = sum(power, mask=in_line)/sum(power)
   end function line_share

   !> Whether the spectrum is one of a periodic signal: a base frequency, harmonics, nothing else.
   pure logical function is_periodic(peaks, share) result(value)
      !> Labelled peaks
      type(peak_type), intent(in) :: peaks(:)
      !> Share of the power in their lines
      real(wp), intent(in) :: share

      value = any(peaks%kind == base_peak) .and. .not. any(peaks%kind == other_peak) &
                    .and. share >= periodic_share
   end function is_periodic
end module spectral_peaks
