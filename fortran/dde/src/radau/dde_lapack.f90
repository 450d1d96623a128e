!> Replaces lapack/dde_lapack.f90 in a build without LAPACK or in quadruple precision. Nothing here
!> is called, since `lapack_is_there` is false.
module dde_lapack
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: factorise_by_lapack, factorise_band, lapack_is_there, solve_band, solve_by_lapack

   !> Whether the procedures of this module work.
   logical, parameter :: lapack_is_there = .false.

   !> Replace a matrix by its factors.
   interface factorise_by_lapack
      module procedure :: factorise_real, factorise_complex
   end interface factorise_by_lapack

   !> Replace a right-hand side by the solution.
   interface solve_by_lapack
      module procedure :: solve_real, solve_complex
   end interface solve_by_lapack

   !> Replace a banded matrix by its factors.
   interface factorise_band
      module procedure :: factorise_real_band, factorise_complex_band
   end interface factorise_band

   !> Replace a right-hand side by the solution of a banded system.
   interface solve_band
      module procedure :: solve_real_band, solve_complex_band
   end interface solve_band

contains

   !> No factors.
   pure subroutine factorise_real(a, pivot, singular)
      !> Matrix
      real(wp), intent(inout) :: a(:, :)
      !> Rows exchanged
      integer, intent(out) :: pivot(:)
      !> Always
      logical, intent(out) :: singular

      singular = .true.
      pivot = 0
   end subroutine factorise_real

   !> No solution.
   pure subroutine solve_real(a, pivot, b)
      !> Factors
      real(wp), intent(in) :: a(:, :)
      !> Rows exchanged
      integer, intent(in) :: pivot(:)
      !> Right-hand side
      real(wp), intent(inout) :: b(:)
   end subroutine solve_real

   !> No factors.
   pure subroutine factorise_real_band(lower, upper, a, pivot, singular)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Matrix
      real(wp), intent(inout) :: a(:, :)
      !> Rows exchanged
      integer, intent(out) :: pivot(:)
      !> Always
      logical, intent(out) :: singular

      singular = .true.
      pivot = 0
   end subroutine factorise_real_band

   !> No solution.
   pure subroutine solve_real_band(lower, upper, a, pivot, b)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Factors
      real(wp), intent(in) :: a(:, :)
      !> Rows exchanged
      integer, intent(in) :: pivot(:)
      !> Right-hand side
      real(wp), intent(inout) :: b(:)
   end subroutine solve_real_band

   !> No factors.
   pure subroutine factorise_complex(a, pivot, singular)
      !> Matrix
      complex(wp), intent(inout) :: a(:, :)
      !> Rows exchanged
      integer, intent(out) :: pivot(:)
      !> Always
      logical, intent(out) :: singular

      singular = .true.
      pivot = 0
   end subroutine factorise_complex

   !> No solution.
   pure subroutine solve_complex(a, pivot, b)
      !> Factors
      complex(wp), intent(in) :: a(:, :)
      !> Rows exchanged
      integer, intent(in) :: pivot(:)
      !> Right-hand side
      complex(wp), intent(inout) :: b(:)
   end subroutine solve_complex

   !> No factors.
   pure subroutine factorise_complex_band(lower, upper, a, pivot, singular)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Matrix
      complex(wp), intent(inout) :: a(:, :)
      !> Rows exchanged
      integer, intent(out) :: pivot(:)
      !> Always
      logical, intent(out) :: singular

      singular = .true.
      pivot = 0
   end subroutine factorise_complex_band

   !> No solution.
   pure subroutine solve_complex_band(lower, upper, a, pivot, b)
      !> Diagonals below the main one
      integer, intent(in) :: lower
      !> Diagonals above it
      integer, intent(in) :: upper
      !> Factors
      complex(wp), intent(in) :: a(:, :)
      !> Rows exchanged
      integer, intent(in) :: pivot(:)
      !> Right-hand side
      complex(wp), intent(inout) :: b(:)
   end subroutine solve_complex_band
end module dde_lapack
