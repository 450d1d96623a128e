!> Planes of Hopf curves as traced, and what is known of them in closed form.
module traced_planes
   use block_family, only: along_tau, along_xi
   use closed_form, only: closed_epsilon, closed_tau, closed_xi
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_success
   use hopf_condition, only: find_hopf_condition
   use hopf_curves, only: curve_point_type, trace_curves
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type
   implicit none (type, external)
   private
   public :: closed_delta, find_points, known_point, new_plane, place_of, plane_number, planes, &
             trace, traced_plane

   !> Number of planes.
   integer, parameter :: planes = 7

   !> A plane and what was traced in it.
   type :: traced_plane
      !> The plane
      type(curve_plane_type) :: plane
      !> Points of all pieces
      type(curve_point_type), allocatable :: points(:)
   end type traced_plane

contains

   !> Plane number i: Figures 2 and 3, loops that leave the window on their way, a short delay,
   !> pieces up to the largest omega there can be, branches up to the highest, and a large gamma.
   type(curve_plane_type) function plane_number(i) result(plane)
      integer, intent(in) :: i
      integer, parameter :: along(planes) = [along_tau, along_xi, along_tau, along_xi, along_tau, &
                                             along_tau, along_tau]
      ! gamma, and xi or tau
      real(wp), parameter :: fixed(2, planes) = reshape( &
         [0.8_wp, 0.5_wp, 0.8_wp, 12.0_wp, 0.8_wp, 0.5_wp, 2.0_wp, 3.0_wp, 0.75_wp, 0.5_wp, &
          1.0_wp, 0.01_wp, 1.0e12_wp, 0.5_wp], [2, planes])
      ! of epsilon and of the ordinate
      real(wp), parameter :: windows(4, planes) = reshape( &
         [0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp, 0.0_wp, 1.5_wp, 1.0e-3_wp, 2.0_wp, &
          0.3_wp, 1.2_wp, 2.0_wp, 28.0_wp, -0.5_wp, 2.0_wp, 0.1_wp, 3.0_wp, &
          0.0_wp, 0.25_wp, 0.0_wp, 30.0_wp, 0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp, &
          0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp], [4, planes])

      plane = new_plane(along(i), fixed(1, i), fixed(2, i), windows(:, i))
   end function plane_number

   !> Trace plane number i.
   subroutine trace(i, traced, error)
      integer, intent(in) :: i
      type(traced_plane), intent(out) :: traced
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      traced%plane = plane_number(i)
      call trace_curves(traced%plane, traced%points, failure)
      call expect_success(error, failure)
      call expect(error, size(traced%points) > 100, "there are points in plane "//text(i))
   end subroutine trace

   !> Trace a plane and find its special points.
   subroutine find_points(plane, points, found, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), allocatable, intent(out) :: points(:)
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      call trace_curves(plane, points, failure)
      call expect_success(error, failure)
      call judge_points(points, failure)
      call expect_success(error, failure)
      call find_hopf_points(plane, points, found, failure)
      call expect_success(error, failure)
   end subroutine find_points

   !> A plane at a gamma and a fixed xi or tau, with windows on epsilon and the ordinate.
   type(curve_plane_type) function new_plane(along, gamma, fixed, windows) result(plane)
      integer, intent(in) :: along
      real(wp), intent(in) :: gamma, fixed, windows(4)
      type(failure_type), allocatable :: failure

      plane%along = along
      plane%fixed%gamma = gamma
      if (along == along_tau) plane%fixed%xi = fixed
      if (along == along_xi) plane%fixed%tau = fixed
      plane%epsilon_window = windows(:2)
      plane%ordinate_window = windows(3:)
      call find_hopf_condition(plane%fixed, plane%condition, failure)
      if (allocated(failure)) error stop "new_plane: "//failure%message
   end function new_plane

   !> (epsilon, ordinate) of branch k at omega in closed form.
   pure function known_point(plane, omega, k) result(point)
      type(curve_plane_type), intent(in) :: plane
      real(wp), intent(in) :: omega
      integer, intent(in) :: k
      real(wp) :: point(2)

      point = -10.0_wp
      associate (p => plane%fixed)
         if (plane%along == along_tau) then
            point = [closed_epsilon(omega, p%xi, p%gamma), closed_tau(omega, p%xi, p%gamma, k)]
         else
            point(2) = closed_xi(omega, p%tau, p%gamma, k)
            if (point(2) > 0.0_wp) point(1) = closed_epsilon(omega, point(2), p%gamma)
         end if
      end associate
   end function known_point

   !> (epsilon, ordinate) in units of the window.
   pure function place_of(plane, point) result(place)
      type(curve_plane_type), intent(in) :: plane
      real(wp), intent(in) :: point(2)
      real(wp) :: place(2)

      associate (least => [plane%epsilon_window(1), plane%ordinate_window(1)], &
                 most => [plane%epsilon_window(2), plane%ordinate_window(2)])
         place = (point - least)/(most - least)
      end associate
   end function place_of

   !> Equation (5) as the product (s + 1)(s^2 + s gamma^2/xi + gamma^2) less its delayed term.
   pure complex(wp) function closed_delta(point, tau, s) result(value)
      type(curve_point_type), intent(in) :: point
      real(wp), intent(in) :: tau
      complex(wp), intent(in) :: s

      associate (p => point%parameters, rate => point%parameters%gamma**2/point%parameters%xi)
         value = (s + 1.0_wp)*(s**2 + s*rate + p%gamma**2) - s*(1.0_wp + p%epsilon)*rate*exp(-s*tau)
      end associate
   end function closed_delta
end module traced_planes
