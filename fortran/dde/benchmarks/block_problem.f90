!> One spring block with delayed friction, on which solvers are compared: a chain of one block that
!> gives its derivatives. Its right-hand side is written out, as those of the other solvers are.
module block_problem
   use chain_of_blocks, only: chain
   use dde_kinds, only: wp
   use test_problems, only: fill
   implicit none (type, external)
   private
   public :: spring_block

   !> The block; without delay if tau is 0.
   type, extends(chain) :: spring_block
   contains
      procedure :: rhs, jacobian
   end type spring_block

   interface spring_block
      module procedure :: new_block
   end interface spring_block

contains

   !> The block with its parameters, from a constant past.
   type(spring_block) function new_block(tau, epsilon, xi, gamma, past) result(problem)
      real(wp), intent(in) :: tau, epsilon, xi, gamma, past(3)

      call fill(problem, 3, past, past, pack([tau], tau > 0.0_wp), pack([3], tau > 0.0_wp))
      problem%epsilon = epsilon
      problem%xi = xi
      problem%gamma = gamma
   end function new_block

   !> The equations of theta, u and w.
   pure subroutine rhs(self, t, y, z, dydt)
      class(spring_block), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: delayed_w, v

      delayed_w = y(3)
      if (size(z) > 0) delayed_w = z(1)
      v = exp(y(3))
      dydt(1) = -v*(y(1) + (1.0_wp + self%epsilon)*delayed_w)
      dydt(2) = v - 1.0_wp
      dydt(3) = -self%gamma**2/v*(y(2) + (y(1) + y(3))/self%xi)
   end subroutine rhs

   !> Derivatives by theta, u, w and by w(t - tau).
   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(spring_block), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)
      real(wp) :: dydt(3), stiffness, v

      call self%rhs(t, y, z, dydt)
      v = exp(y(3))
      stiffness = self%gamma**2/v
      by_y(1, :) = [-v, 0.0_wp, dydt(1)]
      by_y(2, :) = [0.0_wp, 0.0_wp, v]
      by_y(3, :) = [-stiffness/self%xi, -stiffness, -stiffness/self%xi - dydt(3)]
      by_z = 0.0_wp
      if (size(z) > 0) by_z(1, 1) = -v*(1.0_wp + self%epsilon)
      if (size(z) == 0) by_y(1, 3) = by_y(1, 3) - v*(1.0_wp + self%epsilon)
   end subroutine jacobian
end module block_problem
