!> The linear systems (shift - J) x = b of an implicit step, where J is the Jacobian. dde_linear
!> solves small dense systems, LAPACK solves large dense and banded ones.
module dde_systems
   use dde_jacobian, only: jacobian_type
   use dde_lapack, only: factorise_band, factorise_by_lapack, lapack_is_there, solve_band, &
                         solve_by_lapack
   use dde_linear, only: factorise, solve
   use dde_row_scaling, only: scale_band, scale_rows
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: complex_over_real, complex_system, factor_operations, real_system

   !> LAPACK is faster than dde_linear from this number of equations on.
   integer, parameter :: large = 48
   !> Operations of a complex multiplication over those of a real one.
   real(wp), parameter :: complex_over_real = 4.0_wp

   !> A system with a real shift.
   type :: real_system
      private
      !> Factors, shape (n, n) or (1 + 2 lower + upper, n)
      real(wp), allocatable :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, allocatable :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, allocatable, dimension(:) :: first, last
      !> Factor of each equation that makes its largest coefficient 1, shape (n). Otherwise a stiff
      !> equation would be the pivot for the others.
      real(wp), allocatable :: row(:)
      !> Whether the Jacobian is banded, its diagonals below and above the main one
      logical :: banded = .false.
      integer :: lower = 0, upper = 0
      !> Additions and multiplications of a factorisation and of a solution
      real(wp), public :: factor_operations = 0.0_wp, solve_operations = 0.0_wp
   contains
      !> Factorise for a Jacobian
      procedure, public :: prepare => prepare_real
      !> Replace a right-hand side by the solution
      procedure, public :: solve => solve_real
   end type real_system

   !> A system with a complex shift.
   type :: complex_system
      private
      !> Factors, shape (n, n) or (1 + 2 lower + upper, n)
      complex(wp), allocatable :: a(:, :)
      !> Rows exchanged, shape (n)
      integer, allocatable :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, allocatable, dimension(:) :: first, last
      !> Factor of each equation that makes its largest coefficient 1, shape (n). Otherwise a stiff
      !> equation would be the pivot for the others.
      real(wp), allocatable :: row(:)
      !> Whether the Jacobian is banded, its diagonals below and above the main one
      logical :: banded = .false.
      integer :: lower = 0, upper = 0
      !> Additions and multiplications of a factorisation and of a solution
      real(wp), public :: factor_operations = 0.0_wp, solve_operations = 0.0_wp
   contains
      !> Factorise for a Jacobian
      procedure, public :: prepare => prepare_complex
      !> Replace a right-hand side by the solution
      procedure, public :: solve => solve_complex
   end type complex_system

contains

   !> Factorise shift - J.
   pure subroutine prepare_real(self, jacobian, shift, singular)
      !> The system
      class(real_system), intent(inout) :: self
      !> J
      type(jacobian_type), intent(in) :: jacobian
      !> The shift
      real(wp), intent(in) :: shift
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      integer :: diagonal, j, n

      n = size(jacobian%by_y, 2)
      self%banded = jacobian%banded
      self%lower = jacobian%lower
      self%upper = jacobian%upper
      if (.not. allocated(self%a)) then
         allocate (self%a(merge(1 + 2*self%lower + self%upper, n, self%banded), n))
         allocate (self%pivot(n), self%first(n), self%last(n), self%row(n))
         self%factor_operations = factor_operations(n, self%banded, self%lower, self%upper)
         self%solve_operations = 2.0_wp*size(self%a)
      end if
      if (self%banded) then
         diagonal = 1 + self%lower + self%upper
         self%a(self%lower + 1:, :) = -jacobian%by_y
         self%a(diagonal, :) = self%a(diagonal, :) + shift
         call scale_band(self%lower, self%upper, self%a, self%row)
         call factorise_band(self%lower, self%upper, self%a, self%pivot, singular)
         return
      end if
      self%a = -jacobian%by_y
      do j = 1, n
         self%a(j, j) = self%a(j, j) + shift
      end do
      if (lapack_is_there .and. n >= large) then
         call scale_rows(self%a, self%row)
         call factorise_by_lapack(self%a, self%pivot, singular)
      else
         call factorise(self%a, self%pivot, self%first, self%last, self%row, singular)
      end if
   end subroutine prepare_real

   !> Replace a right-hand side by the solution.
   pure subroutine solve_real(self, b)
      !> The system, factorised
      class(real_system), intent(in) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), contiguous, intent(inout) :: b(:)

      if (self%banded) then
         b = self%row*b
         call solve_band(self%lower, self%upper, self%a, self%pivot, b)
      else if (lapack_is_there .and. size(b) >= large) then
         b = self%row*b
         call solve_by_lapack(self%a, self%pivot, b)
      else
         call solve(self%a, self%pivot, self%first, self%last, b)
      end if
   end subroutine solve_real

   !> Factorise shift - J.
   pure subroutine prepare_complex(self, jacobian, shift, singular)
      !> The system
      class(complex_system), intent(inout) :: self
      !> J
      type(jacobian_type), intent(in) :: jacobian
      !> The shift
      complex(wp), intent(in) :: shift
      !> Whether a pivot vanished
      logical, intent(out) :: singular
      integer :: diagonal, j, n

      n = size(jacobian%by_y, 2)
      self%banded = jacobian%banded
      self%lower = jacobian%lower
      self%upper = jacobian%upper
      if (.not. allocated(self%a)) then
         allocate (self%a(merge(1 + 2*self%lower + self%upper, n, self%banded), n))
         allocate (self%pivot(n), self%first(n), self%last(n), self%row(n))
         self%factor_operations = complex_over_real &
                                  *factor_operations(n, self%banded, self%lower, self%upper)
         self%solve_operations = complex_over_real*2.0_wp*size(self%a)
      end if
      if (self%banded) then
         diagonal = 1 + self%lower + self%upper
         self%a(self%lower + 1:, :) = -jacobian%by_y
         self%a(diagonal, :) = self%a(diagonal, :) + shift
         call scale_band(self%lower, self%upper, self%a, self%row)
         call factorise_band(self%lower, self%upper, self%a, self%pivot, singular)
         return
      end if
      self%a = -jacobian%by_y
      do j = 1, n
         self%a(j, j) = self%a(j, j) + shift
      end do
      if (lapack_is_there .and. n >= large) then
         call scale_rows(self%a, self%row)
         call factorise_by_lapack(self%a, self%pivot, singular)
      else
         call factorise(self%a, self%pivot, self%first, self%last, self%row, singular)
      end if
   end subroutine prepare_complex

   !> Replace a right-hand side by the solution.
   pure subroutine solve_complex(self, b)
      !> The system, factorised
      class(complex_system), intent(in) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      complex(wp), contiguous, intent(inout) :: b(:)

      if (self%banded) then
         b = self%row*b
         call solve_band(self%lower, self%upper, self%a, self%pivot, b)
      else if (lapack_is_there .and. size(b) >= large) then
         b = self%row*b
         call solve_by_lapack(self%a, self%pivot, b)
      else
         call solve(self%a, self%pivot, self%first, self%last, b)
      end if
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
