! SPDX-License-Identifier: BSD-3-Clause
!> A delayed model about its state at rest: the linear system
!>
!>     y'(t) = sum_j A_j y(t - lag_j).
module linear_system
   use dde, only: find_jacobian
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use tangent_problem, only: allocate_slopes
   implicit none (type, external)
   private
   public :: find_full_jacobian, linear_part, linear_system_type

   !> A linear system with constant lags; an instantaneous term has lag 0.
   type :: linear_system_type
      !> Matrices A_j, shape (n, n, number of lags)
      real(wp), allocatable :: a(:, :, :)
      !> Lags, each >= 0
      real(wp), allocatable :: lag(:)
   contains
      procedure :: characteristic_matrix, characteristic_slope, history
   end type linear_system_type

contains

   !> The linear part of a model at rest. Lag 1 is 0, those of the delayed values follow, also where
   !> a delay is 0; derivative forms of the model take histories at these lags.
   pure function linear_part(model) result(linear)
      !> The model, which keeps delays of 0
      class(model_type), intent(in) :: model
      type(linear_system_type) :: linear
      real(wp) :: by_y(model%n, model%n), by_z(model%n, size(model%lag)), state(model%n)
      integer :: k

      state = model%steady_state()
      call find_full_jacobian(model, state, state(model%component), by_y, by_z)
      allocate (linear%a(model%n, model%n, size(model%lag) + 1), source=0.0_wp)
      linear%a(:, :, 1) = by_y
      do k = 1, size(model%lag)
         linear%a(:, model%component(k), k + 1) = by_z(:, k)
      end do
      linear%lag = [0.0_wp, model%lag]
      associate (constant => size(model%lag) - model%moving)
         ! near rest a delay of the state is that at rest (Cooke and Huang 1996)
         if (model%moving > 0) call model%moving_lags(0.0_wp, state, linear%lag(constant + 2:))
      end associate
   end function linear_part

   !> The Jacobian as full matrices, also of a problem that gives it as a band.
   pure subroutine find_full_jacobian(problem, y, z, by_y, by_z)
      !> The problem
      class(model_type), intent(in) :: problem
      !> State and delayed values
      real(wp), intent(in) :: y(:), z(:)
      !> Derivatives by y and z, shapes (n, n) and (n, delays)
      real(wp), intent(out) :: by_y(:, :), by_z(:, :)
      real(wp), allocatable :: band(:, :), columns(:, :)
      integer :: column, first, last

      if (problem%lower < 0) then
         call find_jacobian(problem, 0.0_wp, y, z, by_y, by_z)
         return
      end if
      associate (n => problem%n, upper => problem%upper, rows => problem%rows)
         call allocate_slopes(problem, band, columns)
         call find_jacobian(problem, 0.0_wp, y, z, band, columns)
         by_y = 0.0_wp
         do column = 1, n
            first = max(1, column - upper)
            last = min(n, column + problem%lower)
            by_y(first:last, column) = band(1 + upper + first - column:1 + upper + last - column, &
                                            column)
         end do
         by_z = 0.0_wp
         do column = 1, size(z)
            by_z(rows(1, column):rows(2, column), column) &
               = columns(:1 + rows(2, column) - rows(1, column), column)
         end do
      end associate
   end subroutine find_full_jacobian

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

   !> exp(s a) sum_d polynomial(:, d) a^d at a = -lag for all lags, shape (n, lags).
   pure function history(self, polynomial, s) result(values)
      class(linear_system_type), intent(in) :: self
      !> Coefficients, shape (n, 0:degree)
      complex(wp), intent(in) :: polynomial(:, 0:)
      complex(wp), intent(in) :: s
      complex(wp) :: values(size(polynomial, 1), size(self%lag))
      integer :: d, i

      values = 0.0_wp
      do i = 1, size(self%lag)
         do d = ubound(polynomial, 2), 0, -1
            values(:, i) = polynomial(:, d) - self%lag(i)*values(:, i)
         end do
         values(:, i) = exp(-s*self%lag(i))*values(:, i)
      end do
   end function history
end module linear_system
