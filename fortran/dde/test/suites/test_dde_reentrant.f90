! SPDX-License-Identifier: BSD-3-Clause
!> Integrations side by side give the same bits as one after the other.
module test_dde_reentrant
   use dde, only: dde_problem_type, integrate, integration_result, table_sampler
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_success
   use fast_problems, only: follower
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   !$ use omp_lib, only: omp_get_num_threads
   use published_problems, only: infection, mackey_glass
   use solving, only: at_tolerance
   use test_problems, only: sine
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_reentrant

   !> Number of integrations, and of samples of each.
   integer, parameter :: runs = 64, samples = 5
   !> End of each integration.
   real(wp), parameter :: t_end = 100.0_wp

   !> One integration.
   type :: run_type
      !> The problem
      class(dde_problem_type), allocatable :: problem
      !> What was done
      type(integration_result) :: outcome
      !> Samples of component 1
      type(table_sampler) :: table
      !> What went wrong
      type(failure_type), allocatable :: failure
   end type run_type

contains

   subroutine collect_dde_reentrant(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("in threads", test_threads)]
   end subroutine collect_dde_reentrant

   !> Sixty-four integrations in four threads, twice over.
   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      type(run_type) :: alone(runs), together(runs)
      integer :: i, round, threads

      do i = 1, runs
         call prepare(i, alone(i))
         call integrate_one(alone(i))
         call expect_success(error, alone(i)%failure)
      end do
      do round = 1, 2
         do i = 1, runs
            call prepare(i, together(i))
         end do
         threads = 0
         !$omp parallel do num_threads(4) schedule(dynamic, 1) reduction(max: threads)
         do i = 1, runs
            !$ threads = omp_get_num_threads()
            call integrate_one(together(i))
         end do
         !$omp end parallel do
         !$ call expect(error, threads > 1, "more than one thread")
         do i = 1, runs
            call expect_same(error, together(i), alone(i), "integration "//text(i))
         end do
      end do
   end subroutine test_threads

   !> Integration number i.
   subroutine prepare(i, run)
      integer, intent(in) :: i
      type(run_type), intent(out) :: run
      real(wp) :: x
      integer :: k

      x = 1.0_wp + 0.01_wp*i
      select case (modulo(i, 5))
      case (0)
         allocate (run%problem, source=sine())
      case (1)
         allocate (run%problem, source=follower(10.0_wp*x, start=2.0_wp))
      case (2)
         allocate (run%problem, source=mackey_glass(past=[x], first=[x]))
      case (3)
         allocate (run%problem, source=infection())
      case default
         allocate (run%problem, source=swing(x))
      end select
      run%table = table_sampler([1], [(t_end*k/samples, k=1, samples)])
   end subroutine prepare

   !> Integrate.
   subroutine integrate_one(one)
      type(run_type), intent(inout) :: one

      call integrate(one%problem, 0.0_wp, t_end, at_tolerance(1.0e-9_wp), one%outcome, &
                     one%failure, one%table)
   end subroutine integrate_one

   !> Two integrations did the same to the last bit.
   subroutine expect_same(error, one, other, what)
      type(error_type), allocatable, intent(inout) :: error
      type(run_type), intent(in) :: one, other
      character(len=*), intent(in) :: what

      call expect_success(error, one%failure)
      if (allocated(error)) return
      call expect(error, same_bits(one%outcome%y, other%outcome%y), what//": same state")
      call expect(error, same_bits(one%table%values(1, :), other%table%values(1, :)), &
                  what//": same samples")
      call expect(error, one%outcome%accepted == other%outcome%accepted .and. &
                  one%outcome%rejected == other%outcome%rejected .and. &
                  one%outcome%evaluations == other%outcome%evaluations, what//": same counts")
   end subroutine expect_same

   !> Whether the bits are the same.
   pure logical function same_bits(a, b) result(value)
      real(wp), intent(in) :: a(:), b(:)

      value = size(a) == size(b) .and. all(transfer(a, [0_int64]) == transfer(b, [0_int64]))
   end function same_bits
end module test_dde_reentrant
