!> What begins at special points of Hopf curves: the curve of folds of cycles at a generalised Hopf
!> point, two curves of torus bifurcations at a double Hopf point. To leading order, with the growth
!> rate mu of a pair and r = |z|^2, for the motion 2 Re(z q exp(i omega t)) with |q| = 1.
module hopf_unfoldings
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use double_hopf, only: double_hopf_type, find_double_hopf
   use hopf_planes, only: curve_plane_type
   implicit none (type, external)
   private
   public :: unfold_double_hopf, unfold_generalised_hopf, unfolding_type, way_to_growth

   !> Step of the slope of c1 along the curve, in units of omega or of the window; its error is of
   !> fourth order.
   real(wp), parameter :: slope_step = 1.0e-3_wp

   !> The normal form at a special point.
   type :: unfolding_type
      !> Coefficients of z |z|^2 and z |z|^4 at a generalised Hopf point
      complex(wp) :: c1 = 0.0_wp, c2 = 0.0_wp
      !> d Re(c1)/d omega along the Hopf curve, or by the ordinate
      real(wp) :: c1_slope = 0.0_wp
      !> Coefficients at a double Hopf point
      type(double_hopf_type) :: form
      !> Where the curves start: unit vectors (epsilon, ordinate), of the folds, or of the tori of
      !> the cycles of pair 1 and of pair 2
      real(wp) :: start(2, 2) = 0.0_wp
   end type unfolding_type

contains

   !> The second Lyapunov coefficient l2 = Re(c2)/omega. From mu + Re(c1) r + Re(c2) r^2 = 0 and its
   !> derivative, folds have Re(c1) = -2 Re(c2) r and mu = Re(c2) r^2: their curve touches the Hopf
   !> curve and leaves towards the part where l1 and l2 differ in sign.
   subroutine unfold_generalised_hopf(plane, x, k, unfolding, error)
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> Frequency of the pair, or the ordinate, as the plane has it
      real(wp), intent(in) :: x
      !> Branch of the curve
      integer, intent(in) :: k
      !> The normal form
      type(unfolding_type), intent(out) :: unfolding
      !> No coefficient
      type(error_type), allocatable, intent(out) :: error
      complex(wp) :: c1(-2:2), slopes(2)
      type(block_parameters_type) :: p
      real(wp) :: omega, step, tangent(2)
      integer :: i

      step = slope_step*x
      if (.not. plane%by_frequency()) then
         step = slope_step*(plane%ordinate_window(2) - plane%ordinate_window(1))
      end if
      do i = -2, 2
         p = plane%at(x + i*step, k, omega)
         call normal_form_coefficient(block_equation_type(p), [omega], [2, 1], c1(i), error)
         if (allocated(error)) return
      end do
      p = plane%at(x, k, omega)
      call normal_form_coefficient(block_equation_type(p), [omega], [3, 2], unfolding%c2, error)
      if (allocated(error)) return
      unfolding%c1 = c1(0)
      unfolding%c1_slope = (8.0_wp*real(c1(1) - c1(-1)) - real(c1(2) - c1(-2))) &
                           /(12.0_wp*step)
      slopes = plane%root_slopes(p, cmplx(0.0_wp, omega, kind=wp))
      tangent = [real(slopes(2)), -real(slopes(1))]
      ! omega, or the ordinate, grows along the tangent
      tangent = sign(1.0_wp, merge(sum(aimag(slopes)*tangent), tangent(2), plane%by_frequency())) &
                *tangent/norm2(tangent)
      unfolding%start(:, 1) = -sign(1.0_wp, real(unfolding%c2)*unfolding%c1_slope)*tangent
   end subroutine unfold_generalised_hopf

   !> The coefficients, and the directions by mu_j = sum over parameters of Re(d root_j).
   subroutine unfold_double_hopf(plane, parameters, omega, unfolding, error)
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> Parameters of the point
      type(block_parameters_type), intent(in) :: parameters
      !> Frequencies of the pairs
      real(wp), intent(in) :: omega(2)
      !> The normal form
      type(unfolding_type), intent(out) :: unfolding
      !> No coefficient
      type(error_type), allocatable, intent(out) :: error
      integer :: pair

      call find_double_hopf(block_equation_type(parameters), omega, unfolding%form, error)
      if (allocated(error)) return
      do pair = 1, 2
         associate (way => way_to_growth(plane, parameters, omega, &
                                         unfolding%form%torus_rates(pair)))
            unfolding%start(:, pair) = way/norm2(way)
         end associate
      end do
   end subroutine unfold_double_hopf

   !> The step (epsilon, ordinate) from a double Hopf point to given growth rates.
   function way_to_growth(plane, parameters, omega, mu) result(way)
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> Parameters of the point
      type(block_parameters_type), intent(in) :: parameters
      !> Frequencies and growth rates of the pairs
      real(wp), intent(in) :: omega(2), mu(2)
      real(wp) :: way(2)
      real(wp) :: growth(2, 2)
      integer :: j

      do j = 1, 2
         growth(j, :) = real(plane%root_slopes(parameters, cmplx(0.0_wp, omega(j), kind=wp)))
      end do
      way = [growth(2, 2)*mu(1) - growth(1, 2)*mu(2), growth(1, 1)*mu(2) - growth(2, 1)*mu(1)] &
            /(growth(1, 1)*growth(2, 2) - growth(1, 2)*growth(2, 1))
   end function way_to_growth
end module hopf_unfoldings
