! SPDX-License-Identifier: BSD-3-Clause
!> Delays that depend on time or state: exact solutions over their kinks, delays that vanish or are
!> shorter than a step, stiff problems, and what is refused.
module test_dde_moving
   use dde, only: continuation_type, event_table, integrate, integration_options, &
                  integration_result, slides, table_sampler, value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use moving_problems, only: in_disguise, moving_problem, named
   use solving, only: at_tolerance, run
   use test_problems, only: linear, wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_moving

   !> Methods that take them.
   character(len=8), parameter :: methods(6) = [character(len=8) :: "auto", "bs5", "dop853", &
                                                "radau5", "radau9", "radau13"]

contains

   subroutine collect_dde_moving(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exact solutions", test_exact), &
                   new_unittest("all along the solution", test_samples), &
                   new_unittest("constant delays in disguise", test_disguise), &
                   new_unittest("more kinks than pay", test_many_kinks), &
                   new_unittest("stiff, delays shorter than steps", test_stiff), &
                   new_unittest("a bounded past", test_bound), &
                   new_unittest("a delay that jumps", test_jumps), &
                   new_unittest("continued at an event", test_continuation), &
                   new_unittest("a solution that cannot go on", test_slide), &
                   new_unittest("delays out of range", test_refusals)]
   end subroutine collect_dde_moving

   !> Errors at the end are in proportion to the tolerance, and kinks are found: those of y(y(t)),
   !> for instance, where y is 2 and where it is 4. Steps pass over smooth ones that are near to
   !> others.
   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=22), parameter :: names(7) = [character(len=22) :: "Neves", &
                                                  "Enright and Hayashi D1", "Feldstein and Neves", &
                                                  "Paul 1992", "Paul 1.3.10", "pantograph", &
                                                  "pantograph from 1"]
      integer, parameter :: kinks(7) = [1, 1, 1, 1, 2, 0, 1]
      real(wp), allocatable :: known(:)
      type(integration_result) :: outcome
      type(moving_problem) :: problem
      integer :: digits, i, k

      do i = 1, size(names)
         problem = named(names(i))
         known = problem%first
         call problem%exact(problem%p, problem%t_end, known)
         do k = 1, size(methods)
            do digits = 4, 10, 3
               associate (tolerance => 10.0_wp**(-digits), &
                          what => trim(names(i))//", "//trim(methods(k)))
                  call run(error, problem, problem%t_start, problem%t_end, &
                           at_tolerance(tolerance, methods(k)), outcome)
                  call expect_close(error, outcome%y, known, &
                                    10.0_wp*tolerance*(1.0_wp + maxval(abs(known))), what)
                  call expect(error, outcome%breaking_points >= kinks(i), what//" meets the kinks")
               end associate
            end do
         end do
      end do
   end subroutine test_exact

   !> Dense output, over the kinks.
   subroutine test_samples(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(moving_problem) :: problem
      type(table_sampler) :: table
      real(wp) :: known(1), times(200)
      integer :: i, k

      problem = named("Paul 1.3.10")
      times = [(2.0_wp + 3.5_wp*i/size(times), i=1, size(times))]
      do k = 1, size(methods)
         table = table_sampler([1], times)
         call run(error, problem, 2.0_wp, 5.5_wp, at_tolerance(1.0e-8_wp, methods(k)), outcome, &
                  table)
         do i = 1, size(times)
            call problem%exact(problem%p, times(i), known)
            call expect_close(error, table%values(:, i), known, 4.0e-7_wp, &
                              trim(methods(k))//" at t = "//text(times(i)))
         end do
      end do
   end subroutine test_samples

   !> Two constant delays, one or both of them as delays that move: the same solution and kinks.
   subroutine test_disguise(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome, plain
      integer :: first, k

      do k = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(k))
         call run(error, wille_baker(), 0.0_wp, 5.0_wp, at_tolerance(1.0e-12_wp), plain)
         do first = 1, 2
            call run(error, in_disguise(wille_baker(), first), 0.0_wp, 5.0_wp, options, outcome)
            call expect_close(error, outcome%y, plain%y, 1.0e-8_wp*maxval(abs(plain%y)), methods(k))
            call expect(error, outcome%breaking_points >= 4, methods(k)//" meets kinks")
         end do
      end do
   end subroutine test_disguise

   !> Kinks of three delays are many: the run does not end a step at each, says so, and keeps the
   !> error.
   subroutine test_many_kinks(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: fine, outcome
      type(moving_problem) :: problem
      integer :: k

      problem = named("two thresholds")
      call run(error, problem, 0.0_wp, problem%t_end, at_tolerance(1.0e-11_wp, "radau13"), fine)
      do k = 1, size(methods)
         call run(error, problem, 0.0_wp, problem%t_end, at_tolerance(1.0e-6_wp, methods(k)), &
                  outcome)
         call expect_close(error, outcome%y, fine%y, 2.0e-4_wp, methods(k))
         call expect(error, outcome%untracked > 0, methods(k)//" says so")
         call expect(error, outcome%accepted < 200, methods(k)//" takes few steps")
      end do
   end subroutine test_many_kinks

   !> Rates of 1e6 and 1e5, a delay of 0.01 to 0.02: steps of Radau are longer than that, also with
   !> the coupling through the delay, and the number of iterations is usual.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(moving_problem) :: problem
      integer :: k

      problem = named("stiff sine")
      do k = 1, size(methods)
         if (any(methods(k) == [character(len=8) :: "bs5", "dop853"])) cycle
         call run(error, problem, 0.0_wp, problem%t_end, at_tolerance(1.0e-6_wp, methods(k)), &
                  outcome)
         call expect_close(error, outcome%y, [sin(problem%t_end)], 1.0e-5_wp, methods(k))
         call expect(error, outcome%accepted < 400, methods(k)//" takes " &
                     //text(int(outcome%accepted))//" steps")
      end do
   end subroutine test_stiff

   !> With a bound the past is dropped, as little memory shows; one that is too small is refused.
   subroutine test_bound(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(moving_problem) :: problem

      options = at_tolerance(1.0e-9_wp, "bs5")
      options%most_bytes = 4.0e4_wp
      problem = in_disguise(linear(), 1)
      call run(error, problem, 0.0_wp, 100.0_wp, options, outcome)
      problem%lag = huge(1.0_wp)
      call integrate(problem, 0.0_wp, 100.0_wp, options, outcome, failure)
      call expect_failure(error, failure, "no room in most_bytes")
      problem%lag = 0.75_wp
      call integrate(problem, 0.0_wp, 100.0_wp, options, outcome, failure)
      call expect_failure(error, failure, "lag(1) is 1.0 at t = 0.0; 0..0.75 expected")
   end subroutine test_bound

   !> y' = y(n), n the last whole number: error control passes where the delay jumps, and steps end
   !> there if the jumps are given.
   subroutine test_jumps(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(moving_problem) :: problem
      integer :: k

      problem = named("whole numbers")
      do k = 1, size(methods)
         options = at_tolerance(1.0e-6_wp, methods(k))
         call run(error, problem, 0.0_wp, problem%t_end, options, outcome)
         call expect_close(error, outcome%y, [12.0_wp], 1.0e-3_wp, methods(k))
         options%break_at = [1.0_wp, 2.0_wp, 3.0_wp]
         call run(error, problem, 0.0_wp, problem%t_end, options, outcome)
         call expect_close(error, outcome%y, [12.0_wp], 1.0e-11_wp, methods(k)//", given")
      end do
   end subroutine test_jumps

   !> A run that ended at an event goes on with the pieces of its past.
   subroutine test_continuation(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(event_table) :: events
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp) :: known(1)
      type(moving_problem) :: problem
      integer :: k

      problem = named("Paul 1.3.10")
      call problem%exact(problem%p, problem%t_end, known)
      do k = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(k))
         events = event_table([1], [1.5_wp], [1], [.true.])
         state = continuation_type()
         call run(error, problem, 2.0_wp, 5.5_wp, options, outcome, watcher=events, &
                  continuation=state)
         call expect_close(error, outcome%t, 3.0_wp, 1.0e-8_wp, methods(k)//": the event")
         call run(error, problem, state%time(1), 5.5_wp, options, outcome, continuation=state)
         call expect_close(error, outcome%y, known, 1.0e-7_wp, methods(k)//" continued")
      end do
   end subroutine test_continuation

   !> y' = 5 - y(t - 2 - y**2) with a history that falls from 4.5 to -0.5 at -1: t - lag comes back
   !> to -1 from above at t = 1 + 4/121, and from below it would rise again.
   subroutine test_slide(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(moving_problem) :: problem
      integer :: k

      problem = named("reader")
      do k = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(k))
         options%break_at = [-1.0_wp]
         call integrate(problem, 0.0_wp, problem%t_end, options, outcome, failure)
         call expect_failure(error, failure, &
                             "both sides of the place where t - lag(1) passes a jump of y(1)")
         call expect(error, outcome%reason == slides, "the reason is `slides`")
         call expect_close(error, outcome%t, 1.0_wp + 4.0_wp/121.0_wp, 1.0e-7_wp, methods(k))
      end do
   end subroutine test_slide

   !> A delay that becomes negative, bounds and numbers out of range, and methods that need constant
   !> delays.
   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(moving_problem) :: problem
      integer :: k

      problem = named("below zero")
      do k = 1, size(methods)
         call integrate(problem, 0.0_wp, 2.0_wp, at_tolerance(1.0e-6_wp, methods(k)), outcome, &
                        failure)
         call expect_failure(error, failure, "a delay out of its range: lag(1) is -")
         call expect(error, outcome%reason == value_not_finite, "the reason is `value_not_finite`")
         call expect_close(error, outcome%t, 1.0_wp, 1.0e-12_wp, methods(k)//" comes as far as 1")
      end do
      call integrate(problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp, "taylor"), outcome, failure)
      call expect_failure(error, failure, "gives no Taylor series")
      problem%analytic = .true.
      call integrate(problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp, "taylor"), outcome, failure)
      call expect_failure(error, failure, &
                          "'taylor' for a problem with delays that move (moving = 1)")
      do k = -1, 2, 3
         problem%moving = k
         call integrate(problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp), outcome, failure)
         call expect_failure(error, failure, "moving = "//text(k)//" of 1 delays; 0..1 expected")
      end do
   end subroutine test_refusals
end module test_dde_moving
