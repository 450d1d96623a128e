!> When `auto` leaves explicit steps: whether one along a series is held back by more than the
!> change of the solution.
module test_dde_switch
   use block_builder, only: build_block
   use dde, only: continuation_type, integrate, integration_result
   use dde_methods, only: price_of_trial
   use dde_problem, only: dde_problem_type
   use dde_step_context, only: step_context
   use dde_taylor_step, only: taylor_step_type
   use dde_tolerance, only: tolerance_type
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_success
   use fast_problems, only: plain_block
   use dde_kinds, only: wp
   use lines_of_cells, only: cells
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: switching, switching_kinds
   use published_problems, only: enzyme, infection, mackey_glass
   use single_step, only: new_context
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   use test_problems, only: fill
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_switch

contains

   !> All tests of this suite.
   subroutine collect_dde_switch(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("an oscillation", test_oscillation), &
                   new_unittest("at the limit of stability", test_stability), &
                   new_unittest("at rest", test_rest), &
                   new_unittest("a damped oscillation", test_damped), &
                   new_unittest("a stiff block", test_stiff), &
                   new_unittest("near the end", test_end), &
                   new_unittest("failed tries", test_vain), &
                   new_unittest("cost of changes", test_cost)]
   end subroutine collect_dde_switch

   !> The step that the tolerance allows is not held back, a hundredth of it is.
   subroutine test_oscillation(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits

      do digits = 3, 13, 2
         call expect(error, .not. held_back(swing(), 10.0_wp**(-digits), 1.0_wp), &
                     "free at 1e-"//text(digits))
         call expect(error, held_back(swing(), 10.0_wp**(-digits), 0.01_wp), &
                     "held back at 1e-"//text(digits))
      end do
   end subroutine test_oscillation

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

   !> A stiff block without slow series is left to implicit steps soon.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: digits

      do digits = 3, 11, 2
         call integrate(near_balance(1.0e-2_wp), 0.0_wp, 100.0_wp, &
                        at_tolerance(10.0_wp**(-digits), "auto"), outcome, failure)
         call expect_success(error, failure)
         call expect(error, outcome%accepted < 600, "1e-"//text(digits)//": " &
                     //text(outcome%accepted)//" steps")
         call expect(error, outcome%implicit_steps > 10, "implicit ones")
      end do
   end subroutine test_stiff

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

   !> On problems that jump, change their stiffness or have many delays, and on published ones,
   !> `auto` takes at most twice the work of the better method, and the work that earns a trial.
   !> Where the stiffness changes in each delay the average of five neighbouring tolerances counts:
   !> which trials fail there depends on rounding.
   subroutine test_cost(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: neighbours(5) = [0.9_wp, 0.95_wp, 1.0_wp, 1.05_wp, 1.1_wp]
      integer :: kind, power

      do kind = 1, switching_kinds
         do power = 1, 4, 3
            call compare_work(error, switch(kind, 10.0_wp**power), 30.0_wp, &
                              "switching "//text(kind)//", k = 1e"//text(power), neighbours)
         end do
      end do
      call compare_work(error, infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], &
                                         past=[5.0_wp, 0.1_wp, 1.0_wp], &
                                         first=[5.0_wp, 0.1_wp, 1.0_wp]), 40.0_wp, "infection")
      call compare_work(error, enzyme(n=4, lag=[4.0_wp], component=[4], &
                                      past=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp], &
                                      first=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp]), 160.0_wp, &
                        "enzyme")
      call compare_work(error, mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], &
                                            first=[1.2_wp]), 200.0_wp, "mackey-glass")
      call compare_work(error, cells(60, 100.0_wp, delayed=.true.), 5.0_wp, "cells")
   end subroutine test_cost

   !> The work of `auto` and of the methods that it chooses from.
   subroutine compare_work(error, problem, t_end, name, neighbours)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Final time
      real(wp), intent(in) :: t_end
      !> Its name
      character(len=*), intent(in) :: name
      !> Tolerances over 1e-3 and 1e-6 whose average counts; 1 if not given
      real(wp), intent(in), optional :: neighbours(:)
      type(failure_type), allocatable :: failure
      type(integration_result) :: auto, explicit, implicit
      real(wp), allocatable :: ratios(:)
      real(wp) :: better, price, tolerance, work
      integer :: digits, i

      ratios = [1.0_wp]
      if (present(neighbours)) ratios = neighbours

      do digits = 3, 6, 3
         call integrate(problem, 0.0_wp, t_end, at_tolerance(10.0_wp**(-digits), "explicit"), &
                        explicit, failure)
         call expect_success(error, failure)
         work = 0.0_wp
         better = 0.0_wp
         price = 0.0_wp
         do i = 1, size(ratios)
            tolerance = ratios(i)*10.0_wp**(-digits)
            call integrate(problem, 0.0_wp, t_end, at_tolerance(tolerance, "auto"), auto, failure)
            call expect_success(error, failure)
            call integrate(problem, 0.0_wp, t_end, at_tolerance(tolerance, "radau9"), implicit, &
                           failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            work = work + auto%work/size(ratios)
            better = better + min(explicit%work, implicit%work)/size(ratios)
            price = price + price_of_trial(problem, tolerance_type(problem%n, tolerance, &
                                                                   tolerance))/size(ratios)
         end do
         call expect(error, work <= 2*better + 2*price, &
                     name//" at 1e-"//text(digits)//": "//text(work)//" by auto, " &
                     //text(explicit%work)//" by explicit, "//text(implicit%work)//" by radau, " &
                     //text(auto%switches)//" changes")
      end do
   end subroutine compare_work

   !> A problem that switches.
   type(switching) function switch(kind, k) result(problem)
      !> Which one
      integer, intent(in) :: kind
      !> Its fast rate
      real(wp), intent(in) :: k

      call fill(problem, 2, [0.5_wp, 0.5_wp], [0.5_wp, 0.5_wp], [1.0_wp, 1.0_wp], [1, 2])
      problem%kind = kind
      problem%k = k
   end function switch

   !> Whether a step from the start is held back.
   function held_back(problem, tolerance, share) result(value)
      !> The problem, without delays
      class(dde_problem_type), intent(in), target :: problem
      !> Absolute tolerance
      real(wp), intent(in) :: tolerance
      !> Its length over that which the series allows
      real(wp), intent(in) :: share
      logical :: value
      type(step_context) :: context
      type(taylor_step_type) :: step
      real(wp) :: estimate, length

      step = taylor_step_type(problem, tolerance)
      context = new_context(problem, 0.0_wp, 1.0e3_wp, 0.0_wp, tolerance)
      length = 1.0e-6_wp
      call step%propose(context, length)
      context%cursor%h = share*length
      call step%attempt(context, estimate)
      value = step%stiff()
   end function held_back

   !> A block at gamma = 1000 without delay and without slow series, its w a little above balance,
   !> sliding at rest but for that.
   pure type(plain_block) function near_balance(above) result(problem)
      !> How much
      real(wp), intent(in) :: above

      problem%spring_block_type = build_block(tau=0.0_wp, epsilon=0.0_wp, xi=1.0_wp, &
                                              gamma=1.0e3_wp, v=exp(above))
   end function near_balance
end module test_dde_switch
