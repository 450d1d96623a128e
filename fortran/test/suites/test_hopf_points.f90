! SPDX-License-Identifier: BSD-3-Clause
!> Special points of the Hopf curves of Figures 2 and 3, and what the normal forms predict beside
!> them: directions against roots and points of the curves; cycles against harmonic balance and
!> continuation.
module test_hopf_points
   use block_builder, only: block_at, build_block, by_epsilon, by_tau, by_xi
   use centre_manifold, only: normal_form_coefficient
   use characteristic_function, only: characteristic_of, characteristic_type
   use cycle_branches, only: cycle_line_type, cycle_settings_type, cycles_type, find_cycles, &
                             left_out_type
   use cycle_curves, only: cycle_curve_type, find_curves
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use harmonic_balance, only: find_cycle
   use hopf_curves, only: curve_point_type
   use hopf_lines, only: hopf_on_line_type
   use hopf_normal_form, only: first_lyapunov_coefficient
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: find_hopf_points, hopf_point_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_roots, only: find_model_roots
   use paper_equations, only: block_with_pair, relative_residual
   use special_points, only: fold, torus_bifurcation
   use traced_planes, only: find_points, known_numbers, new_plane, plane_number, planes
   implicit none (type, external)
   private
   public :: collect_hopf_points

contains

   subroutine collect_hopf_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("special points of Figures 2 and 3", test_figures), &
                   new_unittest("cycles by harmonic balance", test_cycles), &
                   new_unittest("a coefficient that is 0 but for rounding", test_rounding), &
                   new_unittest("curves start at special Hopf points", test_ends), &
                   new_unittest("a closed branch", test_closed)]
   end subroutine collect_hopf_points

   !> Figure 2 has nine double points, six generalised ones and the point without delay as by Routh
   !> and Hurwitz, Figure 3 five and two. Where no point of a plane has a delay, none is special.
   subroutine test_figures(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      integer :: i

      call check_figure(1, [9, 6, 1], found, error)
      if (allocated(error)) return
      i = findloc(found%kind == "hopf_without_delay", .true., dim=1)
      call expect_close(error, found(i)%numbers, [0.0_wp, 0.32_wp/1.14_wp, 0.5_wp, 0.8_wp], &
                        1.0e-14_wp, "parameters without delay")
      call expect_between(error, found(i)%l1(1), -1.0_wp, -0.01_wp, "l1")
      call check_figure(2, [5, 2, 0], found, error)
      call check_figure(planes, [0, 0, 0], found, error)
   end subroutine test_figures

   !> At gamma = 1e8 the coefficient is 0 without delay. Its rounding error, of either sign, makes
   !> no generalised Hopf point.
   subroutine test_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: found(:)
      integer :: i, sense

      plane = new_plane(by_tau, 1.0e8_wp, 0.5_wp, [0.3_wp, 0.7_wp, 0.0_wp, 1.0_wp])
      call find_points(plane, points, found, error)
      if (allocated(error)) return
      i = minloc([(points(i)%numbers(by_tau), i=1, size(points))], dim=1)
      call expect_between(error, abs(points(i)%l1), 0.0_wp, 1.0e-15_wp, "coefficient")
      do sense = -1, 1, 2
         points(i)%l1 = sense*1.0e-17_wp
         call find_hopf_points(plane, points, found, failure)
         call expect_success(error, failure)
         call expect(error, count(found%kind == "generalised_hopf") == 0, "no such point")
      end do
   end subroutine test_rounding

   !> The special points of a plane: their frequencies are roots of (5), the coefficient vanishes
   !> where it should, and nowhere else.
   subroutine check_figure(n, known, found, error)
      integer, intent(in) :: n
      !> Points of each kind
      integer, intent(in) :: known(3)
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), parameter :: kinds(3) = ["double_hopf       ", "generalised_hopf  ", &
                                                 "hopf_without_delay"]
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      integer :: j, k

      plane = plane_number(n)
      call find_points(plane, points, found, error)
      if (allocated(error)) return
      do k = 1, size(kinds)
         call expect(error, count(found%kind == kinds(k)) == known(k), text(known(k)) &
                     //" points of kind "//trim(kinds(k))//", not " &
                     //text(count(found%kind == kinds(k))))
      end do
      call expect(error, size(found) == sum(known), "no others")
      do j = 1, size(found)
         if (allocated(error)) return
         associate (point => found(j), omega => found(j)%omega)
            do k = 1, count(omega > 0.0_wp)
               call expect_close(error, relative_residual(point%numbers, omega(k)), 0.0_wp, &
                                 1.0e-12_wp, "residual of point "//text(j))
            end do
            select case (point%kind)
            case ("generalised_hopf")
               call expect_close(error, [point%l1(1), real(point%unfolding%c1)], &
                                 [0.0_wp, 0.0_wp], 1.0e-12_wp, "l1 and Re c1")
               call check_fold_direction(plane, point, error)
            case ("double_hopf")
               call expect_between(error, omega(2) - omega(1), 0.01_wp, 10.0_wp, &
                                   "distance of the frequencies")
               call expect(error, point%branch(2) > point%branch(1), &
                           "the higher frequency is on the higher branch")
               call check_torus_directions(plane, point, error)
            case default
               call expect_close(error, point%numbers(by_tau), 0.0_wp, 1.0e-14_wp, "tau")
            end select
         end associate
      end do
      do j = 1, size(points) - 1
         associate (p => points(j), q => points(j + 1))
            if (p%piece /= q%piece .or. p%l1*q%l1 > 0.0_wp) cycle
            call expect(error, any(found%kind == "generalised_hopf" &
                                   .and. found%omega(1) > p%at%omega &
                                   .and. found%omega(1) < q%at%omega &
                                   .and. found%branch(1) == p%branch), &
                        "l1 changes its sign at generalised points only")
         end associate
      end do
   end subroutine check_figure

   !> A small way from a double Hopf point along the start of a curve of tori, the growth rates of
   !> both pairs have the ratio that the normal form gives, with p_jj and mu_j of different sign.
   subroutine check_torus_directions(plane, point, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: growth(2), numbers(4)
      integer :: j, pair

      do pair = 1, 2
         numbers = point%numbers
         numbers(plane%along) = numbers(plane%along) + step*point%unfolding%start(:, pair)
         call find_model_roots(block_at(numbers), -0.05_wp, roots, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         do j = 1, 2
            growth(j) = real(roots(minloc(abs(roots - cmplx(0.0_wp, point%omega(j), kind=wp)), &
                                          dim=1)))
         end do
         growth = growth/norm2(growth)
         associate (form => point%unfolding%form)
            call expect_close(error, growth, form%torus_rates(pair), 1.0e-2_wp, "growth rates")
            call expect(error, growth(pair)*real(form%g(pair, pair)) < 0.0_wp, "the cycle exists")
         end associate
      end do
   end subroutine check_torus_directions

   !> Folds start along the curve towards that side of a generalised Hopf point on which l1 and l2
   !> differ in sign, by l1 and places of points beside it in closed form.
   subroutine check_fold_direction(plane, point, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: l1, omega, there(4), way(2)
      integer :: side

      associate (u => point%unfolding)
         do side = -1, 1, 2
            omega = point%omega(1)*(1.0_wp + 1.0e-5_wp*side)
            there = known_numbers(plane, omega, point%branch(1))
            call first_lyapunov_coefficient(block_at(there), omega, l1, failure)
            call expect_success(error, failure)
            if (l1*real(u%c2) > 0.0_wp) cycle
            way = there(plane%along) - point%numbers(plane%along)
            call expect_close(error, u%start(:, 1), way/norm2(way), 1.0e-3_wp, "start of the folds")
         end do
      end associate
   end subroutine check_fold_direction

   !> The side of a cycle is the sign of l1, by harmonic balance: with the amplitude |z| = r of the
   !> pair, epsilon and frequency of the cycle change by e r^2 and f r^2, with 0 = Re(c1 + e
   !> ds/depsilon) and f = Im(c1 + e ds/depsilon), but for terms of order r^4, which two amplitudes
   !> take away.
   subroutine test_cycles(error)
      type(error_type), allocatable, intent(out) :: error
      type(characteristic_type) :: delta
      type(failure_type), allocatable :: failure
      complex(wp) :: c1, slope
      real(wp), parameter :: amplitude = 0.02_wp
      real(wp) :: change(2, 2), frequency, epsilon, l1, omega, p(4)
      integer :: i, k, sides(-1:1), step

      sides = 0
      do i = 1, 12
         omega = 0.12_wp*i
         do k = 1, 3
            p = block_with_pair(omega, 0.5_wp, 0.8_wp, k)
            call normal_form_coefficient(block_at(p), [omega], [2, 1], c1, failure)
            call expect_success(error, failure)
            call first_lyapunov_coefficient(block_at(p), omega, l1, failure)
            call expect_success(error, failure)
            do step = 1, 2
               associate (r => amplitude/step)
                  call find_cycle(block_at(p), omega, r, epsilon, frequency, error)
                  change(:, step) = ([epsilon, frequency] - [p(by_epsilon), omega])/r**2
               end associate
            end do
            if (allocated(error)) return
            change(:, 2) = (4.0_wp*change(:, 2) - change(:, 1))/3.0_wp
            delta = characteristic_of(block_at(p))
            slope = delta%root_by(by_epsilon, cmplx(0.0_wp, omega, kind=wp))
            associate (known => -real(c1)/real(slope))
               call expect_close(error, change(:, 2), [known, aimag(c1 + known*slope)], &
                                 1.0e-4_wp*abs(c1), "changes at omega = "//text(omega))
            end associate
            sides(nint(sign(1.0_wp, l1))) = sides(nint(sign(1.0_wp, l1))) + 1
            call expect(error, l1*change(1, 2) < 0.0_wp .eqv. real(slope) > 0.0_wp, "the side")
         end do
      end do
      call expect(error, all(sides([-1, 1]) > 3), "cycles on both sides")
   end subroutine test_cycles

   !> Where the first Lyapunov coefficient vanishes, a curve of folds of cycles begins; where two
   !> pairs of roots are imaginary, a curve of torus points.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_end(settings_on(by_epsilon, [5.9_wp, 0.0_wp, 0.8_wp, 0.8_wp], &
                                  [0.3_wp, 0.6_wp]), &
                      [0.3_wp, 0.6_wp, 5.0_wp, 6.0_wp], fold, "generalised_hopf", error)
      call expect_end(settings_on(by_tau, [0.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], &
                                  [12.0_wp, 12.8_wp]), &
                      [0.4_wp, 0.6_wp, 11.5_wp, 12.8_wp], torus_bifurcation, "double_hopf", error)
   end subroutine test_ends

   !> The curves of a kind that start on a line end at a Hopf point of another kind, of those in the
   !> plane of epsilon and tau.
   subroutine expect_end(line, window, kind, ending, error)
      type(cycle_settings_type), intent(in) :: line
      real(wp), intent(in) :: window(4)
      character(len=*), intent(in) :: kind, ending
      type(error_type), allocatable, intent(inout) :: error
      type(curve_point_type), allocatable :: points(:)
      type(cycle_settings_type) :: settings
      type(cycle_curve_type), allocatable :: curves(:)
      type(cycles_type), allocatable :: found(:)
      type(left_out_type), allocatable :: left_out(:)
      type(failure_type), allocatable :: failure
      type(hopf_on_line_type), allocatable :: hopf(:)
      type(hopf_point_type), allocatable :: special(:)
      integer :: ends, i, j, k

      if (allocated(error)) return
      settings = line
      settings%curve_along = [by_epsilon, by_tau]
      settings%curve_window = reshape(window, [2, 2])
      call find_cycles(settings, hopf, found, left_out, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_curves(settings, found, curves, failure)
      call expect_success(error, failure)
      call find_points(new_plane(by_tau, 0.8_wp, settings%line%model%numbers(by_xi), window), &
                       points, special, error)
      if (allocated(error)) return
      ends = 0
      do i = 1, size(curves)
         do k = 1, 2
            associate (part => curves(i)%parts(k))
               if (part%points(1)%kind /= kind .or. part%ending /= ending) cycle
               ends = ends + 1
               associate (last => part%points(size(part%points))%orbit%parameters)
                  call expect(error, any([(special(j)%kind == ending .and. &
                                           all(abs(special(j)%numbers - last) < 1.0e-4_wp), &
                                           j=1, size(special))]), "end of the curve")
               end associate
            end associate
         end do
      end do
      call expect(error, ends > 0, "a curve of kind "//kind//" with the end "//ending)
   end subroutine expect_end

   !> A line without trajectories, of a coarse mesh.
   function settings_on(along, parameters, window) result(settings)
      integer, intent(in) :: along
      !> tau, epsilon, xi, gamma, and the window on the line
      real(wp), intent(in) :: parameters(4), window(2)
      type(cycle_settings_type) :: settings

      settings%line = cycle_line_type(block_at(parameters), along, window)
      allocate (settings%starts(0))
      settings%degree = 5
      settings%intervals = 20
      settings%most_orbits = 40
   end function settings_on

   !> Cycles of three maxima exist between two folds: their branch is closed and is found once.
   subroutine test_closed(error)
      type(error_type), allocatable, intent(out) :: error
      type(cycle_settings_type) :: settings
      type(cycles_type), allocatable :: found(:)
      type(left_out_type), allocatable :: left_out(:)
      type(failure_type), allocatable :: failure
      type(hopf_on_line_type), allocatable :: hopf(:)

      settings%line = cycle_line_type(build_block(0.0_wp, 0.7_wp, 0.5_wp, 0.8_wp, v=1.1_wp), &
                                      by_tau, [4.8_wp, 5.2_wp])
      settings%starts = [5.0_wp, 5.0_wp]
      settings%most_orbits = 100
      call find_cycles(settings, hopf, found, left_out, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, size(hopf) == 0 .and. size(found) == 1 .and. size(left_out) == 1, &
                  "no Hopf point, one branch, and a start left out")
      if (allocated(error)) return
      call expect(error, found(1)%branch%ending == "closed", "a closed branch")
      call expect(error, size(found(1)%points) == 2 .and. all(found(1)%points%kind == fold), &
                  "two folds")
      call expect(error, left_out(1)%reason == "its cycle is on a branch", "why it is left out")
      call expect_close(error, left_out(1)%at, 5.0_wp, 0.0_wp, "and where")
   end subroutine test_closed
end module test_hopf_points
