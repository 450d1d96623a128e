! SPDX-License-Identifier: BSD-3-Clause
!> Two rotating waves,
!>
!>     w z1' = z1 (alpha1 + p11 |z1|^2 + p12 |z2|^2) + k1 z1(t - lag),
!>     w z2' = z2 (alpha2 + p21 |z1|^2 + p22 |z2|^2) + k2 z2(t - lag),   w = 1 + b Re z1 + c Re z2,
!>
!> either with delay or with an uneven course w of time. alpha1 and alpha2 are such that the cycle
!> |z1| = 1, z2 = 0 has frequency omega1, and the disturbance z2 neither grows nor decays, with
!> frequency omega2: a torus point. The state y is
!>
!>     (x1 + kappa x3 (x2 + x3), x2, x3 + sigma y1 x2, x4 + x2),   z1 = x1 + i x2,   z2 = x3 + i x4,
!>
!> so that no term of the normal form is 0 or without influence.
module twin_waves
   use analytic_models, only: analytic_model, h
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: kappa, omega1, on_cycle, sigma, twin_waves_type

   complex(wp), parameter :: p11 = (-0.8_wp, 0.3_wp), p12 = (-0.5_wp, 0.7_wp), &
                             p21 = (-0.4_wp, -0.6_wp), k1 = (0.3_wp, 0.2_wp), &
                             k2 = (-0.25_wp, 0.1_wp)
   real(wp), parameter :: omega1 = 1.3_wp, lag = 2.1_wp, kappa = 0.6_wp, sigma = 0.7_wp
   real(wp), parameter :: b = 0.4_wp, c = 0.5_wp, imaginary_part_of_p22 = 0.4_wp

   !> The model; parameters: real part of p22, omega2.
   type, extends(analytic_model) :: twin_waves_type
      !> Whether there is the delay; otherwise time is uneven
      logical :: delayed = .false.
      !> k1, k2, exp(-i omega lag) of both, alpha1, alpha2
      complex(wp) :: k(2) = 0.0_wp, turned(2) = 0.0_wp, alpha(2) = 0.0_wp
      !> p22
      complex(wp) :: p22 = 0.0_wp
      !> omega2, b, c
      real(wp) :: omega2 = 0.0_wp, b = 0.0_wp, c = 0.0_wp
   contains
      procedure :: coefficient
      procedure :: put => put_waves
      procedure :: slope => slope_of
   end type twin_waves_type

contains

   !> Give the model its parameters.
   pure subroutine put_waves(self, parameters)
      class(twin_waves_type), intent(inout) :: self
      real(wp), intent(in) :: parameters(:)

      call self%fill(on_cycle(0.0_wp), spread(lag, 1, 4), [1, 2, 3, 4])
      self%numbers = parameters
      self%omega2 = parameters(2)
      self%p22 = cmplx(parameters(1), imaginary_part_of_p22, kind=wp)
      self%turned = exp(cmplx(0.0_wp, -lag*[omega1, self%omega2], kind=wp))
      self%k = merge([k1, k2], (0.0_wp, 0.0_wp), self%delayed)
      self%b = merge(0.0_wp, b, self%delayed)
      self%c = merge(0.0_wp, c, self%delayed)
      self%alpha = cmplx(0.0_wp, [omega1, self%omega2], kind=wp) - [p11, p21] - self%k*self%turned
   end subroutine put_waves

   !> Re d/T. While |z2|^2 = S is almost constant, so are R = |z1|^2 and the frequencies:
   !>
   !>     i omega1 = alpha1 + p11 R + p12 S + k1 exp(-i omega1 lag),
   !>     lambda   = alpha2 + p21 R + p22 S + k2 exp(-lambda lag)
   !>
   !> with the growth lambda of z2. Its derivative by S is d/T for z = z2; the mean of w is 1. It is
   !> divided by the mean of |q|^2 for this z.
   pure real(wp) function coefficient(self) result(value)
      class(twin_waves_type), intent(in) :: self
      integer, parameter :: places = 400
      complex(wp) :: by_lambda, by_omega, change(2), wave(2)
      real(wp) :: r_slope, square, w
      integer :: i, part

      ! i omega1' (1 + k1 lag exp(-i omega1 lag)) - p11 R' = p12, by Cramer's rule
      by_omega = (0.0_wp, 1.0_wp)*(1.0_wp + lag*self%k(1)*self%turned(1))
      r_slope = -aimag(conjg(by_omega)*p12)/aimag(conjg(by_omega)*p11)
      by_lambda = 1.0_wp + lag*self%k(2)*self%turned(2)
      square = 0.0_wp
      do i = 1, places
         wave = [exp(cmplx(0.0_wp, 2.0_wp*acos(-1.0_wp)*i/places, kind=wp)), (0.0_wp, 0.0_wp)]
         w = 1.0_wp + self%b*real(wave(1))
         do part = 1, 2
            ! real and imaginary part of q: z = 1/2 and -i/2; later by the integral of c Re z2
            change(2) = 0.5_wp*(0.0_wp, -1.0_wp)**(part - 1)
            change(1) = -(0.0_wp, omega1)*wave(1)/w &
                        *self%c*real(change(2)/(0.0_wp, 1.0_wp))/self%omega2
            square = square + w/places &
                     *sum((aimag(state_of(real_parts(wave) + (0.0_wp, h)*real_parts(change)))/h)**2)
         end do
      end do
      value = real((p21*r_slope + self%p22)/by_lambda)/square
   end function coefficient

   !> Real and imaginary parts of z1 and z2.
   pure function real_parts(wave) result(x)
      complex(wp), intent(in) :: wave(2)
      complex(wp) :: x(4)

      x = [real(wave(1)), aimag(wave(1)), real(wave(2)), aimag(wave(2))]
   end function real_parts

   !> The state by x.
   pure function state_of(x) result(y)
      complex(wp), intent(in) :: x(4)
      complex(wp) :: y(4)

      y = x
      y(1) = x(1) + kappa*x(3)*(x(2) + x(3))
      y(3) = x(3) + sigma*y(1)*x(2)
      y(4) = x(4) + x(2)
   end function state_of

   !> The state of the cycle where z1 has an angle.
   pure function on_cycle(angle) result(y)
      real(wp), intent(in) :: angle
      real(wp) :: y(4)

      y = real(state_of(real_parts([exp(cmplx(0.0_wp, angle, kind=wp)), (0.0_wp, 0.0_wp)])))
   end function on_cycle

   !> x by the state.
   pure function from_state(y) result(x)
      complex(wp), intent(in) :: y(4)
      complex(wp) :: x(4)

      x = y
      x(4) = y(4) - x(2)
      x(3) = y(3) - sigma*y(1)*y(2)
      x(1) = y(1) - kappa*x(3)*(x(2) + x(3))
   end function from_state

   !> Derivative of the state.
   pure function slope_of(self, y, z) result(slope)
      class(twin_waves_type), intent(in) :: self
      complex(wp), intent(in) :: y(:), z(:)
      complex(wp) :: slope(size(y))
      complex(wp) :: before(4), f(4), r, s, x(4)

      x = from_state(y)
      before = from_state(z)
      r = x(1)**2 + x(2)**2
      s = x(3)**2 + x(4)**2
      f(:2) = times(real(self%alpha(1)) + real(p11)*r + real(p12)*s, &
                    aimag(self%alpha(1)) + aimag(p11)*r + aimag(p12)*s, x(:2)) &
              + times(cmplx(real(self%k(1)), kind=wp), cmplx(aimag(self%k(1)), kind=wp), before(:2))
      f(3:) = times(real(self%alpha(2)) + real(p21)*r + real(self%p22)*s, &
                    aimag(self%alpha(2)) + aimag(p21)*r + aimag(self%p22)*s, x(3:)) &
              + times(cmplx(real(self%k(2)), kind=wp), cmplx(aimag(self%k(2)), kind=wp), before(3:))
      slope = f/(1.0_wp + self%b*x(1) + self%c*x(3))
      slope(1) = slope(1) + kappa*(slope(3)*(x(2) + x(3)) + x(3)*(slope(2) + slope(3)))
      slope(3) = slope(3) + sigma*(slope(1)*x(2) + y(1)*slope(2))
      slope(4) = slope(4) + slope(2)
   end function slope_of

   !> Product of complex numbers by real and imaginary parts, which may have imaginary steps.
   pure function times(real_part, imaginary_part, x) result(product)
      complex(wp), intent(in) :: real_part, imaginary_part, x(2)
      complex(wp) :: product(2)

      product = [real_part*x(1) - imaginary_part*x(2), real_part*x(2) + imaginary_part*x(1)]
   end function times
end module twin_waves
