!> A line through fewer points: what is left out is as close to it as was asked.
module test_thinned_line
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_path, only: find_kept_points
   implicit none (type, external)
   private
   public :: collect_thinned_line

contains

   !> All tests of this suite.
   subroutine collect_thinned_line(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("few points", test_few), &
                   new_unittest("corners", test_corners), &
                   new_unittest("way back", test_way_back), &
                   new_unittest("circle", test_circle)]
   end subroutine collect_thinned_line

   !> None, one and two points, the last two at one place.
   subroutine test_few(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      integer :: n
      real(wp) :: points(2, 3)

      points = 1.0_wp
      do n = 0, 2
         associate (kept => find_kept_points(points(:, :n), 0.1_wp))
            call expect(error, size(kept) == n .and. all(kept), "all of "//text(n))
         end associate
      end do
      call expect(error, all(find_kept_points(points, 0.1_wp) .eqv. [.true., .false., .true.]), &
                  "three points at one place")
   end subroutine test_few

   !> Of a line with two corners and points between them the ends and the corners are kept, and a
   !> point beside the line if it is further away than the tolerance.
   subroutine test_corners(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: points(2, 9)

      points(1, :) = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp]
      points(2, :) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 2.0_wp, 2.0_wp]
      call expect(error, all(places(0.1_wp) == [1, 4, 6, 9]), "ends and corners")
      points(2, 8) = 2.09_wp
      call expect(error, all(places(0.1_wp) == [1, 4, 6, 9]), "within the tolerance")
      points(2, 8) = 2.11_wp
      call expect(error, all(places(0.1_wp) == [1, 4, 6, 8, 9]), "beyond the tolerance")

   contains

      !> Numbers of the points that are kept.
      function places(tolerance) result(numbers)
         !> The tolerance
         real(wp), intent(in) :: tolerance
         integer, allocatable :: numbers(:)
         integer :: i

         numbers = pack([(i, i=1, size(points, 2))], find_kept_points(points, tolerance))
      end function places
   end subroutine test_corners

   !> A line that turns back on itself keeps its end, although the line through it is straight.
   subroutine test_way_back(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: points(1, 5)

      points(1, :) = [0.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 1.0_wp]
      call expect(error, all(find_kept_points(points, 0.1_wp) &
                             .eqv. [.true., .false., .true., .false., .true.]), "turning point")
   end subroutine test_way_back

   !> Of 1001 points on half a circle those left out are within the tolerance of the line, and there
   !> are about pi/sqrt(8 tolerance) chords: a chord over the angle a is a**2/8 from the circle.
   subroutine test_circle(error)
      !> The first failure of the test
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp), tolerance = 1.0e-3_wp
      logical :: kept(1001)
      real(wp) :: angle(1001), farthest
      integer :: chords, first, i, last

      angle = [(pi*i/1000.0_wp, i=0, 1000)]
      kept = find_kept_points(transpose(reshape([cos(angle), sin(angle)], [1001, 2])), tolerance)
      farthest = 0.0_wp
      first = 1
      do i = 2, 1001
         if (.not. kept(i)) cycle
         last = i
         farthest = max(farthest, 1.0_wp - cos(0.5_wp*(angle(last) - angle(first))))
         first = last
      end do
      call expect(error, farthest <= tolerance, "within the tolerance")
      chords = count(kept) - 1
      associate (fewest => pi/sqrt(8.0_wp*tolerance))
         call expect(error, chords >= fewest - 1.0_wp .and. chords <= 2.0_wp*fewest, &
                     text(chords)//" chords")
      end associate
   end subroutine test_circle
end module test_thinned_line
