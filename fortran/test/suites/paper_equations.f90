! SPDX-License-Identifier: BSD-3-Clause
!> What is known of the block in closed form: the paper's equation (5), and the Hopf curves apart
!> from the formulas of the program: with B = xi (gamma^2 - omega^2)/(gamma^2 omega),
!>
!>     1 + epsilon = sqrt((1 + omega^2)(1 + B^2)),   omega tau = atan B - atan omega + 2 pi k.
module paper_equations
   use block_builder, only: by_epsilon, by_gamma, by_tau, by_xi
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: block_with_pair, closed_epsilon, closed_tau, closed_xi, delta, relative_residual

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   !> The five terms of Delta(s) in (5); the last one is delayed.
   pure function terms(p, s) result(term)
      !> Parameters, point of the complex plane
      real(wp), intent(in) :: p(:)
      complex(wp), intent(in) :: s
      complex(wp) :: term(5)

      associate (square => p(by_gamma)**2, xi => p(by_xi))
         term = [s**3, s**2*(1.0_wp + square/xi), s*square*(1.0_wp + 1.0_wp/xi), &
                 cmplx(square, kind=wp), &
                 -s*(1.0_wp + p(by_epsilon))*square/xi*exp(-s*p(by_tau))]
      end associate
   end function terms

   !> Delta(s).
   pure complex(wp) function delta(p, s) result(value)
      real(wp), intent(in) :: p(:)
      complex(wp), intent(in) :: s

      value = sum(terms(p, s))
   end function delta

   !> |Delta(i omega)| over its largest term: how well i omega is a characteristic root.
   pure real(wp) function relative_residual(p, omega) result(value)
      real(wp), intent(in) :: p(:), omega

      associate (s => cmplx(0.0_wp, omega, kind=wp))
         value = abs(delta(p, s))/maxval(abs(terms(p, s)))
      end associate
   end function relative_residual

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
end module paper_equations
