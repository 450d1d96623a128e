!> Planes of two parameters in which Hopf curves are drawn, each with its window.
module hopf_planes
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: root_by_epsilon, root_by_tau, root_by_xi
   use hopf_condition, only: hopf_epsilon, hopf_tau, hopf_xi, two_pi
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: curve_plane_type, tau_plane_type, xi_plane_type

   !> A plane (epsilon, ordinate) with a window; gamma is fixed, nondimensional.
   type, abstract :: curve_plane_type
      !> Frequency of the block
      real(wp) :: gamma = 1.0_wp
      !> Window on epsilon: least, most
      real(wp) :: epsilon_window(2) = [0.0_wp, 1.0_wp]
      !> Window on the ordinate: least, most
      real(wp) :: ordinate_window(2) = [0.0_wp, 1.0_wp]
   contains
      !> Parameters at which branch k has the pair i omega
      procedure(branch_at), deferred :: at
      !> Parameters at a place of the plane
      procedure(parameters_at), deferred :: parameters
      !> The ordinate among the parameters
      procedure(ordinate_of), deferred, nopass :: ordinate
      !> Derivatives of a root by epsilon and by the ordinate
      procedure(slopes_of_root), deferred, nopass :: root_slopes
      !> Least omega, and highest branch, that the window can hold
      procedure(reach), deferred :: bounds
   end type curve_plane_type

   abstract interface
      !> Parameters at which branch k has the pair i omega; xi <= 0 where it has none.
      pure type(block_parameters_type) function branch_at(self, omega, k) result(value)
         import :: block_parameters_type, curve_plane_type, wp
         implicit none (type, external)
         !> The plane
         class(curve_plane_type), intent(in) :: self
         !> Frequency of the pair
         real(wp), intent(in) :: omega
         !> Branch
         integer, intent(in) :: k
      end function branch_at

      !> Parameters at a place of the plane.
      pure type(block_parameters_type) function parameters_at(self, epsilon, ordinate) result(value)
         import :: block_parameters_type, curve_plane_type, wp
         implicit none (type, external)
         !> The plane
         class(curve_plane_type), intent(in) :: self
         !> Abscissa
         real(wp), intent(in) :: epsilon
         !> Ordinate
         real(wp), intent(in) :: ordinate
      end function parameters_at

      !> The ordinate among the parameters.
      pure real(wp) function ordinate_of(p) result(value)
         import :: block_parameters_type, wp
         implicit none (type, external)
         !> Parameters
         type(block_parameters_type), intent(in) :: p
      end function ordinate_of

      !> Derivatives of a root by epsilon and by the ordinate.
      pure function slopes_of_root(p, s) result(slopes)
         import :: block_parameters_type, wp
         implicit none (type, external)
         !> Parameters
         type(block_parameters_type), intent(in) :: p
         !> The root
         complex(wp), intent(in) :: s
         complex(wp) :: slopes(2)
      end function slopes_of_root

      !> Least omega and highest branch in the window, given the largest omega.
      pure subroutine reach(self, omega_most, omega_least, k_most)
         import :: curve_plane_type, wp
         implicit none (type, external)
         !> The plane
         class(curve_plane_type), intent(in) :: self
         !> Largest omega in the window
         real(wp), intent(in) :: omega_most
         !> Least omega
         real(wp), intent(out) :: omega_least
         !> Highest branch
         integer, intent(out) :: k_most
      end subroutine reach
   end interface

   !> Figure 2: tau over epsilon at fixed xi.
   type, extends(curve_plane_type) :: tau_plane_type
      !> Spring constant
      real(wp) :: xi = 1.0_wp
   contains
      procedure :: at => tau_branch
      procedure :: parameters => tau_parameters
      procedure, nopass :: ordinate => tau_ordinate
      procedure, nopass :: root_slopes => tau_slopes
      procedure :: bounds => tau_bounds
   end type tau_plane_type

   !> Figure 3: xi over epsilon at fixed tau.
   type, extends(curve_plane_type) :: xi_plane_type
      !> Delay
      real(wp) :: tau = 0.0_wp
   contains
      procedure :: at => xi_branch
      procedure :: parameters => xi_parameters
      procedure, nopass :: ordinate => xi_ordinate
      procedure, nopass :: root_slopes => xi_slopes
      procedure :: bounds => xi_bounds
   end type xi_plane_type

contains

   !> Equations (7) and (10) at fixed xi.
   pure type(block_parameters_type) function tau_branch(self, omega, k) result(p)
      class(tau_plane_type), intent(in) :: self
      real(wp), intent(in) :: omega
      integer, intent(in) :: k

      p = block_parameters_type(tau=hopf_tau(omega, self%xi, self%gamma, k), xi=self%xi, &
                                epsilon=hopf_epsilon(omega, self%xi, self%gamma), gamma=self%gamma)
   end function tau_branch

   !> At fixed xi.
   pure type(block_parameters_type) function tau_parameters(self, epsilon, ordinate) result(p)
      class(tau_plane_type), intent(in) :: self
      real(wp), intent(in) :: epsilon, ordinate

      p = block_parameters_type(tau=ordinate, epsilon=epsilon, xi=self%xi, gamma=self%gamma)
   end function tau_parameters

   !> tau.
   pure real(wp) function tau_ordinate(p) result(value)
      type(block_parameters_type), intent(in) :: p

      value = p%tau
   end function tau_ordinate

   !> By epsilon and tau.
   pure function tau_slopes(p, s) result(slopes)
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: s
      complex(wp) :: slopes(2)

      slopes = [root_by_epsilon(p, s), root_by_tau(p, s)]
   end function tau_slopes

   !> Least omega: where xi |gamma^2 - omega^2|/(gamma^2 omega) falls to omega_most; highest branch:
   !> where (2 pi k - pi)/omega_most exceeds tau.
   pure subroutine tau_bounds(self, omega_most, omega_least, k_most)
      class(tau_plane_type), intent(in) :: self
      real(wp), intent(in) :: omega_most
      real(wp), intent(out) :: omega_least
      integer, intent(out) :: k_most

      omega_least = least_omega(self%xi, self%gamma, omega_most)
      k_most = ceiling(self%ordinate_window(2)*omega_most/two_pi + 0.5_wp)
   end subroutine tau_bounds

   !> Equations (7) and (9) at fixed tau, as far as (10) gives that tau back on branch k.
   pure type(block_parameters_type) function xi_branch(self, omega, k) result(p)
      class(xi_plane_type), intent(in) :: self
      real(wp), intent(in) :: omega
      integer, intent(in) :: k

      p = block_parameters_type(tau=self%tau, xi=hopf_xi(omega, self%tau, self%gamma), &
                                gamma=self%gamma)
      if (.not. p%xi > 0.0_wp) return
      if (abs(omega*(hopf_tau(omega, p%xi, p%gamma, k) - self%tau)) > 1.0_wp) then
         p%xi = -1.0_wp
      else
         p%epsilon = hopf_epsilon(omega, p%xi, p%gamma)
      end if
   end function xi_branch

   !> At fixed tau.
   pure type(block_parameters_type) function xi_parameters(self, epsilon, ordinate) result(p)
      class(xi_plane_type), intent(in) :: self
      real(wp), intent(in) :: epsilon, ordinate

      p = block_parameters_type(tau=self%tau, epsilon=epsilon, xi=ordinate, gamma=self%gamma)
   end function xi_parameters

   !> xi.
   pure real(wp) function xi_ordinate(p) result(value)
      type(block_parameters_type), intent(in) :: p

      value = p%xi
   end function xi_ordinate

   !> By epsilon and xi.
   pure function xi_slopes(p, s) result(slopes)
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: s
      complex(wp) :: slopes(2)

      slopes = [root_by_epsilon(p, s), root_by_xi(p, s)]
   end function xi_slopes

   !> Least omega: as in `tau_bounds` for the least xi; highest branch: from omega_most and tau.
   pure subroutine xi_bounds(self, omega_most, omega_least, k_most)
      class(xi_plane_type), intent(in) :: self
      real(wp), intent(in) :: omega_most
      real(wp), intent(out) :: omega_least
      integer, intent(out) :: k_most

      omega_least = least_omega(self%ordinate_window(1), self%gamma, omega_most)
      k_most = ceiling(self%tau*omega_most/two_pi + 0.5_wp)
   end subroutine xi_bounds

   !> The omega at which xi (gamma^2 - omega^2)/(gamma^2 omega) = omega_most: below it epsilon lies
   !> beyond the window, for 1 + epsilon = sqrt((1 + omega^2)(1 + B^2)) with B that ratio.
   pure real(wp) function least_omega(xi, gamma, omega_most) result(value)
      real(wp), intent(in) :: xi, gamma, omega_most
      real(wp) :: half

      half = 0.5_wp*gamma**2*omega_most/xi
      value = gamma**2/(half + sqrt(half**2 + gamma**2))
   end function least_omega
end module hopf_planes
