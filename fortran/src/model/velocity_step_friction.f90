!> The friction law of Dieterich and Ruina, equations (1.1) and (1.2) of the paper, at an imposed
!> velocity, for Figure 8 only: the block's own friction is in `spring_block`. SI units.
module velocity_step_friction
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   use value_checks, only: missing
   implicit none (type, external)
   private
   public :: friction_parameters_type, friction_coefficient, steady_state, state_evolution_type

   !> Parameters of the law.
   type :: friction_parameters_type
      !> Friction at v = v0 without the two logarithms (dimensionless)
      real(wp) :: mu0 = missing
      !> Size of the direct effect (dimensionless)
      real(wp) :: a = missing
      !> Size of the evolution effect (dimensionless)
      real(wp) :: b = missing
      !> Critical slip distance, m
      real(wp) :: dc = missing
      !> Reference velocity, m/s
      real(wp) :: v0 = missing
      !> Constant b beside the state, s
      real(wp) :: b_state = missing
   end type friction_parameters_type

   !> Evolution of the state theta, equation (1.2), at constant velocity.
   type, extends(dde_problem_type) :: state_evolution_type
      !> The law
      type(friction_parameters_type) :: law
      !> Imposed velocity, m/s
      real(wp) :: v = 0.0_wp
      !> State at the start, s
      real(wp) :: theta_start = 0.0_wp
   contains
      procedure :: initial => theta_at_start
      procedure :: history => no_history
      procedure :: rhs => equation_1_2
   end type state_evolution_type

   interface state_evolution_type
      module procedure :: new_state_evolution
   end interface state_evolution_type

contains

   !> Equation (1.1): mu = mu0 - A ln(v0/v + 1) + B ln(theta/b + 1).
   elemental real(wp) function friction_coefficient(law, v, theta) result(mu)
      !> The law
      type(friction_parameters_type), intent(in) :: law
      !> Velocity, m/s; state, s
      real(wp), intent(in) :: v, theta

      mu = law%mu0 - law%a*log(law%v0/v + 1.0_wp) + law%b*log(theta/law%b_state + 1.0_wp)
   end function friction_coefficient

   !> State at which (1.2) is at rest, s.
   elemental real(wp) function steady_state(law, v) result(theta)
      !> The law
      type(friction_parameters_type), intent(in) :: law
      !> Velocity, m/s
      real(wp), intent(in) :: v

      theta = law%dc/v
   end function steady_state

   !> The problem without delays that (1.2) is at constant velocity.
   pure function new_state_evolution(law, v, theta_start) result(problem)
      type(friction_parameters_type), intent(in) :: law
      real(wp), intent(in) :: v, theta_start
      type(state_evolution_type) :: problem

      problem%n = 1
      allocate (problem%lag(0), problem%component(0))
      problem%law = law
      problem%v = v
      problem%theta_start = theta_start
   end function new_state_evolution

   !> State at the start.
   pure subroutine theta_at_start(self, y)
      class(state_evolution_type), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%theta_start
   end subroutine theta_at_start

   !> Nothing is delayed here; the state at the start stands in.
   pure function no_history(self, t, component) result(value)
      class(state_evolution_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%theta_start
   end function no_history

   !> Equation (1.2): dtheta/dt = 1 - v theta/Dc.
   pure subroutine equation_1_2(self, t, y, z, dydt)
      class(state_evolution_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 1.0_wp - self%v*y/self%law%dc
   end subroutine equation_1_2
end module velocity_step_friction
