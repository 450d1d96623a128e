!> Slow series: the balance they keep, when steps take them, what they pass over, and `auto` with
!> them.
module test_dde_slow_series
   use block_builder, only: build_block
   use dde, only: integrate, integration_options, integration_result, too_many_steps
   use dde_interpolant, only: series_value
   use dde_slow_series, only: series_reach
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use fast_problems, only: follower, plain_block, pulse
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, solve
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_dde_slow_series

   !> The method itself, and the one that begins with it.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "]

contains

   !> All tests of this suite.
   subroutine collect_dde_slow_series(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("how far series reach", test_reach), &
                   new_unittest("slow series of the block", test_block_series), &
                   new_unittest("a follower", test_follower), &
                   new_unittest("a transient", test_transient), &
                   new_unittest("a layer that counts", test_layer), &
                   new_unittest("a pulse", test_pulse), &
                   new_unittest("stiff blocks", test_blocks), &
                   new_unittest("the stick before a slip", test_stick), &
                   new_unittest("a block without", test_plain), &
                   new_unittest("steps longer than the delay", test_short_delay), &
                   new_unittest("at rest", test_rest)]
   end subroutine collect_dde_slow_series

   !> Very small terms that grow do not reach as far as the tolerance would let them; one that
   !> vanishes, or all, are no limit.
   subroutine test_reach(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: reach, series(0:8, 1)
      integer :: k

      ! exp(4 s) - 1 in units of 1e-30: terms grow up to s = 2 and beyond fall
      series(:, 1) = [(1.0e-30_wp*4.0_wp**k/gamma(k + 1.0_wp), k=0, 8)]
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect_close(error, reach, 0.9_wp*2.0_wp, 1.0e-14_wp, "eight over four")
      series(7, 1) = 0.0_wp
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect_close(error, reach, 0.9_wp*sqrt(7*8/16.0_wp), 1.0e-14_wp, "a term vanishes")
      series(:, 1) = 1.0_wp
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect_close(error, reach, 0.9_wp*1.0e-6_wp**(1.0_wp/7), 1.0e-14_wp, "all terms 1")
      series(1:, 1) = 0.0_wp
      call series_reach(8, series, [1.0e-6_wp], reach)
      call expect(error, reach > 1.0e14_wp, "a constant")
   end subroutine test_reach

   !> Iterated from a state, the slow series of the block balances w, with theta and u by (4).
   subroutine test_block_series(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 14
      real(wp), parameter :: gamma(3) = [1.0e3_wp, 1.0e6_wp, 1.0e12_wp], s = 0.7_wp
      type(spring_block_type) :: problem
      real(wp) :: found(3), rises(0:degree - 1, 3), slope(3), state(3), v, y(0:degree, 3)
      real(wp), allocatable :: z(:, :)
      real(wp), parameter :: unit = 0.05_wp
      integer :: delays, i, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.6_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            allocate (z(0:degree, delays), source=0.0_wp)
            if (delays > 0) z(:3, 1) = [0.2_wp, -0.1_wp, 0.03_wp, 0.01_wp]
            y = 0.0_wp
            y(0, :) = [0.4_wp, -0.3_wp, 5.0_wp]
            do k = 1, 4
               call problem%slow_series(0.0_wp, unit, degree, z, y)
            end do
            state = [(series_value(degree, y(:, k), s), k=1, 3)]
            rises = spread([(k, k=1, degree)], 2, 3)*y(1:, :)
            found = [(series_value(degree - 1, rises(:, k), s), k=1, 3)]/unit
            v = exp(state(3))
            call problem%rhs(0.0_wp, state, [(series_value(degree, z(:, k), s), k=1, delays)], &
                             slope)
            call expect_close(error, found(:2), slope(:2), 1.0e-12_wp, "theta and u")
            call expect_close(error, state(3), -state(1) - 0.5_wp*state(2) &
                              - 0.5_wp/gamma(i)**2*v*found(3), 1.0e-14_wp, &
                              "balance at gamma = "//text(gamma(i)))
            deallocate (z)
         end do
      end do
   end subroutine test_block_series

   !> The exact solution within ten tolerances, whatever the rate, in few steps.
   subroutine test_follower(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(follower) :: problem
      type(integration_result) :: outcome
      real(wp), parameter :: rate(5) = [1.0e2_wp, 1.0e4_wp, 1.0e6_wp, 1.0e9_wp, 1.0e12_wp]
      integer :: i, j, k

      do i = 1, size(rate)
         problem = follower(rate(i), start=2.0_wp)
         do j = 4, 12, 2
            do k = 1, 2
               call integrate(problem, 0.0_wp, 20.0_wp, at_tolerance(10.0_wp**(-j), both(k)), &
                              outcome, failure)
               call expect_success(error, failure)
               call expect_close(error, outcome%y, problem%exact(20.0_wp), 10*10.0_wp**(-j), &
                                 trim(both(k))//" at rate "//text(rate(i))//", 1e-"//text(j))
               call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 400.0_wp, &
                                   "steps at rate "//text(rate(i))//", 1e-"//text(j))
            end do
         end do
      end do
   end subroutine test_follower

   !> A transient towards the balance is followed as long as it is seen.
   subroutine test_transient(error)
      type(error_type), allocatable, intent(out) :: error
      type(follower) :: problem
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: rate = 1.0e6_wp, times(4) = [1.0_wp, 3.0_wp, 10.0_wp, 30.0_wp]/rate
      real(wp) :: exact(2, 4)
      integer :: i

      problem = follower(rate, start=2.0_wp)
      do i = 1, size(times)
         exact(:, i) = problem%exact(times(i))
      end do
      do i = 1, size(both)
         call solve(problem, times, at_tolerance(1.0e-9_wp, both(i)), y, error)
         call expect_close(error, y(1, :), exact(1, :), 1.0e-8_wp, both(i))
      end do
   end subroutine test_transient

   !> One delay later the transient changes y2 by 1/rate, which is followed where it counts.
   subroutine test_layer(error)
      type(error_type), allocatable, intent(out) :: error
      type(follower) :: problem
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: times(3) = [1.001_wp, 1.1_wp, 1.5_wp]
      real(wp) :: exact(2, 3)
      integer :: i, j

      do j = 3, 9, 2
         problem = follower(10.0_wp**j, start=2.0_wp)
         do i = 1, size(times)
            exact(:, i) = problem%exact(times(i))
         end do
         do i = 1, size(both)
            call solve(problem, times, at_tolerance(1.0e-10_wp, both(i)), y, error)
            call expect_close(error, y(2, :), exact(2, :), 1.0e-9_wp, &
                              both(i)//" at rate 1e"//text(j))
         end do
      end do
   end subroutine test_layer

   !> A pulse that comes and goes within a step of what follows it is not overlooked.
   subroutine test_pulse(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: width = 1.0e-3_wp
      integer :: i, j

      do i = 1, size(both)
         do j = 4, 10, 2
            call solve(pulse(width), [2.0_wp], at_tolerance(10.0_wp**(-j), both(i)), y, error)
            call expect_close(error, y(2, :), [2*width*atan(0.5_wp/width)], 10*10.0_wp**(-j), &
                              both(i)//" at 1e-"//text(j))
         end do
      end do
   end subroutine test_pulse

   !> Blocks up to gamma = 1e12, as by the implicit method, in few steps and without implicit ones
   !> but for a try.
   subroutine test_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: known, outcome
      type(spring_block_type) :: problem
      real(wp), parameter :: gamma(4) = [1.0e4_wp, 1.0e6_wp, 1.0e9_wp, 1.0e12_wp]
      integer :: delays, i, j, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=1.0_wp*delays, epsilon=0.7_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            call integrate(problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known, &
                           failure)
            call expect_success(error, failure)
            do j = 3, 11, 2
               do k = 1, 2
                  call integrate(problem, 0.0_wp, 20.0_wp, at_tolerance(10.0_wp**(-j), both(k)), &
                                 outcome, failure)
                  call expect_success(error, failure)
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
      type(failure_type), allocatable :: failure
      type(integration_result) :: known, outcome
      type(spring_block_type) :: problem
      integer :: i, j

      problem = build_block(tau=0.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, u=50.0_wp, &
                            v=1.1_wp)
      call integrate(problem, 0.0_wp, 45.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known, failure)
      call expect_success(error, failure)
      do j = 4, 10, 2
         do i = 1, 2
            call integrate(problem, 0.0_wp, 45.0_wp, at_tolerance(10.0_wp**(-j), both(i)), &
                           outcome, failure)
            call expect_success(error, failure)
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

      problem%spring_block_type = build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, &
                                              gamma=1.0e4_wp, v=1.1_wp)
      options = at_tolerance(1.0e-6_wp, "taylor")
      options%most_steps = 10000
      call integrate(problem, 0.0_wp, 20.0_wp, options, outcome, failure)
      call expect(error, outcome%reason == too_many_steps, "the reason is `too_many_steps`")
      call integrate(problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known, failure)
      call expect_success(error, failure)
      do i = 3, 11, 2
         call integrate(problem, 0.0_wp, 20.0_wp, at_tolerance(10.0_wp**(-i), "auto"), outcome, &
                        failure)
         call expect_success(error, failure)
         call expect_close(error, outcome%y, known%y, 1000*10.0_wp**(-i), "1e-"//text(i))
         call expect_between(error, real(outcome%accepted, wp), 30.0_wp, 400.0_wp, "steps")
         call expect(error, outcome%implicit_steps > 10, "implicit steps")
      end do
   end subroutine test_plain

   !> Where the delay is short, `auto` takes implicit steps that are longer.
   subroutine test_short_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome

      call integrate(build_block(tau=1.0e-3_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e6_wp, &
                                 v=1.1_wp), &
                     0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "auto"), outcome, failure)
      call expect_success(error, failure)
      call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 2000.0_wp, "steps")
      call expect(error, outcome%implicit_steps > 5, "implicit steps")
   end subroutine test_short_delay

   !> Where the block is at rest, `auto` takes implicit steps without end.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i, j

      do i = 0, 1
         do j = 4, 10, 2
            call integrate(build_block(tau=10.0_wp*i, epsilon=0.2_wp, xi=0.8_wp, gamma=0.8_wp, &
                                       v=1.1_wp), &
                           0.0_wp, 1.0e6_wp, at_tolerance(10.0_wp**(-j), "auto"), outcome, failure)
            call expect_success(error, failure)
            call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 4000.0_wp, &
                                "steps at 1e-"//text(j))
         end do
      end do
   end subroutine test_rest
end module test_dde_slow_series
