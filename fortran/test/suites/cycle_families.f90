!> Families of problems with cycles of which something is known.
module cycle_families
   use analytic_problems, only: analytic_problem
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
      !> Counts the problems that are made, where it is associated
      integer, pointer :: made => null()
   contains
      procedure :: at => member
   end type known_family

   !> One of them.
   type, extends(analytic_problem) :: known_problem
      !> The equation
      integer :: equation = 0
      !> Its parameters
      real(wp), allocatable :: p(:)
   contains
      procedure :: slope => slope_of
   end type known_problem

contains

   !> The problem at parameters.
   subroutine member(self, parameters, problem)
      class(known_family), intent(in) :: self
      real(wp), intent(in) :: parameters(:)
      class(dde_problem_type), allocatable, intent(out) :: problem
      type(known_problem) :: made

      if (associated(self%made)) self%made = self%made + 1
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
      made%first = made%past
      allocate (problem, source=made)
   end subroutine member

   !> The equations.
   pure function slope_of(self, y, z) result(slope)
      class(known_problem), intent(in) :: self
      complex(wp), intent(in) :: y(:), z(:)
      complex(wp) :: slope(size(y))
      complex(wp) :: s

      associate (p => self%p)
         select case (self%equation)
         case (delayed_sine)
            slope(1) = -z(1)*(1.0_wp + p(1) - y(1)**2 - z(1)**2)
         case (delayed_cubic)
            s = y(1)**2 + z(1)**2 - 1.0_wp
            slope(1) = -z(1)*(1.0_wp + p(1) + p(2)*s - s**3)
         case (driven_growth)
            slope(1) = -2.0_wp*pi*y(2) + y(1)*(1.0_wp - y(1)**2 - y(2)**2)
            slope(2) = 2.0_wp*pi*y(1) + y(2)*(1.0_wp - y(1)**2 - y(2)**2)
            slope(3) = (p(1) + p(2)*y(1))*z(1)
         case (duffing)
            slope(1) = y(2)
            slope(2) = -p(4)*y(2) - p(2)*y(1) - y(1)**3 - p(3)*(y(1) - z(1))
         case (mackey_glass)
            slope(1) = p(2)*z(1)/(1.0_wp + z(1)**10) - 0.1_wp*y(1)
         case default
            slope(1) = -kappa*y(1) + beta*tanh(z(1)) + a12*tanh(z(3))
            slope(2) = -kappa*y(2) + beta*tanh(z(2)) + p(1)*tanh(z(4))
         end select
      end associate
   end function slope_of
end module cycle_families
