! SPDX-License-Identifier: BSD-3-Clause
!> Many equations: a delayed reaction with diffusion by the method of lines. CTest runs this suite
!> with a stack of 512 kB, on which no array of its 100 000 equations would find place.
module test_dde_large
   use dde, only: integration_result
   use dde_jacobian, only: jacobian_type
   use dde_methods, only: price_of_trial
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_errors, only: text
   use expectations, only: expect, expect_close
   use dde_kinds, only: wp
   use lines_of_cells, only: cells
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: many_delays, piecewise
   use solving, only: at_tolerance, run
   use test_problems, only: fill
   implicit none (type, external)
   private
   public :: collect_dde_large

   !> Cells that give their derivatives.
   type, extends(cells) :: cells_with_derivatives
   contains
      procedure :: jacobian => three_diagonals
   end type cells_with_derivatives

contains

   subroutine collect_dde_large(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("differences", test_differences), &
                   new_unittest("nearly equal delays", test_alike), &
                   new_unittest("the cost of auto", test_auto), &
                   new_unittest("a banded Jacobian", test_banded), &
                   new_unittest("many short delays", test_short_delays), &
                   new_unittest("100 000 equations", test_stack)]
   end subroutine collect_dde_large

   !> Differences agree with the derivatives, and each evaluation is counted: by columns and delayed
   !> values, by diagonals where the Jacobian is banded, and once for delayed values of other rows.
   subroutine test_differences(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 7
      type(cells) :: problem
      type(jacobian_type) :: banded, full
      type(tolerance_type) :: tolerance
      type(work_type) :: work
      integer :: i, j
      logical :: finite
      real(wp) :: known, y(n), z(n)

      problem = cells(n, diffusion=3.0_wp, delayed=.true.)
      deallocate (problem%rows)
      tolerance = tolerance_type(n, 1.0e-6_wp, 1.0e-6_wp)
      y = [(1.0_wp + 0.1_wp*i, i=1, n)]
      z = 0.5_wp
      call full%evaluate(problem, tolerance, work, 0.0_wp, y, z, huge(1.0_wp), finite)
      call expect(error, work%evaluations == 1 + 2*n, "of all: "//text(work%evaluations))
      call full%evaluate(problem, tolerance, work, 0.0_wp, y, z, 0.0_wp, finite)
      call expect(error, work%evaluations == 2 + 3*n, &
                  "without the delayed ones: "//text(work%evaluations))
      problem = cells(n, diffusion=3.0_wp, delayed=.true.)
      problem%lower = 1
      problem%upper = 1
      work = work_type(equations=n)
      call banded%evaluate(problem, tolerance, work, 0.0_wp, y, z, huge(1.0_wp), finite)
      call expect(error, work%evaluations == 5, "by diagonals: "//text(work%evaluations))
      do j = 1, n
         do i = max(1, j - 1), min(n, j + 1)
            known = 3.0_wp
            if (i == j) known = 1.8_wp*(1.0_wp - z(i)) - merge(3.0_wp, 6.0_wp, i == 1 .or. i == n)
            call expect_close(error, full%by_y(i, j), known, 1.0e-6_wp, "full")
            call expect_close(error, banded%by_y(2 + i - j, j), known, 1.0e-6_wp, "banded")
         end do
         call expect_close(error, full%by_z(j, j), -1.8_wp*y(j), 1.0e-6_wp, "by a delayed value")
         call expect_close(error, banded%by_z(1, j), -1.8_wp*y(j), 1.0e-6_wp, "from its row on")
      end do
   end subroutine test_differences

   !> Delayed values of nearly equal delays are moved together and share a derivative. Those of long
   !> delays are left out.
   subroutine test_alike(error)
      type(error_type), allocatable, intent(out) :: error
      type(jacobian_type) :: jacobian
      type(piecewise) :: problem
      type(work_type) :: work
      integer :: i
      real(wp), parameter :: lags(12) = [(1.0_wp, i=1, 7), 1.05_wp, 0.98_wp, 1.2_wp, &
                                         1.25_wp, 3.0_wp]
      logical :: finite

      problem%kind = many_delays
      call fill(problem, 1, [1.0_wp], [1.0_wp], lags, [(1, i=1, 12)])
      work = work_type(equations=1)
      call jacobian%evaluate(problem, tolerance_type(1, 1.0e-6_wp, 1.0e-6_wp), work, 0.0_wp, &
                             [0.3_wp], [(0.1_wp*i, i=1, 12)], 2.0_wp, finite)
      call expect(error, work%evaluations == 4, text(work%evaluations)//" evaluations")
      call expect_close(error, jacobian%by_z(1, :), [(-1.0_wp/24, i=1, 11), 0.0_wp], 1.0e-6_wp, &
                        "derivatives")
   end subroutine test_alike

   !> With a band the solution is the same, for a tenth of the evaluations.
   subroutine test_banded(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: sizes(2) = [30, 80]
      character(len=8), parameter :: methods(3) = [character(len=8) :: "radau5", "radau9", &
                                                   "radau13"]
      type(integration_result) :: banded, full
      type(cells) :: problem
      integer :: i, k

      do k = 1, size(sizes)
         do i = 1, size(methods)
            problem = cells(sizes(k), diffusion=100.0_wp, delayed=.true.)
            call run(error, problem, 0.0_wp, 5.0_wp, at_tolerance(1.0e-7_wp, methods(i)), full)
            problem%lower = 1
            problem%upper = 1
            call run(error, problem, 0.0_wp, 5.0_wp, at_tolerance(1.0e-7_wp, methods(i)), banded)
            if (allocated(error)) return
            call expect_close(error, banded%y, full%y, 1.0e-6_wp, methods(i))
            call expect(error, banded%evaluations < full%evaluations, "fewer evaluations")
         end do
      end do
   end subroutine test_banded

   !> Steps longer than 100 delays, whose matrix is full or a band of derivatives that the problem
   !> gives, agree with the explicit method.
   subroutine test_short_delays(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 100
      type(cells) :: problem
      type(cells_with_derivatives) :: with_derivatives
      type(integration_result) :: banded, explicit, full

      problem = cells(n, diffusion=1.0_wp, delayed=.true.)
      problem%lag = 0.01_wp
      call run(error, problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-8_wp, "explicit"), explicit)
      call run(error, problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-7_wp, "radau9"), full)
      with_derivatives%cells = problem
      with_derivatives%lower = 1
      with_derivatives%upper = 1
      call run(error, with_derivatives, 0.0_wp, 1.0_wp, at_tolerance(1.0e-7_wp, "radau9"), banded)
      if (allocated(error)) return
      call expect(error, full%accepted < 50, text(full%accepted)//" steps longer than the delays")
      call expect_close(error, full%y, explicit%y, 1.0e-7_wp, "full")
      call expect_close(error, banded%y, explicit%y, 1.0e-7_wp, "banded")
      call expect(error, banded%evaluations < full%evaluations - n, "no differences")
   end subroutine test_short_delays

   !> Derivatives of the reaction with diffusion in a band of three diagonals.
   pure subroutine three_diagonals(self, t, y, z, by_y, by_z)
      class(cells_with_derivatives), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      by_y = self%diffusion
      by_y(2, :) = 1.8_wp*(1.0_wp - z) - 2*self%diffusion
      by_y(2, 1) = by_y(2, 1) + self%diffusion
      by_y(2, self%n) = by_y(2, self%n) + self%diffusion
      by_z(1, :) = -1.8_wp*y
   end subroutine three_diagonals

   !> No array on the stack grows with the number of equations.
   subroutine test_stack(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=8), parameter :: methods(3) = [character(len=8) :: "explicit", "radau5", "auto"]
      type(integration_result) :: outcome
      type(cells) :: problem
      integer :: i

      problem = cells(100000, diffusion=1.0_wp, delayed=.false.)
      problem%lower = 1
      problem%upper = 1
      do i = 1, size(methods)
         call run(error, problem, 0.0_wp, 0.1_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome)
      end do
   end subroutine test_stack

   !> Where the explicit method is better `auto` stays with it, however stiff steps may look; where
   !> the implicit one is, it does not take much more.
   subroutine test_auto(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: diffusion(2) = [1.0_wp, 1000.0_wp]
      type(integration_result) :: auto, explicit, implicit
      type(cells) :: problem
      real(wp) :: price
      integer, parameter :: sizes(5) = [30, 300, 30, 300, 3000]
      integer :: i, k

      do k = 1, size(sizes)
         do i = 1, size(diffusion)
            associate (n => sizes(k))
               problem = cells(n, diffusion(i), delayed=.true.)
               if (k > 2) problem%lower = 1
               if (k > 2) problem%upper = 1
               call run(error, problem, 0.0_wp, 3.0_wp, at_tolerance(1.0e-5_wp, "explicit"), &
                        explicit)
               call run(error, problem, 0.0_wp, 3.0_wp, at_tolerance(1.0e-5_wp, "radau9"), implicit)
               call run(error, problem, 0.0_wp, 3.0_wp, at_tolerance(1.0e-5_wp, "auto"), auto)
               if (allocated(error)) return
               price = price_of_trial(problem, tolerance_type(n, 1.0e-5_wp, 1.0e-5_wp))
               call expect(error, auto%work <= 1.5_wp*min(explicit%work, implicit%work) + 2*price, &
                           text(auto%work)//" by auto, "//text(explicit%work)//" by explicit, " &
                           //text(implicit%work)//" by radau9, n = "//text(n))
            end associate
         end do
      end do
   end subroutine test_auto
end module test_dde_large
