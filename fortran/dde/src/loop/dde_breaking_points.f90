! SPDX-License-Identifier: BSD-3-Clause
!> Breaking points: a kink (or jump) returns after each delay, one derivative smoother at each
!> passage (Bellen and Zennaro 2003, "Numerical Methods for Delay Differential Equations", sec.
!> 2.2). A point that the run lands on adds those of the next generation.
!>
!> The run lands on all points where the right-hand side or the slope jumps, and on those of the
!> first generation if there are more delays than equations: the errors of kinks that one equation
!> meets would add up. Where a stricter tolerance takes fewer steps than that, it passes over those
!> of the first generation with this tolerance. Another point can make a step shorter than half the
!> proposed size. Only a limited number of such steps is taken; after that the run steps over these
!> points. The error estimate covers the kink then: if the step is accepted, the kink is below the
!> tolerance, and so are the smoother kinks that it would cause.
module dde_breaking_points
   use dde_kink, only: kink_type
   use dde_time, only: ascending, elapsed, instant, later
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: breaking_points, stretch

   !> A step below this share of the proposed step size is short.
   real(wp), parameter :: short = 0.5_wp
   !> A step may be this many times longer than proposed to end at a point.
   real(wp), parameter :: stretch = 1.01_wp
   !> Steps that pay for one that ends where a delay that moves meets a kink.
   integer, parameter :: price_of_kink = 3
   !> No points of later generations are added beyond this number: they lie too close to land on.
   !> Each equation has its share of it before its kinks are too many.
   integer, parameter :: most_ahead = 1000
   !> The error estimate of steps over kinks of one equation, which it hardly sees, times this: 2000
   !> random delays then take 0.13 to 0.33 times the steps at 1e-6, with errors as large. With 200
   !> those of Radau steps were up to 23 times larger.
   real(wp), parameter :: strictness = 2000.0_wp
   !> A few times the steps at this stricter tolerance, times tolerance**(1/4).
   real(wp), parameter :: stricter_steps = 40.0_wp
   !> Passages and generation of the end of a run, which is no kink.
   integer, parameter :: no_kink = huge(1)

   !> Points are one if their distance is below this share of their distance from the first kink.
   real(wp), parameter :: same_point = 16.0_wp*epsilon(1.0_wp)

   !> The kinks of a run.
   type :: breaking_points
      !> Those passed that may return after a delay, ascending
      type(kink_type), allocatable :: met(:)
      !> Whether all those passed are kept, for a continuation
      logical :: remembers = .true.
      !> Those to come, ascending; the last is the end of the run
      type(kink_type), allocatable, private :: ahead(:)
      !> The next of them, and the next that must be landed on
      integer, private :: next = 1, due = 1
      !> Delays, ascending, each once
      real(wp), allocatable, private :: lag(:)
      !> Initial time, from which rounding is measured
      type(instant), private :: origin
      !> Passages after which a kink is too smooth for the order of the method
      integer, private :: most_passages = 0
      !> Generation up to which points must be landed on
      integer, private :: due_generation = 0
      !> Whether kinks of one equation are too many to land on
      logical, private :: crowded = .false.
      !> Short steps that the run may still take, and the most
      integer, private :: credit = 0, most_credit = 0
   contains
      procedure :: begin, add, goal, at, is_end, is_cause, time_to_next, time_to_end, land, pass
      procedure :: judge, forget, kink, is_tracked, is_worth, spend
      procedure, private :: add_ahead, add_returns, find_due
   end type breaking_points

contains

   !> Begin a run.
   pure subroutine begin(self, kinks, origin, now, finish, lag, equations, most_passages, &
                         tolerance)
      class(breaking_points), intent(inout) :: self
      !> Kinks so far and to come, in any order
      type(kink_type), intent(in) :: kinks(:)
      type(instant), intent(in) :: origin, now, finish
      real(wp), intent(in) :: lag(:)
      !> Number of equations
      integer, intent(in) :: equations
      !> Passages after which a kink is too smooth for the order of the method
      integer, intent(in) :: most_passages
      real(wp), intent(in) :: tolerance
      type(kink_type), allocatable :: all_kinks(:), returns(:)
      integer :: i

      self%origin = origin
      self%most_passages = most_passages
      self%most_credit = 2*most_passages
      self%credit = self%most_credit
      allocate (returns(size(lag)))
      returns%at%hi = lag
      call sort(returns, instant(0.0_wp))
      self%lag = returns%at%hi
      self%crowded = size(lag) > equations .and. size(self%lag) &
                     > max(real(most_ahead, wp)/equations, stricter_steps/sqrt(sqrt(tolerance)))
      self%due_generation = merge(1, 0, size(lag) > equations .and. .not. self%crowded)
      self%ahead = [kink_type(finish, no_kink, no_kink)]
      all_kinks = kinks
      call sort(all_kinks, origin)
      self%met = all_kinks(:count(elapsed(all_kinks%at, now) >= 0.0_wp))
      ! backwards: each is then the first
      do i = size(all_kinks), size(self%met) + 1, -1
         call self%add_ahead(all_kinks(i), now)
      end do
      do i = 1, size(self%met)
         call self%add_returns(self%met(i), now)
      end do
      call self%find_due()
   end subroutine begin

   !> Add a kink where the run stands.
   pure subroutine add(self, kink)
      class(breaking_points), intent(inout) :: self
      type(kink_type), intent(in) :: kink

      self%met = each_once([self%met, kink], self%origin)
      call self%add_returns(kink, kink%at)
      call self%find_due()
   end subroutine add

   !> Add the points at which a kink returns, one for each delay, after `now` and before the end.
   pure subroutine add_returns(self, kink, now)
      class(breaking_points), intent(inout) :: self
      type(kink_type), intent(in) :: kink
      type(instant), intent(in) :: now
      integer :: i

      if (.not. self%is_tracked(kink)) return
      if (kink%generation > 0 .and. size(self%ahead) - self%next >= most_ahead) return
      ! the last first: no point is then moved more than once
      do i = size(self%lag), 1, -1
         call self%add_ahead(kink_type(later(kink%at, self%lag(i)), kink%passages + 1, &
                                       kink%generation + 1), now)
      end do
   end subroutine add_returns

   !> Add a point if it lies after `now` and not after the end. This moves the points before it,
   !> which lie at most a delay ahead of those that the run lands on, to the room that passed points
   !> leave.
   pure subroutine add_ahead(self, new, now)
      class(breaking_points), intent(inout) :: self
      type(kink_type), intent(in) :: new
      type(instant), intent(in) :: now
      type(kink_type), allocatable :: wider(:)
      type(kink_type) :: point
      integer :: after, before, middle

      point = new
      after = size(self%ahead)
      associate (finish => self%ahead(after)%at)
         if (abs(elapsed(finish, point%at)) <= same_point*elapsed(self%origin, finish)) then
            point%at = finish
         end if
         if (elapsed(point%at, finish) < 0.0_wp &
             .or. elapsed(now, point%at) <= same_point*elapsed(self%origin, point%at)) return
      end associate
      ! the first that is not before it
      before = self%next - 1
      do while (after - before > 1)
         middle = before + (after - before)/2
         if (elapsed(self%ahead(middle)%at, point%at) > 0.0_wp) then
            before = middle
         else
            after = middle
         end if
      end do
      if (before >= self%next) then
         if (coincide(self%ahead(before), point, self%origin)) then
            call self%ahead(before)%take_in(point)
            return
         end if
      end if
      if (coincide(point, self%ahead(after), self%origin)) then
         call point%take_in(self%ahead(after))
         self%ahead(after) = point
         return
      end if
      if (self%next == 1) then
         associate (points => size(self%ahead))
            allocate (wider(2*points))
            wider(points + 1:) = self%ahead
            call move_alloc(wider, self%ahead)
            self%next = points + 1
            after = after + points
         end associate
      end if
      self%ahead(self%next - 1:after - 2) = self%ahead(self%next:after - 1)
      self%next = self%next - 1
      self%ahead(after - 1) = point
   end subroutine add_ahead

   !> The first point that must be landed on.
   pure subroutine find_due(self)
      class(breaking_points), intent(inout) :: self

      self%due = self%next
      do while (self%ahead(self%due)%generation > self%due_generation &
                .and. self%ahead(self%due)%passages > 0 .and. self%due < size(self%ahead))
         self%due = self%due + 1
      end do
   end subroutine find_due

   !> Number of the point at which a step of proposed length `h` should end.
   pure integer function goal(self, now, h) result(number)
      class(breaking_points), intent(in) :: self
      type(instant), intent(in) :: now
      real(wp), intent(in) :: h
      integer :: i
      real(wp) :: gap

      if (self%credit > 0) then
         number = self%next
         return
      end if
      number = self%due
      do i = self%next, self%due - 1
         gap = elapsed(now, self%ahead(i)%at)
         if (gap > stretch*h) exit
         if (gap >= short*h) number = i
      end do
   end function goal

   !> The time of a point.
   pure type(instant) function at(self, number) result(point)
      class(breaking_points), intent(in) :: self
      integer, intent(in) :: number

      point = self%ahead(number)%at
   end function at

   !> A point.
   pure type(kink_type) function kink(self, number) result(point)
      class(breaking_points), intent(in) :: self
      integer, intent(in) :: number

      point = self%ahead(number)
   end function kink

   !> Whether the passages of a kink through delays are breaking points: it is not too smooth.
   elemental logical function is_tracked(self, kink) result(value)
      class(breaking_points), intent(in) :: self
      type(kink_type), intent(in) :: kink

      value = kink%passages < self%most_passages
   end function is_tracked

   !> Whether steps should end where delays that move meet a kink.
   pure logical function is_worth(self, kink) result(value)
      class(breaking_points), intent(in) :: self
      type(kink_type), intent(in) :: kink

      value = kink%passages <= 0 .or. self%credit > 0
   end function is_worth

   !> A delay that moves met a kink. The step was made twice, and counts as one that lands nowhere.
   pure subroutine spend(self)
      class(breaking_points), intent(inout) :: self

      self%credit = max(0, self%credit - price_of_kink)
   end subroutine spend

   !> Whether a point is the end of the run.
   pure logical function is_end(self, number) result(value)
      class(breaking_points), intent(in) :: self
      integer, intent(in) :: number

      value = number == size(self%ahead)
   end function is_end

   !> Whether the right-hand side may jump at a point.
   pure logical function is_cause(self, number) result(value)
      class(breaking_points), intent(in) :: self
      integer, intent(in) :: number

      value = self%ahead(number)%generation == 0
   end function is_cause

   !> Time to the next point, landed on or not.
   pure real(wp) function time_to_next(self, now) result(time)
      class(breaking_points), intent(in) :: self
      type(instant), intent(in) :: now

      time = elapsed(now, self%ahead(self%next)%at)
   end function time_to_next

   !> Time to the end of the run.
   pure real(wp) function time_to_end(self, now) result(time)
      class(breaking_points), intent(in) :: self
      type(instant), intent(in) :: now

      time = elapsed(now, self%ahead(size(self%ahead))%at)
   end function time_to_end

   !> Land on a point.
   pure subroutine land(self, number, proposed, h)
      class(breaking_points), intent(inout) :: self
      integer, intent(in) :: number
      !> Length proposed for the step
      real(wp), intent(in) :: proposed
      real(wp), intent(in) :: h
      type(kink_type) :: here

      here = self%ahead(number)
      if (number < self%due .and. h < short*proposed) self%credit = max(0, self%credit - 1)
      if (.not. self%is_end(number)) self%next = number + 1
      if (here%passages == no_kink) return
      if (self%remembers) self%met = [self%met, here]
      if (self%is_end(number)) return
      call self%add_returns(here, here%at)
      call self%find_due()
   end subroutine land

   !> Let the estimated error of a step that passes over kinks of one equation be stricter.
   pure subroutine judge(self, step_end, error)
      class(breaking_points), intent(in) :: self
      type(instant), intent(in) :: step_end
      real(wp), intent(inout) :: error

      if (.not. self%crowded .or. self%ahead(self%next)%generation /= 1) return
      if (self%time_to_next(step_end) < 0.0_wp) error = strictness*error
   end subroutine judge

   !> Take a step that lands on no point.
   pure subroutine pass(self, now)
      class(breaking_points), intent(inout) :: self
      type(instant), intent(in) :: now

      self%credit = min(self%credit + 1, self%most_credit)
      do while (self%next < self%due)
         if (elapsed(now, self%ahead(self%next)%at) > 0.0_wp) exit
         self%next = self%next + 1
      end do
   end subroutine pass

   !> Drop the kinks that cannot return.
   pure subroutine forget(self, horizon)
      class(breaking_points), intent(inout) :: self
      !> Nothing before this time will be read
      type(instant), intent(in) :: horizon

      if (size(self%met) == 0) return
      if (elapsed(self%met(1)%at, horizon) > 0.0_wp) then
         self%met = self%met(1 + count(elapsed(self%met%at, horizon) > 0.0_wp):)
      end if
   end subroutine forget

   !> Whether a kink and the next one are the same point.
   pure logical function coincide(kink, next, origin) result(value)
      !> A kink, and one that is not before it
      type(kink_type), intent(in) :: kink, next
      !> Where their rounding is measured from
      type(instant), intent(in) :: origin

      value = elapsed(kink%at, next%at) <= same_point*abs(elapsed(origin, next%at))
   end function coincide

   !> An ascending list in which points that coincide become one, with the fewest passages.
   pure function each_once(ordered, origin) result(points)
      type(kink_type), intent(in) :: ordered(:)
      type(instant), intent(in) :: origin
      type(kink_type), allocatable :: points(:)
      integer :: count, i

      points = ordered
      count = 0
      do i = 1, size(ordered)
         if (count > 0) then
            if (coincide(points(count), ordered(i), origin)) then
               call points(count)%take_in(ordered(i))
               cycle
            end if
         end if
         count = count + 1
         points(count) = ordered(i)
      end do
      points = points(:count)
   end function each_once

   !> From points in any order to an ascending list, each once.
   pure subroutine sort(points, origin)
      type(kink_type), allocatable, intent(inout) :: points(:)
      type(instant), intent(in) :: origin

      if (size(points) > 1) then
         points = each_once(points(ascending(elapsed(origin, points%at))), origin)
      end if
   end subroutine sort
end module dde_breaking_points
