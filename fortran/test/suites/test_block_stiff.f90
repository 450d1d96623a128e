!> Stiff runs of the block: slips, the fall of v after them, a quantity that is conserved at
!> infinite gamma, events and continuations.
module test_block_stiff
   use block_builder, only: build_block
   use block_state, only: index_of_ln_v
   use dde, only: continuation_type, event_met, event_table, integration_result
   use dde_errors, only: text
   use dde_methods, only: price_of_trial
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close
   use problem_runs, only: run
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_block_stiff

   !> Methods under test.
   character(len=8), parameter :: methods(4) = ["radau5  ", "radau9  ", "radau13 ", "auto    "]

contains

   subroutine collect_block_stiff(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("down to where v is 1e-34", test_fall), &
                   new_unittest("conserved at infinite gamma", test_conserved), &
                   new_unittest("maxima of v at gamma 1e6", test_maxima), &
                   new_unittest("in the middle of a slip", test_slip), &
                   new_unittest("auto at gamma 1e12", test_short_delay), &
                   new_unittest("auto at tight tolerances", test_tight)]
   end subroutine collect_block_stiff

   !> After a slip at great epsilon v falls to 1e-34 within 1e-29 of time, less than moves even a
   !> compensated time. A false solution of a step's equations would throw the block far off; on the
   !> true one forces balance before and after.
   subroutine test_fall(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      real(wp), parameter :: tolerance(3) = [1.0e-4_wp, 1.0e-6_wp, 1.0e-9_wp]
      integer :: i, j

      block_model = build_block(tau=0.0_wp, epsilon=5.0_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp)
      do j = 1, size(tolerance)
         do i = 1, size(methods)
            call run(block_model, 50.0_wp, at_tolerance(tolerance(j), methods(i)), outcome, error)
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
      type(spring_block_type) :: block_model
      real(wp), parameter :: xi = 0.5_wp, w0 = 1.2_wp, tolerance = 1.0e-12_wp
      integer, parameter :: powers(10) = [6, 3, 4, 5, 7, 8, 9, 10, 16, 24]
      real(wp) :: drift, times_square
      integer :: i, j

      do i = 1, size(methods)
         do j = 1, size(powers)
            associate (square => 10.0_wp**powers(j))
               block_model = build_block(tau=0.0_wp, epsilon=xi, xi=xi, gamma=sqrt(square), &
                                         theta=-w0, v=exp(w0))
               call run(block_model, 30.0_wp, at_tolerance(tolerance, methods(i)), outcome, error)
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

   !> Slips of the stiff block: at a maximum of v forces balance, u + (theta + ln v)/xi = 0, and a
   !> method of another order finds the same. The first shock, of a few 1e-12, dies out in maxima
   !> below the tolerance, which are left aside.
   subroutine test_maxima(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: one, other
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      integer :: i

      block_model = build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e6_wp, v=1.5_wp)
      one = event_table([index_of_ln_v], [0.0_wp], [-1], of_slope=[.true.])
      other = one
      call run(block_model, 20.0_wp, at_tolerance(1.0e-11_wp, "auto"), outcome, error, events=one)
      call run(block_model, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), outcome, error, &
               events=other)
      do i = 1, one%received
         if (one%time(i)%hi < 1.0e-9_wp) cycle
         associate (theta => one%y(1, i), u => one%y(2, i), w => one%y(3, i))
            call expect_close(error, u + (theta + w)/block_model%parameters%xi, 0.0_wp, &
                              1.0e-11_wp, "forces")
         end associate
      end do
      associate (times => pack(one%time(:one%received)%hi, &
                               one%time(:one%received)%hi > 1.0e-9_wp), &
                 known => pack(other%time(:other%received)%hi, &
                               other%time(:other%received)%hi > 1.0e-9_wp))
         call expect_between(error, real(size(times), wp), 2.0_wp, 100.0_wp, "number of maxima")
         call expect_close(error, times, known, 1.0e-7_wp, "maxima")
      end associate
   end subroutine test_maxima

   !> The stiffest block without delay, stopped on the way up and on the way down of a slip, where
   !> steps are far below a spacing of t, ends as in one run.
   subroutine test_slip(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(event_table) :: table
      type(integration_result) :: outcome, whole
      type(spring_block_type) :: problem
      real(wp), parameter :: t_end = 40.0_wp
      integer :: i, runs

      problem = build_block(tau=0.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e12_wp, u=0.5_wp, &
                            v=1.1_wp)
      do i = 1, size(methods)
         if (any(methods(i) == ["explicit", "taylor  "])) cycle
         call run(problem, t_end, at_tolerance(1.0e-10_wp, methods(i)), whole, error)
         continuation = continuation_type()
         table = event_table([3], [20.0_wp], [0], terminal=[.true.])
         do runs = 1, 1000
            call run(problem, t_end, at_tolerance(1.0e-10_wp, methods(i)), outcome, error, &
                     events=table, continuation=continuation)
            if (outcome%reason /= event_met .or. allocated(error)) exit
         end do
         call expect_between(error, real(runs, wp), 3.0_wp, 3.0_wp, "runs of "//methods(i))
         call expect_close(error, outcome%y, whole%y, 1.0e-6_wp, methods(i))
      end do
   end subroutine test_slip

   !> A delay of 1e-3, where the first steps are below the rounding error of the length of a later
   !> one: another method finds the same.
   subroutine test_short_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, radau
      real(wp), parameter :: v(3) = [0.7_wp, 1.1_wp, 1.5_wp], xi(3) = [0.3_wp, 0.5_wp, 0.8_wp]
      real(wp), parameter :: tolerances(3) = [1.0e-3_wp, 1.0e-4_wp, 3.0e-5_wp]
      type(spring_block_type) :: block_model
      integer :: i, j, k

      do i = 1, size(xi)
         do j = 1, size(v)
            block_model = build_block(tau=1.0e-3_wp, epsilon=0.1_wp, xi=xi(i), gamma=1.0e12_wp, &
                                      v=v(j))
            call run(block_model, 20.0_wp, at_tolerance(1.0e-10_wp, "radau9"), radau, error)
            do k = 1, size(tolerances)
               call run(block_model, 20.0_wp, at_tolerance(tolerances(k), "auto"), auto, error)
               if (allocated(error)) return
               call expect_close(error, auto%y, radau%y, 10*tolerances(k), "xi "//text(xi(i)) &
                                 //", v "//text(v(j))//" at "//text(tolerances(k)))
            end do
         end do
      end do
   end subroutine test_short_delay

   !> At high degrees and gamma from 100 to 1e12 `auto` takes at most twice the work of Radau and
   !> two prices.
   subroutine test_tight(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, radau
      real(wp), parameter :: tau(2) = [1.0_wp, 7.0_wp]
      real(wp), parameter :: tolerances(3) = [3.0e-13_wp, 1.0e-13_wp, 1.0e-14_wp]
      type(spring_block_type) :: block_model
      real(wp) :: price
      integer :: i, j, power

      do power = 2, 12, 2
         do i = 1, size(tau)
            block_model = build_block(tau=tau(i), epsilon=0.7_wp, xi=0.5_wp, gamma=10.0_wp**power, &
                                      v=1.5_wp)
            do j = 1, size(tolerances)
               call run(block_model, 20.0_wp, at_tolerance(tolerances(j), "radau13"), radau, error)
               call run(block_model, 20.0_wp, at_tolerance(tolerances(j), "auto"), auto, error)
               if (allocated(error)) return
               price = price_of_trial(block_model, tolerance_type(3, tolerances(j), tolerances(j)))
               call expect(error, auto%work <= 2*(radau%work + price), text(auto%work) &
                           //" by auto, "//text(radau%work)//" by radau13, gamma 1e"//text(power) &
                           //", tau "//text(tau(i))//" at "//text(tolerances(j)))
            end do
         end do
      end do
   end subroutine test_tight
end module test_block_stiff
