!> Blocks for tests from keywords; the history is steady sliding where a value is left out.
module block_builder
   use block_parameters, only: block_history_type, block_parameters_type
   use dde_kinds, only: wp
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: build_block

contains

   !> A block at these parameters from this history.
   type(spring_block_type) function build_block(tau, epsilon, xi, gamma, theta, u, v) &
      result(block)
      real(wp), intent(in) :: tau, epsilon, xi, gamma
      real(wp), intent(in), optional :: theta, u, v
      type(block_history_type) :: history

      if (present(theta)) history%theta = theta
      if (present(u)) history%u = u
      if (present(v)) history%v = v
      block = spring_block_type(block_parameters_type(tau=tau, epsilon=epsilon, xi=xi, &
                                                      gamma=gamma), history)
   end function build_block
end module block_builder
