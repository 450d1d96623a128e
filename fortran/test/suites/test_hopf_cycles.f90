!> Cycles beside special points of the Hopf curves of Figures 2 and 3, as the normal forms predict
!> them, against cycles by harmonic balance.
module test_hopf_cycles
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use harmonic_balance, only: find_cycle
   use hopf_condition, only: two_pi
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: hopf_point_type
   use hopf_unfoldings, only: way_to_growth
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use normal_form, only: critical_vectors
   use spring_block, only: index_of_ln_v
   use traced_planes, only: find_points, plane_number
   implicit none (type, external)
   private
   public :: collect_hopf_cycles

   !> Amplitude |z| of the cycles.
   real(wp), parameter :: amplitude = 0.02_wp

   !> A cycle near a special point.
   type :: cycle_type
      type(block_parameters_type) :: parameters
      real(wp) :: period = 0.0_wp
   end type cycle_type

contains

   !> All tests of this suite.
   subroutine collect_hopf_cycles(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("folds near generalised Hopf points", test_fold), &
                   new_unittest("torus bifurcations near double Hopf points", test_torus)]
   end subroutine collect_hopf_cycles

   !> Epsilon along cycles of growing amplitude has its extreme at the fold. With the share of the
   !> square of the predicted amplitude it is a parabola, the depth of which is the distance from
   !> the Hopf curve. The period there, by its change along the cycles.
   subroutine test_fold(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      type(cycle_type) :: fold
      real(wp), parameter :: shares(-1:1) = [0.5_wp, 1.0_wp, 1.5_wp]
      real(wp) :: curvature, epsilon(-1:1), frequency(-1:1), period_error(-1:1), slope
      integer :: i, j, n

      do n = 1, 2
         call points_of(n, "generalised_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            call predict_fold(plane, found(i), fold, failure)
            call expect_success(error, failure)
            do j = -1, 1
               call follow(found(i), 1, fold%parameters, amplitude*sqrt(shares(j)), epsilon(j), &
                           frequency(j), error)
               if (allocated(error)) return
            end do
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
   subroutine test_torus(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      type(cycle_type) :: torus
      real(wp) :: epsilon, frequency
      integer :: i, j, n

      do n = 1, 2
         call points_of(n, "double_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            do j = 1, 2
               torus = predict_torus(plane, found(i), j)
               call follow(found(i), j, torus%parameters, amplitude, epsilon, frequency, error)
               if (allocated(error)) return
               associate (point => found(i), omega => found(i)%omega(j))
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
   end subroutine test_torus

   !> Special points of a kind in the plane of Figure 2 or 3.
   subroutine points_of(n, kind, plane, found, error)
      integer, intent(in) :: n
      character(len=*), intent(in) :: kind
      type(curve_plane_type), intent(out) :: plane
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      type(curve_point_type), allocatable :: points(:)

      plane = plane_number(n)
      call find_points(plane, points, found, error)
      if (allocated(error)) return
      found = pack(found, found%kind == kind)
      call expect(error, size(found) > 0, "there are points of the kind "//kind)
   end subroutine points_of

   !> The cycle of a pair whose oscillation has the amplitude |z|, by harmonic balance.
   subroutine follow(point, pair, parameters, size_of_z, epsilon, frequency, error)
      type(hopf_point_type), intent(in) :: point
      integer, intent(in) :: pair
      type(block_parameters_type), intent(in) :: parameters
      real(wp), intent(in) :: size_of_z
      real(wp), intent(out) :: epsilon, frequency
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(block_equation_type) :: equation
      complex(wp) :: p(3), q(3)

      equation = block_equation_type(point%parameters)
      call critical_vectors(equation%linear, cmplx(0.0_wp, point%omega(pair), kind=wp), q, p, &
                            failure)
      call expect_success(error, failure)
      call find_cycle(parameters, point%omega(pair), q, 2.0_wp*abs(q(index_of_ln_v))*size_of_z, &
                      epsilon, frequency, error)
   end subroutine follow

   !> A fold of cycles near a generalised Hopf point.
   subroutine predict_fold(plane, point, fold, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      type(cycle_type), intent(out) :: fold
      type(failure_type), allocatable, intent(out) :: error
      complex(wp) :: c1, slopes(2)
      real(wp) :: epsilon_step, omega

      associate (c2 => point%unfolding%c2, r => amplitude**2)
         omega = point%omega(1) - 2.0_wp*real(c2)*r/point%unfolding%c1_slope
         fold%parameters = plane%at(omega, point%branch(1))
         call normal_form_coefficient(block_equation_type(fold%parameters), [omega], [2, 1], c1, &
                                      error)
         if (allocated(error)) return
         slopes = plane%root_slopes(fold%parameters, cmplx(0.0_wp, omega, kind=wp))
         epsilon_step = real(c2)*r**2/real(slopes(1))
         fold%parameters%epsilon = fold%parameters%epsilon + epsilon_step
         fold%period = two_pi/(omega + aimag(slopes(1))*epsilon_step + aimag(c1)*r)
      end associate
   end subroutine predict_fold

   !> A torus bifurcation of the cycle of a pair near a double Hopf point.
   type(cycle_type) function predict_torus(plane, point, pair) result(torus)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: point
      integer, intent(in) :: pair
      complex(wp) :: slopes(2)
      real(wp) :: way(2)

      associate (p => point%parameters, form => point%unfolding%form)
         way = way_to_growth(plane, p, form%omega, -amplitude**2*real(form%g(:, pair)))
         slopes = plane%root_slopes(p, cmplx(0.0_wp, form%omega(pair), kind=wp))
         torus%parameters = plane%parameters(p%epsilon + way(1), plane%ordinate(p) + way(2))
         torus%period = two_pi/(form%omega(pair) + sum(aimag(slopes)*way) &
                                + amplitude**2*aimag(form%g(pair, pair)))
      end associate
   end function predict_torus
end module test_hopf_cycles
