! SPDX-License-Identifier: BSD-3-Clause
!> What is kept of a motion: samples of the signal, its maxima that stand out, and the section, in
!> which it rises through a level, with two coordinates of each point.
module observed_motion
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: interval_observer_type
   use model_description, only: observed_type
   use model_levels, only: section_level
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: observed_motion_type

   !> Numbers of the event functions.
   enum, bind(c)
      enumerator :: section = 1, maximum, minimum
   end enum

   !> The component of the signal rises by this much at least, in its unit, from a minimum to a
   !> maximum. Where it hardly changes, errors within the tolerance make smaller ones.
   real(wp), parameter :: least_rise = 1.0e-3_wp

   !> Samples that there is room for at first.
   integer, parameter :: first_rows = 1024

   !> Samples at even times.
   type, extends(sampler_type) :: even_sampler_type
      !> When sampling began, and the time between samples
      real(wp) :: begun = 0.0_wp, interval = 0.0_wp
      !> Samples, shape (wanted, >= received)
      real(wp), allocatable :: rows(:, :)
      !> Number of samples received, and how many of them are kept
      integer :: received = 0, kept = 0
   contains
      procedure :: take
   end type even_sampler_type

   !> A motion as far as it was observed.
   type, extends(interval_observer_type) :: observed_motion_type
      !> Time between samples
      real(wp) :: sample_interval = 0.0_wp
      !> Maxima of the signal
      real(wp), allocatable :: maxima(:)
      !> Points of the section, shape (2, points): the coordinates of the definition; where it has
      !> fewer, the time since the passage before and the greatest signal since then
      real(wp), allocatable :: section(:, :)
      !> Times of these points, shape (points)
      real(wp), allocatable :: section_time(:)
      !> Least value since the last maximum, greatest one since the last passage, and its time
      real(wp), private :: lowest = huge(1.0_wp), highest = -huge(1.0_wp), passed = -huge(1.0_wp)
      !> What is observed, and the level of the section
      type(observed_type), private :: observed
      real(wp), private :: level = 0.0_wp
      !> Whether the level is that of a motion, without a state at rest in the definition
      logical, private :: placed = .false.
      !> Unit of the signal: 1, or in own units its size at the start or in the section
      real(wp) :: unit = 1.0_wp
      !> Samples of the signal's component and of the coordinates
      type(even_sampler_type), private :: sampler
      !> Events since the motion arrived somewhere, and how many of them are kept
      type(event_table), private :: events
      integer, private :: events_kept = 0
      !> Where the motion is; empty at its beginning
      type(continuation_type) :: continuation
   contains
      procedure :: begin, place_section, clear, forget_path, observe, observe_interval, &
         keep_interval, arrive, signal, signal_shown, scale
   end type observed_motion_type

contains

   !> Look at a model from now on.
   pure subroutine begin(self, model, sample_interval)
      class(observed_motion_type), intent(inout) :: self
      class(model_type), intent(in) :: model
      !> Time between samples
      real(wp), intent(in) :: sample_interval

      self%observed = model%sizes%observed
      self%level = section_level(model)
      self%placed = ieee_is_nan(self%level)
      if (self%placed) self%level = model%past(self%observed%component)
      self%sample_interval = sample_interval
      if (model%own_units .and. .not. self%observed%is_exponential) then
         self%unit = max(abs(self%level), abs(model%past(self%observed%component)))
      end if
      call self%clear()
   end subroutine begin

   !> Without a state at rest the section is in the middle of the signal as far as it was observed.
   pure subroutine place_section(self)
      class(observed_motion_type), intent(inout) :: self

      if (.not. self%placed) return
      associate (signal => self%signal())
         self%level = 0.5_wp*(minval(signal) + maxval(signal))
      end associate
   end subroutine place_section

   !> Forget the observations, not where the motion is.
   pure subroutine clear(self)
      class(observed_motion_type), intent(inout) :: self
      type(even_sampler_type) :: empty
      real(wp) :: nothing(0)

      self%sampler = empty
      associate (observed => self%observed)
         self%sampler%wanted = [observed%component, pack(observed%coordinates, &
                                                         observed%coordinates > 0)]
      end associate
      self%sampler%interval = self%sample_interval
      allocate (self%sampler%rows(size(self%sampler%wanted), first_rows))
      self%section = reshape(nothing, [2, 0])
      self%section_time = nothing
      self%maxima = nothing
      self%passed = -huge(1.0_wp)
      call await_events(self)
   end subroutine clear

   !> Forget the samples and where the motion is: of many motions they would fill the memory.
   pure subroutine forget_path(self)
      class(observed_motion_type), intent(inout) :: self
      type(even_sampler_type) :: empty
      type(event_table) :: unused

      self%sampler = empty
      self%events = unused
      self%continuation = continuation_type()
   end subroutine forget_path

   !> Observe on for a time.
   subroutine observe(self, model, time, options, error)
      class(observed_motion_type), intent(inout) :: self
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: time
      type(integration_options), intent(in) :: options
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: now
      type(integration_result) :: outcome

      now = self%continuation
      call self%observe_interval(model, now%time(1) + time, options, outcome, error, now)
      if (allocated(error)) return
      call self%keep_interval()
      call self%arrive(now)
   end subroutine observe

   !> Observe a run up to `time`, with or without tangent vectors.
   subroutine observe_interval(self, problem, time, options, outcome, error, continuation)
      class(observed_motion_type), intent(inout) :: self
      !> The model, maybe with tangent vectors
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: time
      type(integration_options), intent(in) :: options
      type(integration_result), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type), intent(inout) :: continuation

      self%events%received = self%events_kept
      associate (sampler => self%sampler)
         if (sampler%kept == 0) sampler%begun = continuation%time(1)
         sampler%received = sampler%kept
         sampler%next = sampler%begun + (sampler%kept + 1)*sampler%interval
      end associate
      call integrate(problem, continuation%time(1), time, options, outcome, error, &
                     sampler=self%sampler, watcher=self%events, continuation=continuation)
   end subroutine observe_interval

   !> Keep the observations of the last interval.
   subroutine keep_interval(self)
      class(observed_motion_type), intent(inout) :: self

      self%sampler%kept = self%sampler%received
      self%events_kept = self%events%received
   end subroutine keep_interval

   !> The motion is here: take over the maxima and the section of what was kept.
   subroutine arrive(self, continuation)
      class(observed_motion_type), intent(inout) :: self
      type(continuation_type), intent(in) :: continuation

      self%continuation = continuation
      if (self%events%received > 0) call take_over(self)
      call await_events(self)
   end subroutine arrive

   !> Wait for new events.
   pure subroutine await_events(self)
      class(observed_motion_type), intent(inout) :: self
      integer :: i

      self%events = event_table([(self%observed%component, i=section, minimum)], &
                                level=[self%level, 0.0_wp, 0.0_wp], direction=[1, -1, 1], &
                                of_slope=[.false., .true., .true.])
      self%events_kept = 0
   end subroutine await_events

   !> The component of the signal at even times.
   pure function signal(self) result(values)
      class(observed_motion_type), intent(in) :: self
      real(wp) :: values(self%sampler%kept)

      values = self%sampler%rows(1, :self%sampler%kept)
   end function signal

   !> The signal itself at even times.
   pure function signal_shown(self) result(values)
      class(observed_motion_type), intent(in) :: self
      real(wp) :: values(self%sampler%kept)

      values = self%signal()
      if (self%observed%is_exponential) values = exp(values)
   end function signal_shown

   !> Keep a sample, and wait for the next one.
   subroutine take(self, y)
      class(even_sampler_type), intent(inout) :: self
      !> Values of the wanted components
      real(wp), intent(in) :: y(:)

      if (self%received == size(self%rows, 2)) then
         self%rows = reshape(self%rows, [size(y), 2*self%received], pad=[0.0_wp])
      end if
      self%received = self%received + 1
      self%rows(:, self%received) = y
      self%next = self%begun + (self%received + 1)*self%interval
   end subroutine take

   !> Take over maxima of the signal and points of the section.
   pure subroutine take_over(self)
      class(observed_motion_type), intent(inout) :: self
      real(wp) :: maxima(self%events%received), points(2, self%events%received), &
                  times(self%events%received)
      integer :: given, i, peaks, passages

      associate (events => self%events, observed => self%observed)
         given = count(observed%coordinates > 0)
         peaks = 0
         passages = 0
         do i = 1, events%received
            associate (value => events%y(observed%component, i))
               select case (events%which(i))
               case (maximum)
                  self%highest = max(self%highest, value)
                  if (value - self%lowest >= least_rise*self%unit) then
                     peaks = peaks + 1
                     maxima(peaks) = value
                     self%lowest = huge(1.0_wp)
                  end if
               case (minimum)
                  self%lowest = min(self%lowest, value)
               case default
                  associate (time => events%time(i)%hi)
                     if (given == 2 .or. self%passed > -huge(1.0_wp)) then
                        passages = passages + 1
                        times(passages) = time
                        points(:, passages) = point_at(i)
                     end if
                     self%passed = time
                     self%highest = -huge(1.0_wp)
                  end associate
               end select
            end associate
         end do
         if (observed%is_exponential) maxima(:peaks) = exp(maxima(:peaks))
         self%maxima = [self%maxima, maxima(:peaks)]
         self%section = reshape([self%section, points(:, :passages)], &
                                [2, size(self%section, 2) + passages])
         self%section_time = [self%section_time, times(:passages)]
      end associate

   contains

      !> The coordinates of a passage.
      pure function point_at(number) result(point)
         !> Number of the event
         integer, intent(in) :: number
         real(wp) :: point(2)
         real(wp) :: all(4)

         associate (events => self%events, given => self%observed%coordinates)
            all(3:) = [events%time(number)%hi - self%passed, self%highest]
            all(:2) = events%y(max(1, given), number)
            associate (chosen => pack(all, [given > 0, .true., .true.]))
               point = chosen(:2)
            end associate
         end associate
      end function point_at
   end subroutine take_over

   !> Scales of the coordinates of points of the section, not 0: standard deviations over all
   !> samples, of the signal for its greatest value; the mean of times since the passage before.
   pure function scale(self) result(scales)
      class(observed_motion_type), intent(in) :: self
      real(wp) :: scales(2)
      real(wp), allocatable :: x(:)
      integer :: given, i, n, row

      given = size(self%sampler%wanted) - 1
      do i = 1, 2
         if (i == given + 1) then
            scales(i) = sum(self%section(i, :))/max(1, size(self%section, 2))
         else
            row = merge(i + 1, 1, i <= given)
            x = self%sampler%rows(row, :self%sampler%kept)
            n = max(1, self%sampler%kept)
            scales(i) = norm2(x - sum(x)/n)/sqrt(real(n, wp))
         end if
      end do
      scales = max(scales, tiny(1.0_wp))
   end function scale
end module observed_motion
