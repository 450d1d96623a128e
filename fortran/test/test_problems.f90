!> Delay equations with published or exact solutions (Wille and Baker 1992; Hairer, Norsett and
!> Wanner 1993, sec. II.17; Guglielmi and Hairer 2001; Mackey and Glass 1977).
module test_problems
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: dde_problem_type
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: blow_up, decay, enzyme, falls_out, infection, linear, mackey_glass, oscillator, quadrature
   public :: sine, swing, wille_baker, without_delays

   !> The start of every problem here that has one: constant history and first state.
   type, extends(dde_problem_type), abstract :: constant_past
      !> History, shape (n)
      real(wp), allocatable :: past(:)
      !> First state, shape (n)
      real(wp), allocatable :: first(:)
   contains
      procedure :: initial => first_state
      procedure :: history => constant_history
   end type constant_past

   !> y' = -rate y(t - lag).
   type, extends(constant_past) :: linear
      !> Rate
      real(wp) :: rate = 1.0_wp
   contains
      procedure :: rhs => linear_rhs
   end type linear

   !> Two delays: y1' = y1(t-1), y2' = y1(t-1) + y2(t-0.2), y3' = y2.
   type, extends(constant_past) :: wille_baker
   contains
      procedure :: rhs => wille_baker_rhs
   end type wille_baker

   !> An infection: delays 1 and 10.
   type, extends(constant_past) :: infection
   contains
      procedure :: rhs => infection_rhs
   end type infection

   !> Enzyme kinetics with inhibition.
   type, extends(constant_past) :: enzyme
   contains
      procedure :: rhs => enzyme_rhs
   end type enzyme

   !> y' = 0.2 y(t-17)/(1 + y(t-17)^10) - 0.1 y.
   type, extends(constant_past) :: mackey_glass
   contains
      procedure :: rhs => mackey_glass_rhs
   end type mackey_glass

   !> y' = (power + 1) t^power.
   type, extends(constant_past) :: quadrature
      !> Power of t
      integer :: power = 0
   contains
      procedure :: rhs => quadrature_rhs
   end type quadrature

   !> y' = -rate y.
   type, extends(constant_past) :: decay
      !> Rate
      real(wp) :: rate = 1.0_wp
   contains
      procedure :: rhs => decay_rhs
   end type decay

   !> y1' = rate y2, y2' = -rate y1.
   type, extends(constant_past) :: oscillator
      !> Rate
      real(wp) :: rate = 1.0_wp
   contains
      procedure :: rhs => oscillator_rhs
   end type oscillator

   !> y' = -y(t - pi/2) with the history sin t: y = sin t.
   type, extends(dde_problem_type) :: sine
   contains
      procedure :: initial => sine_at_zero
      procedure :: history => sine_history
      procedure :: rhs => sine_rhs
   end type sine

   interface sine
      module procedure :: new_sine
   end interface sine

   !> y' = y^2: infinite at t = 1/y(0).
   type, extends(constant_past) :: blow_up
   contains
      procedure :: rhs => blow_up_rhs
   end type blow_up

   !> y' = 1 where t < 1, no number after.
   type, extends(constant_past) :: falls_out
   contains
      procedure :: rhs => falls_out_rhs
   end type falls_out

contains

   !> No delays and no delayed components.
   pure subroutine without_delays(problem)
      class(dde_problem_type), intent(inout) :: problem

      allocate (problem%lag(0), problem%component(0))
   end subroutine without_delays

   !> An oscillator with y1 = cos(rate t), y2 = -sin(rate t); rate 1 if not given.
   pure type(oscillator) function swing(rate) result(problem)
      real(wp), intent(in), optional :: rate

      problem = oscillator(n=2, past=[1.0_wp, 0.0_wp], first=[1.0_wp, 0.0_wp])
      call without_delays(problem)
      if (present(rate)) problem%rate = rate
   end function swing

   !> The first state.
   pure subroutine first_state(self, y)
      class(constant_past), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%first
   end subroutine first_state

   !> The same value at all times before the first instant.
   pure function constant_history(self, t, component) result(value)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component) + 0.0_wp*t
   end function constant_history

   !> z = y(t - lag).
   pure subroutine linear_rhs(self, t, y, z, dydt)
      class(linear), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -self%rate*z
   end subroutine linear_rhs

   !> z = (y1(t-1), y2(t-0.2)).
   pure subroutine wille_baker_rhs(self, t, y, z, dydt)
      class(wille_baker), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [z(1), z(1) + z(2), y(2)]
   end subroutine wille_baker_rhs

   !> z = (y2(t-1), y2(t-10)).
   pure subroutine infection_rhs(self, t, y, z, dydt)
      class(infection), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-y(1)*z(1) + z(2), y(1)*z(1) - y(2), y(2) - z(2)]
   end subroutine infection_rhs

   !> z = y4(t-4).
   pure subroutine enzyme_rhs(self, t, y, z, dydt)
      class(enzyme), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: flow

      flow = y(1)/(1.0_wp + 0.0005_wp*z(1)**3)
      dydt = [10.5_wp - flow, flow - y(2), y(2) - y(3), y(3) - 0.5_wp*y(4)]
   end subroutine enzyme_rhs

   !> z = y(t-17).
   pure subroutine mackey_glass_rhs(self, t, y, z, dydt)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 0.2_wp*z/(1.0_wp + z**10) - 0.1_wp*y
   end subroutine mackey_glass_rhs

   !> -rate y.
   pure subroutine decay_rhs(self, t, y, z, dydt)
      class(decay), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -self%rate*y
   end subroutine decay_rhs

   !> y' = (power + 1) t^power.
   pure subroutine quadrature_rhs(self, t, y, z, dydt)
      class(quadrature), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = (self%power + 1)*t**self%power
   end subroutine quadrature_rhs

   !> y1' = rate y2, y2' = -rate y1.
   pure subroutine oscillator_rhs(self, t, y, z, dydt)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = self%rate*[y(2), -y(1)]
   end subroutine oscillator_rhs

   !> The problem with its delay.
   pure type(sine) function new_sine() result(problem)
      problem%n = 1
      allocate (problem%lag, source=[0.5_wp*acos(-1.0_wp)])
      allocate (problem%component, source=[1])
   end function new_sine

   !> sin 0.
   pure subroutine sine_at_zero(self, y)
      class(sine), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 0.0_wp
   end subroutine sine_at_zero

   !> sin t.
   pure function sine_history(self, t, component) result(value)
      class(sine), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = sin(t)
   end function sine_history

   !> z = y(t - pi/2).
   pure subroutine sine_rhs(self, t, y, z, dydt)
      class(sine), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -z
   end subroutine sine_rhs

   !> y' = y^2.
   pure subroutine blow_up_rhs(self, t, y, z, dydt)
      class(blow_up), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = y**2
   end subroutine blow_up_rhs

   !> No number from t = 1 on.
   pure subroutine falls_out_rhs(self, t, y, z, dydt)
      class(falls_out), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 1.0_wp
      if (t >= 1.0_wp) dydt = ieee_value(t, ieee_quiet_nan)
   end subroutine falls_out_rhs
end module test_problems
