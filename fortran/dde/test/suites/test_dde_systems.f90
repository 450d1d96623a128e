! SPDX-License-Identifier: BSD-3-Clause
!> Jacobians and the linear systems of implicit steps: full and banded, with delayed values in the
!> step. CTest runs this suite with a stack of 512 kB, on which no array of its 100 000 equations
!> would find place.
module test_dde_systems
   use chain_of_blocks, only: chain
   use dde, only: integration_result
   use dde_errors, only: text
   use dde_jacobian, only: jacobian_type
   use dde_kinds, only: wp
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use expectations, only: expect, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: cells, many_delays
   use solving, only: at_tolerance, run
   use stiff_problems, only: exponential_decay, follower, prothero_robinson
   use test_problems, only: constant_past, linear, wille_baker
      implicit none (type, external)
   private
   public :: collect_dde_systems

   character(len=8), parameter :: methods(3) = [character(len=8) :: "radau5", "radau9", "radau13"]
   integer, parameter :: stages(3) = [3, 5, 7]

contains

   subroutine collect_dde_systems(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("differences", test_differences), &
                   new_unittest("nearly equal delays", test_alike), &
                   new_unittest("linear problems", test_linear), &
                   new_unittest("a row of huge numbers", test_huge_row), &
                   new_unittest("a banded Jacobian", test_banded), &
                   new_unittest("100 000 equations", test_stack)]
   end subroutine collect_dde_systems

   !> Differences agree with the derivatives that the problem gives, and each evaluation is counted:
   !> by columns and delayed values, by diagonals where the Jacobian is banded, and once for delayed
   !> values of other rows.
   subroutine test_differences(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 7
      type(cells) :: problem
      type(jacobian_type) :: banded, full, known
      integer :: i, j

      problem = cells(n, diffusion=3.0_wp, delayed=.true.)
      deallocate (problem%rows)
      call evaluate(full, huge(1.0_wp), 1 + 2*n)
      call evaluate(full, 0.0_wp, 1 + n)
      problem = cells(n, diffusion=3.0_wp, delayed=.true.)
      problem%lower = 1
      problem%upper = 1
      call evaluate(banded, huge(1.0_wp), 5)
      problem%gives_jacobian = .true.
      call evaluate(known, huge(1.0_wp), 0)
      do j = 1, n
         do i = max(1, j - 1), min(n, j + 1)
            call expect_close(error, full%by_y(i, j), known%by_y(2 + i - j, j), 1.0e-6_wp, "full")
            call expect_close(error, banded%by_y(2 + i - j, j), known%by_y(2 + i - j, j), &
                              1.0e-6_wp, "banded")
         end do
         call expect_close(error, full%by_z(j, j), -1.8_wp*(1.0_wp + 0.1_wp*j), 1.0e-6_wp, "by z")
         call expect_close(error, banded%by_z(1, j), known%by_z(1, j), 1.0e-6_wp, "from its row on")
      end do

   contains

      subroutine evaluate(jacobian, longest, evaluations)
         type(jacobian_type), intent(inout) :: jacobian
         real(wp), intent(in) :: longest
         integer, intent(in) :: evaluations
         type(work_type) :: work
         logical :: finite

         work = work_type(equations=n)
         call jacobian%evaluate(problem, tolerance_type(n, 1.0e-6_wp, 1.0e-6_wp), work, 0.0_wp, &
                                [(1.0_wp + 0.1_wp*i, i=1, n)], spread(0.5_wp, 1, n), longest, &
                                finite)
         call expect(error, work%evaluations == evaluations, text(work%evaluations) &
                     //" evaluations, not "//text(evaluations))
      end subroutine evaluate
   end subroutine test_differences

   !> Delayed values of nearly equal delays are moved together and share a derivative. Those of long
   !> delays are left out.
   subroutine test_alike(error)
      type(error_type), allocatable, intent(out) :: error
      type(jacobian_type) :: jacobian
      type(work_type) :: work
      integer :: i
      logical :: finite

      work = work_type(equations=1)
      call jacobian%evaluate(many_delays([spread(1.0_wp, 1, 7), 1.05_wp, 0.98_wp, 1.2_wp, 1.25_wp, &
                                          3.0_wp]), tolerance_type(1, 1.0e-6_wp, 1.0e-6_wp), work, &
                             0.0_wp, [0.3_wp], [(0.1_wp*i, i=1, 12)], 2.0_wp, finite)
      call expect(error, work%evaluations == 4, text(work%evaluations)//" evaluations")
      call expect_close(error, jacobian%by_z(1, :), [spread(-1.0_wp/24, 1, 11), 0.0_wp], &
                        1.0e-6_wp, "derivatives")
   end subroutine test_alike

   !> If the Jacobian and the systems are right, the iteration for a linear problem converges at
   !> once: two rounds of its stages a step, and what confirms and estimates. Delayed values lie in
   !> the step at all stages, at some and at none, in equations of full and of banded matrices.
   subroutine test_linear(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 9
      type(linear) :: chain_of_delays
      integer :: i, k

      do i = 1, size(stages)
         call expect_few(wille_baker(), 5.0_wp, 20, "two delays")
         call expect_few(follower(1.0e6_wp, start=2.0_wp), 20.0_wp, 0, "follower")
         call expect_few(prothero_robinson(-1.0e4_wp, 5), 20.0_wp, 0, "Prothero")
         call expect_few(exponential_decay(1.0e-4_wp), 10.0_wp, 0, "a short delay")
         chain_of_delays = linear(n, [(0.1_wp*k, k=1, n)], [(k, k=1, n)], spread(1.0_wp, 1, n), &
                                  spread(1.0_wp, 1, n))
         call expect_few(chain_of_delays, 5.0_wp, 240, "full")
         chain_of_delays%lower = 0
         chain_of_delays%upper = 0
         chain_of_delays%rows = reshape([(k, k, k=1, n)], [2, n])
         call expect_few(chain_of_delays, 5.0_wp, 0, "banded")
      end do

   contains

      subroutine expect_few(problem, t_end, for_jacobians, what)
         class(constant_past), intent(in) :: problem
         real(wp), intent(in) :: t_end
         !> Evaluations for Jacobians beyond one a step
         integer, intent(in) :: for_jacobians
         character(len=*), intent(in) :: what
         type(integration_result) :: outcome

         call run(error, problem, 0.0_wp, t_end, at_tolerance(1.0e-4_wp, methods(i)), outcome)
         call expect(error, outcome%evaluations <= (2*stages(i) + 4)*(outcome%accepted &
                                                                      + outcome%rejected) &
                     + outcome%breaking_points + for_jacobians, &
                     text(outcome%evaluations)//" evaluations, "//what//" by "//methods(i))
      end subroutine expect_few
   end subroutine test_linear

   !> A block deep in stick (stiffness 1e22, near balance of forces), alone and with the delay in
   !> the step: theta stays, u falls with time. The row of w must not be the pivot for the others.
   subroutine test_huge_row(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: delays(2) = [10.0_wp, 1.0e-3_wp]
      type(chain) :: problem
      type(integration_result) :: outcome
      integer :: i, k

      do i = 1, size(stages)
         do k = 1, size(delays)
            problem = chain(1, tau=delays(k))
            problem%first = [50.0_wp, 0.0_wp, -50.0_wp]
            problem%past = problem%first
            call run(error, problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp, methods(i)), outcome)
            if (allocated(error)) return
            call expect_close(error, outcome%y(:2), [50.0_wp, -1.0_wp], 1.0e-14_wp, methods(i))
            call expect_close(error, outcome%y(3), -49.2_wp, 1.0e-5_wp, methods(i))
         end do
      end do
   end subroutine test_huge_row

   !> With a band, of differences or of derivatives that the problem gives, the solution is the
   !> same, for fewer evaluations; and in steps longer than many short delays that of the explicit
   !> method.
   subroutine test_banded(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: banded, explicit, full, given
      type(cells) :: problem
      integer :: i

      do i = 1, size(methods)
         call compare(cells(30, diffusion=100.0_wp, delayed=.true.), 5.0_wp)
      end do
      i = 2
      problem = cells(100, diffusion=1.0_wp, delayed=.true.)
      problem%lag = 0.01_wp
      call run(error, problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-8_wp, "explicit"), explicit)
      call compare(problem, 1.0_wp)
      call expect_close(error, full%y, explicit%y, 1.0e-7_wp, "explicit")
      call expect(error, full%accepted < 50, text(full%accepted)//" steps longer than the delays")

   contains

      subroutine compare(cell_line, t_end)
         type(cells), intent(in) :: cell_line
         real(wp), intent(in) :: t_end
         type(cells) :: asked

         asked = cell_line
         call run(error, asked, 0.0_wp, t_end, at_tolerance(1.0e-7_wp, methods(i)), full)
         asked%lower = 1
         asked%upper = 1
         call run(error, asked, 0.0_wp, t_end, at_tolerance(1.0e-7_wp, methods(i)), banded)
         asked%gives_jacobian = .true.
         call run(error, asked, 0.0_wp, t_end, at_tolerance(1.0e-7_wp, methods(i)), given)
         call expect_close(error, banded%y, full%y, 1.0e-6_wp, methods(i)//" with a band")
         call expect_close(error, given%y, full%y, 1.0e-6_wp, methods(i)//" with derivatives")
         call expect(error, given%evaluations < banded%evaluations &
                     .and. banded%evaluations < full%evaluations, "fewer evaluations")
      end subroutine compare
   end subroutine test_banded

   !> No array on the stack grows with the number of equations.
   subroutine test_stack(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(cells) :: problem

      problem = cells(100000, diffusion=1.0_wp, delayed=.false.)
      problem%lower = 1
      problem%upper = 1
      call run(error, problem, 0.0_wp, 0.1_wp, at_tolerance(1.0e-3_wp, "explicit"), outcome)
      call run(error, problem, 0.0_wp, 0.1_wp, at_tolerance(1.0e-3_wp, "radau5"), outcome)
      call run(error, problem, 0.0_wp, 0.1_wp, at_tolerance(1.0e-3_wp, "auto"), outcome)
   end subroutine test_stack
end module test_dde_systems
