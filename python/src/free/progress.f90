! SPDX-License-Identifier: BSD-3-Clause
!> Progress of long work, of which nobody is told: a library writes nothing.
module progress
   use progress_receiver, only: progress_receiver_type
   implicit none (type, external)
   private
   public :: progress_type

   !> Progress of work in one part, or in several.
   type, extends(progress_receiver_type) :: progress_type
   contains
      procedure :: advance, begin_part
   end type progress_type

   interface progress_type
      module procedure :: new_progress
   end interface progress_type

contains

   !> Progress of work that begins now.
   type(progress_type) function new_progress(label, parts) result(report)
      character(len=*), intent(in) :: label
      integer, intent(in), optional :: parts

      report = progress_type()
   end function new_progress

   !> Begin another part.
   subroutine begin_part(self, part)
      class(progress_type), intent(inout) :: self
      integer, intent(in) :: part
   end subroutine begin_part

   !> Report how much of a part is done.
   subroutine advance(self, done, total)
      class(progress_type), intent(inout) :: self
      integer, intent(in) :: done, total
   end subroutine advance
end module progress
