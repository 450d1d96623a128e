! SPDX-License-Identifier: BSD-3-Clause
!> A receiver that keeps the progress reported to it.
module progress_recorder
   use expectations, only: expect
   use mctc_env_testing, only: error_type
   use progress_receiver, only: progress_receiver_type
   implicit none (type, external)
   private
   public :: expect_counted, recorder

   !> Reports, call by call.
   type, extends(progress_receiver_type) :: recorder
      !> Pieces done, and pieces in all
      integer, allocatable :: done(:), total(:)
   contains
      procedure :: advance
   end type recorder

contains

   !> Keep a report.
   subroutine advance(self, done, total)
      class(recorder), intent(inout) :: self
      integer, intent(in) :: done, total

      if (.not. allocated(self%done)) allocate (self%done(0), self%total(0))
      self%done = [self%done, done]
      self%total = [self%total, total]
   end subroutine advance

   !> The reports were 1, 2, ... of `total`.
   subroutine expect_counted(error, receiver, total)
      type(error_type), allocatable, intent(inout) :: error
      type(recorder), intent(in) :: receiver
      integer, intent(in) :: total
      integer :: i

      call expect(error, size(receiver%done) == total, "as many calls as pieces")
      if (allocated(error)) return
      call expect(error, all(receiver%done == [(i, i=1, total)]), "piece by piece")
      call expect(error, all(receiver%total == total), "the same total in each call")
   end subroutine expect_counted
end module progress_recorder
