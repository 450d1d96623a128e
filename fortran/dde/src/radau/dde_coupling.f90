!> Systems A x = r + sum over l of b_l q_l with few unknowns q_l = w_l x beside x: A is solved for r
!> and once for each b_l, and a small system for q is left (Woodbury's identity).
module dde_coupling
   use dde_linear, only: factorise, solve
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: coupling_type

   !> The coupling of one system.
   type :: coupling_type
      !> Weights w of x in each unknown, shape (size of x, unknowns)
      real(wp), allocatable :: weights(:, :)
      !> Solutions of A x = b, same shape
      real(wp), allocatable :: solutions(:, :)
      !> Factors of the system for q
      real(wp), allocatable, private :: factors(:, :)
      !> One over the largest element of each of its rows
      real(wp), allocatable, private :: row_scale(:)
      !> Rows exchanged
      integer, allocatable, private :: pivot(:)
      !> First and last row of each column of the factors that is not 0
      integer, allocatable, dimension(:), private :: first, last
      !> The unknowns
      real(wp), allocatable, private :: q(:)
   contains
      procedure :: clear, prepare, complete
   end type coupling_type

   interface coupling_type
      module procedure :: new_coupling
   end interface coupling_type

contains

   !> Storage.
   pure function new_coupling(n, unknowns) result(coupling)
      integer, intent(in) :: n, unknowns
      type(coupling_type) :: coupling

      allocate (coupling%weights(n, unknowns), coupling%solutions(n, unknowns))
      allocate (coupling%factors(unknowns, unknowns), coupling%pivot(unknowns))
      allocate (coupling%first(unknowns), coupling%last(unknowns))
      allocate (coupling%row_scale(unknowns), coupling%q(unknowns))
   end function new_coupling

   !> All weights and solutions are zero.
   pure subroutine clear(self)
      class(coupling_type), intent(inout) :: self

      self%weights = 0.0_wp
      self%solutions = 0.0_wp
   end subroutine clear

   !> Factorise 1 - w b, the matrix of the system for q.
   pure subroutine prepare(self, singular)
      class(coupling_type), intent(inout) :: self
      logical, intent(out) :: singular
      integer :: i, j

      do j = 1, size(self%pivot)
         do i = 1, size(self%pivot)
            self%factors(i, j) = -sum(self%weights(:, i)*self%solutions(:, j))
         end do
         self%factors(j, j) = 1.0_wp + self%factors(j, j)
      end do
      call factorise(self%factors, self%pivot, self%first, self%last, self%row_scale, singular)
   end subroutine prepare

   !> Replace the solution of A x = r by that with q.
   pure subroutine complete(self, x)
      class(coupling_type), intent(inout) :: self
      real(wp), intent(inout) :: x(size(self%weights, 1))
      integer :: i

      do i = 1, size(self%q)
         self%q(i) = sum(self%weights(:, i)*x)
      end do
      call solve(self%factors, self%pivot, self%first, self%last, self%q)
      do i = 1, size(self%q)
         x = x + self%q(i)*self%solutions(:, i)
      end do
   end subroutine complete
end module dde_coupling
