! SPDX-License-Identifier: BSD-3-Clause
!> Numbers of unstable roots and Hopf curves of x' = -a x - b x(t - 1), whose roots may be real. In
!> closed form (Hayes 1950): a root passes 0 where a + b = 0. A pair is on the axis where
!> omega^2 = b^2 - a^2, cos(omega) = -a/b and sin(omega) = omega/b, and leaves it to the right as
!> |b| grows.
module test_real_roots
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use hopf_curves, only: curve_point_type, trace_curves
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use hopf_planes, only: curve_plane_type, middles, turn
   use hopf_points, only: judge_points
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_library, only: open_model
   implicit none (type, external)
   private
   public :: collect_real_roots

   !> Cells along each side of a window.
   integer, parameter :: cells = 30

contains

   !> All tests of this suite.
   subroutine collect_real_roots(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("no Hopf curve", test_no_curve), &
                   new_unittest("Hopf curves", test_curves), &
                   new_unittest("Hopf points on a line", test_line), &
                   new_unittest("double root 0", test_double_zero)]
   end subroutine collect_real_roots

   !> A real root passes 0 and no pair is on the axis.
   subroutine test_no_curve(error)
      type(error_type), allocatable, intent(out) :: error

      call check_window([-3.0_wp, 3.0_wp, -4.1_wp, 0.0_wp], [0, 1], 0, error)
   end subroutine test_no_curve

   !> Three curves, one of them from the double root 0 at a = -1, b = 1. Beyond it the number of
   !> roots changes from 1 to 2 without a curve.
   subroutine test_curves(error)
      type(error_type), allocatable, intent(out) :: error

      call check_window([-3.0_wp, 3.0_wp, -12.0_wp, 4.0_wp], [0, 1, 2, 3, 5], 3, error)
   end subroutine test_curves

   !> With a = -1, b = 1 Delta is s**2/2 near 0, to rounding 0 below 1e-8: counting comes to an end.
   subroutine test_double_zero(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_plane_type) :: plane
      integer :: roots(1, 1)

      call make_plane([-1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp], plane, error)
      if (allocated(error)) return
      roots = plane%unstable_roots([0.0_wp], [1.0_wp])
      call expect(error, roots(1, 1) >= 0 .and. roots(1, 1) <= 2, text(roots(1, 1))//" roots")
   end subroutine test_double_zero

   !> A window on a and b: its numbers of roots, and as many pieces of curves.
   subroutine check_window(window, numbers, pieces, error)
      real(wp), intent(in) :: window(4)
      integer, intent(in) :: numbers(:), pieces
      type(error_type), allocatable, intent(inout) :: error
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(failure_type), allocatable :: failure
      integer, allocatable :: roots(:, :)
      real(wp) :: grid(cells + 2), p(3)
      integer :: i, j

      call make_plane(window, plane, error)
      if (allocated(error)) return
      grid = [0.0_wp, middles([0.0_wp, 1.0_wp], cells), 1.0_wp]
      roots = plane%unstable_roots(grid, grid)
      do j = 1, size(grid)
         do i = 1, size(grid)
            p = plane%numbers_at([grid(i), grid(j)])
            call expect(error, roots(i, j) == known_number(p(2), p(3)), text(roots(i, j)) &
                        //" roots at a = "//text(p(2))//", b = "//text(p(3)))
         end do
      end do
      call expect(error, all([(any(roots == numbers(i)), i=1, size(numbers))]), "all numbers occur")
      call trace_curves(plane, grid, grid, roots, points, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call judge_points(plane, points)
      call expect(error, maxval([0, points%piece]) == pieces, "pieces of curves")
      do i = 1, size(points)
         associate (a => points(i)%numbers(2), b => points(i)%numbers(3), &
                    omega => points(i)%at%omega)
            call expect_close(error, [omega**2, b*cos(omega), b*sin(omega)], &
                              [b**2 - a**2, -a, omega], 1.0e-11_wp, "point "//text(i))
            ! behind the curve there are two more
            call expect(error, points(i)%unstable_roots == known_number(a, 1.000001_wp*b) - 2, &
                        "roots beside the pair of point "//text(i))
         end associate
      end do
   end subroutine check_window

   !> The plane of a and b.
   subroutine make_plane(window, plane, error)
      !> On a, then on b
      real(wp), intent(in) :: window(4)
      type(curve_plane_type), intent(out) :: plane
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      call open_model("made_decay", plane%model, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call plane%model%set([0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp], keep_delays=.true.)
      plane%along = [2, 3]
      plane%window = reshape(window, [2, 2])
   end subroutine make_plane

   !> Number of unstable roots in closed form.
   pure integer function known_number(a, b) result(number)
      real(wp), intent(in) :: a, b
      real(wp) :: first, omega

      number = merge(1, 0, a + b < 0.0_wp)
      if (abs(b) <= abs(a)) return
      omega = sqrt(b**2 - a**2)
      first = modulo(atan2(omega/b, -a/b), turn)
      number = number + 2*max(0, floor((omega - first)/turn) + 1)
   end function known_number

   !> Along b at a = 0 two pairs become unstable beside a real root; at a = -2 a real root passes 0
   !> beside another.
   subroutine test_line(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_plane_type) :: plane
      type(failure_type), allocatable :: failure
      type(hopf_on_line_type), allocatable :: found(:)

      call make_plane([-2.0_wp, 0.0_wp, -12.0_wp, 4.0_wp], plane, error)
      if (allocated(error)) return
      call find_hopf_on_line(plane%model, [0.0_wp, 0.0_wp, -0.5_wp], [0.0_wp, 0.0_wp, -12.0_wp], &
                             100, found, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, found%omega, [0.75_wp, 1.75_wp]*turn, 1.0e-12_wp, "omega = -b")
      call expect(error, all(found%roots_before == [1, 3]), "roots before the points")
      call expect(error, all(found%roots_behind == [3, 5]), "roots behind the points")
      call find_hopf_on_line(plane%model, [0.0_wp, -2.0_wp, 0.0_wp], [0.0_wp, -2.0_wp, 4.0_wp], &
                             100, found, failure)
      call expect_success(error, failure)
      call expect(error, size(found) == 0, "no pair on the axis")
   end subroutine test_line
end module test_real_roots
