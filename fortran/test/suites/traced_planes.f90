! SPDX-License-Identifier: BSD-3-Clause
!> Planes of Hopf curves of the block as traced, and what is known of them in closed form.
module traced_planes
   use block_builder, only: block_at, by_epsilon, by_gamma, by_tau, by_xi
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_success
   use hopf_curves, only: curve_point_type, trace_curves
   use hopf_planes, only: curve_plane_type, middles
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use mctc_env_testing, only: error_type
   use paper_equations, only: closed_epsilon, closed_tau, closed_xi
   implicit none (type, external)
   private
   public :: find_points, known_numbers, known_place, new_plane, plane_number, planes, trace

   !> Number of planes.
   integer, parameter :: planes = 9
   !> Cells of the grid on which unstable roots are counted.
   integer, parameter :: cells = 30

contains

   !> Plane number i: Figures 2 and 3, loops that leave the window on their way, a short delay,
   !> pieces up to the largest omega there can be, branches up to the highest, a large gamma,
   !> a small one, near which all frequencies are, and no delay.
   type(curve_plane_type) function plane_number(i) result(plane)
      integer, intent(in) :: i
      integer, parameter :: along(planes) = [by_tau, by_xi, by_tau, by_xi, by_tau, by_tau, by_tau, &
                                             by_tau, by_xi]
      ! gamma, and xi or tau
      real(wp), parameter :: fixed(2, planes) = reshape( &
         [0.8_wp, 0.5_wp, 0.8_wp, 12.0_wp, 0.8_wp, 0.5_wp, 2.0_wp, 3.0_wp, 0.75_wp, 0.5_wp, &
          1.0_wp, 0.01_wp, 1.0e12_wp, 0.5_wp, 0.01_wp, 0.5_wp, 0.8_wp, 0.0_wp], [2, planes])
      ! of epsilon and of the ordinate
      real(wp), parameter :: windows(4, planes) = reshape( &
         [0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp, 0.0_wp, 1.5_wp, 1.0e-3_wp, 2.0_wp, &
          0.3_wp, 1.2_wp, 2.0_wp, 28.0_wp, -0.5_wp, 2.0_wp, 0.1_wp, 3.0_wp, &
          0.0_wp, 0.25_wp, 0.0_wp, 30.0_wp, 0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp, &
          0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp, 0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp, &
          0.0_wp, 1.5_wp, 0.01_wp, 5.0_wp], [4, planes])

      plane = new_plane(along(i), fixed(1, i), fixed(2, i), windows(:, i))
   end function plane_number

   !> A plane at a gamma and a fixed xi or tau, with windows on epsilon and the ordinate.
   type(curve_plane_type) function new_plane(along, gamma, fixed, windows) result(plane)
      integer, intent(in) :: along
      real(wp), intent(in) :: gamma, fixed, windows(4)

      ! both have the value of the fixed one
      plane%model = block_at([fixed, 0.0_wp, fixed, gamma])
      plane%along = [by_epsilon, along]
      plane%window = reshape(windows, [2, 2])
   end function new_plane

   !> Trace a plane.
   subroutine trace(plane, points, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), allocatable, intent(out) :: points(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: grid(cells + 2)

      grid = [0.0_wp, middles([0.0_wp, 1.0_wp], cells), 1.0_wp]
      call trace_curves(plane, grid, grid, plane%unstable_roots(grid, grid), points, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, size(points) > 10, "there are points, not "//text(size(points)))
   end subroutine trace

   !> Trace a plane and find its special points.
   subroutine find_points(plane, points, found, error)
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), allocatable, intent(out) :: points(:)
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      call trace(plane, points, error)
      if (allocated(error)) return
      call judge_points(plane, points)
      call find_hopf_points(plane, points, found, failure)
      call expect_success(error, failure)
   end subroutine find_points

   !> All parameters of branch k at omega in closed form; not in the window where there are none.
   pure function known_numbers(plane, omega, k) result(numbers)
      type(curve_plane_type), intent(in) :: plane
      real(wp), intent(in) :: omega
      integer, intent(in) :: k
      real(wp) :: numbers(4)

      numbers = plane%model%numbers
      associate (tau => numbers(by_tau), xi => numbers(by_xi), gamma => numbers(by_gamma))
         if (plane%along(2) == by_tau) then
            tau = closed_tau(omega, xi, gamma, k)
         else
            xi = closed_xi(omega, tau, gamma, k)
         end if
         numbers(by_epsilon) = -10.0_wp
         if (xi > 0.0_wp) numbers(by_epsilon) = closed_epsilon(omega, xi, gamma)
      end associate
   end function known_numbers

   !> Place of branch k at omega in units of the window.
   pure function known_place(plane, omega, k) result(place)
      type(curve_plane_type), intent(in) :: plane
      real(wp), intent(in) :: omega
      integer, intent(in) :: k
      real(wp) :: place(2)

      place = plane%place_of(known_numbers(plane, omega, k))
   end function known_place
end module traced_planes
