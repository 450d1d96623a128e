! SPDX-License-Identifier: BSD-3-Clause
!> The search for events in a step. Where bounds of dense output exclude events there is none. Else
!> event functions are evaluated on it, at a number of places that its degree requires, and each
!> where a parabola through three of these is nearest to zero. A passage between two places is
!> located to rounding of the step; this costs evaluations of its function alone.
module dde_event_search
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_dense_state, only: dense_state
   use dde_events, only: event_watcher_type
   use dde_step, only: step_type
   use dde_time, only: ascending, instant
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
      !> Share of the step that is searched
      real(wp), private :: reach = 1.0_wp
      !> Event functions there
      real(wp), allocatable, private :: g(:)
      !> Sign of each function at the last place: -1, 1, or 0 at zero
      integer, allocatable, private :: side(:)
   contains
      procedure :: begin, search_step, read_slope
      procedure, private :: fill_grid, find_passages, go_to, locate, report, stays
   end type event_search

contains

   !> Signs of the functions at the initial time, unless they are given.
   pure subroutine begin(self, watcher, t, y, slope, side)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)
      integer, intent(in), optional :: side(:)
      integer :: i

      call self%here%begin(t, y, slope, watcher%reads(size(y)))
      call self%event%begin(t, y, slope, [(i, i=1, size(y))])
      allocate (self%g(size(watcher%direction)))
      allocate (self%side(size(watcher%direction)), source=0)
      call watcher%values(t%hi, y, slope, self%g)
      self%side = sign_of(self%g, self%side)
      if (present(side)) self%side = side
   end subroutine begin

   !> Report the events of an accepted step, up to a share of it, to the watcher. On return the
   !> search is there, or at the event that ends the run.
   subroutine search_step(self, watcher, step, start, step_end, share, beyond, ended)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(inout) :: watcher
      class(step_type), intent(in) :: step
      type(instant), intent(in) :: start
      !> End of the step; the event that ends the run, if one does
      type(instant), intent(inout) :: step_end
      !> Share of the step up to there, 0..1
      real(wp), intent(inout) :: share
      !> Share beyond it in which functions pass zero that would there but for rounding
      real(wp), intent(in) :: beyond
      logical, intent(out) :: ended
      integer, allocatable :: which(:)
      real(wp), allocatable :: grid(:, :), root(:)
      integer :: found, i

      call self%here%take_up(step, start, step_end)
      ended = .false.
      self%reach = share + beyond
      if (share < 1.0_wp .or. beyond > 0.0_wp) call self%here%go_to(self%reach)
      call watcher%values(self%here%t%hi, self%here%y, self%here%slope, self%g)
      if (self%stays(watcher)) return
      call self%fill_grid(watcher, grid)
      ! at each place of the grid and at up to two beside it
      allocate (root(3*size(grid)), which(3*size(grid)))
      found = 0
      do i = 1, size(self%g)
         call self%find_passages(watcher, i, grid(:, i), root, which, found)
      end do
      if (beyond > 0.0_wp) then
         ! these are at zero there, and on no side
         self%side(pack(which(:found), root(:found) >= share - beyond)) = 0
         where (root(:found) >= share - beyond) root(:found) = share
      end if
      if (found > 0) then
         call self%event%take_up(step, start, step_end)
         call self%report(watcher, root(:found), which(:found), share)
         ended = self%ended
         if (ended) step_end = self%event%t
         if (ended) return
      end if
      call self%here%go_to(share)
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

   !> All functions on an even grid over the step.
   pure subroutine fill_grid(self, watcher, grid)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      !> Event functions, shape (0:last, functions)
      real(wp), allocatable, intent(out) :: grid(:, :)
      integer :: k, last

      last = max(size(self%here%nodes) + 1, ceiling(self%here%h/watcher%look_every))
      allocate (grid(0:last, size(self%g)))
      do k = 0, last
         call self%here%go_to(self%reach*k/last)
         call watcher%values(self%here%t%hi, self%here%y, self%here%slope, self%g)
         grid(k, :) = self%g
      end do
   end subroutine fill_grid

   !> Append the passages of one function: between places of the grid and places beside them where
   !> it may pass zero twice. On return its side is that at the end of the step.
   subroutine find_passages(self, watcher, i, grid, root, which, found)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      integer, intent(in) :: i
      !> The function on the grid, shape (0:last)
      real(wp), intent(in) :: grid(0:)
      !> Places of passages and their functions, the first `found` of them
      real(wp), intent(inout) :: root(:)
      integer, intent(inout) :: which(:), found
      real(wp) :: before, g_before, vertex(0:1)
      integer :: k, last

      last = ubound(grid, 1)
      before = 0.0_wp
      g_before = grid(0)
      vertex = 0.0_wp
      do k = 1, last
         ! beside the left end of this interval, and its right end
         vertex(0) = vertex(1)
         vertex(1) = 0.0_wp
         if (k < last) vertex(1) = vertex_of(grid(k - 1:k + 1))
         if (vertex(0) > 0.0_wp) call look(self%reach*(k - 1 + vertex(0))/last)
         if (vertex(1) < 0.0_wp) call look(self%reach*(k + vertex(1))/last)
         call look(self%reach*k/last, grid(k))
      end do

   contains

      !> Look at the next place, and append the passage since the place before.
      subroutine look(place, known)
         real(wp), intent(in) :: place
         !> The function there, if it is known
         real(wp), intent(in), optional :: known
         real(wp) :: g
         integer :: side

         if (present(known)) then
            g = known
         else
            call self%go_to(watcher, i, place, g)
         end if
         side = sign_of(g, self%side(i))
         if (side /= self%side(i) .and. self%side(i)*watcher%direction(i) <= 0 &
             .and. self%side(i) /= 0) then
            found = found + 1
            root(found) = place
            which(found) = i
            if (.not. known_passage()) then
               call self%locate(watcher, i, before, g_before, g, root(found))
            end if
         end if
         self%side(i) = side
         before = place
         g_before = g
      end subroutine look

      !> Whether the passage is the last one found, of another function: both may be of one delay.
      logical function known_passage() result(value)
         real(wp) :: g

         value = .false.
         if (found == 1) return
         associate (last => root(found - 1))
            if (last <= before .or. last > root(found)) return
            call self%go_to(watcher, i, last, g)
            if (sign_of(g, self%side(i)) == self%side(i)) return
            call self%go_to(watcher, i, last - accuracy, g)
            value = sign_of(g, self%side(i)) == self%side(i)
            if (value) root(found) = last
         end associate
      end function known_passage
   end subroutine find_passages

   !> Place of the vertex of a parabola through three values at -1, 0 and 1, if it goes from zero
   !> and back there, on one side; otherwise 0.
   pure real(wp) function vertex_of(g) result(place)
      real(wp), intent(in) :: g(-1:1)
      real(wp) :: bend, half_rise

      place = 0.0_wp
      if (abs(sum(sign_of(g, 0))) < 3) return
      half_rise = 0.5_wp*(g(1) - g(-1))
      bend = (g(1) - g(0)) - (g(0) - g(-1))
      ! towards zero and back: the vertex lies between the three places
      if (sign(1.0_wp, g(0))*bend > abs(half_rise)) place = -half_rise/bend
   end function vertex_of

   !> Report passages in order of time, up to the end of the run; of those at one time all.
   subroutine report(self, watcher, root, which, share)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(inout) :: watcher
      real(wp), intent(in) :: root(:)
      integer, intent(in) :: which(:)
      !> Place of the event that ends the run, if one does
      real(wp), intent(inout) :: share
      integer :: i, k, order(size(root))

      order = ascending(root)
      do k = 1, size(order)
         i = order(k)
         if (self%ended .and. root(i) > share) exit
         call self%event%go_to(root(i), watcher%takes(which(i), size(self%event%y)))
         call watcher%take(which(i), self%event%t, self%event%y, self%event%slope)
         if (watcher%terminal(which(i))) then
            self%ended = .true.
            share = root(i)
         end if
      end do
      if (self%ended) call self%event%go_to(share)
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

   !> First place after `left` where function `i` has no longer its sign, by the method of
   !> Oliveira and Takahashi (2020), "An Enhancement of the Bisection Method Average Performance
   !> Preserving Minmax Optimality": at most one evaluation more than bisection.
   subroutine locate(self, watcher, i, before, g_before, g_root, root)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      integer, intent(in) :: i
      !> A place where it has its sign, and its values there and at the root
      real(wp), intent(in) :: before, g_before, g_root
      !> A place where it has not; on return the first one
      real(wp), intent(inout) :: root
      real(wp) :: first_width, g, g_left, g_right, left, move, place, width
      integer :: j, halvings

      left = before
      g_left = g_before
      g_right = g_root
      ! a slope may jump where the step begins
      if (sign_of(g_left, self%side(i)) /= self%side(i)) root = left
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
         call self%go_to(watcher, i, place, g)
         if (sign_of(g, self%side(i)) == self%side(i)) then
            left = place
            g_left = g
         else
            root = place
            g_right = g
         end if
      end do
   end subroutine locate

   !> Evaluate one function at a place of the step.
   pure subroutine go_to(self, watcher, i, place, g)
      class(event_search), intent(inout) :: self
      class(event_watcher_type), intent(in) :: watcher
      integer, intent(in) :: i
      real(wp), intent(in) :: place
      real(wp), intent(out) :: g

      call self%here%go_to(place, watcher%reads_for(i, size(self%here%y)))
      g = watcher%value(i, self%here%t%hi, self%here%y, self%here%slope)
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
