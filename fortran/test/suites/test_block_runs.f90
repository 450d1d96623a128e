! SPDX-License-Identifier: BSD-3-Clause
!> Runs of the block: by Taylor series, with and without slow ones, and by implicit steps through
!> slips; a quantity that is conserved at infinite gamma; continuations.
module test_block_runs
   use block_builder, only: build_block
   use dde, only: continuation_type, event_met, event_table, integrate, integration_options, &
                  integration_result, too_many_steps, value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use dde_methods, only: price_of_trial
   use dde_tolerance, only: tolerance_type
   use expectations, only: expect, expect_between, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use solving, only: at_tolerance, run
   implicit none (type, external)
   private
   public :: collect_block_runs

   !> The method itself, and the one that begins with it.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "]

   !> Methods under test.
   character(len=8), parameter :: methods(4) = ["radau5  ", "radau9  ", "radau13 ", "auto    "]

   !> A block whose w has no known rate of relaxation.
   type, extends(model_type) :: plain_block
   contains
      procedure :: relaxation_rate => no_rate
   end type plain_block

contains

   !> All tests of this suite.
   subroutine collect_block_runs(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("error follows tolerance", test_proportional), &
                   new_unittest("a series that is not finite", test_not_finite), &
                   new_unittest("stiff blocks", test_blocks), &
                   new_unittest("the stick before a slip", test_stick), &
                   new_unittest("a block without slow series", test_plain), &
                   new_unittest("steps longer than the delay", test_short_delay), &
                   new_unittest("at rest", test_rest), &
                   new_unittest("down to where v is 1e-34", test_fall), &
                   new_unittest("conserved at infinite gamma", test_conserved), &
                   new_unittest("in the middle of a slip", test_slip), &
                   new_unittest("auto at gamma 1e12", test_first_steps), &
                   new_unittest("auto at tight tolerances", test_tight)]
   end subroutine collect_block_runs

   !> No rate is known.
   pure function no_rate(self, t, y) result(rate)
      class(plain_block), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = 0.0_wp
   end function no_rate

   !> The error at t = 100 stays below 100 times the tolerance, and falls with it.
   subroutine test_proportional(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      integer :: i

      call run(error, torus(), 0.0_wp, 100.0_wp, at_tolerance(1.0e-13_wp, "radau13"), known)
      do i = 2, 12
         call run(error, torus(), 0.0_wp, 100.0_wp, at_tolerance(10.0_wp**(-i), "taylor"), outcome)
         call expect_close(error, outcome%y, known%y, 100*10.0_wp**(-i), "1e-"//text(i))
      end do
   end subroutine test_proportional

   !> The block takes no v beyond e^300.
   subroutine test_not_finite(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, &
                                 v=1.0e131_wp), &
                     0.0_wp, 1.0_wp, at_tolerance(1.0e-9_wp, "taylor"), outcome, failure)
      call expect(error, outcome%reason == value_not_finite, "the reason is `value_not_finite`")
      call expect(error, outcome%accepted == 0, "no step passed")
   end subroutine test_not_finite

   !> The torus of the paper.
   type(model_type) function torus() result(problem)
      problem = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.5_wp)
   end function torus

   !> Blocks up to gamma = 1e12, as by the implicit method, in few steps and without implicit ones
   !> but for a try.
   subroutine test_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      type(model_type) :: problem
      real(wp), parameter :: gamma(4) = [1.0e4_wp, 1.0e6_wp, 1.0e9_wp, 1.0e12_wp]
      integer :: delays, i, j, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=1.0_wp*delays, epsilon=0.7_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known)
            do j = 3, 11, 2
               do k = 1, 2
                  call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(10.0_wp**(-j), both(k)), &
                           outcome)
                  call expect_close(error, outcome%y, known%y, 100*10.0_wp**(-j), &
                                    trim(both(k))//" at gamma = "//text(gamma(i))//", 1e-"//text(j))
                  call expect_between(error, real(outcome%accepted, wp), 5.0_wp, 400.0_wp, &
                                      "steps at gamma = "//text(gamma(i))//", 1e-"//text(j))
                  call expect_between(error, real(outcome%implicit_steps, wp), 0.0_wp, &
                                      merge(0.0_wp, 40.0_wp, k == 1), "implicit steps")
               end do
            end do
         end do
      end do
   end subroutine test_blocks

   !> From u = 50 the block sticks at v = exp(-40); what v grows to is seen before it counts.
   subroutine test_stick(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      type(model_type) :: problem
      integer :: i, j

      problem = build_block(tau=0.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, u=50.0_wp, &
                            v=1.1_wp)
      call run(error, problem, 0.0_wp, 45.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known)
      do j = 4, 10, 2
         do i = 1, 2
            call run(error, problem, 0.0_wp, 45.0_wp, at_tolerance(10.0_wp**(-j), both(i)), outcome)
            call expect_close(error, outcome%y, known%y, 100*10.0_wp**(-j), &
                              both(i)//" at 1e-"//text(j))
         end do
      end do
   end subroutine test_stick

   !> Without its slow series a stiff block takes more steps than are allowed, and `auto` leaves the
   !> series at all tolerances.
   subroutine test_plain(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: known, outcome
      type(plain_block) :: problem
      integer :: i

      problem%model_type = build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, &
                                              gamma=1.0e4_wp, v=1.1_wp)
      options = at_tolerance(1.0e-6_wp, "taylor")
      options%most_steps = 10000
      call integrate(problem, 0.0_wp, 20.0_wp, options, outcome, failure)
      call expect(error, outcome%reason == too_many_steps, "the reason is `too_many_steps`")
      call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known)
      do i = 3, 11, 2
         call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(10.0_wp**(-i), "auto"), outcome)
         call expect_close(error, outcome%y, known%y, 1000*10.0_wp**(-i), "1e-"//text(i))
         call expect_between(error, real(outcome%accepted, wp), 30.0_wp, 400.0_wp, "steps")
         call expect(error, outcome%implicit_steps > 10, "implicit steps")
      end do
   end subroutine test_plain

   !> Where the delay is short, `auto` takes implicit steps that are longer.
   subroutine test_short_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome

      call run(error, &
               build_block(tau=1.0e-3_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e6_wp, v=1.1_wp), &
               0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "auto"), outcome)
      call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 2000.0_wp, "steps")
      call expect(error, outcome%implicit_steps > 5, "implicit steps")
   end subroutine test_short_delay

   !> Where the block is at rest, `auto` takes implicit steps without end.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      integer :: i, j

      do i = 0, 1
         do j = 4, 10, 2
            call run(error, build_block(10.0_wp*i, 0.2_wp, 0.8_wp, 0.8_wp, v=1.1_wp), 0.0_wp, &
                     1.0e6_wp, at_tolerance(10.0_wp**(-j), "auto"), outcome)
            call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 4000.0_wp, &
                                "steps at 1e-"//text(j))
         end do
      end do
   end subroutine test_rest

   !> After a slip at great epsilon v falls to 1e-34 within 1e-29 of time, less than moves even a
   !> compensated time. A false solution of a step's equations would throw the block far off; on the
   !> true one forces balance before and after.
   subroutine test_fall(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(model_type) :: block_model
      real(wp), parameter :: tolerance(3) = [1.0e-4_wp, 1.0e-6_wp, 1.0e-9_wp]
      integer :: i, j

      block_model = build_block(tau=0.0_wp, epsilon=5.0_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp)
      do j = 1, size(tolerance)
         do i = 1, size(methods)
            call run(error, block_model, 0.0_wp, 50.0_wp, at_tolerance(tolerance(j), methods(i)), &
                     outcome)
            associate (theta => outcome%y(1), u => outcome%y(2), w => outcome%y(3))
               call expect_between(error, abs(u), 0.0_wp, 1000.0_wp, trim(methods(i))//": u")
               call expect_close(error, [u + (theta + w)/0.5_wp], [0.0_wp], &
                                 1000.0_wp*tolerance(j), trim(methods(i))//": balance of forces")
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
      type(model_type) :: block_model
      real(wp), parameter :: xi = 0.5_wp, w0 = 1.2_wp, tolerance = 1.0e-12_wp
      integer, parameter :: powers(10) = [6, 3, 4, 5, 7, 8, 9, 10, 16, 24]
      real(wp) :: drift, times_square
      integer :: i, j

      do i = 1, size(methods)
         do j = 1, size(powers)
            associate (square => 10.0_wp**powers(j))
               block_model = build_block(tau=0.0_wp, epsilon=xi, xi=xi, gamma=sqrt(square), &
                                         theta=-w0, v=exp(w0))
               call run(error, block_model, 0.0_wp, 30.0_wp, at_tolerance(tolerance, methods(i)), &
                        outcome)
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

      problem = build_block(tau=0.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e12_wp, u=0.5_wp, &
                            v=1.1_wp)
      do i = 1, size(methods)
         if (any(methods(i) == ["explicit", "taylor  "])) cycle
         call run(error, problem, 0.0_wp, t_end, at_tolerance(1.0e-10_wp, methods(i)), whole)
         continuation = continuation_type()
         table = event_table([3], [20.0_wp], [0], terminal=[.true.])
         do runs = 1, 1000
            call run(error, problem, continuation%time(1), t_end, &
                     at_tolerance(1.0e-10_wp, methods(i)), outcome, watcher=table, &
                     continuation=continuation)
            if (outcome%reason /= event_met .or. allocated(error)) exit
         end do
         call expect_between(error, real(runs, wp), 3.0_wp, 3.0_wp, "runs of "//methods(i))
         call expect_close(error, outcome%y, whole%y, 1.0e-6_wp, methods(i))
      end do
   end subroutine test_slip

   !> A delay of 1e-3, where the first steps are below the rounding error of the length of a later
   !> one: another method finds the same.
   subroutine test_first_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, radau
      real(wp), parameter :: v(3) = [0.7_wp, 1.1_wp, 1.5_wp], xi(3) = [0.3_wp, 0.5_wp, 0.8_wp]
      real(wp), parameter :: tolerances(3) = [1.0e-3_wp, 1.0e-4_wp, 3.0e-5_wp]
      type(model_type) :: block_model
      integer :: i, j, k

      do i = 1, size(xi)
         do j = 1, size(v)
            block_model = build_block(tau=1.0e-3_wp, epsilon=0.1_wp, xi=xi(i), gamma=1.0e12_wp, &
                                      v=v(j))
            call run(error, block_model, 0.0_wp, 20.0_wp, at_tolerance(1.0e-10_wp, "radau9"), radau)
            do k = 1, size(tolerances)
               call run(error, block_model, 0.0_wp, 20.0_wp, at_tolerance(tolerances(k), "auto"), &
                        auto)
               if (allocated(error)) return
               call expect_close(error, auto%y, radau%y, 10*tolerances(k), "xi "//text(xi(i)) &
                                 //", v "//text(v(j))//" at "//text(tolerances(k)))
            end do
         end do
      end do
   end subroutine test_first_steps

   !> At high degrees and gamma from 100 to 1e12 `auto` takes at most twice the work of Radau and
   !> two prices.
   subroutine test_tight(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, radau
      real(wp), parameter :: tau(2) = [1.0_wp, 7.0_wp]
      real(wp), parameter :: tolerances(3) = [3.0e-13_wp, 1.0e-13_wp, 1.0e-14_wp]
      type(model_type) :: block_model
      real(wp) :: price
      integer :: i, j, power

      do power = 2, 12, 2
         do i = 1, size(tau)
            block_model = build_block(tau=tau(i), epsilon=0.7_wp, xi=0.5_wp, gamma=10.0_wp**power, &
                                      v=1.5_wp)
            do j = 1, size(tolerances)
               call run(error, block_model, 0.0_wp, 20.0_wp, &
                        at_tolerance(tolerances(j), "radau13"), radau)
               call run(error, block_model, 0.0_wp, 20.0_wp, at_tolerance(tolerances(j), "auto"), &
                        auto)
               if (allocated(error)) return
               price = price_of_trial(block_model, tolerance_type(3, tolerances(j), tolerances(j)))
               call expect(error, auto%work <= 2*(radau%work + price), text(auto%work) &
                           //" by auto, "//text(radau%work)//" by radau13, gamma 1e"//text(power) &
                           //", tau "//text(tau(i))//" at "//text(tolerances(j)))
            end do
         end do
      end do
   end subroutine test_tight
end module test_block_runs
