! SPDX-License-Identifier: BSD-3-Clause
!> All that a later run needs to continue where one ended, in plain arrays that a caller can write
!> to a file and read back.
module dde_continuation
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_kink, only: kink_type
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant, later
   use dde_errors, only: check_finite, error_type, raise, text
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: continuation_type

   !> A step may end so far before the next one begins, in units of the spacing of times.
   real(wp), parameter :: rounding = 4.0_wp

   !> The end of a run. It is empty (`y` not allocated) before the first run. Each time is the
   !> sum of a pair of numbers, the second being the rounding error of the first.
   type :: continuation_type
      !> When
      real(wp) :: time(2) = 0.0_wp
      !> Initial time of the first run: before it the history of the next run's problem holds
      real(wp) :: origin(2) = 0.0_wp
      !> State, shape (n)
      real(wp), allocatable :: y(:)
      !> Time derivative by dense output, the last that event functions were given, shape (n);
      !> of size 0 after a change of the state
      real(wp), allocatable :: slope(:)
      !> Right-hand side, shape (n). If the problem gives another one at the start of the next run,
      !> there is a kink. Of size 0 where a caller changed the solution and all of its past
      !> smoothly: then there is no kink.
      real(wp), allocatable :: rate(:)
      !> Length of the next step; chosen by the solver when 0
      real(wp) :: next_step = 0.0_wp
      !> Name of the method in use
      character(len=8) :: method = ""
      !> Kinks in the steps kept, shape (2, kinks), ascending
      real(wp), allocatable :: kink(:, :)
      !> Passages through a delay that each has made; -1 for a jump of the solution
      integer, allocatable :: passages(:)
      !> Passages through a delay since its cause that each has made; 0 for the cause
      integer, allocatable :: generation(:)
      !> Components of y that are kept
      integer, allocatable :: kept(:)
      !> Start of each step kept, shape (2, steps), ascending
      real(wp), allocatable :: step_start(:, :)
      !> Length of each step kept, shape (steps)
      real(wp), allocatable :: step_length(:)
      !> Time from its start for which its polynomial is valid, shape (steps)
      real(wp), allocatable :: valid_for(:)
      !> Newton nodes of its polynomial, shape (degree, steps)
      real(wp), allocatable :: nodes(:, :)
      !> Newton coefficients, shape (1 + degree, kept, steps), 0 above the degree of the step
      real(wp), allocatable :: coefficients(:, :, :)
   contains
      procedure :: change_state, check, has_rate, store, restore
   end type continuation_type

contains

   !> Change the state: a dose, a bounce. The solution jumps here, and again after each delay.
   pure subroutine change_state(self, y, error)
      class(continuation_type), intent(inout) :: self
      !> New state, shape (n)
      real(wp), intent(in) :: y(:)
      !> No run has ended here, or y is no state
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(self%y)) then
         call raise(error, "change_state: the continuation is empty; one filled by a run expected")
         return
      end if
      if (size(y) /= size(self%y)) then
         call raise(error, "change_state: "//text(size(y))//" components for " &
                    //text(size(self%y))//" equations; "//text(size(self%y))//" expected")
         return
      end if
      call check_finite("change_state: y", y, error)
      if (allocated(error)) return
      self%kink = reshape([self%kink, self%time], [2, size(self%kink, 2) + 1])
      self%passages = [self%passages, -1]
      self%generation = [self%generation, 0]
      self%y = y
      deallocate (self%slope)
      allocate (self%slope(0))
      self%next_step = 0.0_wp
   end subroutine change_state

   !> Refuse a problem that cannot continue from here, and arrays that no run leaves.
   pure subroutine check(self, problem, t_start, error)
      class(continuation_type), intent(in) :: self
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_start
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: delayed, kept
      type(instant) :: oldest
      integer :: k

      if (.not. allocated(self%y)) return
      if (size(self%y) /= problem%n) then
         call raise(error, "integrate: a continuation of "//text(size(self%y))//" equations for " &
                    //text(problem%n)//"; "//text(problem%n)//" expected")
      else if (.not. consistent(self)) then
         call raise(error, "integrate: the arrays of the continuation do not fit each other; " &
                    //"expected as an earlier run left them")
      else if (.not. holds(self%kept, problem%component)) then
         call list(self%kept, kept)
         call list(problem%component, delayed)
         call raise(error, "integrate: the continuation keeps components"//kept &
                    //", delayed are"//delayed//"; these at least expected")
      else if (abs(t_start - self%time(1)) > 0.0_wp) then
         call raise(error, "integrate: t_start = "//text(t_start)//" is " &
                    //text(t_start - self%time(1))//" off the time "//text(self%time(1)) &
                    //" of the continuation; the same expected")
      end if
      if (.not. allocated(error)) then
         call check_finite("integrate: the continuation has y", self%y, error)
      end if
      if (.not. allocated(error)) call check_steps(self, error)
      if (allocated(error)) return
      oldest = instant(self%time(1), self%time(2))
      if (size(self%step_length) > 0) oldest = instant(self%step_start(1, 1), self%step_start(2, 1))
      associate (origin => instant(self%origin(1), self%origin(2)), &
                 now => instant(self%time(1), self%time(2)))
         if (elapsed(origin, oldest) <= 0.0_wp) return
         do k = 1, size(problem%lag)
            if (elapsed(oldest, later(now, -problem%lag(k))) >= -rounding*spacing(now%hi)) cycle
            call raise(error, "integrate: lag("//text(k)//") = "//text(problem%lag(k)) &
                       //" reaches beyond the past that the continuation keeps; at most " &
                       //text(elapsed(oldest, now))//" expected")
            return
         end do
      end associate
   end subroutine check

   !> Refuse steps of no length, and steps that begin after the next one or after the end.
   pure subroutine check_steps(self, error)
      type(continuation_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: next(2)
      integer :: i
      logical :: good

      next = self%time
      do i = size(self%step_length), 1, -1
         associate (start => self%step_start(:, i), length => self%step_length(i))
            good = all(ieee_is_finite([next, start, length]))
            if (good) good = length > 0.0_wp .and. elapsed(instant(start(1), start(2)), &
                                                           instant(next(1), next(2))) >= 0.0_wp
            if (.not. good) then
               call raise(error, "integrate: step "//text(i)//" of the continuation begins " &
                          //text(next(1) - start(1))//" before the next, and its length is " &
                          //text(length)//"; >= 0 and > 0 expected")
               return
            end if
            next = start
         end associate
      end do
   end subroutine check_steps

   !> Whether the shapes of the arrays are consistent.
   pure logical function consistent(self) result(value)
      type(continuation_type), intent(in) :: self
      integer :: steps

      value = allocated(self%slope) .and. allocated(self%rate) .and. allocated(self%kink) &
              .and. allocated(self%passages) .and. allocated(self%generation) &
              .and. allocated(self%kept) &
              .and. allocated(self%step_start) .and. allocated(self%step_length) &
              .and. allocated(self%valid_for) .and. allocated(self%nodes) &
              .and. allocated(self%coefficients)
      if (.not. value) return
      steps = size(self%step_length)
      value = all(self%kept >= 1 .and. self%kept <= size(self%y)) &
              .and. any(size(self%slope) == [0, size(self%y)]) &
              .and. any(size(self%rate) == [0, size(self%y)]) &
              .and. all(shape(self%kink) == [2, size(self%passages)]) &
              .and. size(self%generation) == size(self%passages) &
              .and. all(shape(self%step_start) == [2, steps]) &
              .and. size(self%valid_for) == steps &
              .and. size(self%nodes, 1) <= highest_degree .and. size(self%nodes, 2) == steps &
              .and. all(shape(self%coefficients) &
                        == [1 + size(self%nodes, 1), size(self%kept), steps])
   end function consistent

   !> Whether some components hold all of the others.
   pure logical function holds(some, others) result(value)
      integer, intent(in) :: some(:), others(:)
      integer :: i

      value = all([(any(some == others(i)), i=1, size(others))])
   end function holds

   !> Numbers as words, each with a blank before it.
   pure subroutine list(numbers, words)
      integer, intent(in) :: numbers(:)
      character(len=:), allocatable, intent(out) :: words
      integer :: i

      words = ""
      do i = 1, size(numbers)
         words = words//" "//text(numbers(i))
      end do
      if (size(numbers) == 0) words = " none"
   end subroutine list

   !> Keep the steps of the past, and the kinks that may return after a delay.
   pure subroutine store(self, past, kinks)
      class(continuation_type), intent(inout) :: self
      type(history_type), intent(in) :: past
      type(kink_type), intent(in) :: kinks(:)
      type(instant) :: start
      integer(int64) :: step
      integer :: degree, i, steps

      self%kept = past%kept
      degree = past%degree_in_use()
      steps = int(past%newest - past%oldest + 1)
      allocate (self%step_start(2, steps), self%step_length(steps), self%valid_for(steps))
      allocate (self%nodes(degree, steps), self%coefficients(1 + degree, size(past%kept), steps))
      i = 0
      do step = past%oldest, past%newest
         i = i + 1
         call past%recall(step, start, self%step_length(i), self%valid_for(i), self%nodes(:, i), &
                          self%coefficients(:, :, i))
         self%step_start(:, i) = [start%hi, start%lo]
      end do
      allocate (self%kink(2, size(kinks)))
      self%kink(1, :) = kinks%at%hi
      self%kink(2, :) = kinks%at%lo
      self%passages = kinks%passages
      self%generation = kinks%generation
   end subroutine store

   !> Give the past back.
   subroutine restore(self, past, kinks)
      class(continuation_type), intent(in) :: self
      type(history_type), intent(inout) :: past
      type(kink_type), allocatable, intent(out) :: kinks(:)
      integer :: i

      do i = 1, size(self%step_length)
         call past%append(instant(self%step_start(1, i), self%step_start(2, i)), &
                          self%step_length(i), self%nodes(:, i), self%coefficients(:, :, i), &
                          self%valid_for(i))
      end do
      allocate (kinks(size(self%passages)))
      kinks%at%hi = self%kink(1, :)
      kinks%at%lo = self%kink(2, :)
      kinks%passages = self%passages
      kinks%generation = self%generation
   end subroutine restore

   !> Whether a right-hand side is that of the end of the run. It is not compared if `rate` is
   !> empty.
   pure logical function has_rate(self, slope) result(value)
      class(continuation_type), intent(in) :: self
      real(wp), intent(in) :: slope(:)

      value = size(self%rate) == 0
      if (value) return
      value = all(ieee_is_finite(slope)) .and. all(ieee_is_finite(self%rate))
      if (value) value = .not. any(abs(slope - self%rate) > 0.0_wp)
   end function has_rate
end module dde_continuation
