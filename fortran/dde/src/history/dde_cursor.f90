! SPDX-License-Identifier: BSD-3-Clause
!> Where one step stands, and the delayed values over it: for each of them a cursor walks from
!> polynomial to polynomial of the past.
module dde_cursor
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_history, only: history_type
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant, later
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: cursor_type

   !> The solution may jump where a step starts and ends, so that a step reads what lies between:
   !> pieces of the past that overlap it by less than this share of it are not read.
   real(wp), parameter :: overlap = 4.0_wp*epsilon(1.0_wp)
   !> Least overlap with the problem's history, in units of the spacing of times.
   real(wp), parameter :: spacings = 4.0_wp
   !> Share by which rounding may lengthen a delay.
   real(wp), parameter :: rounding = 16.0_wp*epsilon(1.0_wp)
   !> Share of a step that may lie on the other side of the initial time without being read there.
   real(wp), parameter :: beside = 1.0e-9_wp

   !> One step, and what each delayed value reads at its start.
   type :: cursor_type
      !> Start of the step, and as an ordinary number
      type(instant) :: start
      real(wp) :: t = 0.0_wp
      !> Length of the step
      real(wp) :: h = 0.0_wp
      !> The right-hand side may jump where the step starts and ends: it is evaluated between these
      real(wp) :: earliest = -huge(1.0_wp), latest = huge(1.0_wp)
      !> Number of constant delays
      integer, private :: constant = 0
      !> Whether a delay that moves reached into the step
      logical :: reaches_in = .false.
      !> The earliest and the latest time since the start of the step that each delay read that
      !> moves, shape (2, moving)
      real(wp), allocatable, private :: read(:, :)
      !> Number of the past step that each delayed value reads
      integer(int64), allocatable :: step(:)
      !> Start of the current step less the delay, for each delayed value
      type(instant), allocatable :: delayed_start(:)
      !> Start of the current step less the delay, measured from the start of the past step
      real(wp), allocatable :: offset(:)
      !> Whether the delayed value lies before the initial time, at the start of the step at least
      logical, allocatable :: before_origin(:)
      !> Time since the start of the step at which it passes the initial time; huge if it does not,
      !> at most 0 for ever once it has passed
      real(wp), allocatable :: passes_origin(:)
   contains
      procedure, non_overridable :: set, inside, values, values_of, time_before
      procedure, non_overridable :: walk_to, read_from
      procedure, non_overridable :: begin_step, find_lags, moving_values, read_piece, is_near_kink
   end type cursor_type

   interface cursor_type
      module procedure :: new_cursor
   end interface cursor_type

contains

   !> A cursor on no step.
   pure function new_cursor(problem) result(cursor)
      class(dde_problem_type), intent(in) :: problem
      type(cursor_type) :: cursor

      associate (terms => size(problem%lag))
         cursor%constant = terms - problem%moving
         if (problem%moving > 0) allocate (cursor%read(2, problem%moving), source=0.0_wp)
         allocate (cursor%step(terms), source=0_int64)
         allocate (cursor%delayed_start(terms), cursor%offset(terms), cursor%before_origin(terms))
         allocate (cursor%passes_origin(terms), source=huge(1.0_wp))
      end associate
   end function new_cursor

   !> Go to the step from `start`, `length` long.
   pure subroutine set(self, problem, past, start, length)
      class(cursor_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(history_type), intent(in) :: past
      type(instant), intent(in) :: start
      real(wp), intent(in) :: length
      real(wp) :: ahead
      integer :: k, last

      self%start = start
      self%t = start%hi
      self%h = length
      last = 0
      do while (last < self%constant)
         k = last + 1
         last = past%last_alike(k)
         self%delayed_start(k) = later(start, -problem%lag(k))
         if (self%passes_origin(k) > 0.0_wp) then
            ahead = elapsed(self%delayed_start(k), past%origin)
            self%before_origin(k) = ahead > beside*length
            self%passes_origin(k) = merge(ahead, huge(1.0_wp), ahead < (1.0_wp - beside)*length)
         end if
         if (.not. self%before_origin(k)) then
            call self%read_from(past, k, max(self%step(k), past%oldest))
         end if
         if (last == k) cycle
         self%delayed_start(k + 1:last) = self%delayed_start(k)
         self%before_origin(k + 1:last) = self%before_origin(k)
         self%passes_origin(k + 1:last) = self%passes_origin(k)
         self%step(k + 1:last) = self%step(k)
         self%offset(k + 1:last) = self%offset(k)
      end do
   end subroutine set

   !> The time nearest to `t` at which the right-hand side may be evaluated.
   pure real(wp) function inside(self, t) result(time)
      class(cursor_type), intent(in) :: self
      !> A time from the start of the step to its end
      real(wp), intent(in) :: t

      time = max(self%earliest, min(self%latest, t))
   end function inside

   !> The values of all constant delays at places of the step, each place after the one before.
   pure subroutine values(self, problem, past, ahead, z)
      class(cursor_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(history_type), intent(in) :: past
      !> Times since the start of the step, ascending, 0..length
      real(wp), contiguous, intent(in) :: ahead(:)
      !> Delayed values; those of delays that move are as before
      real(wp), intent(inout) :: z(size(problem%lag), size(ahead))
      integer :: k, last

      last = 0
      do while (last < self%constant)
         k = last + 1
         last = past%last_alike(k)
         call self%values_of(problem, past, k, last, size(ahead), ahead, k, size(z, 1), z)
      end do
   end subroutine values

   !> Delayed values that are alike, at places of the step, each place after the one before: step by
   !> step of the past, each up to its end and a margin.
   pure subroutine values_of(self, problem, past, k, last, places, ahead, row, rows, z)
      class(cursor_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(history_type), intent(in) :: past
      !> The first and the last of them
      integer, intent(in) :: k, last
      integer, intent(in) :: places
      real(wp), intent(in) :: ahead(places)
      !> The row of z that the first fills, and all rows
      integer, intent(in) :: row, rows
      real(wp), intent(inout) :: z(rows, places)
      real(wp) :: limit, margin
      integer :: first, i

      first = 1
      if (self%before_origin(k)) then
         do i = k, last
            do first = 1, places
               if (ahead(first) > self%passes_origin(k) .and. past%newest >= past%oldest) exit
               z(row + i - k, first) = problem%history(self%time_before(past, problem%lag(k), &
                                                                        ahead(first)), &
                                                       problem%component(i))
            end do
         end do
         if (first > places) return
         call self%read_from(past, k, past%oldest)
      end if
      margin = overlap*self%h
      call self%walk_to(past, k, max(ahead(first), margin))
      do
         limit = huge(1.0_wp)
         if (self%step(k) < past%newest) limit = past%length_of(self%step(k)) + margin
         call past%values(self%step(k), k, last, self%offset(k), limit, places, ahead, first, row, &
                          rows, z)
         if (first > places) exit
         call self%read_from(past, k, self%step(k) + 1)
      end do
   end subroutine values_of

   !> Begin a step: no delay that moves has read anything.
   pure subroutine begin_step(self)
      class(cursor_type), intent(inout) :: self

      self%reaches_in = .false.
      self%read(1, :) = huge(1.0_wp)
      self%read(2, :) = -huge(1.0_wp)
   end subroutine begin_step

   !> The delays that move, at a place of the step.
   pure subroutine find_lags(self, problem, t, y, lag, good)
      class(cursor_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      !> The time, and the state there
      real(wp), intent(in) :: t, y(problem%n)
      real(wp), intent(out) :: lag(problem%moving)
      !> Whether they are finite and not longer than their bounds. One below 0 may be so by errors
      !> of a stage.
      logical, intent(out) :: good
      real(wp) :: time
      integer :: j

      call problem%moving_lags(t, y, lag)
      good = .false.
      do j = 1, size(lag)
         if (.not. ieee_is_finite(lag(j))) return
         if ((1.0_wp - rounding)*lag(j) > problem%lag(self%constant + j)) return
         time = elapsed(self%start, instant(t)) - lag(j)
         self%read(1, j) = min(self%read(1, j), time)
         self%read(2, j) = max(self%read(2, j), time)
      end do
      good = .true.
   end subroutine find_lags

   !> The values of the delays that move, at a place of the step.
   pure subroutine moving_values(self, problem, past, t, y, z, good)
      class(cursor_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(history_type), intent(in) :: past
      !> The time, and the state there
      real(wp), intent(in) :: t, y(problem%n)
      !> Delayed values
      real(wp), intent(inout) :: z(size(problem%lag))
      !> Whether the delays are finite and not longer than their bounds
      logical, intent(out) :: good
      real(wp) :: lag(problem%moving)
      integer :: j, k

      call self%find_lags(problem, t, y, lag, good)
      if (.not. good) return
      do j = 1, size(lag)
         k = self%constant + j
         call self%read_piece(problem, past, j, elapsed(self%start, instant(t)), lag(j), &
                              y(problem%component(k)), z(k))
      end do
   end subroutine moving_values

   !> A delayed value, by the piece of the past that its delay reads, which moves.
   pure subroutine read_piece(self, problem, past, j, place, lag, here, z)
      class(cursor_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(history_type), intent(in) :: past
      !> Number of the delay, of those that move
      integer, intent(in) :: j
      !> Time since the start of the step, and the delay
      real(wp), intent(in) :: place, lag
      !> The component without its delay: a first guess where nothing is known yet of the piece
      real(wp), intent(in) :: here
      real(wp), intent(inout) :: z
      real(wp) :: least, most, offset, time
      integer(int64) :: first, last

      time = place - lag
      associate (pieces => past%pieces, k => self%constant + j)
         associate (begin => pieces%begin(j))
            first = past%oldest
            if (begin > 0) first = max(first, pieces%first_step(begin))
            if (begin < size(pieces%kinks)) then
               if (elapsed(pieces%kinks(begin + 1)%at, past%origin) >= 0.0_wp) then
                  ! the history may jump at both ends
                  most = pieces%kinks(begin + 1)%at%hi
                  if (most < past%origin%hi) most = most - spacings*spacing(most)
                  least = -huge(1.0_wp)
                  if (begin > 0) least = pieces%kinks(begin)%at%hi
                  if (begin > 0) least = least + spacings*spacing(least)
                  z = problem%history(max(least, min(most, self%t + time)), problem%component(k))
                  return
               end if
               last = pieces%first_step(begin + 1) - 1
            else
               if (.not. lag > 0.0_wp) then
                  z = here
                  return
               end if
               last = past%newest
               if (past%running) last = last + 1
               self%reaches_in = self%reaches_in .or. time > overlap*self%h .or. last < first
            end if
         end associate
         if (last < first) then
            z = here
            return
         end if
         self%step(k) = max(first, min(last, self%step(k)))
         offset = elapsed(past%start_of(self%step(k)), self%start) + time
         do while (offset < 0.0_wp .and. self%step(k) > first)
            self%step(k) = self%step(k) - 1
            offset = elapsed(past%start_of(self%step(k)), self%start) + time
         end do
         do while (offset > past%length_of(self%step(k)) .and. self%step(k) < last)
            self%step(k) = self%step(k) + 1
            offset = elapsed(past%start_of(self%step(k)), self%start) + time
         end do
         ! beyond the piece no farther than its last step is long
         associate (length => past%length_of(self%step(k)))
            offset = max(-length, min(2.0_wp*length, offset))
         end associate
         z = past%value(self%step(k), k, offset)
      end associate
   end subroutine read_piece

   !> Whether a delay that moves came near an end of the piece that it reads: nearer than the range
   !> of times that it read in the step. One that stays where the piece begins must be before it by
   !> more than rounding.
   pure logical function is_near_kink(self, past) result(value)
      class(cursor_type), intent(in) :: self
      type(history_type), intent(in) :: past
      real(wp) :: range, rounding
      integer :: j

      value = .false.
      rounding = spacings*spacing(abs(self%t) + self%h)
      associate (pieces => past%pieces)
         do j = 1, size(pieces%begin)
            range = self%read(2, j) - self%read(1, j)
            associate (begin => pieces%begin(j))
               if (begin > 0) then
                  value = value .or. self%read(1, j) - merge(range, -rounding, range > rounding) &
                                     <= elapsed(self%start, pieces%kinks(begin)%at)
               end if
               if (begin < size(pieces%kinks)) then
                  value = value .or. self%read(2, j) + range &
                                     >= elapsed(self%start, pieces%kinks(begin + 1)%at)
               end if
            end associate
         end do
      end associate
   end function is_near_kink

   !> A time in the problem's history. Where that may jump it lies between those of the step's ends.
   pure real(wp) function time_before(self, past, lag, ahead) result(time)
      class(cursor_type), intent(in) :: self
      type(history_type), intent(in) :: past
      real(wp), intent(in) :: lag, ahead
      real(wp) :: margin

      time = self%t + (ahead - lag)
      if (.not. past%history_jumps) return
      margin = spacings*spacing(max(abs(self%t), lag))
      time = max(min(time, self%t + (self%h - lag) - margin), self%t - lag + margin)
   end function time_before

   !> Let delayed value k read the past step that holds a place of the current step.
   pure subroutine walk_to(self, past, k, ahead)
      class(cursor_type), intent(inout) :: self
      type(history_type), intent(in) :: past
      integer, intent(in) :: k
      real(wp), intent(in) :: ahead

      do while (self%offset(k) + ahead < 0.0_wp .and. self%step(k) > past%oldest)
         call self%read_from(past, k, self%step(k) - 1)
      end do
      do while (self%offset(k) + ahead > past%length_of(self%step(k)) &
                .and. self%step(k) < past%newest)
         call self%read_from(past, k, self%step(k) + 1)
      end do
   end subroutine walk_to

   !> Let delayed value k read past step number `step`.
   pure subroutine read_from(self, past, k, step)
      class(cursor_type), intent(inout) :: self
      type(history_type), intent(in) :: past
      integer, intent(in) :: k
      integer(int64), intent(in) :: step

      self%step(k) = step
      self%offset(k) = elapsed(past%start_of(step), self%delayed_start(k))
   end subroutine read_from
end module dde_cursor
