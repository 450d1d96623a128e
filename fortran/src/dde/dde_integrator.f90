!> The method of steps: from breaking point to breaking point with controlled steps, each accepted
!> step appended to the history that later steps read.
module dde_integrator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_breaking_points, only: breaking_points
   use dde_controller, only: controller_type
   use dde_explicit_step, only: explicit_step_type
   use dde_first_step, only: choose_first_step
   use dde_history, only: history_type
   use dde_implicit_step, only: implicit_step_type
   use dde_interpolant, only: newton_value
   use dde_outcome, only: explain, integration_result, limit_met, reached_end
   use dde_problem, only: dde_problem_type
   use dde_request, only: check, integration_options
   use dde_sampler, only: sampler_type
   use dde_step, only: step_type
   use dde_switch, only: switch_type
   use dde_time, only: elapsed, instant, instant_at, later
   use errors, only: error_type
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: integrate

contains

   !> Integrate `problem` from t_start to t_end > t_start. Without a sampler nothing is stored but
   !> the history that the delays need. On an error `outcome` still tells how far it came.
   subroutine integrate(problem, t_start, t_end, options, outcome, error, sampler)
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
      !> Why it did not reach t_end
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      class(step_type), allocatable :: step
      type(history_type) :: past
      type(controller_type) :: control
      type(switch_type) :: switch
      type(instant) :: now, step_end
      type(instant), allocatable :: points(:)
      real(wp) :: error_estimate, gap, h, h_try, longest
      integer :: next_point
      logical :: delayed, fresh, landing, other

      call check(problem, t_start, t_end, options, error)
      if (allocated(error)) return
      now = instant_at(t_start)
      delayed = size(problem%lag) > 0
      call choose_method(problem, options%method, step)
      longest = longest_step(problem, step, options)
      if (delayed) then
         past = history_type(problem, now)
         call past%face(problem, now, min(longest, minval(problem%lag)))
      end if
      points = [breaking_points(now, instant_at(t_end), problem%lag, &
                                passages(problem, step, t_start)), instant_at(t_end)]
      next_point = 1
      call step%restart(problem, past, t_start)
      if (present(sampler)) call sample_start(sampler, t_start, step%y)
      h = options%first_step
      if (.not. h > 0.0_wp) then
         call choose_first_step(problem, past, step, t_start, t_end - t_start, options, h)
      end if
      fresh = .false.
      error_estimate = 0.0_wp

      do
         h = min(h, longest)
         gap = elapsed(now, points(next_point))
         landing = 1.01_wp*h >= gap .and. gap <= longest
         h_try = merge(gap, merge(0.5_wp*gap, h, 2.0_wp*h > gap), landing)
         outcome%reason = limit_met(outcome, error_estimate, options, h_try, &
                                    max(abs(t_start), abs(t_end)))
         if (outcome%reason /= reached_end) exit
         if (delayed) call past%face(problem, now, h_try)
         if (fresh) call step%restart(problem, past, now%hi)
         fresh = .false.
         call step%attempt(problem, past, now%hi, h_try, options%relative, options%absolute, &
                           error_estimate)
         if (.not. accepted(error_estimate)) then
            outcome%rejected = outcome%rejected + 1
            h = h_try
            call control%reject(step, h, error_estimate)
            cycle
         end if

         outcome%accepted = outcome%accepted + 1
         if (step%implicit) outcome%implicit_steps = outcome%implicit_steps + 1
         call step%complete(problem, past)
         step_end = later(now, h_try)
         if (landing) step_end = points(next_point)
         call hand_over(problem, step, past, now, step_end, sampler)
         call control%accept(step, h_try, error_estimate)
         other = .false.
         if (options%method == "auto") then
            call switch%wanted(step, minval(problem%lag), h_try, other)
         end if
         call step%advance()
         now = step_end
         ! a step cut short to land says nothing against the length proposed before
         h = merge(max(h, h_try), h_try, landing)
         if (landing) then
            if (next_point == size(points)) exit
            next_point = next_point + 1
            outcome%breaking_points = outcome%breaking_points + 1
            fresh = .true.
         end if
         if (other) then
            call change_method(problem, step)
            control = controller_type()
            outcome%switches = outcome%switches + 1
            longest = longest_step(problem, step, options)
         end if
      end do

      outcome%t = now%hi
      outcome%y = step%y
      outcome%evaluations = step%evaluations
      outcome%factorisations = step%factorisations()
      if (outcome%reason /= reached_end) call explain(outcome, t_end, h_try, options, error)
   end subroutine integrate

   !> A step of the method asked for.
   subroutine choose_method(problem, method, step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Name of the method
      character(len=*), intent(in) :: method
      !> Its step
      class(step_type), allocatable, intent(out) :: step

      select case (method)
      case ("radau5")
         allocate (step, source=implicit_step_type(problem, 3))
      case ("radau9")
         allocate (step, source=implicit_step_type(problem, 5))
      case ("radau13")
         allocate (step, source=implicit_step_type(problem, 7))
      case default
         allocate (step, source=explicit_step_type(problem))
      end select
   end subroutine choose_method

   !> The longest step allowed: an explicit one ends before its delayed values lie in it.
   pure function longest_step(problem, step, options) result(longest)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> Limits
      type(integration_options), intent(in) :: options
      real(wp) :: longest

      longest = options%longest_step
      if (.not. step%implicit) longest = minval([longest, problem%lag])
   end function longest_step

   !> The other method takes over where the step stands.
   subroutine change_method(problem, step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step, advanced; replaced by one of the other method
      class(step_type), allocatable, intent(inout) :: step
      class(step_type), allocatable :: other

      call choose_method(problem, merge("explicit", "radau9  ", step%implicit), other)
      other%y = step%y
      other%slope = step%slope
      other%evaluations = step%evaluations
      other%factorised_before = step%factorisations()
      call move_alloc(other, step)
   end subroutine change_method

   !> Hand the dense output of an accepted step to the history and to the sampler, as far as they
   !> want it.
   subroutine hand_over(problem, step, past, start, step_end, sampler)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step, accepted and complete
      class(step_type), intent(inout) :: step
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Start of the step
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      logical :: delayed, sampled

      delayed = size(problem%lag) > 0
      sampled = .false.
      if (present(sampler)) sampled = elapsed(instant_at(sampler%next), step_end) >= 0.0_wp
      if (delayed .or. sampled) call step%extend(problem, past)
      if (sampled) call sample(sampler, step, start, step_end)
      if (delayed) then
         call remember(past, step, start)
         call past%forget(later(step_end, -maxval(problem%lag)))
      end if
   end subroutine hand_over

   !> Append the delayed components' dense output to the past.
   pure subroutine remember(past, step, start)
      !> The past
      type(history_type), intent(inout) :: past
      !> The step, extended
      class(step_type), intent(in) :: step
      !> Start of the step
      type(instant), intent(in) :: start
      real(wp) :: coefficients(0:size(step%nodes), size(past%kept))
      integer :: i

      do i = 1, size(past%kept)
         call step%interpolant(past%kept(i), coefficients(:, i))
      end do
      call past%append(start, step%h, step%nodes, coefficients)
   end subroutine remember

   !> Passages through a delay after which a kink at the origin no longer shows: one more when a
   !> delayed component jumps there.
   pure integer function passages(problem, step, t_start) result(value)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step at the first instant
      class(step_type), intent(in) :: step
      !> First instant
      real(wp), intent(in) :: t_start
      integer :: k

      value = step%order
      do k = 1, size(problem%lag)
         associate (component => problem%component(k))
            if (abs(problem%history(t_start, component) - step%y(component)) > 0.0_wp) then
               value = step%order + 1
               return
            end if
         end associate
      end do
   end function passages

   !> Whether a step passed: its error finite and within the tolerance.
   pure logical function accepted(error_estimate) result(value)
      !> Error in units of the tolerance
      real(wp), intent(in) :: error_estimate

      value = .false.
      if (ieee_is_finite(error_estimate)) value = error_estimate <= 1.0_wp
   end function accepted

   !> The first samples: those at (or before) the first instant.
   subroutine sample_start(sampler, t_start, y)
      !> Receiver
      class(sampler_type), intent(inout) :: sampler
      !> First instant
      real(wp), intent(in) :: t_start
      !> State there, shape (n)
      real(wp), intent(in) :: y(:)

      do while (sampler%next <= t_start)
         call sampler%take(y(sampler%wanted))
      end do
   end subroutine sample_start

   !> The samples that lie in an accepted and extended step.
   subroutine sample(sampler, step, start, step_end)
      !> Receiver
      class(sampler_type), intent(inout) :: sampler
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      real(wp) :: coefficients(0:size(step%nodes), size(sampler%wanted))
      real(wp) :: values(size(sampler%wanted)), s
      integer :: i

      do i = 1, size(values)
         call step%interpolant(sampler%wanted(i), coefficients(:, i))
      end do
      do while (elapsed(instant_at(sampler%next), step_end) >= 0.0_wp)
         s = elapsed(start, instant_at(sampler%next))/step%h
         do i = 1, size(values)
            values(i) = newton_value(size(step%nodes), step%nodes, coefficients(:, i), s)
         end do
         call sampler%take(values)
      end do
   end subroutine sample
end module dde_integrator
