! SPDX-License-Identifier: BSD-3-Clause
!> The state of a run between two steps: how the next step is planned, and what is kept when it
!> ends.
module dde_run
   use dde_breaking_points, only: breaking_points, stretch
   use dde_continuation, only: continuation_type
   use dde_controller, only: controller_type
   use dde_errors, only: error_type
   use dde_event_search, only: endless, event_search, most_places
   use dde_events, only: event_watcher_type
   use dde_exponents, only: exponent_watch
   use dde_kink, only: kink_type
   use dde_methods, only: choose_method, matching_method
   use dde_problem, only: dde_problem_type
   use dde_request, only: integration_options
   use dde_sampler, only: sampler_type
   use dde_sides, only: sides_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_switch, only: switch_type
   use dde_time, only: elapsed, instant, later
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: run_type

   !> Distance from a jump at which the right-hand side is evaluated, in units of the spacing of
   !> times.
   real(wp), parameter :: beside = 4.0_wp

   !> Kinks as near to each other are one for delays that move, in the same units, or smooth ones in
   !> units of the proposed step.
   real(wp), parameter :: near = 16.0_wp, beside_kink = 0.5_wp

   !> An implicit step of a proposed length below this many times the shortest delay is no longer
   !> than the delay: otherwise its delayed values couple its stages. In one of three stiff chains
   !> (`dde_chain_costs`) 1, 1.5 and 4 take 1.11, 1.03 and 0.92 times the instructions, and in the
   !> others as many.
   real(wp), parameter :: uncoupled = 2.0_wp

   !> The step that is planned, or taken.
   type :: planned_step
      !> Its length
      real(wp) :: h = 0.0_wp
      !> Its end
      type(instant) :: finish
      !> Number of the breaking point at which it should end, and whether it ends there
      integer :: goal = 0
      logical :: landing = .false.
   end type planned_step

   !> The state of a run.
   type :: run_type
      !> Initial and final time wanted, and the options
      real(wp) :: t_start = 0.0_wp, t_end = 0.0_wp
      type(integration_options) :: options
      !> Receivers of samples and of events, if there are some
      class(sampler_type), pointer :: sampler => null()
      class(event_watcher_type), pointer :: watcher => null()
      !> The step, of the method in use
      class(step_type), allocatable :: step
      !> The choice of `auto`, if that is the method
      type(switch_type), allocatable :: switch
      !> The context of its steps: problem, past, tolerance and work
      type(step_context) :: context
      !> The sides of switching functions on which f is, and the problem that takes them, if it has
      !> some
      type(sides_type) :: sides
      class(dde_problem_type), allocatable :: sided
      !> The exponents of exponential terms over a step
      type(exponent_watch) :: exponents
      !> Step control
      type(controller_type) :: control
      !> The search for events, begun if there is a watcher
      type(event_search) :: search
      !> Now
      type(instant) :: now
      !> Length proposed for the next step, and the longest allowed
      real(wp) :: h = 0.0_wp
      real(wp), private :: longest = 0.0_wp
      !> The next step, or the one that is taken
      type(planned_step) :: next
      !> Error of the last attempt in units of the tolerance
      real(wp) :: estimate = 0.0_wp
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
      procedure :: prepare_start, find_longest, plan, shorten, arrive, change_to_other
      procedure :: change_sides, keep
   end type run_type

contains

   !> Evaluate the slope at the start of the next step.
   subroutine prepare_start(self)
      class(run_type), intent(inout) :: self
      integer :: i

      self%may_jump = allocated(self%options%break_at)
      if (self%may_jump) then
         associate (past => self%context%past, break_at => self%options%break_at)
            past%history_jumps = any(break_at < past%origin%hi)
            self%at_cause = .not. all(abs([(elapsed(self%now, instant(break_at(i))), &
                                            i=1, size(break_at))]) > 0.0_wp)
         end associate
      end if
      associate (context => self%context, problem => self%context%problem)
         call context%go_to(self%now, min(self%options%longest_step, problem%shortest_lag(), &
                                          self%points%time_to_next(self%now)))
         call bound_times(self)
         if (.not. allocated(self%sides%above)) then
            call self%sides%begin(context, self%step%y, problem%switches)
         end if
         call self%step%restart(context)
      end associate
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

   !> The longest step allowed: the watcher is not looked at in too many places of it, and an
   !> explicit one ends before its delayed values lie in it.
   pure subroutine find_longest(self)
      class(run_type), intent(inout) :: self

      self%longest = self%options%longest_step
      if (associated(self%watcher)) then
         self%longest = min(self%longest, most_places*min(self%watcher%look_every, endless))
      end if
      if (.not. self%step%constants%implicit) then
         self%longest = min(self%longest, self%context%problem%shortest_lag())
      end if
   end subroutine find_longest

   !> Plan the next step. The method proposes a length. If the next breaking point is near, one step
   !> or two equal steps end there. On return the cursor is on the step.
   pure subroutine plan(self)
      class(run_type), intent(inout) :: self
      real(wp) :: gap

      associate (next => self%next, longest => self%longest)
         next%goal = self%points%goal(self%now, min(self%h, longest))
         gap = elapsed(self%now, self%points%at(next%goal))
         call self%context%go_to(self%now, min(longest, gap))
         call bound_times(self)
         call self%step%propose(self%context, self%h)
         self%h = min(self%h, longest)
         if (self%step%constants%implicit) then
            associate (lag => self%context%problem%shortest_lag())
               if (self%h > lag .and. self%h/uncoupled < lag) self%h = lag
            end associate
         end if
         next%landing = stretch*self%h >= gap .and. gap <= longest
         next%h = merge(gap, merge(0.5_wp*gap, self%h, 2.0_wp*self%h > gap), next%landing)
         self%context%cursor%h = next%h
         next%finish = later(self%now, next%h)
         if (.not. next%landing) return
         next%finish = self%points%at(next%goal)
         call bound_times(self, next%goal)
      end associate
   end subroutine plan

   !> Plan a shorter step.
   pure subroutine shorten(self, share, finish)
      class(run_type), intent(inout) :: self
      !> Share of the planned one, and its end
      real(wp), intent(in) :: share
      type(instant), intent(in) :: finish

      self%next%h = share*self%next%h
      self%next%finish = finish
      self%next%landing = .false.
      call self%context%go_to(self%now, self%next%h)
      call bound_times(self)
   end subroutine shorten

   !> Continue by the other method of `auto`; if memory is lacking, the step is the same as before.
   subroutine change_to_other(self, error)
      class(run_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(self%switch%other)) then
         associate (problem => self%context%problem, tolerance => self%context%tolerance, &
                    origin => self%context%past%origin%hi, &
                    implicit => .not. self%step%constants%implicit)
            call choose_method(problem, matching_method(problem, tolerance, origin, implicit), &
                               tolerance, origin, self%switch%other, self%lacking, error)
         end associate
         if (self%lacking > 0.0_wp .or. allocated(error)) return
      end if
      call self%switch%exchange(self%step, self%h)
      call self%context%work%set_cost(self%step%constants%evaluation_cost)
      self%control = controller_type()
      call self%find_longest()
   end subroutine change_to_other

   !> Where an accepted step ended at zeros of switching functions, go on on their other side.
   subroutine change_sides(self)
      class(run_type), intent(inout) :: self

      self%step%y = self%sides%y
      if (self%sides%meets_kink()) call self%points%spend()
      call self%context%go_to(self%now, min(self%step%h, self%context%problem%shortest_lag()))
      call self%sides%change(self%context, self%step%y)
      call add_piece(self, self%sides%kink)
      if (any(self%sides%acted)) then
         call tell_acts(self)
         call self%context%tolerance%take_in(self%step%y)
         ! one sample was taken before the jump
         if (associated(self%sampler)) call self%sampler%limit_next(self%now%hi, 0.0_wp)
      end if
      call self%prepare_start()
      if (self%sides%kink%passages < huge(1)) call self%points%add(self%sides%kink)
   end subroutine change_sides

   !> Tell the watcher which events changed the state, if it wants to know.
   subroutine tell_acts(self)
      type(run_type), intent(inout) :: self
      integer :: i

      if (.not. associated(self%watcher)) return
      associate (watcher => self%watcher, problem => self%context%problem, sides => self%sides)
         if (.not. watcher%takes_acts) return
         do i = 1, problem%acting
            if (.not. sides%acted(problem%switches - problem%acting + i)) cycle
            call watcher%take(size(watcher%direction) + i, self%now, sides%y, self%step%slope)
         end do
      end associate
   end subroutine tell_acts

   !> Go to the end of an accepted step.
   pure subroutine arrive(self)
      class(run_type), intent(inout) :: self
      type(instant) :: horizon

      self%now = self%next%finish
      call self%context%tolerance%take_in(self%step%y)
      self%at_cause = .false.
      if (.not. self%next%landing) then
         call self%points%pass(self%now)
         return
      end if
      self%at_cause = self%points%is_cause(self%next%goal)
      self%fresh = .true.
      call add_piece(self, self%points%kink(self%next%goal))
      call self%points%land(self%next%goal, self%h, self%step%h)
      associate (past => self%context%past)
         if (past%newest < past%oldest) return
         horizon = past%start_of(past%oldest)
         if (.not. elapsed(past%origin, horizon) > 0.0_wp) return
         call self%points%forget(horizon)
         if (self%context%problem%moving > 0) call past%pieces%forget(horizon)
      end associate
   end subroutine arrive

   !> Delays that move read other pieces of the past before and after a kink here, if it may return.
   pure subroutine add_piece(self, kink)
      type(run_type), intent(inout) :: self
      type(kink_type), intent(in) :: kink

      if (self%context%problem%moving == 0 .or. .not. self%points%is_tracked(kink)) return
      associate (past => self%context%past)
         ! smooth ones are worth a step of their own only if it is not short
         call past%pieces%add(kink, past%newest + 1, self%points%is_worth(kink), &
                              max(near*spacing(self%now%hi), &
                                  merge(beside_kink*self%h, 0.0_wp, kink%passages > 0)))
      end associate
   end subroutine add_piece

   !> Keep what a later run needs to continue from here.
   subroutine keep(self, continuation)
      class(run_type), intent(inout) :: self
      type(continuation_type), intent(out) :: continuation

      continuation%time = [self%now%hi, self%now%lo]
      associate (origin => self%context%past%origin)
         continuation%origin = [origin%hi, origin%lo]
      end associate
      continuation%y = self%step%y
      continuation%slope = self%step%slope_here()
      call self%search%read_slope(continuation%slope)
      call self%prepare_start()
      continuation%rate = self%step%slope
      continuation%next_step = self%h
      continuation%method = self%step%constants%name
      call continuation%store(self%context%past, self%points%met)
   end subroutine keep
end module dde_run
