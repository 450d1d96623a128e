! SPDX-License-Identifier: BSD-3-Clause
!> One or two fundamental frequencies that explain the peaks of a spectrum as harmonics and
!> combinations.
!>
!> Frequencies are matched within what is known of them, and only as long as frequencies drawn at
!> random would rarely match: denominators of fractions and orders of combinations are bounded by
!> that chance, not by a fixed number.
module base_frequencies
   use dde_kinds, only: wp
   use spectral_peaks, only: base_peak, combination_peak, harmonic_peak, other_peak, peak_type, &
                             second_base_peak
   implicit none (type, external)
   private
   public :: bases_type, descending, label_peaks

   !> Error of a line's frequency in bins where there is no background; a background adds as many
   !> bins as its amplitude over the line's.
   real(wp), parameter :: bins_of_interpolation = 0.005_wp
   !> Least distance of two lines that are both resolved, in bins.
   real(wp), parameter :: bins_apart = 1.0_wp
   !> Chance that a random frequency is a fraction of the base: up to the first value the two have
   !> one common base, up to the second it is undecided.
   real(wp), parameter :: chance_sure = 0.02_wp, chance_open = 0.1_wp
   !> Chance that a random frequency is a combination, for each second base tried.
   real(wp), parameter :: chance_of_combination = 0.03_wp
   !> Bounds of orders and denominators in the search.
   integer, parameter :: highest_order = 40, highest_denominator = 1000
   !> Peaks tried as second base, and peaks that a lower one must explain beyond a higher one's.
   integer, parameter :: most_tried = 8, least_gain = 2
   real(wp), parameter :: pi = acos(-1.0_wp)

   !> The fundamental frequencies behind the labels.
   type :: bases_type
      !> f1 and f2; 0 if it does not exist
      real(wp) :: frequency(2) = 0.0_wp
      !> Largest |m| + |n| of a combination
      integer :: order = 0
      !> p and q of the simplest fraction that f2/f1 equals within the accuracy; 0 without an
      !> f2
      integer :: ratio(2) = 0
      !> Whether f2 is certainly neither a simple fraction of f1 nor merged with a multiple of it
      logical :: told_apart = .true.
   end type bases_type

   !> A frequency and how far it may be off.
   type :: known_type
      !> The frequency
      real(wp) :: frequency = 0.0_wp
      !> Largest error of the frequency
      real(wp) :: accuracy = 0.0_wp
   end type known_type

contains

   !> Label all peaks. f1 is the highest peak, or the common base of it and of the next ones, from
   !> the highest down, that are simple fractions of it (no peak need be there). f2 is the highest
   !> peak that is no multiple of f1, or a lower one with which at least two more peaks are
   !> explained (one more may be chance): a peak such as f1 + 2 f2 would leave out f1 + f2.
   pure subroutine label_peaks(peaks, resolution, bases)
      !> Peaks, frequency ascending
      type(peak_type), intent(inout) :: peaks(:)
      !> Width of a bin
      real(wp), intent(in) :: resolution
      !> Fundamental frequencies of the peaks
      type(bases_type), intent(out) :: bases
      type(known_type) :: lines(size(peaks)), first, second
      integer :: ranked(size(peaks)), i, m

      if (size(peaks) == 0) return
      lines%frequency = peaks%frequency
      lines%accuracy = (bins_of_interpolation + sqrt(peaks%background))*resolution
      ranked = descending(peaks%power)
      first = common_base(lines(ranked))
      bases%frequency(1) = first%frequency
      call find_second(lines(ranked), first, resolution, second, bases)
      do i = 1, size(peaks)
         m = multiple_of(lines(i), first)
         if (m > 0) then
            peaks(i)%multiple = [m, 0]
            peaks(i)%kind = merge(base_peak, harmonic_peak, m == 1)
         else
            peaks(i)%multiple = combination_of(lines(i), first, second, bases%order)
            peaks(i)%kind = merge(combination_peak, other_peak, any(peaks(i)%multiple /= 0))
            if (all(peaks(i)%multiple == [0, 1])) peaks(i)%kind = second_base_peak
         end if
      end do
   end subroutine label_peaks

   !> Indices from the largest value to the smallest.
   pure function descending(values) result(order)
      !> Values
      real(wp), intent(in) :: values(:)
      integer :: order(size(values))
      logical :: left(size(values))
      integer :: i

      left = .true.
      do i = 1, size(values)
         order(i) = maxloc(values, dim=1, mask=left)
         left(order(i)) = .false.
      end do
   end function descending

   !> The greatest frequency of which the highest line and those that follow are multiples, up to
   !> the first that is no simple fraction.
   pure type(known_type) function common_base(lines) result(base)
      type(known_type), intent(in) :: lines(:)
      integer :: i, q

      base = lines(1)
      do i = 2, size(lines)
         q = denominator(lines(i), base, most_parts(lines(i), base, chance_sure))
         if (q == 0) exit
         base = known_type(base%frequency/q, base%accuracy/q)
      end do
   end function common_base

   !> Choose the second base and the order up to which it combines with the first.
   pure subroutine find_second(lines, first, resolution, second, bases)
      type(known_type), intent(in) :: lines(:), first
      real(wp), intent(in) :: resolution
      !> Second base; frequency 0 where all lines are multiples of the first
      type(known_type), intent(out) :: second
      type(bases_type), intent(inout) :: bases
      real(wp) :: misfit
      integer :: explained, i, most_explained, order, q, tried

      most_explained = -least_gain
      tried = 0
      do i = 1, size(lines)
         if (multiple_of(lines(i), first) > 0) cycle
         tried = tried + 1
         if (tried > most_tried) exit
         order = most_order(lines, first, lines(i))
         explained = count_explained(lines, first, lines(i), order)
         if (explained < most_explained + least_gain) cycle
         most_explained = explained
         second = lines(i)
         bases%order = order
      end do
      if (tried == 0) return
      bases%frequency(2) = second%frequency
      q = denominator(second, first, highest_denominator)
      if (q > 0) bases%ratio = [nint(q*second%frequency/first%frequency), q]
      ! distance from the nearest multiple of the first base
      misfit = abs(second%frequency &
                   - max(1, nint(second%frequency/first%frequency))*first%frequency)
      bases%told_apart = denominator(second, first, most_parts(second, first, chance_open)) == 0 &
                         .and. misfit >= bins_apart*resolution
   end subroutine find_second

   !> How many lines two bases explain.
   pure integer function count_explained(lines, first, second, order) result(explained)
      type(known_type), intent(in) :: lines(:), first, second
      integer, intent(in) :: order
      integer :: i

      explained = 0
      do i = 1, size(lines)
         if (multiple_of(lines(i), first) > 0) then
            explained = explained + 1
         else if (any(combination_of(lines(i), first, second, order) /= 0)) then
            explained = explained + 1
         end if
      end do
   end function count_explained

   !> m when the line lies at m times the base within the accuracy of both, otherwise 0.
   pure integer function multiple_of(line, base) result(m)
      type(known_type), intent(in) :: line, base

      m = nint(line%frequency/base%frequency)
      if (abs(line%frequency - m*base%frequency) > line%accuracy + m*base%accuracy) m = 0
   end function multiple_of

   !> Smallest q for which the line lies at p/q times the base with a whole p, 0 if q > `most`.
   pure integer function denominator(line, base, most) result(q)
      type(known_type), intent(in) :: line, base
      integer, intent(in) :: most
      integer :: i

      q = 0
      do i = 1, most
         if (multiple_of(line, known_type(base%frequency/i, base%accuracy/i)) == 0) cycle
         q = i
         return
      end do
   end function denominator

   !> Largest denominator up to which a random frequency is a fraction of the base with this chance
   !> at most: about 3 (q/pi)**2 fractions with denominators up to q lie in a unit interval.
   pure integer function most_parts(line, base, chance) result(q)
      type(known_type), intent(in) :: line, base
      real(wp), intent(in) :: chance
      real(wp) :: width

      width = 2.0_wp*(line%accuracy/base%frequency &
                      + line%frequency*base%accuracy/base%frequency**2)
      ! at the least a multiple is recognised
      q = max(1, min(highest_denominator, int(pi*sqrt(chance/(3.0_wp*width)))))
   end function most_parts

   !> Largest |m| + |n| up to which combinations cover so little of the range of the lines that a
   !> random frequency rarely is one.
   pure integer function most_order(lines, first, second) result(order)
      type(known_type), intent(in) :: lines(:), first, second
      real(wp) :: covered, frequency, range, typical
      integer :: m, n, side, total

      range = maxval(lines%frequency)
      typical = sum(lines%accuracy)/size(lines)
      covered = 0.0_wp
      order = 1
      do total = 1, highest_order
         do n = -total, total
            if (n == 0) cycle
            do side = -1, 1, 2
               m = side*(total - abs(n))
               if (m == 0 .and. side == 1) cycle
               frequency = m*first%frequency + n*second%frequency
               if (frequency <= 0.0_wp .or. frequency > range) cycle
               covered = covered + 2.0_wp*(typical + abs(m)*first%accuracy &
                                           + abs(n)*second%accuracy)
            end do
         end do
         if (covered > chance_of_combination*range) return
         order = total
      end do
   end function most_order

   !> m and n with n /= 0 when the line lies at m times the first base plus n times the second, the
   !> smallest |m| + |n|; otherwise 0 and 0.
   pure function combination_of(line, first, second, order) result(multiple)
      type(known_type), intent(in) :: line, first, second
      integer, intent(in) :: order
      integer :: multiple(2)
      real(wp) :: best, misfit
      integer :: least, m, n, nearest

      multiple = 0
      least = order
      best = 1.0_wp
      do n = -order, order
         if (n == 0) cycle
         ! no other multiples of the first base come near
         nearest = nint((line%frequency - n*second%frequency)/first%frequency)
         do m = nearest - 1, nearest + 1
            if (abs(m) + abs(n) > least) cycle
            misfit = abs(line%frequency - m*first%frequency - n*second%frequency) &
                     /(line%accuracy + abs(m)*first%accuracy + abs(n)*second%accuracy)
            if (misfit > merge(best, 1.0_wp, abs(m) + abs(n) == least)) cycle
            least = abs(m) + abs(n)
            best = misfit
            multiple = [m, n]
         end do
      end do
   end function combination_of
end module base_frequencies
