!> Equation (10) as the paper prints it, for its residual beside that of the corrected one.
module printed_delay
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: printed_tau

   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

contains

   !> Equation (10) as printed: numerator without + gamma^2, plain arctangent.
   elemental real(wp) function printed_tau(omega, xi, gamma, k) result(tau)
      !> Frequency of the pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      !> Branch
      integer, intent(in) :: k

      tau = (atan(-omega**2*(gamma**2/xi + 1.0_wp) &
                          /(-omega**3 + omega*gamma**2*(1.0_wp + xi)/xi)) + two_pi*k)/omega
   end function printed_tau
end module printed_delay
