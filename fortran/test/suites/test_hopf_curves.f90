! SPDX-License-Identifier: BSD-3-Clause
!> Hopf curves of the block in their windows, those of the paper's Figures 2 and 3 and seven more,
!> against the closed form; curves of other models against numbers of roots.
module test_hopf_curves
   use block_builder, only: block_at, by_epsilon, by_tau, made
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use hopf_curves, only: curve_point_type
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: hopf_point_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use paper_equations, only: relative_residual
   use traced_planes, only: find_points, known_place, plane_number, planes, trace
   implicit none (type, external)
   private
   public :: collect_hopf_curves

   !> Rounding in units of the window.
   real(wp), parameter :: rounding = 1.0e-12_wp

contains

   !> All tests of this suite.
   subroutine collect_hopf_curves(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("curves in their windows", test_curves), &
                   new_unittest("curves of other models", test_models)]
   end subroutine collect_hopf_curves

   !> All planes.
   subroutine test_curves(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      integer :: counts(-1:1), i, number, total

      counts = 0
      total = 0
      do i = 1, planes
         plane = plane_number(i)
         call trace(plane, points, error)
         if (allocated(error)) return
         call check_points(plane, points, "plane "//text(i), error)
         call check_lines(plane, points, "plane "//text(i), number, error)
         call check_crossing(plane, points, "plane "//text(i), counts, error)
         if (allocated(error)) return
         total = total + number
      end do
      call expect(error, total > 30 .and. all(counts([-1, 1]) > 100), "both crossings occur")
   end subroutine test_curves

   !> Every point lies in the window and on its branch's curve, and solves (5). Within a piece omega
   !> ascends, chords are short, and the curve between them is near.
   subroutine check_points(plane, points, name, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(in) :: points(:)
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(inout) :: error
      real(wp), dimension(2) :: chord, middle
      integer :: j

      do j = 1, size(points)
         associate (point => points(j), place => points(j)%at%place, omega => points(j)%at%omega)
            call expect_between(error, minval(place), -rounding, 1.0_wp, "place in "//name)
            call expect_between(error, maxval(place), 0.0_wp, 1.0_wp + rounding, "place in "//name)
            call expect_close(error, place, known_place(plane, omega, point%branch), rounding, &
                              "place in closed form in "//name)
            call expect_close(error, [point%residual, relative_residual(point%numbers, omega)], &
                              [0.0_wp, 0.0_wp], 1.0e-13_wp, "residuals in "//name)
         end associate
      end do
      do j = 1, size(points) - 1
         associate (p => points(j), q => points(j + 1))
            call expect(error, any(q%piece - p%piece == [0, 1]), "pieces in turn in "//name)
            if (p%piece /= q%piece) cycle
            chord = q%at%place - p%at%place
            middle = known_place(plane, 0.5_wp*(p%at%omega + q%at%omega), p%branch) - p%at%place
            call expect(error, q%at%omega > p%at%omega .and. q%branch == p%branch, &
                        "omega ascends on one branch in "//name)
            call expect_between(error, norm2(chord), 0.0_wp, 0.02_wp + rounding, "chord")
            call expect_between(error, abs(chord(1)*middle(2) - chord(2)*middle(1)), 0.0_wp, &
                                1.0e-4_wp*norm2(chord) + rounding, "chord times its deviation")
         end associate
      end do
   end subroutine check_points

   !> The number of unstable roots changes with a growing ordinate as the crossing says.
   subroutine check_crossing(plane, points, name, counts, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(in) :: points(:)
      character(len=*), intent(in) :: name
      integer, intent(inout) :: counts(-1:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), parameter :: h = 1.0e-6_wp
      integer :: j, roots(1, 2)

      do j = 1, size(points)
         associate (point => points(j), place => points(j)%at%place)
            roots = plane%unstable_roots(place(1:1), place(2) + [-h, h])
            ! where the curve is upright none changes; at a crossing of curves another pair may
            if (abs(roots(1, 2) - roots(1, 1)) /= 2) cycle
            counts(point%crossing) = counts(point%crossing) + 1
            call expect(error, 2*point%crossing == roots(1, 2) - roots(1, 1), &
                        "crossing at point "//text(j)//" of "//name)
         end associate
      end do
   end subroutine check_crossing

   !> On lines across the planes of other models, also of a law's own parameters and of two delays,
   !> the curves are where the number of unstable roots changes. Special points have their roots.
   subroutine test_models(error)
      type(error_type), allocatable, intent(out) :: error

      call check_model(block_at([0.0_wp, 0.0_wp, 0.5_wp, 0.8_wp], "ageing_delayed_velocity"), &
                       [by_epsilon, by_tau], [0.0_wp, 1.5_wp, 0.0_wp, 20.0_wp], error)
      ! c and zeta follow the parameters of all blocks
      call check_model(block_at([0.0_wp, 1.5_wp, 0.5_wp, 0.8_wp, 0.5_wp, 0.0_wp], &
                                "quasistatic_slip_cut_off"), &
                       [6, by_tau], [0.0_wp, 0.5_wp, 0.0_wp, 20.0_wp], error)
      call check_model(made("made_decay", [1.0_wp, 1.0_wp, 0.0_wp], [0.0_wp], keep_delays=.true.), &
                       [3, 1], [0.0_wp, 2.4_wp, 0.0_wp, 6.0_wp], error)
   end subroutine test_models

   !> A plane of a model.
   subroutine check_model(model, along, window, error)
      type(model_type), intent(in) :: model
      integer, intent(in) :: along(2)
      real(wp), intent(in) :: window(4)
      type(error_type), allocatable, intent(inout) :: error
      type(characteristic_type) :: c
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: special(:)
      integer :: i, j, number

      if (allocated(error)) return
      plane%model = model
      plane%along = along
      plane%window = reshape(window, [2, 2])
      call find_points(plane, points, special, error)
      if (allocated(error)) return
      do i = 1, size(special)
         c = characteristic_of(plane%model_at(special(i)%numbers))
         do j = 1, count(special(i)%omega > 0.0_wp)
            call expect_close(error, c%relative_residual(cmplx(0.0_wp, special(i)%omega(j), wp)), &
                              0.0_wp, 1.0e-12_wp, "residual of special point "//text(i))
         end do
      end do
      call check_lines(plane, points, "another model", number, error)
      call expect(error, number > 2, "Hopf points on lines")
   end subroutine check_model

   !> On lines across a plane the curves are where the number of unstable roots changes.
   subroutine check_lines(plane, points, name, number, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(in) :: points(:)
      character(len=*), intent(in) :: name
      !> Hopf points that are known
      integer, intent(out) :: number
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(hopf_on_line_type), allocatable :: known(:)
      real(wp), parameter :: columns(3) = [0.31_wp, 0.49_wp, 0.88_wp]
      real(wp) :: place(2)
      real(wp), allocatable :: found(:)
      integer :: i, j

      number = 0
      do i = 1, size(columns)
         if (allocated(error)) return
         associate (x => columns(i))
            call find_hopf_on_line(plane%model, plane%numbers_at([x, 0.0_wp]), &
                                   plane%numbers_at([x, 1.0_wp]), 400, known, failure)
            call expect_success(error, failure)
            found = ordinates_at(points, x)
         end associate
         call expect(error, size(found) == size(known), text(size(found))//" instead of " &
                     //text(size(known))//" Hopf points on line "//text(i)//" of "//name)
         number = number + size(known)
         do j = 1, size(known)
            if (allocated(error)) return
            place = plane%place_of(known(j)%numbers)
            call expect_close(error, minval(abs(found - place(2))), 0.0_wp, 5.0e-4_wp, &
                              "distance of a Hopf point on line "//text(i)//" of "//name)
         end do
      end do
   end subroutine check_lines

   !> Ordinates at which the pieces pass an abscissa, in units of the window.
   function ordinates_at(points, x) result(ordinates)
      type(curve_point_type), intent(in) :: points(:)
      real(wp), intent(in) :: x
      real(wp), allocatable :: ordinates(:)
      integer :: j

      allocate (ordinates(0))
      do j = 1, size(points) - 1
         associate (p => points(j)%at%place, q => points(j + 1)%at%place)
            if (points(j)%piece /= points(j + 1)%piece) cycle
            if ((p(1) - x)*(q(1) - x) > 0.0_wp) cycle
            ordinates = [ordinates, p(2) + (q(2) - p(2))*(x - p(1))/(q(1) - p(1))]
         end associate
      end do
   end function ordinates_at
end module test_hopf_curves
