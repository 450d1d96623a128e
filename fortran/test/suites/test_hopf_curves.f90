!> Hopf curves in their windows, those of the paper's Figures 2 and 3 and five more, against the
!> closed form.
module test_hopf_curves
   use closed_form, only: closed_epsilon
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use traced_planes, only: closed_delta, known_point, place_of, planes, trace, traced_plane
   implicit none (type, external)
   private
   public :: collect_hopf_curves

   !> Omegas of the independent scan, and their distance.
   integer, parameter :: scan_points = 150000
   real(wp), parameter :: scan_step = 2.0e-5_wp
   !> Branches of the independent scan.
   integer, parameter :: most_branches = 20
   !> Rounding in units of the window.
   real(wp), parameter :: rounding = 1.0e-9_wp

contains

   subroutine collect_hopf_curves(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("points in the window, on the curve", test_points), &
                   new_unittest("pieces are all there", test_pieces), &
                   new_unittest("crossing by theorem", test_crossing)]
   end subroutine collect_hopf_curves

   !> Every point lies in the window and on its branch's curve, and solves (5). Within a piece omega
   !> ascends, chords are short, and the curve between them is near.
   subroutine test_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(traced_plane) :: traced
      real(wp), dimension(2) :: chord, here, known, middle, next, place
      integer :: i, j

      do i = 1, planes
         call trace(i, traced, error)
         if (allocated(error)) return
         do j = 1, size(traced%points)
            associate (point => traced%points(j))
               place = place_of(traced%plane, [point%parameters%epsilon, &
                                               traced%plane%ordinate(point%parameters)])
               known = place_of(traced%plane, known_point(traced%plane, point%omega, point%branch))
               call expect_between(error, minval(place), -rounding, 1.0_wp, "place in the window")
               call expect_between(error, maxval(place), 0.0_wp, 1.0_wp + rounding, "place")
               call expect_between(error, maxval(abs(place - known)), 0.0_wp, rounding, &
                                   "distance to the curve in closed form")
               call expect_between(error, point%residual, 0.0_wp, 1.0e-10_wp, "residual")
               call expect_between(error, abs(closed_delta(point, point%parameters%tau, &
                                                           cmplx(0.0_wp, point%omega, kind=wp))), &
                                   0.0_wp, 1.0e-10_wp*(1.0_wp + point%parameters%gamma**2 &
                                                       /point%parameters%xi), "Delta")
            end associate
         end do
         do j = 1, size(traced%points) - 1
            associate (p => traced%points(j), q => traced%points(j + 1), plane => traced%plane)
               if (p%piece /= q%piece) cycle
               here = place_of(plane, known_point(plane, p%omega, p%branch))
               next = place_of(plane, known_point(plane, q%omega, p%branch))
               middle = place_of(plane, known_point(plane, 0.5_wp*(p%omega + q%omega), p%branch)) &
                        - here
               chord = next - here
               call expect(error, q%omega > p%omega, "omega ascends")
               call expect(error, q%branch == p%branch, "a piece belongs to one branch")
               call expect_between(error, norm2(chord), 0.0_wp, 0.02_wp + rounding, "chord")
               call expect_between(error, abs(chord(1)*middle(2) - chord(2)*middle(1)), 0.0_wp, &
                                   1.0e-4_wp*norm2(chord) + rounding, "chord times its deviation")
            end associate
         end do
      end do
   end subroutine test_points

   !> On each branch the pieces are those of an independent scan, with the same ends, which lie on
   !> the window's edge; they are numbered from 1.
   subroutine test_pieces(error)
      type(error_type), allocatable, intent(out) :: error
      type(traced_plane) :: traced
      real(wp), allocatable :: known(:), found(:)
      integer :: i, j, k

      do i = 1, planes
         call trace(i, traced, error)
         if (allocated(error)) return
         do k = 0, most_branches
            known = ends_by_scan(traced%plane, k)
            found = ends_of_pieces(traced%points, k)
            call expect_close(error, found, known, scan_step, "ends of pieces of branch "//text(k) &
                              //" in plane "//text(i))
            if (i == 3 .and. (k == 1 .or. k == 2)) then
               call expect(error, size(known) == 4, "two pieces of a loop that leaves the window")
            end if
            do j = 1, size(found)
               associate (place => place_of(traced%plane, known_point(traced%plane, found(j), k)))
                  call expect_between(error, minval(abs([place, 1.0_wp - place])), 0.0_wp, &
                                      rounding, "distance of an end to the edge")
               end associate
            end do
         end do
         associate (before => [0, traced%points%piece], piece => [traced%points%piece])
            call expect(error, piece(1) == 1 .and. all(piece == before(:size(piece)) .or. &
                                                       piece == before(:size(piece)) + 1), &
                        "pieces are numbered from 1")
         end associate
      end do
   end subroutine test_pieces

   !> At fixed xi a pair becomes unstable with growing tau where epsilon grows with omega, and
   !> stable where it falls (Cooke and van den Driessche 1986).
   subroutine test_crossing(error)
      type(error_type), allocatable, intent(out) :: error
      type(traced_plane) :: traced
      real(wp), parameter :: h = 1.0e-6_wp
      real(wp) :: growth
      integer :: count_of(-1:1), i, j

      count_of = 0
      do i = 1, planes
         call trace(i, traced, error)
         if (allocated(error)) return
         do j = 1, size(traced%points)
            associate (point => traced%points(j), p => traced%points(j)%parameters)
               growth = closed_epsilon(point%omega + h, p%xi, p%gamma) &
                        - closed_epsilon(point%omega - h, p%xi, p%gamma)
               if (abs(growth) < 1.0e-3_wp*h) cycle
               count_of(point%crossing) = count_of(point%crossing) + 1
               call expect(error, point%crossing == nint(sign(1.0_wp, growth)), &
                           "crossing at point "//text(j)//" of plane "//text(i))
            end associate
         end do
      end do
      call expect(error, count_of(-1) > 100 .and. count_of(1) > 100, "both signs occur")
   end subroutine test_crossing

   !> The omegas at which branch k enters and leaves the window.
   function ends_by_scan(plane, k) result(ends)
      type(curve_plane_type), intent(in) :: plane
      integer, intent(in) :: k
      real(wp), allocatable :: ends(:)
      real(wp) :: omega, place(2)
      logical :: inside, was_inside
      integer :: i

      allocate (ends(0))
      was_inside = .false.
      do i = 1, scan_points
         omega = scan_step*(i - 0.5_wp)
         place = place_of(plane, known_point(plane, omega, k))
         inside = minval(place) >= 0.0_wp .and. maxval(place) <= 1.0_wp
         if (inside .neqv. was_inside) ends = [ends, omega - 0.5_wp*scan_step]
         was_inside = inside
      end do
   end function ends_by_scan

   !> The omegas at which the pieces of branch k begin and end.
   function ends_of_pieces(points, k) result(ends)
      type(curve_point_type), intent(in) :: points(:)
      integer, intent(in) :: k
      real(wp), allocatable :: ends(:)
      integer :: i

      allocate (ends(0))
      do i = 1, maxval(points%piece)
         if (.not. any(points%piece == i .and. points%branch == k)) cycle
         ends = [ends, minval(points%omega, points%piece == i), &
                 maxval(points%omega, points%piece == i)]
      end do
   end function ends_of_pieces

end module test_hopf_curves
