!> The state of the block: where each quantity stands, and what the equations take.
module block_state
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: index_of_ln_v, index_of_theta, index_of_u, largest_ln_v, least_ln_v

   !> Place of the friction state theta in the state vector.
   integer, parameter :: index_of_theta = 1
   !> Place of the displacement u.
   integer, parameter :: index_of_u = 2
   !> Place of w = ln v: in w no step can leave the domain v > 0.
   integer, parameter :: index_of_ln_v = 3

   !> Beyond these exp(w) or gamma^2 exp(-w), times the rest of (4), might overflow.
   real(wp), parameter :: least_ln_v = -600.0_wp, largest_ln_v = 300.0_wp
end module block_state
