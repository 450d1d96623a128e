!> Special points of the Hopf curves of Figures 2 and 3, and runs of the block beside them.
module hopf_point_runs
   use block_equation, only: block_equation_type
   use block_parameters, only: block_history_type, block_parameters_type
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect_success
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use hopf_unfoldings, only: cycle_type, predict_torus
   use mctc_env_testing, only: error_type
   use normal_form, only: critical_vectors
   use solving, only: at_tolerance, solve
   use spring_block, only: index_of_ln_v, spring_block_type
   use traced_planes, only: trace, traced_plane
   implicit none (type, external)
   private
   public :: find_points, modes_of, parameters_at, run

   !> The block with a history of oscillations, sum over pairs of 2 Re(z q exp(i omega t)).
   type, extends(spring_block_type) :: oscillating_block
      !> Frequencies
      real(wp) :: omega(2) = 0.0_wp
      !> z q of the pairs
      complex(wp) :: mode(3, 2) = 0.0_wp
   contains
      procedure :: initial => oscillation_at_zero
      procedure :: history => oscillation
   end type oscillating_block

contains

   !> Special points of a kind in a plane of Figures 2 and 3.
   subroutine find_points(i, kind, plane, found, error)
      !> Number of the plane
      integer, intent(in) :: i
      !> Kind
      character(len=*), intent(in) :: kind
      !> The plane
      type(curve_plane_type), intent(out) :: plane
      !> The points
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

   !> The parameters at which both pairs have given growth rates, to first order, from the starts of
   !> both curves of tori.
   type(block_parameters_type) function parameters_at(plane, point, mu) result(there)
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> The double Hopf point
      type(hopf_point_type), intent(in) :: point
      !> Growth rates
      real(wp), intent(in) :: mu(2)
      type(cycle_type) :: at_torus
      real(wp) :: share(2), way(2, 2)
      integer :: j

      associate (p => real(point%unfolding%form%g), here => point%parameters)
         share = -[p(2, 2)*mu(1) - p(1, 2)*mu(2), p(1, 1)*mu(2) - p(2, 1)*mu(1)] &
                 /(p(1, 1)*p(2, 2) - p(1, 2)*p(2, 1))
         do j = 1, 2
            at_torus = predict_torus(plane, here, point%unfolding, j, 1.0_wp)
            way(:, j) = [at_torus%parameters%epsilon - here%epsilon, &
                         plane%ordinate(at_torus%parameters) - plane%ordinate(here)]
         end do
         there = plane%parameters(here%epsilon + sum(way(1, :)*share), &
                                  plane%ordinate(here) + sum(way(2, :)*share))
      end associate
   end function parameters_at

   !> z q of all pairs of a point.
   function modes_of(point, z) result(mode)
      !> The point
      type(hopf_point_type), intent(in) :: point
      !> z of the pairs
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

   !> Least, mean and greatest maximum of ln v in the last 400 units of a run.
   subroutine run(parameters, omega, mode, time, least, mean, most, error)
      !> Parameters
      type(block_parameters_type), intent(in) :: parameters
      !> Frequencies of the history
      real(wp), intent(in) :: omega(2)
      !> z q of its pairs
      complex(wp), intent(in) :: mode(3, 2)
      !> Length of the run
      real(wp), intent(in) :: time
      !> Least maximum
      real(wp), intent(out) :: least
      !> Their mean
      real(wp), intent(out) :: mean
      !> Greatest maximum
      real(wp), intent(out) :: most
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(oscillating_block) :: block
      real(wp), allocatable :: maxima(:), values(:, :)
      integer, parameter :: samples = 20000
      integer :: i

      block%spring_block_type = spring_block_type(parameters, block_history_type())
      block%omega = omega
      block%mode = mode
      call solve(block, [(time - 0.02_wp*(samples - i), i=1, samples)], &
                 at_tolerance(1.0e-8_wp), values, error)
      if (allocated(error)) return
      associate (w => values(index_of_ln_v, :))
         allocate (maxima, source=pack(w(2:samples - 1), w(2:samples - 1) > w(1:samples - 2) &
                                       .and. w(2:samples - 1) >= w(3:samples)))
      end associate
      mean = sum(maxima)/size(maxima)
      least = minval(maxima)
      most = maxval(maxima)
   end subroutine run

   !> The state at t = 0.
   pure subroutine oscillation_at_zero(self, y)
      class(oscillating_block), intent(in) :: self
      !> theta, u, ln v
      real(wp), intent(out) :: y(self%n)
      integer :: i

      y = [(self%history(0.0_wp, i), i=1, 3)]
   end subroutine oscillation_at_zero

   !> The sum of the oscillations.
   pure function oscillation(self, t, component) result(value)
      class(oscillating_block), intent(in) :: self
      !> Time <= 0
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = 2.0_wp*sum(real(self%mode(component, :)*exp(cmplx(0.0_wp, self%omega*t, kind=wp))))
   end function oscillation
end module hopf_point_runs
