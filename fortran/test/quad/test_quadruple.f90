! SPDX-License-Identifier: BSD-3-Clause
!> The solver compiled in quadruple precision, on problems with exact solutions far below what
!> double precision holds.
module test_quadruple
   use measured_case, only: as_double
   use expectations, only: expect, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, solve
   use test_problems, only: linear
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_quadruple

   !> Methods tried.
   character(len=8), parameter :: methods(4) = ["explicit", "taylor  ", "radau9  ", "radau13 "]
   !> Tolerance, and what errors must stay below.
   real(wp), parameter :: tolerance = 1.0e-22_wp, within = 1.0e-20_wp

contains

   subroutine collect_quadruple(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("precision", test_precision), &
                   new_unittest("known solutions", test_known)]
   end subroutine collect_quadruple

   !> More than 30 digits. 0.1 is rounded as double precision rounds it, numbers that it holds are
   !> not.
   subroutine test_precision(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, precision(1.0_wp) > 30, "more than 30 digits")
      call expect_close(error, (as_double(0.1_wp) - 0.1_wp)*2.0_wp**56, 0.4_wp, 1.0e-12_wp, &
                        "rounding of 0.1")
      call expect_close(error, as_double(0.375_wp), 0.375_wp, 0.0_wp, "a number held")
   end subroutine test_precision

   !> y' = -y(t-1), y = 1 at t = 0 and before, or 0 before; y = cos t.
   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: exact(2, 0:1) = reshape([5.0_wp/24, 19223.0_wp/362880, &
                                                      19.0_wp/120, 10493.0_wp/518400], [2, 2])
      type(linear) :: problem
      real(wp), allocatable :: y(:, :)
      integer :: i, past

      do i = 1, size(methods)
         do past = 0, 1
            problem = linear(n=1, lag=[1.0_wp], component=[1], past=[real(past, wp)], &
                             first=[1.0_wp])
            call solve(problem, [5.0_wp, 10.0_wp], at_tolerance(tolerance, methods(i)), y, error)
            call expect_close(error, y(1, :), exact(:, past), within, methods(i))
         end do
         call solve(swing(), [3.0_wp], at_tolerance(tolerance, methods(i)), y, error)
         call expect_close(error, y(1, :), [cos(3.0_wp)], within, methods(i))
      end do
   end subroutine test_known
end module test_quadruple
