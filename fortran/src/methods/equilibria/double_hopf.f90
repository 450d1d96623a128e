! SPDX-License-Identifier: BSD-3-Clause
!> The normal form of two pairs of imaginary roots without low resonance (double Hopf bifurcation),
!>
!>     z_j' = (mu_j + i omega_j) z_j + z_j sum_k g_jk |z_k|^2,   p_jk = Re g_jk,   j, k = 1, 2
!>
!> (Guckenheimer and Holmes 1983, section 7.5; Kuznetsov 2004, section 8.6, where g_11, g_12, g_21
!> and g_22 are G2100, G1011, G1110 and G0021). The cycle of pair j has |z_j|^2 = -mu_j/p_jj; the
!> other pair k grows along it at the rate mu_k - mu_j p_kj/p_jj, and where this is 0 a torus is
!> born. Tori exist where sum_k p_jk |z_k|^2 = -mu_j has positive solutions, between these lines.
module double_hopf
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: double_hopf_type, find_double_hopf, word_length

   !> Letters of a word.
   integer, parameter :: word_length = 20
   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

   !> The coefficients.
   type :: double_hopf_type
      !> Frequencies of the pairs
      real(wp) :: omega(2) = 0.0_wp
      !> g_jk with eigenvectors of length 1
      complex(wp) :: g(2, 2) = 0.0_wp
   contains
      procedure :: ratios, unfolding, torus_rates, torus_angle, criticality, torus_stability
   end type double_hopf_type

contains

   !> The coefficients at a double Hopf point.
   subroutine find_double_hopf(model, omega, form, error)
      !> The model, which keeps delays of 0 and has simple roots +-i omega at rest
      class(model_type), intent(in) :: model
      !> Frequencies of the pairs
      real(wp), intent(in) :: omega(2)
      !> The coefficients
      type(double_hopf_type), intent(out) :: form
      !> A combination of the frequencies is a root, too
      type(error_type), allocatable, intent(out) :: error
      integer :: j, k, m(4)

      form%omega = omega
      do k = 1, 2
         do j = 1, 2
            m = 0
            m(2*k - 1:2*k) = 1
            m(2*j - 1) = m(2*j - 1) + 1
            call normal_form_coefficient(model, omega, m, form%g(j, k), error)
            if (allocated(error)) return
         end do
      end do
   end subroutine find_double_hopf

   !> theta = p_12/p_22 and delta = p_21/p_11.
   pure function ratios(self) result(value)
      class(double_hopf_type), intent(in) :: self
      real(wp) :: value(2)

      associate (p => real(self%g, wp))
         value = [p(1, 2)/p(2, 2), p(2, 1)/p(1, 1)]
      end associate
   end function ratios

   !> Case Ia to VIII of Guckenheimer and Holmes, table 7.5.1: by the signs of d, b, c and d - b c
   !> in r1' = r1 (mu1 + r1^2 + b r2^2), r2' = r2 (mu2 + c r1^2 + d r2^2). Time is reversed if
   !> p_11 < 0, so that b = d theta and c = delta.
   pure function unfolding(self) result(word)
      class(double_hopf_type), intent(in) :: self
      character(len=4) :: word
      real(wp) :: b, c, d, ratio(2)

      ratio = self%ratios()
      d = sign(1.0_wp, real(self%g(1, 1))*real(self%g(2, 2)))
      b = d*ratio(1)
      c = ratio(2)
      if (b > 0.0_wp .and. c > 0.0_wp) then
         word = merge("I   ", "V   ", d > 0.0_wp)
      else if (b > 0.0_wp) then
         word = merge("II  ", "VI  ", d > 0.0_wp)
      else if (c > 0.0_wp) then
         word = merge("III ", "VII ", d > 0.0_wp)
      else
         word = merge("IV  ", "VIII", d > 0.0_wp)
      end if
      if (any(word == ["I   ", "IV  ", "VI  ", "VII "])) then
         word = trim(word)//merge("a", "b", d - b*c > 0.0_wp)
      end if
   end function unfolding

   !> (mu_1, mu_2) of length 1 at which a torus is born from the cycle of a pair.
   pure function torus_rates(self, pair) result(mu)
      class(double_hopf_type), intent(in) :: self
      integer, intent(in) :: pair
      real(wp) :: mu(2)

      mu = -real(self%g(:, pair))
      mu = mu/norm2(mu)
   end function torus_rates

   !> Angle of the multipliers with which the other pair turns in one period, 0..pi.
   pure real(wp) function torus_angle(self, pair) result(angle)
      class(double_hopf_type), intent(in) :: self
      integer, intent(in) :: pair

      angle = modulo(two_pi*self%omega(3 - pair)/self%omega(pair), two_pi)
      angle = min(angle, two_pi - angle)
   end function torus_angle

   !> 'supercritical' where the torus lies on the side on which the other pair grows along the
   !> cycle, 'subcritical' on the other side: sign of p_kk - p_kj p_jk/p_jj.
   pure function criticality(self, pair) result(word)
      class(double_hopf_type), intent(in) :: self
      integer, intent(in) :: pair
      character(len=word_length) :: word

      word = "subcritical"
      if (determinant(self)*real(self%g(pair, pair)) < 0.0_wp) word = "supercritical"
   end function criticality

   !> 'stable', 'saddle' or 'unstable': the torus near its start, on the centre manifold.
   pure function torus_stability(self, pair) result(word)
      class(double_hopf_type), intent(in) :: self
      integer, intent(in) :: pair
      character(len=word_length) :: word

      if (determinant(self) < 0.0_wp) then
         word = "saddle"
      else if (real(self%g(pair, pair)) < 0.0_wp) then
         word = "stable"
      else
         word = "unstable"
      end if
   end function torus_stability

   !> p_11 p_22 - p_12 p_21.
   pure real(wp) function determinant(form) result(value)
      type(double_hopf_type), intent(in) :: form

      associate (p => real(form%g, wp))
         value = p(1, 1)*p(2, 2) - p(1, 2)*p(2, 1)
      end associate
   end function determinant
end module double_hopf
