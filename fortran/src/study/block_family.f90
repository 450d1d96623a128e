!> The block as a family of problems with the parameters of its law.
module block_family
   use block_parameters, only: block_history_type, block_parameters_type, vector_of, with_vector
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   use problem_family, only: problem_family_type
   use spring_block, only: spring_block_type, transverse_block
   implicit none (type, external)
   private
   public :: along_epsilon, along_gamma, along_tau, along_xi, block_family_type, &
             transverse_family_type, vector_of, with_vector

   !> Numbers of the block's parameters in the family; the law's own ones follow.
   integer, parameter :: along_tau = 1, along_epsilon = 2, along_xi = 3, along_gamma = 4

   !> The block; parameters in the order of the law's definition.
   type, extends(problem_family_type) :: block_family_type
      !> The law
      type(block_parameters_type) :: law
   contains
      procedure :: at => block_at
   end type block_family_type

   !> The block, of which disturbances are those of a mode of a chain (`transverse_block`): about a
   !> cycle of the block it gives the multipliers of the mode, but it is of no use to find cycles.
   type, extends(block_family_type) :: transverse_family_type
      !> kappa times the eigenvalue of the mode, s - 1
      real(wp) :: stiffening = 0.0_wp
   contains
      procedure :: at => transverse_at
   end type transverse_family_type

contains

   !> The block at parameters. A delay of 0 remains a delay.
   subroutine block_at(self, parameters, problem)
      class(block_family_type), intent(in) :: self
      !> Parameters by number
      real(wp), intent(in) :: parameters(:)
      class(dde_problem_type), allocatable, intent(out) :: problem

      allocate (problem, source=spring_block_type(with_vector(self%law, parameters), &
                                                  block_history_type(), keep_delays=.true.))
   end subroutine block_at

   !> The block at parameters, with disturbances of the mode.
   subroutine transverse_at(self, parameters, problem)
      class(transverse_family_type), intent(in) :: self
      !> Parameters by number
      real(wp), intent(in) :: parameters(:)
      class(dde_problem_type), allocatable, intent(out) :: problem

      allocate (problem, source=transverse_block(with_vector(self%law, parameters), &
                                                 block_history_type(), self%stiffening, &
                                                 keep_delays=.true.))
   end subroutine transverse_at
end module block_family
