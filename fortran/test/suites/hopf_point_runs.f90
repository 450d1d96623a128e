!> Special points of the Hopf curves of Figures 2 and 3, and cycles that their normal forms predict.
module hopf_point_runs
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect_success
   use hopf_condition, only: two_pi
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use hopf_unfoldings, only: unfolding_type, way_to_growth
   use mctc_env_testing, only: error_type
   use normal_form, only: critical_vectors
   use traced_planes, only: trace, traced_plane
   implicit none (type, external)
   private
   public :: cycle_type, find_points, modes_of, predict_fold, predict_torus

   !> A cycle near a special point.
   type :: cycle_type
      !> Parameters, nondimensional
      type(block_parameters_type) :: parameters
      !> Period
      real(wp) :: period = 0.0_wp
      real(wp) :: amplitude = 0.0_wp
   end type cycle_type

contains

   !> Special points of a kind in a plane of Figures 2 and 3.
   subroutine find_points(i, kind, plane, found, error)
      integer, intent(in) :: i
      character(len=*), intent(in) :: kind
      type(curve_plane_type), intent(out) :: plane
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(traced_plane) :: traced
      type(hopf_point_type), allocatable :: all_points(:)

      call trace(i, traced, error)
      if (allocated(error)) return
      call judge_points(traced%points, failure)
      call expect_success(error, failure)
      call find_hopf_points(traced%plane, traced%points, all_points, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      plane = traced%plane
      found = pack(all_points, all_points%kind == kind .or. kind == "")
   end subroutine find_points

   !> A fold of cycles near a generalised Hopf point.
   subroutine predict_fold(plane, omega, k, unfolding, amplitude, cycle_at_fold, error)
      type(curve_plane_type), intent(in) :: plane
      real(wp), intent(in) :: omega
      integer, intent(in) :: k
      type(unfolding_type), intent(in) :: unfolding
      real(wp), intent(in) :: amplitude
      type(cycle_type), intent(out) :: cycle_at_fold
      type(failure_type), allocatable, intent(out) :: error
      complex(wp) :: c1, slopes(2)
      real(wp) :: epsilon_step, r, there

      r = amplitude**2
      there = omega - 2.0_wp*real(unfolding%c2)*r/unfolding%c1_slope
      associate (p => cycle_at_fold%parameters)
         p = plane%at(there, k)
         call normal_form_coefficient(block_equation_type(p), [there], [2, 1], c1, error)
         if (allocated(error)) return
         slopes = plane%root_slopes(p, cmplx(0.0_wp, there, kind=wp))
         epsilon_step = real(unfolding%c2)*r**2/real(slopes(1))
         p%epsilon = p%epsilon + epsilon_step
      end associate
      cycle_at_fold%amplitude = amplitude
      cycle_at_fold%period = two_pi/(there + aimag(slopes(1))*epsilon_step + aimag(c1)*r)
   end subroutine predict_fold

   !> A torus bifurcation of the cycle of a pair near a double Hopf point.
   type(cycle_type) function predict_torus(plane, parameters, unfolding, pair, amplitude) &
      result(cycle_at_torus)
      type(curve_plane_type), intent(in) :: plane
      type(block_parameters_type), intent(in) :: parameters
      type(unfolding_type), intent(in) :: unfolding
      !> The pair, 1 or 2
      integer, intent(in) :: pair
      real(wp), intent(in) :: amplitude
      complex(wp) :: slopes(2)
      real(wp) :: way(2)

      associate (form => unfolding%form)
         way = way_to_growth(plane, parameters, form%omega, -amplitude**2*real(form%g(:, pair)))
         slopes = plane%root_slopes(parameters, cmplx(0.0_wp, form%omega(pair), kind=wp))
         cycle_at_torus%parameters = plane%parameters(parameters%epsilon + way(1), &
                                                      plane%ordinate(parameters) + way(2))
         cycle_at_torus%amplitude = amplitude
         cycle_at_torus%period = two_pi/(form%omega(pair) + sum(aimag(slopes)*way) &
                                         + amplitude**2*aimag(form%g(pair, pair)))
      end associate
   end function predict_torus

   !> z q of all pairs of a point.
   function modes_of(point, z) result(mode)
      type(hopf_point_type), intent(in) :: point
      real(wp), intent(in) :: z(2)
      complex(wp) :: mode(3, 2)
      type(failure_type), allocatable :: failure
      type(block_equation_type) :: equation
      complex(wp) :: p(3), q(3)
      integer :: j

      equation = block_equation_type(point%parameters)
      mode = 0.0_wp
      do j = 1, count(point%omega > 0.0_wp)
         call critical_vectors(equation%linear, cmplx(0.0_wp, point%omega(j), kind=wp), q, p, &
                               failure)
         mode(:, j) = z(j)*q
      end do
   end function modes_of
end module hopf_point_runs
