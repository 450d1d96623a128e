!> Slip events: the times in which a block is faster than a threshold; with v > 1, than the plate.
!>
!> While v > 1, u grows, so the spring unloads; else u falls, so the plate loads it. The state has
!> three components a block, in the block's places.
module slip_events
   use block_state, only: components_of_block, index_of_ln_v, index_of_u
   use dde, only: dde_problem_type, event_watcher_type, instant, integrate, integration_options, &
                  integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_slip_events, slip_event_type

   !> Rows of a new table; it doubles.
   integer, parameter :: first_rows = 64

   !> A slip event of a block; all nondimensional.
   type :: slip_event_type
      !> Place of the block in the state vector
      integer :: place = 0
      !> Velocity above which the block slips
      real(wp) :: threshold = 1.0_wp
      !> When v rises through it
      real(wp) :: onset = 0.0_wp
      !> Time from there to the block's next onset at this threshold; 0 until it is known
      real(wp) :: recurrence_time = 0.0_wp
      !> Time in which v is above the threshold
      real(wp) :: duration = 0.0_wp
      !> Integral of v over this time: by u' = v - 1 the growth of u plus the duration
      real(wp) :: slip = 0.0_wp
      !> Largest v of the event
      real(wp) :: peak_velocity = 0.0_wp
      !> Least v between the event and the next
      real(wp) :: least_velocity = huge(1.0_wp)
   end type slip_event_type

   !> The events of all blocks in the order of their onsets. The functions of a block are ln v less
   !> that of each threshold, whose zeros begin and end events, and the slope of ln v.
   type, extends(event_watcher_type) :: slip_watcher_type
      !> Events that begin before this time are left out
      real(wp) :: t_transient = 0.0_wp
      !> Thresholds, ln v at them, and the number of functions of a block
      real(wp), allocatable :: thresholds(:), levels(:)
      integer :: functions = 0
      !> Events, the first `begun` of them
      type(slip_event_type), allocatable :: events(:)
      integer :: begun = 0
      !> The last event of each threshold and block, 0 before the first, and u at its onset
      integer, allocatable :: last(:, :)
      real(wp), allocatable :: u(:, :)
   contains
      procedure :: reads => places_of_ln_v
      procedure :: reads_for => place_of_ln_v
      procedure :: takes => places_of_event
      procedure :: never_zero => keep_from_zero
      procedure :: values => ln_v_and_slope
      procedure :: value => ln_v_or_slope
      procedure :: take => take_passage
   end type slip_watcher_type

contains

   !> All events between two times that are complete, with the loading after them, in the order of
   !> their onsets.
   subroutine find_slip_events(problem, thresholds, t_transient, t_end, options, events, error)
      !> The blocks with their histories
      class(dde_problem_type), intent(in) :: problem
      !> Velocities above which a block slips
      real(wp), intent(in) :: thresholds(:)
      !> Events that begin before this time are left out
      real(wp), intent(in) :: t_transient
      !> Last time
      real(wp), intent(in) :: t_end
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> The events
      type(slip_event_type), allocatable, intent(out) :: events(:)
      !> The run ended before its time
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(slip_watcher_type) :: watcher
      integer :: blocks

      blocks = problem%n/components_of_block
      watcher%t_transient = t_transient
      watcher%thresholds = thresholds
      watcher%levels = log(thresholds)
      watcher%functions = size(thresholds) + 1
      allocate (watcher%direction(watcher%functions*blocks), source=0)
      allocate (watcher%terminal(watcher%functions*blocks), source=.false.)
      allocate (watcher%events(first_rows))
      allocate (watcher%last(size(thresholds), blocks), source=0)
      allocate (watcher%u(size(thresholds), blocks), source=0.0_wp)
      call integrate(problem, 0.0_wp, t_end, options, outcome, error, watcher=watcher)
      if (allocated(error)) return
      associate (begun => watcher%events(:watcher%begun))
         events = pack(begun, begun%recurrence_time > 0.0_wp)
      end associate
   end subroutine find_slip_events

   !> The places of ln v of all blocks.
   pure function places_of_ln_v(self, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: n
      integer, allocatable :: components(:)
      integer :: place

      components = [(components_of_block*(place - 1) + index_of_ln_v, place=1, size(self%last, 2))]
   end function places_of_ln_v

   !> The place of ln v of the block of a function.
   pure function place_of_ln_v(self, which, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = [first_place(self, which) + index_of_ln_v]
   end function place_of_ln_v

   !> The places of u and ln v of the block of a function.
   pure function places_of_event(self, which, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = first_place(self, which) + [index_of_u, index_of_ln_v]
   end function places_of_event

   !> The place before those of the block of a function.
   pure integer function first_place(self, which) result(place)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which

      place = components_of_block*((which - 1)/self%functions)
   end function first_place

   !> Whether ln v of all blocks keeps from the thresholds, and its slope from zero.
   pure logical function keep_from_zero(self, least, most, least_slope, most_slope) result(value)
      class(slip_watcher_type), intent(in) :: self
      real(wp), intent(in) :: least(:), most(:), least_slope(:), most_slope(:)

      integer :: k

      associate (ln_v => self%reads(size(least)), levels => self%levels)
         value = all(least_slope(ln_v) > 0.0_wp .or. most_slope(ln_v) < 0.0_wp)
         do k = 1, size(levels)
            value = value .and. all(least(ln_v) > levels(k) .or. most(ln_v) < levels(k))
         end do
      end associate
   end function keep_from_zero

   !> All functions.
   pure subroutine ln_v_and_slope(self, t, y, slope, g)
      class(slip_watcher_type), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)
      integer :: k

      do k = 1, size(self%thresholds)
         g(k::self%functions) = y(index_of_ln_v::components_of_block) - self%levels(k)
      end do
      g(self%functions::self%functions) = slope(index_of_ln_v::components_of_block)
   end subroutine ln_v_and_slope

   !> One of these functions.
   pure real(wp) function ln_v_or_slope(self, which, t, y, slope) result(value)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: t, y(:), slope(:)

      associate (ln_v => first_place(self, which) + index_of_ln_v, &
                 k => modulo(which, self%functions))
         if (k == 0) then
            value = slope(ln_v)
         else
            value = y(ln_v) - self%levels(k)
         end if
      end associate
   end function ln_v_or_slope

   !> Begin or end an event of a block, or note an extreme velocity.
   subroutine take_passage(self, which, t, y, slope)
      class(slip_watcher_type), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)
      integer :: first, i, k, place
      real(wp) :: u

      place = (which + self%functions - 1)/self%functions
      k = modulo(which, self%functions)
      first = first_place(self, which)
      u = y(first + index_of_u)
      if (k == 0) then
         do i = 1, size(self%thresholds)
            if (self%last(i, place) == 0) cycle
            associate (event => self%events(self%last(i, place)), &
                       v => exp(y(first + index_of_ln_v)))
               event%peak_velocity = max(event%peak_velocity, v)
               event%least_velocity = min(event%least_velocity, v)
            end associate
         end do
      else if (slope(first + index_of_ln_v) > 0.0_wp) then
         if (self%last(k, place) > 0) then
            associate (event => self%events(self%last(k, place)))
               event%recurrence_time = t%hi - event%onset
            end associate
         end if
         if (t%hi < self%t_transient) return
         if (self%begun == size(self%events)) self%events = [self%events, self%events]
         self%begun = self%begun + 1
         self%events(self%begun) = slip_event_type(place=place, threshold=self%thresholds(k), &
                                                   onset=t%hi)
         self%last(k, place) = self%begun
         self%u(k, place) = u
      else if (self%last(k, place) > 0) then
         associate (event => self%events(self%last(k, place)))
            event%duration = t%hi - event%onset
            event%slip = u - self%u(k, place) + event%duration
         end associate
      end if
   end subroutine take_passage
end module slip_events
