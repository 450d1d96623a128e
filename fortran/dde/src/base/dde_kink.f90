! SPDX-License-Identifier: BSD-3-Clause
!> Kinks of a solution.
module dde_kink
   use dde_time, only: instant
   implicit none (type, external)
   private
   public :: kink_type

   !> A time where a derivative of the solution jumps.
   type :: kink_type
      !> When
      type(instant) :: at
      !> Passages through a delay since the first derivative jumped; -1 where the solution does
      integer :: passages = 0
      !> Passages since its cause, which is the initial time or a time that the user gave
      integer :: generation = 0
   contains
      procedure :: take_in
   end type kink_type

contains

   !> Take in another kink at the same time.
   pure subroutine take_in(self, other)
      class(kink_type), intent(inout) :: self
      type(kink_type), intent(in) :: other

      self%passages = min(self%passages, other%passages)
      self%generation = min(self%generation, other%generation)
   end subroutine take_in
end module dde_kink
