! SPDX-License-Identifier: BSD-3-Clause
!> Models whose right-hand side is written once, for complex numbers, and not by a definition. Their
!> derivatives are imaginary parts of f(x + i h) over h, without rounding; forms of any order come
!> from values on circles in the complex plane (Cauchy's integral).
module analytic_models
   use dde_kinds, only: wp
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: analytic_model, h

   !> A model at rest where all states are 0.
   type, abstract, extends(model_type) :: analytic_model
   contains
      procedure(complex_slope), deferred :: slope
      procedure :: fill
      procedure :: put => put_numbers
      procedure :: rhs => real_slope
      procedure :: jacobian => imaginary_slopes
      procedure :: steady_state => state_at_rest
      procedure :: derivative => derivative_by_cauchy
   end type analytic_model

   abstract interface
      !> Right-hand side.
      pure function complex_slope(self, y, z) result(slope)
         import :: analytic_model, wp
         implicit none (type, external)
         class(analytic_model), intent(in) :: self
         !> State, delayed values
         complex(wp), intent(in) :: y(:), z(:)
         complex(wp) :: slope(size(y))
      end function complex_slope
   end interface

   !> The imaginary step.
   real(wp), parameter :: h = 1.0e-100_wp
   !> Points on a circle, and its radius in units of the argument.
   integer, parameter :: points = 64
   real(wp), parameter :: radius = 0.2_wp
   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

contains

   !> Fill what every model has.
   pure subroutine fill(self, past, lag, component)
      class(analytic_model), intent(inout) :: self
      !> States up to the initial time
      real(wp), intent(in) :: past(:)
      !> Delays, and numbers of the delayed states
      real(wp), intent(in) :: lag(:)
      integer, intent(in) :: component(:)

      self%n = size(past)
      self%past = past
      self%lag = lag
      self%component = component
   end subroutine fill

   !> Other parameters, on which no delay depends.
   pure subroutine put_numbers(self, parameters)
      class(analytic_model), intent(inout) :: self
      real(wp), intent(in) :: parameters(:)

      self%numbers = parameters
   end subroutine put_numbers

   !> Right-hand side of real numbers.
   pure subroutine real_slope(self, t, y, z, dydt)
      class(analytic_model), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = real(self%slope(cmplx(y, kind=wp), cmplx(z, kind=wp)))
   end subroutine real_slope

   !> Its derivatives.
   pure subroutine imaginary_slopes(self, t, y, z, by_y, by_z)
      class(analytic_model), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)
      integer :: i, j

      do j = 1, self%n
         by_y(:, j) = aimag(self%slope(cmplx(y, [(merge(h, 0.0_wp, i == j), i=1, self%n)], wp), &
                                       cmplx(z, kind=wp)))/h
      end do
      do j = 1, size(z)
         by_z(:, j) = aimag(self%slope(cmplx(y, kind=wp), &
                                       cmplx(z, [(merge(h, 0.0_wp, i == j), i=1, size(z))], wp)))/h
      end do
   end subroutine imaginary_slopes

   !> State at rest.
   pure function state_at_rest(self) result(state)
      class(analytic_model), intent(in) :: self
      real(wp) :: state(self%n)

      state = 0.0_wp
   end function state_at_rest

   !> The form of order k from the homogeneous part P_k of the right-hand side, by polarisation: the
   !> sum of (-1)^(k - |S|) P_k(sum of x_i over S) over all sets S of arguments.
   pure function derivative_by_cauchy(self, arguments) result(form)
      class(analytic_model), intent(in) :: self
      complex(wp), intent(in) :: arguments(:, :, :)
      complex(wp) :: form(size(arguments, 1))
      integer :: i, k, set

      k = size(arguments, 3)
      form = 0.0_wp
      do set = 1, 2**k - 1
         associate (members => pack([(i, i=1, k)], [(btest(set, i - 1), i=1, k)]))
            form = form + (-1)**(k - size(members)) &
                   *homogeneous_part(self, sum(arguments(:, :, members), dim=3), k)
         end associate
      end do
   end function derivative_by_cauchy

   !> The part of degree k.
   pure function homogeneous_part(model, x, k) result(part)
      class(analytic_model), intent(in) :: model
      !> Disturbances of the state and of the delayed states, shape (n, 1 + delayed states)
      complex(wp), intent(in) :: x(:, :)
      integer, intent(in) :: k
      complex(wp) :: part(size(x, 1))
      complex(wp) :: factor, z(size(x, 2) - 1)
      integer :: i, j

      part = 0.0_wp
      if (all(abs(x) <= 0.0_wp)) return
      z = [(x(model%component(j), j + 1), j=1, size(z))]
      do i = 1, points
         factor = radius/maxval(abs(x))*exp(cmplx(0.0_wp, two_pi*i/points, kind=wp))
         part = part + model%slope(factor*x(:, 1), factor*z)/factor**k/points
      end do
   end function homogeneous_part
end module analytic_models
