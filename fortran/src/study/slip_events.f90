! SPDX-License-Identifier: BSD-3-Clause
!> Events are the times in which the signal of a block is above a threshold. Of the spring block
!> they are slips: with v > 1 it is faster than the plate, and its spring unloads. One whose peak is
!> within a millionth of the threshold is rounding at rest, and none.
module slip_events
   use dde, only: event_table, event_watcher_type, instant, integrate, integration_options, &
                  integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_description, only: observed_type
   use model_levels, only: event_level
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: find_slip_events, slip_event_type

   !> By what share of the threshold the peak of an event exceeds it at least.
   real(wp), parameter :: least_excess = 1.0e-6_wp
   !> Rows of a new table; it doubles.
   integer, parameter :: first_rows = 64

   !> An event of a block.
   type :: slip_event_type
      !> Place of the block in the state vector
      integer :: place = 0
      !> Threshold of the signal v
      real(wp) :: threshold = 0.0_wp
      !> When v rises through it
      real(wp) :: onset = 0.0_wp
      !> Time from there to the block's next onset at this threshold; 0 until it is known
      real(wp) :: recurrence_time = 0.0_wp
      !> Time in which v is above the threshold
      real(wp) :: duration = 0.0_wp
      !> Integral of v over this time, by the growth of the state that the definition names; 0 if it
      !> names none
      real(wp) :: slip = 0.0_wp
      !> Largest v of the event
      real(wp) :: peak_velocity = -huge(1.0_wp)
      !> Least v between the event and the next
      real(wp) :: least_velocity = huge(1.0_wp)
      !> The event before it at this threshold, 0 for the first
      integer :: before = 0
   end type slip_event_type

   !> The events of all blocks in the order of their onsets.
   type, extends(event_watcher_type) :: slip_watcher_type
      !> Events that begin before this time are left out
      real(wp) :: t_transient = 0.0_wp
      !> What is observed, and the number of states of a block
      type(observed_type) :: observed
      integer :: states = 0
      !> Thresholds
      real(wp), allocatable :: thresholds(:)
      !> The functions of each block in turn: the component of the signal less that of each
      !> threshold, whose zeros begin and end events, and its slope
      type(event_table) :: passages
      !> Events, the first `begun` of them
      type(slip_event_type), allocatable :: events(:)
      integer :: begun = 0
      !> The last event of each threshold and block, 0 before the first, and the integral at its
      !> onset
      integer, allocatable :: last(:, :)
      real(wp), allocatable :: integral(:, :)
   contains
      procedure :: reads, reads_for, never_zero, values
      procedure :: value => one_value
      procedure :: takes => places_of_event
      procedure :: take => take_passage
   end type slip_watcher_type

contains

   !> All events between two times that are complete, with the loading after them, in the order of
   !> their onsets.
   subroutine find_slip_events(model, thresholds, t_transient, t_end, options, events, error)
      !> The model and its past
      class(model_type), intent(in) :: model
      !> Thresholds; that of the definition if there is none
      real(wp), intent(in) :: thresholds(:)
      !> Events that begin before this time are left out
      real(wp), intent(in) :: t_transient
      !> Last time
      real(wp), intent(in) :: t_end
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      type(slip_event_type), allocatable, intent(out) :: events(:)
      !> The run ended before its time
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(slip_watcher_type) :: watcher
      real(wp), allocatable :: levels(:)
      integer :: block, blocks, k, n

      blocks = model%shape%blocks
      watcher%observed = model%sizes%observed
      watcher%states = model%states()
      watcher%t_transient = t_transient
      watcher%thresholds = thresholds
      levels = thresholds
      if (watcher%observed%is_exponential) levels = log(thresholds)
      if (size(thresholds) == 0) then
         levels = [event_level(model)]
         watcher%thresholds = levels
         if (watcher%observed%is_exponential) watcher%thresholds = exp(levels)
      end if
      n = size(levels)
      watcher%passages = event_table( &
                         [((watcher%states*(block - 1) + watcher%observed%component, k=0, n), &
                           block=1, blocks)], &
                         level=[([levels, 0.0_wp], block=1, blocks)], &
                         direction=[((0, k=0, n), block=1, blocks)], &
                         of_slope=[([(.false., k=1, n), .true.], block=1, blocks)])
      watcher%direction = watcher%passages%direction
      watcher%terminal = watcher%passages%terminal
      allocate (watcher%events(first_rows))
      allocate (watcher%last(n, blocks), source=0)
      allocate (watcher%integral(n, blocks), source=0.0_wp)
      call integrate(model, 0.0_wp, t_end, options, outcome, error, watcher=watcher)
      if (allocated(error)) return
      associate (begun => watcher%events(:watcher%begun))
         events = pack(begun, begun%recurrence_time > 0.0_wp)
      end associate
   end subroutine find_slip_events

   !> The places of the signal of all blocks.
   pure function reads(self, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: n
      integer, allocatable :: components(:)

      components = self%passages%reads(n)
   end function reads

   !> The place of the signal of the block of a function.
   pure function reads_for(self, which, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = self%passages%reads_for(which, n)
   end function reads_for

   !> The places of the integral and of the signal of the block of a function.
   pure function places_of_event(self, which, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      associate (observed => self%observed)
         components = self%passages%component(which) - observed%component &
                      + pack([observed%integral, observed%component], &
                             [observed%integral > 0, .true.])
      end associate
   end function places_of_event

   !> Whether the signal of all blocks keeps from the thresholds, and its slope from zero.
   pure logical function never_zero(self, least, most, least_slope, most_slope) result(value)
      class(slip_watcher_type), intent(in) :: self
      real(wp), intent(in) :: least(:), most(:), least_slope(:), most_slope(:)

      value = self%passages%never_zero(least, most, least_slope, most_slope)
   end function never_zero

   !> All functions.
   pure subroutine values(self, t, y, slope, g)
      class(slip_watcher_type), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)

      call self%passages%values(t, y, slope, g)
   end subroutine values

   !> One of these functions.
   pure real(wp) function one_value(self, which, t, y, slope) result(value)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: t, y(:), slope(:)

      value = self%passages%value(which, t, y, slope)
   end function one_value

   !> Begin or end an event of a block, or note an extreme of its signal.
   subroutine take_passage(self, which, t, y, slope)
      class(slip_watcher_type), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)
      integer :: functions, i, k, place, signal
      real(wp) :: integral, v

      functions = size(self%thresholds) + 1
      place = (which + functions - 1)/functions
      k = modulo(which, functions)
      signal = self%passages%component(which)
      v = y(signal)
      if (self%observed%is_exponential) v = exp(v)
      integral = 0.0_wp
      associate (observed => self%observed)
         if (observed%integral > 0) integral = y(signal - observed%component + observed%integral)
      end associate
      if (k == 0) then
         do i = 1, size(self%thresholds)
            if (self%last(i, place) == 0) cycle
            associate (event => self%events(self%last(i, place)))
               event%peak_velocity = max(event%peak_velocity, v)
               event%least_velocity = min(event%least_velocity, v)
            end associate
         end do
      else if (slope(signal) > 0.0_wp) then
         if (self%last(k, place) > 0) then
            associate (event => self%events(self%last(k, place)))
               event%recurrence_time = t%hi - event%onset
            end associate
         end if
         if (t%hi < self%t_transient) return
         if (self%begun == size(self%events)) self%events = [self%events, self%events]
         self%begun = self%begun + 1
         self%events(self%begun) = slip_event_type(place=place, threshold=self%thresholds(k), &
                                                   onset=t%hi, before=self%last(k, place))
         self%last(k, place) = self%begun
         self%integral(k, place) = integral
      else if (self%last(k, place) > 0) then
         associate (event => self%events(self%last(k, place)))
            event%duration = t%hi - event%onset
            event%slip = integral - self%integral(k, place)
            if (self%observed%with_time) event%slip = event%slip + event%duration
            if (event%peak_velocity - event%threshold > least_excess*abs(event%threshold)) return
            self%last(k, place) = event%before
            if (event%before > 0) self%events(event%before)%recurrence_time = 0.0_wp
         end associate
      end if
   end subroutine take_passage
end module slip_events
