! SPDX-License-Identifier: BSD-3-Clause
!> How a run begins: anew, or where an earlier one ended.
module dde_start
   use dde_breaking_points, only: kink_type
   use dde_continuation, only: continuation_type
   use dde_cursor, only: cursor_type
   use dde_errors, only: check_finite, error_type
   use dde_first_step, only: choose_first_step
   use dde_history, only: history_type
   use dde_memory, only: find_lacking
   use dde_methods, only: choose_method, is_implicit, matching_method, price_of_trial
   use dde_problem, only: dde_problem_type
   use dde_request, only: causes, integration_options
   use dde_run, only: run_type
   use dde_switch, only: switch_type
   use dde_time, only: instant
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: begin_run

contains

   !> Begin, or continue an earlier run, unless memory is lacking.
   subroutine begin_run(run, problem, t_start, t_end, options, error, continuation)
      type(run_type), intent(inout), target :: run
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

      run%t_start = t_start
      run%t_end = t_end
      run%options = options
      continued = .false.
      if (present(continuation)) continued = allocated(continuation%y)
      ! the state with its tolerances, and at most so many for each number and step that is restored
      reals = 16.0_wp*problem%n
      if (continued) reals = reals + 2.0_wp*size(continuation%coefficients) &
                             + 120.0_wp*size(continuation%step_length)
      run%lacking = find_lacking(reals)
      if (run%lacking > 0.0_wp) return
      run%context%problem => problem
      if (problem%switches > 0) then
         allocate (run%sided, source=problem)
         run%context%problem => run%sided
      end if
      run%points%remembers = present(continuation)
      run%context%tolerance = tolerance_type(problem%n, options%relative, options%absolute, &
                                             options%each_relative, options%each_absolute)
      run%context%tolerance%share_of_largest = options%share_of_largest
      run%context%cursor = cursor_type(problem)
      run%context%work = work_type(problem%n)
      run%reach = max(options%past_kept, maxval(problem%lag))
      if (options%keep_all) run%reach = huge(1.0_wp)
      if (continued) then
         call continue_run(run, continuation, error)
      else
         call start_anew(run, error)
      end if
      if (run%lacking > 0.0_wp .or. allocated(error)) return
      run%context%past%most_bytes = options%most_bytes
      run%context%past%is_copied = run%points%remembers
      call run%context%tolerance%take_in(run%step%y)
      if (options%first_step > 0.0_wp) then
         run%h = options%first_step
      else if (.not. run%h > 0.0_wp .and. t_end > t_start) then
         call choose_first_step(run%context, run%step, options%unit_of_time, &
                                min(t_end - t_start, options%longest_step), run%h)
      end if
      call run%find_longest()
      if (options%method /= "auto") return
      associate (tolerance => run%context%tolerance, origin => run%context%past%origin%hi)
         run%switch = switch_type(price_of_trial(problem, tolerance), &
                                  matching_method(problem, tolerance, origin, .false.) &
                                  == "taylor", minval(problem%lag))
      end associate
   end subroutine begin_run

   !> The first run. Its initial time is a kink, or a jump if a delayed component differs from its
   !> history there.
   subroutine start_anew(run, error)
      type(run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      type(kink_type) :: first
      integer :: k

      run%now = instant(run%t_start)
      call take_method(run, run%options%method, run%now, error)
      if (run%lacking > 0.0_wp .or. allocated(error)) return
      call check_finite("integrate: the initial state has y", run%step%y, error)
      if (allocated(error)) return
      first = kink_type(run%now)
      associate (context => run%context, problem => run%context%problem)
         context%past = history_type(problem, run%now, &
                                     [(k, k=1, merge(problem%n, 0, run%options%keep_all))])
         do k = 1, size(problem%lag)
            associate (component => problem%component(k))
               if (abs(problem%history(run%now%hi, component) - run%step%y(component)) &
                   > 0.0_wp) then
                  first%passages = -1
               end if
            end associate
         end do
      end associate
      call begin_points(run, [first])
      run%first_slope = run%step%slope
   end subroutine start_anew

   !> Another run, with the past of the one before. If the right-hand side differs from that at the
   !> end of the earlier run, there is a kink here.
   subroutine continue_run(run, continuation, error)
      type(run_type), intent(inout) :: run
      type(continuation_type), intent(in) :: continuation
      type(error_type), allocatable, intent(out) :: error
      character(len=8) :: method
      type(kink_type), allocatable :: kinks(:)
      real(wp) :: largest(size(continuation%y))

      largest = 0.0_wp
      largest(continuation%kept) = max(0.0_wp, maxval(abs(continuation%coefficients(1, :, :)), 2))
      run%now = instant(continuation%time(1), continuation%time(2))
      run%h = continuation%next_step
      method = run%options%method
      associate (context => run%context, problem => run%context%problem, &
                 origin => instant(continuation%origin(1), continuation%origin(2)))
         call context%tolerance%take_in(largest)
         if (method == "auto") then
            method = matching_method(problem, context%tolerance, origin%hi, &
                                     is_implicit(continuation%method))
         end if
         call take_method(run, method, origin, error)
         if (run%lacking > 0.0_wp .or. allocated(error)) return
         run%step%y = continuation%y
         run%first_slope = continuation%slope
         context%past = history_type(problem, origin, continuation%kept)
         call continuation%restore(context%past, kinks)
      end associate
      call begin_points(run, kinks)
      if (size(run%first_slope) == 0) run%first_slope = run%step%slope
      if (.not. continuation%has_rate(run%step%slope)) then
         call run%points%add(kink_type(run%now))
      end if
   end subroutine continue_run

   !> Take a method, unless memory is lacking.
   subroutine take_method(run, method, origin, error)
      type(run_type), intent(inout) :: run
      character(len=8), intent(in) :: method
      !> Initial time of the first run
      type(instant), intent(in) :: origin
      type(error_type), allocatable, intent(out) :: error

      call choose_method(run%context%problem, method, run%context%tolerance, origin%hi, &
                         run%step, run%lacking, error)
      if (run%lacking > 0.0_wp .or. allocated(error)) return
      call run%context%work%set_cost(run%step%constants%evaluation_cost)
   end subroutine take_method

   !> Begin with the breaking points that these kinks cause, and the slope at the start.
   subroutine begin_points(run, kinks)
      type(run_type), intent(inout) :: run
      type(kink_type), intent(in) :: kinks(:)

      associate (problem => run%context%problem, origin => run%context%past%origin)
         call run%points%begin(causes(run%options, origin, kinks), origin, run%now, &
                               instant(run%t_end), problem%lag, problem%n, &
                               run%step%constants%order - 1, run%context%tolerance%level)
      end associate
      call run%prepare_start()
   end subroutine begin_points
end module dde_start
