! SPDX-License-Identifier: BSD-3-Clause
!> How a run begins: anew, or where an earlier one ended, and the length of its first step.
module dde_start
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_kink, only: kink_type
   use dde_continuation, only: continuation_type
   use dde_cursor, only: cursor_type
   use dde_errors, only: check_finite, error_type
   use dde_history, only: history_type
   use dde_memory, only: find_lacking
   use dde_methods, only: choose_method, matching_method, methods, price_of_trial, &
                          read_by_methods
   use dde_problem, only: dde_problem_type
   use dde_request, only: causes, integration_options
   use dde_run, only: run_type
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_time, only: elapsed, instant
   use dde_tolerance, only: hopeless, scaled_norm, tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: int64, wp
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
      type(kink_type), allocatable :: kinks(:)
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
      run%context%work = work_type(equations=problem%n)
      run%reach = max(options%past_kept, maxval(problem%lag))
      if (options%keep_all) run%reach = huge(1.0_wp)
      if (continued) then
         call continue_run(run, continuation, kinks, error)
      else
         call start_anew(run, kinks, error)
      end if
      if (run%lacking > 0.0_wp .or. allocated(error)) return
      call run%context%work%set_cost(run%step%constants%evaluation_cost)
      associate (context => run%context, origin => run%context%past%origin)
         context%past%most_bytes = options%most_bytes
         context%past%is_copied = run%points%remembers
         call run%points%begin(causes(options, origin, kinks), origin, run%now, instant(t_end), &
                               problem%lag(:size(problem%lag) - problem%moving), problem%n, &
                               run%step%constants%order - 1, context%tolerance%level)
         if (problem%moving > 0) then
            call find_pieces(context%past, &
                             pack(run%points%met, run%points%is_tracked(run%points%met)))
         end if
         call run%prepare_start()
         if (.not. allocated(run%first_slope)) run%first_slope = run%step%slope
         if (continued) then
            if (.not. continuation%has_rate(run%step%slope)) call run%points%add(kink_type(run%now))
         end if
         call context%tolerance%take_in(run%step%y)
         if (options%first_step > 0.0_wp) then
            run%h = options%first_step
         else if (.not. run%h > 0.0_wp .and. t_end > t_start) then
            call choose_first_step(context, run%step, options%unit_of_time, &
                                   min(t_end - t_start, options%longest_step), run%h)
         end if
         call run%find_longest()
         if (options%method /= "auto") return
         allocate (run%switch)
         run%switch%least_price = price_of_trial(problem, context%tolerance)
         run%switch%price = run%switch%least_price
         run%switch%shortest = problem%shortest_lag()
         run%switch%series = matching_method(problem, context%tolerance, origin%hi, &
                                             implicit=.false.) == "taylor"
      end associate
   end subroutine begin_run

   !> The first run. Its initial time is a kink, or a jump if a delayed component differs from its
   !> history there.
   subroutine start_anew(run, kinks, error)
      type(run_type), intent(inout) :: run
      type(kink_type), allocatable, intent(out) :: kinks(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      run%now = instant(run%t_start)
      kinks = [kink_type(run%now)]
      associate (context => run%context, problem => run%context%problem)
         call choose_method(problem, run%options%method, context%tolerance, run%now%hi, run%step, &
                            run%lacking, error)
         if (run%lacking > 0.0_wp .or. allocated(error)) return
         call check_finite("integrate: the initial state has y", run%step%y, error)
         if (allocated(error)) return
         context%past = history_type(problem, run%now, &
                                     [(k, k=1, merge(problem%n, 0, run%options%keep_all))])
         do k = 1, size(problem%lag)
            associate (component => problem%component(k))
               if (abs(problem%history(run%now%hi, component) - run%step%y(component)) &
                   > 0.0_wp) kinks%passages = -1
            end associate
         end do
      end associate
   end subroutine start_anew

   !> Another run, with the past of the one before. If the right-hand side differs from that at the
   !> end of the earlier run, there is a kink here.
   subroutine continue_run(run, continuation, kinks, error)
      type(run_type), intent(inout) :: run
      type(continuation_type), intent(in) :: continuation
      type(kink_type), allocatable, intent(out) :: kinks(:)
      type(error_type), allocatable, intent(out) :: error
      character(len=8) :: method
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
                                     implicit=any(methods == continuation%method &
                                                  .and. read_by_methods == "jacobian"))
         end if
         call choose_method(problem, method, context%tolerance, origin%hi, run%step, run%lacking, &
                            error)
         if (run%lacking > 0.0_wp .or. allocated(error)) return
         run%step%y = continuation%y
         if (size(continuation%slope) > 0) run%first_slope = continuation%slope
         context%past = history_type(problem, origin, continuation%kept)
         call continuation%restore(context%past, kinks)
      end associate
   end subroutine continue_run

   !> The pieces of the past between kinks, which delays read that move.
   pure subroutine find_pieces(past, kinks)
      type(history_type), intent(inout) :: past
      type(kink_type), intent(in) :: kinks(:)
      integer(int64) :: step
      integer :: i

      step = past%oldest
      do i = 1, size(kinks)
         do while (step <= past%newest)
            if (elapsed(past%start_of(step), kinks(i)%at) <= 0.0_wp) exit
            step = step + 1
         end do
         call past%pieces%add(kinks(i), step, .true., 0.0_wp)
      end do
   end subroutine find_pieces

   !> First step length: about a hundredth of |y|/|y'|, refined by the second derivative (Hairer,
   !> Norsett and Wanner 1993, sec. II.4).
   pure subroutine choose_first_step(context, step, unit, longest, h)
      type(step_context), intent(inout) :: context
      !> The step, its first slope known
      class(step_type), intent(inout) :: step
      !> Unit of time; time to the end of the run, or the longest step allowed, the shorter
      real(wp), intent(in) :: unit, longest
      real(wp), intent(out) :: h
      real(wp), allocatable :: slope_ahead(:)
      real(wp) :: bend, slope

      allocate (slope_ahead, mold=step%slope)
      call context%tolerance%scale(step%y, step%scale)
      h = 1.0e-6_wp*longest
      slope = unit*length_of(step%slope, step%scale)
      if (slope > hopeless) return
      h = 1.0e-6_wp*unit
      if (slope > 1.0e-5_wp .and. length_of(step%y, step%scale) > 1.0e-5_wp) then
         h = 0.01_wp*length_of(step%y, step%scale)/slope*unit
      end if
      h = min(h, longest, context%problem%shortest_lag())
      call context%delayed_values([h], step%z)
      step%y_new = step%y + h*step%slope
      call context%evaluate(context%cursor%t + h, step%y_new, step%z, slope_ahead)
      slope_ahead = slope_ahead - step%slope
      bend = unit*length_of(slope_ahead, step%scale)
      if (bend > hopeless) return
      bend = bend/(h/unit)
      if (max(slope, bend) > 1.0e-15_wp) then
         h = min(100.0_wp*h, &
                 unit*(0.01_wp/max(slope, bend))**(1.0_wp/step%constants%error_order))
      else
         h = min(100.0_wp*h, max(1.0e-6_wp*unit, 1.0e-3_wp*h))
      end if
   end subroutine choose_first_step

   !> The norm of x; huge if x is not finite.
   pure function length_of(x, scale) result(length)
      real(wp), intent(in) :: x(:), scale(:)
      real(wp) :: length

      length = scaled_norm(size(x), x, scale)
      if (.not. ieee_is_finite(length)) length = huge(1.0_wp)
   end function length_of
end module dde_start
