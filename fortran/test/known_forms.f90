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
      procedure :: second => no_second_form
      procedure :: third => third_form_of_tanh
   end type neurons

   !> The delayed block in theta, u and v. Lags: 0, tau.
   type, extends(delay_equation_type) :: block_in_v
      !> Parameters
      type(block_parameters_type) :: p
   contains
      procedure :: second => second_form_in_v
      procedure :: third => third_form_in_v
   end type block_in_v

contains

   !> The neurons at their Hopf point.
   pure function new_neurons() result(equation)
      type(neurons) :: equation
      real(wp), parameter :: kappa = 0.5_wp, beta = -1.0_wp, a12 = 1.0_wp, a21 = 0.8071232250_wp

      allocate (equation%linear%a(2, 2, 4))
      equation%linear%a = 0.0_wp
      equation%linear%a(:, :, 1) = reshape([-kappa, 0.0_wp, 0.0_wp, -kappa], [2, 2])
      equation%linear%a(:, :, 2) = reshape([beta, 0.0_wp, 0.0_wp, beta], [2, 2])
      equation%linear%a(1, 2, 3) = a12
      equation%linear%a(2, 1, 4) = a21
      equation%linear%lag = [0.0_wp, 1.5_wp, 0.2_wp, 0.2_wp]
   end function new_neurons

   !> tanh is odd.
   pure function no_second_form(self, x, y) result(form)
      class(neurons), intent(in) :: self
      complex(wp), intent(in) :: x(:, :), y(:, :)
      complex(wp) :: form(size(x, 1))

      form = 0.0_wp
   end function no_second_form

   !> The third derivative of tanh at 0 is -2.
   pure function third_form_of_tanh(self, x, y, z) result(form)
      class(neurons), intent(in) :: self
      complex(wp), intent(in) :: x(:, :), y(:, :), z(:, :)
      complex(wp) :: form(size(x, 1))
      integer :: i

      form = 0.0_wp
      do i = 2, 4
         form = form - 2.0_wp*matmul(self%linear%a(:, :, i), x(:, i)*y(:, i)*z(:, i))
      end do
   end function third_form_of_tanh

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
