!> Cycles beside special points of the Hopf curves of Figures 2 and 3, as the normal forms predict
!> them, against cycles by harmonic balance.
module test_hopf_cycles
   use block_builder, only: block_at, by_epsilon, index_of_ln_v
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use harmonic_balance, only: find_cycle
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type, turn
   use hopf_points, only: hopf_point_type
   use hopf_unfoldings, only: way_to_growth
   use linear_system, only: linear_part
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use normal_form, only: critical_vectors
   use traced_planes, only: find_points, known_numbers, plane_number
   implicit none (type, external)
   private
   public :: collect_hopf_cycles

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
   subroutine collect_hopf_cycles(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("folds and torus bifurcations near special points", test_figures)]
   end subroutine collect_hopf_cycles

   !> Both figures.
   subroutine test_figures(error)
      type(error_type), allocatable, intent(out) :: error
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: found(:)
      integer :: i, j, n

      do n = 1, 2
         plane = plane_number(n)
         call find_points(plane, points, found, error)
         if (allocated(error)) return
         call expect(error, any(found%kind == "generalised_hopf") &
                     .and. any(found%kind == "double_hopf"), "points of both kinds")
         do i = 1, size(found)
            if (allocated(error)) return
            if (found(i)%kind == "generalised_hopf") call check_fold(plane, found(i), error)
            if (found(i)%kind /= "double_hopf") cycle
            do j = 1, 2
               call check_torus(plane, found(i), j, error)
            end do
         end do
      end do
   end subroutine test_figures

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
end module test_hopf_cycles
