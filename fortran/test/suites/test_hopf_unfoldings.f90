!> What the normal forms predict beside special points of the Hopf curves, against roots of (5) and
!> against cycles by harmonic balance.
module test_hopf_unfoldings
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use characteristic_roots, only: find_roots
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use harmonic_balance, only: find_cycle
   use hopf_condition, only: two_pi
   use hopf_planes, only: curve_plane_type
   use hopf_point_runs, only: cycle_type, find_points, modes_of, predict_fold, predict_torus
   use hopf_points, only: hopf_point_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use spring_block, only: index_of_ln_v
   implicit none (type, external)
   private
   public :: collect_hopf_unfoldings

contains

   !> All tests of this suite.
   subroutine collect_hopf_unfoldings(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("directions against roots", test_directions), &
                   new_unittest("folds leave along the curve", test_fold_direction), &
                   new_unittest("folds against harmonic balance", test_fold), &
                   new_unittest("cycles at their torus", test_cycle_at_torus)]
   end subroutine collect_hopf_unfoldings

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
end module test_hopf_unfoldings
