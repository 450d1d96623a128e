! SPDX-License-Identifier: BSD-3-Clause
!> Whether a spectrum consists of lines of one fundamental frequency, of two, or of a continuum.
module spectrum_verdict
   use base_frequencies, only: bases_type
   use dde_kinds, only: wp
   use spectral_peaks, only: base_peak, combination_peak, harmonic_peak, other_peak, peak_type, &
                             second_base_peak
   implicit none (type, external)
   private
   public :: continuum, continuum_share, line_share, no_spectrum, one_base, spectrum_kind
   public :: spectrum_kind_name, two_bases, undecided_spectrum

   !> Kinds of spectra.
   enum, bind(c)
      enumerator :: one_base, two_bases, continuum, undecided_spectrum, no_spectrum
   end enum

   !> Half width, in bins, of a line through a Hann window, and what it holds over its height.
   integer, parameter :: line_half_width = 4
   real(wp), parameter :: bins_of_a_line = 1.5_wp

   !> Least share of the power in the lines that the bases explain.
   real(wp), parameter :: least_in_lines = 0.999_wp
   !> Shares of the power up to which lines of a second base and unexplained lines do not count:
   !> what a transient may leave, and combinations of high order.
   real(wp), parameter :: negligible_second = 1.0e-5_wp, negligible_others = 1.0e-4_wp
   !> Least share of the power off all lines in a continuum.
   real(wp), parameter :: least_in_continuum = 0.02_wp

contains

   !> A spectrum is periodic if the explained lines hold at least 99.9 % of the power, all others
   !> at most 1e-4, and those of f2 at most 1e-5; quasiperiodic if those of f2 hold more and f2 is
   !> no fraction of f1; a continuum if 2 % is outside all lines. Without power no_spectrum, else
   !> undecided_spectrum.
   pure integer function spectrum_kind(power, peaks, bases) result(kind)
      real(wp), intent(in) :: power(:)
      !> Labelled peaks, frequency ascending
      type(peak_type), intent(in) :: peaks(:)
      type(bases_type), intent(in) :: bases
      real(wp) :: first, others, second

      first = share_of(power, peaks, [base_peak, harmonic_peak])
      second = share_of(power, peaks, [second_base_peak, combination_peak])
      others = share_of(power, peaks, [other_peak])
      kind = undecided_spectrum
      if (.not. sum(power) > 0.0_wp) then
         kind = no_spectrum
      else if (continuum_share(power, peaks) >= least_in_continuum) then
         kind = continuum
      else if (others <= negligible_others .and. first + second >= least_in_lines) then
         if (second <= negligible_second) then
            kind = one_base
         else if (bases%told_apart) then
            kind = two_bases
         end if
      end if
   end function spectrum_kind

   !> Name of a kind.
   pure function spectrum_kind_name(kind) result(name)
      !> one_base, two_bases, continuum, undecided_spectrum or no_spectrum
      integer, intent(in) :: kind
      character(len=:), allocatable :: name
      character(len=13), parameter :: names(0:4) = [character(len=13) :: &
                                                   "periodic", "quasiperiodic", "continuum", &
                                                   "undecided", "none"]

      name = trim(names(kind))
   end function spectrum_kind_name

   !> Share of the power in the lines that the bases explain.
   pure real(wp) function line_share(power, peaks) result(share)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Labelled peaks, frequency ascending
      type(peak_type), intent(in) :: peaks(:)

      share = share_of(power, peaks, [base_peak, harmonic_peak, second_base_peak, combination_peak])
   end function line_share

   !> Share of the power outside the lines of all peaks, whatever they are.
   pure real(wp) function continuum_share(power, peaks) result(share)
      !> Power spectral density
      real(wp), intent(in) :: power(:)
      !> Peaks, frequency ascending
      type(peak_type), intent(in) :: peaks(:)

      real(wp) :: total

      total = sum(power)
      share = 0.0_wp
      if (total > 0.0_wp) share = max(0.0_wp, 1.0_wp - sum(line_powers(power, peaks))/total)
   end function continuum_share

   !> Share of the power in the lines of these kinds.
   pure real(wp) function share_of(power, peaks, kinds) result(share)
      real(wp), intent(in) :: power(:)
      !> Labelled peaks, frequency ascending
      type(peak_type), intent(in) :: peaks(:)
      integer, intent(in) :: kinds(:)
      real(wp) :: held(size(peaks))
      integer :: i

      held = line_powers(power, peaks)
      share = 0.0_wp
      if (sum(power) > 0.0_wp) share = sum([(sum(held, mask=peaks%kind == kinds(i)), &
                                             i=1, size(kinds))])/sum(power)
   end function share_of

   !> Power, in bins, that the line of each peak holds: what belongs to its height, but of lines so
   !> close that they share bins not more than there is. A broad peak holds more than its line.
   pure function line_powers(power, peaks) result(held)
      real(wp), intent(in) :: power(:)
      !> Peaks, frequency ascending
      type(peak_type), intent(in) :: peaks(:)
      real(wp) :: held(size(peaks))
      real(wp) :: there
      integer :: first, last

      held = bins_of_a_line*peaks%power
      first = 1
      do while (first <= size(peaks))
         last = first
         do while (last < size(peaks))
            if (peaks(last + 1)%bin - peaks(last)%bin > 2*line_half_width) exit
            last = last + 1
         end do
         there = sum(power(max(1, peaks(first)%bin - line_half_width): &
                           min(size(power), peaks(last)%bin + line_half_width)))
         held(first:last) = held(first:last)*min(1.0_wp, there/sum(held(first:last)))
         first = last + 1
      end do
   end function line_powers
end module spectrum_verdict
