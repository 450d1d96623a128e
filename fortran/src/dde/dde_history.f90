!> The past: the polynomials of accepted steps for the delayed components only, in a ring that
!> forgets what no delay can reach any more; before the first instant, the problem's own history.
module dde_history
   use dde_interpolant, only: highest_degree, newton_values, taylor_coefficients
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant, later
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: history_type

   !> Slots of a new ring; it doubles when the longest delay spans more steps.
   integer, parameter :: first_capacity = 64
   !> Part of a step that rounding may hide.
   real(wp), parameter :: hidden = 4.0_wp*epsilon(1.0_wp)

   !> The past of one integration.
   type :: history_type
      private
      !> Components of y that are kept, without repetition
      integer, allocatable, public :: kept(:)
      !> First instant of the integration
      type(instant) :: origin
      !> Newton nodes of each step's interpolant, shape (highest degree, slot), unused ones last
      real(wp), allocatable :: nodes(:, :)
      !> Numbers of the oldest and the newest step kept; step i lives in slot modulo(i, capacity)
      integer(int64), public :: oldest = 0, newest = -1
      !> Start of each step kept, per slot
      type(instant), allocatable :: start(:)
      !> Length of each step kept, per slot
      real(wp), allocatable :: length(:)
      !> How long from its start on the interpolant serves, its length or longer, per slot
      real(wp), allocatable :: serves(:)
      !> Degree of the interpolant, per slot
      integer, allocatable :: degree(:)
      !> Its coefficients (0:highest degree, kept component, slot), 0 above the degree
      real(wp), allocatable :: coefficients(:, :, :)
      !> Row of `kept` that each delayed value reads
      integer, allocatable :: row(:)
      !> Step that each delayed value was last found in
      integer(int64), allocatable :: found(:)
      !> Slot of that step
      integer, allocatable :: slot(:)
      !> Current step's start less the delay, for each delayed value
      type(instant), allocatable :: delayed_start(:)
      !> The same, measured from the start of the step it was last found in
      real(wp), allocatable :: offset(:)
      !> Whether the current step's delayed value lies before the first instant
      logical, allocatable :: before_origin(:)
      !> Start of the current step as an ordinary number
      real(wp) :: now = 0.0_wp
   contains
      !> Take in an accepted step
      procedure :: append
      !> Give a kept step back
      procedure :: recall
      !> Drop what ended before a given instant
      procedure :: forget
      !> Turn to the step that starts at a given instant
      procedure :: face
      !> All delayed values at places of the current step
      procedure :: values
      !> Their Taylor series from the start of the current step on
      procedure :: series
      !> Highest degree of the interpolants kept
      procedure :: degree_in_use
   end type history_type

   interface history_type
      module procedure :: new_history
   end interface history_type

contains

   !> An empty past that begins at `origin`.
   pure function new_history(problem, origin) result(past)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant of the integration
      type(instant), intent(in) :: origin
      type(history_type) :: past
      integer :: i, k, terms

      terms = size(problem%lag)
      past%origin = origin
      past%kept = pack([(i, i=1, problem%n)], [(any(problem%component == i), i=1, problem%n)])
      past%row = [(findloc(past%kept, problem%component(k), dim=1), k=1, terms)]
      allocate (past%start(0:first_capacity - 1), past%length(0:first_capacity - 1))
      allocate (past%serves(0:first_capacity - 1), past%degree(0:first_capacity - 1))
      allocate (past%nodes(highest_degree, 0:first_capacity - 1), source=0.0_wp)
      allocate (past%coefficients(0:highest_degree, size(past%kept), 0:first_capacity - 1))
      allocate (past%found(terms), source=0_int64)
      allocate (past%slot(terms), source=0)
      allocate (past%delayed_start(terms), past%offset(terms), past%before_origin(terms))
   end function new_history

   !> Take in the polynomial of the step from `start`, `length` long.
   pure subroutine append(self, start, length, nodes, coefficients, serves)
      !> The past
      class(history_type), intent(inout) :: self
      !> Start of the step
      type(instant), intent(in) :: start
      !> Length of the step
      real(wp), intent(in) :: length
      !> Newton nodes of its interpolant
      real(wp), intent(in) :: nodes(:)
      !> Interpolant of the kept components, shape (0:degree, kept)
      real(wp), intent(in) :: coefficients(0:, :)
      !> How long from the start on it serves; less than the length counts as the length
      real(wp), intent(in) :: serves
      integer :: slot

      if (self%newest - self%oldest + 1 == size(self%start)) call double_capacity(self)
      self%newest = self%newest + 1
      slot = int(modulo(self%newest, size(self%start, kind=int64)))
      self%start(slot) = start
      self%length(slot) = length
      self%serves(slot) = max(length, serves)
      self%degree(slot) = size(nodes)
      self%nodes(:size(nodes), slot) = nodes
      self%coefficients(:size(nodes), :, slot) = coefficients
      self%coefficients(size(nodes) + 1:, :, slot) = 0.0_wp
   end subroutine append

   !> Step number `step`, oldest..newest, as it was appended.
   pure subroutine recall(self, step, start, length, nodes, coefficients)
      !> The past
      class(history_type), intent(in) :: self
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

      slot = int(modulo(step, size(self%start, kind=int64)))
      start = self%start(slot)
      length = self%length(slot)
      nodes = self%nodes(:size(nodes), slot)
      coefficients = self%coefficients(0:size(nodes), :, slot)
   end subroutine recall

   !> Drop the steps that ended before `horizon`; the newest stays.
   pure subroutine forget(self, horizon)
      !> The past
      class(history_type), intent(inout) :: self
      !> Nothing before this instant will be asked for
      type(instant), intent(in) :: horizon
      integer :: slot

      do while (self%oldest < self%newest)
         slot = int(modulo(self%oldest, size(self%start, kind=int64)))
         if (elapsed(self%start(slot), horizon) < self%length(slot)) exit
         self%oldest = self%oldest + 1
      end do
   end subroutine forget

   !> Turn to the step of length `length` that starts at `start`. Steps land on every instant where
   !> a delayed time passes the origin, so one side holds for the whole step.
   pure subroutine face(self, problem, start, length)
      !> The past
      class(history_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Start of the step to come
      type(instant), intent(in) :: start
      !> Its length
      real(wp), intent(in) :: length
      integer :: k

      self%now = start%hi
      do k = 1, size(self%offset)
         self%delayed_start(k) = later(start, -problem%lag(k))
         self%before_origin(k) = elapsed(self%origin, self%delayed_start(k)) < -0.5_wp*length
         if (.not. self%before_origin(k)) call point_at(self, k, max(self%found(k), self%oldest))
      end do
   end subroutine face

   !> Delayed values at several places of the current step, each place after the one before.
   pure subroutine values(self, problem, ahead, z)
      !> The past
      class(history_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Times since the start of the current step, ascending, 0..length
      real(wp), intent(in) :: ahead(:)
      !> Delayed values, shape (size(problem%lag), size(ahead))
      real(wp), intent(out) :: z(:, :)
      integer :: i, k

      do k = 1, size(z, 1)
         if (self%before_origin(k)) then
            do i = 1, size(ahead)
               z(k, i) = problem%history(self%now + (ahead(i) - problem%lag(k)), &
                                         problem%component(k))
            end do
         else
            call look_up(self, k, ahead, z(k, :))
         end if
      end do
   end subroutine values

   !> One delayed value at several places, ascending: step by step of the past.
   pure subroutine look_up(self, k, ahead, z)
      !> The past
      class(history_type), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> Times since the start of the current step, ascending
      real(wp), intent(in) :: ahead(:)
      !> The delayed value there
      real(wp), intent(out) :: z(:)
      real(wp) :: limit
      integer :: first, slot

      do while (self%offset(k) + ahead(1) < 0.0_wp .and. self%found(k) > self%oldest)
         call point_at(self, k, self%found(k) - 1)
      end do
      first = 1
      do
         slot = self%slot(k)
         limit = merge(huge(1.0_wp), self%length(slot), self%found(k) == self%newest)
         call newton_values(self%degree(slot), self%nodes(:, slot), self%coefficients(:, self%row(k), slot), &
                            self%offset(k), self%length(slot), limit, size(ahead), ahead, first, z)
         if (first > size(ahead)) exit
         call point_at(self, k, self%found(k) + 1)
      end do
   end subroutine look_up

   !> Taylor series of the delayed values from the start of the current step on.
   pure subroutine series(self, problem, unit, z, serves)
      !> The past, facing this step
      class(history_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Coefficients, shape (0:degree, size(problem%lag))
      real(wp), intent(out) :: z(0:, :)
      !> How long they serve
      real(wp), intent(out) :: serves
      real(wp) :: place
      integer :: k, slot

      serves = huge(1.0_wp)
      do k = 1, size(z, 2)
         if (self%before_origin(k)) then
            call problem%past_series(self%now - problem%lag(k), problem%component(k), unit, z(:, k))
            cycle
         end if
         do while (self%offset(k) < 0.0_wp .and. self%found(k) > self%oldest)
            call point_at(self, k, self%found(k) - 1)
         end do
         do while (self%found(k) < self%newest)
            if (self%offset(k) < (1.0_wp - hidden)*self%length(self%slot(k))) exit
            call point_at(self, k, self%found(k) + 1)
         end do
         slot = self%slot(k)
         place = self%offset(k)/self%length(slot)
         if (abs(place) < hidden) place = 0.0_wp
         call taylor_coefficients(self%degree(slot), self%nodes(:, slot), &
                                  self%coefficients(:, self%row(k), slot), place, &
                                  unit/self%length(slot), z(:, k))
         serves = min(serves, self%serves(slot) - self%offset(k))
      end do
   end subroutine series

   !> Highest degree of the interpolants kept.
   pure integer function degree_in_use(self) result(degree)
      !> The past
      class(history_type), intent(in) :: self
      integer(int64) :: step

      degree = 0
      do step = self%oldest, self%newest
         degree = max(degree, self%degree(int(modulo(step, size(self%start, kind=int64)))))
      end do
   end function degree_in_use

   !> Let delayed value k read step number `step`.
   pure subroutine point_at(self, k, step)
      !> The past
      class(history_type), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> Number of the step
      integer(int64), intent(in) :: step

      self%found(k) = step
      self%slot(k) = int(modulo(step, size(self%start, kind=int64)))
      self%offset(k) = elapsed(self%start(self%slot(k)), self%delayed_start(k))
   end subroutine point_at

   !> Twice the slots, the same steps.
   pure subroutine double_capacity(self)
      !> The past
      class(history_type), intent(inout) :: self
      type(history_type) :: wider
      integer :: capacity, from, to
      integer(int64) :: step

      capacity = size(self%start)
      allocate (wider%start(0:2*capacity - 1), wider%length(0:2*capacity - 1))
      allocate (wider%serves(0:2*capacity - 1), wider%degree(0:2*capacity - 1))
      allocate (wider%nodes(highest_degree, 0:2*capacity - 1), source=0.0_wp)
      allocate (wider%coefficients(0:highest_degree, size(self%kept), 0:2*capacity - 1))
      do step = self%oldest, self%newest
         from = int(modulo(step, int(capacity, int64)))
         to = int(modulo(step, int(2*capacity, int64)))
         wider%start(to) = self%start(from)
         wider%length(to) = self%length(from)
         wider%serves(to) = self%serves(from)
         wider%degree(to) = self%degree(from)
         wider%nodes(:, to) = self%nodes(:, from)
         wider%coefficients(:, :, to) = self%coefficients(:, :, from)
      end do
      call move_alloc(wider%start, self%start)
      call move_alloc(wider%length, self%length)
      call move_alloc(wider%serves, self%serves)
      call move_alloc(wider%degree, self%degree)
      call move_alloc(wider%nodes, self%nodes)
      call move_alloc(wider%coefficients, self%coefficients)
      self%slot = int(modulo(self%found, int(2*capacity, int64)))
   end subroutine double_capacity
end module dde_history
