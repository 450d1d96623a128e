!> The state of the block: where each quantity stands, as in spring_block.yaml.
module block_state
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: index_of_ln_v, index_of_theta, index_of_u

   !> Place of the friction state theta in the state vector.
   integer, parameter :: index_of_theta = 1
   !> Place of the displacement u.
   integer, parameter :: index_of_u = 2
   !> Place of w = ln v: in w no step can leave the domain v > 0.
   integer, parameter :: index_of_ln_v = 3
end module block_state
