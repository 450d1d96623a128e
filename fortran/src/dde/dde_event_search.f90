!> The search for events in a step: dense output is looked at in as many places as its degree asks
!> for, and where a parabola through three of them comes nearest to zero; a passage between two
!> places is located to the last digits of the step.
module dde_event_search
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_events, only: event_watcher_type
   use dde_interpolant, only: newton_slope, newton_value
   use dde_step, only: step_type
   use dde_time, only: instant, later
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: event_search

   !> Events are located to this share of the step.
   real(wp), parameter :: accuracy = epsilon(1.0_wp)
   !> Rounding of a state, relative, that the slope of dense output may carry over a step length.
   real(wp), parameter :: rounding = 16.0_wp*epsilon(1.0_wp)

   !> The search, at one place of one step.
   type :: event_search
      !> When
      type(instant) :: t
      !> State and its time derivative there, shape (n)
      real(wp), allocatable :: y(:), slope(:)
      !> Event functions there
      real(wp), allocatable, private :: g(:)
      !> Side of zero that each function was last seen on, going forward: -1, 1, or 0 at zero
      integer, allocatable, private :: side(:)
      !> Dense output of the step, shape (0:degree, n)
      real(wp), allocatable, private :: coefficients(:, :)
      !> Slopes at both ends of a step so short that its rounding hides those between, shape (2, n)
      real(wp), allocatable, private :: ends(:, :)
      !> Whether that is so, shape (n)
      logical, allocatable, private :: straight(:)
   contains
      !> Look at the first instant
      procedure :: begin
      !> Look through a step
      procedure :: look_through
      procedure, private :: choose_places, go_to, hand_over, locate
   end type event_search

contains

   !> See on which side of zero each function starts.
   pure subroutine begin(self, watcher, t, y, slope)
      !> The search
      class(event_search), intent(inout) :: self
      !> The watcher
      class(event_watcher_type), intent(in) :: watcher
      !> First instant
      type(instant), intent(in) :: t
      !> State there, shape (n)
      real(wp), intent(in) :: y(:)
      !> Its time derivative, shape (n)
      real(wp), intent(in) :: slope(:)

      self%t = t
      self%y = y
      self%slope = slope
      allocate (self%g(size(watcher%direction)))
      allocate (self%side(size(watcher%direction)), source=0)
      allocate (self%ends(2, size(y)), self%straight(size(y)))
      call watcher%values(t%hi, y, slope, self%g)
      self%side = seen(self%g, self%side)
   end subroutine begin

   !> Hand over the events of an accepted and extended step. Afterwards the search stands at the end
   !> of the step, or at the event that ends the run.
   subroutine look_through(self, watcher, step, start, step_end, share, ended)
      !> The search
      class(event_search), intent(inout) :: self
      !> The watcher
      class(event_watcher_type), intent(inout) :: watcher
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end; the event that ends the run, if one does
      type(instant), intent(inout) :: step_end
      !> Share of the step up to there, 0..1
      real(wp), intent(out) :: share
      !> Whether an event ends the run
      logical, intent(out) :: ended
      integer :: side(size(self%side))
      integer :: i
      real(wp), allocatable :: places(:)
      real(wp) :: before

      if (allocated(self%coefficients)) deallocate (self%coefficients)
      allocate (self%coefficients(0:size(step%nodes), size(step%y)))
      do i = 1, size(step%y)
         associate (a => self%coefficients(:, i), ends => self%ends(:, i))
            call step%interpolant(i, a)
            ends = [newton_slope(step%nodes, a, 0.0_wp), newton_slope(step%nodes, a, 1.0_wp)]
            self%straight(i) = abs(ends(2) - ends(1)) <= rounding*abs(step%y(i))
         end associate
      end do
      call self%choose_places(watcher, step, start, step_end, places)
      ended = .false.
      share = 0.0_wp
      do i = 1, size(places)
         before = share
         share = places(i)
         call self%go_to(watcher, step, start, step_end, share)
         side = seen(self%g, self%side)
         if (any(side /= self%side .and. self%side /= 0)) then
            call self%hand_over(watcher, step, start, step_end, before, share, side, ended)
            if (ended) step_end = self%t
            if (ended) return
            call self%go_to(watcher, step, start, step_end, share)
         end if
         self%side = side
      end do
   end subroutine look_through

   !> Places to look at, ascending up to 1: an even grid, and between its places where functions may
   !> dip through zero and back.
   pure subroutine choose_places(self, watcher, step, start, step_end, places)
      !> The search
      class(event_search), intent(inout) :: self
      !> The watcher
      class(event_watcher_type), intent(in) :: watcher
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      !> The places
      real(wp), allocatable, intent(out) :: places(:)
      real(wp) :: g(0:size(step%nodes) + 1, size(self%g)), bend, half_rise, place
      integer :: i, k, last

      last = size(step%nodes) + 1
      do k = 0, last
         call self%go_to(watcher, step, start, step_end, k*1.0_wp/last)
         g(k, :) = self%g
      end do
      allocate (places, source=[(k*1.0_wp/last, k=1, last)])
      do i = 1, size(g, 2)
         do k = 1, last - 1
            if (abs(sum(seen(g(k - 1:k + 1, i), 0))) < 3) cycle
            half_rise = 0.5_wp*(g(k + 1, i) - g(k - 1, i))
            bend = (g(k + 1, i) - g(k, i)) - (g(k, i) - g(k - 1, i))
            ! towards zero and back, with the vertex of the parabola between the three
            if (sign(1.0_wp, g(k, i))*bend <= abs(half_rise)) cycle
            place = (k - half_rise/bend)/last
            places = [pack(places, places < place), place, pack(places, places > place)]
         end do
      end do
   end subroutine choose_places

   !> Hand over the events between two places, in order of time, as far as the run goes on.
   subroutine hand_over(self, watcher, step, start, step_end, before, share, side, ended)
      !> The search
      class(event_search), intent(inout) :: self
      !> The watcher
      class(event_watcher_type), intent(inout) :: watcher
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      !> The earlier place
      real(wp), intent(in) :: before
      !> The later place; the event that ends the run, if one does
      real(wp), intent(inout) :: share
      !> Sides seen at the later place
      integer, intent(in) :: side(:)
      !> Whether an event ends the run
      logical, intent(out) :: ended
      real(wp) :: root(size(side))
      logical :: passed(size(side))
      integer :: i

      passed = side /= self%side .and. self%side /= 0 .and. watcher%direction*self%side <= 0
      root = share
      do i = 1, size(side)
         if (passed(i)) call self%locate(watcher, step, start, step_end, i, before, root(i))
      end do
      ended = .false.
      do while (any(passed))
         i = minloc(root, dim=1, mask=passed)
         if (ended .and. root(i) > share) exit
         passed(i) = .false.
         call self%go_to(watcher, step, start, step_end, root(i))
         call watcher%take(i, self%t, self%y, self%slope)
         if (watcher%terminal(i)) then
            ended = .true.
            share = root(i)
         end if
      end do
   end subroutine hand_over

   !> First place after `before` where function `i` is not on its side of zero any more, by the
   !> method of Oliveira and Takahashi (2020), "An Enhancement of the Bisection Method Average
   !> Performance Preserving Minmax Optimality": never more evaluations than halving and one.
   subroutine locate(self, watcher, step, start, step_end, i, before, root)
      !> The search
      class(event_search), intent(inout) :: self
      !> The watcher
      class(event_watcher_type), intent(in) :: watcher
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      !> Number of the function
      integer, intent(in) :: i
      !> A place where it is on its side
      real(wp), intent(in) :: before
      !> A place where it is not; the first one
      real(wp), intent(inout) :: root
      real(wp) :: first_width, g_left, g_right, left, move, place, width
      integer :: j, halvings

      call self%go_to(watcher, step, start, step_end, root)
      g_right = self%g(i)
      left = before
      call self%go_to(watcher, step, start, step_end, left)
      ! a slope may jump where the step begins
      if (seen(self%g(i), self%side(i)) /= self%side(i)) root = left
      g_left = self%g(i)
      first_width = root - left
      halvings = max(0, exponent(first_width/accuracy)) + 1
      do j = halvings, 0, -1
         width = root - left
         if (width <= accuracy) exit
         ! from the middle to the secant's zero, short of it, no further than halving allows
         move = 0.0_wp
         if (ieee_is_finite(g_left)) move = width*(g_left/(g_left - g_right) - 0.5_wp)
         move = sign(max(0.0_wp, min(abs(move) - 0.2_wp*width**2/first_width, &
                                     scale(0.5_wp*accuracy, j) - 0.5_wp*width)), move)
         place = left + 0.5_wp*width + move
         call self%go_to(watcher, step, start, step_end, place)
         if (seen(self%g(i), self%side(i)) == self%side(i)) then
            left = place
            g_left = self%g(i)
         else
            root = place
            g_right = self%g(i)
         end if
      end do
   end subroutine locate

   !> Look at one place of the step.
   pure subroutine go_to(self, watcher, step, start, step_end, place)
      !> The search
      class(event_search), intent(inout) :: self
      !> The watcher
      class(event_watcher_type), intent(in) :: watcher
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      !> The place, 0..1
      real(wp), intent(in) :: place
      integer :: i

      self%t = later(start, place*step%h)
      do i = 1, size(self%y)
         associate (a => self%coefficients(:, i))
            self%y(i) = newton_value(step%nodes, a, place)
            if (self%straight(i)) then
               self%slope(i) = ((1.0_wp - place)*self%ends(1, i) + place*self%ends(2, i))/step%h
            else
               self%slope(i) = newton_slope(step%nodes, a, place)/step%h
            end if
         end associate
      end do
      if (place >= 1.0_wp) then
         ! the very numbers that the next step starts from
         self%t = step_end
         self%y = step%y_new
      end if
      call watcher%values(self%t%hi, self%y, self%slope, self%g)
   end subroutine go_to

   !> Side of zero of a value; the last one seen where the value is not finite.
   elemental integer function seen(g, last) result(side)
      !> The value
      real(wp), intent(in) :: g
      !> Side last seen
      integer, intent(in) :: last

      side = last
      if (.not. ieee_is_finite(g)) return
      side = 0
      if (g > 0.0_wp) side = 1
      if (g < 0.0_wp) side = -1
   end function seen
end module dde_event_search
