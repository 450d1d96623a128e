! SPDX-License-Identifier: BSD-3-Clause
!> The Hopf curves in closed form, apart from the pipeline's own formulas: with
!> B = xi (gamma^2 - omega^2)/(gamma^2 omega),
!>
!>     1 + epsilon = sqrt((1 + omega^2)(1 + B^2)),   omega tau = atan B - atan omega + 2 pi k.
module closed_form
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: block_with_pair, closed_epsilon, closed_tau, closed_xi

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   !> Parameters of a block with the pair i omega on branch k.
   pure function block_with_pair(omega, xi, gamma, k) result(numbers)
      !> Frequency of the pair > 0, spring constant, frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      integer, intent(in) :: k
      real(wp) :: numbers(4)

      numbers = [closed_tau(omega, xi, gamma, k), closed_epsilon(omega, xi, gamma), xi, gamma]
   end function block_with_pair

   !> epsilon of the pair i omega.
   elemental real(wp) function closed_epsilon(omega, xi, gamma) result(epsilon)
      real(wp), intent(in) :: omega, xi, gamma

      epsilon = sqrt((1.0_wp + omega**2)*(1.0_wp + ratio(omega, xi, gamma)**2)) - 1.0_wp
   end function closed_epsilon

   !> Delay of the pair on branch k; no delay where it is negative.
   elemental real(wp) function closed_tau(omega, xi, gamma, k) result(tau)
      real(wp), intent(in) :: omega, xi, gamma
      integer, intent(in) :: k

      tau = (atan(ratio(omega, xi, gamma)) - atan(omega) + turn*k)/omega
   end function closed_tau

   !> Spring constant of the pair on branch k at a given delay; -1 where there is none.
   elemental real(wp) function closed_xi(omega, tau, gamma, k) result(xi)
      real(wp), intent(in) :: omega, tau, gamma
      integer, intent(in) :: k
      real(wp) :: angle

      xi = -1.0_wp
      angle = omega*tau + atan(omega) - turn*k
      if (abs(angle) < 0.25_wp*turn) xi = tan(angle)*gamma**2*omega/(gamma**2 - omega**2)
      if (.not. xi > 0.0_wp) xi = -1.0_wp
   end function closed_xi

   !> B.
   elemental real(wp) function ratio(omega, xi, gamma) result(b)
      real(wp), intent(in) :: omega, xi, gamma

      b = xi*(gamma**2 - omega**2)/(gamma**2*omega)
   end function ratio
end module closed_form
