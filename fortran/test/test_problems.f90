!> Delay equations with published or exact solutions (Wille and Baker 1992; Hairer, Norsett and
!> Wanner 1993, sec. II.17; Guglielmi and Hairer 2001; Mackey and Glass 1977).
module test_problems
   use dde, only: dde_problem_type
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: constant_past, enzyme, fill, infection, linear, mackey_glass, sine, wille_baker

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

   interface linear
      module procedure :: new_linear
   end interface linear

   !> Two delays: y1' = y1(t-1), y2' = y1(t-1) + y2(t-0.2), y3' = y2.
   type, extends(constant_past) :: wille_baker
   contains
      procedure :: rhs => wille_baker_rhs
   end type wille_baker

   interface wille_baker
      module procedure :: new_wille_baker
   end interface wille_baker

   !> An infection: delays 1 and 10.
   type, extends(constant_past) :: infection
   contains
      procedure :: rhs => infection_rhs
   end type infection

   interface infection
      module procedure :: new_infection
   end interface infection

   !> Enzyme kinetics with inhibition.
   type, extends(constant_past) :: enzyme
   contains
      procedure :: rhs => enzyme_rhs
   end type enzyme

   interface enzyme
      module procedure :: new_enzyme
   end interface enzyme

   !> y' = 0.2 y(t-17)/(1 + y(t-17)^10) - 0.1 y.
   type, extends(constant_past) :: mackey_glass
   contains
      procedure :: rhs => mackey_glass_rhs
   end type mackey_glass

   interface mackey_glass
      module procedure :: new_mackey_glass
   end interface mackey_glass

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

contains

   !> Fill what every problem has. (flang 19 crashes on structure constructors with components of a
   !> parent type, llvm-project issue 118270; so each type has a function of its name.)
   pure subroutine fill(problem, n, past, first, lag, component)
      class(constant_past), intent(inout) :: problem
      integer, intent(in) :: n
      real(wp), intent(in) :: past(:), first(:)
      real(wp), intent(in), optional :: lag(:)
      integer, intent(in), optional :: component(:)

      problem%n = n
      problem%past = past
      problem%first = first
      if (present(lag)) problem%lag = lag
      if (present(component)) problem%component = component
   end subroutine fill

   !> The problem with its components.
   pure type(linear) function new_linear(n, lag, component, past, first, rate) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)
      real(wp), intent(in), optional :: rate

      call fill(problem, n, past, first, lag, component)
      if (present(rate)) problem%rate = rate
   end function new_linear

   !> The problem with its components.
   pure type(wille_baker) function new_wille_baker(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
   end function new_wille_baker

   !> The problem with its components.
   pure type(infection) function new_infection(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
   end function new_infection

   !> The problem with its components.
   pure type(enzyme) function new_enzyme(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
   end function new_enzyme

   !> The problem with its components.
   pure type(mackey_glass) function new_mackey_glass(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
   end function new_mackey_glass

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
end module test_problems
