!> Special points of Hopf curves and the number of unstable pairs in the planes of Figures 2 and 3;
!> what the normal forms predict beside them, against roots of (5) and cycles by harmonic balance.
module test_hopf_points
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: relative_residual
   use characteristic_roots, only: find_roots
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use harmonic_balance, only: find_cycle
   use hopf_condition, only: hopf_epsilon, partner_omega, two_pi
   use hopf_planes, only: curve_plane_type
   use hopf_point_runs, only: cycle_type, find_points, modes_of, predict_fold, predict_torus
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use spring_block, only: index_of_ln_v
   use stability_map, only: middles, unstable_pairs
   use traced_planes, only: trace, traced_plane
   implicit none (type, external)
   private
   public :: collect_hopf_points

contains

   !> All tests of this suite.
   subroutine collect_hopf_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("second frequency", test_partner), &
                   new_unittest("special points of Figures 2 and 3", test_figures), &
                   new_unittest("map of unstable pairs", test_map), &
                   new_unittest("directions against roots", test_directions), &
                   new_unittest("folds leave along the curve", test_fold_direction), &
                   new_unittest("folds against harmonic balance", test_fold), &
                   new_unittest("cycles at their torus", test_cycle_at_torus)]
   end subroutine collect_hopf_points

   !> Both frequencies have the same epsilon, each is the other's partner.
   subroutine test_partner(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: partner, x(3)
      integer :: i

      do i = 1, 100
         x = 10.0_wp**uniform(i, 3, -1.0_wp, 1.0_wp)
         associate (omega => x(1), xi => x(2), gamma => x(3))
            partner = partner_omega(omega, xi, gamma)
            call expect_close(error, (1.0_wp + hopf_epsilon(partner, xi, gamma)) &
                              /(1.0_wp + hopf_epsilon(omega, xi, gamma)), 1.0_wp, 1.0e-12_wp, &
                              "1 + epsilon over 1 + epsilon")
            call expect_close(error, partner_omega(partner, xi, gamma)/omega, 1.0_wp, 1.0e-9_wp, &
                              "partner of the partner")
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
      type(failure_type), allocatable :: failure
      type(traced_plane) :: traced
      integer :: j, k

      call trace(i, traced, error)
      if (allocated(error)) return
      call judge_points(traced%points, failure)
      call expect_success(error, failure)
      call find_hopf_points(traced%plane, traced%points, found, failure)
      call expect_success(error, failure)
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
      call expect(error, all([(sign_is_kept(traced, j), j=1, size(traced%points) - 1)]), &
                  "l1 changes its sign at generalised points only")

   contains

      !> Whether between two points l1 keeps its sign or a generalised point lies.
      logical function sign_is_kept(traced, j) result(kept)
         type(traced_plane), intent(in) :: traced
         integer, intent(in) :: j

         associate (p => traced%points(j), q => traced%points(j + 1))
            kept = p%piece /= q%piece .or. p%l1*q%l1 > 0.0_wp .or. &
                   any(found%kind == "generalised_hopf" .and. found%omega(1) > p%omega &
                       .and. found%omega(1) < q%omega .and. found%branch(1) == p%branch)
         end associate
      end function sign_is_kept
   end subroutine check_points

   !> Cells of a map, against the roots themselves.
   subroutine test_map(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(traced_plane) :: traced
      type(block_equation_type) :: equation
      complex(wp), allocatable :: roots(:)
      integer, parameter :: cells = 6
      integer :: i, j, k, pairs(cells, cells)

      do k = 1, 2
         call trace(k, traced, error)
         if (allocated(error)) return
         pairs = unstable_pairs(traced%plane, cells)
         associate (x => middles(traced%plane%epsilon_window, cells), &
                    y => middles(traced%plane%ordinate_window, cells))
            do j = 1, cells
               do i = 1, cells
                  equation = block_equation_type(traced%plane%parameters(x(i), y(j)))
                  call find_roots(equation%linear, 0.0_wp, roots, failure)
                  call expect_success(error, failure)
                  if (allocated(error)) return
                  call expect(error, size(roots) == 2*pairs(i, j), "unstable pairs at epsilon = " &
                              //text(x(i))//", ordinate "//text(y(j)))
               end do
            end do
         end associate
         call expect(error, minval(pairs) == 0 .and. maxval(pairs) >= 4, "none and many")
      end do
   end subroutine test_map

   !> A small way from a double Hopf point along the start of a curve of tori, the growth rates of
   !> both pairs have the ratio that the normal form gives, with p_jj and mu_j of different sign.
   subroutine test_directions(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      complex(wp), allocatable :: roots(:)
      type(block_equation_type) :: equation
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: growth(2)
      integer :: i, j, n, pair

      do n = 1, 2
         call find_points(n, "double_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
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
      type(block_parameters_type) :: there
      real(wp) :: way(2)
      integer :: i, n, side

      do n = 1, 2
         call find_points(n, "generalised_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
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

   !> Epsilon along cycles of growing amplitude has its extreme at the fold. With the share of the
   !> square of the predicted amplitude it is a parabola, the depth of which is the distance from
   !> the Hopf curve. The period there, by its change along the cycles.
   subroutine test_fold(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      type(cycle_type) :: fold
      complex(wp) :: mode(3, 2)
      real(wp), parameter :: amplitude = 0.02_wp, shares(-1:1) = [0.5_wp, 1.0_wp, 1.5_wp]
      real(wp) :: curvature, epsilon(-1:1), frequency(-1:1), period_error(-1:1), slope
      integer :: i, j, n

      do n = 1, 2
         call find_points(n, "generalised_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            associate (point => found(i))
               call predict_fold(plane, point%omega(1), point%branch(1), point%unfolding, &
                                 amplitude, fold, failure)
               call expect_success(error, failure)
               mode = modes_of(point, [1.0_wp, 0.0_wp])
               do j = -1, 1
                  call find_cycle(fold%parameters, point%omega(1), mode(:, 1), &
                                  2.0_wp*abs(mode(index_of_ln_v, 1))*amplitude*sqrt(shares(j)), &
                                  epsilon(j), frequency(j), error)
               end do
               if (allocated(error)) return
            end associate
            slope = epsilon(1) - epsilon(-1)
            curvature = 4.0_wp*(epsilon(1) - 2.0_wp*epsilon(0) + epsilon(-1))
            call expect_between(error, -slope/curvature, -0.01_wp, 0.01_wp, &
                                "share at the fold less 1")
            call expect_close(error, epsilon(0), fold%parameters%epsilon, &
                              0.01_wp*abs(0.5_wp*curvature), "epsilon of the fold")
            period_error = two_pi/frequency - fold%period
            call expect_between(error, period_error(0)/period_error(-1), -0.01_wp, 0.01_wp, &
                                "error of the period over its change")
         end do
      end do
   end subroutine test_fold

   !> The cycle of the predicted amplitude has the predicted epsilon and period, by their distances
   !> from the double Hopf point.
   subroutine test_cycle_at_torus(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      type(cycle_type) :: torus
      complex(wp) :: mode(3, 2)
      real(wp), parameter :: amplitude = 0.02_wp
      real(wp) :: epsilon, frequency
      integer :: i, j, n

      do n = 1, 2
         call find_points(n, "double_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            mode = modes_of(found(i), [1.0_wp, 1.0_wp])
            do j = 1, 2
               associate (point => found(i), omega => found(i)%omega(j))
                  torus = predict_torus(plane, point%parameters, point%unfolding, j, amplitude)
                  call find_cycle(torus%parameters, omega, mode(:, j), &
                                  2.0_wp*abs(mode(index_of_ln_v, j))*amplitude, epsilon, &
                                  frequency, error)
                  if (allocated(error)) return
                  call expect_between(error, (epsilon - torus%parameters%epsilon) &
                                      /(torus%parameters%epsilon - point%parameters%epsilon), &
                                      -2.0e-3_wp, 2.0e-3_wp, "error of epsilon over its change")
                  call expect_between(error, (two_pi/frequency - torus%period) &
                                      /(torus%period - two_pi/omega), -2.0e-3_wp, 2.0e-3_wp, &
                                      "error of the period over its change")
               end associate
            end do
         end do
      end do
   end subroutine test_cycle_at_torus
end module test_hopf_points
