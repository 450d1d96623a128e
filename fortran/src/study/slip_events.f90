!> Slip events: the times in which a block is faster than the plate, v > 1.
!>
!> In an event u grows, so the spring unloads; between events u falls, so the plate loads it. The
!> state has three components a block, in the block's places.
module slip_events
   use block_state, only: components_of_block, index_of_ln_v, index_of_u
   use dde, only: dde_problem_type, event_watcher_type, instant, integrate, integration_options, &
                  integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_slip_events, slip_event_type

   !> Functions of each block: ln v, whose zeros begin and end events, and its slope.
   integer, parameter :: functions_of_block = 2
   !> Rows of a new table; it doubles.
   integer, parameter :: first_rows = 64

   !> A slip event of a block; all nondimensional.
   type :: slip_event_type
      !> Place of the block in the state vector
      integer :: place = 0
      !> When v rises through 1
      real(wp) :: onset = 0.0_wp
      !> Time from there to the block's next onset; 0 until it is known
      real(wp) :: recurrence_time = 0.0_wp
      !> Time in which v > 1
      real(wp) :: duration = 0.0_wp
      !> Integral of v over this time: by u' = v - 1 the growth of u plus the duration
      real(wp) :: slip = 0.0_wp
      !> Largest v of the event
      real(wp) :: peak_velocity = 0.0_wp
      !> Least v between the event and the next
      real(wp) :: least_velocity = huge(1.0_wp)
   end type slip_event_type

   !> The events of all blocks in the order of their onsets.
   type, extends(event_watcher_type) :: slip_watcher_type
      !> Events that begin before this time are left out
      real(wp) :: t_transient = 0.0_wp
      !> Events, the first `begun` of them
      type(slip_event_type), allocatable :: events(:)
      integer :: begun = 0
      !> The last event of each block, 0 before the first, and u at its onset
      integer, allocatable :: last(:)
      real(wp), allocatable :: u(:)
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
   subroutine find_slip_events(problem, t_transient, t_end, options, events, error)
      !> The blocks with their histories
      class(dde_problem_type), intent(in) :: problem
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
      allocate (watcher%direction(functions_of_block*blocks), source=0)
      allocate (watcher%terminal(functions_of_block*blocks), source=.false.)
      allocate (watcher%events(first_rows))
      allocate (watcher%last(blocks), source=0)
      allocate (watcher%u(blocks), source=0.0_wp)
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

      components = [(components_of_block*(place - 1) + index_of_ln_v, place=1, size(self%last))]
   end function places_of_ln_v

   !> The place of ln v of the block of a function.
   pure function place_of_ln_v(self, which, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = [first_place(which) + index_of_ln_v]
   end function place_of_ln_v

   !> The places of u and ln v of the block of a function.
   pure function places_of_event(self, which, n) result(components)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = first_place(which) + [index_of_u, index_of_ln_v]
   end function places_of_event

   !> The place before those of the block of a function.
   pure integer function first_place(which) result(place)
      integer, intent(in) :: which

      place = components_of_block*((which - 1)/functions_of_block)
   end function first_place

   !> Whether ln v of all blocks and its slopes keep from zero.
   pure logical function keep_from_zero(self, least, most, least_slope, most_slope) result(value)
      class(slip_watcher_type), intent(in) :: self
      real(wp), intent(in) :: least(:), most(:), least_slope(:), most_slope(:)

      associate (ln_v => self%reads(size(least)))
         value = all((least(ln_v) > 0.0_wp .or. most(ln_v) < 0.0_wp) &
                     .and. (least_slope(ln_v) > 0.0_wp .or. most_slope(ln_v) < 0.0_wp))
      end associate
   end function keep_from_zero

   !> ln v of each block and its slope.
   pure subroutine ln_v_and_slope(self, t, y, slope, g)
      class(slip_watcher_type), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)

      g(1::functions_of_block) = y(index_of_ln_v::components_of_block)
      g(2::functions_of_block) = slope(index_of_ln_v::components_of_block)
   end subroutine ln_v_and_slope

   !> One of these functions.
   pure real(wp) function ln_v_or_slope(self, which, t, y, slope) result(value)
      class(slip_watcher_type), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: t, y(:), slope(:)

      associate (ln_v => first_place(which) + index_of_ln_v)
         value = merge(slope(ln_v), y(ln_v), modulo(which, functions_of_block) == 0)
      end associate
   end function ln_v_or_slope

   !> Begin or end an event of a block, or note an extreme velocity.
   subroutine take_passage(self, which, t, y, slope)
      class(slip_watcher_type), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)
      integer :: first, place
      real(wp) :: u

      place = (which + functions_of_block - 1)/functions_of_block
      first = first_place(which)
      u = y(first + index_of_u)
      if (modulo(which, functions_of_block) == 0) then
         if (self%last(place) == 0) return
         associate (event => self%events(self%last(place)), v => exp(y(first + index_of_ln_v)))
            event%peak_velocity = max(event%peak_velocity, v)
            event%least_velocity = min(event%least_velocity, v)
         end associate
      else if (slope(first + index_of_ln_v) > 0.0_wp) then
         if (self%last(place) > 0) then
            associate (event => self%events(self%last(place)))
               event%recurrence_time = t%hi - event%onset
            end associate
         end if
         if (t%hi < self%t_transient) return
         if (self%begun == size(self%events)) self%events = [self%events, self%events]
         self%begun = self%begun + 1
         self%events(self%begun) = slip_event_type(place=place, onset=t%hi)
         self%last(place) = self%begun
         self%u(place) = u
      else if (self%last(place) > 0) then
         associate (event => self%events(self%last(place)))
            event%duration = t%hi - event%onset
            event%slip = u - self%u(place) + event%duration
         end associate
      end if
   end subroutine take_passage
end module slip_events
