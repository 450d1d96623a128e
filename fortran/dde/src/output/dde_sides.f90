! SPDX-License-Identifier: BSD-3-Clause
!> The sides of the switching functions of f, which is smooth while none of them passes zero. A step
!> is made with the sides of its start, ends where the first function passes zero on its dense
!> output, and f goes to the other side there. Where f pushes the solution back from both sides, it
!> would slide along the zero (Filippov 1988, "Differential Equations with Discontinuous Righthand
!> Sides", sec. 4): it cannot go on by steps.
module dde_sides
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_event_search, only: event_search
   use dde_kink, only: kink_type
   use dde_passages, only: below_zero, find_rates, new_passages, odd, passages_type, straight
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_time, only: elapsed, instant
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: sides_type

   !> Share of a step over which rates of the functions are found, and where a run starts.
   real(wp), parameter :: ahead = 1.0e-4_wp, ahead_of_start = 1.0e-10_wp
   !> A passage as near to an end of the step, in units of the spacing of times, is there.
   real(wp), parameter :: near = 16.0_wp
   !> Even places of a step at which the functions are looked at, powers of two.
   integer, parameter :: least_places = 8, most_places = 128
   !> Part of a step that is made again up to which it may miss a kink, and how often it is made at
   !> most.
   real(wp), parameter :: least_part = 1.0e-9_wp
   integer, parameter :: most_times = 8
   !> So many changes of the state by one function within so many spacings of times have no end: a
   !> bouncing ball comes to rest.
   integer, parameter :: most_repeats = 10
   real(wp), parameter :: crowd = 1.0e7_wp
   !> Least rate at which a solution is pushed back, over that at which it came.
   real(wp), parameter :: least_push = 1.0e-6_wp

   !> The sides.
   type :: sides_type
      !> Whether f is that where each function is > 0, shape (functions)
      logical, allocatable :: above(:)
      !> Number of functions that are the problem's own
      integer, private :: own = 0
      !> How often each of the problem has changed, shape (switches)
      integer(int64), allocatable :: changes(:)
      !> The end of the step, and its share up to there
      type(instant) :: finish
      real(wp) :: share = 1.0_wp
      !> Time beyond it in which functions pass zero that would there but for rounding, where the
      !> state may jump
      real(wp) :: margin = 0.0_wp
      !> Functions that pass zero there, and the state
      logical, allocatable :: passed(:)
      real(wp), allocatable :: y(:)
      !> The kink of the solution there
      type(kink_type) :: kink
      !> Functions at whose zeros the state changed there
      logical, allocatable :: acted(:)
      !> When each that changes the state began to do so again and again, and how often it did since
      type(instant), allocatable, private :: first(:)
      integer, allocatable, private :: repeats(:)
      !> How far beyond zero each was there, if it went back, shape (functions)
      real(wp), allocatable, private :: beyond(:)
      !> Number of the function along whose zero the solution slides; 0 if it does not
      integer :: slides = 0
      !> Functions that should pass zero at the end of a step that is made again
      logical, allocatable, private :: due(:)
      !> Changes at one time, and how often the step was made again
      integer, private :: idle = 0, times = 0
      !> Whether no function can pass zero in the step
      logical, private :: quiet = .false.
      !> Places at which the functions are looked at in the step
      integer, private :: places = 2
   contains
      procedure :: begin, judge, find_end, change, meets_kink
   end type sides_type

contains

   !> The sides at the start of a run: on a zero that to which the solution goes.
   subroutine begin(self, context, y, switches)
      class(sides_type), intent(inout) :: self
      !> The context, at the start
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: y(:)
      !> Number of switching functions
      integer, intent(in) :: switches
      real(wp), dimension(switches + 2*context%problem%moving) :: g, rate
      real(wp) :: lag(context%problem%moving)
      logical :: acts(switches)
      integer :: j, k

      associate (functions => size(g), moving => size(lag), cursor => context%cursor)
         allocate (self%above(functions), self%passed(functions), self%acted(functions), &
                   source=.false.)
         allocate (self%beyond(functions), source=0.0_wp)
         allocate (self%repeats(functions), source=0)
         allocate (self%first(functions), source=cursor%start)
         allocate (self%changes(switches), source=0_int64)
         self%own = switches
         if (moving > 0) then
            self%above(switches + 1::2) = .true.
            call context%problem%moving_lags(cursor%inside(cursor%t), y, lag)
            associate (pieces => context%past%pieces)
               pieces%begin = [(pieces%find(cursor%start, -lag(j)), j=1, moving)]
            end associate
         end if
      end associate
      if (switches == 0) return
      acts = [(k > switches - context%problem%acting, k=1, switches)]
      ! a function may depend on the sides of those before it
      do k = 0, switches
         call find_rates(context, y, ahead_of_start, g, rate)
         associate (own => self%above(:switches))
            own = g(:switches) > 0.0_wp &
                  .or. .not. abs(g(:switches)) > 0.0_wp .and. goes_up(rate(:switches), acts)
            call context%problem%take_sides(own)
         end associate
      end do
   end subroutine begin

   !> Find how many places show where the functions pass zero: between these they are near lines.
   !> Reject a step that takes too many, and one at whose end a delay is below 0.
   subroutine judge(self, context, step, error)
      class(sides_type), intent(inout) :: self
      type(step_context), intent(in), target :: context
      class(step_type), intent(in), target :: step
      !> Error of the step in units of the tolerance
      real(wp), intent(inout) :: error
      real(wp) :: between(size(self%above), size(odd)), g(size(self%above), 0:most_places)
      real(wp) :: noise(size(self%above)), y(size(step%y))
      type(passages_type) :: passages
      integer :: i, stride

      if (below_zero(context, step)) then
         error = ieee_value(1.0_wp, ieee_quiet_nan)
         return
      end if
      self%quiet = .false.
      if (self%own == 0) self%quiet = .not. context%cursor%is_near_kink(context%past)
      if (self%quiet) return
      passages = new_passages(self%above, self%beyond, self%own, context, step)
      noise = merge(0.0_wp, passages%slack, [(i, i=1, size(noise))] <= self%own)
      do i = 1, size(odd)
         call look(odd(i), between(:, i))
      end do
      stride = most_places/least_places
      do i = 0, most_places, stride
         call look(real(i, wp)/most_places, g(:, i))
      end do
      do while (.not. straight(g(:, ::stride), between, noise))
         if (stride == 1) then
            error = huge(1.0_wp)
            return
         end if
         stride = stride/2
         do i = stride, most_places, 2*stride
            call look(real(i, wp)/most_places, g(:, i))
         end do
      end do
      self%places = most_places/stride

   contains

      !> The functions at a place of the step.
      subroutine look(place, values)
         real(wp), intent(in) :: place
         real(wp), intent(out) :: values(:)

         call step%state_at(place, y)
         call passages%values(step%t + place*step%h, y, y, values)
      end subroutine look
   end subroutine judge

   !> Where an accepted step ends: where the first function passes zero, if one does. If that is the
   !> end of a piece, the step is made again up to there: it read the piece beyond its end.
   subroutine find_end(self, context, step, start, whole, again)
      class(sides_type), intent(inout) :: self
      type(step_context), intent(in), target :: context
      class(step_type), intent(in), target :: step
      !> Start and end of the step
      type(instant), intent(in) :: start, whole
      !> Whether it was made again, then whether it must be, up to `finish`
      logical, intent(inout) :: again
      type(passages_type) :: passages
      type(event_search) :: search
      real(wp) :: beside
      real(wp), dimension(size(self%above)) :: g, g_end
      real(wp) :: y(size(step%y))
      logical :: ended, repeated

      repeated = again
      self%times = merge(self%times + 1, 0, repeated)
      again = .false.
      self%passed = .false.
      self%share = 1.0_wp
      self%finish = whole
      if (.not. self%quiet) then
         passages = new_passages(self%above, self%beyond, self%own, context, step)
         passages%look_every = step%h/self%places
         allocate (passages%direction(size(self%above)), source=0)
         allocate (passages%terminal(size(self%above)), source=.true.)
         call search%begin(passages, start, step%y, step%slope, merge(1, -1, self%above))
         call search%search_step(passages, step, start, self%finish, self%share, 0.0_wp, ended)
         if (ended) then
            self%passed = passages%passed
            self%y = search%event%y
         end if
      end if
      beside = near*spacing(self%finish%hi)
      if (repeated .and. 1.0_wp - self%share <= least_part) then
         ! the kink is as near to the end as it can be found
         if (.not. self%quiet) then
            call passages%values(step%t, step%y, step%slope, g)
            call passages%values(step%t + step%h, step%y_new, step%slope, g_end)
            self%passed = self%passed .or. self%due .and. abs(g_end) <= least_part*abs(g)
         end if
         self%share = 1.0_wp
      else if (elapsed(self%finish, whole) <= beside) then
         self%share = 1.0_wp
      else if (elapsed(start, self%finish) <= beside) then
         self%share = 0.0_wp
         self%finish = start
         self%y = step%y
      else if (any(self%passed(self%own + 1:)) .and. self%times < most_times) then
         again = .true.
         self%due = self%passed
         self%due(:self%own) = .false.
      end if
      self%margin = 0.0_wp
      if (context%problem%acting > 0) then
         associate (acts => acting(self, context%problem))
            call step%state_at(self%share + beside/step%h, y)
            call passages%values(step%t + self%share*step%h + beside, y, step%slope, g)
            self%passed = self%passed .or. acts .and. (self%above .neqv. g > 0.0_wp)
            if (any(self%passed .and. acts)) self%margin = beside
         end associate
      end if
      if (.not. self%share < 1.0_wp) then
         self%finish = whole
         if (any(self%passed)) self%y = step%y_new
      end if
      self%idle = merge(0, self%idle + 1, self%share > 0.0_wp)
      ! what acted at another time
      if (self%idle == 0) self%acted = .false.
   end subroutine find_end

   !> Whether the state may change at zeros of each function.
   pure function acting(self, problem) result(values)
      class(sides_type), intent(in) :: self
      class(dde_problem_type), intent(in) :: problem
      logical :: values(size(self%above))

      values = .false.
      values(self%own - problem%acting + 1:self%own) = .true.
   end function acting

   !> Whether a function goes above its zero. One that acts and stays there has passed it.
   elemental logical function goes_up(rate, acts) result(value)
      real(wp), intent(in) :: rate
      logical, intent(in) :: acts

      value = rate > 0.0_wp .or. acts .and. rate >= 0.0_wp
   end function goes_up

   !> Go to the other side of the functions that passed zero where the step ended, and to the next
   !> pieces of the past. Where the state changes, the side is that of the new state.
   subroutine change(self, context, y)
      class(sides_type), intent(inout) :: self
      !> The context, there
      type(step_context), intent(inout) :: context
      real(wp), intent(inout) :: y(:)
      real(wp), dimension(size(self%above)) :: g, g_before, before, after
      logical, dimension(size(self%above)) :: acts, again, back, changed
      integer :: k

      call find_rates(context, y, ahead, g_before, before)
      acts = acting(self, context%problem)
      self%kink = kink_type(context%cursor%start)
      if (.not. any(self%passed(:self%own) .and. .not. acts(:self%own))) then
         self%kink%passages = huge(1)
      end if
      call change_pieces(self, context)
      again = self%acted
      self%acted = .false.
      if (any(self%passed .and. acts)) call act(self, context, y)
      changed = self%passed
      changed(self%own + 1:) = .false.
      do k = 1, size(self%above)
         self%above = self%above .neqv. changed
         self%changes = self%changes + merge(1, 0, changed(:self%own) .and. .not. acts(:self%own))
         call context%problem%take_sides(self%above(:self%own))
         call find_rates(context, y, ahead, g, after)
         ! a function that depends on a side may jump beyond zero
         changed = (self%above .neqv. g > 0.0_wp) .and. .not. self%passed &
                   .and. abs(g - g_before) > 0.0_wp
         changed(self%own + 1:) = .false.
         if (.not. any(changed)) exit
      end do
      if (any(self%acted)) then
         self%changes = self%changes + merge(1, 0, self%acted(:self%own))
         ! a bounce leaves the function at its zero
         where (self%acted)
            self%above = merge(goes_up(after, acts), g > 0.0_wp, abs(g) <= abs(g_before))
            self%beyond = merge(abs(g), 0.0_wp, self%above .neqv. g > 0.0_wp)
         end where
         call context%problem%take_sides(self%above(:self%own))
         associate (now => context%cursor%start)
            where (self%acted) self%repeats = self%repeats + 1
            changed = self%acted .and. elapsed(self%first, now) > crowd*spacing(now%hi)
            where (changed) self%repeats = 0
            self%first = merge(now, self%first, changed)
         end associate
      end if
      ! an end of a piece is then the other end of the next
      after(self%own + 1:) = [(after(k + 1), after(k), k=self%own + 1, size(after), 2)]
      ! beyond it t - lag is on the other side of the function
      associate (on => [merge(1.0_wp, -1.0_wp, self%above(:self%own)), &
                        merge(-1.0_wp, 1.0_wp, self%above(self%own + 1:))])
         back = self%passed .and. .not. acts .and. on*before > 0.0_wp &
                .and. on*after < -least_push*abs(before)
         if (self%idle > size(self%above)) back = self%passed
         back = back .or. again .and. self%acted .or. self%repeats >= most_repeats
      end associate
      self%slides = findloc(back, .true., dim=1)
   end subroutine change

   !> Let the functions that passed zero change the state, in their order.
   pure subroutine act(self, context, y)
      type(sides_type), intent(inout) :: self
      !> The context, there
      type(step_context), intent(inout) :: context
      real(wp), intent(inout) :: y(:)
      real(wp) :: slope(size(y)), z(size(context%problem%lag), 1)
      integer :: i

      associate (problem => context%problem, t => context%cursor%inside(context%cursor%t))
         call context%delayed_values([0.0_wp], z)
         ! sets those of delays that move
         call context%evaluate(t, y, z(:, 1), slope)
         do i = self%own - problem%acting + 1, self%own
            if (.not. self%passed(i)) cycle
            call problem%act(i - self%own + problem%acting, .not. self%above(i), t, z(:, 1), y, &
                             self%acted(i))
         end do
      end associate
      if (any(self%acted)) self%kink%passages = -1
   end subroutine act

   !> Whether a delay that moves meets a kink at the end of the step.
   pure logical function meets_kink(self) result(value)
      class(sides_type), intent(in) :: self

      value = any(self%passed(self%own + 1:))
   end function meets_kink

   !> Go to the next piece of the past, or to the one before, where t - lag passed an end of one.
   !> The kink there returns, one derivative smoother.
   pure subroutine change_pieces(self, context)
      type(sides_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      type(kink_type) :: kink
      integer :: i, j

      associate (pieces => context%past%pieces)
         do i = self%own + 1, size(self%above)
            if (.not. self%passed(i)) cycle
            j = (i - self%own + 1)/2
            if (self%above(i)) then
               kink = pieces%kinks(pieces%begin(j))
               pieces%begin(j) = pieces%begin(j) - 1
            else
               pieces%begin(j) = pieces%begin(j) + 1
               kink = pieces%kinks(pieces%begin(j))
            end if
            kink%passages = kink%passages + 1
            kink%generation = kink%generation + 1
            call self%kink%take_in(kink)
         end do
      end associate
   end subroutine change_pieces
end module dde_sides
