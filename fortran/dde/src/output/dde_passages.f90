! SPDX-License-Identifier: BSD-3-Clause
!> The switching functions over a step, and which of them pass zero: those of the problem, and for
!> each delay that moves t - lag less the kinks at both ends of the piece of the past that it reads.
module dde_passages
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use dde_cursor, only: cursor_type
   use dde_events, only: event_watcher_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_time, only: elapsed, instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_functions, new_passages, passages_type, rounding

   !> Rounding error of t - lag near a kink, in units of the spacing of times.
   real(wp), parameter :: rounding = 4.0_wp

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
      procedure :: values, take
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
      integer :: i, j

      associate (own => size(g) - 2*size(lag), pieces => context%past%pieces)
         if (own > 0) call context%problem%switching(t, y, z, g(:own))
         if (size(lag) == 0) return
         call context%problem%moving_lags(t, y, lag)
         ! a piece without an end there is never left
         g(own + 1::2) = 1.0_wp
         g(own + 2::2) = -1.0_wp
         do j = 1, size(lag)
            i = own + 2*j - 1
            associate (begin => pieces%begin(j), time => place - lag(j))
               if (begin > 0) then
                  g(i) = elapsed(pieces%kinks(begin)%at, context%cursor%start) + time
               end if
               if (begin < size(pieces%kinks)) then
                  g(i + 1) = elapsed(pieces%kinks(begin + 1)%at, context%cursor%start) + time
               end if
            end associate
         end do
      end associate
   end subroutine find_functions

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

   !> A function passes zero.
   subroutine take(self, which, t, y, slope)
      class(passages_type), intent(inout) :: self
      integer, intent(in) :: which
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)

      self%passed(which) = .true.
   end subroutine take
end module dde_passages
