!> Analytic equations whose normal forms are known.
module known_equations
   use analytic_equations, only: analytic_equation_type, set_linear_part
   use block_parameters, only: block_parameters_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: block_by_values, duffing_with_pair, layers, lienard, neurons, new_block_by_values, &
             new_small, new_transformed, quadratic, small_equation, transformed

   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

   !> Small equations, their coefficients p and delays:
   !>
   !>     lienard    x' = y - a3 x^3 - a5 x^5, y' = -x; a3, a5
   !>     quadratic  the form of Kapteyn and Bautin at lambda1 = 0; l1, ..., l6:
   !>                x' = -y - l3 x^2 + (2 l2 + l5) x y + l6 y^2, y' = x + l2 x^2 + (2 l3 + l4) x y
   !>                - l2 y^2
   !>     duffing    delayed feedback, demonstration minimal_demo of DDE-BIFTOOL, in the state
   !>                (x + bend v^2, v) with v = x': x'' + d x' + a x + x^3 + b [x - x(t - tau)] = 0;
   !>                a, b, d, bend; tau
   !>     layers     two layers of neurons, demonstration nmfm_demo of DDE-BIFTOOL; a, c; tau1,
   !>                tau2:
   !>                x1' = -x1 - a g(2 x1(t - tau1)) + c g(1.2 x2(t - tau2)), x2' with 1 and 2
   !>                exchanged, g(z) = [tanh(z - 1) + tanh 1] cosh^2 1
   !>     neurons    two neurons, demonstration neuron of DDE-BIFTOOL; a21; tau_s, tau1 = 0.2:
   !>                x1' = -x1/2 - tanh x1(t - tau_s) + tanh x2(t - tau1), x2' = -x2/2
   !>                - tanh x2(t - tau_s) + a21 tanh x1(t - tau1)
   integer, parameter :: lienard = 1, quadratic = 2, duffing = 3, layers = 4, neurons = 5

   !> One of these equations.
   type, extends(analytic_equation_type) :: small_equation
      !> The equation
      integer :: equation = 0
      !> Its coefficients
      real(wp), allocatable :: p(:)
   contains
      procedure :: rhs => small_rhs
   end type small_equation

   !> z_j' = z_j (i omega_j + sum_k g_jk |z_k|^2 + f_j |z_j|^4), w' = -w with z_j = x_j + i y_j, in
   !> the state (x_1, y_1, x_2, y_2, w) after shears: nonlinear changes of coordinates with exact
   !> inverses.
   type, extends(analytic_equation_type) :: transformed
      !> Frequencies
      real(wp) :: omega(2) = 0.0_wp
      !> Coefficients
      complex(wp) :: g(2, 2) = 0.0_wp, f(2) = 0.0_wp
   contains
      procedure :: rhs => transformed_rhs
   end type transformed

   !> The block in theta, u and ln v or v - 1.
   type, extends(analytic_equation_type) :: block_by_values
      !> Parameters
      type(block_parameters_type) :: p
      !> The third component is v - 1
      logical :: in_v = .false.
   contains
      procedure :: rhs => block_rhs
   end type block_by_values

contains

   !> Duffing's oscillator at a frequency above sqrt(a) with this pair on the axis, on branch k.
   type(small_equation) function duffing_with_pair(omega, k, bend) result(equation)
      real(wp), intent(in) :: omega, bend
      integer, intent(in) :: k
      real(wp), parameter :: a = 0.5_wp, d = 0.05_wp
      real(wp) :: b, excess

      excess = omega**2 - a
      b = (excess**2 + (d*omega)**2)/(2.0_wp*excess)
      equation = new_small(duffing, [a, b, d, bend], &
                           [(atan2(-d*omega, b - excess) + two_pi*k)/omega])
   end function duffing_with_pair

   !> A small equation with its linear part.
   type(small_equation) function new_small(equation, p, delays) result(made)
      integer, intent(in) :: equation
      real(wp), intent(in) :: p(:)
      !> Lags > 0, in the order of the equation
      real(wp), intent(in), optional :: delays(:)

      made%equation = equation
      made%p = p
      if (present(delays)) then
         call set_linear_part(made, 2, [0.0_wp, delays])
      else
         call set_linear_part(made, 2, [0.0_wp])
      end if
   end function new_small

   !> The small equations.
   pure function small_rhs(self, x) result(dxdt)
      class(small_equation), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))
      complex(wp) :: place(2)

      associate (p => self%p, u => x(1, 1), v => x(2, 1))
         select case (self%equation)
         case (lienard)
            dxdt = [v - p(1)*u**3 - p(2)*u**5, -u]
         case (quadratic)
            dxdt = [-v - p(3)*u**2 + (2.0_wp*p(2) + p(5))*u*v + p(6)*v**2, &
                    u + p(2)*u**2 + (2.0_wp*p(3) + p(4))*u*v - p(2)*v**2]
         case (duffing)
            place = x(1, :) - p(4)*x(2, :)**2
            dxdt(2) = -p(3)*v - p(1)*place(1) - place(1)**3 - p(2)*(place(1) - place(2))
            dxdt(1) = v + 2.0_wp*p(4)*v*dxdt(2)
         case (layers)
            dxdt = -x(:, 1) - p(1)*response(2.0_wp*x(:, 2)) + p(2)*response(1.2_wp*x(2:1:-1, 3))
         case default
            dxdt = -0.5_wp*x(:, 1) - tanh(x(:, 2)) + [1.0_wp, p(1)]*tanh(x(2:1:-1, 3))
         end select
      end associate
   end function small_rhs

   !> The equation with its linear part.
   type(transformed) function new_transformed(omega, g, f) result(equation)
      real(wp), intent(in) :: omega(2)
      complex(wp), intent(in) :: g(2, 2), f(2)

      equation%omega = omega
      equation%g = g
      equation%f = f
      call set_linear_part(equation, 5, [0.0_wp])
   end function new_transformed

   !> The state is brought back through the shears, the velocity forward.
   pure function transformed_rhs(self, x) result(dxdt)
      class(transformed), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))
      complex(wp) :: growth, size_2(2), slope(5), state(5, 0:5), turn
      real(wp) :: along(5)
      integer :: j, k

      state(:, 5) = x(:, 1)
      do k = 5, 1, -1
         state(:, k - 1) = state(:, k)
         state(k, k - 1) = state(k, k) - bend(k, state(:, k))
      end do
      size_2 = [(state(2*j - 1, 0)**2 + state(2*j, 0)**2, j=1, 2)]
      do j = 1, 2
         growth = sum(real(self%g(j, :))*size_2) + real(self%f(j))*size_2(j)**2
         turn = self%omega(j) + sum(aimag(self%g(j, :))*size_2) + aimag(self%f(j))*size_2(j)**2
         dxdt(2*j - 1) = growth*state(2*j - 1, 0) - turn*state(2*j, 0)
         dxdt(2*j) = growth*state(2*j, 0) + turn*state(2*j - 1, 0)
      end do
      dxdt(5) = -state(5, 0)
      do k = 1, 5
         do j = 1, 5
            along = 0.0_wp
            along(j) = 1.0_wp
            slope(j) = bend_slope(k, state(:, k), along)
         end do
         dxdt(k) = dxdt(k) + sum(slope*dxdt)
      end do
   end function transformed_rhs

   !> What shear k adds to component k: a polynomial in the other components.
   pure complex(wp) function bend(k, x) result(value)
      integer, intent(in) :: k
      complex(wp), intent(in) :: x(5)
      complex(wp) :: r(0:4)

      r = cshift(x, k - 1)
      value = 0.7_wp*r(1)**2 - 0.4_wp*r(1)*r(2) + 0.5_wp*r(2)*r(3) + 0.3_wp*r(4)*r(1) &
              + 0.6_wp*r(4)**2 + 0.8_wp*r(3)**2 - 0.2_wp*r(2)**3 + 0.9_wp*r(1)*r(3)*r(4)
   end function bend

   !> Its derivative in a direction.
   pure complex(wp) function bend_slope(k, x, direction) result(value)
      integer, intent(in) :: k
      complex(wp), intent(in) :: x(5)
      real(wp), intent(in) :: direction(5)
      complex(wp) :: r(0:4)
      real(wp) :: s(0:4)

      r = cshift(x, k - 1)
      s = cshift(direction, k - 1)
      value = s(1)*(1.4_wp*r(1) - 0.4_wp*r(2) + 0.3_wp*r(4) + 0.9_wp*r(3)*r(4)) &
              + s(2)*(-0.4_wp*r(1) + 0.5_wp*r(3) - 0.6_wp*r(2)**2) &
              + s(3)*(0.5_wp*r(2) + 1.6_wp*r(3) + 0.9_wp*r(1)*r(4)) &
              + s(4)*(0.3_wp*r(1) + 1.2_wp*r(4) + 0.9_wp*r(1)*r(3))
   end function bend_slope

   !> g(z).
   elemental complex(wp) function response(z) result(value)
      complex(wp), intent(in) :: z

      value = (tanh(z - 1.0_wp) + tanh(1.0_wp))*cosh(1.0_wp)**2
   end function response

   !> The equation with its linear part.
   type(block_by_values) function new_block_by_values(p, in_v) result(equation)
      type(block_parameters_type), intent(in) :: p
      logical, intent(in) :: in_v

      equation%p = p
      equation%in_v = in_v
      call set_linear_part(equation, 3, [0.0_wp, p%tau])
   end function new_block_by_values

   pure function block_rhs(self, x) result(dxdt)
      class(block_by_values), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))
      complex(wp) :: v, w(2)

      w = x(3, :)
      if (self%in_v) w = log(1.0_wp + x(3, :))
      v = exp(w(1))
      associate (p => self%p, theta => x(1, 1), u => x(2, 1))
         dxdt = [-v*(theta + (1.0_wp + p%epsilon)*w(2)), v - 1.0_wp, &
                 -p%gamma**2*(u + (theta + w(1))/p%xi)]
      end associate
      if (.not. self%in_v) dxdt(3) = dxdt(3)/v
   end function block_rhs
end module known_equations
