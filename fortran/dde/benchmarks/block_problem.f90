!> A spring block with delayed friction, on which solvers are compared, with w = ln v:
!>
!>     theta' = -v [theta + (1 + epsilon) w(t - tau)],   u' = v - 1,
!>     v w' = -gamma^2 [u + (theta + w)/xi].
!>
!> Components are theta, u, w.
module block_problem
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: spring_block

   !> The block; without delay if tau is 0.
   type, extends(constant_past) :: spring_block
      real(wp) :: epsilon, xi, gamma
   contains
      procedure :: rhs, jacobian, series, relaxation_rate, slow_series
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

   !> The equations.
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

   !> Their derivatives.
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

   !> v' = v w' is linear in the state; w' follows from it term by term.
   pure subroutine series(self, t, unit, degree, z, y)
      class(spring_block), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      !> Coefficients of v, the last first, of theta + (1 + epsilon) w(t - tau), and of unit w'
      real(wp), dimension(0:degree) :: v_back, relaxing, rate
      real(wp) :: by_v, compliance, delayed_w, earlier, pull, theta, total, u, v, v_rate, w
      integer :: j, k

      theta = y(0, 1)
      u = y(0, 2)
      w = y(0, 3)
      v = exp(w)
      v_back(degree) = v
      by_v = 1.0_wp/v
      compliance = 1.0_wp/self%xi
      pull = -self%gamma**2*unit
      do k = 0, degree - 1
         ! first what has been known for long: the newest terms need not wait for it
         total = 0.0_wp
         earlier = 0.0_wp
         do j = 0, k - 1
            total = total + v_back(degree - k + j)*relaxing(j)
            earlier = earlier + v_back(degree - k + j)*rate(j)
         end do
         delayed_w = w
         if (size(z, 2) > 0) delayed_w = z(k, 1)
         relaxing(k) = theta + (1.0_wp + self%epsilon)*delayed_w
         v_rate = pull*(u + compliance*(theta + w))
         rate(k) = by_v*(v_rate - earlier)
         theta = -unit/(k + 1)*(total + v_back(degree)*relaxing(k))
         u = unit/(k + 1)*merge(v - 1.0_wp, v, k == 0)
         w = rate(k)/(k + 1)
         v = v_rate/(k + 1)
         y(k + 1, 1) = theta
         y(k + 1, 2) = u
         y(k + 1, 3) = w
         v_back(degree - k - 1) = v
      end do
   end subroutine series

   !> Rate at which w approaches -theta - xi u.
   pure function relaxation_rate(self, t, y) result(rate)
      class(spring_block), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = self%gamma**2/self%xi*exp(-y(3))
   end function relaxation_rate

   !> w = -theta - xi u - (xi/gamma^2) v' with v' as it was.
   pure subroutine slow_series(self, t, unit, degree, z, y)
      class(spring_block), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      !> Coefficients of v, the last first, of theta + (1 + epsilon) w(t - tau), of unit w', and of
      !> unit v' as it was
      real(wp), dimension(0:degree) :: v_back, relaxing, rate, v_rate
      real(wp) :: delayed_w, earlier, theta, total, u, v, v_first, w
      integer :: j, k

      v_rate = last_rate(unit, degree, y(:, 2), y(:, 3))
      theta = y(0, 1)
      u = y(0, 2)
      do k = 0, degree
         total = 0.0_wp
         earlier = 0.0_wp
         do j = 1, k - 1
            total = total + v_back(degree - k + j)*relaxing(j)
            earlier = earlier + v_back(degree - k + j)*rate(j)
         end do
         w = -theta - self%xi*(u + v_rate(k)/(self%gamma**2*unit))
         if (k == 0) then
            v_first = exp(w)
            v = v_first
         else
            rate(k) = k*w
            v = (earlier + v_first*rate(k))/k
         end if
         y(k, 1) = theta
         y(k, 2) = u
         y(k, 3) = w
         v_back(degree - k) = v
         delayed_w = w
         if (size(z, 2) > 0) delayed_w = z(k, 1)
         relaxing(k) = theta + (1.0_wp + self%epsilon)*delayed_w
         total = total + v_first*relaxing(k)
         if (k > 0) total = total + v*relaxing(0)
         theta = -unit/(k + 1)*total
         u = unit/(k + 1)*merge(v - 1.0_wp, v, k == 0)
      end do
   end subroutine slow_series

   !> Coefficients of unit v', by u' = v - 1; the last that is known, for which those of u do not
   !> suffice, by v' = w' v.
   pure function last_rate(unit, degree, u, w) result(rate)
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: u(0:degree), w(0:degree)
      real(wp) :: rate(0:degree)
      integer :: k

      rate(degree - 1:) = 0.0_wp
      do k = 0, degree - 2
         rate(k) = (k + 1)*(k + 2)/unit*u(k + 2)
      end do
      rate(degree - 1) = degree*w(degree)*exp(w(0))
      do k = 1, degree - 1
         rate(degree - 1) = rate(degree - 1) + k*w(k)*rate(degree - k - 1)/(degree - k)
      end do
   end function last_rate
end module block_problem
