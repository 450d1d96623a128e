!> The search for events in a step. Where bounds of dense output exclude events there is none. Else
!> event functions are evaluated on it, at a number of places that its degree requires, and where a
!> parabola through three of these is nearest to zero.
!> A passage between two places is located to rounding of the step.
module dde_event_search
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_dense_state, only: dense_state
   use dde_events, only: event_watcher_type
   use dde_step, only: step_type
   use dde_time, only: instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: endless, event_search, most_places

   !> Most places at which event functions are evaluated in a step. It limits the step size by
   !> `look_every`.
   real(wp), parameter :: most_places = 1.0e5_wp
   !> A time longer than any run.
   real(wp), parameter :: endless = 1.0e200_wp
   !> Events are located to this share of the step.
   real(wp), parameter :: accuracy = epsilon(1.0_wp)

   !> The search, at one place of one step.
   type :: event_search
      !> The place, and time, state and slope there of the components that the functions read
      type(dense_state), private :: here
      !> The last event: time, and state and slope of all components
      type(dense_state) :: event
      !> Whether the last event ended the run
      logical, private :: ended = .false.
      !> Event functions there
      real(wp), allocatable, private :: g(:)
      !> Sign of each function at the last place: -1, 1, or 0 at zero
      integer, allocatable, private :: side(:)
   contains
      procedure :: begin, search_step, read_slope
      procedure, private :: choose_places, go_to, report, locate, stays
   end type event_search

contains

   !> Signs of the functions at the initial time.
   pure subroutine begin(self, watcher, t, y, slope)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)
      integer :: i

      call self%here%begin(t, y, slope, watcher%reads(size(y)))
      call self%event%begin(t, y, slope, [(i, i=1, size(y))])
      allocate (self%g(size(watcher%direction)))
      allocate (self%side(size(watcher%direction)), source=0)
      call watcher%values(t%hi, y, slope, self%g)
      self%side = sign_of(self%g, self%side)
   end subroutine begin

   !> Report the events of an accepted and extended step to the watcher. On return the search is at
   !> the end of the step, or at the event that ends the run.
   subroutine search_step(self, watcher, step, start, step_end, share, ended)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(inout) :: watcher
      class(step_type), intent(in) :: step
      type(instant), intent(in) :: start
      !> End of the step; the event that ends the run, if one does
      type(instant), intent(inout) :: step_end
      !> Share of the step up to there, 0..1
      real(wp), intent(out) :: share
      logical, intent(out) :: ended
      integer :: side(size(self%side))
      integer :: i
      real(wp), allocatable :: g(:, :), places(:)
      real(wp) :: before

      call self%here%take_up(step, start, step_end)
      ended = .false.
      share = 1.0_wp
      call watcher%values(self%here%t%hi, self%here%y, self%here%slope, self%g)
      if (self%stays(watcher)) return
      call self%choose_places(watcher, places, g)
      share = 0.0_wp
      do i = 1, size(places)
         before = share
         share = places(i)
         side = sign_of(g(:, i), self%side)
         if (any(side /= self%side .and. self%side /= 0)) then
            call self%event%take_up(step, start, step_end)
            call self%report(watcher, before, share, side)
            ended = self%ended
            if (ended) step_end = self%event%t
            if (ended) return
         end if
         self%side = side
      end do
      call self%go_to(watcher, 1.0_wp)
   end subroutine search_step

   !> Whether no function leaves its side in the step, by the functions at its end and by bounds.
   logical function stays(self, watcher) result(value)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher

      value = .not. any(sign_of(self%g, self%side) /= self%side)
      if (.not. value) return
      call self%here%find_bounds()
      associate (here => self%here)
         value = watcher%never_zero(here%least, here%most, here%least_slope, here%most_slope)
      end associate
   end function stays

   !> Places at which functions are evaluated, ascending up to 1: an even grid, and places between
   !> where a function may pass zero twice.
   pure subroutine choose_places(self, watcher, places, g)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      real(wp), allocatable, intent(out) :: places(:)
      !> Event functions there, shape (functions, places)
      real(wp), allocatable, intent(out) :: g(:, :)
      real(wp), allocatable :: grid(:, :)
      real(wp) :: bend, half_rise, place
      integer :: i, k, last

      last = max(size(self%here%nodes) + 1, ceiling(self%here%h/watcher%look_every))
      allocate (grid(size(self%g), 0:last))
      do k = 0, last
         call self%go_to(watcher, k*1.0_wp/last)
         grid(:, k) = self%g
      end do
      allocate (places, source=[(k*1.0_wp/last, k=1, last)])
      allocate (g, source=grid(:, 1:))
      do k = 1, last - 1
         do i = 1, size(self%g)
            if (abs(sum(sign_of(grid(i, k - 1:k + 1), 0))) < 3) cycle
            half_rise = 0.5_wp*(grid(i, k + 1) - grid(i, k - 1))
            bend = (grid(i, k + 1) - grid(i, k)) - (grid(i, k) - grid(i, k - 1))
            ! towards zero and back: the vertex of the parabola lies between the three places
            if (sign(1.0_wp, grid(i, k))*bend <= abs(half_rise)) cycle
            place = (k - half_rise/bend)/last
            call self%go_to(watcher, place)
            associate (earlier => count(places < place))
               g = reshape([g(:, :earlier), self%g, g(:, earlier + 1:)], shape(g) + [0, 1])
               places = [places(:earlier), place, places(earlier + 1:)]
            end associate
         end do
      end do
   end subroutine choose_places

   !> Report the events between two places, in order of time, up to the end of the run.
   subroutine report(self, watcher, before, share, side)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(inout) :: watcher
      real(wp), intent(in) :: before
      !> The later place; the event that ends the run, if one does
      real(wp), intent(inout) :: share
      integer, intent(in) :: side(:)
      real(wp) :: root(size(side))
      logical :: passed(size(side))
      integer :: i

      passed = side /= self%side .and. self%side /= 0 .and. watcher%direction*self%side <= 0
      root = share
      do i = 1, size(side)
         if (passed(i)) call self%locate(watcher, i, before, root(i))
      end do
      do while (any(passed))
         i = minloc(root, dim=1, mask=passed)
         if (self%ended .and. root(i) > share) exit
         passed(i) = .false.
         call self%event%go_to(root(i))
         call watcher%take(i, self%event%t, self%event%y, self%event%slope)
         if (watcher%terminal(i)) then
            self%ended = .true.
            share = root(i)
         end if
      end do
   end subroutine report

   !> Replace the slope where the search is by the one that the functions were given last, of the
   !> components that they read; of all, if an event ended the run.
   pure subroutine read_slope(self, slope)
      class(event_search), intent(in) :: self
      real(wp), intent(inout) :: slope(:)

      if (self%ended) then
         slope = self%event%slope
      else if (allocated(self%here%components)) then
         slope(self%here%components) = self%here%slope(self%here%components)
      end if
   end subroutine read_slope

   !> First place after `before` where function `i` has no longer its sign, by the method of
   !> Oliveira and Takahashi (2020), "An Enhancement of the Bisection Method Average Performance
   !> Preserving Minmax Optimality": at most one evaluation more than bisection.
   subroutine locate(self, watcher, i, before, root)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      integer, intent(in) :: i
      !> A place where it has its sign
      real(wp), intent(in) :: before
      !> A place where it has not; on return the first one
      real(wp), intent(inout) :: root
      real(wp) :: first_width, g_left, g_right, left, move, place, width
      integer :: j, halvings

      call self%go_to(watcher, root)
      g_right = self%g(i)
      left = before
      call self%go_to(watcher, left)
      ! a slope may jump where the step begins
      if (sign_of(self%g(i), self%side(i)) /= self%side(i)) root = left
      g_left = self%g(i)
      first_width = root - left
      halvings = max(0, exponent(first_width/accuracy)) + 1
      do j = halvings, 0, -1
         width = root - left
         if (width <= accuracy) exit
         ! from the middle towards the secant's zero, as far as the bound on evaluations allows
         move = 0.0_wp
         if (ieee_is_finite(g_left)) move = width*(g_left/(g_left - g_right) - 0.5_wp)
         move = sign(max(0.0_wp, min(abs(move) - 0.2_wp*width**2/first_width, &
                                     scale(0.5_wp*accuracy, j) - 0.5_wp*width)), move)
         place = left + 0.5_wp*width + move
         call self%go_to(watcher, place)
         if (sign_of(self%g(i), self%side(i)) == self%side(i)) then
            left = place
            g_left = self%g(i)
         else
            root = place
            g_right = self%g(i)
         end if
      end do
   end subroutine locate

   !> Evaluate the functions at one place of the step.
   pure subroutine go_to(self, watcher, place)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      real(wp), intent(in) :: place

      call self%here%go_to(place)
      call watcher%values(self%here%t%hi, self%here%y, self%here%slope, self%g)
   end subroutine go_to

   !> Sign of a value; the last one if the value is not finite.
   elemental integer function sign_of(g, last) result(side)
      real(wp), intent(in) :: g
      integer, intent(in) :: last

      side = last
      if (.not. ieee_is_finite(g)) return
      side = 0
      if (g > 0.0_wp) side = 1
      if (g < 0.0_wp) side = -1
   end function sign_of
end module dde_event_search
