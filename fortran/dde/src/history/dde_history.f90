!> The past of one integration: a store of the polynomials of accepted steps, for the delayed
!> components only. It is a ring of slots. It drops the oldest steps on request and doubles when it
!> is full. Before the initial time the problem's own history holds.
module dde_history
   use dde_interpolant, only: highest_degree, usual_degree
   use dde_memory, only: bytes_of, lacks
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: history_type, memory_of_past

   !> Slots of a new ring. It is a power of two, as are its doubles.
   integer, parameter :: first_capacity = 64

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
      !> Start of each step, per slot
      type(instant), allocatable :: start(:)
      !> Length of each step, per slot
      real(wp), allocatable :: length(:)
      !> Time from the start of the step for which its polynomial is valid, >= its length, per slot
      real(wp), allocatable :: valid_for(:)
      !> Degree of the polynomial, per slot
      integer, allocatable :: degree(:)
      !> Whether all Newton nodes are 0, so that the polynomial is in powers, per slot
      logical, allocatable :: powers(:)
      !> Newton nodes, shape (highest degree, slot), unused ones last
      real(wp), allocatable :: nodes(:, :)
      !> Newton coefficients, shape (0:highest degree, kept component, slot); those between the
      !> degree and the usual degree are 0
      real(wp), allocatable :: coefficients(:, :, :)
   contains
      !> Slot of a step
      procedure :: slot_of
      !> Store the polynomial of an accepted step
      procedure :: append
      !> See that one more step finds memory
      procedure :: make_room
      !> Make a slot for it
      procedure :: open_slot
      !> Read a stored step
      procedure :: recall
      !> Drop the steps that ended before a given time
      procedure :: forget
      !> Highest degree of the polynomials kept
      procedure :: degree_in_use
      procedure, private :: allocate_slots, double_capacity, is_full
   end type history_type

   interface history_type
      module procedure :: new_history
   end interface history_type

contains

   !> An empty past that begins at `origin`.
   pure function new_history(problem, origin) result(past)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Initial time of the integration
      type(instant), intent(in) :: origin
      type(history_type) :: past
      integer, allocatable :: row_of(:)
      integer :: i, k

      past%origin = origin
      allocate (row_of(problem%n), source=0)
      row_of(problem%component) = 1
      past%kept = pack([(i, i=1, problem%n)], row_of > 0)
      row_of(past%kept) = [(i, i=1, size(past%kept))]
      past%row = [(row_of(problem%component(k)), k=1, size(problem%lag))]
      call past%allocate_slots(first_capacity)
   end function new_history

   !> Empty slots.
   pure subroutine allocate_slots(self, slots)
      !> The past
      class(history_type), intent(inout) :: self
      !> Number of slots, a power of two
      integer, intent(in) :: slots

      allocate (self%start(0:slots - 1), self%length(0:slots - 1))
      allocate (self%valid_for(0:slots - 1), self%degree(0:slots - 1), self%powers(0:slots - 1))
      allocate (self%nodes(highest_degree, 0:slots - 1), source=0.0_wp)
      allocate (self%coefficients(0:highest_degree, size(self%kept), 0:slots - 1))
   end subroutine allocate_slots

   !> Slot of step number `step`.
   pure integer function slot_of(self, step) result(slot)
      !> The past
      class(history_type), intent(in) :: self
      !> Number of the step
      integer(int64), intent(in) :: step

      slot = int(iand(step, size(self%start, kind=int64) - 1_int64))
   end function slot_of

   !> Store the polynomial of the step from `start`, `length` long.
   pure subroutine append(self, start, length, nodes, coefficients, valid_for)
      !> The past
      class(history_type), intent(inout) :: self
      !> Start of the step
      type(instant), intent(in) :: start
      !> Length of the step
      real(wp), intent(in) :: length
      !> Newton nodes of its polynomial
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Newton coefficients of the kept components, shape (0:degree, kept)
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> Time from `start` for which it is valid; the length if that is longer
      real(wp), intent(in) :: valid_for
      integer :: slot

      call self%open_slot(start, length, nodes, .not. any(abs(nodes) > 0.0_wp), valid_for, slot)
      self%coefficients(:size(nodes), :, slot) = coefficients
   end subroutine append

   !> Bytes of a ring of slots.
   pure real(wp) function memory_of_past(slots, kept) result(bytes)
      !> Number of slots; a smaller ring than the first one is not made
      integer, intent(in) :: slots
      !> Number of components kept
      integer, intent(in) :: kept

      bytes = bytes_of(max(slots, first_capacity) &
                       *(8.0_wp + highest_degree + (1.0_wp + highest_degree)*kept))
   end function memory_of_past

   !> Double a full ring, if there is memory for it.
   subroutine make_room(self, lacking)
      !> The past
      class(history_type), intent(inout) :: self
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking

      lacking = 0.0_wp
      if (.not. self%is_full()) return
      lacking = memory_of_past(2*size(self%start), size(self%kept))
      if (lacks(lacking)) return
      lacking = 0.0_wp
      call self%double_capacity()
   end subroutine make_room

   !> Whether no slot is free.
   pure logical function is_full(self) result(full)
      !> The past
      class(history_type), intent(in) :: self

      full = self%newest - self%oldest + 1 == size(self%start)
   end function is_full

   !> Make a slot for the step from `start`, `length` long. The caller fills in its coefficients.
   pure subroutine open_slot(self, start, length, nodes, powers, valid_for, slot)
      !> The past
      class(history_type), intent(inout) :: self
      !> Start of the step
      type(instant), intent(in) :: start
      !> Length of the step
      real(wp), intent(in) :: length
      !> Newton nodes of its polynomial
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Whether all of them are 0
      logical, intent(in) :: powers
      !> Time from `start` for which it is valid; the length if that is longer
      real(wp), intent(in) :: valid_for
      !> The slot
      integer, intent(out) :: slot

      if (self%is_full()) call self%double_capacity()
      self%newest = self%newest + 1
      slot = self%slot_of(self%newest)
      self%start(slot) = start
      self%length(slot) = length
      self%valid_for(slot) = max(length, valid_for)
      self%degree(slot) = size(nodes)
      self%powers(slot) = powers
      self%nodes(:size(nodes), slot) = nodes
      self%coefficients(size(nodes) + 1:usual_degree, :, slot) = 0.0_wp
   end subroutine open_slot

   !> Step number `step`, oldest..newest, as it was stored.
   pure subroutine recall(self, step, start, length, valid_for, nodes, coefficients)
      !> The past
      class(history_type), intent(in) :: self
      !> Number of the step
      integer(int64), intent(in) :: step
      !> Start of the step
      type(instant), intent(out) :: start
      !> Length of the step
      real(wp), intent(out) :: length
      !> Time from `start` for which its polynomial is valid
      real(wp), intent(out) :: valid_for
      !> Newton nodes of its polynomial, as many as its degree at least
      real(wp), intent(out) :: nodes(:)
      !> Newton coefficients of the kept components, shape (0:size(nodes), kept)
      real(wp), intent(out) :: coefficients(0:, :)
      integer :: slot

      slot = self%slot_of(step)
      start = self%start(slot)
      length = self%length(slot)
      valid_for = self%valid_for(slot)
      nodes = self%nodes(:size(nodes), slot)
      coefficients = self%coefficients(0:size(nodes), :, slot)
      coefficients(self%degree(slot) + 1:, :) = 0.0_wp
   end subroutine recall

   !> Drop the steps that ended before `horizon`. The newest step stays. A step ends where the next
   !> one starts: its length is rounded, and that error may be many lengths of the next step.
   pure subroutine forget(self, horizon)
      !> The past
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
      !> The past
      class(history_type), intent(in) :: self
      integer(int64) :: step

      degree = 0
      do step = self%oldest, self%newest
         degree = max(degree, self%degree(self%slot_of(step)))
      end do
   end function degree_in_use

   !> Twice the slots, the same steps.
   pure subroutine double_capacity(self)
      !> The past
      class(history_type), intent(inout) :: self
      type(history_type) :: wider
      integer :: from, to
      integer(int64) :: step

      wider%kept = self%kept
      call wider%allocate_slots(2*size(self%start))
      do step = self%oldest, self%newest
         from = self%slot_of(step)
         to = wider%slot_of(step)
         wider%start(to) = self%start(from)
         wider%length(to) = self%length(from)
         wider%valid_for(to) = self%valid_for(from)
         wider%degree(to) = self%degree(from)
         wider%powers(to) = self%powers(from)
         wider%nodes(:, to) = self%nodes(:, from)
         wider%coefficients(:, :, to) = self%coefficients(:, :, from)
      end do
      call move_alloc(wider%start, self%start)
      call move_alloc(wider%length, self%length)
      call move_alloc(wider%valid_for, self%valid_for)
      call move_alloc(wider%degree, self%degree)
      call move_alloc(wider%powers, self%powers)
      call move_alloc(wider%nodes, self%nodes)
      call move_alloc(wider%coefficients, self%coefficients)
   end subroutine double_capacity
end module dde_history
