!> The spring block with delayed friction, equations (3) and (4) of the paper as corrected (see
!> docs/method.md, "What was corrected"). All quantities are nondimensional.
module spring_block
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use block_parameters, only: block_history_type, block_parameters_type
   use block_series, only: series_of_block, slow_series_of_block
   use block_tangent_series, only: slow_tangent_series_of_block, tangent_series_of_block
   use block_state, only: index_of_ln_v, index_of_theta, index_of_u, largest_ln_v, least_ln_v
   use dde, only: problem_with_tangents
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: index_of_ln_v, index_of_theta, index_of_u, spring_block_type

   !> The block with its parameters; all nondimensional.
   type, extends(problem_with_tangents) :: spring_block_type
      !> Parameters of the block
      type(block_parameters_type) :: parameters
      !> State theta, u, ln v for t <= 0
      real(wp) :: past(3) = 0.0_wp
   contains
      procedure :: initial => state_at_zero
      procedure :: history => constant_history
      procedure :: rhs => equation_4
      procedure :: jacobian => derivatives_of_4
      procedure :: series => series_of_4
      procedure :: past_series => constant_series
      procedure :: relaxation_rate => relaxation_of_w
      procedure :: slow_series => slow_series_of_4
      procedure :: tangent_series => tangent_series_of_4
      procedure :: slow_tangent_series => slow_tangent_series_of_4
   end type spring_block_type

   interface spring_block_type
      module procedure :: new_spring_block
   end interface spring_block_type

contains

   !> A block from its parameters and history; without delay it is equation (3).
   pure function new_spring_block(parameters, history) result(block)
      type(block_parameters_type), intent(in) :: parameters
      type(block_history_type), intent(in) :: history
      type(spring_block_type) :: block

      block%n = 3
      block%analytic = .true.
      block%analytic_tangents = .true.
      associate (tau => parameters%tau)
         allocate (block%lag, source=pack([tau], tau > 0.0_wp))
         allocate (block%component, source=pack([index_of_ln_v], tau > 0.0_wp))
      end associate
      block%parameters = parameters
      block%past = [history%theta, history%u, log(history%v)]
   end function new_spring_block

   !> The constant history holds up to t = 0.
   pure subroutine state_at_zero(self, y)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%past
   end subroutine state_at_zero

   !> Constant history.
   pure function constant_history(self, t, component) result(value)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t
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
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: delayed_w, v

      associate (p => self%parameters, theta => y(index_of_theta), u => y(index_of_u), &
                 w => y(index_of_ln_v))
         if (w < least_ln_v .or. w > largest_ln_v) then
            dydt = ieee_value(1.0_wp, ieee_quiet_nan)
            return
         end if
         delayed_w = w
         if (size(z) > 0) delayed_w = z(1)
         v = exp(w)
         dydt(index_of_theta) = -v*(theta + (1.0_wp + p%epsilon)*delayed_w)
         dydt(index_of_u) = v - 1.0_wp
         dydt(index_of_ln_v) = -p%gamma**2/v*(u + (theta + w)/p%xi)
      end associate
   end subroutine equation_4

   !> Derivatives of (4) by theta, u, w and by w(t - tau).
   pure subroutine derivatives_of_4(self, t, y, z, by_y, by_z)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)
      real(wp) :: stiffness, v

      associate (p => self%parameters, theta => y(index_of_theta), u => y(index_of_u), &
                 w => y(index_of_ln_v))
         if (w < least_ln_v .or. w > largest_ln_v) then
            by_y = ieee_value(1.0_wp, ieee_quiet_nan)
            by_z = by_y(1, 1)
            return
         end if
         v = exp(w)
         stiffness = p%gamma**2/v
         by_y = 0.0_wp
         by_y(index_of_theta, index_of_theta) = -v
         by_y(index_of_u, index_of_ln_v) = v
         by_y(index_of_ln_v, index_of_theta) = -stiffness/p%xi
         by_y(index_of_ln_v, index_of_u) = -stiffness
         by_y(index_of_ln_v, index_of_ln_v) = stiffness*(u + (theta + w - 1.0_wp)/p%xi)
         if (size(z) > 0) then
            by_y(index_of_theta, index_of_ln_v) = -v*(theta + (1.0_wp + p%epsilon)*z(1))
            by_z = 0.0_wp
            by_z(index_of_theta, 1) = -v*(1.0_wp + p%epsilon)
         else
            by_y(index_of_theta, index_of_ln_v) = -v*(theta + (1.0_wp + p%epsilon)*(w + 1.0_wp))
         end if
      end associate
   end subroutine derivatives_of_4

   !> Taylor series of the solution of (4).
   pure subroutine series_of_4(self, t, unit, degree, z, y)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      call series_of_block(self%parameters, unit, degree, size(z, 2), z, y)
   end subroutine series_of_4

   !> Rate at which w approaches -theta - xi u, by (4).
   pure function relaxation_of_w(self, t, y) result(rate)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      associate (p => self%parameters)
         rate = p%gamma**2/p%xi*exp(-max(least_ln_v, y(index_of_ln_v)))
      end associate
   end function relaxation_of_w

   !> A better Taylor series of the slow solution of (4).
   pure subroutine slow_series_of_4(self, t, unit, degree, z, y)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      call slow_series_of_block(self%parameters, unit, degree, size(z, 2), z, y)
   end subroutine slow_series_of_4

   !> Taylor series of disturbances of the solution of (4).
   pure subroutine tangent_series_of_4(self, t, unit, degree, z, y, vectors, dz, dy)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag)), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      call tangent_series_of_block(self%parameters, unit, degree, size(z, 2), z, y, vectors, dz, dy)
   end subroutine tangent_series_of_4

   !> A better Taylor series of disturbances of the slow solution of (4).
   pure subroutine slow_tangent_series_of_4(self, t, unit, degree, z, before, y, vectors, dz, dy)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(in) :: before(0:degree, self%n), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      call slow_tangent_series_of_block(self%parameters, unit, degree, size(z, 2), z, before, y, &
                                        vectors, dz, dy)
   end subroutine slow_tangent_series_of_4

   !> Series of the constant history.
   pure subroutine constant_series(self, t, component, unit, y)
      class(spring_block_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), intent(in) :: unit
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%past(component)
   end subroutine constant_series
end module spring_block
