!> The spring block with delayed friction, equations (3) and (4) of the paper as corrected (see
!> docs/method.md, "What was corrected"). All quantities are nondimensional.
module spring_block
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: dde_problem_type
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: index_of_ln_v, index_of_theta, index_of_u, spring_block_type

   !> Place of the friction state theta in the state vector.
   integer, parameter :: index_of_theta = 1
   !> Place of the displacement u.
   integer, parameter :: index_of_u = 2
   !> Place of w = ln v: in w no step can leave the domain v > 0.
   integer, parameter :: index_of_ln_v = 3

   !> Beyond these exp(w) or gamma^2 exp(-w), times the rest of (4), might overflow.
   real(wp), parameter :: least_ln_v = -600.0_wp, largest_ln_v = 300.0_wp

   !> The block with its parameters; all nondimensional.
   type, extends(dde_problem_type) :: spring_block_type
      !> Sensitivity of the velocity relaxation, (B - A)/A
      real(wp) :: epsilon = 0.0_wp
      !> Spring constant, k L/A
      real(wp) :: xi = 1.0_wp
      !> Frequency, sqrt(k/M) L/v0
      real(wp) :: gamma = 1.0_wp
      !> State theta, u, ln v for t <= 0
      real(wp) :: past(3) = 0.0_wp
   contains
      procedure :: initial => state_at_zero
      procedure :: history => constant_history
      procedure :: rhs => equation_4
      procedure :: jacobian => derivatives_of_4
      procedure :: series => series_of_4
      procedure :: past_series => constant_series
   end type spring_block_type

   interface spring_block_type
      module procedure :: new_spring_block
   end interface spring_block_type

contains

   !> A block at delay tau >= 0; tau = 0 is a problem without delays, equation (3).
   pure function new_spring_block(tau, epsilon, xi, gamma, theta, u, v) result(block)
      !> Delay
      real(wp), intent(in) :: tau
      !> Sensitivity of the velocity relaxation
      real(wp), intent(in) :: epsilon
      !> Spring constant
      real(wp), intent(in) :: xi
      !> Frequency
      real(wp), intent(in) :: gamma
      !> Friction state for t <= 0
      real(wp), intent(in) :: theta
      !> Displacement for t <= 0
      real(wp), intent(in) :: u
      !> Velocity for t <= 0
      real(wp), intent(in) :: v
      type(spring_block_type) :: block

      block%n = 3
      block%analytic = .true.
      allocate (block%lag, source=pack([tau], tau > 0.0_wp))
      allocate (block%component, source=pack([index_of_ln_v], tau > 0.0_wp))
      block%epsilon = epsilon
      block%xi = xi
      block%gamma = gamma
      block%past = [theta, u, log(v)]
   end function new_spring_block

   !> The constant history holds up to t = 0.
   pure subroutine state_at_zero(self, y)
      !> The block
      class(spring_block_type), intent(in) :: self
      !> theta, u, ln v at t = 0
      real(wp), intent(out) :: y(self%n)

      y = self%past
   end subroutine state_at_zero

   !> Constant history.
   pure function constant_history(self, t, component) result(value)
      !> The block
      class(spring_block_type), intent(in) :: self
      !> Time <= 0, without influence
      real(wp), intent(in) :: t
      !> Index into the state
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component)
   end function constant_history

   !> Equation (4), and (3) where there is no delay, with w = ln v:
   !>
   !>     theta' = -v [theta + (1 + epsilon) w(t - tau)]
   !>     u'     =  v - 1
   !>     w'     = -(gamma^2/v) [u + (theta + w)/xi]
   pure subroutine equation_4(self, t, y, z, dydt)
      !> The block
      class(spring_block_type), intent(in) :: self
      !> Time, without influence
      real(wp), intent(in) :: t
      !> theta, u, w
      real(wp), intent(in) :: y(self%n)
      !> w(t - tau), or nothing
      real(wp), intent(in) :: z(size(self%lag))
      !> Time derivatives of theta, u, w
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: delayed_w, v

      associate (theta => y(index_of_theta), u => y(index_of_u), w => y(index_of_ln_v))
         if (w < least_ln_v .or. w > largest_ln_v) then
            dydt = ieee_value(1.0_wp, ieee_quiet_nan)
            return
         end if
         delayed_w = w
         if (size(z) > 0) delayed_w = z(1)
         v = exp(w)
         dydt(index_of_theta) = -v*(theta + (1.0_wp + self%epsilon)*delayed_w)
         dydt(index_of_u) = v - 1.0_wp
         dydt(index_of_ln_v) = -self%gamma**2/v*(u + (theta + w)/self%xi)
      end associate
   end subroutine equation_4

   !> Derivatives of (4) by theta, u, w and by w(t - tau).
   pure subroutine derivatives_of_4(self, t, y, z, by_y, by_z)
      !> The block
      class(spring_block_type), intent(in) :: self
      !> Time, without influence
      real(wp), intent(in) :: t
      !> theta, u, w
      real(wp), intent(in) :: y(self%n)
      !> w(t - tau), or nothing
      real(wp), intent(in) :: z(size(self%lag))
      !> Derivatives by theta, u, w
      real(wp), intent(out) :: by_y(self%n, self%n)
      !> Derivatives by w(t - tau)
      real(wp), intent(out) :: by_z(self%n, size(self%lag))
      real(wp) :: stiffness, v

      associate (theta => y(index_of_theta), u => y(index_of_u), w => y(index_of_ln_v))
         if (w < least_ln_v .or. w > largest_ln_v) then
            by_y = ieee_value(1.0_wp, ieee_quiet_nan)
            by_z = by_y(1, 1)
            return
         end if
         v = exp(w)
         stiffness = self%gamma**2/v
         by_y = 0.0_wp
         by_y(index_of_theta, index_of_theta) = -v
         by_y(index_of_u, index_of_ln_v) = v
         by_y(index_of_ln_v, index_of_theta) = -stiffness/self%xi
         by_y(index_of_ln_v, index_of_u) = -stiffness
         by_y(index_of_ln_v, index_of_ln_v) = stiffness*(u + (theta + w - 1.0_wp)/self%xi)
         if (size(z) > 0) then
            by_y(index_of_theta, index_of_ln_v) = -v*(theta + (1.0_wp + self%epsilon)*z(1))
            by_z = 0.0_wp
            by_z(index_of_theta, 1) = -v*(1.0_wp + self%epsilon)
         else
            by_y(index_of_theta, index_of_ln_v) = -v*(theta + (1.0_wp + self%epsilon)*(w + 1.0_wp))
         end if
      end associate
   end subroutine derivatives_of_4

   !> Taylor series of the solution of (4), with that of v beside it: v' = v w' is
   !> -gamma^2 [u + (theta + w)/xi], linear in the state, and w' follows from it term by term.
   pure subroutine series_of_4(self, t, unit, degree, z, y)
      !> The block
      class(spring_block_type), intent(in) :: self
      !> Time, without influence
      real(wp), intent(in) :: t
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients of w(t - tau), or nothing
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of theta, u, w; y(0, :) is given
      real(wp), intent(inout) :: y(0:degree, self%n)
      !> Coefficients of v, of theta + (1 + epsilon) w(t - tau), and of unit w'
      real(wp), dimension(0:degree) :: v, relaxing, rate
      real(wp) :: by_v, compliance, delayed_w, earlier, share, total, v_rate
      integer :: j, k

      if (y(0, index_of_ln_v) < least_ln_v .or. y(0, index_of_ln_v) > largest_ln_v) then
         y(1:, :) = ieee_value(1.0_wp, ieee_quiet_nan)
         return
      end if
      v(0) = exp(y(0, index_of_ln_v))
      by_v = 1.0_wp/v(0)
      compliance = 1.0_wp/self%xi
      do k = 0, degree - 1
         associate (theta => y(k, index_of_theta), u => y(k, index_of_u), &
                    w => y(k, index_of_ln_v))
            delayed_w = w
            if (size(z, 2) > 0) delayed_w = z(k, 1)
            relaxing(k) = theta + (1.0_wp + self%epsilon)*delayed_w
            v_rate = -self%gamma**2*unit*(u + compliance*(theta + w))
         end associate
         total = v(k)*relaxing(0)
         earlier = 0.0_wp
         do j = 1, k
            total = total + v(k - j)*relaxing(j)
            earlier = earlier + v(k - j + 1)*rate(j - 1)
         end do
         rate(k) = by_v*(v_rate - earlier)
         share = 1.0_wp/(k + 1)
         v(k + 1) = share*v_rate
         y(k + 1, index_of_theta) = -unit*share*total
         y(k + 1, index_of_u) = unit*share*merge(v(0) - 1.0_wp, v(k), k == 0)
         y(k + 1, index_of_ln_v) = share*rate(k)
      end do
   end subroutine series_of_4

   !> Series of the constant history.
   pure subroutine constant_series(self, t, component, unit, y)
      !> The block
      class(spring_block_type), intent(in) :: self
      !> Time <= 0, without influence
      real(wp), intent(in) :: t
      !> Index into the state
      integer, intent(in) :: component
      !> Unit of time of the powers, without influence
      real(wp), intent(in) :: unit
      !> Coefficients
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%past(component)
   end subroutine constant_series
end module spring_block
