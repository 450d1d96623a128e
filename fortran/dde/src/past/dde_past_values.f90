!> The past at single places: each delayed value is found step by step, in the polynomials of
!> accepted steps; before the first instant the problem's own history holds.
module dde_past_values
   use dde_interpolant, only: newton_values
   use dde_problem, only: dde_problem_type
   use dde_step_ring, only: step_ring
   use dde_time, only: elapsed, instant, later
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: past_values

   !> A step reads what lies between its ends: pieces of the past that overlap it by less than this
   !> share of it are not read, since the solution may jump where it starts and ends.
   real(wp), parameter :: overlap = 4.0_wp*epsilon(1.0_wp)
   !> Places that a method looks at at once: no more than these.
   integer, parameter :: most_places = 16
   !> The same overlap for the problem's history, in units of the spacing of times.
   real(wp), parameter :: spacings = 4.0_wp

   !> Where each delayed value was found.
   type, extends(step_ring) :: past_values
      !> First instant of the integration
      type(instant) :: origin
      !> Row of `kept` that each delayed value reads
      integer, allocatable :: row(:)
      !> Step that each delayed value was last found in
      integer(int64), allocatable :: found(:)
      !> Slot of that step, as it was when the past turned to the current one
      integer, allocatable :: slot(:)
      !> Current step's start less the delay, for each delayed value
      type(instant), allocatable :: delayed_start(:)
      !> The same, measured from the start of the step it was last found in
      real(wp), allocatable :: offset(:)
      !> Whether the current step's delayed value lies before the first instant
      logical, allocatable :: before_origin(:)
      !> Start of the current step as an ordinary number
      real(wp) :: now = 0.0_wp
      !> Length of the current step
      real(wp), private :: length_now = 0.0_wp
      !> Whether the problem's history may jump where a step starts or ends
      logical :: history_jumps = .false.
   contains
      !> A time in the problem's history
      procedure :: time_before
      !> Turn to the step that starts at a given instant
      procedure :: face
      !> All delayed values at places of the current step
      procedure :: values
      !> Let one of them read a given step
      procedure :: point_at
   end type past_values

   interface past_values
      module procedure :: new_past
   end interface past_values

contains

   !> An empty past that begins at `origin`.
   pure function new_past(problem, origin) result(past)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant of the integration
      type(instant), intent(in) :: origin
      type(past_values) :: past
      integer, allocatable :: row_of(:)
      integer :: i, k, terms

      terms = size(problem%lag)
      past%origin = origin
      allocate (row_of(problem%n), source=0)
      row_of(problem%component) = 1
      past%step_ring = step_ring(pack([(i, i=1, problem%n)], row_of > 0))
      row_of(past%kept) = [(i, i=1, size(past%kept))]
      past%row = [(row_of(problem%component(k)), k=1, terms)]
      allocate (past%found(terms), source=0_int64)
      allocate (past%slot(terms), source=0)
      allocate (past%delayed_start(terms), past%offset(terms), past%before_origin(terms))
   end function new_past

   !> Turn to the step of length `length` that starts at `start`. Steps land on every instant where
   !> a delayed time passes the origin, so one side holds for the whole step.
   pure subroutine face(self, problem, start, length)
      !> The past
      class(past_values), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Start of the step to come
      type(instant), intent(in) :: start
      !> Its length
      real(wp), intent(in) :: length
      integer :: k

      self%now = start%hi
      self%length_now = length
      do k = 1, size(self%offset)
         self%delayed_start(k) = later(start, -problem%lag(k))
         self%before_origin(k) = elapsed(self%origin, self%delayed_start(k)) < -0.5_wp*length
         if (.not. self%before_origin(k)) call self%point_at(k, max(self%found(k), self%oldest))
      end do
   end subroutine face

   !> Delayed values at several places of the current step, each place after the one before.
   pure subroutine values(self, problem, ahead, z)
      !> The past
      class(past_values), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Times since the start of the current step, ascending, 0..length, at most `most_places`
      real(wp), contiguous, intent(in) :: ahead(:)
      !> Delayed values, shape (size(problem%lag), size(ahead))
      real(wp), intent(out) :: z(:, :)
      real(wp) :: found(most_places)
      integer :: i, k

      do k = 1, size(z, 1)
         if (self%before_origin(k)) then
            do i = 1, size(ahead)
               z(k, i) = problem%history(self%time_before(problem%lag(k), ahead(i)), &
                                         problem%component(k))
            end do
         else
            call look_up(self, k, ahead, found)
            z(k, :) = found(:size(ahead))
         end if
      end do
   end subroutine values

   !> A time in the problem's history: where that may jump, one between those of the step's ends.
   pure real(wp) function time_before(self, lag, ahead) result(time)
      !> The past
      class(past_values), intent(in) :: self
      !> The delay
      real(wp), intent(in) :: lag
      !> Time since the start of the current step
      real(wp), intent(in) :: ahead
      real(wp) :: margin

      time = self%now + (ahead - lag)
      if (.not. self%history_jumps) return
      margin = spacings*spacing(max(abs(self%now), lag))
      time = max(min(time, self%now + (self%length_now - lag) - margin), self%now - lag + margin)
   end function time_before

   !> One delayed value at several places, ascending: step by step of the past.
   pure subroutine look_up(self, k, ahead, z)
      !> The past
      class(past_values), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> Times since the start of the current step, ascending
      real(wp), contiguous, intent(in) :: ahead(:)
      !> The delayed value there
      real(wp), intent(inout) :: z(most_places)
      real(wp) :: first_place, limit, margin
      integer :: first, slot

      margin = overlap*self%length_now
      first_place = max(ahead(1), margin)
      do while (self%offset(k) + first_place < 0.0_wp .and. self%found(k) > self%oldest)
         call self%point_at(k, self%found(k) - 1)
      end do
      do while (self%offset(k) + first_place > self%length(self%slot(k)) &
                .and. self%found(k) < self%newest)
         call self%point_at(k, self%found(k) + 1)
      end do
      first = 1
      do
         slot = self%slot(k)
         limit = merge(huge(1.0_wp), self%length(slot) + margin, self%found(k) == self%newest)
         call newton_values(self%degree(slot), self%nodes(:, slot), &
                            self%coefficients(:, self%row(k), slot), self%offset(k), &
                            self%length(slot), limit, size(ahead), ahead, first, z)
         if (first > size(ahead)) exit
         call self%point_at(k, self%found(k) + 1)
      end do
   end subroutine look_up

   !> Let delayed value k read step number `step`.
   pure subroutine point_at(self, k, step)
      !> The past
      class(past_values), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> Number of the step
      integer(int64), intent(in) :: step

      self%found(k) = step
      self%slot(k) = self%slot_of(step)
      self%offset(k) = elapsed(self%start(self%slot(k)), self%delayed_start(k))
   end subroutine point_at
end module dde_past_values
