!> Slip events: the times in which the block is faster than the plate, v > 1.
!>
!> In an event u grows, so the spring unloads; between events u falls, so the plate loads it. The
!> state has three components, in the block's places.
module slip_events
   use block_state, only: index_of_ln_v, index_of_u
   use dde, only: dde_problem_type, event_table, integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_slip_events, slip_events_type

   !> Numbers of the event functions.
   enum, bind(c)
      enumerator :: onset = 1, finish, maximum, minimum
   end enum

   !> Slip events in their order; all nondimensional, each of shape (events).
   type :: slip_events_type
      !> When v rises through 1
      real(wp), allocatable :: onset(:)
      !> Time from there to the next onset
      real(wp), allocatable :: recurrence_time(:)
      !> Time in which v > 1
      real(wp), allocatable :: duration(:)
      !> Integral of v over this time: by u' = v - 1 the growth of u plus the duration
      real(wp), allocatable :: slip(:)
      !> Largest v of the event
      real(wp), allocatable :: peak_velocity(:)
      !> Least v between the event and the next
      real(wp), allocatable :: least_velocity(:)
   end type slip_events_type

contains

   !> All events between two times that are complete, with the loading after them.
   subroutine find_slip_events(problem, t_transient, t_end, options, events, error)
      !> The block with its history
      class(dde_problem_type), intent(in) :: problem
      !> Events that begin before this time are left out
      real(wp), intent(in) :: t_transient
      !> Last time
      real(wp), intent(in) :: t_end
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> The events
      type(slip_events_type), intent(out) :: events
      !> The run ended before its time
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: passages
      type(integration_result) :: outcome
      integer, allocatable :: begin(:)
      integer :: i, n

      passages = event_table([index_of_ln_v, index_of_ln_v, index_of_ln_v, index_of_ln_v], &
                             level=[0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], direction=[1, -1, -1, 1], &
                             of_slope=[.false., .false., .true., .true.])
      call integrate(problem, 0.0_wp, t_end, options, outcome, error, watcher=passages)
      if (allocated(error)) return
      allocate (begin(0))
      if (passages%received > 0) then
         begin = pack([(i, i=1, passages%received)], &
                      passages%which(:passages%received) == onset &
                      .and. passages%time(:passages%received)%hi >= t_transient)
      end if
      n = max(0, size(begin) - 1)
      allocate (events%onset(n), events%recurrence_time(n), events%duration(n), events%slip(n), &
                events%peak_velocity(n), events%least_velocity(n))
      do i = 1, n
         associate (rows => passages%which(begin(i):begin(i + 1)), &
                    time => passages%time(begin(i):begin(i + 1))%hi, &
                    y => passages%y(:, begin(i):begin(i + 1)))
            events%onset(i) = time(1)
            events%recurrence_time(i) = time(size(time)) - time(1)
            events%duration(i) = time(findloc(rows, finish, dim=1)) - time(1)
            events%slip(i) = y(index_of_u, findloc(rows, finish, dim=1)) - y(index_of_u, 1) &
                             + events%duration(i)
            events%peak_velocity(i) = exp(maxval(y(index_of_ln_v, :), mask=rows == maximum))
            events%least_velocity(i) = exp(minval(y(index_of_ln_v, :), mask=rows == minimum))
         end associate
      end do
   end subroutine find_slip_events
end module slip_events
