! SPDX-License-Identifier: BSD-3-Clause
!> Functions of nilpotent numbers, each from its derivatives at the number without units.
module nilpotent_functions
   use dde_kinds, only: wp
   use nilpotent_numbers, only: composed, disturbed, most_units, nilpotent_type, operator(**), &
                                operator(/)
   implicit none (type, external)
   private
   public :: acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, erf, exp, log, sin, sinh, &
             sqrt, tan, tanh, within

   !> m! of each order m; i is only that of the list.
   integer :: i
   real(wp), parameter :: factorial(0:most_units) = [(gamma(i + 1.0_wp), i=0, most_units)]

   interface exp
      module procedure :: exponential
   end interface exp
   interface log
      module procedure :: logarithm
   end interface log
   interface sqrt
      module procedure :: square_root
   end interface sqrt
   interface sin
      module procedure :: sine
   end interface sin
   interface cos
      module procedure :: cosine
   end interface cos
   interface tan
      module procedure :: tangent
   end interface tan
   interface sinh
      module procedure :: hyperbolic_sine
   end interface sinh
   interface cosh
      module procedure :: hyperbolic_cosine
   end interface cosh
   interface tanh
      module procedure :: hyperbolic_tangent
   end interface tanh
   interface asin
      module procedure :: arc_sine
   end interface asin
   interface acos
      module procedure :: arc_cosine
   end interface acos
   interface atan
      module procedure :: arc_tangent
   end interface atan
   interface asinh
      module procedure :: area_sine
   end interface asinh
   interface acosh
      module procedure :: area_cosine
   end interface acosh
   interface atanh
      module procedure :: area_tangent
   end interface atanh
   interface atan2
      module procedure :: angle, angle_of_real, angle_over_real
   end interface atan2
   interface erf
      module procedure :: error_function
   end interface erf
   interface within
      module procedure :: within_bound
   end interface within

contains

   !> A number whose real part is no larger in size than a bound, with its disturbances.
   pure type(nilpotent_type) function within_bound(a, bound) result(c)
      type(nilpotent_type), intent(in) :: a
      real(wp), intent(in) :: bound

      c = a
      if (abs(a%a(0)%re) > bound) c%a(0) = sign(bound, a%a(0)%re)
   end function within_bound

   pure type(nilpotent_type) function square_root(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = a**0.5_wp
   end function square_root

   pure type(nilpotent_type) function exponential(a) result(c)
      type(nilpotent_type), intent(in) :: a
      complex(wp) :: slopes(0:most_units)

      slopes = exp(a%a(0))
      c = composed(a, slopes)
   end function exponential

   pure type(nilpotent_type) function logarithm(a) result(c)
      type(nilpotent_type), intent(in) :: a
      complex(wp) :: slopes(0:most_units)
      integer :: m

      slopes(0) = log(a%a(0))
      slopes(1) = 1.0_wp/a%a(0)
      do m = 2, most_units
         slopes(m) = -(m - 1)*slopes(m - 1)/a%a(0)
      end do
      c = composed(a, slopes)
   end function logarithm

   pure type(nilpotent_type) function sine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, waves(sin(a%a(0)), cos(a%a(0)), -1))
   end function sine

   pure type(nilpotent_type) function cosine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, waves(cos(a%a(0)), -sin(a%a(0)), -1))
   end function cosine

   pure type(nilpotent_type) function hyperbolic_sine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, waves(sinh(a%a(0)), cosh(a%a(0)), 1))
   end function hyperbolic_sine

   pure type(nilpotent_type) function hyperbolic_cosine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, waves(cosh(a%a(0)), sinh(a%a(0)), 1))
   end function hyperbolic_cosine

   pure type(nilpotent_type) function tangent(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, squares(tan(a%a(0)), 1))
   end function tangent

   pure type(nilpotent_type) function hyperbolic_tangent(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, squares(tanh(a%a(0)), -1))
   end function hyperbolic_tangent

   pure type(nilpotent_type) function arc_sine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, inverses(asin(a%a(0)), a%a(0), 1, -1, -0.5_wp))
   end function arc_sine

   pure type(nilpotent_type) function arc_cosine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, -inverses(-acos(a%a(0)), a%a(0), 1, -1, -0.5_wp))
   end function arc_cosine

   pure type(nilpotent_type) function arc_tangent(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, inverses(atan(a%a(0)), a%a(0), 1, 1, -1.0_wp))
   end function arc_tangent

   pure type(nilpotent_type) function area_sine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, inverses(asinh(a%a(0)), a%a(0), 1, 1, -0.5_wp))
   end function area_sine

   pure type(nilpotent_type) function area_cosine(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, inverses(acosh(a%a(0)), a%a(0), -1, 1, -0.5_wp))
   end function area_cosine

   pure type(nilpotent_type) function area_tangent(a) result(c)
      type(nilpotent_type), intent(in) :: a

      c = composed(a, inverses(atanh(a%a(0)), a%a(0), 1, -1, -1.0_wp))
   end function area_tangent

   !> The angle of (x, y): the smaller of the two is divided by the other.
   pure type(nilpotent_type) function angle(y, x) result(c)
      type(nilpotent_type), intent(in) :: y, x

      if (abs(x%a(0)) > abs(y%a(0))) then
         c = arc_tangent(y/x)
      else
         c = arc_tangent(x/y)
         c%a = -c%a
      end if
      c%a(0) = atan2(y%a(0)%re, x%a(0)%re)
   end function angle

   pure type(nilpotent_type) function angle_of_real(y, x) result(c)
      real(wp), intent(in) :: y
      type(nilpotent_type), intent(in) :: x

      c = angle(disturbed(y, [complex(wp) ::]), x)
   end function angle_of_real

   pure type(nilpotent_type) function angle_over_real(y, x) result(c)
      type(nilpotent_type), intent(in) :: y
      real(wp), intent(in) :: x

      c = angle(y, disturbed(x, [complex(wp) ::]))
   end function angle_over_real

   !> f'' = -2 x f', and f^(m + 1) = -2 x f^(m) - 2 (m - 1) f^(m - 1).
   pure type(nilpotent_type) function error_function(a) result(c)
      type(nilpotent_type), intent(in) :: a
      complex(wp) :: slopes(0:most_units)
      integer :: m

      associate (x => a%a(0)%re)
         slopes(0) = erf(x)
         slopes(1) = 2.0_wp*exp(-x**2)/sqrt(acos(-1.0_wp))
         do m = 1, most_units - 1
            slopes(m + 1) = -2.0_wp*(x*slopes(m) + (m - 1)*slopes(m - 1))
         end do
      end associate
      c = composed(a, slopes)
   end function error_function

   !> Derivatives of a function with f'' = sign f.
   pure function waves(value, slope, sign) result(slopes)
      complex(wp), intent(in) :: value, slope
      integer, intent(in) :: sign
      complex(wp) :: slopes(0:most_units)
      integer :: m

      slopes(0) = value
      slopes(1) = slope
      do m = 2, most_units
         slopes(m) = sign*slopes(m - 2)
      end do
   end function waves

   !> Derivatives of a function with f' = 1 + sign f**2, from its Taylor coefficients.
   pure function squares(value, sign) result(slopes)
      complex(wp), intent(in) :: value
      integer, intent(in) :: sign
      complex(wp) :: slopes(0:most_units)
      integer :: m

      slopes(0) = value
      slopes(1) = 1.0_wp + sign*value**2
      do m = 1, most_units - 1
         slopes(m + 1) = sign*sum(slopes(:m)*slopes(m:0:-1))/(m + 1)
      end do
      slopes = slopes*factorial
   end function squares

   !> Derivatives of a function with f' = u**power, u = constant + sign x**2, from the Taylor
   !> coefficients g of f': m u_0 g_m = sum over 0 < j <= m of (power j - m + j) u_j g_(m-j).
   pure function inverses(value, x, constant, sign, power) result(slopes)
      complex(wp), intent(in) :: value, x
      integer, intent(in) :: constant, sign
      real(wp), intent(in) :: power
      complex(wp) :: slopes(0:most_units)
      complex(wp) :: g(0:most_units - 1), u(0:2)
      integer :: j, m

      u = [constant + sign*x**2, 2*sign*x, cmplx(sign, kind=wp)]
      g(0) = u(0)**power
      do m = 1, most_units - 1
         g(m) = sum([((power*j - m + j)*u(j)*g(m - j), j=1, min(m, 2))])/(m*u(0))
      end do
      slopes = [value, [(g(m)/(m + 1), m=0, most_units - 1)]]*factorial
   end function inverses
end module nilpotent_functions
