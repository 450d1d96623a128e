! SPDX-License-Identifier: BSD-3-Clause
!> The method of steps: controlled steps from breaking point to breaking point. The polynomial of
!> each accepted step is stored in the past that later steps read.
module dde_integrator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_continuation, only: continuation_type
   use dde_diagnosis, only: explain
   use dde_events, only: event_watcher_type
   use dde_outcome, only: event_met, integration_result, interrupted, out_of_memory, reached_end, &
                          refused, slides, step_underflow, stop_requested, too_many_steps, &
                          value_not_finite
   use dde_output, only: begin_output, deliver, is_read
   use dde_problem, only: dde_problem_type
   use dde_request, only: check, integration_options
   use dde_run, only: run_type
   use dde_sampler, only: sampler_type
   use dde_start, only: begin_run
   use dde_time, only: too_short
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
      class(sampler_type), intent(inout), optional, target :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(inout), optional, target :: watcher
      !> Where an earlier run ended; on return where this one ended
      type(continuation_type), intent(inout), optional :: continuation
      class(dde_problem_type), allocatable :: whole
      type(run_type), target :: run

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
      if (present(sampler)) run%sampler => sampler
      if (present(watcher)) run%watcher => watcher
      call begin_run(run, problem, t_start, t_end, options, error, continuation)
      if (allocated(error)) return
      outcome%t = t_start
      outcome%reason = out_of_memory
      if (.not. run%lacking > 0.0_wp) then
         call begin_output(run)
         call take_steps(run, outcome, error)
         outcome%t = run%now%hi
         outcome%y = run%step%y
         outcome%switched = run%sides%changes
         outcome%untracked = run%context%past%pieces%left_out
         if (present(continuation) .and. outcome%reason /= out_of_memory) then
            call run%keep(continuation)
         end if
         outcome%evaluations = run%context%work%evaluations
         outcome%work = run%context%work%total()
         outcome%factorisations = run%context%work%factorisations
      end if
      if (all(outcome%reason /= [reached_end, event_met, refused])) then
         call explain(run, outcome, error)
      end if
   end subroutine integrate

   !> Take steps to the end of the run, or to what stops it.
   subroutine take_steps(run, outcome, error)
      type(run_type), intent(inout) :: run
      type(integration_result), intent(inout) :: outcome
      !> Series of the problem are wrong
      type(error_type), allocatable, intent(out) :: error
      logical :: other

      outcome%reason = reached_end
      do while (run%points%time_to_end(run%now) > 0.0_wp)
         call run%context%past%make_room(size(run%step%nodes), run%lacking)
         if (run%lacking > 0.0_wp) exit
         call run%plan()
         outcome%reason = limit_met(run, outcome)
         if (outcome%reason /= reached_end) exit
         call attempt_step(run, outcome)
         if (accepted(run%estimate)) then
            call accept_step(run, outcome, other)
            if (outcome%reason /= reached_end) exit
         else
            if (outcome%accepted == 0) call run%step%refuse_series(run%context, error)
            if (allocated(error)) exit
            call reject_step(run, outcome, other)
         end if
         if (.not. other) cycle
         call run%change_to_other(error)
         if (run%lacking > 0.0_wp .or. allocated(error)) exit
         outcome%switches = outcome%switches + 1
      end do
      if (run%lacking > 0.0_wp) outcome%reason = out_of_memory
      if (allocated(error)) outcome%reason = refused
   end subroutine take_steps

   !> The limit that forbids the planned step, or `reached_end` if none does.
   integer function limit_met(run, outcome) result(reason)
      type(run_type), intent(in) :: run
      type(integration_result), intent(in) :: outcome

      reason = reached_end
      if (run%next%h <= too_short(run%t_start, run%now%hi, run%t_end)) then
         reason = merge(step_underflow, value_not_finite, ieee_is_finite(run%estimate))
      else if (outcome%accepted + outcome%rejected >= run%options%most_steps) then
         reason = too_many_steps
      else if (stop_requested /= 0) then
         reason = interrupted
      end if
   end function limit_met

   !> Attempt the planned step, again up to a kink that a moving delay meets in it.
   subroutine attempt_step(run, outcome)
      type(run_type), intent(inout) :: run
      type(integration_result), intent(inout) :: outcome
      logical :: again

      if (run%fresh) call run%step%renew(run%context)
      run%fresh = .false.
      run%context%between = is_read(run)
      again = .false.
      do
         call judge_step(run)
         if (size(run%sides%above) == 0 .or. .not. accepted(run%estimate)) return
         call run%sides%find_end(run%context, run%step, run%now, run%next%finish, again)
         if (.not. again) return
         outcome%rejected = outcome%rejected + 1
         call run%shorten(run%sides%share, run%sides%finish)
      end do
   end subroutine attempt_step

   !> Make the planned step, and estimate its error by all that watches it.
   subroutine judge_step(run)
      type(run_type), intent(inout) :: run

      call run%step%attempt(run%context, run%estimate)
      call run%points%judge(run%next%finish, run%estimate)
      associate (problem => run%context%problem)
         if (problem%exponentials > 0 .and. accepted(run%estimate)) then
            call run%exponents%judge(run%context, run%step, run%estimate)
         end if
         if (problem%switches + problem%moving > 0 .and. accepted(run%estimate)) then
            call run%sides%judge(run%context, run%step, run%estimate)
         end if
      end associate
   end subroutine judge_step

   !> Whether the error of a step is finite and within the tolerance.
   pure logical function accepted(estimate) result(value)
      real(wp), intent(in) :: estimate

      value = .false.
      if (ieee_is_finite(estimate)) value = estimate <= 1.0_wp
   end function accepted

   !> Pass on what an accepted step gives, and go to its end.
   subroutine accept_step(run, outcome, other)
      type(run_type), intent(inout) :: run
      type(integration_result), intent(inout) :: outcome
      !> Whether the other method of `auto` takes over
      logical, intent(out) :: other
      real(wp) :: h, left
      logical :: ended, passed

      other = .false.
      outcome%accepted = outcome%accepted + 1
      if (run%step%constants%implicit) outcome%implicit_steps = outcome%implicit_steps + 1
      call deliver(run, ended)
      if (ended) then
         call run%arrive()
         run%step%y = run%search%event%y
         if (any(run%sides%passed)) call run%change_sides()
         outcome%reason = event_met
         return
      end if
      h = run%next%h
      call run%step%next_length(run%control, h, run%estimate)
      if (allocated(run%switch)) then
         ! a run that may be continued has no end yet
         left = merge(huge(1.0_wp), run%t_end - run%next%finish%hi, run%points%remembers)
         call run%switch%judge(run%context%problem, run%step, run%context%work, h, left, other)
      end if
      passed = any(run%sides%passed)
      call run%exponents%advance(.not. (run%next%landing .or. passed))
      call run%step%advance()
      call run%arrive()
      if (passed) call run%change_sides()
      if (run%sides%slides > 0) then
         outcome%reason = slides
         return
      end if
      if (run%next%landing .or. run%sides%meets_kink()) then
         ! a step shortened to end at a point does not reduce the step size proposed before
         h = max(run%h, h)
         if (run%points%time_to_end(run%now) > 0.0_wp) then
            outcome%breaking_points = outcome%breaking_points + 1
         end if
      end if
      run%h = h
   end subroutine accept_step

   !> Shorten a rejected step.
   subroutine reject_step(run, outcome, other)
      type(run_type), intent(inout) :: run
      type(integration_result), intent(inout) :: outcome
      !> Whether the other method of `auto` takes over
      logical, intent(out) :: other

      other = .false.
      outcome%rejected = outcome%rejected + 1
      run%h = run%next%h
      call run%control%reject(run%step%constants, run%step%safety, run%h, run%estimate)
      if (allocated(run%switch)) call run%switch%judge_rejection(run%step, run%estimate, other)
   end subroutine reject_step
end module dde_integrator
