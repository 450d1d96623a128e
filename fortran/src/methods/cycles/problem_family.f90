!> Problems that depend on parameters.
module problem_family
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: free_family_type, problem_family_type

   !> Problems with the same number of equations and of delays, whose right-hand side does not
   !> depend on time. Here a delay may be 0.
   type, abstract :: problem_family_type
   contains
      !> The problem at parameters
      procedure(make_problem), deferred :: at
   end type problem_family_type

   !> Problems and those of their parameters that may vary.
   type :: free_family_type
      !> The problems
      class(problem_family_type), allocatable :: problems
      !> Numbers of the free parameters in the family
      integer, allocatable :: free(:)
      !> Unit of each, > 0
      real(wp), allocatable :: unit(:)
   end type free_family_type

   interface free_family_type
      module procedure :: new_free_family
   end interface free_family_type

   abstract interface
      !> The problem at parameters.
      subroutine make_problem(self, parameters, problem)
         import :: dde_problem_type, problem_family_type, wp
         implicit none (type, external)
         class(problem_family_type), intent(in) :: self
         real(wp), intent(in) :: parameters(:)
         class(dde_problem_type), allocatable, intent(out) :: problem
      end subroutine make_problem
   end interface

contains

   !> Problems with free parameters. gfortran 12 cannot compile the structure constructor.
   function new_free_family(problems, free, unit) result(family)
      class(problem_family_type), intent(in) :: problems
      integer, intent(in) :: free(:)
      !> Unit of each, > 0
      real(wp), intent(in) :: unit(:)
      type(free_family_type) :: family

      allocate (family%problems, source=problems)
      family%free = free
      family%unit = unit
   end function new_free_family
end module problem_family
