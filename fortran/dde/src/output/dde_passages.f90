! SPDX-License-Identifier: BSD-3-Clause
!> The switching functions over a step, and which of them pass zero: those of the problem, and for
!> each delay that moves t - lag less the kinks at both ends of the piece of the past that it reads.
module dde_passages
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use dde_cursor, only: cursor_type
   use dde_events, only: event_watcher_type, one_of_values
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_time, only: elapsed, instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: below_zero, find_rates, new_passages, odd, passages_type, straight

   !> Rounding error of t - lag near a kink, in units of the spacing of times.
   real(wp), parameter :: rounding = 4.0_wp

   !> Tolerances of the state by whose errors a delay may be below 0.
   real(wp), parameter :: most_tolerances = 100.0_wp
   !> Odd places of a step. A sine of many periods may look straight at even ones, hardly ever at
   !> these, too: fractions of roots of primes.
   real(wp), parameter :: odd(6) = sqrt([2.0_wp, 3.0_wp, 5.0_wp, 7.0_wp, 11.0_wp, 13.0_wp]) &
                                   - [1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 3.0_wp, 3.0_wp]
   !> Largest distance of functions from a line, over their largest value.
   real(wp), parameter :: most_bend = 0.1_wp

   !> The functions over a step, and those that pass zero.
   type, extends(event_watcher_type) :: passages_type
      type(step_context), pointer :: context => null()
      class(step_type), pointer :: step => null()
      logical, allocatable :: above(:), passed(:)
      !> Size up to which each function may be beyond zero by rounding, shape (functions)
      real(wp), allocatable :: slack(:)
      !> What is added to each: how far beyond zero it was where the state changed last
      real(wp), allocatable :: shift(:)
   contains
      procedure :: values, value, take
   end type passages_type

contains

   !> The functions over a step.
   function new_passages(above, beyond, own, context, step) result(passages)
      !> The sides at the start of the step, and how far beyond zero functions are by rounding where
      !> the state changed; the number of functions that are the problem's own
      logical, intent(in) :: above(:)
      real(wp), intent(in) :: beyond(:)
      integer, intent(in) :: own
      type(step_context), intent(in), target :: context
      class(step_type), intent(in), target :: step
      type(passages_type) :: passages
      real(wp) :: g(size(above))

      passages%context => context
      passages%step => step
      passages%above = above
      allocate (passages%passed(size(above)), source=.false.)
      allocate (passages%slack(size(above)), passages%shift(size(above)), source=0.0_wp)
      ! where the last step ended at a zero
      call passages%values(step%t, step%y, step%slope, g)
      passages%shift = merge(sign(beyond, merge(1.0_wp, -1.0_wp, above)), 0.0_wp, &
                             above .neqv. g > 0.0_wp)
      g = g + passages%shift
      passages%slack = merge(2.0_wp*abs(g), 0.0_wp, above .neqv. g > 0.0_wp)
      if (size(g) == own) return
      ! t - lag is rounded
      associate (of_delays => passages%slack(own + 1:))
         of_delays = max(of_delays, rounding*spacing(2.0_wp*max(abs(step%t), abs(step%t + step%h))))
      end associate
   end function new_passages

   !> The functions, of the problem and of delays that move.
   pure subroutine find_functions(context, t, place, y, z, g)
      type(step_context), intent(in) :: context
      !> Time, and time since the start of the step
      real(wp), intent(in) :: t, place
      !> State there, and delayed values
      real(wp), intent(in) :: y(:), z(:)
      real(wp), intent(out) :: g(:)
      real(wp) :: lag(context%problem%moving)
      integer :: i

      associate (own => size(g) - 2*size(lag))
         if (own > 0) call context%problem%switching(t, y, z, g(:own))
         if (size(lag) == 0) return
         call context%problem%moving_lags(t, y, lag)
         do i = 1, 2*size(lag)
            g(own + i) = from_kink(context, i, place - lag((i + 1)/2))
         end do
      end associate
   end subroutine find_functions

   !> A time less that of the kink at the start of the piece of the past that a delay reads (odd
   !> numbers), or at its end (even ones). A piece without an end there is never left.
   pure real(wp) function from_kink(context, number, time) result(g)
      type(step_context), intent(in) :: context
      integer, intent(in) :: number
      !> Time since the start of the step
      real(wp), intent(in) :: time

      associate (pieces => context%past%pieces, at_end => 1 - mod(number, 2))
         associate (i => pieces%begin((number + 1)/2) + at_end)
            if (i > 0 .and. i <= size(pieces%kinks)) then
               g = elapsed(pieces%kinks(i)%at, context%cursor%start) + time
            else
               g = 1.0_wp - 2.0_wp*at_end
            end if
         end associate
      end associate
   end function from_kink

   !> The functions at a place of the step. One that is 0, or no farther beyond than where the step
   !> starts, has not passed yet.
   pure subroutine values(self, t, y, slope, g)
      class(passages_type), intent(in) :: self
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp), intent(out) :: g(:)
      type(cursor_type) :: cursor
      real(wp) :: z(size(self%context%problem%lag), 1)

      associate (context => self%context, at => self%context%cursor, &
                 place => min(self%step%h, t - self%context%cursor%t))
         if (context%problem%switches > 0) then
            cursor = at
            call self%step%delayed_at(context%problem, context%past, cursor, place, z)
         end if
         call find_functions(context, at%inside(t), place, y, z(:, 1), g)
      end associate
      where (ieee_is_nan(g)) g = 0.0_wp
      g = g + self%shift
      where ((self%above .neqv. g > 0.0_wp) .and. .not. abs(g) > self%slack)
         g = merge(tiny(g), -tiny(g), self%above)
      end where
   end subroutine values

   !> One of the functions. Those of delays have their slack added: without a jump there, fewer
   !> evaluations locate a passage.
   pure real(wp) function value(self, which, t, y, slope) result(g)
      class(passages_type), intent(in) :: self
      integer, intent(in) :: which
      real(wp), intent(in) :: t, y(:), slope(:)
      real(wp) :: lag(self%context%problem%moving), side

      associate (context => self%context, at => self%context%cursor, &
                 number => which - size(self%above) + 2*size(lag))
         if (number < 1) then
            g = one_of_values(self, which, t, y, slope)
            return
         end if
         call context%problem%moving_lags(at%inside(t), y, lag)
         g = from_kink(context, number, min(self%step%h, t - at%t) - lag((number + 1)/2))
      end associate
      if (ieee_is_nan(g)) g = 0.0_wp
      side = merge(1.0_wp, -1.0_wp, self%above(which))
      g = side*(g + self%shift(which)) + self%slack(which)
      if (.not. abs(g) > 0.0_wp) g = tiny(g)
      g = side*g
   end function value

   !> A function passes zero.
   subroutine take(self, which, t, y, slope)
      class(passages_type), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)

      self%passed(which) = .true.
   end subroutine take

   !> Whether functions are near lines between even places: at every other place, and at odd ones.
   pure logical function straight(g, between, noise) result(value)
      !> Functions at even places, shape (switches, 0:last), and at the odd ones
      real(wp), intent(in) :: g(:, 0:), between(:, :)
      !> What rounding may make of each, shape (switches)
      real(wp), intent(in) :: noise(:)
      real(wp) :: bend, largest
      integer :: i, k, last

      last = ubound(g, 2)
      value = .true.
      do k = 1, size(g, 1)
         largest = max(noise(k), most_bend*maxval(abs(g(k, :))))
         do i = 1, last - 1, 2
            bend = g(k, i) - 0.5_wp*(g(k, i - 1) + g(k, i + 1))
            value = value .and. .not. abs(bend) > largest
         end do
         do i = 1, size(odd)
            associate (left => int(last*odd(i)), share => last*odd(i) - int(last*odd(i)))
               bend = between(k, i) - (1.0_wp - share)*g(k, left) - share*g(k, left + 1)
            end associate
            value = value .and. .not. abs(bend) > largest
         end do
      end do
   end function straight

   !> The functions where the step of the context starts, and their rates.
   subroutine find_rates(context, y, share, g, rate)
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: y(:)
      !> Share of the step over which rates are found
      real(wp), intent(in) :: share
      real(wp), intent(out) :: g(:), rate(:)
      real(wp) :: h, slope(size(y)), z(size(context%problem%lag), 2)
      logical :: good

      associate (problem => context%problem, cursor => context%cursor)
         h = share*cursor%h
         call context%delayed_values([0.0_wp, h], z)
         call context%evaluate(cursor%inside(cursor%t), y, z(:, 1), slope)
         call find_functions(context, cursor%inside(cursor%t), 0.0_wp, y, z(:, 1), g)
         if (problem%moving > 0) then
            call context%moving_values(cursor%inside(cursor%t + h), y + h*slope, z(:, 2), good)
         end if
         call find_functions(context, cursor%inside(cursor%t + h), h, y + h*slope, z(:, 2), rate)
         where (ieee_is_nan(g) .or. ieee_is_nan(rate))
            g = 0.0_wp
            rate = 0.0_wp
         end where
         rate = (rate - g)/h
      end associate
   end subroutine find_rates

   !> Whether a delay that moves is below 0 at the end of a step, by more than rounding and some
   !> tolerances of the state change it.
   pure logical function below_zero(context, step) result(value)
      type(step_context), intent(in) :: context
      class(step_type), intent(in) :: step
      real(wp), dimension(context%problem%moving) :: allowed, lag, moved
      real(wp) :: t_end, y(size(step%y))
      integer :: i

      value = .false.
      if (size(lag) == 0) return
      t_end = context%cursor%inside(step%t + step%h)
      call context%problem%moving_lags(t_end, step%y_new, lag)
      if (.not. any(lag < 0.0_wp)) return
      allowed = rounding*spacing(t_end)
      y = step%y_new
      do i = 1, size(y)
         y(i) = step%y_new(i) + most_tolerances*step%scale(i)
         call context%problem%moving_lags(t_end, y, moved)
         allowed = allowed + abs(moved - lag)
         y(i) = step%y_new(i)
      end do
      value = any(lag < -allowed)
   end function below_zero
end module dde_passages
