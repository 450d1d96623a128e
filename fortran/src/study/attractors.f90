!> The attractor that the delayed block comes to from one history, and its class: by Lyapunov
!> exponents, confirmed by a Poincare section and by the spectrum of v.
!>
!> The section is v = 1, v rising (where u is least), its points are (theta, u).
module attractors
   use base_frequencies, only: bases_type, label_peaks
   use dde, only: continuation_type, event_table, integrate, integration_options, &
                  integration_result, table_sampler
   use dde_errors, only: error_type
   use exponent_averages, only: average_growth, exponent_type
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: extend_growth, growth_settings_type, growth_type, measure_growth
   use motion_classes, only: agreed, chaos, class_by_exponents, cycle_motion, fixed_point, torus, &
                             undecided
   use steady_sliding, only: settles, sliding_exponents
   use section_motion, only: judge_section, section_verdict_type
   use spectral_peaks, only: find_peaks, peak_type
   use spectrum, only: power_spectrum
   use spectrum_verdict, only: continuum, line_share, one_base, spectrum_kind, two_bases
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: attractor_settings_type, attractor_type, find_attractor

   !> Numbers of the two event functions.
   enum, bind(c)
      enumerator :: section = 1, maximum
   end enum

   !> How an attractor is found and judged.
   type :: attractor_settings_type
      !> Time of the approach, left out
      real(wp) :: t_transient = 0.0_wp
      !> Time in which it is observed, and exponents are measured
      real(wp) :: t_observed = 0.0_wp
      !> Time in which tangent vectors turn before
      real(wp) :: t_turning = 0.0_wp
      !> Longest time between orthonormalisations
      real(wp) :: interval = 0.0_wp
      !> Number of blocks of exponents
      integer :: blocks = 0
      !> Number of exponents; without delay no more are measured than equations
      integer :: exponents = 0
      !> An exponent this close to zero has no sign
      real(wp) :: zero_level = 0.0_wp
      !> Longest error bar of a zero exponent
      real(wp) :: longest_bar = 0.0_wp
      !> How often the time of measuring exponents is doubled while their class is undecided
      integer :: doublings = 0
      !> Time between the samples of the spectrum
      real(wp) :: sample_interval = 0.0_wp
      !> Window of the spectrum, of `window_of`
      character(len=8) :: window = "hann"
      !> Number of its segments, and the share of one that the next repeats
      integer :: segments = 1
      real(wp) :: overlap = 0.0_wp
      !> Least height of its peaks over the highest, and over the valleys beside them
      real(wp) :: peak_floor = 0.0_wp, peak_prominence = 1.0_wp
   end type attractor_settings_type

   !> What was found.
   type :: attractor_type
      !> Classes, of `motion_classes`
      integer :: class = undecided, by_exponents = undecided, by_section = undecided
      integer :: by_spectrum = undecided
      !> Leading exponents, descending
      type(exponent_type), allocatable :: exponents(:)
      !> Points after which a cycle repeats in the section, 0 where none
      integer :: period = 0
      !> Roughness of the section as a function of two phases, see `section_verdict_type`
      real(wp) :: roughness = 1.0_wp
      !> Base frequencies of v, 0 where none
      real(wp) :: bases(2) = 0.0_wp
      !> Share of the power of v in the lines of these
      real(wp) :: line_share = 0.0_wp
      !> Maxima of v
      real(wp), allocatable :: maxima(:)
      !> Points (theta, u) of the section, shape (2, points)
      real(wp), allocatable :: section(:, :)
      !> When it was at each, shape (points)
      real(wp), allocatable :: section_time(:)
   end type attractor_type

contains

   !> Find the attractor of the block's own history, or of where another run ended.
   subroutine find_attractor(block_model, settings, options, attractor, error, start, arrived)
      !> The block and its history
      type(spring_block_type), intent(in) :: block_model
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> What was found
      type(attractor_type), intent(out) :: attractor
      !> The run ended before its time, or exponents cannot be measured
      type(error_type), allocatable, intent(out) :: error
      !> Where another run ended; empty: the block's own history
      type(continuation_type), intent(in), optional :: start
      !> Where the observation ended; empty on an error before
      type(continuation_type), intent(out), optional :: arrived
      type(continuation_type) :: approached, onward
      type(event_table) :: events
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      real(wp) :: t_approached, t_end
      integer :: i

      if (present(start)) approached = start
      t_approached = approached%time(1) + settings%t_transient
      call integrate(block_model, approached%time(1), t_approached, options, outcome, error, &
                     continuation=approached)
      if (allocated(error)) return
      events = event_table([index_of_ln_v, index_of_ln_v], level=[0.0_wp, 0.0_wp], &
                           direction=[1, -1], of_slope=[.false., .true.])
      t_end = t_approached + settings%t_observed
      ! rounding may put the last one beyond the end, where there is none
      samples = table_sampler([index_of_theta, index_of_u, index_of_ln_v], &
                              [(min(t_approached + i*settings%sample_interval, t_end), &
                                i=0, int(settings%t_observed/settings%sample_interval))])
      onward = approached
      call integrate(block_model, t_approached, t_end, options, outcome, error, &
                     sampler=samples, watcher=events, continuation=onward)
      if (allocated(error)) return
      if (present(arrived)) arrived = onward
      call keep_events(events, attractor)

      if (settles(samples%values(3, :))) then
         call sliding_exponents(block_model, exponents_of(block_model, settings), &
                                attractor%exponents, error)
         if (allocated(error)) return
         if (all(attractor%exponents%value < 0.0_wp)) then
            attractor%class = fixed_point
            attractor%by_exponents = fixed_point
            attractor%by_section = fixed_point
            attractor%by_spectrum = fixed_point
            return
         end if
      end if
      call judge_motion(block_model, settings, options, approached, samples, attractor, error)
      if (allocated(error)) return
      attractor%class = agreed(attractor%by_exponents, attractor%by_section, attractor%by_spectrum)
   end subroutine find_attractor

   !> Number of exponents: without delay there are no more than equations.
   pure integer function exponents_of(block_model, settings) result(exponents)
      !> The block
      type(spring_block_type), intent(in) :: block_model
      !> How many are wanted
      type(attractor_settings_type), intent(in) :: settings

      exponents = settings%exponents
      if (size(block_model%lag) == 0) exponents = min(exponents, block_model%n)
   end function exponents_of

   !> Maxima of v and points of the section.
   pure subroutine keep_events(events, attractor)
      !> Events met
      type(event_table), intent(in) :: events
      !> The attractor
      type(attractor_type), intent(inout) :: attractor
      integer :: i

      if (events%received == 0) then
         allocate (attractor%maxima(0), attractor%section(2, 0), attractor%section_time(0))
         return
      end if
      associate (met => events%which(:events%received), rows => [(i, i=1, events%received)])
         attractor%maxima = exp(events%y(index_of_ln_v, pack(rows, met == maximum)))
         associate (passages => pack(rows, met == section))
            attractor%section = events%y([index_of_theta, index_of_u], passages)
            attractor%section_time = events%time(passages)%hi
         end associate
      end associate
   end subroutine keep_events

   !> A block in motion: its class by exponents, by the section and by the spectrum.
   subroutine judge_motion(block_model, settings, options, arrived, samples, attractor, error)
      !> The block
      type(spring_block_type), intent(in) :: block_model
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Where the approach ended
      type(continuation_type), intent(in) :: arrived
      !> theta, u and ln v
      type(table_sampler), intent(in) :: samples
      !> The attractor
      type(attractor_type), intent(inout) :: attractor
      !> Exponents cannot be measured
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: wanted
      type(growth_type) :: measured
      type(section_verdict_type) :: in_section
      integer :: i

      wanted = growth_settings_type(exponents=exponents_of(block_model, settings), &
                                    t_turning=settings%t_turning, &
                                    t_end=arrived%time(1) + settings%t_turning &
                                    + settings%t_observed, &
                               interval=settings%interval, blocks=settings%blocks, bounds=.true.)
      call measure_growth(block_model, wanted, options, measured, error, arrived)
      do i = 0, settings%doublings
         if (allocated(error)) return
         attractor%exponents = average_growth(measured%growth, measured%interval, settings%blocks)
         attractor%by_exponents = class_by_exponents(attractor%exponents, settings%zero_level, &
                                                     settings%longest_bar)
         if (attractor%by_exponents /= undecided .or. i == settings%doublings) exit
         call extend_growth(block_model, wanted, options, measured, error)
      end do

      call judge_spectrum(exp(samples%values(3, :)), settings, attractor, error)
      if (allocated(error)) return
      call judge_section(attractor%section, attractor%section_time, &
                         [(spread_of(samples%values(i, :)), i=1, 2)], attractor%bases, in_section)
      attractor%by_section = in_section%class
      attractor%period = in_section%period
      attractor%roughness = in_section%roughness
   end subroutine judge_motion

   !> The class by the lines in the spectrum of v.
   subroutine judge_spectrum(v, settings, attractor, error)
      !> Samples of v
      real(wp), intent(in) :: v(:)
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> The attractor
      type(attractor_type), intent(inout) :: attractor
      !> Too few samples
      type(error_type), allocatable, intent(out) :: error
      type(bases_type) :: bases
      type(peak_type), allocatable :: peaks(:)
      real(wp), allocatable :: frequency(:), power(:)

      call power_spectrum(v, settings%sample_interval, trim(settings%window), settings%segments, &
                          settings%overlap, frequency, power, error)
      if (allocated(error)) return
      peaks = find_peaks(frequency, power, settings%peak_floor, settings%peak_prominence)
      call label_peaks(peaks, frequency(2), bases)
      attractor%bases = bases%frequency
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

   !> Standard deviation.
   pure real(wp) function spread_of(values) result(spread)
      !> Values
      real(wp), intent(in) :: values(:)

      associate (n => size(values))
         spread = max(norm2(values - sum(values)/n)/sqrt(real(n, wp)), tiny(1.0_wp))
      end associate
   end function spread_of
end module attractors
