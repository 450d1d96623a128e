! SPDX-License-Identifier: BSD-3-Clause
!> The paper's own equations for its law, corrected where docs/method.md, "What was corrected", says
!> so: (5), and (7) to (10) on the Hopf set. The tests compare what was made from (4) with them.
module paper_equations
   use block_builder, only: by_epsilon, by_gamma, by_tau, by_xi
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: delta, hopf_epsilon, hopf_tau, hopf_xi, relative_residual

   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

contains

   !> The five terms of Delta(s).
   pure function terms(p, s) result(term)
      !> Parameters
      real(wp), intent(in) :: p(:)
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      complex(wp) :: term(5)

      associate (gamma => p(by_gamma), xi => p(by_xi))
         term = [s**3, s**2*(1.0_wp + gamma**2/xi), s*gamma**2*(1.0_wp + 1.0_wp/xi), &
                 cmplx(gamma**2, kind=wp), delayed_term(p, s)]
      end associate
   end function terms

   !> The delayed term -s (1 + epsilon) (gamma^2/xi) exp(-s tau).
   pure complex(wp) function delayed_term(p, s) result(value)
      real(wp), intent(in) :: p(:)
      complex(wp), intent(in) :: s

      value = -s*(1.0_wp + p(by_epsilon))*(p(by_gamma)**2/p(by_xi))*exp(-s*p(by_tau))
   end function delayed_term

   !> Delta(s).
   pure complex(wp) function delta(p, s) result(value)
      !> Parameters
      real(wp), intent(in) :: p(:)
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = sum(terms(p, s))
   end function delta

   !> |Delta(s)| over its largest term: how well s is a characteristic root.
   pure real(wp) function relative_residual(p, s) result(value)
      !> Parameters
      real(wp), intent(in) :: p(:)
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = abs(delta(p, s))/maxval(abs(terms(p, s)))
   end function relative_residual

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

   !> Equation (9): the xi of a pair i omega at delay tau; it holds where hopf_tau gives tau back.
   elemental real(wp) function hopf_xi(omega, tau, gamma) result(xi)
      !> Frequency of the pair, > 0; delay; frequency of the block
      real(wp), intent(in) :: omega, tau, gamma

      xi = (omega*gamma**2*sin(omega*tau) + omega**2*gamma**2*cos(omega*tau)) &
           /((omega**3 - omega*gamma**2)*sin(omega*tau) + (gamma**2 - omega**2)*cos(omega*tau))
   end function hopf_xi

   !> Equation (10) with its full numerator and the arctangent of two arguments: the delay of a pair
   !> i omega on branch k. The angle is continuous in omega, so each branch is one smooth curve.
   elemental real(wp) function hopf_tau(omega, xi, gamma, k) result(tau)
      !> Frequency of the pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      !> Branch
      integer, intent(in) :: k

      tau = (atan2(sine_part(omega, xi, gamma), cosine_part(omega, xi, gamma)) + two_pi*k)/omega
   end function hopf_tau
end module paper_equations
