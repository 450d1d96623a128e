!> The block about its stationary state: the linear part and the derivative forms of its law.
module block_equation
   use block_parameters, only: block_parameters_type
   use delay_equation, only: delay_equation_type, linear_part
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use spring_block, only: find_model
   implicit none (type, external)
   private
   public :: block_equation_type

   !> The block by its derivatives; lag 1 is 0, lag 2 is tau.
   type, extends(delay_equation_type) :: block_equation_type
      !> The model of the law
      type(model_type) :: model
   contains
      procedure :: derivative
   end type block_equation_type

   interface block_equation_type
      module procedure :: new_block_equation
   end interface block_equation_type

contains

   !> The block at these parameters; the delayed part has the same form for every tau >= 0.
   function new_block_equation(parameters) result(equation)
      type(block_parameters_type), intent(in) :: parameters
      type(block_equation_type) :: equation

      call find_model(parameters, equation%model, keep_delays=.true.)
      equation%linear = linear_part(equation%model, equation%model%steady_state())
   end function new_block_equation

   !> Derivative of the equations of order k.
   pure function derivative(self, x) result(form)
      class(block_equation_type), intent(in) :: self
      !> Histories at t and t - tau, shape (n, 2, k)
      complex(wp), intent(in) :: x(:, :, :)
      complex(wp) :: form(size(x, 1))

      form = self%model%derivative(x)
   end function derivative
end module block_equation
