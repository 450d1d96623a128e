!> Analytic equations whose normal forms are known.
module known_equations
   use analytic_equations, only: analytic_equation_type, set_linear_part
   use block_parameters, only: block_parameters_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: block_by_values, duffing_with_pair, new_block_by_values, new_layers, new_lienard
   public :: new_quadratic, new_transformed, transformed

   !> One turn.
   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

   !> x' = y - a3 x^3 - a5 x^5, y' = -x.
   type, extends(analytic_equation_type) :: lienard
      !> Coefficients
      real(wp) :: a3 = 0.0_wp, a5 = 0.0_wp
   contains
      procedure :: rhs => lienard_rhs
   end type lienard

   !> The quadratic system in the form of Kapteyn and Bautin at lambda1 = 0:
   !> x' = -y - l3 x^2 + (2 l2 + l5) x y + l6 y^2, y' = x + l2 x^2 + (2 l3 + l4) x y - l2 y^2.
   type, extends(analytic_equation_type) :: quadratic
      !> lambda
      real(wp) :: l(6) = 0.0_wp
   contains
      procedure :: rhs => quadratic_rhs
   end type quadratic

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

   !> Duffing's oscillator with delayed feedback, demonstration minimal_demo of DDE-BIFTOOL:
   !> x'' + d x' + a x + x^3 + b [x - x(t - tau)] = 0, in the state (x + bend v^2, v) with v = x'.
   type, extends(analytic_equation_type) :: delayed_duffing
      !> Coefficients
      real(wp) :: a = 0.5_wp, b = 0.6_wp, d = 0.05_wp, bend = 0.0_wp
   contains
      procedure :: rhs => duffing_rhs
   end type delayed_duffing

   !> Two layers of neurons, demonstration nmfm_demo of DDE-BIFTOOL:
   !> x1' = -x1 - a g(b x1(t - tau1)) + c g(d x2(t - tau2)), x2' with 1 and 2 exchanged,
   !> g(z) = [tanh(z - 1) + tanh 1] cosh^2 1, b = 2, d = 1.2.
   type, extends(analytic_equation_type) :: neural_layers
      !> Coefficients
      real(wp) :: a = 0.0_wp, c = 0.0_wp
   contains
      procedure :: rhs => layers_rhs
   end type neural_layers

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

   !> The equation with its linear part.
   type(lienard) function new_lienard(a3, a5) result(equation)
      real(wp), intent(in) :: a3, a5

      equation%a3 = a3
      equation%a5 = a5
      call set_linear_part(equation, 2, [0.0_wp])
   end function new_lienard

   pure function lienard_rhs(self, x) result(dxdt)
      class(lienard), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))

      dxdt = [x(2, 1) - self%a3*x(1, 1)**3 - self%a5*x(1, 1)**5, -x(1, 1)]
   end function lienard_rhs

   !> The equation with its linear part.
   type(quadratic) function new_quadratic(l) result(equation)
      real(wp), intent(in) :: l(6)

      equation%l = l
      call set_linear_part(equation, 2, [0.0_wp])
   end function new_quadratic

   pure function quadratic_rhs(self, x) result(dxdt)
      class(quadratic), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))

      associate (l => self%l, u => x(1, 1), v => x(2, 1))
         dxdt = [-v - l(3)*u**2 + (2.0_wp*l(2) + l(5))*u*v + l(6)*v**2, &
                 u + l(2)*u**2 + (2.0_wp*l(3) + l(4))*u*v - l(2)*v**2]
      end associate
   end function quadratic_rhs

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

   !> The equation with its linear part.
   type(delayed_duffing) function new_duffing(b, tau, bend) result(equation)
      real(wp), intent(in) :: b, tau, bend

      equation%b = b
      equation%bend = bend
      call set_linear_part(equation, 2, [0.0_wp, tau])
   end function new_duffing

   !> At a frequency above sqrt(a), the equation with this pair on the axis, on branch k.
   type(delayed_duffing) function duffing_with_pair(omega, k, bend) result(equation)
      real(wp), intent(in) :: omega, bend
      integer, intent(in) :: k
      real(wp) :: b, excess

      excess = omega**2 - equation%a
      b = (excess**2 + (equation%d*omega)**2)/(2.0_wp*excess)
      equation = new_duffing(b, (atan2(-equation%d*omega, b - excess) + two_pi*k)/omega, bend)
   end function duffing_with_pair

   pure function duffing_rhs(self, x) result(dxdt)
      class(delayed_duffing), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))
      complex(wp) :: place(2)

      place = x(1, :) - self%bend*x(2, :)**2
      dxdt(2) = -self%d*x(2, 1) - self%a*place(1) - place(1)**3 - self%b*(place(1) - place(2))
      dxdt(1) = x(2, 1) + 2.0_wp*self%bend*x(2, 1)*dxdt(2)
   end function duffing_rhs

   !> The equation with its linear part.
   type(neural_layers) function new_layers(a, c) result(equation)
      real(wp), intent(in) :: a, c

      equation%a = a
      equation%c = c
      call set_linear_part(equation, 2, [0.0_wp, 12.7_wp, 20.2_wp])
   end function new_layers

   pure function layers_rhs(self, x) result(dxdt)
      class(neural_layers), intent(in) :: self
      complex(wp), intent(in) :: x(:, :)
      complex(wp) :: dxdt(size(x, 1))

      dxdt = -x(:, 1) - self%a*response(2.0_wp*x(:, 2)) + self%c*response(1.2_wp*x(2:1:-1, 3))
   end function layers_rhs

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
