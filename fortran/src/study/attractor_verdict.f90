! SPDX-License-Identifier: BSD-3-Clause
!> The class of an attractor by its observation: by Lyapunov exponents, confirmed by a Poincare
!> section and by the spectrum of the signal.
module attractor_verdict
   use base_frequencies, only: bases_type, descending, label_peaks
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use exponent_averages, only: average_growth, exponent_type
   use lyapunov_spectrum, only: growth_type
   use motion_classes, only: agree, chaos, class_by_exponents, clear_by_exponents, &
                             cycle_motion, fixed_point, no_class_by_exponents, none, &
                             three_torus, torus, undecided
   use observed_motion, only: observed_motion_type
   use section_motion, only: find_third_phase, not_measured, period_of_tail, section_roughness, &
                             torus_roughness
   use spectral_peaks, only: find_peaks, other_peak, peak_type
   use spectral_density, only: power_spectrum
   use spectrum_verdict, only: continuum, line_share, one_base, spectrum_kind, two_bases
   use value_checks, only: missing, missing_count
   implicit none (type, external)
   private
   public :: attractor_settings_type, attractor_type, is_at_rest, judge, on_cycle, settle

   !> A motion is at rest whose signal changes by less than this share.
   real(wp), parameter :: least_range = 1.0e-9_wp

   !> How an attractor is found and judged; all of it must be given.
   type :: attractor_settings_type
      !> Longest time of the approach, left out
      real(wp) :: t_transient = missing
      !> Time in which it is first observed, and exponents are measured
      real(wp) :: t_observed = missing
      !> Time for which chaos must last after it is certain
      real(wp) :: t_lasting = missing
      !> Time in which tangent vectors turn before
      real(wp) :: t_turning = missing
      !> Time on the attractor of which the path is kept; 0: none is
      real(wp) :: t_path = missing
      !> Longest time between orthonormalisations
      real(wp) :: interval = missing
      !> Number of exponents; four if all of fewer are zero, without delay no more than equations
      integer :: exponents = missing_count
      !> An exponent this close to zero has no sign
      real(wp) :: zero_level = missing
      !> Longest error bar of a zero exponent
      real(wp) :: longest_bar = missing
      !> How often that time is doubled while the class is undecided
      integer :: doublings = missing_count
      !> Time between the samples of the spectrum
      real(wp) :: sample_interval = missing
      !> Window of the spectrum, of `window_of`
      character(len=16) :: window = ""
      !> Number of its segments, and the share of one that the next repeats
      integer :: segments = missing_count
      real(wp) :: overlap = missing
      !> Least height of its peaks over the highest, and over the valleys beside them
      real(wp) :: peak_floor = missing, peak_prominence = missing
   end type attractor_settings_type

   !> An attractor.
   type :: attractor_type
      !> Classes, of `motion_classes`
      integer :: class = undecided, by_exponents = undecided, by_section = undecided
      integer :: by_spectrum = undecided
      !> Why the class is undecided, of `motion_classes`
      integer :: reason = none
      !> Time after which the class was certain, or the limit
      real(wp) :: time = 0.0_wp
      !> Leading exponents, descending
      type(exponent_type), allocatable :: exponents(:)
      !> Points after which a cycle repeats in the section, 0 if none
      integer :: period = 0
      !> Roughness of the section as a function of two phases, of three on a 3-torus, see
      !> `section_roughness`
      real(wp) :: roughness = not_measured
      !> Fundamental frequencies of the signal, 0 if none
      real(wp) :: bases(3) = 0.0_wp
      !> Share of the power of the signal in the lines of these, or `not_measured`
      real(wp) :: line_share = not_measured
      !> Observation of the motion
      type(observed_motion_type) :: motion
      !> A piece of it to be drawn, see `follow_path`; none of rest
      real(wp), allocatable :: path(:, :)
   end type attractor_type

contains

   !> The class by the observation so far. The spectrum is computed where it matters.
   subroutine judge(settings, measured, flow, last, attractor, error)
      !> How an attractor is judged
      type(attractor_settings_type), intent(in) :: settings
      !> Growth of the vectors
      type(growth_type), intent(in) :: measured
      !> Whether one more exponent is that of the flow, which is 0
      logical, intent(in) :: flow
      !> Whether this is the last judgement
      logical, intent(in) :: last
      type(attractor_type), intent(inout) :: attractor
      !> Too few samples
      type(error_type), allocatable, intent(out) :: error
      type(peak_type), allocatable :: peaks(:)
      logical :: clear

      attractor%exponents = average_growth(measured%growth, measured%length, batches=1, flow=flow)
      attractor%by_exponents = class_by_exponents(attractor%exponents, settings%zero_level, &
                                                  settings%longest_bar)
      clear = clear_by_exponents(attractor%exponents, sum(measured%length))
      attractor%by_section = undecided
      attractor%by_spectrum = undecided
      attractor%roughness = not_measured
      attractor%bases = 0.0_wp
      attractor%line_share = not_measured
      attractor%reason = no_class_by_exponents
      if (attractor%by_exponents == undecided .and. .not. last) return
      if (is_at_rest(attractor%motion) .and. attractor%by_exponents /= chaos) then
         call settle(attractor)
         return
      end if
      associate (motion => attractor%motion)
         attractor%period = period_of_tail(motion%section, motion%scale(), &
                                           on_the_way=attractor%by_exponents == cycle_motion)
         if (attractor%period > 0) then
            attractor%by_section = cycle_motion
            associate (time => motion%section_time, n => size(motion%section_time))
               attractor%bases = [1.0_wp/(time(n) - time(n - attractor%period)), 0.0_wp, 0.0_wp]
            end associate
         else if (.not. clear) then
            call judge_spectrum(motion%signal_shown(), settings, attractor, peaks, error)
            if (allocated(error)) return
            attractor%roughness = section_roughness(motion%section, motion%section_time, &
                                                    motion%scale(), attractor%bases(:2))
            if (attractor%roughness >= 0.0_wp .and. attractor%roughness <= torus_roughness) then
               attractor%by_section = torus
            end if
            if (attractor%by_exponents == three_torus) call look_for_third(peaks, attractor)
         end if
      end associate
      call agree(attractor%by_exponents, clear, attractor%by_section, attractor%by_spectrum, &
                 attractor%class, attractor%reason)
   end subroutine judge

   !> Whether the signal has not changed in the second half of the observation: the model has come
   !> to another state of rest than that of its definition.
   pure logical function is_at_rest(motion) result(value)
      type(observed_motion_type), intent(in) :: motion

      real(wp), allocatable :: signal(:)

      signal = motion%signal_shown()
      signal = signal(1 + size(signal)/2:)
      value = size(signal) > 0
      if (value) value = maxval(abs(signal - signal(1))) &
                         <= least_range*max(motion%unit, abs(signal(1)))
   end function is_at_rest

   !> Give a motion the class of a fixed point.
   subroutine settle(attractor)
      type(attractor_type), intent(inout) :: attractor

      attractor%class = fixed_point
      attractor%by_exponents = fixed_point
      attractor%by_section = fixed_point
      attractor%by_spectrum = fixed_point
      attractor%reason = none
      attractor%period = 0
   end subroutine settle

   !> The class by the lines in the spectrum of the signal.
   subroutine judge_spectrum(signal, settings, attractor, peaks, error)
      real(wp), intent(in) :: signal(:)
      type(attractor_settings_type), intent(in) :: settings
      type(attractor_type), intent(inout) :: attractor
      type(peak_type), allocatable, intent(out) :: peaks(:)
      type(error_type), allocatable, intent(out) :: error
      type(bases_type) :: bases
      real(wp), allocatable :: frequency(:), power(:)

      call power_spectrum(signal, settings%sample_interval, trim(settings%window), &
                          settings%segments, settings%overlap, frequency, power, error)
      if (allocated(error)) return
      peaks = find_peaks(frequency, power, settings%peak_floor, settings%peak_prominence)
      call label_peaks(peaks, frequency(2), bases)
      attractor%bases(:2) = bases%frequency
      attractor%line_share = line_share(power, peaks)
      select case (spectrum_kind(power, peaks, bases))
      case (one_base)
         attractor%by_spectrum = cycle_motion
      case (two_bases)
         attractor%by_spectrum = torus
      case (continuum)
         attractor%by_spectrum = chaos
      case default
         attractor%by_spectrum = undecided
      end select
   end subroutine judge_spectrum

   !> Look for a third base among the lines that two bases do not explain: with it the section must
   !> be a smooth function of three phases, but not of two.
   subroutine look_for_third(peaks, attractor)
      type(peak_type), intent(in) :: peaks(:)
      type(attractor_type), intent(inout) :: attractor
      type(peak_type), allocatable :: others(:)
      real(wp) :: roughness

      others = pack(peaks, peaks%kind == other_peak)
      associate (motion => attractor%motion)
         call find_third_phase(motion%section, motion%section_time, motion%scale(), &
                               attractor%bases(:2), others(descending(others%power))%frequency, &
                               attractor%bases(3), roughness)
      end associate
      if (attractor%bases(3) <= 0.0_wp) return
      attractor%by_section = three_torus
      attractor%roughness = roughness
   end subroutine look_for_third

   !> Whether the last points of the section are those of a cycle.
   pure logical function on_cycle(motion) result(value)
      type(observed_motion_type), intent(in) :: motion

      value = period_of_tail(motion%section, motion%scale(), .false.) > 0
   end function on_cycle
end module attractor_verdict
