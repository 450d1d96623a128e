!> Integrations side by side give the same bits as one after the other.
module test_dde_reentrant
   use dde, only: dde_problem_type, integrate, integration_result, sampler_type, table_sampler
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

   !> A sampler that integrates another problem at each sample it takes.
   type, extends(sampler_type) :: busy_sampler
      !> The other integration
      type(run_type) :: other
      !> Samples taken
      integer :: taken = 0
   contains
      procedure :: take => integrate_other
   end type busy_sampler

contains

   !> All tests of this suite.
   subroutine collect_dde_reentrant(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("in threads", test_threads), &
                   new_unittest("one inside the other", test_nested)]
   end subroutine collect_dde_reentrant

   !> Sixty-four integrations in four threads, twice over.
   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      type(run_type) :: alone(runs), together(runs)
      integer :: i, round, threads

      do i = 1, runs
         call prepare(i, alone(i))
         call perform(alone(i))
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
            call perform(together(i))
         end do
         !$omp end parallel do
         !$ call expect(error, threads > 1, "more than one thread")
         do i = 1, runs
            call expect_same(error, together(i), alone(i), "integration "//text(i))
         end do
      end do
   end subroutine test_threads

   !> A sampler that integrates while it is handed a sample disturbs nothing.
   subroutine test_nested(error)
      type(error_type), allocatable, intent(out) :: error
      type(busy_sampler) :: busy
      type(run_type) :: inner, outer, outer_alone

      call prepare(3, inner)
      call perform(inner)
      call prepare(2, outer_alone)
      call perform(outer_alone)
      call prepare(2, outer)
      busy%wanted = [1]
      busy%next = 10.0_wp
      call prepare(3, busy%other)
      call integrate(outer%problem, 0.0_wp, t_end, at_tolerance(1.0e-9_wp), outer%outcome, &
                     outer%failure, busy)
      call expect_success(error, outer%failure)
      call expect(error, busy%taken == 4, "four samples are taken")
      call expect_same(error, busy%other, inner, "the inner integration")
      call expect(error, same_bits(outer%outcome%y, outer_alone%outcome%y), &
                  "the outer integration gives the same bits")
   end subroutine test_nested

   !> Integrate another problem to its end.
   subroutine integrate_other(self, y)
      class(busy_sampler), intent(inout) :: self
      real(wp), intent(in) :: y(:)

      self%taken = self%taken + 1
      self%next = self%next + 30.0_wp
      call prepare(3, self%other)
      call perform(self%other)
   end subroutine integrate_other

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
   subroutine perform(run)
      type(run_type), intent(inout) :: run

      call integrate(run%problem, 0.0_wp, t_end, at_tolerance(1.0e-9_wp), run%outcome, &
                     run%failure, run%table)
   end subroutine perform

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
