!> Hopf curves in their windows, those of the paper's Figures 2 and 3 and five more, against the
!> closed form; special points on them, and what the normal forms predict beside them, against
!> roots of (5) and points of the curves.
module test_hopf_curves
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use characteristic_roots, only: find_roots
   use closed_form, only: closed_epsilon
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use hopf_condition, only: find_hopf_condition, hopf_condition_type
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: hopf_point_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use paper_equations, only: hopf_epsilon, relative_residual
   use pseudo_random, only: uniform
   use traced_planes, only: closed_delta, find_points, known_point, place_of, plane_number, &
                            planes, trace, traced_plane
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

   !> All tests of this suite.
   subroutine collect_hopf_curves(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("points in the window, on the curve", test_points), &
                   new_unittest("pieces are all there", test_pieces), &
                   new_unittest("crossing by theorem", test_crossing), &
                   new_unittest("second frequency", test_partner), &
                   new_unittest("special points of Figures 2 and 3", test_figures), &
                   new_unittest("directions against roots", test_directions), &
                   new_unittest("folds leave along the curve", test_fold_direction)]
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

   !> Both frequencies have the same epsilon, each is the other's partner.
   subroutine test_partner(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      type(failure_type), allocatable :: failure
      type(hopf_condition_type) :: c
      real(wp) :: partner, x(3)
      integer :: i

      call find_hopf_condition(p, c, failure)
      call expect_success(error, failure)
      do i = 1, 100
         x = 10.0_wp**uniform(i, 3, -1.0_wp, 1.0_wp)
         associate (omega => x(1), xi => x(2), gamma => x(3))
            partner = c%partner_omega(omega, hopf_epsilon(omega, xi, gamma), xi, gamma)
            call expect_close(error, (1.0_wp + hopf_epsilon(partner, xi, gamma)) &
                              /(1.0_wp + hopf_epsilon(omega, xi, gamma)), 1.0_wp, 1.0e-12_wp, &
                              "1 + epsilon over 1 + epsilon")
            associate (epsilon => hopf_epsilon(partner, xi, gamma))
               call expect_close(error, c%partner_omega(partner, epsilon, xi, gamma)/omega, &
                                 1.0_wp, 1.0e-9_wp, "partner of the partner")
            end associate
         end associate
      end do
   end subroutine test_partner

   !> Figure 2 has nine double points, six generalised ones and the point without delay as by Routh
   !> and Hurwitz; Figure 3 has five double points and two generalised ones.
   subroutine test_figures(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      character(len=*), parameter :: kinds(3) = ["double_hopf       ", "generalised_hopf  ", &
                                                 "hopf_without_delay"]
      integer, parameter :: known(3, 2) = reshape([9, 6, 1, 5, 2, 0], [3, 2])
      integer :: i, k

      do i = 1, 2
         call check_points(i, found, error)
         if (allocated(error)) return
         do k = 1, 3
            call expect(error, count(found%kind == kinds(k)) == known(k, i), &
                        text(known(k, i))//" points of kind "//trim(kinds(k)))
         end do
         call expect(error, size(found) == sum(known(:, i)), "no others")
         if (i == 2) exit
         associate (first => found(1))
            call expect_close(error, first%parameters%epsilon, 0.32_wp/1.14_wp, 1.0e-14_wp, &
                              "epsilon without delay")
            call expect_close(error, first%parameters%tau, 0.0_wp, 1.0e-14_wp, "tau")
            call expect_between(error, first%l1(1), -1.0_wp, -0.01_wp, "l1")
         end associate
      end do
   end subroutine test_figures

   !> The special points of a plane: their frequencies are roots of (5), the coefficient vanishes
   !> where it should, and beside a point of a curve the pairs are those of the map.
   subroutine check_points(i, found, error)
      integer, intent(in) :: i
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      type(curve_point_type), allocatable :: points(:)
      integer :: j, k

      call find_points(plane_number(i), points, found, error)
      if (allocated(error)) return
      do j = 1, size(found)
         associate (p => found(j)%parameters, omega => found(j)%omega)
            do k = 1, count(omega > 0.0_wp)
               call expect_between(error, relative_residual(p, cmplx(0.0_wp, omega(k), kind=wp)), &
                                   0.0_wp, 1.0e-12_wp, "residual of point "//text(j))
            end do
            select case (found(j)%kind)
            case ("generalised_hopf")
               call expect_close(error, found(j)%l1(1), 0.0_wp, 1.0e-13_wp, "l1")
            case ("double_hopf")
               call expect_between(error, omega(2) - omega(1), 0.01_wp, 10.0_wp, &
                                   "distance of the frequencies")
               call expect(error, found(j)%branch(2) > found(j)%branch(1), &
                           "the higher frequency is on the higher branch")
            case default
               call expect_close(error, p%tau, 0.0_wp, 1.0e-14_wp, "tau")
            end select
         end associate
      end do
      do j = 1, size(points) - 1
         associate (p => points(j), q => points(j + 1))
            if (p%piece /= q%piece .or. p%l1*q%l1 > 0.0_wp) cycle
            call expect(error, any(found%kind == "generalised_hopf" .and. found%omega(1) > p%omega &
                                   .and. found%omega(1) < q%omega &
                                   .and. found%branch(1) == p%branch), &
                        "l1 changes its sign at generalised points only")
         end associate
      end do
   end subroutine check_points

   !> A small way from a double Hopf point along the start of a curve of tori, the growth rates of
   !> both pairs have the ratio that the normal form gives, with p_jj and mu_j of different sign.
   subroutine test_directions(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      complex(wp), allocatable :: roots(:)
      type(block_equation_type) :: equation
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: growth(2)
      integer :: i, j, n, pair

      do n = 1, 2
         plane = plane_number(n)
         call find_points(plane, points, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            if (found(i)%kind /= "double_hopf") cycle
            do pair = 1, 2
               associate (p => found(i)%parameters, u => found(i)%unfolding)
                  equation = block_equation_type(plane%parameters( &
                             p%epsilon + step*u%start(1, pair), &
                             plane%ordinate(p) + step*u%start(2, pair)))
                  call find_roots(equation%linear, -0.05_wp, roots, failure)
                  call expect_success(error, failure)
                  if (allocated(error)) return
                  do j = 1, 2
                     growth(j) = real(roots(minloc(abs(roots - cmplx(0.0_wp, found(i)%omega(j), &
                                                                     kind=wp)), dim=1)))
                  end do
                  growth = growth/norm2(growth)
                  call expect_close(error, growth, u%form%torus_rates(pair), 1.0e-2_wp, &
                                    "growth rates at point "//text(i)//" of plane "//text(n))
                  call expect(error, growth(pair)*real(u%form%g(pair, pair)) < 0.0_wp, &
                              "the cycle exists")
               end associate
            end do
         end do
      end do
   end subroutine test_directions

   !> Towards that side of a generalised Hopf point on which l1 and l2 differ in sign, by l1 and
   !> places of nearby points of the curve.
   subroutine test_fold_direction(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(block_parameters_type) :: there
      real(wp) :: way(2)
      integer :: i, n, side

      do n = 1, 2
         plane = plane_number(n)
         call find_points(plane, points, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            if (found(i)%kind /= "generalised_hopf") cycle
            associate (p => found(i)%parameters, u => found(i)%unfolding)
               ! c1 = 0 here
               side = nint(-sign(1.0_wp, real(u%c2)*u%c1_slope))
               there = plane%at(found(i)%omega(1)*(1.0_wp + 1.0e-5_wp*side), found(i)%branch(1))
               way = [there%epsilon - p%epsilon, plane%ordinate(there) - plane%ordinate(p)]
               call expect_close(error, u%start(:, 1), way/norm2(way), 1.0e-3_wp, &
                                 "start of the folds at point "//text(i)//" of plane "//text(n))
               call expect_close(error, real(u%c1), 0.0_wp, 1.0e-13_wp, "Re c1")
            end associate
         end do
      end do
   end subroutine test_fold_direction
end module test_hopf_curves
