! SPDX-License-Identifier: BSD-3-Clause
!> Receiver of the progress of long work. This one tells nobody.
module progress_receiver
   implicit none (type, external)
   private
   public :: progress_receiver_type

   !> Receiver of the progress of work in one part, or in several of about the same length. The work
   !> may call it often, from one thread at a time.
   type :: progress_receiver_type
   contains
      procedure :: begin, begin_part, advance
   end type progress_receiver_type

contains

   !> Work begins now.
   subroutine begin(self, label, parts)
      class(progress_receiver_type), intent(inout) :: self
      !> What is being done
      character(len=*), intent(in) :: label
      !> Number of parts; one if it is left out
      integer, intent(in), optional :: parts
   end subroutine begin

   !> Another part begins.
   subroutine begin_part(self, part)
      class(progress_receiver_type), intent(inout) :: self
      !> Number of the part, from 1
      integer, intent(in) :: part
   end subroutine begin_part

   !> So much of a part is done.
   subroutine advance(self, done, total)
      class(progress_receiver_type), intent(inout) :: self
      !> Number of pieces done, 0..total; number of pieces in all, at least 1
      integer, intent(in) :: done, total
   end subroutine advance
end module progress_receiver
