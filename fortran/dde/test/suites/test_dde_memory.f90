!> Runs that need more memory than there is end with an error.
module test_dde_memory
   use, intrinsic :: iso_c_binding, only: c_int, c_long
   use dde, only: integrate, integration_options, integration_result, out_of_memory
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_failure
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use test_problems, only: fill, linear
   use undelayed_problems, only: decay
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_dde_memory

   interface
      !> Let this process take this number of bytes more, or without limit if they are negative.
      integer(c_int) function limit_memory(more) result(done) bind(c)
         import :: c_int, c_long
         implicit none (type, external)
         !> Bytes
         integer(c_long), value :: more
      end function limit_memory
   end interface

contains

   !> All tests of this suite.
   subroutine collect_dde_memory(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("matrices", test_matrices), new_unittest("the past", test_past)]
   end subroutine collect_dde_memory

   !> Matrices of 2e6 rows take more bytes than a process can address.
   subroutine test_matrices(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      character(len=8), parameter :: methods(3) = [character(len=8) :: "radau5", "radau9", &
                                                   "radau13"]
      integer, parameter :: n = 2000000
      type(decay) :: problem
      integer :: i

      call fill(problem, n, spread(0.0_wp, 1, n), spread(0.0_wp, 1, n))
      do i = 1, size(methods)
         call integrate(problem, 0.0_wp, 1.0_wp, at_tolerance(1.0e-6_wp, methods(i)), outcome, &
                        failure)
         call expect_failure(error, failure, "no memory for another ")
         call expect(error, outcome%reason == out_of_memory, "the reason, of "//methods(i))
         call expect(error, .not. allocated(outcome%y), "no state of "//methods(i))
      end do
   end subroutine test_matrices

   !> The past doubles until there is no memory for it. The state of the last step is kept.
   subroutine test_past(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 64
      integer(c_long), parameter :: limit = 64*1024*1024_c_long
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(linear) :: problem
      integer :: i

      problem = linear(n, spread(1.0_wp, 1, n), [(i, i=1, n)], spread(0.0_wp, 1, n), &
                       spread(0.0_wp, 1, n))
      options = at_tolerance(1.0e-6_wp)
      options%longest_step = 1.0e-5_wp
      ! an address sanitizer cannot be limited
      if (limit_memory(limit) == 0) return
      call integrate(problem, 0.0_wp, 1.0_wp, options, outcome, failure)
      call expect(error, limit_memory(-1_c_long) == 1, "the limit is lifted")
      call expect_failure(error, failure, "no memory for another ")
      call expect(error, outcome%reason == out_of_memory, "the reason")
      call expect(error, outcome%t > 0.0_wp .and. size(outcome%y) == n, "the last step")
   end subroutine test_past
end module test_dde_memory
