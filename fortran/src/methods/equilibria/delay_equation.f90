!> Delay equations about a stationary state: their linear part
!>
!>     y'(t) = sum_j A_j y(t - lag_j),
!>
!> and the higher derivative forms of their right-hand side.
module delay_equation
   use dde, only: dde_problem_type, find_jacobian
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: delay_equation_type, linear_part, linear_system_type

   !> A linear system with constant lags; an instantaneous term has lag 0.
   type :: linear_system_type
      !> Matrices A_j, shape (n, n, number of lags)
      real(wp), allocatable :: a(:, :, :)
      !> Lags, each >= 0
      real(wp), allocatable :: lag(:)
   contains
      procedure :: characteristic_matrix, characteristic_slope
   end type linear_system_type

   !> A right-hand side by its derivatives at the stationary state. The arguments of the forms are
   !> histories: column j holds their values at t - lag_j.
   type, abstract :: delay_equation_type
      !> First derivative
      type(linear_system_type) :: linear
   contains
      !> The derivative of any order from 2 on
      procedure(derivative_form), deferred :: derivative
   end type delay_equation_type

   abstract interface
      !> Derivative of the order of the number of arguments, symmetric and linear in each of them.
      pure function derivative_form(self, x) result(form)
         import :: delay_equation_type, wp
         implicit none (type, external)
         class(delay_equation_type), intent(in) :: self
         !> Histories at all lags, shape (n, number of lags, order)
         complex(wp), intent(in) :: x(:, :, :)
         complex(wp) :: form(size(x, 1))
      end function derivative_form
   end interface

contains

   !> The linear part of a problem at a stationary state; lag 1 is 0, those of the problem follow.
   pure function linear_part(problem, state) result(linear)
      !> The problem, with constant lags
      class(dde_problem_type), intent(in) :: problem
      !> The stationary state
      real(wp), intent(in) :: state(:)
      type(linear_system_type) :: linear
      real(wp) :: by_y(size(state), size(state)), by_z(size(state), size(problem%lag))
      integer :: k

      call find_jacobian(problem, 0.0_wp, state, state(problem%component), by_y, by_z)
      allocate (linear%a(size(state), size(state), size(problem%lag) + 1), source=0.0_wp)
      linear%a(:, :, 1) = by_y
      do k = 1, size(problem%lag)
         linear%a(:, problem%component(k), k + 1) = by_z(:, k)
      end do
      linear%lag = [0.0_wp, problem%lag]
   end function linear_part

   !> Delta(s), singular at characteristic roots.
   pure function characteristic_matrix(self, s) result(matrix)
      class(linear_system_type), intent(in) :: self
      complex(wp), intent(in) :: s
      complex(wp) :: matrix(size(self%a, 1), size(self%a, 1))
      integer :: i

      matrix = 0.0_wp
      do i = 1, size(matrix, 1)
         matrix(i, i) = s
      end do
      do i = 1, size(self%lag)
         matrix = matrix - self%a(:, :, i)*exp(-s*self%lag(i))
      end do
   end function characteristic_matrix

   !> Derivative of Delta(s).
   pure function characteristic_slope(self, s) result(matrix)
      class(linear_system_type), intent(in) :: self
      complex(wp), intent(in) :: s
      complex(wp) :: matrix(size(self%a, 1), size(self%a, 1))
      integer :: i

      matrix = 0.0_wp
      do i = 1, size(matrix, 1)
         matrix(i, i) = 1.0_wp
      end do
      do i = 1, size(self%lag)
         matrix = matrix + self%a(:, :, i)*(self%lag(i)*exp(-s*self%lag(i)))
      end do
   end function characteristic_slope
end module delay_equation
