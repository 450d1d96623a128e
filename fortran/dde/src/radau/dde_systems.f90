!> The linear systems (shift - J) x = b of an implicit step, where J is the Jacobian. Real and
!> complex systems have one body in a file that is included.
module dde_systems
   use dde_jacobian, only: jacobian_type
   use dde_linear, only: factorise, matrix_layout, solve
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: complex_system, real_system

   !> What real and complex systems have in common.
   type :: linear_system
      !> Where the elements are
      type(matrix_layout) :: layout
      !> Row exchanged with each row, shape (n)
      integer, allocatable, private :: pivot(:)
      !> First and last row of each column of the factors that is not 0, shape (n)
      integer, allocatable, dimension(:), private :: first, last
      !> One over the largest coefficient of each equation, shape (n)
      real(wp), allocatable, private :: row_scale(:)
      !> Additions and multiplications of a factorisation and of a solution
      real(wp) :: factor_operations = 0.0_wp, solve_operations = 0.0_wp
   contains
      procedure, non_overridable :: column
   end type linear_system

   !> A system with a real shift.
   type, extends(linear_system) :: real_system
      !> Elements, then those of the factors
      real(wp), allocatable :: a(:)
   contains
      procedure, non_overridable :: reshape => reshape_real
      procedure, non_overridable :: fill => fill_real
      procedure, non_overridable :: factorise => factorise_system
      procedure, non_overridable :: prepare => prepare_real
      procedure, non_overridable :: solve => solve_real
   end type real_system

   !> A system with a complex shift.
   type, extends(linear_system) :: complex_system
      !> Elements, then those of the factors
      complex(wp), allocatable, private :: a(:)
   contains
      procedure, private, non_overridable :: reshape => reshape_complex
      procedure, private, non_overridable :: fill => fill_complex
      procedure, non_overridable :: prepare => prepare_complex
      procedure, non_overridable :: solve => solve_complex
   end type complex_system

contains

   !> Storage for a band of at least so many diagonals.
   pure subroutine reshape_real(self, n, lower, upper)
      class(real_system), intent(inout) :: self
      include "reshape_system.inc"
   end subroutine reshape_real

   !> Storage for a band of at least so many diagonals.
   pure subroutine reshape_complex(self, n, lower, upper)
      class(complex_system), intent(inout) :: self
      include "reshape_system.inc"
   end subroutine reshape_complex

   !> The matrix shift - J, whose band may be wider than that of J.
   pure subroutine fill_real(self, jacobian, shift)
      class(real_system), intent(inout) :: self
      real(wp), intent(in) :: shift
      include "fill_system.inc"
   end subroutine fill_real

   !> The matrix shift - J.
   pure subroutine fill_complex(self, jacobian, shift)
      class(complex_system), intent(inout) :: self
      complex(wp), intent(in) :: shift
      include "fill_system.inc"
   end subroutine fill_complex

   !> Factorise a matrix that is filled.
   pure subroutine factorise_system(self, singular)
      class(real_system), intent(inout) :: self
      !> Whether a pivot vanished
      logical, intent(out) :: singular

      call factorise(self%layout, self%a, self%pivot, self%first, self%last, self%row_scale, &
                     self%factor_operations, self%solve_operations, singular)
   end subroutine factorise_system

   !> Factorise shift - J.
   pure subroutine prepare_real(self, jacobian, shift, singular)
      class(real_system), intent(inout) :: self
      type(jacobian_type), intent(in) :: jacobian
      real(wp), intent(in) :: shift
      logical, intent(out) :: singular

      if (.not. allocated(self%a)) then
         call self%reshape(size(jacobian%by_y, 2), jacobian%lower, jacobian%upper)
      end if
      call self%fill(jacobian, shift)
      call self%factorise(singular)
   end subroutine prepare_real

   !> Factorise shift - J.
   pure subroutine prepare_complex(self, jacobian, shift, singular)
      class(complex_system), intent(inout) :: self
      type(jacobian_type), intent(in) :: jacobian
      complex(wp), intent(in) :: shift
      logical, intent(out) :: singular

      if (.not. allocated(self%a)) then
         call self%reshape(size(jacobian%by_y, 2), jacobian%lower, jacobian%upper)
      end if
      call self%fill(jacobian, shift)
      call factorise(self%layout, self%a, self%pivot, self%first, self%last, self%row_scale, &
                     self%factor_operations, self%solve_operations, singular)
   end subroutine prepare_complex

   !> Replace a right-hand side by the solution.
   pure subroutine solve_real(self, b)
      class(real_system), intent(in) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), intent(inout) :: b(self%layout%n)

      call solve(self%layout, self%a, self%pivot, self%first, self%last, b)
   end subroutine solve_real

   !> Replace a right-hand side by the solution.
   pure subroutine solve_complex(self, b)
      class(complex_system), intent(in) :: self
      complex(wp), intent(inout) :: b(self%layout%n)

      call solve(self%layout, self%a, self%pivot, self%first, self%last, b)
   end subroutine solve_complex

   !> Where a column is: its element i is number column + i.
   pure integer(int64) function column(self, j) result(at)
      class(linear_system), intent(in) :: self
      integer, intent(in) :: j

      at = self%layout%origin + j*self%layout%stride
   end function column
end module dde_systems
