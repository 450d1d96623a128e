!> Runs of the block: by Taylor series, with and without slow ones; when `auto` leaves them for
!> implicit steps.
module test_block_runs
   use block_builder, only: build_block
   use dde, only: continuation_type, integrate, integration_options, integration_result, &
                  too_many_steps, value_not_finite
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close
   use problem_runs, only: run
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use plain_blocks, only: plain_block
   use single_step, only: held_back
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_block_runs

   !> The method itself, and the one that begins with it.
   character(len=8), parameter :: both(2) = ["taylor  ", "auto    "]

contains

   subroutine collect_block_runs(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("error follows tolerance", test_proportional), &
                   new_unittest("a series that is not finite", test_not_finite), &
                   new_unittest("stiff blocks", test_blocks), &
                   new_unittest("the stick before a slip", test_stick), &
                   new_unittest("a block without slow series", test_plain), &
                   new_unittest("steps longer than the delay", test_short_delay), &
                   new_unittest("at rest", test_rest), &
                   new_unittest("at the limit of stability", test_stability), &
                   new_unittest("at rest", test_held_at_rest), &
                   new_unittest("a damped oscillation", test_damped), &
                   new_unittest("near the end", test_end), &
                   new_unittest("failed tries", test_vain)]
   end subroutine collect_block_runs

   !> The error at t = 100 stays below 100 times the tolerance, and falls with it.
   subroutine test_proportional(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      integer :: i

      call run(torus(), 100.0_wp, at_tolerance(1.0e-13_wp, "radau13"), known, error)
      do i = 2, 12
         call run(torus(), 100.0_wp, at_tolerance(10.0_wp**(-i), "taylor"), outcome, error)
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
   type(spring_block_type) function torus() result(problem)
      problem = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.5_wp)
   end function torus

   !> Blocks up to gamma = 1e12, as by the implicit method, in few steps and without implicit ones
   !> but for a try.
   subroutine test_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      type(spring_block_type) :: problem
      real(wp), parameter :: gamma(4) = [1.0e4_wp, 1.0e6_wp, 1.0e9_wp, 1.0e12_wp]
      integer :: delays, i, j, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=1.0_wp*delays, epsilon=0.7_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            call run(problem, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known, error)
            do j = 3, 11, 2
               do k = 1, 2
                  call run(problem, 20.0_wp, at_tolerance(10.0_wp**(-j), both(k)), outcome, error)
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
      type(spring_block_type) :: problem
      integer :: i, j

      problem = build_block(tau=0.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, u=50.0_wp, &
                            v=1.1_wp)
      call run(problem, 45.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known, error)
      do j = 4, 10, 2
         do i = 1, 2
            call run(problem, 45.0_wp, at_tolerance(10.0_wp**(-j), both(i)), outcome, error)
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
      call run(problem, 20.0_wp, at_tolerance(1.0e-12_wp, "radau13"), known, error)
      do i = 3, 11, 2
         call run(problem, 20.0_wp, at_tolerance(10.0_wp**(-i), "auto"), outcome, error)
         call expect_close(error, outcome%y, known%y, 1000*10.0_wp**(-i), "1e-"//text(i))
         call expect_between(error, real(outcome%accepted, wp), 30.0_wp, 400.0_wp, "steps")
         call expect(error, outcome%implicit_steps > 10, "implicit steps")
      end do
   end subroutine test_plain

   !> Where the delay is short, `auto` takes implicit steps that are longer.
   subroutine test_short_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome

      call run(build_block(tau=1.0e-3_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e6_wp, v=1.1_wp), &
               20.0_wp, at_tolerance(1.0e-6_wp, "auto"), outcome, error)
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
            call run( &
                     build_block(10.0_wp*i, 0.2_wp, 0.8_wp, 0.8_wp, v=1.1_wp), &
                     1.0e6_wp, at_tolerance(10.0_wp**(-j), "auto"), outcome, error)
            call expect_between(error, real(outcome%accepted, wp), 20.0_wp, 4000.0_wp, &
                                "steps at 1e-"//text(j))
         end do
      end do
   end subroutine test_rest

   !> A block without slow series, on its way to balance and within the tolerance of it.
   subroutine test_stability(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, held_back(near_balance(1.0e-8_wp), 1.0e-6_wp, 1.0_wp), "near balance")
      call expect(error, .not. held_back(near_balance(1.0e-2_wp), 1.0e-6_wp, 1.0_wp), &
                  "on the way there")
   end subroutine test_stability

   !> Where all changes are below the tolerance any step is held back.
   subroutine test_held_at_rest(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, held_back(near_balance(0.0_wp), 1.0e-4_wp, 1.0_wp), "at rest")
   end subroutine test_held_at_rest

   !> As long as an oscillation that dies out can be seen no implicit step is tried: it is 1e-3 at
   !> the end.
   subroutine test_damped(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(spring_block_type) :: problem
      integer :: digits

      problem = build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
      do digits = 5, 11, 2
         call run(problem, 400.0_wp, at_tolerance(10.0_wp**(-digits), "auto"), outcome, error)
         call expect(error, outcome%implicit_steps == 0, "1e-"//text(digits))
      end do
   end subroutine test_damped

   !> Where few explicit steps are left no implicit one is tried, however much they are held back,
   !> unless the run may go on.
   subroutine test_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(continuation_type) :: kept
      real(wp), parameter :: t_end(2) = [4.0e-4_wp, 2.0_wp]
      integer :: i

      do i = 1, size(t_end)
         call run(near_balance(1.0e-8_wp), t_end(i), at_tolerance(1.0e-6_wp, "auto"), outcome, &
                  error)
         call expect(error, outcome%implicit_steps > 0 .eqv. i == 2, text(outcome%implicit_steps) &
                     //" of "//text(outcome%accepted)//" steps to "//text(t_end(i)))
      end do
      call run(near_balance(1.0e-8_wp), t_end(1), at_tolerance(1.0e-6_wp, "auto"), outcome, error, &
               continuation=kept)
      call expect(error, outcome%implicit_steps > 0, "none in a run that may go on")
   end subroutine test_end

   !> Between the slips of a block at gamma = 0.8 an implicit step is hardly longer than one along
   !> the series: a try is given up after three or a few more.
   subroutine test_vain(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      integer :: digits

      do digits = 5, 7
         call run(build_block(tau=0.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, v=1.1_wp), &
                  300.0_wp, at_tolerance(10.0_wp**(-digits), "auto"), outcome, error)
         call expect(error, outcome%switches > 0, "a try at 1e-"//text(digits))
         call expect(error, outcome%implicit_steps <= 2*outcome%switches, &
                     text(outcome%implicit_steps)//" implicit steps, " &
                     //text(outcome%switches)//" changes of method")
      end do
   end subroutine test_vain

   !> A block at gamma = 1000 without delay and without slow series, its w a little above balance,
   !> sliding at rest but for that.
   pure type(plain_block) function near_balance(above) result(problem)
      real(wp), intent(in) :: above

      problem%spring_block_type = build_block(tau=0.0_wp, epsilon=0.0_wp, xi=1.0_wp, &
                                              gamma=1.0e3_wp, v=exp(above))
   end function near_balance
end module test_block_runs
