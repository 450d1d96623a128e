! SPDX-License-Identifier: BSD-3-Clause
!> Models with normal forms or cycles of which something is known.
module known_models
   use analytic_models, only: analytic_model
   use block_builder, only: by_epsilon, by_gamma, by_tau, by_xi
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: block_by_values, delayed_cubic, delayed_sine, driven_growth, duffing, &
             duffing_with_pair, known_model, layers, lienard, neurons, quadratic, transformed

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> Equations and their parameters:
   !>
   !>     lienard        x' = y - a3 x^3 - a5 x^5, y' = -x; a3, a5
   !>     quadratic      the form of Kapteyn and Bautin at lambda1 = 0; l1, ..., l6:
   !>                    x' = -y - l3 x^2 + (2 l2 + l5) x y + l6 y^2,
   !>                    y' = x + l2 x^2 + (2 l3 + l4) x y - l2 y^2
   !>     delayed_sine   x' = -z [1 + (rho - x^2 - z^2)], z = x(t - pi/2); rho.
   !>                    x = sqrt(rho) sin t is a solution.
   !>     delayed_cubic  x' = -z (1 + a + b s - s^3), s = x^2 + z^2 - 1, z = x(t - pi/2); a, b.
   !>                    x = sqrt(1 + s) sin t is a solution where a + b s = s^3: folds at
   !>                    a = -2 s^3, b = 3 s^2, a cusp at a = b = 0
   !>     driven_growth  (x1, x2) turns on the unit circle once in a unit of time,
   !>                    x3' = (a + b x1) x3(t - lag); a, b, lag
   !>     duffing        delayed feedback, "minimal_demo" of DDE-BIFTOOL, in the state
   !>                    (x + bend v^2, v) with v = x': x'' + d x' + a x + x^3 + b [x - x(t - tau)]
   !>                    = 0; tau, a, b, d, bend
   !>     layers         two layers of neurons, "nmfm_demo" of DDE-BIFTOOL; a, c, tau1, tau2:
   !>                    x1' = -x1 - a g(2 x1(t - tau1)) + c g(1.2 x2(t - tau2)), x2' with 1 and 2
   !>                    exchanged, g(z) = [tanh(z - 1) + tanh 1] cosh^2 1
   !>     neurons        two neurons, "neuron" of DDE-BIFTOOL (Shayer and Campbell 2000, SIAM J.
   !>                    Appl. Math. 61, 673); a21, tau_s:
   !>                    x1' = -x1/2 - tanh x1(t - tau_s) + tanh x2(t - 0.2), x2' = -x2/2
   !>                    - tanh x2(t - tau_s) + a21 tanh x1(t - 0.2)
   integer, parameter :: lienard = 1, quadratic = 2, delayed_sine = 3, delayed_cubic = 4, &
                         driven_growth = 5, duffing = 6, layers = 7, neurons = 8

   !> One of these.
   type, extends(analytic_model) :: known_model
      !> The equation
      integer :: equation = 0
   contains
      procedure :: put => put_known
      procedure :: slope => known_slope
   end type known_model

   interface known_model
      module procedure :: new_known
   end interface known_model

   !> z_j' = z_j (i omega_j + sum_k g_jk |z_k|^2 + f_j |z_j|^4), w' = -w with z_j = x_j + i y_j, in
   !> the state (x_1, y_1, x_2, y_2, w) after shears: nonlinear changes of coordinates with exact
   !> inverses.
   type, extends(analytic_model) :: transformed
      !> Frequencies
      real(wp) :: omega(2) = 0.0_wp
      !> Coefficients
      complex(wp) :: g(2, 2) = 0.0_wp, f(2) = 0.0_wp
   contains
      procedure :: slope => transformed_slope
   end type transformed

   interface transformed
      module procedure :: new_transformed
   end interface transformed

   !> The block in theta, u and ln v or v - 1.
   type, extends(analytic_model) :: block_by_values
      !> The third component is v - 1
      logical :: in_v = .false.
   contains
      procedure :: slope => block_slope
   end type block_by_values

   interface block_by_values
      module procedure :: new_block
   end interface block_by_values

contains

   !> One of the equations at parameters.
   pure type(known_model) function new_known(equation, numbers) result(model)
      integer, intent(in) :: equation
      real(wp), intent(in) :: numbers(:)

      model%equation = equation
      call model%put(numbers)
   end function new_known

   !> Duffing's oscillator at a frequency above sqrt(a) with this pair on the axis, on branch k.
   pure type(known_model) function duffing_with_pair(omega, k, bend) result(model)
      real(wp), intent(in) :: omega, bend
      integer, intent(in) :: k
      real(wp), parameter :: a = 0.5_wp, d = 0.05_wp
      real(wp) :: b, excess

      excess = omega**2 - a
      b = (excess**2 + (d*omega)**2)/(2.0_wp*excess)
      model = known_model(duffing, [(atan2(-d*omega, b - excess) + 2.0_wp*pi*k)/omega, a, b, d, &
                                    bend])
   end function duffing_with_pair

   !> Give the model its parameters.
   pure subroutine put_known(self, parameters)
      class(known_model), intent(inout) :: self
      real(wp), intent(in) :: parameters(:)

      self%numbers = parameters
      associate (p => parameters)
         select case (self%equation)
         case (lienard, quadratic)
            call self%fill([0.1_wp, 0.1_wp], [real(wp) ::], [integer ::])
         case (delayed_sine, delayed_cubic)
            call self%fill([1.0_wp], [0.5_wp*pi], [1])
         case (driven_growth)
            call self%fill([1.0_wp, 0.0_wp, 0.0_wp], [p(3)], [3])
         case (duffing)
            call self%fill([0.5_wp, 0.0_wp], [p(1), p(1)], [1, 2])
         case (layers)
            call self%fill([0.1_wp, 0.1_wp], [p(3), p(3), p(4), p(4)], [1, 2, 2, 1])
         case default
            call self%fill([0.1_wp, 0.1_wp], [p(2), p(2), 0.2_wp, 0.2_wp], [1, 2, 2, 1])
         end select
      end associate
   end subroutine put_known

   !> The equations.
   pure function known_slope(self, y, z) result(slope)
      class(known_model), intent(in) :: self
      complex(wp), intent(in) :: y(:), z(:)
      complex(wp) :: slope(size(y))
      complex(wp) :: place(2), s

      associate (p => self%numbers)
         select case (self%equation)
         case (lienard)
            slope = [y(2) - p(1)*y(1)**3 - p(2)*y(1)**5, -y(1)]
         case (quadratic)
            slope = [-y(2) - p(3)*y(1)**2 + (2.0_wp*p(2) + p(5))*y(1)*y(2) + p(6)*y(2)**2, &
                     y(1) + p(2)*y(1)**2 + (2.0_wp*p(3) + p(4))*y(1)*y(2) - p(2)*y(2)**2]
         case (delayed_sine)
            slope = -z*(1.0_wp + p(1) - y**2 - z**2)
         case (delayed_cubic)
            s = y(1)**2 + z(1)**2 - 1.0_wp
            slope = -z*(1.0_wp + p(1) + p(2)*s - s**3)
         case (driven_growth)
            slope(1) = -2.0_wp*pi*y(2) + y(1)*(1.0_wp - y(1)**2 - y(2)**2)
            slope(2) = 2.0_wp*pi*y(1) + y(2)*(1.0_wp - y(1)**2 - y(2)**2)
            slope(3) = (p(1) + p(2)*y(1))*z(1)
         case (duffing)
            place = [y(1) - p(5)*y(2)**2, z(1) - p(5)*z(2)**2]
            slope(2) = -p(4)*y(2) - p(2)*place(1) - place(1)**3 - p(3)*(place(1) - place(2))
            slope(1) = y(2) + 2.0_wp*p(5)*y(2)*slope(2)
         case (layers)
            slope = -y - p(1)*response(2.0_wp*z(:2)) + p(2)*response(1.2_wp*z(3:))
         case default
            slope = -0.5_wp*y - tanh(z(:2)) + [1.0_wp, p(1)]*tanh(z(3:))
         end select
      end associate
   end function known_slope

   !> g(z).
   elemental complex(wp) function response(z) result(value)
      complex(wp), intent(in) :: z

      value = (tanh(z - 1.0_wp) + tanh(1.0_wp))*cosh(1.0_wp)**2
   end function response

   !> The transformed normal form with its coefficients.
   pure type(transformed) function new_transformed(omega, g, f) result(model)
      real(wp), intent(in) :: omega(2)
      complex(wp), intent(in) :: g(2, 2), f(2)

      model%omega = omega
      model%g = g
      model%f = f
      call model%fill(spread(0.0_wp, 1, 5), [real(wp) ::], [integer ::])
   end function new_transformed

   !> The state is brought back through the shears, the velocity forward.
   pure function transformed_slope(self, y, z) result(slope)
      class(transformed), intent(in) :: self
      complex(wp), intent(in) :: y(:), z(:)
      complex(wp) :: slope(size(y))
      complex(wp) :: by(5), growth, size_2(2), state(5, 0:5), turn
      real(wp) :: along(5)
      integer :: j, k

      state(:, 5) = y
      do k = 5, 1, -1
         state(:, k - 1) = state(:, k)
         state(k, k - 1) = state(k, k) - bend(k, state(:, k))
      end do
      size_2 = [(state(2*j - 1, 0)**2 + state(2*j, 0)**2, j=1, 2)]
      do j = 1, 2
         growth = sum(real(self%g(j, :))*size_2) + real(self%f(j))*size_2(j)**2
         turn = self%omega(j) + sum(aimag(self%g(j, :))*size_2) + aimag(self%f(j))*size_2(j)**2
         slope(2*j - 1) = growth*state(2*j - 1, 0) - turn*state(2*j, 0)
         slope(2*j) = growth*state(2*j, 0) + turn*state(2*j - 1, 0)
      end do
      slope(5) = -state(5, 0)
      do k = 1, 5
         do j = 1, 5
            along = 0.0_wp
            along(j) = 1.0_wp
            by(j) = bend_slope(k, state(:, k), along)
         end do
         slope(k) = slope(k) + sum(by*slope)
      end do
   end function transformed_slope

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

   !> The block at parameters.
   pure type(block_by_values) function new_block(numbers, in_v) result(model)
      real(wp), intent(in) :: numbers(:)
      logical, intent(in) :: in_v

      model%numbers = numbers
      model%in_v = in_v
      call model%fill([0.0_wp, 0.0_wp, 0.0_wp], [numbers(by_tau)], [3])
   end function new_block

   !> Equations (3) and (4).
   pure function block_slope(self, y, z) result(slope)
      class(block_by_values), intent(in) :: self
      complex(wp), intent(in) :: y(:), z(:)
      complex(wp) :: slope(size(y))
      complex(wp) :: v, w(2)

      w = [y(3), z(1)]
      if (self%in_v) w = log(1.0_wp + w)
      v = exp(w(1))
      associate (p => self%numbers)
         slope = [-v*(y(1) + (1.0_wp + p(by_epsilon))*w(2)), v - 1.0_wp, &
                  -p(by_gamma)**2*(y(2) + (y(1) + w(1))/p(by_xi))]
      end associate
      if (.not. self%in_v) slope(3) = slope(3)/v
   end function block_slope
end module known_models
