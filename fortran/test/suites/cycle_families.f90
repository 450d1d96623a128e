!> Families of problems with cycles of which something is known.
module cycle_families
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   use problem_family, only: problem_family_type
   implicit none (type, external)
   private
   public :: delayed_cubic, delayed_sine, driven_growth, duffing, known_family, mackey_glass, &
             neurons

   !> Equations:
   !>
   !>     delayed_sine   x' = -z [1 + (rho - x^2 - z^2)], z = x(t - pi/2); parameter rho.
   !>                    x = sqrt(rho) sin t is a solution.
   !>     delayed_cubic  x' = -z (1 + a + b s - s^3), s = x^2 + z^2 - 1, z = x(t - pi/2);
   !>                    parameters a, b. x = sqrt(1 + s) sin t is a solution where
   !>                    a + b s = s^3: folds at a = -2 s^3, b = 3 s^2, a cusp at a = b = 0
   !>     driven_growth  (x1, x2) turns on the unit circle once in a unit of time,
   !>                    x3' = (a + b x1) x3(t - lag); parameters a, b, lag
   !>     duffing        x'' + d x' + a x + x^3 + b [x - x(t - tau)] = 0; parameters tau, a, b, d:
   !>                    "minimal_demo" of DDE-BIFTOOL
   !>     mackey_glass   x' = beta z/(1 + z^10) - x/10, z = x(t - tau); parameters tau, beta
   !>     neurons        two neurons, "neuron" of DDE-BIFTOOL (Shayer and Campbell 2000, SIAM J.
   !>                    Appl. Math. 61, 673); parameter a21
   integer, parameter :: delayed_sine = 1, driven_growth = 2, duffing = 3, mackey_glass = 4, &
                         neurons = 5, delayed_cubic = 6

   !> Constants of the neurons.
   real(wp), parameter :: kappa = 0.5_wp, beta = -1.0_wp, a12 = 1.0_wp

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> Problems of one of these equations.
   type, extends(problem_family_type) :: known_family
      !> The equation
      integer :: equation = 0
   contains
      procedure :: at => member
   end type known_family

   !> One of them.
   type, extends(dde_problem_type) :: known_problem
      !> The equation
      integer :: equation = 0
      !> Its parameters
      real(wp), allocatable :: p(:)
      !> State before the initial time
      real(wp), allocatable :: past(:)
   contains
      procedure :: initial
      procedure :: history
      procedure :: rhs
      procedure :: jacobian
   end type known_problem

contains

   !> The problem at parameters.
   subroutine member(self, parameters, problem)
      class(known_family), intent(in) :: self
      real(wp), intent(in) :: parameters(:)
      class(dde_problem_type), allocatable, intent(out) :: problem
      type(known_problem) :: made

      made%equation = self%equation
      made%p = parameters
      select case (self%equation)
      case (delayed_sine, delayed_cubic)
         made%n = 1
         made%lag = [0.5_wp*pi]
         made%component = [1]
         made%past = [1.0_wp]
      case (driven_growth)
         made%n = 3
         made%lag = [parameters(3)]
         made%component = [3]
         made%past = [1.0_wp, 0.0_wp, 0.0_wp]
      case (duffing)
         made%n = 2
         made%lag = [parameters(1)]
         made%component = [1]
         made%past = [0.5_wp, 0.0_wp]
      case (mackey_glass)
         made%n = 1
         made%lag = [parameters(1)]
         made%component = [1]
         made%past = [0.5_wp]
      case default
         made%n = 2
         made%lag = [1.5_wp, 1.5_wp, 0.2_wp, 0.2_wp]
         made%component = [1, 2, 2, 1]
         made%past = [0.1_wp, 0.1_wp]
      end select
      allocate (problem, source=made)
   end subroutine member

   !> The past holds up to the initial time.
   pure subroutine initial(self, y)
      class(known_problem), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%past
   end subroutine initial

   !> A constant past.
   pure function history(self, t, component) result(value)
      class(known_problem), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component)
   end function history

   !> The equations.
   pure subroutine rhs(self, t, y, z, dydt)
      class(known_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: s

      associate (p => self%p)
         select case (self%equation)
         case (delayed_sine)
            dydt(1) = -z(1)*(1.0_wp + p(1) - y(1)**2 - z(1)**2)
         case (delayed_cubic)
            s = y(1)**2 + z(1)**2 - 1.0_wp
            dydt(1) = -z(1)*(1.0_wp + p(1) + p(2)*s - s**3)
         case (driven_growth)
            dydt(1) = -2.0_wp*pi*y(2) + y(1)*(1.0_wp - y(1)**2 - y(2)**2)
            dydt(2) = 2.0_wp*pi*y(1) + y(2)*(1.0_wp - y(1)**2 - y(2)**2)
            dydt(3) = (p(1) + p(2)*y(1))*z(1)
         case (duffing)
            dydt(1) = y(2)
            dydt(2) = -p(4)*y(2) - p(2)*y(1) - y(1)**3 - p(3)*(y(1) - z(1))
         case (mackey_glass)
            dydt(1) = p(2)*z(1)/(1.0_wp + z(1)**10) - 0.1_wp*y(1)
         case default
            dydt(1) = -kappa*y(1) + beta*tanh(z(1)) + a12*tanh(z(3))
            dydt(2) = -kappa*y(2) + beta*tanh(z(2)) + p(1)*tanh(z(4))
         end select
      end associate
   end subroutine rhs

   !> Their derivatives.
   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(known_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: by_y(self%n, self%n), by_z(self%n, size(self%lag))
      real(wp) :: s

      by_y = 0.0_wp
      by_z = 0.0_wp
      associate (p => self%p)
         select case (self%equation)
         case (delayed_sine)
            by_y(1, 1) = 2.0_wp*y(1)*z(1)
            by_z(1, 1) = -(1.0_wp + p(1) - y(1)**2 - 3.0_wp*z(1)**2)
         case (delayed_cubic)
            s = y(1)**2 + z(1)**2 - 1.0_wp
            by_y(1, 1) = -2.0_wp*y(1)*z(1)*(p(2) - 3.0_wp*s**2)
            by_z(1, 1) = -(1.0_wp + p(1) + p(2)*s - s**3) - 2.0_wp*z(1)**2*(p(2) - 3.0_wp*s**2)
         case (driven_growth)
            by_y(1, 1) = 1.0_wp - 3.0_wp*y(1)**2 - y(2)**2
            by_y(1, 2) = -2.0_wp*pi - 2.0_wp*y(1)*y(2)
            by_y(2, 1) = 2.0_wp*pi - 2.0_wp*y(1)*y(2)
            by_y(2, 2) = 1.0_wp - y(1)**2 - 3.0_wp*y(2)**2
            by_y(3, 1) = p(2)*z(1)
            by_z(3, 1) = p(1) + p(2)*y(1)
         case (duffing)
            by_y(1, 2) = 1.0_wp
            by_y(2, 1) = -p(2) - 3.0_wp*y(1)**2 - p(3)
            by_y(2, 2) = -p(4)
            by_z(2, 1) = p(3)
         case (mackey_glass)
            by_y(1, 1) = -0.1_wp
            by_z(1, 1) = p(2)*(1.0_wp - 9.0_wp*z(1)**10)/(1.0_wp + z(1)**10)**2
         case default
            by_y(1, 1) = -kappa
            by_y(2, 2) = -kappa
            by_z(1, 1) = beta/cosh(z(1))**2
            by_z(2, 2) = beta/cosh(z(2))**2
            by_z(1, 3) = a12/cosh(z(3))**2
            by_z(2, 4) = p(1)/cosh(z(4))**2
         end select
      end associate
   end subroutine jacobian
end module cycle_families
