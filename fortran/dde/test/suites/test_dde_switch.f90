! SPDX-License-Identifier: BSD-3-Clause
!> What `auto` chooses and when it changes the method, what that costs, and how work is counted.
module test_dde_switch
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use chain_of_blocks, only: chain
   use dde, only: dde_problem_type, integration_result
   use dde_errors, only: text
   use dde_kinds, only: wp
   use dde_methods, only: price_of_trial
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use expectations, only: expect, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: cells, changing_stiffness, switching_kinds
   use published_problems, only: enzyme, infection, mackey_glass
   use solving, only: at_tolerance, run
   use stiff_problems, only: follower, sdisc
   use test_problems, only: constant_past, fill, sine
   implicit none (type, external)
   private
   public :: collect_dde_switch

   !> Tolerances whose average counts, over one of them, where the stiffness changes in each delay:
   !> which trials fail there depends on rounding.
   real(wp), parameter :: neighbours(5) = [0.9_wp, 0.95_wp, 1.0_wp, 1.05_wp, 1.1_wp]

   !> y' = cos 3t - y + y(t - lag)/10, which gives its derivatives.
   type, extends(constant_past) :: tracking
   contains
      procedure :: jacobian => derivatives
   end type tracking

contains

   subroutine collect_dde_switch(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("the choice of auto", test_choice), &
                   new_unittest("the beginning of auto", test_beginning), &
                   new_unittest("cost of changes", test_cost), &
                   new_unittest("the cost of auto", test_cells), &
                   new_unittest("layers after each delay", test_layers), &
                   new_unittest("series that are never found", test_lost_series), &
                   new_unittest("work", test_work)]
   end subroutine collect_dde_switch

   !> `auto` takes series where delays are few, and where they are many below 1e-5.
   subroutine test_choice(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_method(chain(1), 1.0e-2_wp, "taylor")
      call expect_method(mackey_glass(), 1.0e-5_wp, "bs5")
      call expect_method(mackey_glass(), 1.0e-6_wp, "taylor")

   contains

      !> As many steps and evaluations as by the method.
      subroutine expect_method(problem, tolerance, method)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: tolerance
         character(len=*), intent(in) :: method
         class(dde_problem_type), allocatable :: analytic
         type(integration_result) :: known, outcome

         allocate (analytic, source=problem)
         analytic%analytic = .true.
         call run(error, analytic, 0.0_wp, 50.0_wp, at_tolerance(tolerance, method), known)
         call run(error, analytic, 0.0_wp, 50.0_wp, at_tolerance(tolerance, "auto"), outcome)
         call expect(error, outcome%accepted == known%accepted &
                     .and. outcome%evaluations == known%evaluations, method)
      end subroutine expect_method
   end subroutine test_choice

   !> `auto` begins by the implicit method where the Jacobian says so, and else not. Where that is
   !> wrong, it costs less than a fifth of the run: y follows cos 3t, which is as fast, and the
   !> delay is long.
   subroutine test_beginning(error)
      type(error_type), allocatable, intent(out) :: error
      type(cells) :: diffusing
      type(tracking) :: oscillating
      type(integration_result) :: auto, explicit
      integer :: i

      diffusing = cells(30, 1000.0_wp, delayed=.true.)
      diffusing%lower = 1
      diffusing%upper = 1
      diffusing%rows = reshape([([i, i], i=1, 30)], [2, 30])
      diffusing%gives_jacobian = .true.
      call run(error, diffusing, 0.0_wp, 3.0_wp, at_tolerance(1.0e-5_wp, "auto"), auto)
      call expect(error, auto%implicit_steps == auto%accepted, "implicit from the first step on")
      diffusing%gives_jacobian = .false.
      call run(error, diffusing, 0.0_wp, 3.0_wp, at_tolerance(1.0e-5_wp, "auto"), auto)
      call expect(error, auto%implicit_steps < auto%accepted, "explicit where f alone is given")
      call fill(oscillating, 1, [0.0_wp], [0.0_wp], [1000.0_wp], [1])
      oscillating%f => track
      call run(error, oscillating, 0.0_wp, 1500.0_wp, at_tolerance(1.0e-4_wp, "bs5"), explicit)
      call run(error, oscillating, 0.0_wp, 1500.0_wp, at_tolerance(1.0e-4_wp, "auto"), auto)
      call expect(error, auto%implicit_steps > 0, "the wrong one first")
      call expect(error, auto%work < 1.2_wp*explicit%work, "work "//text(auto%work/explicit%work))
      oscillating = tracking()
      call fill(oscillating, 1, [0.0_wp], [0.0_wp])
      oscillating%f => track
      call run(error, oscillating, 0.0_wp, 50.0_wp, at_tolerance(1.0e-4_wp, "auto"), auto)
      call expect(error, auto%implicit_steps == 0, "explicit without a delay")
   end subroutine test_beginning

   pure subroutine track(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = cos(3.0_wp*t) - y + 0.1_wp*sum(z)
   end subroutine track

   pure subroutine derivatives(self, t, y, z, by_y, by_z)
      class(tracking), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      by_y = -1.0_wp
      by_z = 0.1_wp
   end subroutine derivatives

   !> On problems that jump or change their stiffness, and on published ones, `auto` takes at most
   !> twice the work of the better method, and the work that earns a trial.
   subroutine test_cost(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits, kind, power

      do digits = 3, 6, 3
         do kind = 1, switching_kinds
            do power = 1, 4, 3
               call compare_work(error, changing_stiffness(kind, 10.0_wp**power), 30.0_wp, &
                                 10.0_wp**(-digits)*neighbours, 2.0_wp, &
                                 "switching "//text(kind)//", k = 1e"//text(power))
            end do
         end do
         call compare_work(error, infection(), 40.0_wp, [10.0_wp**(-digits)], 2.0_wp, "infection")
         call compare_work(error, enzyme(), 160.0_wp, [10.0_wp**(-digits)], 2.0_wp, "enzyme")
         call compare_work(error, mackey_glass(), 200.0_wp, [10.0_wp**(-digits)], 2.0_wp, "chaos")
      end do
   end subroutine test_cost

   !> Where the explicit method is better `auto` stays with it, however stiff steps may look; where
   !> the implicit one is, it does not take much more.
   subroutine test_cells(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: diffusion(2) = [1.0_wp, 1000.0_wp]
      type(cells) :: problem
      integer, parameter :: sizes(5) = [30, 300, 30, 300, 3000]
      integer :: i, k

      do k = 1, size(sizes)
         do i = 1, size(diffusion)
            problem = cells(sizes(k), diffusion(i), delayed=.true.)
            if (k > 2) problem%lower = 1
            if (k > 2) problem%upper = 1
            call compare_work(error, problem, 3.0_wp, [1.0e-5_wp], 1.5_wp, text(sizes(k))//" cells")
         end do
      end do
   end subroutine test_cells

   !> The work of `auto` and of the methods that it chooses from, on the average of tolerances.
   subroutine compare_work(error, problem, t_end, tolerances, most, name, known)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_end, tolerances(:)
      !> Work of auto over that of the better method
      real(wp), intent(in) :: most
      character(len=*), intent(in) :: name
      !> The end, if it is compared; then the explicit method is not tried
      real(wp), intent(in), optional :: known(:)
      type(integration_result) :: auto, explicit, implicit
      real(wp) :: better, middle, price, work
      integer :: i

      middle = tolerances((size(tolerances) + 1)/2)
      explicit%work = huge(1.0_wp)
      if (.not. present(known)) then
         call run(error, problem, 0.0_wp, t_end, at_tolerance(middle, "explicit"), explicit)
      end if
      work = 0.0_wp
      better = 0.0_wp
      price = 0.0_wp
      do i = 1, size(tolerances)
         call run(error, problem, 0.0_wp, t_end, at_tolerance(tolerances(i), "auto"), auto)
         call run(error, problem, 0.0_wp, t_end, at_tolerance(tolerances(i), "radau9"), implicit)
         if (present(known)) then
            call expect_close(error, auto%y, known, 10*tolerances(i), name//" by auto")
            call expect_close(error, implicit%y, known, 10*tolerances(i), name//" by radau9")
         end if
         work = work + auto%work
         better = better + min(explicit%work, implicit%work)
         price = price + price_of_trial(problem, tolerance_type(problem%n, tolerances(i), &
                                                                tolerances(i)))
      end do
      call expect(error, work <= most*better + 2*price, &
                  name//" at "//text(middle)//": "//text(work)//" by auto, " &
                  //text(explicit%work)//" by explicit, "//text(implicit%work)//" by radau9, " &
                  //text(auto%switches)//" changes")
   end subroutine compare_work

   !> In layers both methods are equally fast; elsewhere explicit steps are out of the question.
   !> Both agree with the method of order 13.
   subroutine test_layers(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known

      call run(error, sdisc(), 0.0_wp, 20.5_wp, at_tolerance(1.0e-9_wp, "radau13"), known)
      call compare_work(error, sdisc(), 20.5_wp, 1.0e-3_wp*neighbours, 2.0_wp, "layers", known%y)
      call compare_work(error, sdisc(), 20.5_wp, 1.0e-6_wp*neighbours, 2.0_wp, "layers", known%y)
   end subroutine test_layers

   !> The component is in balance, but its slow series is not found: all trials of the explicit
   !> method fail, at steps of 1e-22. Implicit steps do not begin so short after each of them.
   subroutine test_lost_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: auto, implicit
      type(follower) :: problem
      real(wp) :: exact(2)

      problem = follower(1.0e22_wp, 0.0_wp, wrong_by=ieee_value(1.0_wp, ieee_quiet_nan))
      call run(error, problem, 0.0_wp, 5.0_wp, at_tolerance(1.0e-8_wp, "auto"), auto)
      call run(error, problem, 0.0_wp, 5.0_wp, at_tolerance(1.0e-8_wp, "radau9"), implicit)
      call expect(error, auto%switches > 1, "trials of the explicit method")
      call expect(error, auto%work <= 2*implicit%work, &
                  text(auto%work)//" by auto, "//text(implicit%work)//" by radau9")
      call problem%exact(problem%p, 5.0_wp, exact)
      call expect_close(error, auto%y, exact, 1.0e-7_wp, "by auto")
   end subroutine test_lost_series

   !> Evaluations have the cost of the method that made them. By the explicit pair the work is their
   !> number, by the implicit method more, and only that factorises.
   subroutine test_work(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
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
      call run(error, sine(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "explicit"), outcome)
      call expect_close(error, outcome%work, real(outcome%evaluations, wp), 0.0_wp, "explicit")
      call expect(error, outcome%factorisations == 0, "no factorisation")
      call run(error, sine(), 0.0_wp, 20.0_wp, at_tolerance(1.0e-6_wp, "radau5"), outcome)
      call expect(error, outcome%work > 3.0_wp*outcome%evaluations, "implicit, with its systems")
      call expect(error, outcome%factorisations > 0, "factorisations")
   end subroutine test_work
end module test_dde_switch
