!> Small dense linear systems by Gaussian elimination, real and complex. Each pivot is the largest
!> of its column relative to its row. Otherwise a row of huge numbers in a stiff system would be the
!> pivot for the others. LAPACK does not scale rows and is slower for a few equations (dde_systems).
!> Zeros at both ends of a column are left out: the Jacobian of a trajectory with tangent vectors
!> has blocks on its diagonal.
module dde_linear
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: factorise, solve

   !> Replace a matrix by its factors.
   interface factorise
      module procedure :: factorise_real
      module procedure :: factorise_complex
   end interface factorise

   !> Replace a right-hand side by the solution.
   interface solve
      module procedure :: solve_real
      module procedure :: solve_complex
   end interface solve

   !> Size of a number: of a complex one the sum of its parts.
   interface size_of
      module procedure :: size_of_real
      module procedure :: size_of_complex
   end interface size_of

contains

   !> Factors of a real matrix.
   pure subroutine factorise_real(a, pivot, first, last, row_scale, singular)
      integer, intent(out) :: pivot(:)
      !> Matrix, replaced by its factors
      real(wp), intent(inout) :: a(size(pivot), size(pivot))
      real(wp) :: moved
      include "factorise.inc"
   end subroutine factorise_real

   !> Factors of a complex matrix.
   pure subroutine factorise_complex(a, pivot, first, last, row_scale, singular)
      integer, intent(out) :: pivot(:)
      complex(wp), intent(inout) :: a(size(pivot), size(pivot))
      complex(wp) :: moved
      include "factorise.inc"
   end subroutine factorise_complex

   !> Solution of a factorised real system.
   pure subroutine solve_real(a, pivot, first, last, b)
      integer, intent(in) :: pivot(:)
      real(wp), intent(in) :: a(size(pivot), size(pivot))
      !> Right-hand side, replaced by the solution
      real(wp), intent(inout) :: b(size(pivot))
      real(wp) :: moved
      include "solve.inc"
   end subroutine solve_real

   !> Solution of a factorised complex system.
   pure subroutine solve_complex(a, pivot, first, last, b)
      integer, intent(in) :: pivot(:)
      complex(wp), intent(in) :: a(size(pivot), size(pivot))
      complex(wp), intent(inout) :: b(size(pivot))
      complex(wp) :: moved
      include "solve.inc"
   end subroutine solve_complex

   !> Size of a real number.
   elemental real(wp) function size_of_real(x) result(value)
      real(wp), intent(in) :: x

      value = abs(x)
   end function size_of_real

   !> Size of a complex number.
   elemental real(wp) function size_of_complex(z) result(value)
      complex(wp), intent(in) :: z

      value = abs(real(z)) + abs(aimag(z))
   end function size_of_complex
end module dde_linear
