!> Where a pair of characteristic roots lies at s = i omega: equations (6) to (10) of the paper,
!> corrected where docs/method.md, "What was corrected", says so. With
!>
!>     X sin(omega tau) = -[omega^2 (gamma^2/xi + 1) - gamma^2]
!>     X cos(omega tau) = -[omega^3 - omega gamma^2 (1 + xi)/xi],
!>     X = omega (1 + epsilon) gamma^2/xi.
!>
!> All quantities are nondimensional.
module hopf_condition
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: frequency_condition, hopf_epsilon, hopf_gamma, hopf_tau, hopf_xi, largest_omega, &
             partner_omega, printed_tau, two_pi

   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

contains

   !> X sin(omega tau), which does not depend on epsilon and tau.
   elemental real(wp) function sine_part(omega, xi, gamma) result(value)
      real(wp), intent(in) :: omega, xi, gamma

      value = -(omega**2*(gamma**2/xi + 1.0_wp) - gamma**2)
   end function sine_part

   !> X cos(omega tau), which does not depend on epsilon and tau.
   elemental real(wp) function cosine_part(omega, xi, gamma) result(value)
      real(wp), intent(in) :: omega, xi, gamma

      value = -(omega**3 - omega*gamma**2*(1.0_wp + xi)/xi)
   end function cosine_part

   !> Equations (7) and (8), with gamma^2 where (8) prints gamma^1: the epsilon of a pair i omega.
   elemental real(wp) function hopf_epsilon(omega, xi, gamma) result(epsilon)
      !> Frequency of the pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma

      epsilon = -1.0_wp + hypot(cosine_part(omega, xi, gamma), sine_part(omega, xi, gamma)) &
                /(omega*gamma**2/xi)
   end function hopf_epsilon

   !> Largest frequency of a pair i omega at this epsilon or a smaller one: by (7) and (8)
   !> 1 + epsilon >= sqrt(1 + omega^2).
   elemental real(wp) function largest_omega(epsilon) result(omega)
      !> Sensitivity of the velocity relaxation
      real(wp), intent(in) :: epsilon

      omega = sqrt(max((1.0_wp + epsilon)**2 - 1.0_wp, 0.0_wp))
   end function largest_omega

   !> Equation (9): the xi of a pair i omega at delay tau; it holds where hopf_tau gives tau back.
   elemental real(wp) function hopf_xi(omega, tau, gamma) result(xi)
      !> Frequency of the pair, > 0; delay; frequency of the block
      real(wp), intent(in) :: omega, tau, gamma

      xi = (omega*gamma**2*sin(omega*tau) + omega**2*gamma**2*cos(omega*tau)) &
           /((omega**3 - omega*gamma**2)*sin(omega*tau) + (gamma**2 - omega**2)*cos(omega*tau))
   end function hopf_xi

   !> What is left of (6) when xi and gamma are eliminated: 0 at the frequencies of pairs i omega at
   !> this epsilon and delay.
   elemental real(wp) function frequency_condition(omega, epsilon, tau) result(value)
      !> Frequency of the pair, sensitivity of the velocity relaxation; delay
      real(wp), intent(in) :: omega, epsilon, tau

      value = 1.0_wp + omega**2 &
              + (1.0_wp + epsilon)*(omega*sin(omega*tau) - cos(omega*tau))
   end function frequency_condition

   !> The gamma of a pair i omega by the sine part of (6), where frequency_condition is 0; -1 where
   !> there is none.
   elemental real(wp) function hopf_gamma(omega, epsilon, tau, xi) result(gamma)
      !> Frequency of the pair, > 0; sensitivity of the velocity relaxation; delay; spring constant
      real(wp), intent(in) :: omega, epsilon, tau, xi
      real(wp) :: square

      ! omega^2/gamma^2
      square = 1.0_wp - omega*(omega + (1.0_wp + epsilon)*sin(omega*tau))/xi
      gamma = -1.0_wp
      if (square > 0.0_wp) gamma = omega/sqrt(square)
   end function hopf_gamma

   !> Equation (10) with its full numerator and the arctangent of two arguments: the delay of a pair
   !> i omega on branch k. The angle is continuous in omega, so each branch is one smooth curve.
   elemental real(wp) function hopf_tau(omega, xi, gamma, k) result(tau)
      !> Frequency of the pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      !> Branch
      integer, intent(in) :: k

      tau = (atan2(sine_part(omega, xi, gamma), cosine_part(omega, xi, gamma)) + two_pi*k)/omega
   end function hopf_tau

   !> The other frequency at which (7) and (8) give the same epsilon, or omega again where epsilon
   !> is least. In omega^2 they are a cubic whose roots have the sum 2 gamma^2 - 1 - gamma^4/xi^2
   !> and the product -gamma^4; one root is negative.
   elemental real(wp) function partner_omega(omega, xi, gamma) result(partner)
      !> Frequency of a pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      real(wp) :: half_sum, product, root

      half_sum = 0.5_wp*(2.0_wp*gamma**2 - 1.0_wp - gamma**4/xi**2 - omega**2)
      product = gamma**4/omega**2
      root = sqrt(half_sum**2 + product)
      if (half_sum > 0.0_wp) then
         partner = sqrt(half_sum + root)
      else
         partner = sqrt(product/(root - half_sum))
      end if
   end function partner_omega

   !> Equation (10) as printed: numerator without + gamma^2, plain arctangent.
   elemental real(wp) function printed_tau(omega, xi, gamma, k) result(tau)
      !> Frequency of the pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      !> Branch
      integer, intent(in) :: k

      tau = (atan(-omega**2*(gamma**2/xi + 1.0_wp) &
                          /(-omega**3 + omega*gamma**2*(1.0_wp + xi)/xi)) + two_pi*k)/omega
   end function printed_tau
end module hopf_condition
