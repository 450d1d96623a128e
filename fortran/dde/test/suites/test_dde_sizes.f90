! SPDX-License-Identifier: BSD-3-Clause
!> Components of different size and number: one beside another that is huge or tiny, tolerances of
!> each, and many copies of one equation.
module test_dde_sizes
   use dde, only: dde_problem_type, integration_options, integration_result
   use dde_errors, only: text
   use expectations, only: expect, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: logistic, piecewise, relaxing
   use solving, only: at_tolerance, run
   use stiff_problems, only: prothero_robinson
   use test_problems, only: fill
   implicit none (type, external)
   private
   public :: collect_dde_sizes

   !> Methods; all but the last do not need a series.
   character(len=8), parameter :: methods(6) = [character(len=8) :: "explicit", "auto", "radau5", &
                                                "radau9", "radau13", "taylor"]

contains

   subroutine collect_dde_sizes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a component beside", test_beside), &
                   new_unittest("tolerances of components", test_each), &
                   new_unittest("copies of a delayed equation", test_delayed_copies), &
                   new_unittest("copies of a stiff equation", test_stiff_copies)]
   end subroutine collect_dde_sizes

   !> A component that is no part of the equation does not change how it is solved.
   subroutine test_beside(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: alone, beside
      type(logistic) :: problem
      real(wp), parameter :: sizes(4) = [1.0e-15_wp, 1.0e9_wp, 1.0e12_wp, 1.0e15_wp]
      integer :: digits, i, k

      do i = 1, 5
         do digits = 3, 12, 3
            call fill(problem, 2, [1.2_wp, 1.0_wp], [1.2_wp, 1.0_wp], [1.0_wp], [1])
            call run(error, problem, 0.0_wp, 100.0_wp, &
                     at_tolerance(10.0_wp**(-digits), methods(i)), alone)
            do k = 1, size(sizes)
               problem%first(2) = sizes(k)
               call run(error, problem, 0.0_wp, 100.0_wp, &
                        at_tolerance(10.0_wp**(-digits), methods(i)), beside)
               if (allocated(error)) return
               call expect_close(error, beside%y(1), alone%y(1), 0.01_wp*10.0_wp**(-digits), &
                                 trim(methods(i))//" at 1e-"//text(digits)//" beside " &
                                 //text(sizes(k)))
            end do
         end do
      end do
   end subroutine test_beside

   !> A stiff component of size 1e-30 beside one of size 1 is as exact as one of size 1.
   subroutine test_each(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: large, small
      type(piecewise) :: problem
      integer :: i

      problem%kind = relaxing
      do i = 1, 5
         call fill(problem, 2, [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp])
         problem%k = 1.0_wp
         call run(error, problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-8_wp, methods(i)), large)
         problem%k = 1.0e-30_wp
         problem%first(1) = 1.0e-30_wp
         options = at_tolerance(1.0e-8_wp, methods(i))
         options%each_absolute = [1.0e-38_wp, 1.0e-8_wp]
         options%each_relative = [1.0e-8_wp, 1.0e-8_wp]
         call run(error, problem, 0.0_wp, 1.0_wp, options, small)
         if (allocated(error)) return
         call expect_close(error, small%y(2), large%y(2), 1.0e-8_wp, "y2 by "//methods(i))
         call expect_close(error, small%y(1)*1.0e30_wp, large%y(1), 1.0e-7_wp, "y1 by "//methods(i))
         call expect_close(error, large%y(1), sqrt(large%y(2)**2 + 1.0e-3_wp*large%y(2)), &
                           1.0e-5_wp, "the slow solution")
      end do
   end subroutine test_each

   !> A limit cycle beside copies at rest. Implicit steps are longer than the delay.
   subroutine test_delayed_copies(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits, i

      do i = 1, size(methods)
         do digits = 4, 8, 2
            call compare(error, copies(1), &
                         copies(merge(1000, 10000, index(methods(i), "radau") > 0)), methods(i), &
                         10.0_wp**(-digits))
         end do
      end do
   end subroutine test_delayed_copies

   !> A component that the embedded error of the implicit methods overlooks.
   subroutine test_stiff_copies(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits, i

      do i = 3, 5
         do digits = 4, 8, 2
            call compare(error, prothero_robinson(-1.0e4_wp), prothero_robinson(-1.0e4_wp, 60), &
                         methods(i), 10.0_wp**(-digits))
         end do
      end do
   end subroutine test_stiff_copies

   !> The first of several copies is solved by as many steps as alone.
   subroutine compare(error, alone, among, method, tolerance)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: alone, among
      character(len=*), intent(in) :: method
      real(wp), intent(in) :: tolerance
      type(integration_result) :: first, known

      call run(error, alone, 0.0_wp, 20.0_wp, at_tolerance(tolerance, method), known)
      call run(error, among, 0.0_wp, 20.0_wp, at_tolerance(tolerance, method), first)
      if (allocated(error)) return
      associate (name => trim(method)//" at "//text(tolerance))
         call expect(error, first%accepted == known%accepted &
                     .and. first%rejected == known%rejected, &
                     name//": "//text(first%accepted)//" steps, "//text(first%rejected) &
                     //" rejected; alone "//text(known%accepted)//", "//text(known%rejected))
         call expect_close(error, first%y(1), known%y(1), 1.0e-3_wp*tolerance, name)
      end associate
   end subroutine compare

   !> n copies of the delayed equation, all but the first at rest.
   type(logistic) function copies(n) result(problem)
      integer, intent(in) :: n
      real(wp) :: start(n)
      integer :: i

      start = 1.0_wp
      start(1) = 1.5_wp
      call fill(problem, n, start, start, spread(1.0_wp, 1, n), [(i, i=1, n)])
      problem%lower = 0
      problem%upper = 0
      problem%rows = reshape([(i, i, i=1, n)], [2, n])
      problem%analytic = .true.
   end function copies
end module test_dde_sizes
