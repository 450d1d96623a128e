! SPDX-License-Identifier: BSD-3-Clause
!> The state of a run between two steps: how it begins, how the next step is planned, and what is
!> kept when it ends.
module dde_run
   use dde_breaking_points, only: breaking_points, kink_type, stretch
   use dde_continuation, only: continuation_type
   use dde_controller, only: controller_type
   use dde_cursor, only: cursor_type
   use dde_errors, only: check_finite, error_type
   use dde_event_search, only: event_search
   use dde_first_step, only: choose_first_step
   use dde_history, only: history_type
   use dde_memory, only: find_lacking
   use dde_methods, only: choose_method, longest_step, matching_method
   use dde_problem, only: dde_problem_type
   use dde_request, only: causes, implicit_methods, integration_options
   use dde_sides, only: sides_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_time, only: elapsed, instant
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: run_type

   !> Distance from a jump at which the right-hand side is evaluated, in units of the spacing of
   !> times.
   real(wp), parameter :: beside = 4.0_wp

   !> An implicit step of a proposed length below this many times the shortest delay is no longer
   !> than the delay: otherwise its delayed values couple its stages. In one of three stiff chains
   !> (`dde_chain_costs`) 1, 1.5 and 4 take 1.11, 1.03 and 0.92 times the instructions, and in the
   !> others as many.
   real(wp), parameter :: uncoupled = 2.0_wp

   !> The solution hardly moves on in a few steps that are shorter by this factor than those before.
   !> It is below 6**6, by which implicit steps may grow in a trial (`dde_switch`): otherwise steps
   !> could stay short for ever.
   real(wp), parameter :: hardly = 3.0e4_wp

   !> The state of a run.
   type :: run_type
      !> The step, of the method in use
      class(step_type), allocatable :: step
      !> The step of the other method of `auto`, kept once it has been used
      class(step_type), allocatable, private :: other
      !> The context of its steps: problem, past, tolerance and work
      type(step_context) :: context
      !> The sides of switching functions on which f is, and the problem that takes them, if it has
      !> some
      type(sides_type) :: sides
      class(dde_problem_type), allocatable, private :: sided
      !> Step control
      type(controller_type) :: control
      !> The search for events, begun if there is a watcher
      type(event_search) :: search
      !> Now
      type(instant) :: now
      !> Length proposed for the next step, and by the other method when it was left
      real(wp) :: h = 0.0_wp
      real(wp), private :: h_of_other = 0.0_wp
      !> Whether the slope at the start of the next step must be evaluated
      logical :: fresh = .false.
      !> Breaking points and the end
      type(breaking_points) :: points
      !> Time that the past reaches back
      real(wp) :: reach = 0.0_wp
      !> Bytes that could not be allocated, or 0
      real(wp) :: lacking = 0.0_wp
      !> Whether the right-hand side may jump somewhere, and now
      logical, private :: may_jump = .false., at_cause = .false.
      !> Time derivative of the state at the start of the run, as event functions see it, shape (n)
      real(wp), allocatable :: first_slope(:)
   contains
      procedure :: begin, plan, change_to_other, change_sides, keep, arrive
      procedure, private :: start_anew, continue_run
   end type run_type

contains

   !> Begin, or continue an earlier run, unless memory is lacking.
   subroutine begin(self, problem, t_start, t_end, options, error, continuation)
      class(run_type), intent(inout), target :: self
      !> The problem, which lives as long as the run
      class(dde_problem_type), intent(in), target :: problem
      real(wp), intent(in) :: t_start, t_end
      type(integration_options), intent(in) :: options
      !> What is wrong with values of the problem at the start
      type(error_type), allocatable, intent(out) :: error
      !> Where an earlier run ended, if one did
      type(continuation_type), intent(in), optional :: continuation
      logical :: continued
      real(wp) :: reals

      continued = .false.
      if (present(continuation)) continued = allocated(continuation%y)
      ! the state with its tolerances, and at most so many for each number and step that is restored
      reals = 16.0_wp*problem%n
      if (continued) reals = reals + 2.0_wp*size(continuation%coefficients) &
                             + 120.0_wp*size(continuation%step_length)
      self%lacking = find_lacking(reals)
      if (self%lacking > 0.0_wp) return
      self%context%problem => problem
      if (problem%switches > 0) then
         allocate (self%sided, source=problem)
         self%context%problem => self%sided
      end if
      self%points%remembers = present(continuation)
      self%context%tolerance = tolerance_type(problem%n, options%relative, options%absolute, &
                                              options%each_relative, options%each_absolute)
      self%context%tolerance%share_of_largest = options%share_of_largest
      self%context%cursor = cursor_type(problem)
      self%context%work = work_type(problem%n)
      self%reach = max(options%past_kept, maxval(problem%lag))
      if (options%keep_all) self%reach = huge(1.0_wp)
      if (continued) then
         call self%continue_run(instant(t_end), options, continuation)
      else
         call self%start_anew(instant(t_start), instant(t_end), options, error)
      end if
      if (self%lacking > 0.0_wp .or. allocated(error)) return
      self%context%past%most_bytes = options%most_bytes
      self%context%past%is_copied = self%points%remembers
      call self%context%tolerance%take_in(self%step%y)
      if (options%first_step > 0.0_wp) then
         self%h = options%first_step
      else if (.not. self%h > 0.0_wp .and. t_end > t_start) then
         call choose_first_step(self%context, self%step, options%unit_of_time, &
                                min(t_end - t_start, options%longest_step), self%h)
      end if
   end subroutine begin

   !> The first run. Its initial time is a kink, or a jump if a delayed component differs from its
   !> history there.
   subroutine start_anew(self, start, finish, options, error)
      class(run_type), intent(inout) :: self
      type(instant), intent(in) :: start, finish
      type(integration_options), intent(in) :: options
      type(error_type), allocatable, intent(out) :: error
      type(kink_type) :: first
      integer :: k

      self%now = start
      associate (context => self%context, problem => self%context%problem)
         call choose_method(problem, options%method, context%tolerance, start%hi, self%step, &
                            self%lacking)
         if (self%lacking > 0.0_wp) return
         call check_finite("integrate: the initial state has y", self%step%y, error)
         if (allocated(error)) return
         call context%work%set_cost(self%step%constants%evaluation_cost)
         context%past = history_type(problem, start, &
                                     [(k, k=1, merge(problem%n, 0, options%keep_all))])
         first = kink_type(start)
         do k = 1, size(problem%lag)
            associate (component => problem%component(k))
               if (abs(problem%history(start%hi, component) - self%step%y(component)) &
                   > 0.0_wp) then
                  first%passages = -1
               end if
            end associate
         end do
         call self%points%begin(causes(options, start, [first]), start, start, finish, &
                                problem%lag, problem%n, self%step%constants%order - 1, &
                                context%tolerance%level)
      end associate
      call prepare_start(self, options)
      self%first_slope = self%step%slope
   end subroutine start_anew

   !> Another run, with the past of the one before. If the right-hand side differs from that at the
   !> end of the earlier run, there is a kink here.
   subroutine continue_run(self, finish, options, continuation)
      class(run_type), intent(inout) :: self
      type(instant), intent(in) :: finish
      type(integration_options), intent(in) :: options
      type(continuation_type), intent(in) :: continuation
      character(len=8) :: method
      type(kink_type), allocatable :: kinks(:)
      real(wp) :: largest(size(continuation%y))

      largest = 0.0_wp
      largest(continuation%kept) = max(0.0_wp, maxval(abs(continuation%coefficients(1, :, :)), 2))
      call self%context%tolerance%take_in(largest)
      self%now = instant(continuation%time(1), continuation%time(2))
      self%h = continuation%next_step
      method = options%method
      associate (context => self%context, problem => self%context%problem, &
                 origin => instant(continuation%origin(1), continuation%origin(2)))
         if (method == "auto") then
            method = matching_method(problem, context%tolerance, origin%hi, &
                                     implicit=any(continuation%method == implicit_methods))
         end if
         call choose_method(problem, method, context%tolerance, origin%hi, self%step, self%lacking)
         if (self%lacking > 0.0_wp) return
         call context%work%set_cost(self%step%constants%evaluation_cost)
         self%step%y = continuation%y
         self%first_slope = continuation%slope
         context%past = history_type(problem, origin, continuation%kept)
         call continuation%restore(context%past, kinks)
         call self%points%begin(causes(options, origin, kinks), origin, self%now, finish, &
                                problem%lag, problem%n, self%step%constants%order - 1, &
                                context%tolerance%level)
      end associate
      call prepare_start(self, options)
      if (size(self%first_slope) == 0) self%first_slope = self%step%slope
      if (.not. continuation%has_rate(self%step%slope)) then
         call self%points%add(kink_type(self%now))
      end if
   end subroutine continue_run

   !> Evaluate the slope at the start of the next step.
   subroutine prepare_start(self, options)
      class(run_type), intent(inout) :: self
      type(integration_options), intent(in) :: options
      integer :: i

      self%may_jump = allocated(options%break_at)
      if (self%may_jump) then
         associate (past => self%context%past)
            past%history_jumps = any(options%break_at < past%origin%hi)
         end associate
         self%at_cause = .not. all(abs([(elapsed(self%now, instant(options%break_at(i))), &
                                         i=1, size(options%break_at))]) > 0.0_wp)
      end if
      associate (problem => self%context%problem)
         call self%context%go_to(self%now, &
                                 min(longest_step(problem, self%step, options%longest_step), &
                                     minval(problem%lag), self%points%time_to_next(self%now)))
         call bound_times(self)
         if (.not. allocated(self%sides%above)) then
            call self%sides%begin(self%context, self%step%y, problem%switches)
         end if
      end associate
      call self%step%restart(self%context)
   end subroutine prepare_start

   !> The right-hand side is evaluated beside a time where it may jump, not there.
   pure subroutine bound_times(self, goal)
      class(run_type), intent(inout) :: self
      !> Number of the point that the step lands on, if it lands on one
      integer, intent(in), optional :: goal
      real(wp) :: time

      if (.not. self%may_jump) return
      associate (cursor => self%context%cursor)
         cursor%earliest = -huge(1.0_wp)
         cursor%latest = huge(1.0_wp)
         if (self%at_cause) cursor%earliest = self%now%hi + beside*spacing(self%now%hi)
         if (.not. present(goal)) return
         if (.not. self%points%is_cause(goal)) return
         time = self%now%hi + elapsed(self%now, self%points%at(goal))
         cursor%latest = time - beside*spacing(time)
      end associate
   end subroutine bound_times

   !> Plan the next step. The method proposes a length. If the next breaking point is near, one step
   !> or two equal steps end there. On return the cursor is on the step.
   pure subroutine plan(self, longest, h, goal, landing)
      class(run_type), intent(inout) :: self
      real(wp), intent(in) :: longest
      real(wp), intent(out) :: h
      !> Number of the breaking point at which it should end
      integer, intent(out) :: goal
      !> Whether the step ends at this breaking point
      logical, intent(out) :: landing
      real(wp) :: gap

      goal = self%points%goal(self%now, min(self%h, longest))
      gap = elapsed(self%now, self%points%at(goal))
      call self%context%go_to(self%now, min(longest, gap))
      call bound_times(self)
      call self%step%propose(self%context, self%h)
      self%h = min(self%h, longest)
      if (self%step%constants%implicit) then
         associate (lag => minval(self%context%problem%lag))
            if (self%h > lag .and. self%h/uncoupled < lag) self%h = lag
         end associate
      end if
      landing = stretch*self%h >= gap .and. gap <= longest
      h = merge(gap, merge(0.5_wp*gap, self%h, 2.0_wp*self%h > gap), landing)
      self%context%cursor%h = h
      if (landing) call bound_times(self, goal)
   end subroutine plan

   !> Continue by the other method of `auto`; if memory is lacking, the step is the same as before.
   subroutine change_to_other(self, returned)
      class(run_type), intent(inout) :: self
      !> Whether it was left a few steps ago: if in these the solution hardly moved on, its steps
      !> are as long as they were
      logical, intent(in) :: returned
      class(step_type), allocatable :: last
      real(wp) :: h

      if (.not. allocated(self%other)) then
         associate (problem => self%context%problem, tolerance => self%context%tolerance, &
                    origin => self%context%past%origin%hi, &
                    implicit => .not. self%step%constants%implicit)
            call choose_method(problem, matching_method(problem, tolerance, origin, implicit), &
                               tolerance, origin, self%other, self%lacking)
         end associate
         if (self%lacking > 0.0_wp) return
      end if
      self%other%y = self%step%y
      self%other%slope = self%step%slope_here()
      call self%other%reset()
      call move_alloc(self%step, last)
      call move_alloc(self%other, self%step)
      call move_alloc(last, self%other)
      call self%context%work%set_cost(self%step%constants%evaluation_cost)
      self%control = controller_type()
      h = self%h
      if (returned .and. self%h_of_other > hardly*h) self%h = self%h_of_other
      self%h_of_other = h
   end subroutine change_to_other

   !> Where an accepted step ended at zeros of switching functions, go on on their other side.
   subroutine change_sides(self, options)
      class(run_type), intent(inout) :: self
      type(integration_options), intent(in) :: options

      self%step%y = self%sides%y
      call self%context%go_to(self%now, min(self%step%h, minval(self%context%problem%lag)))
      call self%sides%change(self%context, self%step%y)
      call prepare_start(self, options)
      call self%points%add(kink_type(self%now))
   end subroutine change_sides

   !> Go to the end of an accepted step.
   pure subroutine arrive(self, goal, landing, step_end)
      class(run_type), intent(inout) :: self
      !> Number of the breaking point at which the step should have ended
      integer, intent(in) :: goal
      logical, intent(in) :: landing
      type(instant), intent(in) :: step_end
      type(instant) :: horizon

      self%now = step_end
      call self%context%tolerance%take_in(self%step%y)
      self%at_cause = .false.
      if (.not. landing) then
         call self%points%pass(step_end)
         return
      end if
      self%at_cause = self%points%is_cause(goal)
      self%fresh = .true.
      call self%points%land(goal, self%h, self%step%h)
      associate (past => self%context%past)
         if (past%newest < past%oldest) return
         horizon = past%start_of(past%oldest)
         if (elapsed(past%origin, horizon) > 0.0_wp) call self%points%forget(horizon)
      end associate
   end subroutine arrive

   !> Keep what a later run needs to continue from here.
   subroutine keep(self, options, continuation)
      class(run_type), intent(inout) :: self
      type(integration_options), intent(in) :: options
      type(continuation_type), intent(out) :: continuation

      continuation%time = [self%now%hi, self%now%lo]
      associate (origin => self%context%past%origin)
         continuation%origin = [origin%hi, origin%lo]
      end associate
      continuation%y = self%step%y
      continuation%slope = self%step%slope_here()
      call self%search%read_slope(continuation%slope)
      call prepare_start(self, options)
      continuation%rate = self%step%slope
      continuation%next_step = self%h
      continuation%method = self%step%constants%name
      call continuation%store(self%context%past, self%points%met)
   end subroutine keep
end module dde_run
