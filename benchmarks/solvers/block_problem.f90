! SPDX-License-Identifier: BSD-3-Clause
!> One spring block with delayed friction, on which solvers are compared: a chain of one block that
!> may give its derivatives. Right-hand side and series are written out for one block, as the other
!> solvers have them.
module block_problem
   use chain_of_blocks, only: chain
   use dde_kinds, only: wp
   use test_problems, only: fill
   implicit none (type, external)
   private
   public :: block_with_jacobian, spring_block

   !> The block; without delay if tau is 0.
   type, extends(chain) :: spring_block
   contains
      procedure :: rhs, series
   end type spring_block

   !> The block with its derivatives.
   type, extends(spring_block) :: block_with_jacobian
   contains
      procedure :: jacobian
   end type block_with_jacobian

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

   !> Their series: v' = v w' is linear in the state, and w' follows from it term by term.
   pure subroutine series(self, t, unit, degree, z, y)
      class(spring_block), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      ! coefficients of theta + (1 + epsilon) w(t - lag), of unit w', and of v, the last first
      real(wp) :: relaxing(0:degree), rate(0:degree), v_back(-degree:0), v_rate, by_theta, by_w
      integer :: j, k

      v_back(0) = exp(y(0, 3))
      do k = 0, degree - 1
         relaxing(k) = y(k, 3)
         if (size(z, 2) > 0) relaxing(k) = z(k, 1)
         relaxing(k) = y(k, 1) + (1.0_wp + self%epsilon)*relaxing(k)
         v_rate = -self%gamma**2*unit*(y(k, 2) + (y(k, 1) + y(k, 3))/self%xi)
         by_theta = 0.0_wp
         by_w = 0.0_wp
         do j = 0, k - 1
            by_theta = by_theta + v_back(j - k)*relaxing(j)
            by_w = by_w + v_back(j - k)*rate(j)
         end do
         rate(k) = (v_rate - by_w)/v_back(0)
         y(k + 1, 1) = -unit/(k + 1)*(by_theta + v_back(0)*relaxing(k))
         y(k + 1, 2) = unit/(k + 1)*(v_back(-k) - merge(1.0_wp, 0.0_wp, k == 0))
         y(k + 1, 3) = rate(k)/(k + 1)
         v_back(-k - 1) = v_rate/(k + 1)
      end do
   end subroutine series

   !> Derivatives by theta, u, w and by w(t - tau).
   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(block_with_jacobian), intent(in) :: self
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
