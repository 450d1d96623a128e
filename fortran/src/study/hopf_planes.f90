!> Planes of two parameters in which Hopf curves are drawn, each with its window: tau over epsilon
!> at fixed xi (Figure 2), or xi over epsilon at fixed tau (Figure 3).
module hopf_planes
   use block_family, only: along_epsilon, along_tau, along_xi, vector_of, with_vector
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: characteristic_type
   use hopf_condition, only: hopf_condition_type, two_pi
   use dde_kinds, only: wp
   use spring_block, only: block_characteristic
   implicit none (type, external)
   private
   public :: curve_plane_type

   !> A plane (epsilon, ordinate) with a window.
   type :: curve_plane_type
      !> Which parameter is the ordinate: along_tau or along_xi
      integer :: along = along_tau
      !> The fixed parameters: the law, gamma, and xi or tau
      type(block_parameters_type) :: fixed
      !> Where the law has pairs i omega
      type(hopf_condition_type) :: condition
      !> Window on epsilon: least, most
      real(wp) :: epsilon_window(2) = [0.0_wp, 1.0_wp]
      !> Window on the ordinate: least, most
      real(wp) :: ordinate_window(2) = [0.0_wp, 1.0_wp]
   contains
      procedure :: at, parameters, ordinate, root_slopes, bounds
   end type curve_plane_type

contains

   !> Parameters at which branch k has the pair i omega; xi <= 0 if there are none. Equations (7)
   !> and (10) at fixed xi; at fixed tau (9) and (7), as far as (10) gives that tau back on branch
   !> k.
   pure type(block_parameters_type) function at(self, omega, k) result(p)
      class(curve_plane_type), intent(in) :: self
      real(wp), intent(in) :: omega
      integer, intent(in) :: k

      p = self%fixed
      associate (c => self%condition)
         if (self%along == along_xi) p%xi = c%xi_at(omega, p%tau, p%gamma)
         if (.not. p%xi > 0.0_wp) return
         p%epsilon = c%epsilon_at(omega, p%xi, p%gamma)
         associate (tau => c%tau_at(omega, p%epsilon, p%xi, p%gamma, k))
            if (self%along == along_tau) then
               p%tau = tau
            else if (abs(omega*(tau - p%tau)) > 1.0_wp) then
               p%xi = -1.0_wp
            end if
         end associate
      end associate
   end function at

   !> Parameters at a place of the plane.
   pure type(block_parameters_type) function parameters(self, epsilon, ordinate) result(p)
      class(curve_plane_type), intent(in) :: self
      !> Abscissa and ordinate
      real(wp), intent(in) :: epsilon, ordinate
      real(wp) :: vector(4)

      vector = vector_of(self%fixed)
      vector([along_epsilon, self%along]) = [epsilon, ordinate]
      p = with_vector(self%fixed, vector)
   end function parameters

   !> The ordinate among the parameters.
   pure real(wp) function ordinate(self, p) result(value)
      class(curve_plane_type), intent(in) :: self
      type(block_parameters_type), intent(in) :: p

      value = merge(p%tau, p%xi, self%along == along_tau)
   end function ordinate

   !> Derivatives of a root by epsilon and by the ordinate.
   function root_slopes(self, p, s) result(slopes)
      class(curve_plane_type), intent(in) :: self
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: s
      complex(wp) :: slopes(2)
      type(characteristic_type) :: c

      c = block_characteristic(p)
      slopes = [c%root_by(along_epsilon, s), c%root_by(self%along, s)]
   end function root_slopes

   !> Least and largest omega and highest branch in the window. On branch k,
   !> 2 pi k - pi <= omega tau.
   pure subroutine bounds(self, omega_least, omega_most, k_most)
      class(curve_plane_type), intent(in) :: self
      !> Least and largest omega
      real(wp), intent(out) :: omega_least, omega_most
      !> Highest branch
      integer, intent(out) :: k_most
      real(wp) :: tau_most, xi_least

      tau_most = self%fixed%tau
      xi_least = self%fixed%xi
      if (self%along == along_tau) tau_most = self%ordinate_window(2)
      if (self%along == along_xi) xi_least = self%ordinate_window(1)
      associate (c => self%condition, epsilon_most => self%epsilon_window(2), &
                 gamma => self%fixed%gamma)
         omega_most = c%largest_omega(epsilon_most)
         omega_least = min(c%least_omega(epsilon_most, xi_least, gamma), omega_most)
         ! beyond gamma the inertia of the block holds the spring's place
         if (c%has_inertia) omega_most = min(omega_most, gamma**2/omega_least)
      end associate
      k_most = ceiling(tau_most*omega_most/two_pi + 0.5_wp)
   end subroutine bounds
end module hopf_planes
