! SPDX-License-Identifier: BSD-3-Clause
!> Hopf points on lines of one parameter, of blocks against the closed form and against the number
!> of roots between them; lines and planes of x' = -a x - b x(t - 1), whose roots may be real, in
!> closed form (Hayes 1950): a root passes 0 where a + b = 0. A pair is on the axis where omega^2 =
!> b^2 - a^2, cos(omega) = -a/b and sin(omega) = omega/b, and leaves it to the right as |b| grows.
module test_hopf_lines
   use block_builder, only: block_at, by_epsilon, by_gamma, by_tau, by_xi, made
   use characteristic_function, only: characteristic_of
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use hopf_curves, only: curve_point_type, trace_curves
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use hopf_planes, only: curve_plane_type, middles, turn
   use hopf_points, only: judge_points
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use paper_equations, only: closed_epsilon, closed_tau, relative_residual
   use pseudo_random, only: uniform
   use root_counts, only: roots_right_of
   implicit none (type, external)
   private
   public :: collect_hopf_lines

contains

   subroutine collect_hopf_lines(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("with the delay and with epsilon", test_random_blocks), &
                   new_unittest("known crossings", test_known), &
                   new_unittest("along a law's own parameter", test_own_parameter), &
                   new_unittest("planes with real roots", test_real_planes), &
                   new_unittest("lines with real roots", test_real_lines)]
   end subroutine collect_hopf_lines

   !> Hopf points along one parameter of a model.
   subroutine find_along(model, along, ends, found, error)
      type(model_type), intent(in) :: model
      integer, intent(in) :: along
      real(wp), intent(in) :: ends(2)
      type(hopf_on_line_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: numbers(size(model%numbers), 2)

      numbers = spread(model%numbers, 2, 2)
      numbers(along, :) = ends
      call find_hopf_on_line(model, numbers(:, 1), numbers(:, 2), 400, found, failure)
      call expect_success(error, failure)
      if (.not. allocated(found)) allocate (found(0))
   end subroutine find_along

   !> Of random blocks, with the delay from 0, where the closed form says how many there are, and
   !> with epsilon from -1. Every third gamma is between 1e-2 and 1e12.
   subroutine test_random_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: found(:)
      type(model_type) :: block
      integer :: i, total(2)
      real(wp), parameter :: delays(2) = [0.0_wp, 25.0_wp], epsilons(2) = [-1.0_wp, 2.0_wp]
      real(wp) :: gamma, x(4)

      total = 0
      do i = 1, 30
         x = uniform(i, 4, 0.0_wp, 1.0_wp)
         gamma = merge(10.0_wp**(14.0_wp*x(4) - 2.0_wp), 0.3_wp + x(4), modulo(i, 3) == 0)
         block = block_at([15.0_wp*x(1), 1.5_wp*x(2), 0.2_wp + x(3), gamma])
         call find_along(block, by_tau, delays, found, error)
         call expect(error, size(found) == known_crossings(block%numbers, delays(2)), &
                     text(size(found))//" crossings with tau of block "//text(i))
         call check_points(block, by_tau, delays, found, error)
         total(1) = total(1) + size(found)
         call find_along(block, by_epsilon, epsilons, found, error)
         call check_points(block, by_epsilon, epsilons, found, error)
         call expect(error, all(found%roots_behind > found%roots_before), &
                     "a larger epsilon makes no pair stable")
         total(2) = total(2) + size(found)
      end do
      call expect(error, all(total > 50), "many crossings")
   end subroutine test_random_blocks

   !> Number of delays up to a longest at which a pair is on the axis: those of all branches at the
   !> frequencies that have this epsilon.
   pure integer function known_crossings(p, longest) result(number)
      real(wp), intent(in) :: p(:), longest
      real(wp), parameter :: least = 1.0e-3_wp, growth = 1.0001_wp, most = 4.0_wp
      real(wp) :: omega
      integer :: i, k

      number = 0
      do i = 0, ceiling(log(most/least)/log(growth))
         omega = least*growth**i
         associate (here => closed_epsilon(omega, p(by_xi), p(by_gamma)) - p(by_epsilon), &
                    next => closed_epsilon(omega*growth, p(by_xi), p(by_gamma)) - p(by_epsilon))
            if (here*next > 0.0_wp) cycle
         end associate
         associate (tau => closed_tau(omega, p(by_xi), p(by_gamma), [(k, k=0, 20)]))
            number = number + count(tau > 0.0_wp .and. tau < longest)
         end associate
      end do
   end function known_crossings

   !> Points are inside, have their pair on the axis, and the roots between them are counted.
   subroutine check_points(block, along, ends, found, error)
      type(model_type), intent(in) :: block
      integer, intent(in) :: along
      real(wp), intent(in) :: ends(2)
      type(hopf_on_line_type), intent(in) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: edges(0:size(found) + 1), places(size(found)), numbers(4)
      integer :: i, place, roots(0:1), side

      if (allocated(error)) return
      places = [(found(i)%numbers(along), i=1, size(found))]
      edges = [ends(1), places, ends(2)]
      do i = 1, size(found)
         edges(1 + count(places < places(i))) = places(i)
      end do
      do i = 1, size(found)
         place = 1 + count(places < places(i))
         numbers = block%numbers
         numbers(along) = places(i)
         call expect_close(error, found(i)%numbers, numbers, 0.0_wp, "parameters on the line")
         call expect_close(error, relative_residual(numbers, found(i)%omega), 0.0_wp, 1.0e-11_wp, &
                           "residual")
         call expect(error, places(i) > ends(1) .and. places(i) < ends(2), "inside")
         do side = 0, 1
            numbers(along) = 0.5_wp*(edges(place + side - 1) + edges(place + side))
            roots(side) = roots_right_of(characteristic_of(block_at(numbers)), 0.0_wp)
         end do
         call expect(error, all(roots == [found(i)%roots_before, found(i)%roots_behind]), &
                     "roots before and behind "//text(places(i)))
      end do
   end subroutine check_points

   !> At tau = 0 there is one epsilon, that of Routh and Hurwitz. Below the least epsilon of all
   !> curves no delay makes a change. Points with fewer turns in the delay come first. A line in tau
   !> meets Hopf points of lines in xi and gamma.
   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: across(:), found(:)
      integer, parameter :: along(2) = [by_xi, by_gamma]
      integer :: i, j

      call find_along(block_at([0.0_wp, 0.0_wp, 0.5_wp, 0.8_wp]), by_epsilon, [-1.0_wp, 5.0_wp], &
                      found, error)
      call expect(error, size(found) == 1, "one crossing without delay")
      if (allocated(error)) return
      call expect_close(error, found(1)%numbers(by_epsilon), 0.32_wp/1.14_wp, 1.0e-14_wp, "epsilon")
      call find_along(block_at([0.0_wp, 0.2_wp, 0.5_wp, 0.8_wp]), by_tau, [0.0_wp, 1.0e3_wp], &
                      found, error)
      call expect(error, size(found) == 0, "no crossing")
      do j = 1, size(along)
         call find_along(block_at([10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp]), along(j), &
                         [0.01_wp, 2.0_wp], found, error)
         call expect(error, size(found) > 0, "Hopf points")
         do i = 1, size(found)
            call find_along(block_at(found(i)%numbers), by_tau, [0.0_wp, 20.0_wp], across, error)
            associate (turns => nint(across%omega*across%delay/turn), n => size(across))
               call expect(error, all(turns(2:) >= turns(:n - 1)), "fewer turns first")
            end associate
            call expect_close(error, minval(abs(across%delay - 10.0_wp)), 0.0_wp, 1.0e-9_wp, &
                              "tau of the line across")
         end do
      end do
   end subroutine test_known

   !> About steady sliding the law with a cut-off is the paper's at (1 + c) xi.
   subroutine test_own_parameter(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: along_c(:), of_paper(:)
      integer :: i

      call find_along(block_at([10.0_wp, 0.5_wp, 0.4_wp, 0.8_wp]), by_xi, [0.4_wp, 4.0_wp], &
                      of_paper, error)
      call find_along(block_at([10.0_wp, 0.5_wp, 0.4_wp, 0.8_wp], "slip_cut_off"), by_gamma + 1, &
                      [0.0_wp, 9.0_wp], along_c, error)
      call expect(error, size(along_c) > 0 .and. size(along_c) == size(of_paper), "as many")
      if (allocated(error)) return
      do i = 1, size(along_c)
         call expect_close(error, [0.4_wp*(1.0_wp + along_c(i)%numbers(by_gamma + 1)), &
                                   along_c(i)%omega], &
                           [of_paper(i)%numbers(by_xi), of_paper(i)%omega], 1.0e-12_wp, &
                           "(1 + c) xi and omega")
      end do
   end subroutine test_own_parameter

   !> No pair on the axis; three curves, one of them from the double root 0 at a = -1, b = 1, beyond
   !> which the number of roots changes from 1 to 2 without a curve. At that point Delta is s**2/2
   !> near 0, to rounding 0 below 1e-8: counting comes to an end.
   subroutine test_real_planes(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_plane_type) :: plane
      integer :: roots(1, 1)

      call check_window([-3.0_wp, 3.0_wp, -4.1_wp, 0.0_wp], [0, 1], 0, error)
      call check_window([-3.0_wp, 3.0_wp, -12.0_wp, 4.0_wp], [0, 1, 2, 3, 5], 3, error)
      plane = plane_of([-1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp])
      roots = plane%unstable_roots([0.0_wp], [1.0_wp])
      call expect(error, roots(1, 1) >= 0 .and. roots(1, 1) <= 2, text(roots(1, 1))//" roots")
   end subroutine test_real_planes

   !> The plane of a and b.
   type(curve_plane_type) function plane_of(window) result(plane)
      !> On a, then on b
      real(wp), intent(in) :: window(4)

      plane%model = made("made_decay", [0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp], keep_delays=.true.)
      plane%along = [2, 3]
      plane%window = reshape(window, [2, 2])
   end function plane_of

   !> A window on a and b: its numbers of roots, and as many pieces of curves.
   subroutine check_window(window, numbers, pieces, error)
      real(wp), intent(in) :: window(4)
      integer, intent(in) :: numbers(:), pieces
      type(error_type), allocatable, intent(inout) :: error
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(failure_type), allocatable :: failure
      integer, allocatable :: roots(:, :)
      integer, parameter :: cells = 30
      real(wp) :: grid(cells + 2), p(3)
      integer :: i, j

      plane = plane_of(window)
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
   subroutine test_real_lines(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: found(:)

      call find_along(made("made_decay", [0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp], keep_delays=.true.), &
                      3, [-0.5_wp, -12.0_wp], found, error)
      call expect_close(error, found%omega, [0.75_wp, 1.75_wp]*turn, 1.0e-12_wp, "omega = -b")
      if (allocated(error)) return
      call expect(error, all(found%roots_before == [1, 3] .and. found%roots_behind == [3, 5]), &
                  "roots before and behind the points")
      call find_along(made("made_decay", [0.0_wp, -2.0_wp, 0.0_wp], [0.0_wp], &
                           keep_delays=.true.), 3, [0.0_wp, 4.0_wp], found, error)
      call expect(error, size(found) == 0, "no pair on the axis")
   end subroutine test_real_lines
end module test_hopf_lines
