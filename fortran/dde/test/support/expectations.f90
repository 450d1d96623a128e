! SPDX-License-Identifier: BSD-3-Clause
!> What a test expects. The first expectation that fails is kept and told with its numbers; a value
!> that is not a number fails.
module expectations
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, test_failed
   implicit none (type, external)
   private
   public :: expect, expect_between, expect_close, expect_failure, expect_success

   !> A value, or each of several, is the known one within an absolute bound.
   interface expect_close
      module procedure :: expect_close_value
      module procedure :: expect_close_values
   end interface expect_close

contains

   !> A condition holds.
   subroutine expect(error, condition, what)
      type(error_type), allocatable, intent(inout) :: error
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (allocated(error) .or. condition) return
      call test_failed(error, "not so: "//what)
   end subroutine expect

   !> A value is the known one.
   subroutine expect_close_value(error, actual, known, within, what)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: actual, known, within
      character(len=*), intent(in) :: what

      if (allocated(error)) return
      if (abs(actual - known) <= within) return
      call test_failed(error, what//" is "//text(actual)//", known to be "//text(known) &
                       //"; difference "//text(actual - known)//", allowed "//text(within))
   end subroutine expect_close_value

   !> Values are the known ones.
   subroutine expect_close_values(error, actual, known, within, what)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: actual(:), known(:), within
      character(len=*), intent(in) :: what
      integer :: i

      call expect(error, size(actual) == size(known), what//" are "//text(size(known)))
      do i = 1, min(size(actual), size(known))
         call expect_close(error, actual(i), known(i), within, what//", number "//text(i)//",")
      end do
   end subroutine expect_close_values

   !> A value lies in an interval.
   subroutine expect_between(error, actual, least, most, what)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: actual, least, most
      character(len=*), intent(in) :: what

      if (allocated(error)) return
      if (actual >= least .and. actual <= most) return
      call test_failed(error, what//" is "//text(actual)//", not in "//text(least)//".." &
                       //text(most))
   end subroutine expect_between

   !> Nothing went wrong.
   subroutine expect_success(error, failure)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable, intent(in) :: failure

      if (allocated(error) .or. .not. allocated(failure)) return
      call test_failed(error, failure%message)
   end subroutine expect_success

   !> Something went wrong, and the message says these words.
   subroutine expect_failure(error, failure, words)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable, intent(in) :: failure
      character(len=*), intent(in) :: words

      if (allocated(error)) return
      if (.not. allocated(failure)) then
         call test_failed(error, "no error where one was expected to say '"//words//"'")
      else if (index(failure%message, words) == 0) then
         call test_failed(error, "the error does not say '"//words//"': "//failure%message)
      end if
   end subroutine expect_failure
end module expectations
