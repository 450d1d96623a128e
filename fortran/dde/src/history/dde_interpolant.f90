! SPDX-License-Identifier: BSD-3-Clause
!> The polynomial of a step, in Newton form over s = (t - t_n)/h,
!>
!>     p(s) = a(0) + (s - x(1)) [a(1) + (s - x(2)) [a(2) + ... ]],
!>
!> where the nodes x belong to the method and the coefficients a to the step and the component.
module dde_interpolant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: highest_degree, newton_row, newton_state, newton_values, series_value
   public :: stored_degree, taylor_coefficients, usual_degree

   !> Highest degree of a polynomial.
   integer, parameter :: highest_degree = 20
   !> Highest degree of polynomials other than Taylor series.
   integer, parameter :: usual_degree = 8
   !> Highest degree of short polynomials.
   integer, parameter :: short_degree = 4
   !> Factorials, and one over them. All are exact. Compilers disagree on the values of `gamma`.
   real(wp), parameter :: factorial(0:highest_degree) = [ &
      1.0_wp, 1.0_wp, 2.0_wp, 6.0_wp, 24.0_wp, 120.0_wp, 720.0_wp, 5040.0_wp, 40320.0_wp, &
      362880.0_wp, 3628800.0_wp, 39916800.0_wp, 479001600.0_wp, &
      6227020800.0_wp, 87178291200.0_wp, 1307674368000.0_wp, &
      20922789888000.0_wp, 355687428096000.0_wp, 6402373705728000.0_wp, &
      121645100408832000.0_wp, 2432902008176640000.0_wp]
   real(wp), parameter :: inverse_factorial(0:highest_degree) = 1.0_wp/factorial

contains

   !> Degree up to which coefficients are stored: those above the degree of p are 0.
   pure integer function stored_degree(degree) result(stored)
      !> Degree of p
      integer, intent(in) :: degree

      stored = short_degree
      if (degree > short_degree) stored = max(degree, usual_degree)
   end function stored_degree

   !> Values of p at ascending places, from number `first` up to a limit. Written out for the usual
   !> degrees, since most time of a step is spent on delayed values.
   pure subroutine newton_values(degree, x, a, offset, length, limit, places, ahead, first, &
                                 row, rows, values)
      !> Degree of p
      integer, value :: degree
      !> Nodes
      real(wp), intent(in) :: x(highest_degree)
      !> Coefficients, 0 above the degree of p
      real(wp), intent(in) :: a(0:stored_degree(degree))
      !> Time from the start of p's step to the origin of `ahead`, the length of p's step, and the
      !> time since its start up to which p is read
      real(wp), value :: offset, length, limit
      !> Places as times, ascending
      integer, value :: places
      real(wp), intent(in) :: ahead(places)
      !> First place to read; on return the first that lies beyond the limit
      integer, intent(inout) :: first
      !> The row that the values fill, and all rows
      integer, value :: row, rows
      real(wp), intent(inout) :: values(rows, places)
      real(wp) :: s, rest
      integer :: i, j

      if (degree <= short_degree) then
         do i = first, places
            if (offset + ahead(i) > limit) exit
            s = (offset + ahead(i))/length
            values(row, i) = a(0) + (s - x(1))*(a(1) + (s - x(2))*(a(2) + (s - x(3))*(a(3) &
                           + (s - x(4))*a(4))))
         end do
         first = i
         return
      end if
      do i = first, places
         if (offset + ahead(i) > limit) exit
         s = (offset + ahead(i))/length
         rest = 0.0_wp
         do j = degree, usual_degree + 1, -1
            rest = (s - x(j))*(a(j) + rest)
         end do
         rest = (s - x(5))*(a(5) + (s - x(6))*(a(6) + (s - x(7))*(a(7) &
                + (s - x(8))*(a(8) + rest))))
         values(row, i) = a(0) + (s - x(1))*(a(1) + (s - x(2))*(a(2) + (s - x(3))*(a(3) &
                        + (s - x(4))*(a(4) + rest))))
      end do
      first = i
   end subroutine newton_values

   !> Values at s of several polynomials, the columns of a, as `newton_values`.
   pure subroutine newton_row(degree, x, a, s, values)
      integer, intent(in) :: degree
      real(wp), contiguous, intent(in) :: a(0:, :)
      real(wp), intent(in) :: x(highest_degree), s
      real(wp), intent(out) :: values(size(a, 2))
      real(wp) :: d(usual_degree), rest
      integer :: j, k

      d = s - x(:usual_degree)
      do k = 1, size(values)
         rest = 0.0_wp
         do j = degree, usual_degree + 1, -1
            rest = (s - x(j))*(a(j, k) + rest)
         end do
         if (degree > short_degree) then
            rest = d(5)*(a(5, k) + d(6)*(a(6, k) + d(7)*(a(7, k) + d(8)*(a(8, k) + rest))))
         end if
         values(k) = a(0, k) + d(1)*(a(1, k) + d(2)*(a(2, k) + d(3)*(a(3, k) &
                   + d(4)*(a(4, k) + rest))))
      end do
   end subroutine newton_row

   !> Value of a series of powers at s. Even and odd terms are summed in parallel.
   pure function series_value(degree, coefficients, s) result(value)
      !> Degree
      integer, intent(in) :: degree
      !> Coefficients
      real(wp), intent(in) :: coefficients(0:degree)
      !> Place
      real(wp), intent(in) :: s
      real(wp) :: even, odd, square, value
      integer :: k, last_odd

      square = s*s
      last_odd = degree - 1 + modulo(degree, 2)
      even = 0.0_wp
      if (last_odd < degree) even = coefficients(degree)
      odd = 0.0_wp
      do k = last_odd, 1, -2
         odd = coefficients(k) + square*odd
         even = coefficients(k - 1) + square*even
      end do
      value = even + s*odd
   end function series_value

   !> Coefficients of p in powers of a unit of time from s on.
   pure subroutine taylor_coefficients(degree, nodes, powers, coefficients, s, unit, taylor)
      !> Degree of p
      integer, intent(in) :: degree
      !> Nodes x(1..degree)
      real(wp), intent(in) :: nodes(degree)
      !> Whether all of them are 0
      logical, intent(in) :: powers
      !> Coefficients a(0..degree)
      real(wp), intent(in) :: coefficients(0:degree)
      !> Place in the step
      real(wp), intent(in) :: s
      !> The unit of time, in lengths of the step
      real(wp), intent(in) :: unit
      !> Coefficients of the powers; higher ones than its size are left out
      real(wp), contiguous, intent(out) :: taylor(0:)
      real(wp) :: power, rest(0:highest_degree)
      integer :: i, j

      taylor(degree + 1:) = 0.0_wp
      if (powers) then
         call shift(degree, coefficients, s, unit, taylor)
         return
      end if
      rest(:degree) = coefficients
      ! each pass replaces one more node by s, which makes one more coefficient final
      do i = 0, degree - 1
         do j = degree - 1, i, -1
            rest(j) = rest(j) + (s - nodes(j - i + 1))*rest(j + 1)
         end do
      end do
      power = 1.0_wp
      do i = 0, min(degree, ubound(taylor, 1))
         taylor(i) = power*rest(i)
         power = power*unit
      end do
   end subroutine taylor_coefficients

   !> From powers of x to powers of (x - s)/unit: i! b(i) = unit**i times the sum over j of
   !> (i + j)! a(i + j) s**j/j!. The sums are independent of each other.
   pure subroutine shift(degree, a, s, unit, b)
      integer, intent(in) :: degree
      real(wp), intent(in) :: a(0:degree)
      !> Where the new powers vanish
      real(wp), intent(in) :: s
      !> Unit of x
      real(wp), intent(in) :: unit
      !> New coefficients; higher ones than its size are left out
      real(wp), contiguous, intent(inout) :: b(0:)
      real(wp), dimension(0:highest_degree + 1) :: derivatives, weights
      real(wp) :: even, odd, power
      integer :: i, j

      power = 1.0_wp
      do i = 0, degree
         derivatives(i) = factorial(i)*a(i)
         weights(i) = power*inverse_factorial(i)
         power = power*s
      end do
      derivatives(degree + 1) = 0.0_wp
      weights(degree + 1) = 0.0_wp
      power = 1.0_wp
      do i = 0, min(degree, ubound(b, 1))
         even = 0.0_wp
         odd = 0.0_wp
         do j = 0, degree - i, 2
            even = even + derivatives(i + j)*weights(j)
            odd = odd + derivatives(i + j + 1)*weights(j + 1)
         end do
         b(i) = power*inverse_factorial(i)*(even + odd)
         power = power*unit
      end do
   end subroutine shift

   !> Value of p at s, and its derivative by s.
   pure subroutine newton_state(nodes, coefficients, s, value, slope)
      !> Nodes x(1..degree) of the method
      real(wp), intent(in) :: nodes(:)
      !> Coefficients a(0..degree)
      real(wp), intent(in) :: coefficients(0:)
      !> Place in the step, 0..1
      real(wp), intent(in) :: s
      !> The value
      real(wp), intent(out) :: value
      !> The derivative
      real(wp), intent(out) :: slope
      integer :: j

      value = coefficients(size(nodes))
      slope = 0.0_wp
      do j = size(nodes), 1, -1
         slope = value + (s - nodes(j))*slope
         value = coefficients(j - 1) + (s - nodes(j))*value
      end do
   end subroutine newton_state
end module dde_interpolant
