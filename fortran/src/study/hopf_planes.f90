!> Planes of two parameters in which Hopf curves are drawn, each with its window: over epsilon tau
!> (Figure 2), xi (Figure 3), or another parameter of the law. Curves of tau and xi are in closed
!> form over the frequency, others are found by root finding over the ordinate.
module hopf_planes
   use block_family, only: along_epsilon, along_tau, along_xi, vector_of, with_vector
   use block_parameters, only: block_parameters_type
   use dde_errors, only: error_type
   use characteristic_function, only: characteristic_type
   use hopf_condition, only: find_hopf_condition, hopf_condition_type, two_pi
   use dde_kinds, only: wp
   use spring_block, only: block_characteristic
   use stability_changes, only: angle_above, find_on_branch, omega_function_type
   implicit none (type, external)
   private
   public :: curve_plane_type

   !> Places of the ordinate at which the largest frequency is looked for.
   integer, parameter :: places = 20

   !> A plane (epsilon, ordinate) with a window.
   type :: curve_plane_type
      !> Number of the parameter that is the ordinate
      integer :: along = along_tau
      !> The law and the parameters that are fixed
      type(block_parameters_type) :: fixed
      !> Where the law has pairs i omega, if the ordinate is no parameter of its own
      type(hopf_condition_type) :: condition
      !> Window on epsilon: least, most
      real(wp) :: epsilon_window(2) = [0.0_wp, 1.0_wp]
      !> Window on the ordinate: least, most
      real(wp) :: ordinate_window(2) = [0.0_wp, 1.0_wp]
   contains
      procedure :: at, by_frequency, condition_at, parameters, ordinate, root_slopes, bounds
   end type curve_plane_type

contains

   !> Whether curves are drawn over the frequency, or over the ordinate.
   pure logical function by_frequency(self) result(value)
      class(curve_plane_type), intent(in) :: self

      value = self%along == along_tau .or. self%along == along_xi
   end function by_frequency

   !> Where the law has pairs i omega, with its own parameters at a place.
   subroutine condition_at(self, p, condition, error)
      class(curve_plane_type), intent(in) :: self
      !> The place
      type(block_parameters_type), intent(in) :: p
      type(hopf_condition_type), intent(out) :: condition
      !> The law is outside of the form of the condition
      type(error_type), allocatable, intent(out) :: error

      condition = self%condition
      if (.not. self%by_frequency()) call find_hopf_condition(p, condition, error)
   end subroutine condition_at

   !> The point of branch k at a frequency, or at an ordinate; xi <= 0 if there is none. Equations
   !> (7) and (10) at fixed xi; at fixed tau (9) and (7), as far as (10) gives that tau back on
   !> branch k.
   type(block_parameters_type) function at(self, x, k, frequency) result(p)
      class(curve_plane_type), intent(in) :: self
      !> Frequency or ordinate, as `by_frequency` says
      real(wp), intent(in) :: x
      integer, intent(in) :: k
      !> Frequency of the pair
      real(wp), intent(out), optional :: frequency
      type(error_type), allocatable :: error
      type(hopf_condition_type) :: condition
      real(wp) :: omega

      omega = x
      if (.not. self%by_frequency()) then
         p = self%parameters(self%epsilon_window(1), x)
         call self%condition_at(p, condition, error)
         if (.not. allocated(error)) then
            call find_on_branch(omega_function_type(angle_above, p, condition, k), &
                                condition%largest_omega(self%epsilon_window(2)), omega, error)
         end if
         if (present(frequency)) frequency = omega
         p%xi = merge(-1.0_wp, p%xi, allocated(error) .or. omega <= 0.0_wp)
         if (p%xi > 0.0_wp) p%epsilon = condition%epsilon_at(omega, p%xi, p%gamma)
         return
      end if
      if (present(frequency)) frequency = omega
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
      real(wp), allocatable :: vector(:)

      vector = vector_of(self%fixed)
      vector([along_epsilon, self%along]) = [epsilon, ordinate]
      p = with_vector(self%fixed, vector)
   end function parameters

   !> The ordinate among the parameters.
   pure real(wp) function ordinate(self, p) result(value)
      class(curve_plane_type), intent(in) :: self
      type(block_parameters_type), intent(in) :: p

      real(wp), allocatable :: vector(:)

      vector = vector_of(p)
      value = vector(self%along)
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

   !> Least and largest omega, or ordinate, and highest branch in the window. On branch k,
   !> 2 pi k - pi <= omega tau.
   subroutine bounds(self, least, most, k_most)
      class(curve_plane_type), intent(in) :: self
      !> Least and largest omega, or the window on the ordinate
      real(wp), intent(out) :: least, most
      !> Highest branch
      integer, intent(out) :: k_most
      type(error_type), allocatable :: error
      type(hopf_condition_type) :: condition
      real(wp) :: omega_least, omega_most, tau_most, xi_least
      integer :: i

      if (.not. self%by_frequency()) then
         least = self%ordinate_window(1)
         most = self%ordinate_window(2)
         omega_most = 0.0_wp
         do i = 0, places
            call self%condition_at(self%parameters(0.0_wp, least + (most - least)*i/places), &
                                   condition, error)
            if (allocated(error)) cycle
            omega_most = max(omega_most, condition%largest_omega(self%epsilon_window(2)))
         end do
         k_most = ceiling(self%fixed%tau*omega_most/two_pi + 0.5_wp)
         return
      end if
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
         least = omega_least
         most = omega_most
      end associate
      k_most = ceiling(tau_most*omega_most/two_pi + 0.5_wp)
   end subroutine bounds
end module hopf_planes
