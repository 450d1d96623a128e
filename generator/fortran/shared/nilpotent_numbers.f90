! SPDX-License-Identifier: BSD-3-Clause
!> Numbers a_0 + sum of a_S e_S over sets S of nilpotent units, e_i**2 = 0: in f(y + sum of x_i e_i)
!> the coefficient of the product of all units is the derivative form of f of arguments x_i. Sets
!> are written as bits: a_S is coefficient number S, the sum of 2**(i - 1) over the units in S.
module nilpotent_numbers
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: composed, disturbed, most_units, nilpotent_type, operator(*), operator(**), &
             operator(+), operator(-), operator(/), top

   !> Most units: the order of the highest derivative.
   integer, parameter :: most_units = 7
   !> Number of their sets, the empty one included.
   integer, parameter :: most = 2**most_units

   !> A number with units.
   type :: nilpotent_type
      !> Number of sets in use, a power of 2
      integer :: sets = 1
      !> Coefficients by set
      complex(wp) :: a(0:most - 1) = (0.0_wp, 0.0_wp)
   end type nilpotent_type

   interface operator(+)
      module procedure :: add, add_real, real_add
   end interface operator(+)
   interface operator(-)
      module procedure :: subtract, subtract_real, real_subtract, negate
   end interface operator(-)
   interface operator(*)
      module procedure :: multiply, multiply_real, real_multiply
   end interface operator(*)
   interface operator(/)
      module procedure :: divide, divide_real, real_divide
   end interface operator(/)
   interface operator(**)
      module procedure :: whole_power, real_power
   end interface operator(**)

contains

   !> A value with one unit for each disturbance.
   pure type(nilpotent_type) function disturbed(value, x) result(number)
      !> The value
      real(wp), intent(in) :: value
      !> Disturbances, at most `most_units`
      complex(wp), intent(in) :: x(:)
      integer :: i

      number%sets = 2**size(x)
      number%a(0) = value
      do i = 1, size(x)
         number%a(2**(i - 1)) = x(i)
      end do
   end function disturbed

   !> The coefficient of the product of all units.
   pure complex(wp) function top(number) result(value)
      !> The number
      type(nilpotent_type), intent(in) :: number

      value = number%a(number%sets - 1)
   end function top

   pure type(nilpotent_type) function add(a, b) result(c)
      type(nilpotent_type), intent(in) :: a, b

      c%sets = max(a%sets, b%sets)
      c%a(:c%sets - 1) = a%a(:c%sets - 1) + b%a(:c%sets - 1)
   end function add

   pure type(nilpotent_type) function add_real(a, b) result(c)
      type(nilpotent_type), intent(in) :: a
      real(wp), intent(in) :: b

      c = a
      c%a(0) = c%a(0) + b
   end function add_real

   pure type(nilpotent_type) function real_add(a, b) result(c)
      real(wp), intent(in) :: a
      type(nilpotent_type), intent(in) :: b

      c = add_real(b, a)
   end function real_add

   pure type(nilpotent_type) function negate(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = real_multiply(-1.0_wp, a)
   end function negate

   pure type(nilpotent_type) function subtract(a, b) result(c)
      type(nilpotent_type), intent(in) :: a, b

      c = add(a, negate(b))
   end function subtract

   pure type(nilpotent_type) function subtract_real(a, b) result(c)
      type(nilpotent_type), intent(in) :: a
      real(wp), intent(in) :: b

      c = add_real(a, -b)
   end function subtract_real

   pure type(nilpotent_type) function real_subtract(a, b) result(c)
      real(wp), intent(in) :: a
      type(nilpotent_type), intent(in) :: b

      c = add_real(negate(b), a)
   end function real_subtract

   !> Coefficient S of a product is the sum over all parts T of S of a_T b_(S without T).
   pure type(nilpotent_type) function multiply(a, b) result(c)
      type(nilpotent_type), intent(in) :: a, b
      integer :: set

      c%sets = max(a%sets, b%sets)
      do set = 0, c%sets - 1
         c%a(set) = sum_over_parts(a%a, b%a, set, 0)
      end do
   end function multiply

   pure type(nilpotent_type) function real_multiply(a, b) result(c)
      real(wp), intent(in) :: a
      type(nilpotent_type), intent(in) :: b

      c%sets = b%sets
      c%a(:c%sets - 1) = a*b%a(:c%sets - 1)
   end function real_multiply

   pure type(nilpotent_type) function multiply_real(a, b) result(c)
      type(nilpotent_type), intent(in) :: a
      real(wp), intent(in) :: b

      c = real_multiply(b, a)
   end function multiply_real

   pure type(nilpotent_type) function divide(a, b) result(c)
      type(nilpotent_type), intent(in) :: a, b

      c = multiply(a, whole_power(b, -1))
   end function divide

   pure type(nilpotent_type) function divide_real(a, b) result(c)
      type(nilpotent_type), intent(in) :: a
      real(wp), intent(in) :: b

      c = real_multiply(1.0_wp/b, a)
   end function divide_real

   pure type(nilpotent_type) function real_divide(a, b) result(c)
      real(wp), intent(in) :: a
      type(nilpotent_type), intent(in) :: b

      c = real_multiply(a, whole_power(b, -1))
   end function real_divide

   !> Powers with derivatives p (p - 1) .. a**(p - m).
   pure type(nilpotent_type) function whole_power(a, power) result(c)
      type(nilpotent_type), intent(in) :: a
      integer, intent(in) :: power
      complex(wp) :: slopes(0:most_units)
      integer :: m

      slopes(0) = 1.0_wp
      do m = 1, most_units
         slopes(m) = slopes(m - 1)*(power - m + 1)
      end do
      do m = 0, most_units
         ! 0**0 is 1 here, and no power of 0 is needed where its factor is 0
         if (power - m > 0 .or. abs(slopes(m)) > 0.0_wp) slopes(m) = slopes(m)*a%a(0)**(power - m)
      end do
      c = composed(a, slopes)
   end function whole_power

   pure type(nilpotent_type) function real_power(a, power) result(c)
      type(nilpotent_type), intent(in) :: a
      real(wp), intent(in) :: power
      complex(wp) :: slopes(0:most_units)
      integer :: m

      slopes(0) = a%a(0)**power
      do m = 1, most_units
         slopes(m) = slopes(m - 1)*(power - m + 1)/a%a(0)
      end do
      c = composed(a, slopes)
   end function real_power

   !> A function of a number, from its derivatives at a_0. Let F_m be derivative m of it, as a
   !> number. With the lowest unit i of S, F_m has the coefficient S that is the sum over all parts
   !> T of S that have i of a_T (F_(m + 1))_(S without T).
   pure type(nilpotent_type) function composed(a, slopes) result(c)
      type(nilpotent_type), intent(in) :: a
      !> Derivatives of orders 0 to `most_units` at a_0
      complex(wp), intent(in) :: slopes(0:)
      complex(wp) :: f(0:a%sets - 1, 0:most_units)
      integer :: m, set

      f(0, :) = slopes
      do set = 1, a%sets - 1
         do m = 0, most_units - popcnt(set)
            f(set, m) = sum_over_parts(a%a, f(:, m + 1), set, iand(set, -set))
         end do
      end do
      c%sets = a%sets
      c%a(:c%sets - 1) = f(:, 0)
   end function composed

   !> The sum of a_T b_(S without T) over the parts T of S that have some units.
   pure complex(wp) function sum_over_parts(a, b, set, units) result(total)
      complex(wp), intent(in) :: a(0:), b(0:)
      integer, intent(in) :: set, units
      integer :: part, rest

      total = 0.0_wp
      rest = ieor(set, units)
      part = rest
      do
         total = total + a(ior(part, units))*b(ieor(rest, part))
         if (part == 0) exit
         part = iand(part - 1, rest)
      end do
   end function sum_over_parts
end module nilpotent_numbers
