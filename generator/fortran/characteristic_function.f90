! SPDX-License-Identifier: BSD-3-Clause
!> The characteristic function of a model at its steady state,
!>
!>     Delta(s) = det(s I - A_0 - sum over k of A_k exp(-s lag_k)) = sum over d of P_d(s) exp(-s d),
!>
!> with polynomials P_d, from the terms that were made from the equations.
module characteristic_function
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: characteristic_of, characteristic_type

   !> Delta(s) of a model, and its derivatives by the model's parameters.
   type :: characteristic_type
      !> Number of equations, of a chain those of one block: the degree of P_0, whose first
      !> coefficient is 1
      integer :: n = 0
      !> Delays d, ascending; the first is 0
      real(wp), allocatable :: delay(:)
      !> Coefficients of P_d, shape (0:n, delays)
      real(wp), allocatable :: coefficient(:, :)
      !> Derivatives by the parameters, shapes (delays, parameters) and (0:n, delays, parameters)
      real(wp), allocatable :: delay_by(:, :), coefficient_by(:, :, :)
   contains
      procedure :: value => delta
      procedure :: by_s
      procedure :: by_parameter
      procedure :: part
      procedure :: curvature_bound
      procedure :: largest_term
      procedure :: root_by
      procedure :: relative_residual
   end type characteristic_type

contains

   !> The characteristic function of a model, of a chain that of the mode with the eigenvalue
   !> `shape%mode`. Terms of one delay in the definition are one part, also where that delay is 0.
   !> Where a delay that moves has no value >= 0 at rest, coefficients are not numbers.
   pure function characteristic_of(model) result(function_of_model)
      !> The model
      class(model_type), intent(in) :: model
      type(characteristic_type) :: function_of_model
      real(wp), allocatable :: coefficient(:), coefficient_by(:, :), delay(:), delay_by(:, :)
      integer, allocatable :: part(:), power(:)
      integer :: i, parts

      call model%characteristic_terms(coefficient, power, delay, part, coefficient_by, delay_by)
      parts = maxval(part)
      associate (c => function_of_model)
         c%n = model%sizes%states
         allocate (c%delay(parts), c%coefficient(0:c%n, parts), &
                   c%delay_by(parts, size(delay_by, 2)), &
                   c%coefficient_by(0:c%n, parts, size(delay_by, 2)), source=0.0_wp)
         do i = 1, size(coefficient)
            c%delay(part(i)) = delay(i)
            c%delay_by(part(i), :) = delay_by(i, :)
            c%coefficient(power(i), part(i)) = coefficient(i)
            c%coefficient_by(power(i), part(i), :) = coefficient_by(i, :)
         end do
         associate (known => pack(c%delay, .not. ieee_is_nan(c%delay)))
            if (model%moving > 0 .and. (size(known) < parts .or. any(known < 0.0_wp))) then
               c%coefficient = ieee_value(1.0_wp, ieee_quiet_nan)
            end if
         end associate
      end associate
   end function characteristic_of

   !> P_d(s), without the exponential.
   pure complex(wp) function part(self, number, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Number of the delay
      integer, intent(in) :: number
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = polynomial(self%coefficient(:, number), s)
   end function part

   !> Delta(s).
   pure complex(wp) function delta(self, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      integer :: i

      value = self%part(1, s)
      do i = 2, size(self%delay)
         value = value + self%part(i, s)*exp(-s*self%delay(i))
      end do
   end function delta

   !> Derivative of Delta by s.
   pure complex(wp) function by_s(self, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      integer :: i, power

      value = 0.0_wp
      do i = 1, size(self%delay)
         value = value + (polynomial([(power*self%coefficient(power, i), power=1, self%n)], s) &
                          - self%delay(i)*self%part(i, s))*exp(-s*self%delay(i))
      end do
   end function by_s

   !> Derivative of Delta by a parameter.
   pure complex(wp) function by_parameter(self, parameter, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Number of the parameter
      integer, intent(in) :: parameter
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      integer :: i

      value = 0.0_wp
      do i = 1, size(self%delay)
         value = value + (polynomial(self%coefficient_by(:, i, parameter), s) &
                          - s*self%delay_by(i, parameter)*self%part(i, s))*exp(-s*self%delay(i))
      end do
   end function by_parameter

   !> Derivative of a root by a parameter.
   pure complex(wp) function root_by(self, parameter, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Number of the parameter
      integer, intent(in) :: parameter
      !> The root
      complex(wp), intent(in) :: s

      value = -self%by_parameter(parameter, s)/self%by_s(s)
   end function root_by

   !> Sum of the sizes of the terms of the second derivative of Delta by s.
   pure real(wp) function curvature_bound(self, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      real(wp) :: size_of_c(0:self%n), size_of_s, total
      integer :: i, power

      size_of_s = abs(s)
      value = 0.0_wp
      do i = 1, size(self%delay)
         size_of_c = abs(self%coefficient(:, i))
         total = 0.0_wp
         do power = self%n, 0, -1
            total = total*size_of_s + size_of_c(power)*self%delay(i)**2
            if (power < self%n) total = total + 2*(power + 1)*size_of_c(power + 1)*self%delay(i)
            if (power < self%n - 1) total = total + (power + 2)*(power + 1)*size_of_c(power + 2)
         end do
         value = value + total*exp(-real(s)*self%delay(i))
      end do
   end function curvature_bound

   !> |Delta(s)| over its largest term: how well s is a characteristic root.
   pure real(wp) function relative_residual(self, s) result(value)
      class(characteristic_type), intent(in) :: self
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = abs(self%value(s))/self%largest_term(s)
   end function relative_residual

   !> Size of the largest term of Delta(s).
   pure real(wp) function largest_term(self, s) result(largest)
      class(characteristic_type), intent(in) :: self
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      integer :: i, power

      largest = 0.0_wp
      do i = 1, size(self%delay)
         do power = 0, self%n
            largest = max(largest, abs(self%coefficient(power, i))*abs(s)**power &
                          *exp(-real(s)*self%delay(i)))
         end do
      end do
   end function largest_term

   !> A polynomial with real coefficients.
   pure complex(wp) function polynomial(coefficient, s) result(value)
      !> Coefficients of s**0, s**1, ...
      real(wp), intent(in) :: coefficient(0:)
      complex(wp), intent(in) :: s
      integer :: power

      value = coefficient(ubound(coefficient, 1))
      do power = ubound(coefficient, 1) - 1, 0, -1
         value = value*s + coefficient(power)
      end do
   end function polynomial
end module characteristic_function
