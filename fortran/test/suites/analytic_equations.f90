!> Delay equations given by an analytic right-hand side alone. Its derivatives come from its values
!> on circles in the complex plane (Cauchy's integral), so that no derivative is written by hand.
module analytic_equations
   use delay_equation, only: delay_equation_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: analytic_equation_type, set_linear_part

   !> Points on a circle, and its radius in units of the argument.
   integer, parameter :: points = 64
   real(wp), parameter :: radius = 0.2_wp
   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

   !> An equation that is 0 at rest.
   type, abstract, extends(delay_equation_type) :: analytic_equation_type
   contains
      !> The right-hand side
      procedure(analytic_rhs), deferred :: rhs
      procedure :: derivative => derivative_by_cauchy
   end type analytic_equation_type

   abstract interface
      !> The right-hand side.
      pure function analytic_rhs(self, x) result(dxdt)
         import :: analytic_equation_type, wp
         implicit none (type, external)
         class(analytic_equation_type), intent(in) :: self
         !> State at all lags, shape (n, number of lags)
         complex(wp), intent(in) :: x(:, :)
         complex(wp) :: dxdt(size(x, 1))
      end function analytic_rhs
   end interface

contains

   !> The matrices A_j of n equations.
   subroutine set_linear_part(equation, n, lag)
      class(analytic_equation_type), intent(inout) :: equation
      integer, intent(in) :: n
      real(wp), intent(in) :: lag(:)
      complex(wp) :: unit_history(n, size(lag))
      integer :: i, j

      if (allocated(equation%linear%a)) deallocate (equation%linear%a)
      allocate (equation%linear%a(n, n, size(lag)))
      equation%linear%lag = lag
      do j = 1, size(lag)
         do i = 1, n
            unit_history = 0.0_wp
            unit_history(i, j) = 1.0_wp
            equation%linear%a(:, i, j) = real(homogeneous_part(equation, unit_history, 1))
         end do
      end do
   end subroutine set_linear_part

   !> The form of order k from the homogeneous part P_k of the right-hand side, by polarisation: the
   !> sum of (-1)^(k - |S|) P_k(sum of x_i over S) over all sets S of arguments.
   pure function derivative_by_cauchy(self, x) result(form)
      class(analytic_equation_type), intent(in) :: self
      complex(wp), intent(in) :: x(:, :, :)
      complex(wp) :: form(size(x, 1))
      integer :: i, k, set

      k = size(x, 3)
      form = 0.0_wp
      do set = 1, 2**k - 1
         associate (members => pack([(i, i=1, k)], [(btest(set, i - 1), i=1, k)]))
            form = form + (-1)**(k - size(members)) &
                   *homogeneous_part(self, sum(x(:, :, members), dim=3), k)
         end associate
      end do
   end function derivative_by_cauchy

   !> The part of degree k.
   pure function homogeneous_part(equation, x, k) result(part)
      class(analytic_equation_type), intent(in) :: equation
      complex(wp), intent(in) :: x(:, :)
      integer, intent(in) :: k
      complex(wp) :: part(size(x, 1))
      complex(wp) :: factor
      integer :: i

      part = 0.0_wp
      if (all(abs(x) <= 0.0_wp)) return
      do i = 1, points
         factor = radius/maxval(abs(x))*exp(cmplx(0.0_wp, two_pi*i/points, kind=wp))
         part = part + equation%rhs(factor*x)/factor**k/points
      end do
   end function homogeneous_part
end module analytic_equations
