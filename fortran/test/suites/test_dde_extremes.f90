!> Events and continuations where it is hard: in stiff runs, and in steps far below a spacing of t.
module test_dde_extremes
   use block_builder, only: build_block
   use dde, only: continuation_type, elapsed, event_met, event_table, instant, integrate, &
                  integration_options, integration_result, methods, too_many_steps
   use dde_methods, only: price_of_trial
   use dde_tolerance, only: tolerance_type
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance
   use spring_block, only: index_of_ln_v, spring_block_type
   use stiff_problems, only: prothero_robinson
   use test_problems, only: linear
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_extremes

   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> All tests of this suite.
   subroutine collect_dde_extremes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("events of stiff relaxation", test_stiff), &
                   new_unittest("maxima of v at gamma 1e6", test_block), &
                   new_unittest("events within a spacing of t", test_events), &
                   new_unittest("a slope that jumps", test_jump), &
                   new_unittest("a zero where runs meet", test_zero_between), &
                   new_unittest("runs within a spacing of t", test_runs), &
                   new_unittest("in the middle of a slip", test_slip), &
                   new_unittest("auto at gamma 1e12", test_short_delay), &
                   new_unittest("auto at tight tolerances", test_tight)]
   end subroutine collect_dde_extremes

   !> A delay of 1e-3, where the first steps are below the rounding error of the length of a later
   !> one: another method finds the same.
   subroutine test_short_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: auto, radau
      real(wp), parameter :: v(3) = [0.7_wp, 1.1_wp, 1.5_wp], xi(3) = [0.3_wp, 0.5_wp, 0.8_wp]
      real(wp), parameter :: tolerances(3) = [1.0e-3_wp, 1.0e-4_wp, 3.0e-5_wp]
      type(spring_block_type) :: block_model
      integer :: i, j, k

      do i = 1, size(xi)
         do j = 1, size(v)
            block_model = build_block(tau=1.0e-3_wp, epsilon=0.1_wp, xi=xi(i), gamma=1.0e12_wp, &
                                      v=v(j))
            call integrate(block_model, 0.0_wp, 20.0_wp, at_tolerance(1.0e-10_wp, "radau9"), &
                           radau, failure)
            call expect_success(error, failure)
            do k = 1, size(tolerances)
               call integrate(block_model, 0.0_wp, 20.0_wp, at_tolerance(tolerances(k), "auto"), &
                              auto, failure)
               call expect_success(error, failure)
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
      type(failure_type), allocatable :: failure
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
               call integrate(block_model, 0.0_wp, 20.0_wp, &
                              at_tolerance(tolerances(j), "radau13"), radau, failure)
               call expect_success(error, failure)
               call integrate(block_model, 0.0_wp, 20.0_wp, at_tolerance(tolerances(j), "auto"), &
                              auto, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               price = price_of_trial(block_model, tolerance_type(3, tolerances(j), tolerances(j)))
               call expect(error, auto%work <= 2*(radau%work + price), text(auto%work) &
                           //" by auto, "//text(radau%work)//" by radau13, gamma 1e"//text(power) &
                           //", tau "//text(tau(i))//" at "//text(tolerances(j)))
            end do
         end do
      end do
   end subroutine test_tight

   !> cos t = 1/2 with a rate of -1e6, in steps far longer than its inverse.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         if (any(methods(i) == ["explicit", "taylor  "])) cycle
         table = event_table([1], [0.5_wp], [0])
         call integrate(prothero_robinson(-1.0e6_wp), 0.0_wp, 10.0_wp, &
                        at_tolerance(1.0e-10_wp, methods(i)), outcome, failure, watcher=table)
         call expect_success(error, failure)
         call expect_close(error, table%time(:table%received)%hi, &
                           [pi/3, 5*pi/3, 7*pi/3], 1.0e-8_wp, methods(i))
      end do
   end subroutine test_stiff

   !> Slips of the stiff block: at a maximum of v forces balance, u + (theta + ln v)/xi = 0, and a
   !> method of another order finds the same. The first shock, of a few 1e-12, dies out in maxima
   !> below the tolerance, which are left aside.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: one, other
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      integer :: i

      block_model = build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e6_wp, v=1.5_wp)
      one = event_table([index_of_ln_v], [0.0_wp], [-1], of_slope=[.true.])
      other = one
      call integrate(block_model, 0.0_wp, 20.0_wp, at_tolerance(1.0e-11_wp, "auto"), outcome, &
                     failure, watcher=one)
      call expect_success(error, failure)
      call integrate(block_model, 0.0_wp, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), outcome, &
                     failure, watcher=other)
      call expect_success(error, failure)
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
   end subroutine test_block

   !> An oscillator at t = 100 with a period of half a spacing of t: maxima a period apart.
   subroutine test_events(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      real(wp), parameter :: period = 2.0_wp**(-47)
      integer :: i

      table = event_table([1], [0.0_wp], [-1], of_slope=[.true.])
      call integrate(swing(2*pi/period), 100.0_wp, 100.0_wp + 20*period, &
                     at_tolerance(1.0e-12_wp), outcome, failure, watcher=table)
      call expect_success(error, failure)
      call expect_between(error, real(table%received, wp), 19.0_wp, 20.0_wp, "maxima")
      if (allocated(error)) return
      call expect_close(error, [(elapsed(instant(100.0_wp), table%time(i))/(i*period), i=1, 19)], &
                        spread(1.0_wp, 1, 19), 1.0e-9_wp, "time in periods")
   end subroutine test_events

   !> y' = -y(t - 1) from y = 0 with a jump to 1 at t = 0: the slope jumps from 0 to -1 at t = 1
   !> and passes -1/2 there, and again at 5/2 on its way up from -1 to 0.
   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         table = event_table([1], [-0.5_wp], [0], of_slope=[.true.])
         call integrate(linear(n=1, lag=[1.0_wp], component=[1], past=[0.0_wp], first=[1.0_wp]), &
                        0.0_wp, 2.9_wp, at_tolerance(1.0e-10_wp, methods(i)), outcome, failure, &
                        watcher=table)
         call expect_success(error, failure)
         call expect_close(error, table%time(:table%received)%hi, [1.0_wp, 2.5_wp], 1.0e-9_wp, &
                           methods(i))
         call expect_close(error, table%time(1)%hi, 1.0_wp, 0.0_wp, methods(i))
      end do
   end subroutine test_jump

   !> Zeros and extremes of cos t where runs end, and amid runs so short that rounding is all that
   !> their dense output shows: each is met once. A Newton iteration leaves rounding in its slopes
   !> at the ends, and a series what follows its last term, so that only the explicit pair is asked
   !> for all.
   subroutine test_zero_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: table
      type(continuation_type) :: continuation
      real(wp) :: little
      integer :: i, j, k

      do i = 1, size(methods)
         do j = 0, 2
            little = j*merge(1.0e-14_wp, 1.0e-5_wp, methods(i) == "explicit")
            table = event_table([1, 1], [0.0_wp, 0.0_wp], [0, 0], of_slope=[.false., .true.])
            continuation = continuation_type()
            do k = 1, 12
               call go_on(error, methods(i), 0.5_wp*k*pi - little, table, continuation)
               if (j > 0) call go_on(error, methods(i), 0.5_wp*k*pi + little, table, continuation)
            end do
            call go_on(error, methods(i), 6.2_wp*pi, table, continuation)
            call expect(error, table%received == 12, text(table%received)//" events, "//methods(i))
            if (allocated(error)) return
            call expect_close(error, table%time(:12)%hi, [(0.5_wp*k*pi, k=1, 12)], 1.0e-8_wp, &
                              methods(i))
         end do
      end do
   end subroutine test_zero_between

   !> An oscillator goes on, watched.
   subroutine go_on(error, method, t_end, table, continuation)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The method
      character(len=*), intent(in) :: method
      !> Final time
      real(wp), intent(in) :: t_end
      !> The watcher
      type(event_table), intent(inout) :: table
      !> Where it stands
      type(continuation_type), intent(inout) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(swing(), continuation%time(1), t_end, at_tolerance(1.0e-10_wp, method), &
                     outcome, failure, watcher=table, continuation=continuation)
      call expect_success(error, failure)
   end subroutine go_on

   !> A fast oscillator at t = 100, whose phase is lost with less than a spacing of t, in runs of a
   !> hundred steps.
   subroutine test_runs(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp), parameter :: spacing_of_100 = 2.0_wp**(-46), turns = 1.1_wp*128
      real(wp) :: t_start
      integer :: i, runs

      do i = 1, size(methods)
         options = at_tolerance(1.0e-12_wp, methods(i))
         options%most_steps = 100
         continuation = continuation_type()
         t_start = 100.0_wp
         do runs = 1, 1000
            call integrate(swing(turns*2*pi/(64*spacing_of_100)), t_start, &
                           100.0_wp + 64*spacing_of_100, options, outcome, failure, &
                           continuation=continuation)
            t_start = outcome%t
            if (outcome%reason /= too_many_steps) exit
         end do
         call expect_success(error, failure)
         call expect(error, runs > 3, "several runs")
         call expect_close(error, outcome%y, [cos(turns*2*pi), -sin(turns*2*pi)], 1.0e-8_wp, &
                           methods(i))
      end do
   end subroutine test_runs

   !> The stiffest block without delay, stopped on the way up and on the way down of a slip, where
   !> steps are far below a spacing of t, ends as in one run.
   subroutine test_slip(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(event_table) :: table
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome, whole
      type(spring_block_type) :: problem
      real(wp), parameter :: t_end = 40.0_wp
      integer :: i, runs

      problem = build_block(tau=0.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e12_wp, u=0.5_wp, &
                            v=1.1_wp)
      do i = 1, size(methods)
         if (any(methods(i) == ["explicit", "taylor  "])) cycle
         call integrate(problem, 0.0_wp, t_end, at_tolerance(1.0e-10_wp, methods(i)), whole, &
                        failure)
         call expect_success(error, failure)
         continuation = continuation_type()
         table = event_table([3], [20.0_wp], [0], terminal=[.true.])
         do runs = 1, 1000
            call integrate(problem, continuation%time(1), t_end, &
                           at_tolerance(1.0e-10_wp, methods(i)), outcome, failure, &
                           watcher=table, continuation=continuation)
            call expect_success(error, failure)
            if (outcome%reason /= event_met .or. allocated(error)) exit
         end do
         call expect_between(error, real(runs, wp), 3.0_wp, 3.0_wp, "runs of "//methods(i))
         call expect_close(error, outcome%y, whole%y, 1.0e-6_wp, methods(i))
      end do
   end subroutine test_slip
end module test_dde_extremes
