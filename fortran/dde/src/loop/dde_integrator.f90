! SPDX-License-Identifier: BSD-3-Clause
!> The method of steps: controlled steps from breaking point to breaking point. The polynomial of
!> each accepted step is stored in the past that later steps read.
module dde_integrator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_continuation, only: continuation_type
   use dde_diagnosis, only: explain
   use dde_event_search, only: endless, most_places
   use dde_events, only: event_watcher_type
   use dde_exponents, only: exponent_watch
   use dde_methods, only: longest_step, matching_method, price_of_trial
   use dde_outcome, only: event_met, integration_result, interrupted, out_of_memory, reached_end, &
                          refused, slides, step_underflow, stop_requested, too_many_steps, &
                          value_not_finite
   use dde_output, only: deliver, is_read
   use dde_problem, only: dde_problem_type
   use dde_request, only: check, integration_options
   use dde_run, only: run_type
   use dde_sampler, only: sampler_type
   use dde_switch, only: switch_type
   use dde_time, only: elapsed, instant, later, too_short
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: integrate

contains

   !> Integrate `problem` from t_start to t_end >= t_start, or to an event that ends the run. Only
   !> the past that the delays need is stored. On an error `outcome` holds the last time reached.
   recursive subroutine integrate(problem, t_start, t_end, options, outcome, error, sampler, &
                                  watcher, continuation)
      !> The problem
      class(dde_problem_type), intent(in), target :: problem
      !> Initial time
      real(wp), intent(in) :: t_start
      !> Final time
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> The result
      type(integration_result), intent(out) :: outcome
      !> Why it reached neither t_end nor an event that ends the run
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(inout), optional :: watcher
      !> Where an earlier run ended; on return where this one ended
      type(continuation_type), intent(inout), optional :: continuation
      class(dde_problem_type), allocatable :: whole
      type(exponent_watch) :: exponents
      type(run_type), target :: run
      type(switch_type) :: switch
      type(instant) :: step_end
      real(wp) :: error_estimate, h, left, longest, longest_of_all
      integer :: goal
      logical :: automatic, ended, landing, last, other, passed

      if (.not. (allocated(problem%lag) .or. allocated(problem%component))) then
         ! gfortran 12 leaves out empty lists that a constructor is given
         allocate (whole, source=problem)
         allocate (whole%lag(0), whole%component(0))
         call integrate(whole, t_start, t_end, options, outcome, error, sampler, watcher, &
                        continuation)
         return
      end if
      allocate (outcome%switched(problem%switches), source=0_int64)
      call check(problem, t_start, t_end, options, error, sampler, watcher, continuation)
      if (allocated(error)) return
      call run%begin(problem, t_start, t_end, options, error, continuation)
      if (allocated(error)) return
      if (run%lacking > 0.0_wp) then
         outcome%reason = out_of_memory
         outcome%t = t_start
         call explain(run, outcome, t_end, 0.0_wp, options, error)
         return
      end if
      if (present(sampler)) then
         ! the first samples: those at (or before) the initial time
         do while (elapsed(instant(sampler%next), run%now) >= 0.0_wp)
            call sampler%take(run%step%y(sampler%wanted))
         end do
      end if
      if (present(watcher)) call run%search%begin(watcher, run%now, run%step%y, run%first_slope)
      longest_of_all = options%longest_step
      if (present(watcher)) then
         longest_of_all = min(longest_of_all, most_places*min(watcher%look_every, endless))
      end if
      longest = longest_step(problem, run%step, longest_of_all)
      automatic = options%method == "auto"
      if (automatic) then
         associate (tolerance => run%context%tolerance, origin => run%context%past%origin%hi)
            switch = switch_type(price_of_trial(problem, tolerance), &
                                 matching_method(problem, tolerance, origin, .false.) == "taylor", &
                                 minval(problem%lag))
         end associate
      end if
      error_estimate = 0.0_wp

      outcome%reason = reached_end
      last = .not. run%points%time_to_end(run%now) > 0.0_wp
      do while (.not. last)
         call run%context%past%make_room(size(run%step%nodes), run%lacking)
         if (run%lacking > 0.0_wp) then
            outcome%reason = out_of_memory
            exit
         end if
         call run%plan(longest, h, goal, landing)
         outcome%reason = limit_met(outcome, error_estimate, options, h, &
                                    too_short(t_start, run%now%hi, t_end))
         if (outcome%reason /= reached_end) exit
         if (run%fresh) call run%step%renew(run%context)
         run%fresh = .false.
         step_end = later(run%now, h)
         if (landing) step_end = run%points%at(goal)
         run%context%between = is_read(run, h, step_end, sampler, watcher)
         call run%step%attempt(run%context, error_estimate)
         call run%points%judge(step_end, error_estimate)
         if (problem%exponentials > 0 .and. accepted(error_estimate)) then
            call exponents%judge(run%context, run%step, error_estimate)
         end if
         if (problem%switches > 0 .and. accepted(error_estimate)) then
            call run%sides%judge(run%context, run%step, error_estimate)
         end if
         if (outcome%accepted == 0 .and. .not. accepted(error_estimate)) then
            call run%step%refuse_series(run%context, error)
            if (allocated(error)) then
               outcome%reason = refused
               exit
            end if
         end if
         other = .false.
         if (.not. accepted(error_estimate)) then
            outcome%rejected = outcome%rejected + 1
            run%h = h
            call run%control%reject(run%step%constants, run%step%safety, run%h, error_estimate)
            if (automatic) call switch%judge_rejection(run%step, error_estimate, other)
         else
            outcome%accepted = outcome%accepted + 1
            if (run%step%constants%implicit) outcome%implicit_steps = outcome%implicit_steps + 1
            call deliver(run, step_end, ended, sampler, watcher)
            passed = any(run%sides%passed)
            if (passed) then
               landing = landing .and. .not. elapsed(step_end, run%points%at(goal)) > 0.0_wp
            end if
            if (ended) then
               call run%arrive(goal, .false., step_end)
               run%step%y = run%search%event%y
               outcome%reason = event_met
               exit
            end if
            call run%step%next_length(run%control, h, error_estimate)
            if (automatic) then
               ! a run that may be continued has no end yet
               left = huge(1.0_wp)
               if (.not. present(continuation)) left = t_end - step_end%hi
               call switch%judge(problem, run%step, run%context%work, h, left, other)
            end if
            call exponents%advance(.not. (landing .or. passed))
            call run%step%advance()
            last = landing .and. run%points%is_end(goal)
            call run%arrive(goal, landing, step_end)
            if (passed) call run%change_sides(options)
            if (run%sides%slides > 0) then
               outcome%reason = slides
               exit
            end if
            ! a step shortened to end at a point does not reduce the step size proposed before
            run%h = merge(max(run%h, h), h, landing)
            if (landing .and. .not. last) outcome%breaking_points = outcome%breaking_points + 1
         end if
         if (other) then
            call run%change_to_other(switch%returned)
            if (run%lacking > 0.0_wp) then
               outcome%reason = out_of_memory
               exit
            end if
            outcome%switches = outcome%switches + 1
            longest = longest_step(problem, run%step, longest_of_all)
         end if
      end do

      outcome%t = run%now%hi
      outcome%y = run%step%y
      outcome%switched = run%sides%changes
      if (present(continuation) .and. outcome%reason /= out_of_memory) then
         call run%keep(options, continuation)
      end if
      outcome%evaluations = run%context%work%evaluations
      outcome%work = run%context%work%total()
      outcome%factorisations = run%context%work%factorisations
      if (all(outcome%reason /= [reached_end, event_met, refused])) then
         call explain(run, outcome, t_end, h, options, error)
      end if
   end subroutine integrate

   !> The limit that forbids an attempt of length h, or `reached_end` if none does.
   integer function limit_met(outcome, last_error, options, h, shortest) result(reason)
      type(integration_result), intent(in) :: outcome
      real(wp), intent(in) :: last_error, h, shortest
      type(integration_options), intent(in) :: options

      reason = reached_end
      if (h <= shortest) then
         reason = merge(step_underflow, value_not_finite, ieee_is_finite(last_error))
      else if (outcome%accepted + outcome%rejected >= options%most_steps) then
         reason = too_many_steps
      else if (stop_requested /= 0) then
         reason = interrupted
      end if
   end function limit_met

   !> Whether the error of a step is finite and within the tolerance.
   pure logical function accepted(error_estimate) result(value)
      real(wp), intent(in) :: error_estimate

      value = .false.
      if (ieee_is_finite(error_estimate)) value = error_estimate <= 1.0_wp
   end function accepted
end module dde_integrator
