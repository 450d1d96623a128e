! SPDX-License-Identifier: BSD-3-Clause
!> The options of an integration, and the refusal of wrong arguments.
module dde_request
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use dde_kink, only: kink_type
   use dde_continuation, only: continuation_type
   use dde_events, only: event_watcher_type
   use dde_problem, only: dde_problem_type
   use dde_sampler, only: sampler_type
   use dde_time, only: elapsed, instant, too_short
   use dde_errors, only: check_finite, error_type, raise, text
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: causes, check, integration_options

   !> Longest run: times must not overflow.
   real(wp), parameter :: longest_run = 1.0e307_wp

   !> Options.
   type :: integration_options
      !> One of `methods` (`dde_methods`)
      character(len=8) :: method = "auto"
      !> Relative tolerance of one step
      real(wp) :: relative = 1.0e-9_wp
      !> Absolute tolerance of one step
      real(wp) :: absolute = 1.0e-9_wp
      !> Tolerances of each component in place of those two, shape (n)
      real(wp), allocatable :: each_relative(:), each_absolute(:)
      !> Least absolute tolerance of a component over its largest value in the run so far
      real(wp) :: share_of_largest = 0.0_wp
      !> Length of the first step; chosen by the solver when 0
      real(wp) :: first_step = 0.0_wp
      !> A time on which the solution changes, > 0, from which the choice of the first step begins
      real(wp) :: unit_of_time = 1.0_wp
      !> Longest step
      real(wp) :: longest_step = huge(1.0_wp)
      !> Most steps, accepted and rejected
      integer(int64) :: most_steps = 100000000_int64
      !> Most bytes of the past; a stiff run that stays explicit fills any memory
      real(wp) :: most_bytes = 2.0e9_wp
      !> Time that a continuation reaches back, if longer than the longest delay: so that the next
      !> run may have a longer one
      real(wp) :: past_kept = 0.0_wp
      !> Times at which the right-hand side jumps (before the initial time: the history), in any
      !> order. Steps end there.
      real(wp), allocatable :: break_at(:)
      !> Whether a continuation keeps all components over the whole run: it then is dense output
      logical :: keep_all = .false.
   end type integration_options

contains

   !> Kinks, and the jumps that the user gave. Before the initial time the history jumps, after it
   !> the right-hand side.
   pure function causes(options, origin, others) result(kinks)
      !> Where they are
      type(integration_options), intent(in) :: options
      !> Initial time of the first run
      type(instant), intent(in) :: origin
      !> Kinks of other causes
      type(kink_type), intent(in) :: others(:)
      type(kink_type), allocatable :: kinks(:)

      kinks = others
      if (.not. allocated(options%break_at)) return
      kinks = [others, spread(kink_type(at=instant(0.0_wp)), 1, size(options%break_at))]
      associate (given => size(others) + 1)
         kinks(given:)%at%hi = options%break_at
         kinks(given:)%passages = merge(-1, 0, options%break_at < origin%hi)
      end associate
   end function causes

   !> Refuse what cannot be integrated.
   pure subroutine check(problem, t_start, t_end, options, error, sampler, watcher, continuation)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Initial time
      real(wp), intent(in) :: t_start
      !> Final time
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of samples
      class(sampler_type), intent(in), optional :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(in), optional :: watcher
      !> Where an earlier run ended
      type(continuation_type), intent(in), optional :: continuation
      logical :: goes_on

      call check_span(t_start, t_end, error, continuation)
      if (.not. allocated(error)) then
         call check_problem(problem, too_short(t_start, t_start, t_end), error)
      end if
      if (.not. allocated(error)) call check_options(problem, options, error)
      goes_on = .false.
      if (present(continuation)) goes_on = allocated(continuation%y)
      if (present(sampler) .and. .not. allocated(error)) then
         call sampler%check(problem%n, t_start, goes_on, error)
      end if
      if (present(watcher) .and. .not. allocated(error)) call watcher%check(problem%n, error)
      if (present(continuation) .and. .not. allocated(error)) then
         call continuation%check(problem, t_start, error)
      end if
   end subroutine check

   !> Refuse a problem that is not one, and delays that no step resolves.
   pure subroutine check_problem(problem, shortest, error)
      class(dde_problem_type), intent(in) :: problem
      !> Length up to which a step is too short
      real(wp), intent(in) :: shortest
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      if (problem%n < 1) then
         call raise(error, "integrate: n = "//text(problem%n)//" equations; at least 1 expected")
      else if (allocated(problem%lag) .neqv. allocated(problem%component)) then
         call raise(error, "integrate: "//trim(merge("component", "lag      ", &
                                                     allocated(problem%lag)))//" is not allocated" &
                    //"; lag and component expected, or none of them (no delays)")
      end if
      if (allocated(error) .or. .not. allocated(problem%lag)) return
      if (size(problem%lag) /= size(problem%component)) then
         call raise(error, "integrate: "//text(size(problem%lag))//" delays for " &
                    //text(size(problem%component))//" delayed components; " &
                    //text(size(problem%component))//" expected")
      else if (problem%lower < 0 .neqv. problem%upper < 0) then
         call raise(error, "integrate: lower = "//text(problem%lower)//", upper = " &
                    //text(problem%upper)//"; both >= 0 expected (a banded Jacobian), or neither")
      else if (problem%lower >= 0 .and. size(problem%lag) > 0 &
               .and. .not. allocated(problem%rows)) then
         call raise(error, "integrate: lower = "//text(problem%lower)//" (a banded Jacobian) and " &
                    //"no rows; rows of each delayed value expected")
      end if
      if (allocated(error)) return
      if (problem%moving < 0 .or. problem%moving > size(problem%lag)) then
         call raise(error, "integrate: moving = "//text(problem%moving)//" of " &
                    //text(size(problem%lag))//" delays; 0.."//text(size(problem%lag))//" expected")
         return
      end if
      do k = 1, size(problem%lag)
         if (.not. positive(problem%lag(k))) then
            call raise(error, "integrate: lag("//text(k)//") = "//text(problem%lag(k)) &
                       //"; finite and > 0 expected")
         else if (problem%lag(k) <= shortest) then
            call raise(error, "integrate: lag("//text(k)//") = "//text(problem%lag(k)) &
                       //" is no longer than the shortest step, "//text(shortest) &
                       //"; a longer one expected")
         else if (problem%component(k) < 1 .or. problem%component(k) > problem%n) then
            call raise(error, "integrate: component("//text(k)//") = " &
                       //text(problem%component(k))//"; 1.."//text(problem%n)//" expected")
         end if
         if (allocated(error)) return
      end do
      if (allocated(problem%rows)) call check_rows(problem, error)
   end subroutine check_problem

   !> Refuse rows of delayed values that are not some of the equations.
   pure subroutine check_rows(problem, error)
      class(dde_problem_type), intent(in) :: problem
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      associate (rows => problem%rows, delays => size(problem%lag))
         if (any(shape(rows) /= [2, delays])) then
            call raise(error, "integrate: rows has the shape ("//text(size(rows, 1))//", " &
                       //text(size(rows, 2))//"); (2, "//text(delays)//") expected")
            return
         end if
         do k = 1, delays
            if (rows(1, k) >= 1 .and. rows(1, k) <= rows(2, k) .and. rows(2, k) <= problem%n) cycle
            call raise(error, "integrate: rows(:, "//text(k)//") = "//text(rows(1, k))//", " &
                       //text(rows(2, k))//"; ascending in 1.."//text(problem%n)//" expected")
            return
         end do
      end associate
   end subroutine check_rows

   !> Refuse a span that is not finite, not ascending or too long. A continued run starts exactly
   !> where the earlier one ended.
   pure subroutine check_span(t_start, t_end, error, continuation)
      real(wp), intent(in) :: t_start, t_end
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type), intent(in), optional :: continuation
      type(instant) :: start

      if (all(ieee_is_finite([t_start, t_end]))) then
         start = instant(t_start)
         if (present(continuation)) then
            if (allocated(continuation%y)) start%lo = continuation%time(2)
         end if
         ! half of each: the difference may overflow
         if (0.5_wp*t_end - 0.5_wp*t_start <= 0.5_wp*longest_run) then
            if (elapsed(start, instant(t_end)) >= 0.0_wp) return
         end if
      end if
      call raise(error, "integrate: t_end = "//text(t_end)//"; finite, >= "//text(t_start) &
                 //" and at most "//text(longest_run)//" later expected")
   end subroutine check_span

   !> Refuse tolerances and limits out of range.
   pure subroutine check_options(problem, options, error)
      class(dde_problem_type), intent(in) :: problem
      type(integration_options), intent(in) :: options
      type(error_type), allocatable, intent(out) :: error

      if (.not. (not_negative(options%relative) .and. positive(options%absolute))) then
         call raise(error, "integrate: tolerances relative = "//text(options%relative) &
                    //", absolute = "//text(options%absolute) &
                    //"; finite, >= 0 and > 0 expected")
      end if
      call check_list(problem%n, "each_relative", ">= 0", error, options%each_relative)
      call check_list(problem%n, "each_absolute", "> 0", error, options%each_absolute)
      if (allocated(error)) return
      if (.not. not_negative(options%first_step)) then
         call raise(error, "integrate: first_step = "//text(options%first_step) &
                    //"; finite and >= 0 expected (0: chosen by the solver)")
      else if (.not. above_zero(options%longest_step)) then
         call raise(error, "integrate: longest_step = "//text(options%longest_step) &
                    //"; > 0 expected")
      else if (.not. above_zero(options%most_bytes)) then
         call raise(error, "integrate: most_bytes = "//text(options%most_bytes)//"; > 0 expected")
      else if (.not. not_negative(options%past_kept)) then
         call raise(error, "integrate: past_kept = "//text(options%past_kept) &
                    //"; finite and >= 0 expected")
      else if (allocated(options%break_at)) then
         call check_finite("integrate: break_at", options%break_at, error)
      end if
   end subroutine check_options

   !> Refuse a list of tolerances of wrong size or out of range, if there is one.
   pure subroutine check_list(n, name, range, error, values)
      integer, intent(in) :: n
      character(len=*), intent(in) :: name, range
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in), optional :: values(:)
      integer :: i

      if (allocated(error) .or. .not. present(values)) return
      if (size(values) /= n) then
         call raise(error, "integrate: "//text(size(values))//" tolerances "//name//" for " &
                    //text(n)//" equations; "//text(n)//" expected")
         return
      end if
      do i = 1, n
         if (positive(values(i)) .or. range == ">= 0" .and. not_negative(values(i))) cycle
         call raise(error, "integrate: "//name//"("//text(i)//") = "//text(values(i)) &
                    //"; finite and "//range//" expected")
         return
      end do
   end subroutine check_list

   !> Whether a number is finite and > 0.
   elemental logical function positive(x) result(value)
      real(wp), intent(in) :: x

      value = above_zero(x) .and. ieee_is_finite(x)
   end function positive

   !> Whether a number is > 0, infinite or not.
   elemental logical function above_zero(x) result(value)
      real(wp), intent(in) :: x

      value = .false.
      if (.not. ieee_is_nan(x)) value = x > 0.0_wp
   end function above_zero

   !> Whether a number is finite and >= 0.
   elemental logical function not_negative(x) result(value)
      real(wp), intent(in) :: x

      value = .false.
      if (ieee_is_finite(x)) value = x >= 0.0_wp
   end function not_negative
end module dde_request
