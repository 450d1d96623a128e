!> The method of steps: from breaking point to breaking point with controlled steps, each accepted
!> step appended to the history that later steps read.
module dde_integrator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_breaking_points, only: breaking_points
   use dde_controller, only: controller_type
   use dde_explicit_step, only: explicit_degree, explicit_nodes, explicit_order, explicit_step_type
   use dde_history, only: history_type
   use dde_interpolant, only: newton_value
   use dde_problem, only: dde_problem_type
   use dde_sampler, only: sampler_type
   use dde_time, only: elapsed, instant, instant_at, later
   use errors, only: error_type, raise, text
   use kinds, only: int64, wp
   implicit none
   private
   public :: integrate, integration_options, integration_result
   public :: reached_end, refused, step_underflow, too_many_steps, value_not_finite

   !> Why an integration ended.
   enum, bind(c)
      enumerator :: reached_end, refused, step_underflow, too_many_steps, value_not_finite
   end enum

   !> What a caller may choose.
   type :: integration_options
      !> 'auto' or 'explicit'
      character(len=8) :: method = 'auto'
      !> Relative tolerance of one step
      real(wp) :: relative = 1.0e-9_wp
      !> Absolute tolerance of one step
      real(wp) :: absolute = 1.0e-9_wp
      !> Length of the first step; chosen by the solver when 0
      real(wp) :: first_step = 0.0_wp
      !> Longest step
      real(wp) :: longest_step = huge(1.0_wp)
      !> Most steps, accepted and rejected
      integer(int64) :: most_steps = 100000000_int64
   end type integration_options

   !> What an integration did.
   type :: integration_result
      !> Why it ended: reached_end, step_underflow, too_many_steps, value_not_finite or refused
      integer :: reason = refused
      !> How far it came
      real(wp) :: t = 0.0_wp
      !> State there, shape (n)
      real(wp), allocatable :: y(:)
      !> Name of the method used
      character(len=8) :: method = ''
      !> Steps accepted
      integer(int64) :: accepted = 0
      !> Steps rejected
      integer(int64) :: rejected = 0
      !> Right-hand sides evaluated
      integer(int64) :: evaluations = 0
      !> Breaking points landed on
      integer :: breaking_points = 0
   end type integration_result

contains

   !> Integrate `problem` from t_start to t_end > t_start. Without a sampler nothing is stored but the
   !> history that the delays need. On an error `outcome` still tells how far it came.
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
      type(explicit_step_type) :: step
      type(history_type) :: past
      type(controller_type) :: control
      type(instant) :: now, finish, step_end, target
      type(instant), allocatable :: points(:)
      real(wp), allocatable :: coefficients(:, :)
      real(wp) :: error_estimate, gap, h, h_try, longest
      integer :: i, next_point
      logical :: delayed, extended, fresh, landing

      call check(problem, t_start, t_end, options, error)
      if (allocated(error)) return
      now = instant_at(t_start)
      finish = instant_at(t_end)
      outcome%method = 'explicit'
      control%order = explicit_order
      delayed = size(problem%lag) > 0
      longest = options%longest_step
      step = explicit_step_type(problem)
      if (delayed) then
         longest = min(longest, minval(problem%lag))
         past = history_type(problem, now, explicit_nodes)
         allocate (coefficients(0:explicit_degree, size(past%kept)))
         call past%face(problem, now, longest)
      end if
      points = [breaking_points(now, finish, problem%lag, passages(problem, past, t_start, step%y)), &
                finish]
      next_point = 1
      call step%restart(problem, past, t_start)
      if (present(sampler)) call sample_start(sampler, t_start, step%y)
      h = options%first_step
      if (.not. h > 0.0_wp) h = first_step(problem, past, step, t_start, t_end - t_start, options)
      fresh = .false.

      do
         h = min(h, longest)
         target = points(next_point)
         gap = elapsed(now, target)
         landing = 1.01_wp*h >= gap .and. gap <= longest
         h_try = merge(gap, merge(0.5_wp*gap, h, 2.0_wp*h > gap), landing)
         outcome%reason = limit_met(outcome, step, options, h_try, max(abs(t_start), abs(t_end)))
         if (outcome%reason /= reached_end) exit
         if (delayed) call past%face(problem, now, h_try)
         if (fresh) call step%restart(problem, past, now%hi)
         fresh = .false.
         call step%attempt(problem, past, now%hi, h_try, options%relative, options%absolute, &
                           error_estimate)
         if (.not. accepted(error_estimate)) then
            outcome%rejected = outcome%rejected + 1
            h = h_try
            call control%reject(h, error_estimate)
            cycle
         end if
         outcome%accepted = outcome%accepted + 1
         step_end = later(now, h_try)
         if (landing) step_end = target

         extended = delayed
         if (delayed) then
            call step%extend(problem, past)
            do i = 1, size(past%kept)
               coefficients(:, i) = step%interpolant(past%kept(i))
            end do
            call past%append(now, h_try, coefficients)
         end if
         if (present(sampler)) then
            if (elapsed(instant_at(sampler%next), step_end) >= 0.0_wp) then
               if (.not. extended) call step%extend(problem, past)
               call sample(sampler, step, now, step_end)
            end if
         end if

         gap = h
         h = h_try
         call control%accept(h, error_estimate)
         if (h_try < gap) h = max(h, gap)
         call step%advance()
         now = step_end
         if (landing) then
            if (next_point == size(points)) exit
            next_point = next_point + 1
            outcome%breaking_points = outcome%breaking_points + 1
            fresh = .true.
         end if
         if (delayed) call past%forget(later(now, -maxval(problem%lag)))
      end do

      outcome%t = now%hi
      outcome%y = step%y
      outcome%evaluations = step%evaluations
      if (outcome%reason /= reached_end) call explain(outcome, t_end, h_try, options, error)
   end subroutine integrate

   !> Refuse what cannot be integrated.
   pure subroutine check(problem, t_start, t_end, options, error)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant
      real(wp), intent(in) :: t_start
      !> Last instant
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      if (problem%n < 1) then
         call raise(error, 'integrate: n = '//text(problem%n)//' equations; at least 1 expected')
      else if (.not. (allocated(problem%lag) .and. allocated(problem%component))) then
         call raise(error, 'integrate: lag and component must be allocated (of size 0 without delays)')
      else if (size(problem%lag) /= size(problem%component)) then
         call raise(error, 'integrate: '//text(size(problem%lag))//' delays for ' &
                    //text(size(problem%component))//' delayed components; as many expected')
      else if (.not. all(problem%lag > 0.0_wp .and. ieee_is_finite(problem%lag))) then
         call raise(error, 'integrate: smallest delay = '//text(minval(problem%lag)) &
                    //'; finite and > 0 expected')
      else if (any(problem%component < 1 .or. problem%component > problem%n)) then
         call raise(error, 'integrate: a delayed component lies outside 1..'//text(problem%n))
      else if (.not. (ieee_is_finite(t_start) .and. ieee_is_finite(t_end) .and. t_end > t_start)) then
         call raise(error, 'integrate: t_end = '//text(t_end)//'; finite and > '//text(t_start) &
                    //' expected')
      else if (.not. (options%relative >= 0.0_wp .and. options%absolute > 0.0_wp)) then
         call raise(error, 'integrate: tolerances relative = '//text(options%relative) &
                    //', absolute = '//text(options%absolute)//'; >= 0 and > 0 expected')
      else if (.not. options%longest_step > 0.0_wp) then
         call raise(error, 'integrate: longest_step = '//text(options%longest_step) &
                    //'; > 0 expected')
      else if (all(options%method /= ['auto    ', 'explicit'])) then
         call raise(error, "integrate: method = '"//trim(options%method) &
                    //"'; 'auto' or 'explicit' expected")
      end if
   end subroutine check

   !> Passages through a delay after which a kink at the origin no longer shows: one more when a
   !> delayed component jumps there.
   pure integer function passages(problem, past, t_start, y) result(count)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past
      type(history_type), intent(in) :: past
      !> First instant
      real(wp), intent(in) :: t_start
      !> State there
      real(wp), intent(in) :: y(:)
      integer :: i

      count = explicit_order
      if (.not. allocated(past%kept)) return
      do i = 1, size(past%kept)
         associate (component => past%kept(i))
            if (abs(problem%history(t_start, component) - y(component)) > 0.0_wp) then
               count = explicit_order + 1
               return
            end if
         end associate
      end do
   end function passages

   !> First step length: about a hundredth of |y|/|y'|, refined by the second derivative (Hairer,
   !> Norsett and Wanner 1993, sec. II.4).
   function first_step(problem, past, step, t_start, span, options) result(h)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing the first step
      type(history_type), intent(inout) :: past
      !> The step, its first slope known
      type(explicit_step_type), intent(inout) :: step
      !> First instant
      real(wp), intent(in) :: t_start
      !> Length of the integration
      real(wp), intent(in) :: span
      !> Tolerances and limits
      type(integration_options), intent(in) :: options
      real(wp) :: h
      real(wp) :: scale(size(step%y)), slope, bend

      scale = options%absolute + options%relative*abs(step%y)
      slope = norm2(step%k(:, 1)/scale)
      h = 1.0e-6_wp
      if (slope > 1.0e-5_wp .and. norm2(step%y/scale) > 1.0e-5_wp) then
         h = 0.01_wp*norm2(step%y/scale)/slope
      end if
      h = min(h, options%longest_step, span)
      if (size(problem%lag) > 0) h = min(h, minval(problem%lag))
      step%stage = step%y + h*step%k(:, 1)
      if (size(problem%lag) > 0) call past%values(problem, h, step%z)
      call problem%rhs(t_start + h, step%stage, step%z, step%k(:, 2))
      step%evaluations = step%evaluations + 1
      bend = norm2((step%k(:, 2) - step%k(:, 1))/scale)/h
      if (max(slope, bend) > 1.0e-15_wp) then
         h = min(100.0_wp*h, (0.01_wp/max(slope, bend))**(1.0_wp/explicit_order))
      else
         h = min(100.0_wp*h, max(1.0e-6_wp, 1.0e-3_wp*h))
      end if
      if (.not. ieee_is_finite(h)) h = 1.0e-6_wp*span
   end function first_step

   !> Whether a step passed: its error finite and within the tolerance.
   pure logical function accepted(error_estimate)
      !> Error in units of the tolerance
      real(wp), intent(in) :: error_estimate

      accepted = .false.
      if (ieee_is_finite(error_estimate)) accepted = error_estimate <= 1.0_wp
   end function accepted

   !> The limit that forbids a further try, or `reached_end` when none does.
   pure integer function limit_met(outcome, step, options, h, largest_time) result(reason)
      !> Counts so far
      type(integration_result), intent(in) :: outcome
      !> The step
      type(explicit_step_type), intent(in) :: step
      !> Limits
      type(integration_options), intent(in) :: options
      !> Length of the coming try
      real(wp), intent(in) :: h
      !> Largest |t| of the integration
      real(wp), intent(in) :: largest_time

      reason = reached_end
      if (.not. all(ieee_is_finite(step%y))) then
         reason = value_not_finite
      else if (h <= 4.0_wp*epsilon(1.0_wp)**2*largest_time) then
         reason = step_underflow
         if (.not. all(ieee_is_finite(step%k))) reason = value_not_finite
      else if (outcome%accepted + outcome%rejected >= options%most_steps) then
         reason = too_many_steps
      end if
   end function limit_met

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
      type(explicit_step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: step_end
      real(wp) :: coefficients(0:explicit_degree, size(sampler%wanted))
      real(wp) :: values(size(sampler%wanted)), s
      integer :: i

      do i = 1, size(values)
         coefficients(:, i) = step%interpolant(sampler%wanted(i))
      end do
      do while (elapsed(instant_at(sampler%next), step_end) >= 0.0_wp)
         s = elapsed(start, instant_at(sampler%next))/step%h
         do i = 1, size(values)
            values(i) = newton_value(explicit_nodes, coefficients(:, i), s)
         end do
         call sampler%take(values)
      end do
   end subroutine sample

   !> Say where and why an integration ended before its time.
   pure subroutine explain(outcome, t_end, h, options, error)
      !> What was done
      type(integration_result), intent(in) :: outcome
      !> Where it should have ended
      real(wp), intent(in) :: t_end
      !> Last step tried
      real(wp), intent(in) :: h
      !> Limits
      type(integration_options), intent(in) :: options
      !> The error to set
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: why

      select case (outcome%reason)
      case (step_underflow)
         why = 'the step had to shrink to '//text(h)//', too small to move time; a singularity?'
      case (too_many_steps)
         why = text(options%most_steps)//' steps (most_steps) were used up'
      case default
         why = 'a value that is not finite was met at every step length down to '//text(h)
      end select
      call raise(error, 'integrate: stopped at t = '//text(outcome%t)//' of '//text(t_end)//' after ' &
                 //text(outcome%accepted)//' steps ('//text(outcome%rejected)//' rejected): '//why)
   end subroutine explain
end module dde_integrator
