!> The method of steps: from breaking point to breaking point with controlled steps, each accepted
!> step appended to the history that later steps read.
module dde_integrator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_continuation, only: continuation_type
   use dde_controller, only: controller_type
   use dde_diagnosis, only: not_finite
   use dde_event_search, only: endless, most_places
   use dde_events, only: event_watcher_type
   use dde_methods, only: change_method, limiting_delay, longest_step, price_of_trial
   use dde_outcome, only: event_met, explain, integration_result, limit_met, reached_end, &
                          value_not_finite
   use dde_output, only: hand_over, sample_start
   use dde_problem, only: dde_problem_type
   use dde_request, only: check, integration_options
   use dde_run, only: run_type
   use dde_sampler, only: sampler_type
   use dde_switch, only: switch_type
   use dde_time, only: elapsed, instant, later
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: integrate

contains

   !> Integrate `problem` from t_start to t_end >= t_start, or to an event that ends the run.
   !> Without sampler, watcher and continuation nothing is stored but the history that the delays
   !> need. On an error `outcome` still tells how far it came.
   subroutine integrate(problem, t_start, t_end, options, outcome, error, sampler, watcher, &
                        continuation)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant
      real(wp), intent(in) :: t_start
      !> Last instant
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What was done
      type(integration_result), intent(out) :: outcome
      !> Why it reached neither t_end nor an event that ends the run
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(inout), optional :: watcher
      !> Where an earlier run ended, to go on from there; where this one did
      type(continuation_type), intent(inout), optional :: continuation
      type(run_type) :: run
      type(controller_type) :: control
      type(switch_type) :: switch
      type(instant) :: step_end
      real(wp) :: error_estimate, h, left, longest, longest_of_all, shortest_delay
      character(len=:), allocatable :: culprit
      integer :: goal
      logical :: automatic, ended, landing, last, other

      call check(problem, t_start, t_end, options, error, sampler, watcher, continuation)
      if (allocated(error)) return
      call run%begin(problem, t_start, t_end, options, continuation)
      if (present(sampler)) call sample_start(sampler, run%now, run%step%y)
      if (present(watcher)) call run%search%begin(watcher, run%now, run%step%y, run%first_slope)
      longest_of_all = options%longest_step
      if (present(watcher)) then
         longest_of_all = min(longest_of_all, most_places*min(watcher%look_every, endless))
      end if
      longest = longest_step(problem, run%step, longest_of_all)
      automatic = options%method == "auto"
      if (automatic) switch%price = price_of_trial(problem, run%tolerance)
      shortest_delay = limiting_delay(problem)
      error_estimate = 0.0_wp

      outcome%reason = reached_end
      last = .not. run%points%left(run%now) > 0.0_wp
      do while (.not. last)
         call run%plan(problem, longest, h, goal, landing)
         outcome%reason = limit_met(outcome, error_estimate, options, h, &
                                    max(abs(t_start), abs(t_end)))
         if (outcome%reason /= reached_end) exit
         if (run%fresh) call run%step%restart(problem, run%past, run%now%hi)
         run%fresh = .false.
         call run%step%attempt(problem, run%past, run%now%hi, h, run%tolerance, error_estimate)
         if (.not. accepted(error_estimate)) then
            outcome%rejected = outcome%rejected + 1
            run%h = h
            call control%reject(run%step, run%h, error_estimate)
            cycle
         end if

         outcome%accepted = outcome%accepted + 1
         if (run%step%implicit) outcome%implicit_steps = outcome%implicit_steps + 1
         call run%step%complete(problem, run%past)
         step_end = later(run%now, h)
         if (landing) step_end = run%points%at(goal)
         if (.not. run%now%hi + h > run%now%hi) outcome%unresolved = outcome%unresolved + 1
         call hand_over(problem, run%step, run%past, run%search, run%now, step_end, &
                        run%points%smooth(run%now), ended, sampler, watcher)
         if (ended) then
            call run%arrive(goal, .false., step_end)
            run%step%y = run%search%here%y
            outcome%reason = event_met
            exit
         end if
         if (run%step%foresees) then
            h = run%step%ideal
         else
            call control%accept(run%step, h, error_estimate)
         end if
         other = .false.
         if (automatic) then
            ! a run that may go on has no end yet
            left = huge(1.0_wp)
            if (.not. present(continuation)) left = run%points%left(step_end)
            call switch%judge(problem, run%step, shortest_delay, h, left, other)
         end if
         call run%step%advance()
         last = landing .and. run%points%is_end(goal)
         call run%arrive(goal, landing, step_end)
         ! a step cut short to land says nothing against the length proposed before
         run%h = merge(max(run%h, h), h, landing)
         if (landing .and. .not. last) outcome%breaking_points = outcome%breaking_points + 1
         if (other) then
            call change_method(problem, run%tolerance, run%step)
            control = controller_type()
            outcome%switches = outcome%switches + 1
            longest = longest_step(problem, run%step, longest_of_all)
         end if
      end do

      outcome%t = run%now%hi
      outcome%y = run%step%y
      if (present(continuation)) call run%keep(problem, options, continuation)
      outcome%evaluations = run%step%evaluations
      outcome%work = run%step%work()
      outcome%factorisations = run%step%factorisations()
      if (all(outcome%reason /= [reached_end, event_met])) then
         culprit = ""
         if (outcome%reason == value_not_finite) then
            culprit = not_finite(problem, run%step, run%past, run%now, h)
         end if
         call explain(outcome, t_end, h, options, culprit, error)
      end if
   end subroutine integrate

   !> Whether a step passed: its error finite and within the tolerance.
   pure logical function accepted(error_estimate) result(value)
      !> Error in units of the tolerance
      real(wp), intent(in) :: error_estimate

      value = .false.
      if (ieee_is_finite(error_estimate)) value = error_estimate <= 1.0_wp
   end function accepted
end module dde_integrator
