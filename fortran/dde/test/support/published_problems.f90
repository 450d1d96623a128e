! SPDX-License-Identifier: BSD-3-Clause
!> Delay equations with published solutions (Hairer, Norsett and Wanner 1993, sec. II.17; Guglielmi
!> and Hairer 2001; Mackey and Glass 1977).
module published_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: enzyme, infection, mackey_glass, published_enzyme, published_infection

   !> Solutions of `infection` at t = 40 and of `enzyme` at t = 160.
   real(wp), parameter :: published_infection(3) = [0.0912491205664_wp, 0.0202995003351_wp, &
                                                    5.9884513791_wp]
   real(wp), parameter :: published_enzyme(4) = [33.92579471114_wp, 22.70653713103_wp, &
                                                 18.83057673173_wp, 22.26599078770_wp]

   !> An infection: delays 1 and 10.
   type, extends(constant_past) :: infection
   contains
      procedure :: rhs => infection_rhs
      procedure :: series => infection_series
   end type infection

   interface infection
      module procedure :: new_infection
   end interface infection

   !> Enzyme kinetics with inhibition.
   type, extends(constant_past) :: enzyme
   contains
      procedure :: rhs => enzyme_rhs
   end type enzyme

   interface enzyme
      module procedure :: new_enzyme
   end interface enzyme

   !> y' = 0.2 y(t-17)/(1 + y(t-17)^10) - 0.1 y.
   type, extends(constant_past) :: mackey_glass
   contains
      procedure :: rhs => mackey_glass_rhs
      procedure :: series => mackey_glass_series
      procedure :: tangent_series => mackey_glass_tangent_series
   end type mackey_glass

   interface mackey_glass
      module procedure :: new_mackey_glass
   end interface mackey_glass

contains

   !> From the published start.
   pure type(infection) function new_infection() result(problem)
      real(wp), parameter :: start(3) = [5.0_wp, 0.1_wp, 1.0_wp]

      call fill(problem, 3, start, start, [1.0_wp, 10.0_wp], [2, 2])
      problem%analytic = .true.
   end function new_infection

   !> From the published start.
   pure type(enzyme) function new_enzyme() result(problem)
      real(wp), parameter :: start(4) = [60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp]

      call fill(problem, 4, start, start, [4.0_wp], [4])
   end function new_enzyme

   !> From 1.2 with a delay of 17, unless something else is given.
   pure type(mackey_glass) function new_mackey_glass(n, lag, component, past, first) result(problem)
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: lag(:), past(:), first(:)

      call fill(problem, 1, [1.2_wp], [1.2_wp], [17.0_wp], [1])
      call fill(problem, n, past, first, lag, component)
      problem%analytic = .true.
      problem%analytic_tangents = .true.
   end function new_mackey_glass

   !> z = (y2(t-1), y2(t-10)).
   pure subroutine infection_rhs(self, t, y, z, dydt)
      class(infection), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-y(1)*z(1) + z(2), y(1)*z(1) - y(2), y(2) - z(2)]
   end subroutine infection_rhs

   !> The product y1 z1 is a sum of products.
   pure subroutine infection_series(self, t, unit, degree, z, y)
      class(infection), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: infected
      integer :: k

      do k = 0, degree - 1
         infected = sum(y(0:k, 1)*z(k:0:-1, 1))
         y(k + 1, :) = unit/(k + 1)*[z(k, 2) - infected, infected - y(k, 2), y(k, 2) - z(k, 2)]
      end do
   end subroutine infection_series

   !> z = y4(t-4).
   pure subroutine enzyme_rhs(self, t, y, z, dydt)
      class(enzyme), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: flow

      flow = y(1)/(1.0_wp + 0.0005_wp*z(1)**3)
      dydt = [10.5_wp - flow, flow - y(2), y(2) - y(3), y(3) - 0.5_wp*y(4)]
   end subroutine enzyme_rhs

   !> z = y(t-17).
   pure subroutine mackey_glass_rhs(self, t, y, z, dydt)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 0.2_wp*z/(1.0_wp + z**10) - 0.1_wp*y
   end subroutine mackey_glass_rhs

   !> From the gain z/(1 + z^10).
   pure subroutine mackey_glass_series(self, t, unit, degree, z, y)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp), dimension(0:degree) :: gain, power
      integer :: k

      call power_and_gain(degree, z, power, gain)
      do k = 0, degree - 1
         y(k + 1, 1) = unit/(k + 1)*(0.2_wp*gain(k) - 0.1_wp*y(k, 1))
      end do
   end subroutine mackey_glass_series

   !> d power by z d power = 10 power dz, d gain by d gain (1 + power) + gain d power = dz.
   pure subroutine mackey_glass_tangent_series(self, t, unit, degree, z, y, vectors, dz, dy)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag)), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)
      real(wp), dimension(0:degree) :: d_gain, d_power, gain, power
      integer :: i, k

      call power_and_gain(degree, z, power, gain)
      do i = 1, vectors
         do k = 0, degree - 1
            d_power(k) = (10.0_wp*sum(power(0:k)*dz(k:0:-1, 1, i)) &
                          - sum(z(1:k, 1)*d_power(k - 1:0:-1)))/z(0, 1)
            d_gain(k) = (dz(k, 1, i) - sum(power(1:k)*d_gain(k - 1:0:-1)) &
                         - sum(gain(0:k)*d_power(k:0:-1)))/(1.0_wp + power(0))
            dy(k + 1, 1, i) = unit/(k + 1)*(0.2_wp*d_gain(k) - 0.1_wp*dy(k, 1, i))
         end do
      end do
   end subroutine mackey_glass_tangent_series

   !> power = z^10 by z power' = 10 power z', gain = z/(1 + power) by gain (1 + power) = z.
   pure subroutine power_and_gain(degree, z, power, gain)
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree)
      real(wp), intent(out) :: power(0:degree), gain(0:degree)
      real(wp) :: by_gain, by_z
      integer :: j, k

      power(0) = z(0)**10
      gain(0) = z(0)/(1.0_wp + power(0))
      do k = 1, degree
         ! an array of the terms would be allocated
         by_z = 0.0_wp
         do j = 1, k
            by_z = by_z + (11*j - k)*z(j)*power(k - j)
         end do
         power(k) = by_z/(k*z(0))
         by_gain = 0.0_wp
         do j = 1, k
            by_gain = by_gain + power(j)*gain(k - j)
         end do
         gain(k) = (z(k) - by_gain)/(1.0_wp + power(0))
      end do
   end subroutine power_and_gain
end module published_problems
