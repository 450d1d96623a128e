! SPDX-License-Identifier: BSD-3-Clause
!> The past: look-ups in a ring of polynomials of two kinds, growth, and forgetting; and runs that
!> need more memory than there is, which end with an error.
module test_dde_history
   use, intrinsic :: iso_c_binding, only: c_int, c_long
   use dde, only: integrate, integration_options, integration_result, methods, out_of_memory
   use dde_cursor, only: cursor_type
   use dde_history, only: history_type
   use dde_time, only: instant, later
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_failure
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run
   use test_problems, only: linear, wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_history

   !> Nodes of the polynomials of odd and of even steps.
   real(wp), parameter :: odd_nodes(1) = [1.0_wp], even_nodes(3) = [0.0_wp, 1.0_wp, 0.0_wp]
   !> Places of a step in an order that goes forth and back.
   real(wp), parameter :: places(5) = [0.0_wp, 0.05_wp, 0.3_wp, 0.9_wp, 1.0_wp]
   !> Memory that this process may take, in bytes.
   integer(c_long), parameter :: limit = 64*1024*1024_c_long
   !> Memory that counts as growth, in kibibytes.
   integer(c_long), parameter :: growth = 4096_c_long

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

      testsuite = [new_unittest("look-ups in a ring", test_ring), &
                   new_unittest("what is forgotten", test_forget), &
                   new_unittest("what is given back", test_recall), &
                   new_unittest("memory of an integration", test_memory_of_integration), &
                   new_unittest("no memory for steps", test_steps), &
                   new_unittest("no memory for the past", test_past), &
                   new_unittest("the memory of each degree", test_degree)]
   end subroutine collect_dde_history

   !> Three delays of two components over 2000 steps of different lengths, of which 50 at a time
   !> matter; the same where 600 matter, so that the ring doubles four times; where steps become
   !> shorter on the way, so that the ring doubles when its oldest step lies anywhere; and where
   !> both components have one delay, and are looked up together.
   subroutine test_ring(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_lookups(error, [0.05_wp, 1.45_wp, 0.9_wp], 2000)
      call expect_lookups(error, [0.05_wp, 18.0_wp, 7.3_wp], 2000)
      call expect_lookups(error, [0.05_wp, 1.45_wp, 0.9_wp], 2000, 500)
      call expect_lookups(error, [0.05_wp, 1.45_wp, 1.45_wp], 2000, 500)
   end subroutine test_ring

   !> Steps that ended before the horizon are gone, those after it are there, the newest always is:
   !> the value of each step is its number.
   subroutine test_forget(error)
      type(error_type), allocatable, intent(out) :: error
      type(cursor_type) :: cursor
      type(history_type) :: past
      type(wille_baker) :: problem
      integer :: i

      problem = delayed([200.0_wp], [1])
      past = history_type(problem, instant(0.0_wp))
      cursor = cursor_type(problem)
      do i = 0, 199
         call past%append(instant(real(i, wp)), 1.0_wp, [0.0_wp], &
                          reshape([real(i, wp), 0.0_wp], [2, 1]), valid_for=1.0_wp)
      end do
      call expect_number(2.5_wp, 2.0_wp)
      call past%forget(instant(100.5_wp))
      call expect_number(2.5_wp, 100.0_wp)
      call expect_number(100.25_wp, 100.0_wp)
      call expect_number(101.5_wp, 101.0_wp)
      call expect_number(199.5_wp, 199.0_wp)
      call past%forget(instant(150.0_wp))
      call expect_number(2.5_wp, 150.0_wp)
      call past%forget(instant(1000.0_wp))
      call expect_number(2.5_wp, 199.0_wp)

   contains

      !> The past reads this number at time t.
      subroutine expect_number(t, number)
         real(wp), intent(in) :: t, number
         real(wp) :: z(1, 1)

         call cursor%set(problem, past, instant(t + problem%lag(1)), 0.1_wp)
         call cursor%values(problem, past, [0.0_wp], z)
         call expect_close(error, z(:, 1), [number], 0.0_wp, "number of the step at t = "//text(t))
      end subroutine expect_number
   end subroutine test_forget

   !> A step of low degree in a slot that had one of high degree before comes back with zeros above.
   subroutine test_recall(error)
      type(error_type), allocatable, intent(out) :: error
      type(history_type) :: past
      type(instant) :: start
      real(wp) :: coefficient(0:12, 1), length, nodes(12), valid_for
      integer :: i

      past = history_type(delayed([2.0_wp], [1]), instant(0.0_wp))
      nodes = 0.0_wp
      coefficient = 7.0_wp
      do i = 0, 63
         call past%append(instant(real(i, wp)), 1.0_wp, nodes, coefficient, valid_for=1.0_wp)
         call past%forget(instant(i + 1.0_wp))
      end do
      call past%append(instant(64.0_wp), 1.0_wp, odd_nodes, reshape([3.0_wp, 4.0_wp], [2, 1]), &
                       valid_for=1.5_wp)
      call past%recall(past%newest, start, length, valid_for, nodes, coefficient)
      call expect_close(error, valid_for, 1.5_wp, 0.0_wp, "validity")
      call expect_close(error, start%hi, 64.0_wp, 0.0_wp, "start")
      call expect_close(error, coefficient(:, 1), [3.0_wp, 4.0_wp, (0.0_wp, i=2, 12)], 0.0_wp, &
                        "coefficients")
      call expect(error, past%degree_in_use() == 12, "the step before is kept, too")
   end subroutine test_recall

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

   !> Append steps, forget what no delay reaches, and look up all delayed values in each step. In
   !> step i the solution is i + s, but component 3 of an even step is i + 3 s^2 - 2 s^3:
   !> continuous, and in no step what it is in another.
   subroutine expect_lookups(error, lag, steps, long_steps)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: lag(3)
      integer, intent(in) :: steps
      !> Steps after which they are 20 times shorter; none if not given
      integer, intent(in), optional :: long_steps
      type(cursor_type) :: cursor
      type(history_type) :: past
      type(instant) :: now
      type(wille_baker) :: problem
      real(wp) :: known, length, misfit, start(0:steps)
      real(wp) :: z(3, size(places))
      integer :: found, i, j, k

      problem = delayed(lag, [3, 1, 3])
      now = instant(0.0_wp)
      past = history_type(problem, now)
      cursor = cursor_type(problem)
      misfit = 0.0_wp
      found = 0
      do i = 0, steps - 1
         start(i) = now%hi
         length = 0.01_wp*(1 + modulo(7*i, 5))
         if (present(long_steps)) length = length/merge(1, 20, i < long_steps)
         call cursor%set(problem, past, now, length)
         ! ahead, then back to the start of the step
         call cursor%values(problem, past, places(3:)*length, z(:, 3:))
         call cursor%values(problem, past, places*length, z)
         do j = 1, size(places)
            do k = 1, size(lag)
               ! a step that has the initial time inside is none that the solver makes
               if (now%hi < lag(k) .and. now%hi + length > lag(k)) cycle
               known = problem%past(problem%component(k))
               if (now%hi >= lag(k)) then
                  known = value_at(now%hi + places(j)*length - lag(k), start(:i), &
                                   problem%component(k))
                  found = found + 1
               end if
               misfit = max(misfit, abs(z(k, j) - known))
            end do
         end do
         if (modulo(i, 2) == 1) then
            call past%append(now, length, odd_nodes, &
                             reshape([real(wp) :: i + 1, 1, i + 1, 1], [2, 2]), valid_for=length)
         else
            call past%append(now, length, even_nodes, &
                             reshape([real(wp) :: i, 1, 0, 0, i, 1, 1, -2], [4, 2]), &
                             valid_for=length)
         end if
         now = later(now, length)
         call past%forget(later(now, -maxval(lag)))
      end do
      call expect_between(error, misfit, 0.0_wp, 1.0e-9_wp, "largest misfit")
      call expect(error, found > 5*steps, "most look-ups are in the ring")
   end subroutine expect_lookups

   !> That solution at time t.
   pure real(wp) function value_at(t, start, component) result(value)
      real(wp), intent(in) :: t
      !> Starts of all steps so far, the present one last
      real(wp), intent(in) :: start(0:)
      !> 1 or 3
      integer, intent(in) :: component
      real(wp) :: s
      integer :: i

      i = min(count(start <= t), ubound(start, 1)) - 1
      s = (t - start(i))/(start(i + 1) - start(i))
      value = i + s
      if (component == 3 .and. modulo(i, 2) == 0) value = i + (3.0_wp - 2.0_wp*s)*s**2
   end function value_at

   !> A problem of three components with any delays.
   type(wille_baker) function delayed(lag, component) result(problem)
      real(wp), intent(in) :: lag(:)
      integer, intent(in) :: component(:)

      problem = wille_baker(n=3, lag=lag, component=component, past=[-1.0_wp, -2.0_wp, -3.0_wp], &
                            first=[0.0_wp, 0.0_wp, 0.0_wp])
   end function delayed

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
      integer :: degree, i

      past = history_type(many_delays(n), instant(0.0_wp))
      if (limit_memory(115*1000*1000_c_long) == 0) return
      do degree = 7, 12, 5
         do i = 0, 99
            call past%make_room(degree, lacking)
            if (lacking > 0.0_wp) exit
            call past%open_step(instant(real(i, wp)), 1.0_wp, spread(0.0_wp, 1, degree), .true., &
                                1.0_wp)
            if (degree == 12) call past%forget(past%start_of(past%oldest + 1))
         end do
         call expect_close(error, lacking, 0.0_wp, 0.0_wp, "bytes lacking at "//text(degree))
      end do
      call expect(error, limit_memory(-1_c_long) == 1, "the limit is lifted")
   end subroutine test_degree
end module test_dde_history
