! SPDX-License-Identifier: BSD-3-Clause
!> The order of each family of methods, by the tolerance. It is chosen once a run. The figure
!> `work_precision` shows what each order costs.
module dde_orders
   use dde_interpolant, only: highest_degree
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: explicit_method, radau_method, series_pays, taylor_degree

   !> Least tolerance of the pair 5(4); below it the pair is 8(5,3).
   real(wp), parameter :: least_of_bs5 = 3.0e-6_wp
   !> Least tolerance at which the pair takes fewer instructions than a Taylor series where there is
   !> a delayed value for every two equations or more: their series cost most of a step.
   real(wp), parameter :: least_of_many = 1.0e-5_wp
   !> Least tolerances of Radau IIA of order 5 and 9; below them the order is 13.
   real(wp), parameter :: least_of_radau5 = 3.0e-5_wp, least_of_radau9 = 1.0e-11_wp
   !> Degree of a Taylor series = this - log10(tolerance), near the degree of least cost for an
   !> accuracy. Jorba and Zou 2005, "A software package for the numerical integration of ODEs by
   !> means of high-order Taylor methods", sec. 3.2, have 1 - ln(tolerance)/2. The degree here is
   !> higher since a step costs three times its series.
   real(wp), parameter :: degree_at_one = 7.0_wp
   !> Lowest degree.
   integer, parameter :: lowest_degree = 6

contains

   !> The explicit pair.
   pure function explicit_method(tolerance) result(name)
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance
      character(len=8) :: name

      name = merge("bs5     ", "dop853  ", tolerance >= least_of_bs5)
   end function explicit_method

   !> Whether a Taylor series takes fewer instructions than the explicit pair.
   pure logical function series_pays(tolerance, n, delays) result(value)
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance
      !> Numbers of equations and of delayed values
      integer, intent(in) :: n, delays

      value = 2*delays < n .or. tolerance < least_of_many
   end function series_pays

   !> The Radau method of `auto`.
   pure function radau_method(tolerance) result(name)
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance
      character(len=8) :: name

      name = "radau9"
      if (tolerance >= least_of_radau5) name = "radau5"
      if (tolerance < least_of_radau9) name = "radau13"
   end function radau_method

   !> The degree of a Taylor series.
   pure integer function taylor_degree(tolerance) result(degree)
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance

      degree = max(lowest_degree, min(highest_degree, nint(degree_at_one - log10(tolerance))))
   end function taylor_degree
end module dde_orders
