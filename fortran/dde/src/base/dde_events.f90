! SPDX-License-Identifier: BSD-3-Clause
!> Events are times where a function of time, state and slope passes zero: the maxima of a
!> component or its passages through a section. The integrator finds them on dense output and passes
!> them to the watcher, which chooses the functions and decides what is done with an event.
!>
!> There is one event where a function that was not zero becomes zero or changes its sign, at the
!> first such time. A zero at the initial time of a run is no event. If a function stays within
!> the tolerance of zero, dense output may pass zero although the solution does not.
module dde_events
   use dde_time, only: instant
   use dde_errors, only: check_finite, error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: event_table, event_watcher_type, one_of_values

   !> Rows of a new table; it doubles.
   integer, parameter :: first_rows = 64

   !> Event functions, and the receiver of their events.
   type, abstract :: event_watcher_type
      !> Passages wanted of each function: -1 falling, 1 rising, 0 both
      integer, allocatable :: direction(:)
      !> Whether an event of each function ends the run
      logical, allocatable :: terminal(:)
      !> Longest time between two looks at the functions, besides those that each step takes: for
      !> functions that change faster than the solution
      real(wp) :: look_every = huge(1.0_wp)
      !> Whether changes of the state by the problem (`act`) are events, too, numbered in its order
      !> behind the functions
      logical :: takes_acts = .false.
   contains
      !> Components that the functions depend on, that one of them does, and that `take` needs at
      !> the events of one; reading less saves time
      procedure :: reads => all_components
      procedure :: reads_for => components_read
      procedure :: takes => components_of_state
      !> Refuse what cannot be watched
      procedure :: check => check_directions
      !> Whether bounds of state and slope show that no function is zero
      procedure :: never_zero => not_known
      !> The event functions
      procedure(event_values), deferred :: values
      !> One of them
      procedure :: value => one_of_values
      !> Receive an event
      procedure(take_event), deferred :: take
   end type event_watcher_type

   abstract interface
      !> All event functions. A value that is not finite is ignored. Of state and slope only the
      !> components that `reads` names are those of this time.
      pure subroutine event_values(self, t, y, slope, g)
         import :: event_watcher_type, wp
         implicit none (type, external)
         class(event_watcher_type), intent(in) :: self
         !> Time
         real(wp), intent(in) :: t
         !> State, shape (n)
         real(wp), intent(in) :: y(:)
         !> Time derivative of the state, of dense output, shape (n)
         real(wp), intent(in) :: slope(:)
         !> The functions, shape (size(direction))
         real(wp), intent(out) :: g(:)
      end subroutine event_values

      !> Receive an event; events come in order of time.
      subroutine take_event(self, which, t, y, slope)
         import :: event_watcher_type, instant, wp
         implicit none (type, external)
         class(event_watcher_type), intent(inout) :: self
         !> Number of the function, or behind these that of an act
         integer, intent(in) :: which
         !> Time of the event: t%hi, and t%lo beyond its last digit
         type(instant), intent(in) :: t
         !> State there, before it changes, of the components that `takes` names, shape (n)
         real(wp), intent(in) :: y(:)
         !> Time derivative of the state, of these components, shape (n)
         real(wp), intent(in) :: slope(:)
      end subroutine take_event
   end interface

   !> A table in memory of the passages of components, or of their slopes, through levels. With
   !> functions of its own an extension has no need of `component`, `of_slope` and `level`.
   type, extends(event_watcher_type) :: event_table
      !> Component that each function looks at, 1..n
      integer, allocatable :: component(:)
      !> Whether the function looks at the slope of the component: level 0 falling is a maximum
      logical, allocatable :: of_slope(:)
      !> Level whose passages are events
      real(wp), allocatable :: level(:)
      !> Number of events received
      integer :: received = 0
      !> When, shape (at least received)
      type(instant), allocatable :: time(:)
      !> Number of the function, shape (at least received)
      integer, allocatable :: which(:)
      !> State, shape (n, at least received)
      real(wp), allocatable :: y(:, :)
   contains
      procedure :: reads => components_of_table
      procedure :: reads_for => component_of_function
      procedure :: check => check_table
      procedure :: never_zero => never_at_level
      procedure :: values => less_level
      procedure :: value => one_less_level
      procedure :: take => take_row
   end type event_table

   interface event_table
      module procedure :: new_table
   end interface event_table

contains

   !> An empty table, with one of each for every function; not terminal and not of slopes where not
   !> said.
   pure function new_table(component, level, direction, terminal, of_slope) result(table)
      integer, intent(in) :: component(:), direction(:)
      real(wp), intent(in) :: level(:)
      logical, intent(in), optional :: terminal(:), of_slope(:)
      type(event_table) :: table

      allocate (table%component, source=component)
      allocate (table%level, source=level)
      allocate (table%direction, source=direction)
      allocate (table%terminal(size(direction)), source=.false.)
      allocate (table%of_slope(size(component)), source=.false.)
      if (present(terminal)) table%terminal = terminal
      if (present(of_slope)) table%of_slope = of_slope
   end function new_table

   !> Refuse directions and ends that cannot be.
   pure subroutine check_directions(self, n, error)
      class(event_watcher_type), intent(in) :: self
      integer, intent(in) :: n
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      if (.not. (allocated(self%direction) .and. allocated(self%terminal))) then
         call raise(error, "integrate: direction and terminal of the watcher are not allocated; " &
                    //"expected to be, one each for every event function")
         return
      end if
      if (size(self%direction) /= size(self%terminal)) then
         call raise(error, "integrate: "//text(size(self%direction))//" directions for " &
                    //text(size(self%terminal))//" marks `terminal` of the watcher; " &
                    //text(size(self%terminal))//" expected")
         return
      end if
      do i = 1, size(self%direction)
         if (abs(self%direction(i)) <= 1) cycle
         call raise(error, "integrate: direction("//text(i)//") = "//text(self%direction(i)) &
                    //" of the watcher; -1 (falling), 1 (rising) or 0 (both) expected")
         return
      end do
      if (self%look_every > 0.0_wp) return
      call raise(error, "integrate: look_every = "//text(self%look_every) &
                 //" of the watcher; a time > 0 expected")
   end subroutine check_directions

   !> Functions in general may depend on all components.
   pure function all_components(self, n) result(components)
      class(event_watcher_type), intent(in) :: self
      integer, intent(in) :: n
      integer, allocatable :: components(:)
      integer :: i

      allocate (components(n))
      do i = 1, n
         components(i) = i
      end do
   end function all_components

   !> One function may depend on all components that are read.
   pure function components_read(self, which, n) result(components)
      class(event_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = self%reads(n)
   end function components_read

   !> An event has the whole state.
   pure function components_of_state(self, which, n) result(components)
      class(event_watcher_type), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)

      components = all_components(self, n)
   end function components_of_state

   !> One of all functions.
   pure real(wp) function one_of_values(self, which, t, y, slope) result(value)
      class(event_watcher_type), intent(in) :: self
      !> Number of the function
      integer, intent(in) :: which
      !> As for all functions; of state and slope those that `reads_for` names
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp) :: g(size(self%direction))

      call self%values(t, y, slope, g)
      value = g(which)
   end function one_of_values

   !> Nothing is known of functions in general.
   pure logical function not_known(self, least, most, least_slope, most_slope) result(value)
      class(event_watcher_type), intent(in) :: self
      !> Bounds of each component, shape (n)
      real(wp), intent(in) :: least(:), most(:)
      !> Bounds of its time derivative, shape (n)
      real(wp), intent(in) :: least_slope(:), most_slope(:)

      value = .false.
   end function not_known

   !> Refuse levels of components that are not there, and levels that are not finite.
   pure subroutine check_table(self, n, error)
      class(event_table), intent(in) :: self
      integer, intent(in) :: n
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call check_directions(self, n, error)
      if (allocated(error) .or. .not. allocated(self%component)) return
      if (any([size(self%level), size(self%of_slope), size(self%direction)] &
              /= size(self%component))) then
         call raise(error, "integrate: "//text(size(self%component))//" components, " &
                    //text(size(self%level))//" levels, "//text(size(self%direction)) &
                    //" directions and "//text(size(self%of_slope))//" marks `of_slope` of the " &
                    //"watcher; "//text(size(self%component))//" of each expected")
         return
      end if
      do i = 1, size(self%component)
         if (self%component(i) >= 1 .and. self%component(i) <= n) cycle
         call raise(error, "integrate: component("//text(i)//") = "//text(self%component(i)) &
                    //" of the watcher; 1.."//text(n)//" expected")
         return
      end do
      call check_finite("integrate: the watcher has level", self%level, error)
   end subroutine check_table

   !> Components of the table. An extension may have other functions: nothing is known of those.
   pure function components_of_table(self, n) result(components)
      class(event_table), intent(in) :: self
      integer, intent(in) :: n
      integer, allocatable :: components(:)
      type(event_table) :: plain
      logical :: looked_at(n)

      components = all_components(self, n)
      if (.not. same_type_as(self, plain)) return
      looked_at = .false.
      looked_at(self%component) = .true.
      components = pack(components, looked_at)
   end function components_of_table

   !> The component of a function of the table, or of an extension all that it reads.
   pure function component_of_function(self, which, n) result(components)
      class(event_table), intent(in) :: self
      integer, intent(in) :: which, n
      integer, allocatable :: components(:)
      type(event_table) :: plain

      if (same_type_as(self, plain)) then
         components = [self%component(which)]
      else
         components = self%reads(n)
      end if
   end function component_of_function

   !> Whether components and slopes keep from their levels. An extension may have other functions:
   !> nothing is known of those.
   pure logical function never_at_level(self, least, most, least_slope, most_slope) result(value)
      class(event_table), intent(in) :: self
      real(wp), intent(in) :: least(:), most(:), least_slope(:), most_slope(:)
      type(event_table) :: plain

      value = same_type_as(self, plain)
      if (.not. value) return
      value = all(merge(least_slope(self%component) > self%level &
                        .or. most_slope(self%component) < self%level, &
                        least(self%component) > self%level .or. most(self%component) < self%level, &
                        self%of_slope))
   end function never_at_level

   !> Components or slopes, less their levels.
   pure subroutine less_level(self, t, y, slope, g)
      class(event_table), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)
      integer :: i

      do i = 1, size(g)
         g(i) = distance(self, i, y, slope)
      end do
   end subroutine less_level

   !> One component or slope, less its level. An extension may have other functions.
   pure real(wp) function one_less_level(self, which, t, y, slope) result(value)
      class(event_table), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: t, y(:), slope(:)
      type(event_table) :: plain

      if (same_type_as(self, plain)) then
         value = distance(self, which, y, slope)
      else
         value = one_of_values(self, which, t, y, slope)
      end if
   end function one_less_level

   !> A component or slope, less its level.
   pure real(wp) function distance(self, which, y, slope) result(value)
      class(event_table), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: y(:), slope(:)

      if (self%of_slope(which)) then
         value = slope(self%component(which)) - self%level(which)
      else
         value = y(self%component(which)) - self%level(which)
      end if
   end function distance

   !> Fill the next row.
   subroutine take_row(self, which, t, y, slope)
      class(event_table), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)

      if (.not. allocated(self%time)) then
         allocate (self%time(first_rows), self%which(first_rows), self%y(size(y), first_rows))
      else if (self%received == size(self%time)) then
         self%time = [self%time, self%time]
         self%which = [self%which, self%which]
         self%y = reshape([self%y, self%y], [size(y), 2*self%received])
      end if
      self%received = self%received + 1
      self%time(self%received) = t
      self%which(self%received) = which
      self%y(:, self%received) = y
   end subroutine take_row
end module dde_events
