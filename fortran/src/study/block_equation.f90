!> The delayed block about its stationary state in theta, u and w = ln v, to third order: equation
!> (4) of the paper as in `spring_block`,
!>
!>     theta' = -exp(w) [theta + (1 + epsilon) w(t - tau)]
!>     u'     =  exp(w) - 1
!>     w'     = -gamma^2 exp(-w) [u + (theta + w)/xi].
module block_equation
   use block_parameters, only: block_history_type, block_parameters_type
   use delay_equation, only: delay_equation_type
   use dde, only: find_jacobian
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
      procedure :: second => second_form_of_4
      procedure :: third => third_form_of_4
   end type block_equation_type

   interface block_equation_type
      module procedure :: new_block_equation
   end interface block_equation_type

contains

   !> The block at these parameters.
   pure function new_block_equation(parameters) result(equation)
      !> Parameters
      type(block_parameters_type), intent(in) :: parameters
      type(block_equation_type) :: equation
      type(block_parameters_type) :: delayed
      type(spring_block_type) :: block
      ! the delayed part has the same form for every tau > 0
      real(wp), parameter :: some_delay = 1.0_wp
      real(wp) :: by_z(3, 1)

      equation%parameters = parameters
      delayed = parameters
      delayed%tau = some_delay
      block = spring_block_type(delayed, block_history_type())
      allocate (equation%linear%a(3, 3, 2), equation%linear%lag(2))
      call find_jacobian(block, 0.0_wp, [0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp], &
                         equation%linear%a(:, :, 1), by_z)
      equation%linear%a(:, :, 2) = 0.0_wp
      equation%linear%a(:, index_of_ln_v, 2) = by_z(:, 1)
      equation%linear%lag = [0.0_wp, parameters%tau]
   end function new_block_equation

   !> Second derivatives of (4).
   pure function second_form_of_4(self, x, y) result(form)
      !> The block
      class(block_equation_type), intent(in) :: self
      !> Histories at t and t - tau
      complex(wp), intent(in) :: x(:, :), y(:, :)
      complex(wp) :: form(size(x, 1))

      associate (p => self%parameters, wx => x(index_of_ln_v, 1), wy => y(index_of_ln_v, 1))
         form(index_of_theta) = -(wx*friction(p, y) + wy*friction(p, x))
         form(index_of_u) = wx*wy
         form(index_of_ln_v) = p%gamma**2*(wx*force(p, y) + wy*force(p, x))
      end associate
   end function second_form_of_4

   !> Third derivatives of (4).
   pure function third_form_of_4(self, x, y, z) result(form)
      !> The block
      class(block_equation_type), intent(in) :: self
      !> Histories at t and t - tau
      complex(wp), intent(in) :: x(:, :), y(:, :), z(:, :)
      complex(wp) :: form(size(x, 1))

      associate (p => self%parameters, wx => x(index_of_ln_v, 1), wy => y(index_of_ln_v, 1), &
                 wz => z(index_of_ln_v, 1))
         form(index_of_theta) = -(wx*wy*friction(p, z) + wy*wz*friction(p, x) &
                                  + wz*wx*friction(p, y))
         form(index_of_u) = wx*wy*wz
         form(index_of_ln_v) = -p%gamma**2*(wx*wy*force(p, z) + wy*wz*force(p, x) &
                                            + wz*wx*force(p, y))
      end associate
   end function third_form_of_4

   !> theta + (1 + epsilon) w(t - tau).
   pure complex(wp) function friction(p, x) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> History at t and t - tau
      complex(wp), intent(in) :: x(:, :)

      value = x(index_of_theta, 1) + (1.0_wp + p%epsilon)*x(index_of_ln_v, 2)
   end function friction

   !> u + (theta + w)/xi.
   pure complex(wp) function force(p, x) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> History at t and t - tau
      complex(wp), intent(in) :: x(:, :)

      value = x(index_of_u, 1) + (x(index_of_theta, 1) + x(index_of_ln_v, 1))/p%xi
   end function force
end module block_equation
