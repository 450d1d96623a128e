!> The block without its slow series.
module plain_blocks
   use dde_kinds, only: wp
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: plain_block

   !> A block whose w has no known rate of relaxation.
   type, extends(spring_block_type) :: plain_block
   contains
      procedure :: relaxation_rate => no_rate
   end type plain_block

contains

   !> No rate is known.
   pure function no_rate(self, t, y) result(rate)
      class(plain_block), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = 0.0_wp
   end function no_rate
end module plain_blocks
