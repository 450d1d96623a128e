! SPDX-License-Identifier: BSD-3-Clause
!> The past as it is kept and as series, and runs that need more memory than there is, which end
!> with an error. What runs read of it is in the laws of accuracy and invariance.
module test_dde_history
   use, intrinsic :: iso_c_binding, only: c_int, c_long
   use dde, only: integrate, integration_options, integration_result, methods, out_of_memory
   use dde_delayed_series, only: delayed_series
   use dde_history, only: history_type
   use dde_step_context, only: step_context
   use dde_time, only: instant
   use dde_tolerance, only: tolerance_type
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_failure
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use single_step, only: new_context
   use solving, only: at_tolerance, run
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_dde_history

   !> Memory that this process may take, in bytes.
   integer(c_long), parameter :: limit = 64*1024*1024_c_long
   !> Memory that counts as growth, in kibibytes.
   integer(c_long), parameter :: growth = 4096_c_long

   !> A step in powers of its length.
   type :: past_step
      real(wp) :: start, length, a(0:2), valid_for
      !> What is lost of its start
      real(wp) :: rest = 0.0_wp
   end type past_step

   interface
      integer(c_long) function peak_memory() result(kibibytes) bind(c)
         import :: c_long
         implicit none (type, external)
      end function peak_memory

      !> Let this process take this number of bytes more, or without limit if they are negative.
      integer(c_int) function limit_memory(more) result(done) bind(c)
         import :: c_int, c_long
         implicit none (type, external)
         !> Bytes
         integer(c_long), value :: more
      end function limit_memory
   end interface

contains

   subroutine collect_dde_history(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("what is given back", test_recall), &
                   new_unittest("series of the past", test_series), &
                   new_unittest("memory of an integration", test_memory_of_integration), &
                   new_unittest("no memory for steps", test_steps), &
                   new_unittest("no memory for the past", test_past), &
                   new_unittest("the memory of each degree", test_degree)]
   end subroutine collect_dde_history

   !> A step of low degree after one of high degree comes back with zeros above.
   subroutine test_recall(error)
      type(error_type), allocatable, intent(out) :: error
      type(history_type) :: past
      type(instant) :: start
      real(wp) :: coefficient(0:12, 1), length, nodes(12), valid_for

      past = history_type(linear(), instant(0.0_wp))
      nodes = 0.0_wp
      coefficient = 7.0_wp
      call past%append(instant(0.0_wp), 1.0_wp, nodes, coefficient, valid_for=1.0_wp)
      call past%append(instant(1.0_wp), 1.0_wp, [1.0_wp], reshape([3.0_wp, 4.0_wp], [2, 1]), &
                       valid_for=1.5_wp)
      call past%recall(past%newest, start, length, valid_for, nodes, coefficient)
      call expect_close(error, [start%hi, length, valid_for], [1.0_wp, 1.0_wp, 1.5_wp], 0.0_wp, &
                        "start, length and validity")
      call expect_close(error, coefficient(:, 1), [3.0_wp, 4.0_wp, spread(0.0_wp, 1, 11)], 0.0_wp, &
                        "coefficients")
      call expect(error, past%degree_in_use() == 12, "the step before is kept, too")
   end subroutine test_recall

   !> The past as series: 1 + t from 0 to 1, and 0.001 more from there on. If the next step begins
   !> nearer, its series is read, unless there is a kink between them; its departure from the past
   !> before it begins must not exceed the tolerance. A series is used beyond its step as far as it
   !> agrees with what followed. Ten steps of 1e-5 that are 0.1 above what follows are skipped if a
   !> step of 0.5 is expected, not if one of 1e-3 is. At t = 1 the next step begins in 1e-17: the
   !> step before is valid until then, although its length less the time passed is 0.
   subroutine test_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(past_step), allocatable :: kink(:), layer(:), rest(:), two(:)
      integer :: i

      two = [past_step(0.0_wp, 1.0_wp, [1.0_wp, 1.0_wp, 0.0_wp], 1.5_wp), &
             past_step(1.0_wp, 1.0_wp, [2.001_wp, 1.0_wp, 0.0_wp], 2.0_wp), &
             past_step(2.0_wp, 1.0_wp, [3.001_wp, 1.0_wp, 0.0_wp], 2.0_wp)]
      kink = two
      kink(1)%valid_for = 1.0_wp
      layer = [(past_step(i*1.0e-5_wp, 1.0e-5_wp, [1.1_wp, 0.0_wp, 0.0_wp], 1.0e-4_wp), i=0, 9), &
               (past_step(1.0e-4_wp + i, 1.0_wp, [1.0_wp, 0.0_wp, 0.0_wp], 1.0_wp), i=0, 1)]
      rest = [past_step(0.0_wp, 1.0_wp, [1.0_wp, 1.0_wp, 0.0_wp], 1.0_wp), &
              past_step(1.0_wp, 1.0e-15_wp, [2.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, rest=1.0e-17_wp)]
      call expect_series(two, 0.75_wp, 0.5_wp, .true., [1.751_wp, 0.5_wp], &
                         [1.0e-2_wp, 1.0e-4_wp], [0.5_wp, 0.0_wp])
      call expect_series(two, 0.75_wp, 0.5_wp, .false., [1.75_wp, 0.5_wp])
      call expect_series(two, 0.25_wp, 1.0_wp, .true., [1.25_wp, 1.0_wp], &
                         [1.0e-2_wp, 1.0e-4_wp], [1.0_wp, 0.75_wp])
      call expect_series(kink, 0.75_wp, 0.25_wp, .true., [1.75_wp, 0.25_wp])
      call expect_series(layer, 0.0_wp, 0.5_wp, .true., [1.0_wp, 0.0_wp], &
                         [1.0e-3_wp, 1.0e-5_wp], [0.5_wp, 0.0_wp])
      call expect_series(layer, 0.0_wp, 1.0e-3_wp, .true., [1.1_wp, 0.0_wp])
      call expect_series(rest, 1.0_wp, 0.5_wp, .false., [2.0_wp, 1.0e-17_wp], valid_for=1.0e-17_wp)

   contains

      !> The first coefficients at a time, and the length of the step for which they agree with the
      !> past at tolerances.
      subroutine expect_series(steps, t, unit, skipping, known, tolerances, lengths, valid_for)
         type(past_step), intent(in) :: steps(:)
         real(wp), intent(in) :: t, unit, known(2)
         logical, intent(in) :: skipping
         real(wp), intent(in), optional :: tolerances(:), lengths(:), valid_for
         type(delayed_series) :: series
         type(step_context) :: context
         type(linear), target :: problem
         real(wp) :: found_unit, h
         integer :: k

         problem = linear(lag=[2.0_wp])
         context = new_context(problem, 0.0_wp, 0.1_wp, 0.0_wp, 1.0_wp)
         do k = 1, size(steps)
            call context%past%append(instant(steps(k)%start, steps(k)%rest), steps(k)%length, &
                                     [0.0_wp, 0.0_wp], reshape(steps(k)%a, [3, 1]), &
                                     steps(k)%valid_for)
         end do
         series = delayed_series(degree=2, delays=1)
         call context%go_to(instant(t + 2.0_wp), max(0.5_wp, unit))
         found_unit = unit
         call series%read_past(context, skipping, found_unit)
         call expect_close(error, series%coefficients(:, 1), [known, 0.0_wp], 1.0e-15_wp, "series")
         call expect_close(error, found_unit, min(unit, series%valid_for), 0.0_wp, "unit")
         if (present(valid_for)) then
            call expect_close(error, series%valid_for, valid_for, 0.01_wp*valid_for, "validity")
         end if
         if (.not. present(tolerances)) return
         do k = 1, size(tolerances)
            context%tolerance = tolerance_type(1, 0.0_wp, tolerances(k))
            call context%go_to(instant(t + 2.0_wp), max(0.5_wp, unit))
            call series%read_past(context, skipping, found_unit)
            h = unit
            call series%confirm(context, unit, h)
            call expect_close(error, h, lengths(k), 1.0e-15_wp, "length at "//text(tolerances(k)))
         end do
      end subroutine expect_series
   end subroutine test_series

   !> Ten thousand steps of an integration with 40 delayed values take no more memory than the first
   !> hundred; to keep all of them would need 25 MB.
   subroutine test_memory_of_integration(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(linear) :: problem
      integer, parameter :: n = 40
      integer(c_long) :: before
      integer :: i

      problem = linear(n=n, lag=[(0.01_wp, i=1, n)], component=[(i, i=1, n)], &
                       past=[(1.0_wp, i=1, n)], first=[(1.0_wp, i=1, n)])
      call run(error, problem, 0.0_wp, 1.0_wp, integration_options("explicit"), outcome)
      before = peak_memory()
      call run(error, problem, 0.0_wp, 100.0_wp, integration_options("explicit"), outcome)
      call expect(error, outcome%accepted >= 10000, "ten thousand steps")
      call expect(error, peak_memory() - before < growth, "memory does not grow by " &
                  //text(int(peak_memory() - before)))
   end subroutine test_memory_of_integration

   !> The step of no method, with 300 000 delays, finds place in 64 MB.
   subroutine test_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer, parameter :: n = 300000
      integer :: i

      do i = 1, size(methods)
         if (limit_memory(limit) == 0) return
         call integrate(many_delays(n), 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp, methods(i)), &
                        outcome, failure)
         call expect(error, limit_memory(-1_c_long) == 1, "the limit is lifted")
         call expect_failure(error, failure, "no memory for another ")
         call expect(error, outcome%reason == out_of_memory, "the reason, of "//methods(i))
         call expect(error, .not. allocated(outcome%y), "no state of "//methods(i))
      end do
   end subroutine test_steps

   !> As many equations, each with its own delay of 1.
   type(linear) function many_delays(n) result(problem)
      integer, intent(in) :: n
      integer :: i

      problem = linear(n, spread(1.0_wp, 1, n), [(i, i=1, n)], spread(0.0_wp, 1, n), &
                       spread(0.0_wp, 1, n))
   end function many_delays

   !> The past doubles until there is no memory for it, or fills its bound: a step of 64 components
   !> and degree 4 has 2560 bytes, its place in the ring 320. The state of the last step is kept.
   subroutine test_past(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 64
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      options = at_tolerance(1.0e-6_wp, "bs5")
      options%longest_step = 1.0e-5_wp
      do i = 1, 2
         ! an address sanitizer cannot be limited
         if (limit_memory(limit) == 0) return
         call integrate(many_delays(n), 0.0_wp, 1.0_wp, options, outcome, failure)
         call expect(error, limit_memory(-1_c_long) == 1, "the limit is lifted")
         call expect_failure(error, failure, merge("no memory for ", "no room in mos", i == 1))
         call expect_failure(error, failure, "(auto or an implicit method)")
         call expect(error, outcome%reason == out_of_memory, "the reason")
         call expect(error, outcome%t > 0.0_wp .and. size(outcome%y) == n, "the last step")
         options%most_bytes = 1.0e6_wp
      end do
      call expect_between(error, real(outcome%accepted, wp), 300.0_wp, 1.0e6_wp/2880, "steps")
   end subroutine test_past

   !> 100 steps of 10 000 components and degree 7, then of degree 12, are 72 and 104 MB. The ring
   !> doubles once; steps of the other degree take the place of those dropped.
   subroutine test_degree(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 10000
      type(history_type) :: past
      real(wp) :: lacking
      integer :: degree, i, place

      past = history_type(many_delays(n), instant(0.0_wp))
      if (limit_memory(115*1000*1000_c_long) == 0) return
      do degree = 7, 12, 5
         do i = 0, 99
            call past%make_room(degree, lacking)
            if (lacking > 0.0_wp) exit
            call past%open_step(instant(real(i, wp)), 1.0_wp, spread(0.0_wp, 1, degree), .true., &
                                1.0_wp, place)
            if (degree == 12) call past%forget(past%start_of(past%oldest + 1))
         end do
         call expect_close(error, lacking, 0.0_wp, 0.0_wp, "bytes lacking at "//text(degree))
      end do
      call expect(error, limit_memory(-1_c_long) == 1, "the limit is lifted")
   end subroutine test_degree
end module test_dde_history
