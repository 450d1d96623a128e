!> The polynomials of accepted steps in a ring of slots, which forgets the oldest and doubles when
!> it is full.
module dde_step_ring
   use dde_interpolant, only: highest_degree, usual_degree
   use dde_time, only: elapsed, instant
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: step_ring

   !> Slots of a new ring, a power of two, as they remain by doubling.
   integer, parameter :: first_capacity = 64

   !> Steps kept, number `oldest` to number `newest`.
   type :: step_ring
      !> Components of y that are kept, without repetition
      integer, allocatable :: kept(:)
      !> Numbers of the oldest and the newest step kept
      integer(int64) :: oldest = 0, newest = -1
      !> Start of each step, per slot
      type(instant), allocatable :: start(:)
      !> Length of each step, per slot
      real(wp), allocatable :: length(:)
      !> How long from its start on its interpolant serves, its length or longer, per slot
      real(wp), allocatable :: serves(:)
      !> Degree of the interpolant, per slot
      integer, allocatable :: degree(:)
      !> Whether all nodes of the interpolant are 0, so that it is in powers, per slot
      logical, allocatable :: powers(:)
      !> Newton nodes of the interpolant, shape (highest degree, slot), unused ones last
      real(wp), allocatable :: nodes(:, :)
      !> Its coefficients (0:highest degree, kept component, slot), 0 above the degree up to the
      !> usual one
      real(wp), allocatable :: coefficients(:, :, :)
   contains
      !> Slot of a step
      procedure :: slot_of
      !> Take in an accepted step
      procedure :: append
      !> Make place for one
      procedure :: open_slot
      !> Give a kept step back
      procedure :: recall
      !> Drop what ended before a given instant
      procedure :: forget
      !> Highest degree of the interpolants kept
      procedure :: degree_in_use
   end type step_ring

   interface step_ring
      module procedure :: new_ring
   end interface step_ring

contains

   !> An empty ring.
   pure function new_ring(kept, capacity) result(ring)
      !> Components of y to keep, without repetition
      integer, intent(in) :: kept(:)
      !> Slots, a power of two; as many as usual if not given
      integer, intent(in), optional :: capacity
      type(step_ring) :: ring
      integer :: slots

      slots = first_capacity
      if (present(capacity)) slots = capacity
      ring%kept = kept
      allocate (ring%start(0:slots - 1), ring%length(0:slots - 1))
      allocate (ring%serves(0:slots - 1), ring%degree(0:slots - 1), ring%powers(0:slots - 1))
      allocate (ring%nodes(highest_degree, 0:slots - 1), source=0.0_wp)
      allocate (ring%coefficients(0:highest_degree, size(kept), 0:slots - 1))
   end function new_ring

   !> Slot of step number `step`.
   pure integer function slot_of(self, step) result(slot)
      !> The ring
      class(step_ring), intent(in) :: self
      !> Number of the step
      integer(int64), intent(in) :: step

      slot = int(iand(step, size(self%start, kind=int64) - 1_int64))
   end function slot_of

   !> Take in the polynomial of the step from `start`, `length` long.
   pure subroutine append(self, start, length, nodes, coefficients, serves)
      !> The ring
      class(step_ring), intent(inout) :: self
      !> Start of the step
      type(instant), intent(in) :: start
      !> Length of the step
      real(wp), intent(in) :: length
      !> Newton nodes of its interpolant
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Interpolant of the kept components, shape (0:degree, kept)
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> How long from the start on it serves; less than the length counts as the length
      real(wp), intent(in) :: serves
      integer :: slot

      call self%open_slot(start, length, nodes, .not. any(abs(nodes) > 0.0_wp), serves, slot)
      self%coefficients(:size(nodes), :, slot) = coefficients
   end subroutine append

   !> A slot for the step from `start`, `length` long; the coefficients are left to the caller.
   pure subroutine open_slot(self, start, length, nodes, powers, serves, slot)
      !> The ring
      class(step_ring), intent(inout) :: self
      !> Start of the step
      type(instant), intent(in) :: start
      !> Length of the step
      real(wp), intent(in) :: length
      !> Newton nodes of its interpolant
      real(wp), contiguous, intent(in) :: nodes(:)
      !> Whether all of them are 0
      logical, intent(in) :: powers
      !> How long from the start on it serves; less than the length counts as the length
      real(wp), intent(in) :: serves
      !> The slot
      integer, intent(out) :: slot

      if (self%newest - self%oldest + 1 == size(self%start)) call double_capacity(self)
      self%newest = self%newest + 1
      slot = self%slot_of(self%newest)
      self%start(slot) = start
      self%length(slot) = length
      self%serves(slot) = max(length, serves)
      self%degree(slot) = size(nodes)
      self%powers(slot) = powers
      self%nodes(:size(nodes), slot) = nodes
      self%coefficients(size(nodes) + 1:usual_degree, :, slot) = 0.0_wp
   end subroutine open_slot

   !> Step number `step`, oldest..newest, as it was appended.
   pure subroutine recall(self, step, start, length, nodes, coefficients)
      !> The ring
      class(step_ring), intent(in) :: self
      !> Number of the step
      integer(int64), intent(in) :: step
      !> Start of the step
      type(instant), intent(out) :: start
      !> Length of the step
      real(wp), intent(out) :: length
      !> Newton nodes of its interpolant, as many as its degree at least
      real(wp), intent(out) :: nodes(:)
      !> Interpolant of the kept components, shape (0:size(nodes), kept)
      real(wp), intent(out) :: coefficients(0:, :)
      integer :: slot

      slot = self%slot_of(step)
      start = self%start(slot)
      length = self%length(slot)
      nodes = self%nodes(:size(nodes), slot)
      coefficients = self%coefficients(0:size(nodes), :, slot)
      coefficients(self%degree(slot) + 1:, :) = 0.0_wp
   end subroutine recall

   !> Drop the steps that ended before `horizon`; the newest stays.
   pure subroutine forget(self, horizon)
      !> The ring
      class(step_ring), intent(inout) :: self
      !> Nothing before this instant will be asked for
      type(instant), intent(in) :: horizon
      integer :: slot

      do while (self%oldest < self%newest)
         slot = self%slot_of(self%oldest)
         if (elapsed(self%start(slot), horizon) < self%length(slot)) exit
         self%oldest = self%oldest + 1
      end do
   end subroutine forget

   !> Highest degree of the interpolants kept.
   pure integer function degree_in_use(self) result(degree)
      !> The ring
      class(step_ring), intent(in) :: self
      integer(int64) :: step

      degree = 0
      do step = self%oldest, self%newest
         degree = max(degree, self%degree(self%slot_of(step)))
      end do
   end function degree_in_use

   !> Twice the slots, the same steps.
   pure subroutine double_capacity(self)
      !> The ring
      class(step_ring), intent(inout) :: self
      type(step_ring) :: wider
      integer :: from, to
      integer(int64) :: step

      wider = step_ring(self%kept, 2*size(self%start))
      do step = self%oldest, self%newest
         from = self%slot_of(step)
         to = wider%slot_of(step)
         wider%start(to) = self%start(from)
         wider%length(to) = self%length(from)
         wider%serves(to) = self%serves(from)
         wider%degree(to) = self%degree(from)
         wider%powers(to) = self%powers(from)
         wider%nodes(:, to) = self%nodes(:, from)
         wider%coefficients(:, :, to) = self%coefficients(:, :, from)
      end do
      call move_alloc(wider%start, self%start)
      call move_alloc(wider%length, self%length)
      call move_alloc(wider%serves, self%serves)
      call move_alloc(wider%degree, self%degree)
      call move_alloc(wider%powers, self%powers)
      call move_alloc(wider%nodes, self%nodes)
      call move_alloc(wider%coefficients, self%coefficients)
   end subroutine double_capacity
end module dde_step_ring
