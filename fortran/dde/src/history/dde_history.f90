!> The past of one integration: the polynomials of accepted steps, of the delayed components or more.
!> It is a ring of slots. It drops the oldest steps on request and doubles when it is full. The
!> coefficients of a step never move: a new step takes over those of a dropped one. Other
!> modules ask it for values: steps have numbers, times in a step are counted from its start. Before
!> the initial time the problem's own history holds.
module dde_history
   use dde_interpolant, only: highest_degree, newton_value, newton_values, stored_degree, &
                              taylor_coefficients, usual_degree
   use dde_memory, only: bytes_of, lacks, small
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: history_type, memory_of_past

   !> Slots of a new ring. It is a power of two, as are its doubles.
   integer, parameter :: first_capacity = 64
   !> Real numbers of a slot beside its nodes and coefficients, at most.
   integer, parameter :: slot_size = 20
   !> Share of a step that rounding may hide.
   real(wp), parameter :: hidden = 4.0_wp*epsilon(1.0_wp)

   !> The polynomials of a step.
   type :: polynomials
      !> Newton coefficients, shape (0:stored degree, kept component)
      real(wp), allocatable :: a(:, :)
   end type polynomials

   !> Steps kept, number `oldest` to number `newest`.
   type :: history_type
      !> Initial time of the integration
      type(instant) :: origin
      !> Whether the problem's history may jump where a step starts or ends
      logical :: history_jumps = .false.
      !> Components of y that are kept, without repetition
      integer, allocatable :: kept(:)
      !> Place in `kept` of each delayed value
      integer, allocatable :: row(:)
      !> Numbers of the oldest and the newest step kept
      integer(int64) :: oldest = 0, newest = -1
      !> Steps from this number to the oldest are dropped, but still have their polynomials
      integer(int64), private :: spare = 0
      !> Number of polynomials allocated
      integer, private :: used = 0
      !> Start of each step, per slot
      type(instant), allocatable, private :: start(:)
      !> Length of each step, per slot
      real(wp), allocatable, private :: length(:)
      !> Time from the start of the step for which its polynomial is valid, >= its length, per slot
      real(wp), allocatable, private :: valid_for(:)
      !> Degree of the polynomial, per slot
      integer, allocatable, private :: degree(:)
      !> Whether all Newton nodes are 0, so that the polynomial is in powers, per slot
      logical, allocatable, private :: powers(:)
      !> Newton nodes, shape (highest degree, slot); those between the degree and the usual degree
      !> are 0
      real(wp), allocatable, private :: nodes(:, :)
      !> Number of the polynomials of each step, per slot, and these
      integer, allocatable, private :: place(:)
      type(polynomials), allocatable, private :: stored(:)
   contains
      procedure, non_overridable :: start_of, length_of, validity_of, value, values, series
      procedure, non_overridable :: append, open_step, fill, make_room, recall, forget
      procedure, non_overridable :: degree_in_use
      procedure, non_overridable, private :: double_capacity, is_full, slot_of
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
      integer, intent(in) :: also(:)
      type(history_type) :: past
      integer, allocatable :: row_of(:)
      logical, allocatable :: wanted(:)
      integer :: i, k

      past%origin = origin
      allocate (wanted(problem%n), source=.false.)
      wanted(problem%component) = .true.
      wanted(also) = .true.
      past%kept = pack([(i, i=1, problem%n)], wanted)
      allocate (row_of(problem%n))
      row_of(past%kept) = [(i, i=1, size(past%kept))]
      past%row = [(row_of(problem%component(k)), k=1, size(problem%lag))]
      allocate (past%start(first_capacity), past%length(first_capacity))
      allocate (past%valid_for(first_capacity), past%degree(first_capacity))
      allocate (past%powers(first_capacity))
      allocate (past%nodes(highest_degree, first_capacity))
      allocate (past%place(first_capacity), past%stored(first_capacity))
   end function new_history

   !> Slot of step number `step`.
   pure integer function slot_of(self, step) result(slot)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      slot = 1 + int(iand(step, size(self%start, kind=int64) - 1_int64))
   end function slot_of

   !> Start of a step.
   pure type(instant) function start_of(self, step) result(start)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      start = self%start(self%slot_of(step))
   end function start_of

   !> Length of a step.
   pure real(wp) function length_of(self, step) result(length)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      length = self%length(self%slot_of(step))
   end function length_of

   !> Time from the start of a step for which its polynomial is valid, >= its length.
   pure real(wp) function validity_of(self, step) result(time)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step

      time = self%valid_for(self%slot_of(step))
   end function validity_of

   !> Delayed value number k by the polynomial of a step, at a time since the start of that step.
   pure real(wp) function value(self, step, k, time) result(z)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step
      integer, intent(in) :: k
      real(wp), intent(in) :: time
      integer :: slot

      slot = self%slot_of(step)
      z = newton_value(self%degree(slot), self%nodes(:, slot), &
                       self%stored(self%place(slot))%a(:, self%row(k)), time/self%length(slot))
   end function value

   !> Delayed value number k by the polynomial of a step, at ascending times up to a limit.
   pure subroutine values(self, step, k, offset, limit, ahead, first, z)
      class(history_type), intent(in) :: self
      integer(int64), intent(in) :: step
      integer, intent(in) :: k
      !> Time from the start of the step to the origin of `ahead`
      real(wp), intent(in) :: offset
      !> Time since the start of the step up to which its polynomial is read
      real(wp), intent(in) :: limit
      real(wp), contiguous, intent(in) :: ahead(:)
      !> First time to read; on return the first that lies beyond the limit
      integer, intent(inout) :: first
      !> The delayed value at all times, shape (size(ahead))
      real(wp), contiguous, intent(inout) :: z(:)
      integer :: slot

      slot = self%slot_of(step)
      call newton_values(self%degree(slot), self%nodes(:, slot), &
                         self%stored(self%place(slot))%a(:, self%row(k)), offset, &
                         self%length(slot), limit, size(ahead), ahead, first, z)
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
      integer :: slot

      slot = self%slot_of(step)
      place = time/self%length(slot)
      if (abs(place) < hidden) place = 0.0_wp
      call taylor_coefficients(self%degree(slot), self%nodes(:, slot), self%powers(slot), &
                               self%stored(self%place(slot))%a(:, self%row(k)), place, &
                               unit/self%length(slot), coefficients)
   end subroutine series

   !> Store the polynomials of the step from `start`, `length` long.
   pure subroutine append(self, start, length, nodes, coefficients, valid_for)
      class(history_type), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length
      !> Newton nodes of its polynomials
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Newton coefficients of the kept components, shape (0:degree, kept)
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> Time from `start` for which they are valid; the length if that is longer
      real(wp), intent(in) :: valid_for
      integer :: i

      call self%open_step(start, length, nodes, .not. any(abs(nodes) > 0.0_wp), valid_for)
      do i = 1, size(coefficients, 2)
         call self%fill(i, coefficients(:, i))
      end do
   end subroutine append

   !> Bytes of a past.
   pure real(wp) function memory_of_past(slots, steps, kept, degree) result(bytes)
      !> Number of slots; a smaller ring than the first one is not made
      integer, intent(in) :: slots
      !> Number of steps whose polynomials are allocated
      integer, intent(in) :: steps
      !> Number of components kept
      integer, intent(in) :: kept
      !> Degree of the polynomials
      integer, intent(in) :: degree

      bytes = bytes_of(real(max(slots, first_capacity), wp)*(slot_size + highest_degree) &
                       + real(steps, wp)*kept*(1 + stored_degree(degree)))
   end function memory_of_past

   !> Make room for a step, if there is memory for it.
   subroutine make_room(self, degree, lacking)
      class(history_type), intent(inout) :: self
      !> Degree of the polynomials of the step
      integer, intent(in) :: degree
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking
      integer :: slots, steps

      lacking = 0.0_wp
      if (self%spare < self%oldest) return
      slots = 0
      steps = 1
      if (self%is_full()) then
         slots = 2*size(self%start)
         ! small ones are asked for together
         if (memory_of_past(0, 1, size(self%kept), degree) <= small) steps = size(self%start)
      end if
      lacking = memory_of_past(slots, steps, size(self%kept), degree)
      if (lacks(lacking)) return
      lacking = 0.0_wp
      if (slots > 0) call self%double_capacity()
   end subroutine make_room

   !> Whether no slot is free.
   pure logical function is_full(self) result(full)
      class(history_type), intent(in) :: self

      full = self%newest - self%oldest + 1 == size(self%start)
   end function is_full

   !> Store the step from `start`, `length` long. The caller fills in its coefficients.
   pure subroutine open_step(self, start, length, nodes, powers, valid_for)
      class(history_type), intent(inout) :: self
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Whether all of them are 0
      logical, intent(in) :: powers
      real(wp), intent(in) :: valid_for
      integer :: from, place, slot

      if (self%is_full()) call self%double_capacity()
      self%newest = self%newest + 1
      slot = self%slot_of(self%newest)
      if (self%spare < self%oldest) then
         from = self%slot_of(self%spare)
         self%spare = self%spare + 1
         place = self%place(from)
         if (self%degree(from) /= size(nodes)) deallocate (self%stored(place)%a)
      else
         self%used = self%used + 1
         place = self%used
      end if
      if (.not. allocated(self%stored(place)%a)) then
         allocate (self%stored(place)%a(0:stored_degree(size(nodes)), size(self%kept)), &
                   source=0.0_wp)
      end if
      self%place(slot) = place
      self%start(slot) = start
      self%length(slot) = length
      self%valid_for(slot) = max(length, valid_for)
      self%degree(slot) = size(nodes)
      self%powers(slot) = powers
      self%nodes(:size(nodes), slot) = nodes
      self%nodes(size(nodes) + 1:usual_degree, slot) = 0.0_wp
   end subroutine open_step

   !> Fill in one polynomial of the newest step.
   pure subroutine fill(self, i, coefficients)
      class(history_type), intent(inout) :: self
      !> Number of the component among those kept
      integer, intent(in) :: i
      !> Newton coefficients, shape (0:degree)
      real(wp), contiguous, intent(in) :: coefficients(0:)
      integer :: place

      place = self%place(self%slot_of(self%newest))
      self%stored(place)%a(:ubound(coefficients, 1), i) = coefficients
   end subroutine fill

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
      integer :: slot

      slot = self%slot_of(step)
      start = self%start(slot)
      length = self%length(slot)
      valid_for = self%valid_for(slot)
      nodes = self%nodes(:size(nodes), slot)
      nodes(self%degree(slot) + 1:) = 0.0_wp
      coefficients(:self%degree(slot), :) = self%stored(self%place(slot))%a(:self%degree(slot), :)
      coefficients(self%degree(slot) + 1:, :) = 0.0_wp
   end subroutine recall

   !> Drop the steps that ended before `horizon`. The newest step stays. A step ends where the next
   !> one starts: its length is rounded, and that error may be many lengths of the next step.
   pure subroutine forget(self, horizon)
      class(history_type), intent(inout) :: self
      !> Nothing before this time will be read
      type(instant), intent(in) :: horizon

      do while (self%oldest < self%newest)
         if (elapsed(self%start(self%slot_of(self%oldest + 1)), horizon) < 0.0_wp) exit
         self%oldest = self%oldest + 1
      end do
   end subroutine forget

   !> Highest degree of the polynomials kept.
   pure integer function degree_in_use(self) result(degree)
      class(history_type), intent(in) :: self
      integer(int64) :: step

      degree = 0
      do step = self%oldest, self%newest
         degree = max(degree, self%degree(self%slot_of(step)))
      end do
   end function degree_in_use

   !> Twice the slots of a full ring. Each step is in its old slot and, a copy, in the same slot of
   !> the second half: its number gives one of these two.
   pure subroutine double_capacity(self)
      class(history_type), intent(inout) :: self
      type(polynomials), allocatable :: stored(:)
      real(wp), allocatable :: nodes(:, :)
      integer :: i, slots

      slots = size(self%start)
      self%start = [self%start, self%start]
      self%length = [self%length, self%length]
      self%valid_for = [self%valid_for, self%valid_for]
      self%degree = [self%degree, self%degree]
      self%powers = [self%powers, self%powers]
      self%place = [self%place, self%place]
      allocate (nodes(highest_degree, 2*slots))
      nodes(:, :slots) = self%nodes
      nodes(:, slots + 1:) = self%nodes
      call move_alloc(nodes, self%nodes)
      allocate (stored(2*slots))
      do i = 1, slots
         call move_alloc(self%stored(i)%a, stored(i)%a)
      end do
      call move_alloc(stored, self%stored)
   end subroutine double_capacity
end module dde_history
