!> Problems that depend on parameters.
module problem_family
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: problem_family_type

   !> Problems with the same number of equations and of delays, whose right-hand side does not
   !> depend on time. Here a delay may be 0.
   type, abstract :: problem_family_type
   contains
      !> The problem at parameters
      procedure(make_problem), deferred :: at
   end type problem_family_type

   abstract interface
      !> The problem at parameters.
      subroutine make_problem(self, parameters, problem)
         import :: dde_problem_type, problem_family_type, wp
         implicit none (type, external)
         !> The family
         class(problem_family_type), intent(in) :: self
         !> Parameters, in the order of the family
         real(wp), intent(in) :: parameters(:)
         !> The problem
         class(dde_problem_type), allocatable, intent(out) :: problem
      end subroutine make_problem
   end interface
end module problem_family
