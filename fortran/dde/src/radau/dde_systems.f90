!> The linear systems (shift - J) x = b of an implicit step, where J is the Jacobian. dde_linear
!> solves small dense systems, LAPACK solves large dense and banded ones. Real and complex systems
!> have one body in two files that are included.
module dde_systems
   use dde_jacobian, only: jacobian_type
   use dde_lapack, only: gbtrf, gbtrs, getrf, getrs, lapack_is_there
   use dde_linear, only: factorise, solve
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: complex_over_real, complex_system, factor_operations, real_system

   !> LAPACK is faster than dde_linear from this number of equations on.
   integer, parameter :: large = 48
   !> Operations of a complex multiplication over those of a real one.
   real(wp), parameter :: complex_over_real = 4.0_wp

   !> What real and complex systems have in common.
   type :: linear_system
      !> Rows exchanged, shape (n)
      integer, allocatable, private :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, allocatable, dimension(:), private :: first, last
      !> Factor of each equation that makes its largest coefficient 1, shape (n). Otherwise a stiff
      !> equation would be the pivot for the others.
      real(wp), allocatable, private :: row(:)
      !> Whether the Jacobian is banded, its diagonals below and above the main one
      logical, private :: banded = .false.
      integer, private :: lower = 0, upper = 0
      !> Additions and multiplications of a factorisation and of a solution
      real(wp) :: factor_operations = 0.0_wp, solve_operations = 0.0_wp
   end type linear_system

   !> A system with a real shift.
   type, extends(linear_system) :: real_system
      !> Factors, shape (n, n) or (1 + 2 lower + upper, n)
      real(wp), allocatable, private :: a(:, :)
   contains
      procedure :: prepare => prepare_real
      procedure :: solve => solve_real
   end type real_system

   !> A system with a complex shift.
   type, extends(linear_system) :: complex_system
      !> Factors, shape (n, n) or (1 + 2 lower + upper, n)
      complex(wp), allocatable, private :: a(:, :)
   contains
      procedure :: prepare => prepare_complex
      procedure :: solve => solve_complex
   end type complex_system

contains

   !> Factorise shift - J.
   pure subroutine prepare_real(self, jacobian, shift, singular)
      class(real_system), intent(inout) :: self
      real(wp), intent(in) :: shift
      !> Operations of a multiplication
      real(wp), parameter :: cost = 1.0_wp
      include "prepare_system.inc"
   end subroutine prepare_real

   !> Replace a right-hand side by the solution.
   pure subroutine solve_real(self, b)
      class(real_system), intent(in) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), contiguous, intent(inout) :: b(:)
      include "solve_system.inc"
   end subroutine solve_real

   !> Factorise shift - J.
   pure subroutine prepare_complex(self, jacobian, shift, singular)
      class(complex_system), intent(inout) :: self
      complex(wp), intent(in) :: shift
      !> Operations of a multiplication
      real(wp), parameter :: cost = complex_over_real
      include "prepare_system.inc"
   end subroutine prepare_complex

   !> Replace a right-hand side by the solution.
   pure subroutine solve_complex(self, b)
      class(complex_system), intent(in) :: self
      complex(wp), contiguous, intent(inout) :: b(:)
      include "solve_system.inc"
   end subroutine solve_complex

   !> Additions and multiplications of a factorisation, in real numbers.
   pure real(wp) function factor_operations(n, banded, lower, upper) result(operations)
      !> Number of equations
      integer, intent(in) :: n
      !> Whether the matrix is banded
      logical, intent(in) :: banded
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper

      if (banded) then
         operations = 2.0_wp*n*lower*(lower + upper + 1)
      else
         operations = 2.0_wp/3.0_wp*real(n, wp)**3
      end if
   end function factor_operations
end module dde_systems
