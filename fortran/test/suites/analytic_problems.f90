!> Problems whose right-hand side is written once, for complex numbers. Their derivatives are the
!> imaginary parts of f(x + i h) over h, without rounding.
module analytic_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past
   implicit none (type, external)
   private
   public :: analytic_problem, h

   !> A problem with a constant past.
   type, abstract, extends(constant_past) :: analytic_problem
   contains
      procedure(complex_slope), deferred :: slope
      procedure :: rhs => real_slope
      procedure :: jacobian
   end type analytic_problem

   abstract interface
      !> Right-hand side.
      pure function complex_slope(self, y, z) result(slope)
         import :: analytic_problem, wp
         implicit none (type, external)
         class(analytic_problem), intent(in) :: self
         complex(wp), intent(in) :: y(:), z(:)
         complex(wp) :: slope(size(y))
      end function complex_slope
   end interface

   !> The imaginary step.
   real(wp), parameter :: h = 1.0e-100_wp

contains

   !> Right-hand side of real numbers.
   pure subroutine real_slope(self, t, y, z, dydt)
      class(analytic_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = real(self%slope(cmplx(y, kind=wp), cmplx(z, kind=wp)))
   end subroutine real_slope

   !> Its derivatives.
   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(analytic_problem), intent(in) :: self
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
   end subroutine jacobian
end module analytic_problems
