! SPDX-License-Identifier: BSD-3-Clause
!> Special points of the Hopf curves of Figures 2 and 3, and what the normal forms predict beside
!> them: directions against roots and points of the curves, cycles against harmonic balance.
module test_hopf_points
   use block_builder, only: block_at, by_epsilon, by_tau, index_of_ln_v
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use harmonic_balance, only: find_cycle
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type, turn
   use hopf_points, only: find_hopf_points, hopf_point_type
   use hopf_unfoldings, only: way_to_growth
   use linear_system, only: linear_part
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_roots, only: find_model_roots
   use normal_form, only: critical_vectors, first_lyapunov_coefficient
   use paper_equations, only: relative_residual
   use traced_planes, only: find_points, known_numbers, new_plane, plane_number, planes
   implicit none (type, external)
   private
   public :: collect_hopf_points

   !> Amplitude |z| of the cycles.
   real(wp), parameter :: amplitude = 0.02_wp

   !> A cycle near a special point.
   type :: cycle_type
      !> Parameters
      real(wp) :: numbers(4) = 0.0_wp
      real(wp) :: period = 0.0_wp
   end type cycle_type

contains

   !> All tests of this suite.
   subroutine collect_hopf_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("special points of Figure 2", test_figure_2), &
                   new_unittest("special points of Figure 3", test_figure_3), &
                   new_unittest("no special points without delay", test_no_delay), &
                   new_unittest("a coefficient that is 0 but for rounding", test_rounding)]
   end subroutine collect_hopf_points

   !> Figure 2 has nine double points, six generalised ones and the point without delay as by Routh
   !> and Hurwitz.
   subroutine test_figure_2(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      integer :: i

      call check_figure(1, [9, 6, 1], found, error)
      if (allocated(error)) return
      i = findloc(found%kind == "hopf_without_delay", .true., dim=1)
      call expect_close(error, found(i)%numbers, [0.0_wp, 0.32_wp/1.14_wp, 0.5_wp, 0.8_wp], &
                        1.0e-14_wp, "parameters without delay")
      call expect_between(error, found(i)%l1(1), -1.0_wp, -0.01_wp, "l1")
   end subroutine test_figure_2

   !> Figure 3 has five double points and two generalised ones.
   subroutine test_figure_3(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)

      call check_figure(2, [5, 2, 0], found, error)
   end subroutine test_figure_3

   !> Where no point of a plane has a delay, none is special for that.
   subroutine test_no_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)

      call check_figure(planes, [0, 0, 0], found, error)
   end subroutine test_no_delay

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
               call expect_between(error, relative_residual(point%numbers, &
                                                            cmplx(0.0_wp, omega(k), kind=wp)), &
                                   0.0_wp, 1.0e-12_wp, "residual of point "//text(j))
            end do
            select case (point%kind)
            case ("generalised_hopf")
               call expect_close(error, point%l1(1), 0.0_wp, 1.0e-12_wp, "l1")
               call check_fold_direction(plane, point, error)
               call check_fold(plane, point, error)
            case ("double_hopf")
               call expect_between(error, omega(2) - omega(1), 0.01_wp, 10.0_wp, &
                                   "distance of the frequencies")
               call expect(error, point%branch(2) > point%branch(1), &
                           "the higher frequency is on the higher branch")
               call check_torus_directions(plane, point, error)
               call check_torus(plane, point, 1, error)
               call check_torus(plane, point, 2, error)
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
         call expect_close(error, real(u%c1), 0.0_wp, 1.0e-12_wp, "Re c1")
      end associate
   end subroutine check_fold_direction

   !> Epsilon along cycles of growing amplitude has its extreme at the fold. With the share of the
   !> square of the predicted amplitude it is a parabola, the depth of which is the distance from
   !> the Hopf curve. The period there, by its change along the cycles.
   subroutine check_fold(plane, point, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(cycle_type) :: fold
      real(wp), parameter :: shares(-1:1) = [0.5_wp, 1.0_wp, 1.5_wp]
      real(wp) :: curvature, epsilon(-1:1), frequency(-1:1), period_error(-1:1), slope
      integer :: j

      call predict_fold(plane, point, fold, failure)
      call expect_success(error, failure)
      do j = -1, 1
         call follow(point, 1, fold%numbers, amplitude*sqrt(shares(j)), epsilon(j), frequency(j), &
                     error)
         if (allocated(error)) return
      end do
      slope = epsilon(1) - epsilon(-1)
      curvature = 4.0_wp*(epsilon(1) - 2.0_wp*epsilon(0) + epsilon(-1))
      call expect_between(error, -slope/curvature, -0.01_wp, 0.01_wp, "share at the fold less 1")
      call expect_close(error, epsilon(0), fold%numbers(by_epsilon), &
                        0.01_wp*abs(0.5_wp*curvature), "epsilon of the fold")
      period_error = turn/frequency - fold%period
      call expect_between(error, period_error(0)/period_error(-1), -0.01_wp, 0.01_wp, &
                          "error of the period over its change")
   end subroutine check_fold

   !> The cycle of the predicted amplitude has the predicted epsilon and period, by their distances
   !> from the double Hopf point.
   subroutine check_torus(plane, point, pair, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      integer, intent(in) :: pair
      type(error_type), allocatable, intent(inout) :: error
      type(cycle_type) :: torus
      real(wp) :: epsilon, frequency

      torus = predict_torus(plane, point, pair)
      call follow(point, pair, torus%numbers, amplitude, epsilon, frequency, error)
      if (allocated(error)) return
      call expect_between(error, (epsilon - torus%numbers(by_epsilon)) &
                          /(torus%numbers(by_epsilon) - point%numbers(by_epsilon)), &
                          -2.0e-3_wp, 2.0e-3_wp, "error of epsilon over its change")
      call expect_between(error, (turn/frequency - torus%period) &
                          /(torus%period - turn/point%omega(pair)), -2.0e-3_wp, 2.0e-3_wp, &
                          "error of the period over its change")
   end subroutine check_torus

   !> The cycle of a pair whose oscillation has the amplitude |z|, by harmonic balance.
   subroutine follow(point, pair, numbers, size_of_z, epsilon, frequency, error)
      type(hopf_point_type), intent(in) :: point
      integer, intent(in) :: pair
      real(wp), intent(in) :: numbers(:), size_of_z
      real(wp), intent(out) :: epsilon, frequency
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      complex(wp) :: p(3), q(3)

      call critical_vectors(linear_part(block_at(point%numbers)), &
                            cmplx(0.0_wp, point%omega(pair), kind=wp), q, p, failure)
      call expect_success(error, failure)
      call find_cycle(block_at(numbers), point%omega(pair), q, &
                      2.0_wp*abs(q(index_of_ln_v))*size_of_z, epsilon, frequency, error)
   end subroutine follow

   !> A fold of cycles near a generalised Hopf point.
   subroutine predict_fold(plane, point, fold, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      type(cycle_type), intent(out) :: fold
      type(failure_type), allocatable, intent(out) :: error
      complex(wp) :: c1, slopes(2)
      real(wp) :: beside(2), c1_slope, epsilon_step, omega
      real(wp), parameter :: share = 1.0e-4_wp
      integer :: i

      do i = 1, 2
         call coefficient_at(point%omega(1)*(1.0_wp + share*(2*i - 3)), c1)
         if (allocated(error)) return
         beside(i) = real(c1)
      end do
      c1_slope = (beside(2) - beside(1))/(2.0_wp*share*point%omega(1))
      associate (c2 => point%unfolding%c2, r => amplitude**2)
         omega = point%omega(1) - 2.0_wp*real(c2)*r/c1_slope
         call coefficient_at(omega, c1)
         if (allocated(error)) return
         fold%numbers = known_numbers(plane, omega, point%branch(1))
         slopes = plane%root_slopes(fold%numbers, cmplx(0.0_wp, omega, kind=wp))
         epsilon_step = real(c2)*r**2/real(slopes(1))
         fold%numbers(by_epsilon) = fold%numbers(by_epsilon) + epsilon_step
         fold%period = turn/(omega + aimag(slopes(1))*epsilon_step + aimag(c1)*r)
      end associate

   contains

      !> The coefficient of z |z|^2 on the curve.
      subroutine coefficient_at(omega, c1)
         real(wp), intent(in) :: omega
         complex(wp), intent(out) :: c1

         call normal_form_coefficient(block_at(known_numbers(plane, omega, point%branch(1))), &
                                      [omega], [2, 1], c1, error)
      end subroutine coefficient_at
   end subroutine predict_fold

   !> A torus bifurcation of the cycle of a pair near a double Hopf point.
   type(cycle_type) function predict_torus(plane, point, pair) result(torus)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      integer, intent(in) :: pair
      complex(wp) :: slopes(2)
      real(wp) :: way(2)

      associate (form => point%unfolding%form)
         way = way_to_growth(plane, point%numbers, form%omega, &
                             -amplitude**2*real(form%g(:, pair)))
         slopes = plane%root_slopes(point%numbers, cmplx(0.0_wp, form%omega(pair), kind=wp))
         torus%numbers = point%numbers
         torus%numbers(plane%along) = torus%numbers(plane%along) + way
         torus%period = turn/(form%omega(pair) + sum(aimag(slopes)*way) &
                              + amplitude**2*aimag(form%g(pair, pair)))
      end associate
   end function predict_torus
end module test_hopf_points
