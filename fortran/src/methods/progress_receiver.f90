! SPDX-License-Identifier: BSD-3-Clause
!> Receiver of the progress of long work.
module progress_receiver
   implicit none (type, external)
   private
   public :: progress_receiver_type

   !> Receiver of progress.
   type, abstract :: progress_receiver_type
   contains
      !> Receive how much is done
      procedure(take_progress), deferred :: advance
   end type progress_receiver_type

   abstract interface
      !> Receive how much is done. The work may call it often, from one thread at a time.
      subroutine take_progress(self, done, total)
         import :: progress_receiver_type
         implicit none (type, external)
         class(progress_receiver_type), intent(inout) :: self
         !> Number of pieces done, 0..total; number of pieces in all, at least 1
         integer, intent(in) :: done, total
      end subroutine take_progress
   end interface
end module progress_receiver
