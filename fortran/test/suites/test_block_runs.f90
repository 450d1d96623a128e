! SPDX-License-Identifier: BSD-3-Clause
!> Runs of the block by Taylor series, with slow ones, and by implicit steps through slips; a
!> quantity that is conserved at infinite gamma; continuations. The baseline with fixed steps on
!> problems with exact solutions; tests/test_measure.py has measured runs.
module test_block_runs
   use block_builder, only: build_block
   use dde, only: continuation_type, dde_problem_type, event_met, event_table, integrate, &
                  integration_result, table_sampler, value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: int64, wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use fixed_step_rk4, only: integrate_rk4
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use measured_case, only: case_type
   use model_problem, only: model_type
   use solving, only: at_tolerance, run
   use test_problems, only: linear, sine
   use undelayed_problems, only: falls_out
   implicit none (type, external)
   private
   public :: collect_block_runs

   !> The method itself, and the one that begins with it; methods that go through slips.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "], &
                                  methods(4) = ["radau5  ", "radau9  ", "radau13 ", "auto    "]
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_block_runs(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("error follows tolerance", test_tolerances), &
                   new_unittest("a series that is not finite", test_not_finite), &
                   new_unittest("down to where v is 1e-34", test_fall), &
                   new_unittest("conserved at infinite gamma", test_conserved), &
                   new_unittest("in the middle of a slip", test_slip), &
                   new_unittest("order of rk4", test_orders), &
                   new_unittest("samples of rk4", test_rk4_samples), &
                   new_unittest("refusals of rk4", test_rk4_refusals), &
                   new_unittest("sample times", test_sample_times)]
   end subroutine collect_block_runs

   !> Errors stay below 100 or 10 tolerances and fall with them: on the paper's torus; of stiff
   !> blocks with and without delay, in few steps and without implicit ones but for a try; where a
   !> block from u = 50 sticks at v = exp(-40), and what v grows to is seen before it counts; and
   !> with a delay of 1e-3, where the first steps are below the rounding error of a later one.
   subroutine test_tolerances(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result), allocatable :: found(:)
      real(wp), parameter :: v(3) = [0.7_wp, 1.1_wp, 1.5_wp], xi(3) = [0.3_wp, 0.5_wp, 0.8_wp]
      integer :: delays, i, j, power

      call check(build_block(10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp, v=1.5_wp), 100.0_wp, both(:1), &
                 [(i, i=2, 12)], 100)
      do power = 4, 12, 2
         do delays = 0, 1
            call check(build_block(1.0_wp*delays, 0.7_wp, 0.5_wp, 10.0_wp**power, v=1.1_wp), &
                       20.0_wp, both, [3, 5, 7, 9, 11], 100)
            call expect(error, all(found%accepted >= 5 .and. found%accepted <= 400), &
                        "steps at gamma = 1e"//text(power))
            call expect(error, all(found(1::2)%implicit_steps == 0) &
                        .and. all(found(2::2)%implicit_steps <= 40), "implicit steps")
         end do
      end do
      call check(build_block(0.0_wp, 0.5_wp, 0.8_wp, 0.8_wp, u=50.0_wp, v=1.1_wp), 45.0_wp, both, &
                 [4, 6, 8, 10], 100)
      do i = 1, size(xi)
         do j = 1, size(v)
            call check(build_block(1.0e-3_wp, 0.1_wp, xi(i), 1.0e12_wp, v=v(j)), 20.0_wp, &
                       both(2:), [3, 4, 5], 10)
         end do
      end do

   contains

      !> A block by methods at tolerances 10**-power, each method at each, beside Radau's.
      subroutine check(block, t_end, names, powers, most)
         type(model_type), intent(in) :: block
         real(wp), intent(in) :: t_end
         character(len=*), intent(in) :: names(:)
         !> The most that an error may be, in tolerances
         integer, intent(in) :: powers(:), most
         type(integration_result) :: known
         integer :: at, k, m

         if (allocated(found)) deallocate (found)
         allocate (found(size(names)*size(powers)))
         call run(error, block, 0.0_wp, t_end, at_tolerance(1.0e-13_wp, "radau13"), known)
         at = 0
         do k = 1, size(powers)
            do m = 1, size(names)
               if (allocated(error)) return
               at = at + 1
               call run(error, block, 0.0_wp, t_end, &
                        at_tolerance(10.0_wp**(-powers(k)), names(m)), found(at))
               call expect_close(error, found(at)%y, known%y, most*10.0_wp**(-powers(k)), &
                                 trim(names(m))//" at 1e-"//text(powers(k))//", gamma = " &
                                 //text(block%numbers(4)))
            end do
         end do
      end subroutine check
   end subroutine test_tolerances

   !> The block takes no v beyond e^300.
   subroutine test_not_finite(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(build_block(1.0_wp, 0.7_wp, 0.5_wp, 0.8_wp, v=1.0e131_wp), 0.0_wp, 1.0_wp, &
                     at_tolerance(1.0e-9_wp, "taylor"), outcome, failure)
      call expect(error, outcome%reason == value_not_finite .and. outcome%accepted == 0, &
                  "the reason is `value_not_finite`, and no step passed")
   end subroutine test_not_finite

   !> After a slip at great epsilon v falls to 1e-34 within 1e-29 of time, less than moves even a
   !> compensated time. A false solution of a step's equations would throw the block far off; on the
   !> true one forces balance before and after.
   subroutine test_fall(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      real(wp), parameter :: tolerance(3) = [1.0e-4_wp, 1.0e-6_wp, 1.0e-9_wp]
      integer :: i, j

      do j = 1, size(tolerance)
         do i = 1, size(methods)
            call run(error, build_block(0.0_wp, 5.0_wp, 0.5_wp, 1.0e4_wp, v=1.1_wp), 0.0_wp, &
                     50.0_wp, at_tolerance(tolerance(j), methods(i)), outcome)
            associate (theta => outcome%y(1), u => outcome%y(2), w => outcome%y(3))
               call expect_between(error, abs(u), 0.0_wp, 1000.0_wp, trim(methods(i))//": u")
               call expect_close(error, u + (theta + w)/0.5_wp, 0.0_wp, 1000.0_wp*tolerance(j), &
                                 trim(methods(i))//": balance of forces")
            end associate
         end do
      end do
   end subroutine test_fall

   !> Without delay, at epsilon = xi and infinite gamma, theta = -w - xi u, u' = v - 1 and
   !> w' = xi [v (w - u - 1) + 1]. Then H = exp(-xi u) [1/xi + 1 + u - w - 1/v] is constant: with Q
   !> its bracket, exp(xi u) H' = (v - 1)(1 - xi Q) - (1 - 1/v) w' = 0. At finite gamma H drifts by
   !> D/gamma^2 + O(gamma^-4). D is taken from gamma = 1e3. Up to gamma = 1e5 the drift is more than
   !> ten times what is allowed, ten tolerances; at gamma = 1e8 and 1e12 no drift may exceed these.
   subroutine test_conserved(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      real(wp), parameter :: xi = 0.5_wp, w0 = 1.2_wp, tolerance = 1.0e-12_wp
      integer, parameter :: powers(10) = [6, 3, 4, 5, 7, 8, 9, 10, 16, 24]
      real(wp) :: drift, times_square
      integer :: i, j

      do i = 1, size(methods)
         do j = 1, size(powers)
            associate (square => 10.0_wp**powers(j))
               call run(error, build_block(0.0_wp, xi, xi, sqrt(square), theta=-w0, v=exp(w0)), &
                        0.0_wp, 30.0_wp, at_tolerance(tolerance, methods(i)), outcome)
               if (allocated(error)) return
               drift = conserved(outcome%y(2), outcome%y(3)) - conserved(0.0_wp, w0)
               if (j == 1) times_square = drift*square
               call expect_close(error, drift, times_square/square, &
                                 10.0_wp*(1.0_wp/square**2 + 2.0e-6_wp/square + tolerance), &
                                 trim(methods(i))//": drift at gamma^2 = 1e"//text(powers(j)))
            end associate
         end do
         call expect_between(error, abs(times_square), 0.1_wp, 10.0_wp, "drift times gamma^2")
      end do

   contains

      !> H.
      pure real(wp) function conserved(u, w) result(value)
         real(wp), intent(in) :: u, w

         value = exp(-xi*u)*(1.0_wp/xi + 1.0_wp + u - w - exp(-w))
      end function conserved
   end subroutine test_conserved

   !> The stiffest block without delay, stopped on the way up and on the way down of a slip, where
   !> steps are far below a spacing of t, ends as in one run.
   subroutine test_slip(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(event_table) :: table
      type(integration_result) :: outcome, whole
      type(model_type) :: problem
      real(wp), parameter :: t_end = 40.0_wp
      integer :: i, runs

      problem = build_block(0.0_wp, 0.7_wp, 0.5_wp, 1.0e12_wp, u=0.5_wp, v=1.1_wp)
      do i = 1, size(methods)
         call run(error, problem, 0.0_wp, t_end, at_tolerance(1.0e-10_wp, methods(i)), whole)
         continuation = continuation_type()
         table = event_table([3], [20.0_wp], [0], terminal=[.true.])
         do runs = 1, 1000
            call run(error, problem, continuation%time(1), t_end, &
                     at_tolerance(1.0e-10_wp, methods(i)), outcome, watcher=table, &
                     continuation=continuation)
            if (outcome%reason /= event_met .or. allocated(error)) exit
         end do
         call expect(error, runs == 3, text(runs)//" runs of "//methods(i))
         call expect_close(error, outcome%y, whole%y, 1.0e-6_wp, methods(i))
      end do
   end subroutine test_slip

   !> Order 4 with a cubic history and 2 with a linear one: y' = -y(t-1), y = 1 up to t = 0, at t =
   !> 10, with kinks on the grid; y' = -y(t - pi/2), which goes on as sin t, with delayed values a
   !> third of a step off the grid points.
   subroutine test_orders(error)
      type(error_type), allocatable, intent(out) :: error
      type(sine) :: off_grid
      real(wp), parameter :: h = 0.5_wp*pi/(31.0_wp + 1.0_wp/3.0_wp)
      logical :: cubic
      integer :: i

      off_grid = sine()
      do i = 1, 2
         cubic = i == 2
         call expect_close(error, [order_of(linear(), cubic, 10.0_wp, 10493.0_wp/518400, 0.05_wp), &
                                   order_of(off_grid, cubic, 50*h, sin(50*h), h)], &
                           [2.0_wp*i, 2.0_wp*i], 0.2_wp, "orders")
      end do
   end subroutine test_orders

   !> How the error falls from steps of length h to half of that.
   real(wp) function order_of(problem, cubic, t_end, known, h) result(order)
      class(dde_problem_type), intent(in) :: problem
      logical, intent(in) :: cubic
      real(wp), intent(in) :: t_end, known, h
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      real(wp) :: misfit(2)
      integer :: i

      do i = 1, 2
         call integrate_rk4(problem, t_end, h/i, cubic, outcome, failure)
         misfit(i) = abs(outcome%y(1) - known)
      end do
      order = log(misfit(1)/misfit(2))/log(2.0_wp)
   end function order_of

   !> Between grid points, at both ends, and as many as asked for.
   subroutine test_rk4_samples(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(sine) :: problem
      type(table_sampler) :: table
      real(wp) :: time(6)

      time = [0.0_wp, 0.013_wp, 1.0_wp, 2.0_wp, 4.99_wp, 5.0_wp]
      problem = sine()
      table = table_sampler([1], time)
      call integrate_rk4(problem, 5.0_wp, 0.01_wp, .true., outcome, failure, table)
      call expect_success(error, failure)
      call expect(error, table%received == size(time), "every sample is taken")
      call expect_close(error, table%values(1, :), sin(time), 1.0e-8_wp, "samples")
      call expect(error, outcome%accepted == 500_int64, "500 steps")
      call expect(error, outcome%evaluations == 2001_int64, "four evaluations a step")
   end subroutine test_rk4_samples

   !> Steps longer than the delay, and a value that is not finite.
   subroutine test_rk4_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(sine) :: problem

      problem = sine()
      call integrate_rk4(problem, 10.0_wp, 2.0_wp, .true., outcome, failure)
      call expect_failure(error, failure, "longer than the shortest delay, 1.570796")
      call integrate_rk4(falls_out(0.0_wp), 2.0_wp, 0.1_wp, .true., outcome, failure)
      call expect_failure(error, failure, "not finite")
      call expect(error, outcome%reason == value_not_finite, "the reason says so")
      call expect_close(error, outcome%t, 0.9_wp, 1.0e-12_wp, "time reached")
   end subroutine test_rk4_refusals

   !> The last sample is at t_end where that is a multiple, also where the quotient rounds down.
   subroutine test_sample_times(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: case

      case%sample_interval = 0.1_wp
      case%t_end = 0.3_wp
      call expect_close(error, case%sample_times(), [0.0_wp, 0.1_wp, 0.2_wp, 0.3_wp], 0.0_wp, "all")
      case%sample_interval = 2.0_wp
      case%t_end = 5.0_wp
      call expect_close(error, case%sample_times(), [0.0_wp, 2.0_wp, 4.0_wp], 0.0_wp, "multiples")
   end subroutine test_sample_times
end module test_block_runs
