!> The delayed block about its stationary state in theta, u and w = ln v: equation (4) of the
!> paper as in `spring_block`,
!>
!>     theta' = -exp(w) [theta + (1 + epsilon) w(t - tau)]
!>     u'     =  exp(w) - 1
!>     w'     = -gamma^2 exp(-w) [u + (theta + w)/xi].
module block_equation
   use block_parameters, only: block_history_type, block_parameters_type
   use delay_equation, only: delay_equation_type, linear_part
   use dde_kinds, only: wp
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: block_equation_type

   !> The block by its derivatives; lag 1 is 0, lag 2 is tau.
   type, extends(delay_equation_type) :: block_equation_type
      !> Parameters, nondimensional
      type(block_parameters_type) :: parameters
   contains
      procedure :: derivative => derivative_of_4
   end type block_equation_type

   interface block_equation_type
      module procedure :: new_block_equation
   end interface block_equation_type

contains

   !> The block at these parameters.
   pure function new_block_equation(parameters) result(equation)
      type(block_parameters_type), intent(in) :: parameters
      type(block_equation_type) :: equation
      type(block_parameters_type) :: delayed
      ! the delayed part has the same form for every tau > 0
      real(wp), parameter :: some_delay = 1.0_wp

      equation%parameters = parameters
      delayed = parameters
      delayed%tau = some_delay
      equation%linear = linear_part(spring_block_type(delayed, block_history_type()), &
                                    [0.0_wp, 0.0_wp, 0.0_wp])
      equation%linear%lag = [0.0_wp, parameters%tau]
   end function new_block_equation

   !> Derivative of (4) of order k. The right-hand side is made of exp(w) and of exp(w) f and
   !> exp(-w) f with f linear: of the former it is the product of all w_i, of the latter the sum
   !> over i of f_i times the other w.
   pure function derivative_of_4(self, x) result(form)
      class(block_equation_type), intent(in) :: self
      !> Histories at t and t - tau, shape (3, 2, k)
      complex(wp), intent(in) :: x(:, :, :)
      complex(wp) :: form(size(x, 1))
      complex(wp), dimension(size(x, 3)) :: circle, w
      complex(wp) :: others, sum_of_forces, sum_of_frictions
      integer :: i, k

      k = size(x, 3)
      w = x(index_of_ln_v, 1, :)
      sum_of_frictions = 0.0_wp
      sum_of_forces = 0.0_wp
      do i = 1, k
         ! the argument before i in the circle, and all others from i on
         circle = cshift(w, i - 1)
         others = product(circle(:k - 1))
         associate (left => x(:, :, 1 + modulo(i - 2, k)))
            sum_of_frictions = sum_of_frictions + others*friction(self%parameters, left)
            sum_of_forces = sum_of_forces + others*force(self%parameters, left)
         end associate
      end do
      form(index_of_theta) = -sum_of_frictions
      form(index_of_u) = product(w)
      form(index_of_ln_v) = (-1)**k*self%parameters%gamma**2*sum_of_forces
   end function derivative_of_4

   !> theta + (1 + epsilon) w(t - tau).
   pure complex(wp) function friction(p, x) result(value)
      type(block_parameters_type), intent(in) :: p
      !> History at t and t - tau
      complex(wp), intent(in) :: x(:, :)

      value = x(index_of_theta, 1) + (1.0_wp + p%epsilon)*x(index_of_ln_v, 2)
   end function friction

   !> u + (theta + w)/xi.
   pure complex(wp) function force(p, x) result(value)
      type(block_parameters_type), intent(in) :: p
      !> History at t and t - tau
      complex(wp), intent(in) :: x(:, :)

      value = x(index_of_u, 1) + (x(index_of_theta, 1) + x(index_of_ln_v, 1))/p%xi
   end function force
end module block_equation
