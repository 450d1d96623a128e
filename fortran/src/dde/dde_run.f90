!> The state of a run between two steps: how it begins, what the next step may be, and what is kept
!> when it ends.
module dde_run
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_breaking_points, only: breaking_points, kink_type
   use dde_continuation, only: continuation_type
   use dde_event_search, only: event_search
   use dde_first_step, only: choose_first_step
   use dde_history, only: history_type
   use dde_methods, only: choose_method, longest_step, matching_method
   use dde_problem, only: dde_problem_type
   use dde_request, only: integration_options
   use dde_step, only: step_type
   use dde_time, only: elapsed, instant, instant_at
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_type

   !> Where a run stands.
   type :: run_type
      !> The step, of the method in use
      class(step_type), allocatable :: step
      !> The past
      type(history_type) :: past
      !> The search for events, begun if there is a watcher
      type(event_search) :: search
      !> Now
      type(instant) :: now
      !> Length proposed for the next step
      real(wp) :: h = 0.0_wp
      !> Whether the slope at the start of the step is yet to be evaluated
      logical :: fresh = .false.
      !> Kinks that the run began with, ascending
      type(kink_type), allocatable :: kinks(:)
      !> Breaking points of the run, and its end
      type(kink_type), allocatable :: points(:)
      !> The next of them
      integer :: next_point = 1
      !> First instant of the first run
      type(instant) :: origin
      !> Time derivative of the state at the start of the run, as event functions see it, shape (n)
      real(wp), allocatable :: first_slope(:)
   contains
      !> Begin, or go on from an earlier run
      procedure :: begin
      !> The step to try
      procedure :: plan
      !> Keep what a later run needs to go on
      procedure :: keep
      procedure, private :: start_anew, go_on, find_points
   end type run_type

contains

   !> Begin, or go on from an earlier run.
   subroutine begin(self, problem, t_start, t_end, options, continuation)
      !> The run
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant
      real(wp), intent(in) :: t_start
      !> Last instant
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Where an earlier run ended, if one did
      type(continuation_type), intent(in), optional :: continuation
      logical :: goes_on

      goes_on = .false.
      if (present(continuation)) goes_on = allocated(continuation%y)
      if (goes_on) then
         call self%go_on(problem, instant_at(t_end), options, continuation)
      else
         call self%start_anew(problem, instant_at(t_start), instant_at(t_end), options)
      end if
      if (options%first_step > 0.0_wp) then
         self%h = options%first_step
      else if (.not. goes_on) then
         call choose_first_step(problem, self%past, self%step, t_start, t_end - t_start, options, &
                                self%h)
      end if
   end subroutine begin

   !> The first run: its first instant is a kink, or a jump where a delayed component differs from
   !> its history there.
   subroutine start_anew(self, problem, start, finish, options)
      !> The run
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant
      type(instant), intent(in) :: start
      !> Last instant
      type(instant), intent(in) :: finish
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      integer :: k

      self%now = start
      self%origin = start
      call choose_method(problem, options%method, options, self%step)
      self%past = history_type(problem, start)
      self%kinks = [kink_type(start)]
      do k = 1, size(problem%lag)
         associate (component => problem%component(k))
            if (abs(problem%history(start%hi, component) - self%step%y(component)) > 0.0_wp) then
               self%kinks%passages = -1
            end if
         end associate
      end do
      call self%find_points(problem, finish)
      call look(self, problem, options)
      self%first_slope = self%step%slope
   end subroutine start_anew

   !> Another run, on the past of the one before. Where the problem gives another right-hand side
   !> than it did at the end of that one, there is a kink here.
   subroutine go_on(self, problem, finish, options, continuation)
      !> The run
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Last instant
      type(instant), intent(in) :: finish
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Where the earlier run ended
      type(continuation_type), intent(in) :: continuation
      character(len=8) :: method

      self%now = instant(continuation%time(1), continuation%time(2))
      self%origin = instant(continuation%origin(1), continuation%origin(2))
      self%h = continuation%next_step
      method = options%method
      if (method == "auto") then
         method = matching_method(problem, options, &
                                  implicit=index(continuation%method, "radau") == 1)
      end if
      call choose_method(problem, method, options, self%step)
      self%step%y = continuation%y
      self%first_slope = continuation%slope
      self%past = history_type(problem, self%origin)
      call continuation%restore(self%past, self%kinks)
      call self%find_points(problem, finish)
      call look(self, problem, options)
      if (.not. same(self%step%slope, continuation%rate)) then
         self%kinks = [self%kinks, kink_type(self%now)]
         call self%find_points(problem, finish)
      end if
   end subroutine go_on

   !> The breaking points ahead, and the end.
   pure subroutine find_points(self, problem, finish)
      !> The run
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Last instant
      type(instant), intent(in) :: finish

      self%points = [breaking_points(self%kinks, self%now, finish, problem%lag, self%step%order), &
                     kink_type(finish)]
   end subroutine find_points

   !> Face the first step and evaluate the slope at its start.
   subroutine look(self, problem, options)
      !> The run
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Limits
      type(integration_options), intent(in) :: options

      if (size(problem%lag) > 0) then
         call self%past%face(problem, self%now, &
                             minval([longest_step(problem, self%step, options), problem%lag, &
                                     elapsed(self%now, self%points(self%next_point)%at)]))
      end if
      call self%step%restart(problem, self%past, self%now%hi)
   end subroutine look

   !> Length of the step to try; where the next breaking point (or the end) is near, it is landed
   !> on, or two steps share the way. The past faces it on return.
   pure subroutine plan(self, problem, options, longest, h, landing)
      !> The run
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerances
      type(integration_options), intent(in) :: options
      !> Longest step allowed
      real(wp), intent(in) :: longest
      !> Length of the step
      real(wp), intent(out) :: h
      !> Whether it ends at the next point
      logical, intent(out) :: landing
      real(wp) :: gap

      gap = elapsed(self%now, self%points(self%next_point)%at)
      if (self%step%foresees) then
         if (size(problem%lag) > 0) call self%past%face(problem, self%now, min(longest, gap))
         call self%step%look_ahead(problem, self%past, self%now%hi, options%relative, &
                                   options%absolute, min(longest, gap), self%h)
      end if
      self%h = min(self%h, longest)
      landing = 1.01_wp*self%h >= gap .and. gap <= longest
      h = merge(gap, merge(0.5_wp*gap, self%h, 2.0_wp*self%h > gap), landing)
      if (.not. self%step%foresees .and. size(problem%lag) > 0) then
         call self%past%face(problem, self%now, h)
      end if
   end subroutine plan

   !> Keep what a later run needs to go on from here.
   subroutine keep(self, problem, options, continuation)
      !> The run, ended
      class(run_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Limits
      type(integration_options), intent(in) :: options
      !> What is kept
      type(continuation_type), intent(out) :: continuation
      type(kink_type), allocatable :: met(:)

      continuation%time = [self%now%hi, self%now%lo]
      continuation%origin = [self%origin%hi, self%origin%lo]
      continuation%y = self%step%y
      continuation%slope = self%step%slope_here()
      if (allocated(self%search%here%slope)) continuation%slope = self%search%here%slope
      call look(self, problem, options)
      continuation%rate = self%step%slope
      continuation%next_step = self%h
      continuation%method = self%step%name
      associate (points => self%points(:size(self%points) - 1))
         met = [self%kinks, pack(points, elapsed(points%at, self%now) >= 0.0_wp)]
      end associate
      call continuation%store(self%past, met)
   end subroutine keep

   !> Whether two lists hold the same finite numbers, or the other none at all.
   pure logical function same(one, other) result(value)
      !> One
      real(wp), intent(in) :: one(:)
      !> The other, as long or empty
      real(wp), intent(in) :: other(:)

      value = size(other) == 0
      if (value) return
      value = all(ieee_is_finite(one)) .and. all(ieee_is_finite(other))
      if (value) value = .not. any(abs(one - other) > 0.0_wp)
   end function same
end module dde_run
