!> When `auto` leaves the series of the block for implicit steps.
module test_block_auto
   use block_builder, only: build_block
   use dde, only: continuation_type, integrate, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use plain_blocks, only: plain_block
   use single_step, only: held_back
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_block_auto

contains

   !> All tests of this suite.
   subroutine collect_block_auto(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("at the limit of stability", test_stability), &
                   new_unittest("at rest", test_rest), &
                   new_unittest("a damped oscillation", test_damped), &
                   new_unittest("near the end", test_end), &
                   new_unittest("failed tries", test_vain)]
   end subroutine collect_block_auto

   !> A block without slow series, on its way to balance and within the tolerance of it.
   subroutine test_stability(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, held_back(near_balance(1.0e-8_wp), 1.0e-6_wp, 1.0_wp), "near balance")
      call expect(error, .not. held_back(near_balance(1.0e-2_wp), 1.0e-6_wp, 1.0_wp), &
                  "on the way there")
   end subroutine test_stability

   !> Where all changes are below the tolerance any step is held back.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, held_back(near_balance(0.0_wp), 1.0e-4_wp, 1.0_wp), "at rest")
   end subroutine test_rest

   !> As long as an oscillation that dies out can be seen no implicit step is tried: it is 1e-3 at
   !> the end.
   subroutine test_damped(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(spring_block_type) :: problem
      integer :: digits

      problem = build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
      do digits = 5, 11, 2
         call integrate(problem, 0.0_wp, 400.0_wp, at_tolerance(10.0_wp**(-digits), "auto"), &
                        outcome, failure)
         call expect_success(error, failure)
         call expect(error, outcome%implicit_steps == 0, "1e-"//text(digits))
      end do
   end subroutine test_damped

   !> Where few explicit steps are left no implicit one is tried, however much they are held back,
   !> unless the run may go on.
   subroutine test_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(continuation_type) :: kept
      real(wp), parameter :: t_end(2) = [4.0e-4_wp, 2.0_wp]
      integer :: i

      do i = 1, size(t_end)
         call integrate(near_balance(1.0e-8_wp), 0.0_wp, t_end(i), &
                        at_tolerance(1.0e-6_wp, "auto"), outcome, failure)
         call expect_success(error, failure)
         call expect(error, outcome%implicit_steps > 0 .eqv. i == 2, text(outcome%implicit_steps) &
                     //" of "//text(outcome%accepted)//" steps to "//text(t_end(i)))
      end do
      call integrate(near_balance(1.0e-8_wp), 0.0_wp, t_end(1), at_tolerance(1.0e-6_wp, "auto"), &
                     outcome, failure, continuation=kept)
      call expect_success(error, failure)
      call expect(error, outcome%implicit_steps > 0, "none in a run that may go on")
   end subroutine test_end

   !> Between the slips of a block at gamma = 0.8 an implicit step is hardly longer than one along
   !> the series: a try is given up after three or a few more.
   subroutine test_vain(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: digits

      do digits = 5, 7
         call integrate(build_block(tau=0.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp, &
                                    v=1.1_wp), 0.0_wp, 300.0_wp, &
                        at_tolerance(10.0_wp**(-digits), "auto"), outcome, failure)
         call expect_success(error, failure)
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
end module test_block_auto
