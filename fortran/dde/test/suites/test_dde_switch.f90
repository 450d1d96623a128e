! SPDX-License-Identifier: BSD-3-Clause
!> When `auto` changes the method, what that costs, and how work is counted.
module test_dde_switch
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: dde_problem_type, integration_result
   use dde_errors, only: text
   use dde_methods, only: price_of_trial
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: wp
   use dde_work, only: work_type
   use expectations, only: expect, expect_close
   use fast_problems, only: follower
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: piecewise, switching_kinds
   use published_problems, only: enzyme, infection, mackey_glass
   use single_step, only: held_back
   use solving, only: at_tolerance, run
   use stiff_problems, only: sdisc
   use test_problems, only: fill, sine
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_switch

   !> A fast component whose slow series is not found.
   type, extends(follower) :: without_slow_series
   contains
      procedure :: slow_series => not_found
   end type without_slow_series

   !> Tolerances whose average counts, over one of them.
   real(wp), parameter :: neighbours(5) = [0.9_wp, 0.95_wp, 1.0_wp, 1.05_wp, 1.1_wp]

contains

   subroutine collect_dde_switch(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("an oscillation", test_oscillation), &
                   new_unittest("cost of changes", test_cost), &
                   new_unittest("layers after each delay", test_layers), &
                   new_unittest("series that are never found", test_lost_series), &
                   new_unittest("work of three methods in turn", test_methods), &
                   new_unittest("work of a run", test_run)]
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

   !> On problems that jump or change their stiffness, and on published ones,
   !> `auto` takes at most twice the work of the better method, and the work that earns a trial.
   !> Where the stiffness changes in each delay the average of five neighbouring tolerances counts:
   !> which trials fail there depends on rounding.
   subroutine test_cost(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: kind, power

      do kind = 1, switching_kinds
         do power = 1, 4, 3
            call compare_work(error, switch(kind, 10.0_wp**power), 30.0_wp, &
                              "switching "//text(kind)//", k = 1e"//text(power), changing=.true.)
         end do
      end do
      call compare_work(error, infection(), 40.0_wp, "infection")
      call compare_work(error, enzyme(), 160.0_wp, "enzyme")
      call compare_work(error, mackey_glass(), 200.0_wp, "mackey-glass")
   end subroutine test_cost

   !> In layers both methods are equally fast; elsewhere explicit steps are out of the question.
   !> On the average of five neighbouring tolerances `auto` takes at most twice the work of the
   !> implicit method. Both agree with the method of order 13.
   subroutine test_layers(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, implicit, reference
      type(sdisc) :: problem
      real(wp) :: better, price, tolerance, work
      integer :: digits, i

      problem = sdisc()
      call run(error, problem, 0.0_wp, 20.5_wp, at_tolerance(1.0e-9_wp, "radau13"), reference)
      do digits = 3, 6, 3
         work = 0.0_wp
         better = 0.0_wp
         do i = 1, size(neighbours)
            tolerance = neighbours(i)*10.0_wp**(-digits)
            call run(error, problem, 0.0_wp, 20.5_wp, at_tolerance(tolerance, "auto"), auto)
            call run(error, problem, 0.0_wp, 20.5_wp, at_tolerance(tolerance, "radau9"), implicit)
            if (allocated(error)) return
            call expect_close(error, auto%y, reference%y, 10*tolerance, "by auto")
            call expect_close(error, implicit%y, reference%y, 10*tolerance, "by radau9")
            work = work + auto%work
            better = better + implicit%work
         end do
         price = price_of_trial(problem, tolerance_type(1, tolerance, tolerance))
         call expect(error, work <= 2*better + 2*price*size(neighbours), &
                     text(work)//" by auto, "//text(better)//" by radau9")
      end do
   end subroutine test_layers

   !> The component is in balance, but its slow series is not found: all trials of the explicit
   !> method fail, at steps of 1e-22. Implicit steps do not begin so short after each of them.
   subroutine test_lost_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, implicit
      type(without_slow_series) :: problem

      problem%follower = follower(1.0e22_wp, 0.0_wp)
      call run(error, problem, 0.0_wp, 5.0_wp, at_tolerance(1.0e-8_wp, "auto"), auto)
      call run(error, problem, 0.0_wp, 5.0_wp, at_tolerance(1.0e-8_wp, "radau9"), implicit)
      if (allocated(error)) return
      call expect(error, auto%switches > 1, "trials of the explicit method")
      call expect(error, auto%work <= 2*implicit%work, &
                  text(auto%work)//" by auto, "//text(implicit%work)//" by radau9")
      call expect_close(error, auto%y, problem%exact(5.0_wp), 1.0e-7_wp, "by auto")
   end subroutine test_lost_series

   !> No number.
   pure subroutine not_found(self, t, unit, degree, z, y)
      class(without_slow_series), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      y = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine not_found

   !> The work of `auto` and of the methods that it chooses from.
   subroutine compare_work(error, problem, t_end, name, changing)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_end
      character(len=*), intent(in) :: name
      !> Whether the average over neighbouring tolerances counts; not if not given
      logical, intent(in), optional :: changing
      type(integration_result) :: auto, explicit, implicit
      real(wp), allocatable :: ratios(:)
      real(wp) :: better, price, tolerance, work
      integer :: digits, i

      ratios = [1.0_wp]
      if (present(changing)) ratios = neighbours
      do digits = 3, 6, 3
         call run(error, problem, 0.0_wp, t_end, at_tolerance(10.0_wp**(-digits), "explicit"), &
                  explicit)
         work = 0.0_wp
         better = 0.0_wp
         price = 0.0_wp
         do i = 1, size(ratios)
            tolerance = ratios(i)*10.0_wp**(-digits)
            call run(error, problem, 0.0_wp, t_end, at_tolerance(tolerance, "auto"), auto)
            call run(error, problem, 0.0_wp, t_end, at_tolerance(tolerance, "radau9"), implicit)
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
   type(piecewise) function switch(kind, k) result(problem)
      integer, intent(in) :: kind
      real(wp), intent(in) :: k

      call fill(problem, 2, [0.5_wp, 0.5_wp], [0.5_wp, 0.5_wp], [1.0_wp, 1.0_wp], [1, 2])
      problem%kind = kind
      problem%k = k
   end function switch

   !> Evaluations have the cost of the method that made them.
   subroutine test_methods(error)
      type(error_type), allocatable, intent(out) :: error
      type(work_type) :: work

      work = work_type(equations=3)
      work%evaluations = 10
      call expect_close(error, work%total(), 10.0_wp, 0.0_wp, "explicit")
      call work%set_cost(4.0_wp)
      call expect_close(error, work%total(), 10.0_wp, 0.0_wp, "none by the second")
      work%evaluations = work%evaluations + 5
      call work%set_cost(1.0_wp)
      work%evaluations = work%evaluations + 7
      call expect_close(error, work%total(), 10.0_wp + 4*5.0_wp + 7.0_wp, 0.0_wp, "after the third")
   end subroutine test_methods

   !> By the explicit pair the work is the number of evaluations, by the implicit method more, and
   !> only that factorises.
   subroutine test_run(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome

      call run(error, sine(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "explicit"), outcome)
      call expect_close(error, outcome%work, real(outcome%evaluations, wp), 0.0_wp, "explicit")
      call expect(error, outcome%factorisations == 0, "no factorisation")
      call run(error, sine(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "radau5"), outcome)
      call expect(error, outcome%work > 3.0_wp*outcome%evaluations, "implicit, with its systems")
      call expect(error, outcome%factorisations > 0, "factorisations")
   end subroutine test_run
end module test_dde_switch
