!> Delay equations by their derivatives, for tests of the normal form.
module known_forms
   use block_parameters, only: block_parameters_type
   use delay_equation, only: delay_equation_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: block_in_v, neurons, new_block_in_v, new_neurons

   !> Two neurons, the demonstration of DDE-BIFTOOL, at the origin:
   !> x1' = -kappa x1 + beta tanh x1(t - tau_s) + a12 tanh x2(t - tau2), and x2' likewise with a21
   !> and tau1. Lags: 0, tau_s, tau2, tau1.
   type, extends(delay_equation_type) :: neurons
   contains
      procedure :: derivative => derivative_of_tanh
   end type neurons

   !> The delayed block in theta, u and v. Lags: 0, tau.
   type, extends(delay_equation_type) :: block_in_v
      !> Parameters
      type(block_parameters_type) :: p
   contains
      procedure :: derivative => derivative_in_v
   end type block_in_v

contains

   !> The neurons.
   pure function new_neurons(a21, tau_s) result(equation)
      real(wp), intent(in) :: a21, tau_s
      type(neurons) :: equation
      real(wp), parameter :: kappa = 0.5_wp, beta = -1.0_wp, a12 = 1.0_wp

      allocate (equation%linear%a(2, 2, 4))
      equation%linear%a = 0.0_wp
      equation%linear%a(:, :, 1) = reshape([-kappa, 0.0_wp, 0.0_wp, -kappa], [2, 2])
      equation%linear%a(:, :, 2) = reshape([beta, 0.0_wp, 0.0_wp, beta], [2, 2])
      equation%linear%a(1, 2, 3) = a12
      equation%linear%a(2, 1, 4) = a21
      equation%linear%lag = [0.0_wp, tau_s, 0.2_wp, 0.2_wp]
   end function new_neurons

   !> tanh is odd; its third derivative at 0 is -2, its fifth is 16.
   pure function derivative_of_tanh(self, x) result(form)
      class(neurons), intent(in) :: self
      complex(wp), intent(in) :: x(:, :, :)
      complex(wp) :: form(size(x, 1))
      real(wp), parameter :: at_zero(2:5) = [0.0_wp, -2.0_wp, 0.0_wp, 16.0_wp]
      integer :: i

      form = 0.0_wp
      do i = 2, size(x, 2)
         form = form + at_zero(size(x, 3)) &
                *matmul(self%linear%a(:, :, i), product(x(:, i, :), dim=2))
      end do
   end function derivative_of_tanh

   !> The block; its linear part by hand.
   pure function new_block_in_v(p) result(equation)
      type(block_parameters_type), intent(in) :: p
      type(block_in_v) :: equation

      allocate (equation%linear%a(3, 3, 2))
      equation%p = p
      equation%linear%a = 0.0_wp
      equation%linear%a(1, 1, 1) = -1.0_wp
      equation%linear%a(2, 3, 1) = 1.0_wp
      equation%linear%a(3, :, 1) = -p%gamma**2*[1.0_wp/p%xi, 1.0_wp, 1.0_wp/p%xi]
      equation%linear%a(1, 3, 2) = -(1.0_wp + p%epsilon)
      equation%linear%lag = [0.0_wp, p%tau]
   end function new_block_in_v

   !> To third order.
   pure function derivative_in_v(self, x) result(form)
      class(block_in_v), intent(in) :: self
      complex(wp), intent(in) :: x(:, :, :)
      complex(wp) :: form(size(x, 1))

      if (size(x, 3) == 2) then
         form = second_form_in_v(self, x(:, :, 1), x(:, :, 2))
      else
         form = third_form_in_v(self, x(:, :, 1), x(:, :, 2), x(:, :, 3))
      end if
   end function derivative_in_v

   !> Of theta' = -v [theta + (1 + epsilon) ln z] and v' = -gamma^2 [u + (theta + ln v)/xi], with
   !> z = v(t - tau), at theta = u = 0, v = z = 1.
   pure function second_form_in_v(self, x, y) result(form)
      class(block_in_v), intent(in) :: self
      complex(wp), intent(in) :: x(:, :), y(:, :)
      complex(wp) :: form(size(x, 1))

      associate (slope => 1.0_wp + self%p%epsilon, rate => self%p%gamma**2/self%p%xi)
         form(1) = -(x(3, 1)*y(1, 1) + x(1, 1)*y(3, 1)) &
                   - slope*(x(3, 1)*y(3, 2) + x(3, 2)*y(3, 1)) + slope*x(3, 2)*y(3, 2)
         form(2) = 0.0_wp
         form(3) = rate*x(3, 1)*y(3, 1)
      end associate
   end function second_form_in_v

   !> The same to third order.
   pure function third_form_in_v(self, x, y, z) result(form)
      class(block_in_v), intent(in) :: self
      complex(wp), intent(in) :: x(:, :), y(:, :), z(:, :)
      complex(wp) :: form(size(x, 1))

      associate (slope => 1.0_wp + self%p%epsilon, rate => self%p%gamma**2/self%p%xi)
         form(1) = slope*(x(3, 1)*y(3, 2)*z(3, 2) + x(3, 2)*y(3, 1)*z(3, 2) &
                          + x(3, 2)*y(3, 2)*z(3, 1) - 2.0_wp*x(3, 2)*y(3, 2)*z(3, 2))
         form(2) = 0.0_wp
         form(3) = -2.0_wp*rate*x(3, 1)*y(3, 1)*z(3, 1)
      end associate
   end function third_form_in_v
end module known_forms
