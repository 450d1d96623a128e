! SPDX-License-Identifier: BSD-3-Clause
!> The error of a run that could not continue.
module dde_diagnosis
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_outcome, only: integration_result, interrupted, out_of_memory, slides, step_underflow, &
                          too_many_steps
   use dde_run, only: run_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: explain

contains

   !> The error of an integration that ended early: where and why.
   subroutine explain(run, outcome, error)
      !> The run at the start of the step
      type(run_type), intent(inout) :: run
      !> The result
      type(integration_result), intent(in) :: outcome
      !> The error to set
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: culprit, why
      integer(int64) :: steps

      select case (outcome%reason)
      case (interrupted)
         culprit = ""
         why = "interrupted"
      case (slides)
         call name_slide(run, why, culprit)
      case (out_of_memory)
         culprit = ""
         steps = run%context%past%newest - run%context%past%oldest + 1
         why = "no memory for another "//text(run%lacking)//" bytes"
         if (run%lacking > run%context%past%most_bytes) then
            why = "no room in most_bytes = "//text(run%context%past%most_bytes)
         end if
         if (steps > 0) why = why//" beside the "//text(steps)//" steps of the past; longer ones " &
                              //"(auto or an implicit method) or shorter delays expected"
      case (step_underflow)
         call find_below_rounding(run, culprit)
         why = "the step had to shrink to "//text(run%next%h)//", too small to change the time; "
         if (len(culprit) == 0) why = why//"a singularity?"
      case (too_many_steps)
         call find_below_rounding(run, culprit)
         why = text(run%options%most_steps)//" steps (most_steps) were used up"
         if (len(culprit) > 0) why = why//"; "
      case default
         call find_not_finite(run, why, culprit)
      end select
      call raise(error, "integrate: stopped at t = "//text(outcome%t)//" of "//text(run%t_end) &
                 //" after "//text(outcome%accepted)//" steps ("//text(outcome%rejected) &
                 //" rejected): "//why//culprit)
   end subroutine explain

   !> Along what the solution slides, or at what it jumps again and again.
   subroutine name_slide(run, why, words)
      type(run_type), intent(in) :: run
      character(len=:), allocatable, intent(out) :: why, words

      why = "f pushes the solution back from both sides of "
      associate (problem => run%context%problem, slides => run%sides%slides)
         if (slides <= problem%switches) then
            words = "the zero of "//problem%name_of("switching", slides)
            if (slides > problem%switches - problem%acting) then
               why = "events follow each other without end: "
               words = problem%name_of("switching", slides)
            end if
            return
         end if
         associate (k => size(problem%lag) - problem%moving + (slides - problem%switches + 1)/2)
            words = "the place where t - "//problem%name_of("lag", k)//" passes a jump of " &
                    //problem%name_of("y", problem%component(k))
         end associate
      end associate
   end subroutine name_slide

   !> Which component has a tolerance below the rounding error of the step planned from here.
   subroutine find_below_rounding(run, words)
      type(run_type), intent(in) :: run
      character(len=:), allocatable, intent(out) :: words
      real(wp), allocatable :: slope(:)
      real(wp) :: rounding, tolerance
      integer :: i

      words = ""
      slope = run%step%slope_here()
      do i = 1, size(slope)
         if (.not. ieee_is_finite(slope(i))) cycle
         rounding = epsilon(1.0_wp)*(abs(run%step%y(i)) + run%next%h*abs(slope(i)))
         tolerance = run%context%tolerance%of_component(i, run%step%y(i))
         if (tolerance >= rounding) cycle
         words = "the tolerance "//text(tolerance)//" of " &
                 //run%context%problem%name_of("y", i)//" = "//text(run%step%y(i)) &
                 //" is below its rounding error "//text(rounding)//"; a larger one expected"
         return
      end do
   end subroutine find_below_rounding

   !> Which value is not finite, or which delay out of its range, in the step planned from here.
   subroutine find_not_finite(run, why, words)
      type(run_type), intent(inout) :: run
      character(len=:), allocatable, intent(out) :: why, words
      real(wp), allocatable :: slope(:), y(:), z(:, :)
      integer :: i, place
      real(wp) :: t
      logical :: good

      why = "a value is not finite at every step length down to "//text(run%next%h)//": "
      y = run%step%y
      call run%context%go_to(run%now, run%next%h)
      associate (problem => run%context%problem, cursor => run%context%cursor, h => run%next%h)
         allocate (z(size(problem%lag), 2), slope(problem%n))
         call run%context%delayed_values([0.0_wp, h], z)
         do place = 1, 2
            t = run%now%hi + (place - 1)*h
            if (problem%moving > 0) then
               call find_bad_lag(run, t, y, words)
               if (len(words) > 0) then
                  why = "a delay out of its range: "
                  return
               end if
               call run%context%moving_values(t, y, z(:, place), good)
            end if
            do i = 1, size(problem%lag)
               if (ieee_is_finite(z(i, place))) cycle
               words = problem%name_of("y", problem%component(i))//" is "//text(z(i, place)) &
                       //" at t = "//text(t - problem%lag(i))
               if (cursor%before_origin(i)) words = "the history of "//words
               return
            end do
            call problem%rhs(cursor%inside(t), y, z(:, place), slope)
            do i = 1, problem%n
               if (ieee_is_finite(slope(i))) cycle
               words = problem%name_of("f", i)//" is "//text(slope(i))//" at t = "//text(t) &
                       //", where "//problem%name_of("y", i)//" = "//text(y(i))
               return
            end do
            y = y + h*slope
         end do
      end associate
      words = "f at a stage of the step"
   end subroutine find_not_finite

   !> Which delay that moves is not finite or out of its bounds.
   subroutine find_bad_lag(run, t, y, words)
      type(run_type), intent(in) :: run
      real(wp), intent(in) :: t, y(:)
      character(len=:), allocatable, intent(out) :: words
      real(wp) :: lag(run%context%problem%moving)
      integer :: j

      words = ""
      associate (problem => run%context%problem)
         call problem%moving_lags(t, y, lag)
         associate (bounds => problem%lag(size(problem%lag) - size(lag) + 1:))
            j = findloc(lag >= 0.0_wp .and. lag <= bounds, .false., dim=1)
            if (j == 0) return
            words = problem%name_of("lag", size(problem%lag) - size(lag) + j)//" is " &
                    //text(lag(j))//" at t = "//text(t)//"; 0.."//text(bounds(j))//" expected"
         end associate
      end associate
   end subroutine find_bad_lag
end module dde_diagnosis
