!> The state of the block: where each quantity stands, as in spring_block.yaml.
module block_state
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: components_of_block, index_of_ln_v, index_of_theta, index_of_u

   !> Place of the friction state theta in the state vector.
   integer, parameter :: index_of_theta = 1
   !> Place of the displacement u.
   integer, parameter :: index_of_u = 2
   !> Place of w = ln v: in w no step can leave the domain v > 0.
   integer, parameter :: index_of_ln_v = 3
   !> Number of quantities of a block. Blocks of a chain stand one after another.
   integer, parameter :: components_of_block = 3
end module block_state
