! SPDX-License-Identifier: BSD-3-Clause
!> What begins at special points of Hopf curves: the curve of folds of cycles at a generalised Hopf
!> point, two curves of torus bifurcations at a double Hopf point. To leading order, with the growth
!> rate mu of a pair and r = |z|^2, for the motion 2 Re(z q exp(i omega t)) with |q| = 1.
module hopf_unfoldings
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use double_hopf, only: double_hopf_type, find_double_hopf
   use hopf_planes, only: axis_point_type, curve_plane_type
   implicit none (type, external)
   private
   public :: unfold_double_hopf, unfold_generalised_hopf, unfolding_type, way_to_growth

   !> Step of the slope of c1 along the curve, in units of the window; its error is of fourth order.
   real(wp), parameter :: slope_step = 1.0e-3_wp

   !> The normal form at a special point.
   type :: unfolding_type
      !> Coefficients of z |z|^2 and z |z|^4 at a generalised Hopf point
      complex(wp) :: c1 = 0.0_wp, c2 = 0.0_wp
      !> Coefficients at a double Hopf point
      type(double_hopf_type) :: form
      !> Where the curves start: unit vectors (abscissa, ordinate), of the folds, or of the tori of
      !> the cycles of pair 1 and of pair 2
      real(wp) :: start(2, 2) = 0.0_wp
   end type unfolding_type

contains

   !> The second Lyapunov coefficient l2 = Re(c2)/omega. From mu + Re(c1) r + Re(c2) r^2 = 0 and its
   !> derivative, folds have Re(c1) = -2 Re(c2) r and mu = Re(c2) r^2: their curve touches the Hopf
   !> curve and leaves towards the part where l1 and l2 differ in sign.
   subroutine unfold_generalised_hopf(plane, at, direction, unfolding, error)
      type(curve_plane_type), intent(in) :: plane
      type(axis_point_type), intent(in) :: at
      !> About the direction of the curve in (place, ln omega), of any sign
      real(wp), intent(in) :: direction(3)
      !> The normal form
      type(unfolding_type), intent(out) :: unfolding
      !> No coefficient
      type(error_type), allocatable, intent(out) :: error
      complex(wp) :: c1(-2:2)
      type(axis_point_type) :: beside
      real(wp) :: along(3), slope, tangent(2)
      integer :: i
      logical :: found

      beside = at
      call plane%correct(beside, direction, at%along(direction), found, along)
      do i = -2, 2
         if (.not. found) exit
         beside = at%moved(along, i*slope_step)
         call plane%correct(beside, along, at%along(along) + i*slope_step, found)
         if (.not. found) exit
         call normal_form_coefficient(plane%model_at(plane%numbers_at(beside%place)), &
                                      [beside%omega], [2, 1], c1(i), error)
         if (allocated(error)) return
      end do
      if (.not. found) then
         call raise(error, "generalised Hopf point: the curve is not found beside it")
         return
      end if
      call normal_form_coefficient(plane%model_at(plane%numbers_at(at%place)), [at%omega], [3, 2], &
                                   unfolding%c2, error)
      if (allocated(error)) return
      unfolding%c1 = c1(0)
      slope = 8.0_wp*real(c1(1) - c1(-1)) - real(c1(2) - c1(-2))
      tangent = along(:2)*(plane%window(2, :) - plane%window(1, :))
      unfolding%start(:, 1) = -sign(1.0_wp, real(unfolding%c2)*slope)*tangent/norm2(tangent)
   end subroutine unfold_generalised_hopf

   !> The coefficients, and the directions by mu_j = sum over parameters of Re(d root_j).
   subroutine unfold_double_hopf(plane, numbers, omega, unfolding, error)
      type(curve_plane_type), intent(in) :: plane
      !> All parameters of the point, frequencies of the pairs
      real(wp), intent(in) :: numbers(:), omega(2)
      !> The normal form
      type(unfolding_type), intent(out) :: unfolding
      !> No coefficient
      type(error_type), allocatable, intent(out) :: error
      integer :: pair

      call find_double_hopf(plane%model_at(numbers), omega, unfolding%form, error)
      if (allocated(error)) return
      do pair = 1, 2
         associate (way => way_to_growth(plane, numbers, omega, unfolding%form%torus_rates(pair)))
            unfolding%start(:, pair) = way/norm2(way)
         end associate
      end do
   end subroutine unfold_double_hopf

   !> The step (abscissa, ordinate) from a double Hopf point to given growth rates.
   function way_to_growth(plane, numbers, omega, mu) result(way)
      type(curve_plane_type), intent(in) :: plane
      !> All parameters of the point, frequencies and growth rates of the pairs
      real(wp), intent(in) :: numbers(:), omega(2), mu(2)
      real(wp) :: way(2)
      real(wp) :: growth(2, 2)
      integer :: j

      do j = 1, 2
         growth(j, :) = real(plane%root_slopes(numbers, cmplx(0.0_wp, omega(j), kind=wp)))
      end do
      way = [growth(2, 2)*mu(1) - growth(1, 2)*mu(2), growth(1, 1)*mu(2) - growth(2, 1)*mu(1)] &
            /(growth(1, 1)*growth(2, 2) - growth(1, 2)*growth(2, 1))
   end function way_to_growth
end module hopf_unfoldings
