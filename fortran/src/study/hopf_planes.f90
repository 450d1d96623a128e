!> Planes of two parameters in which Hopf curves are drawn, each with its window: tau over epsilon
!> at fixed xi (Figure 2), or xi over epsilon at fixed tau (Figure 3).
module hopf_planes
   use block_family, only: along_epsilon, along_tau, along_xi, parameters_of, vector_of
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: by_epsilon, by_tau, by_xi, root_by
   use hopf_condition, only: hopf_epsilon, hopf_tau, hopf_xi, two_pi
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: curve_plane_type

   !> A plane (epsilon, ordinate) with a window.
   type :: curve_plane_type
      !> Which parameter is the ordinate: along_tau or along_xi
      integer :: along = along_tau
      !> The fixed parameters: gamma, and xi or tau
      type(block_parameters_type) :: fixed
      !> Window on epsilon: least, most
      real(wp) :: epsilon_window(2) = [0.0_wp, 1.0_wp]
      !> Window on the ordinate: least, most
      real(wp) :: ordinate_window(2) = [0.0_wp, 1.0_wp]
   contains
      procedure :: at, parameters, ordinate, root_slopes, bounds
   end type curve_plane_type

contains

   !> Parameters at which branch k has the pair i omega; xi <= 0 if there are none. Equations (7)
   !> and (10) at fixed xi; at fixed tau (7) and (9), as far as (10) gives that tau back on branch
   !> k.
   pure type(block_parameters_type) function at(self, omega, k) result(p)
      class(curve_plane_type), intent(in) :: self
      real(wp), intent(in) :: omega
      integer, intent(in) :: k

      p = self%fixed
      if (self%along == along_tau) then
         p%tau = hopf_tau(omega, p%xi, p%gamma, k)
      else
         p%xi = hopf_xi(omega, p%tau, p%gamma)
         if (.not. p%xi > 0.0_wp) return
         if (abs(omega*(hopf_tau(omega, p%xi, p%gamma, k) - p%tau)) > 1.0_wp) then
            p%xi = -1.0_wp
            return
         end if
      end if
      p%epsilon = hopf_epsilon(omega, p%xi, p%gamma)
   end function at

   !> Parameters at a place of the plane.
   pure type(block_parameters_type) function parameters(self, epsilon, ordinate) result(p)
      class(curve_plane_type), intent(in) :: self
      !> Abscissa and ordinate
      real(wp), intent(in) :: epsilon, ordinate
      real(wp) :: vector(4)

      vector = vector_of(self%fixed)
      vector([along_epsilon, self%along]) = [epsilon, ordinate]
      p = parameters_of(vector)
   end function parameters

   !> The ordinate among the parameters.
   pure real(wp) function ordinate(self, p) result(value)
      class(curve_plane_type), intent(in) :: self
      type(block_parameters_type), intent(in) :: p

      value = merge(p%tau, p%xi, self%along == along_tau)
   end function ordinate

   !> Derivatives of a root by epsilon and by the ordinate.
   pure function root_slopes(self, p, s) result(slopes)
      class(curve_plane_type), intent(in) :: self
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: s
      complex(wp) :: slopes(2)

      slopes = [root_by(by_epsilon, p, s), &
                root_by(merge(by_tau, by_xi, self%along == along_tau), p, s)]
   end function root_slopes

   !> Least omega: where xi (gamma^2 - omega^2)/(gamma^2 omega) falls to omega_most for the least
   !> xi. Below it epsilon lies beyond the window, for 1 + epsilon = sqrt((1 + omega^2)(1 + B^2))
   !> with B that ratio. Highest branch: where (2 pi k - pi)/omega_most exceeds the longest tau.
   pure subroutine bounds(self, omega_most, omega_least, k_most)
      class(curve_plane_type), intent(in) :: self
      !> Largest omega in the window
      real(wp), intent(in) :: omega_most
      !> Least omega
      real(wp), intent(out) :: omega_least
      !> Highest branch
      integer, intent(out) :: k_most
      real(wp) :: half, tau_most, xi_least

      tau_most = self%fixed%tau
      xi_least = self%fixed%xi
      if (self%along == along_tau) tau_most = self%ordinate_window(2)
      if (self%along == along_xi) xi_least = self%ordinate_window(1)
      associate (gamma => self%fixed%gamma)
         half = 0.5_wp*gamma**2*omega_most/xi_least
         omega_least = gamma**2/(half + sqrt(half**2 + gamma**2))
      end associate
      k_most = ceiling(tau_most*omega_most/two_pi + 0.5_wp)
   end subroutine bounds
end module hopf_planes
