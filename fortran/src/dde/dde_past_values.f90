!> The past at single places: each delayed value is found step by step, in the polynomials of
!> accepted steps; before the first instant the problem's own history holds.
module dde_past_values
   use dde_interpolant, only: newton_values
   use dde_problem, only: dde_problem_type
   use dde_step_ring, only: step_ring
   use dde_time, only: elapsed, instant, later
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: past_values

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
   contains
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
      integer :: i, k, terms

      terms = size(problem%lag)
      past%origin = origin
      past%step_ring = step_ring(pack([(i, i=1, problem%n)], &
                                      [(any(problem%component == i), i=1, problem%n)]))
      past%row = [(findloc(past%kept, problem%component(k), dim=1), k=1, terms)]
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
      class(past_values), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> Times since the start of the current step, ascending
      real(wp), intent(in) :: ahead(:)
      !> The delayed value there
      real(wp), intent(out) :: z(:)
      real(wp) :: limit
      integer :: first, slot

      do while (self%offset(k) + ahead(1) < 0.0_wp .and. self%found(k) > self%oldest)
         call self%point_at(k, self%found(k) - 1)
      end do
      first = 1
      do
         slot = self%slot(k)
         limit = merge(huge(1.0_wp), self%length(slot), self%found(k) == self%newest)
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
