! SPDX-License-Identifier: BSD-3-Clause
!> The past of one integration: polynomials of accepted steps, of the delayed components or more.
!> It is a ring of slots. It drops the oldest steps on request and doubles when it is full. The
!> coefficients of a step never move: a new step takes over those of a dropped one. Other
!> modules ask it for values: steps have numbers, times in a step are counted from its start. Before
!> the initial time the problem's own history holds.
module dde_history
   use dde_interpolant, only: highest_degree, newton_row, newton_values, stored_degree, &
                              taylor_coefficients, usual_degree
   use dde_memory, only: bytes_of_real, find_lacking, small
   use dde_pieces, only: pieces_type
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: history_type

   !> Slots of a new ring. It is a power of two, as are its doubles.
   integer, parameter :: first_capacity = 16
   !> Real numbers of a slot beside its coefficients, at most.
   integer, parameter :: slot_size = 40
   !> Share of a step that rounding may hide.
   real(wp), parameter :: hidden = 4.0_wp*epsilon(1.0_wp)

   !> A step.
   type :: slot_type
      !> Its start
      type(instant) :: start
      !> Its length, and the time from its start for which its polynomial is valid, >= its length
      real(wp) :: length = 0.0_wp, valid_for = 0.0_wp
      !> Degree of the polynomial
      integer :: degree = 0
      !> Whether all Newton nodes are 0, so that the polynomial is in powers
      logical :: powers = .false.
      !> Newton nodes; those between the degree and the usual degree are 0
      real(wp) :: nodes(highest_degree)
      !> Number of its polynomials
      integer :: place = 0
   end type slot_type

   !> The polynomials of a step.
   type :: polynomials
      !> Newton coefficients, shape (0:stored degree, kept component)
      real(wp), allocatable :: a(:, :)
   end type polynomials

   !> Steps kept, number `oldest` to number `newest`.
   type :: history_type
      !> Initial time of the integration
      type(instant) :: origin
      !> Most bytes of the steps
      real(wp) :: most_bytes = huge(1.0_wp)
      !> Whether all of it is copied at the end
      logical :: is_copied = .false.
      !> Whether the problem's history may jump where a step starts or ends
      logical :: history_jumps = .false.
      !> Whether the polynomials of the running step are known, as those of a step after the newest
      logical :: running = .false.
      !> Its pieces between kinks, which delays read that move
      type(pieces_type) :: pieces
      !> Components of y that are kept, without repetition
      integer, allocatable :: kept(:)
      !> Place in `kept` of each delayed value
      integer, allocatable :: row(:)
      !> The last delayed value after each that is alike: of the same delay, in the next places
      integer, allocatable :: last_alike(:)
      !> Numbers of the oldest and the newest step kept
      integer(int64) :: oldest = 0, newest = -1
      !> Steps from this number to the oldest are dropped, but still have their polynomials
      integer(int64), private :: spare = 0
      !> Number of polynomials allocated
      integer, private :: used = 0
      !> Number of slots less 1, a mask of the bits of their numbers
      integer(int64), private :: mask = 0
      !> The ring, and the polynomials of its steps
      type(slot_type), allocatable, private :: slots(:)
      type(polynomials), allocatable :: stored(:)
   contains
      procedure, non_overridable :: start_of, length_of, validity_of, value, values, series
      procedure, non_overridable :: append, open_step, open_running, make_room, recall, forget
      procedure, non_overridable :: degree_in_use
   end type history_type

   interface history_type
      module procedure :: new_history
   end interface history_type

contains

   !> An empty past that begins at `origin`.
   pure function new_history(problem, origin, also) result(past)
      class(dde_problem_type), intent(in) :: problem
      type(instant), intent(in) :: origin
      !> Components that are kept beside the delayed ones
      integer, intent(in), optional :: also(:)
      type(history_type) :: past
      integer, allocatable :: row_of(:)
      integer :: i, row

      past%origin = origin
      allocate (row_of(problem%n), source=0)
      row_of(problem%component) = 1
      if (present(also)) row_of(also) = 1
      allocate (past%kept(count(row_of > 0)))
      row = 0
      do i = 1, problem%n
         if (row_of(i) == 0) cycle
         row = row + 1
         past%kept(row) = i
         row_of(i) = row
      end do
      past%row = row_of(problem%component)
      past%last_alike = [(i, i=1, size(problem%lag))]
      do i = size(problem%lag) - problem%moving - 1, 1, -1
         if (past%row(i + 1) /= past%row(i) + 1) cycle
         if (abs(problem%lag(i + 1) - problem%lag(i)) > 0.0_wp) cycle
         past%last_alike(i) = past%last_alike(i + 1)
      end do
      if (problem%moving > 0) past%pieces = pieces_type(problem%moving)
      allocate (past%slots(first_capacity), past%stored(first_capacity))
      past%mask = first_capacity - 1
   end function new_history

   !> Slot of step number `step`.
   pure integer function slot_of(self, step) result(slot)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      slot = 1 + int(iand(step, self%mask))
   end function slot_of

   !> Start of a step.
   pure type(instant) function start_of(self, step) result(start)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      start = self%slots(slot_of(self, step))%start
   end function start_of

   !> Length of a step.
   pure real(wp) function length_of(self, step) result(length)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      length = self%slots(slot_of(self, step))%length
   end function length_of

   !> Time from the start of a step for which its polynomial is valid, >= its length.
   pure real(wp) function validity_of(self, step) result(time)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      time = self%slots(slot_of(self, step))%valid_for
   end function validity_of

   !> Delayed value number k by the polynomial of a step, at a time since the start of that step.
   pure real(wp) function value(self, step, k, time) result(z)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step
      integer, intent(in) :: k
      real(wp), intent(in) :: time
      real(wp) :: values(1)

      associate (slot => self%slots(slot_of(self, step)), row => self%row(k))
         call newton_row(slot%degree, slot%nodes, self%stored(slot%place)%a(:, row:row), &
                         time/slot%length, values)
      end associate
      z = values(1)
   end function value

   !> Delayed values number k to `last`, which are alike, by the polynomials of one step, at
   !> ascending times from number `first` up to a limit.
   pure subroutine values(self, step, k, last, offset, limit, places, ahead, first, row, rows, z)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step
      integer, intent(in) :: k, last
      !> Time from the start of the step to the origin of `ahead`, and up to where it is read
      real(wp), intent(in) :: offset, limit
      integer, intent(in) :: places
      real(wp), intent(in) :: ahead(places)
      !> First time to read; on return the first beyond the limit
      integer, intent(inout) :: first
      !> The row of z that the values of number k fill, and all rows
      integer, intent(in) :: row, rows
      real(wp), intent(inout) :: z(rows, places)

      associate (slot => self%slots(slot_of(self, step)))
         if (k == last) then
            call newton_values(slot%degree, slot%nodes, self%stored(slot%place)%a(:, self%row(k)), &
                               offset, slot%length, limit, places, ahead, first, row, rows, z)
            return
         end if
         do first = first, places
            if (offset + ahead(first) > limit) exit
            call newton_row(slot%degree, slot%nodes, &
                            self%stored(slot%place)%a(:, self%row(k):self%row(last)), &
                            (offset + ahead(first))/slot%length, z(row, first))
         end do
      end associate
   end subroutine values

   !> Delayed value number k as a series in powers of a unit of time, by the polynomial of a step.
   pure subroutine series(self, step, k, time, unit, coefficients)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step
      integer, intent(in) :: k
      !> Where the series begins, as time since the start of the step
      real(wp), intent(in) :: time
      real(wp), intent(in) :: unit
      !> Coefficients; higher ones than its size are left out
      real(wp), contiguous, intent(out) :: coefficients(0:)
      real(wp) :: place

      associate (slot => self%slots(slot_of(self, step)))
         place = time/slot%length
         if (abs(place) < hidden) place = 0.0_wp
         call taylor_coefficients(slot%degree, slot%nodes, slot%powers, &
                                  self%stored(slot%place)%a(:, self%row(k)), place, &
                                  unit/slot%length, coefficients)
      end associate
   end subroutine series

   !> Store the polynomials of the step from `start`, `length` long, where memory was asked for.
   subroutine append(self, start, length, nodes, coefficients, valid_for)
      class(history_type), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length
      !> Newton nodes of its polynomials
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Newton coefficients of the kept components, shape (0:degree, kept)
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> Time from `start` for which they are valid; the length if that is longer
      real(wp), intent(in) :: valid_for
      real(wp) :: lacking
      integer :: place

      call self%make_room(size(nodes), lacking)
      call self%open_step(start, length, nodes, .not. any(abs(nodes) > 0.0_wp), valid_for, place)
      self%stored(place)%a(:size(nodes), :) = coefficients
   end subroutine append

   !> Place of the polynomials of the next step: that of a dropped one, if one is left.
   pure integer function next_place(self) result(place)
      class(history_type), intent(in) :: self

      place = self%used + 1
      if (self%spare < self%oldest) place = self%slots(slot_of(self, self%spare))%place
   end function next_place

   !> Make room for a step, if there is memory for it within the bound. A full ring gets twice the
   !> slots: each step is in its old slot and, a copy, in the same slot of the second half.
   subroutine make_room(self, degree, lacking)
      class(history_type), intent(inout) :: self
      !> Degree of the polynomials of the step
      integer, intent(in) :: degree
      !> Bytes that could not be allocated, more than the bound where that forbids them, or 0
      real(wp), intent(out) :: lacking
      type(slot_type), allocatable :: slots(:)
      type(polynomials), allocatable :: stored(:)
      real(wp) :: ahead, reals, ring
      integer :: i, n, place, status

      lacking = 0.0_wp
      if (self%spare < self%oldest) then
         if (self%slots(slot_of(self, self%spare))%degree == degree) return
      end if
      place = next_place(self)
      n = size(self%slots)
      reals = real(size(self%kept), wp)*(1 + stored_degree(degree))
      ring = merge(3.0_wp, 1.0_wp, place > n)*slot_size*n
      lacking = bytes_of_real*(place*reals + ring)
      if (lacking > self%most_bytes) return
      ! small ones are asked for together
      ahead = reals
      if (place > n) ahead = ring + merge(n*reals, reals, reals <= small)
      if (self%is_copied .and. ahead > small) ahead = ahead + place*reals
      lacking = find_lacking(ahead)
      if (lacking > 0.0_wp) return
      lacking = bytes_of_real*ahead
      if (place <= n) then
         if (allocated(self%stored(place)%a)) deallocate (self%stored(place)%a)
      else
         allocate (slots(2*n), stat=status)
         if (status == 0) allocate (stored(2*n), stat=status)
         if (status /= 0) return
         do i = 1, n
            call move_alloc(self%stored(i)%a, stored(i)%a)
         end do
         call move_alloc(stored, self%stored)
         slots(:n) = self%slots
         slots(n + 1:) = self%slots
         call move_alloc(slots, self%slots)
         self%mask = 2*n - 1
      end if
      allocate (self%stored(place)%a(0:stored_degree(degree), size(self%kept)), &
                source=0.0_wp, stat=status)
      if (status == 0) lacking = 0.0_wp
   end subroutine make_room

   !> Store the step from `start`, `length` long. The caller made room, and stores the coefficients.
   pure subroutine open_step(self, start, length, nodes, powers, valid_for, place)
      class(history_type), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Whether all of them are 0
      logical, intent(in) :: powers
      real(wp), intent(in) :: valid_for
      !> Place of its polynomials
      integer, intent(out) :: place

      place = next_place(self)
      if (self%spare < self%oldest) self%spare = self%spare + 1
      self%used = max(self%used, place)
      self%newest = self%newest + 1
      associate (slot => self%slots(slot_of(self, self%newest)))
         slot%place = place
         slot%start = start
         slot%length = length
         slot%valid_for = max(length, valid_for)
         slot%degree = size(nodes)
         slot%powers = powers
         slot%nodes(:size(nodes)) = nodes
         slot%nodes(size(nodes) + 1:usual_degree) = 0.0_wp
      end associate
   end subroutine open_step

   !> Store the running step as one after the newest, in the place of its polynomials if it is
   !> accepted.
   pure subroutine open_running(self, start, length, nodes, powers, place)
      class(history_type), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length
      real(wp), contiguous, intent(in) :: nodes(:)
      logical, intent(in) :: powers
      integer, intent(out) :: place
      integer(int64) :: spare
      integer :: used

      spare = self%spare
      used = self%used
      call self%open_step(start, length, nodes, powers, 0.0_wp, place)
      self%newest = self%newest - 1
      self%spare = spare
      self%used = used
      self%running = .true.
   end subroutine open_running

   !> Step number `step`, oldest..newest, as it was stored.
   pure subroutine recall(self, step, start, length, valid_for, nodes, coefficients)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step
      type(instant), intent(out) :: start
      real(wp), intent(out) :: length
      !> Time from `start` for which its polynomial is valid
      real(wp), intent(out) :: valid_for
      !> Newton nodes of its polynomial, at least as many as its degree
      real(wp), intent(out) :: nodes(:)
      !> Newton coefficients of the kept components, shape (0:size(nodes), kept)
      real(wp), intent(out) :: coefficients(0:, :)

      associate (slot => self%slots(slot_of(self, step)))
         start = slot%start
         length = slot%length
         valid_for = slot%valid_for
         nodes = slot%nodes(:size(nodes))
         nodes(slot%degree + 1:) = 0.0_wp
         coefficients(:slot%degree, :) = self%stored(slot%place)%a(:slot%degree, :)
         coefficients(slot%degree + 1:, :) = 0.0_wp
      end associate
   end subroutine recall

   !> Drop the steps that ended before `horizon`. The newest step stays. A step ends where the next
   !> one starts: its length is rounded, and that error may be many lengths of the next step.
   pure subroutine forget(self, horizon)
      class(history_type), intent(inout) :: self
      !> Nothing before this time will be read
      type(instant), intent(in) :: horizon

      do while (self%oldest < self%newest)
         if (elapsed(self%start_of(self%oldest + 1), horizon) < 0.0_wp) exit
         self%oldest = self%oldest + 1
      end do
   end subroutine forget

   !> Highest degree of the polynomials kept.
   pure integer function degree_in_use(self) result(degree)
      class(history_type), intent(in) :: self
      integer(int64) :: step

      degree = 0
      do step = self%oldest, self%newest
         degree = max(degree, self%slots(slot_of(self, step))%degree)
      end do
   end function degree_in_use
end module dde_history
