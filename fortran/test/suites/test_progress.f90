!> Progress that long work reports.
module test_progress
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integration_options
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_success
   use dde_kinds, only: int64, wp
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use measured_case, only: case_type
   use measured_run, only: measure_run, run_type, time_runs
   use progress_receiver, only: progress_receiver_type
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_progress

   !> Keeps what it is told.
   type, extends(progress_receiver_type) :: recorder
      !> Pieces done, call by call
      integer, allocatable :: done(:)
      !> Pieces in all, call by call
      integer, allocatable :: total(:)
   contains
      procedure :: advance
   end type recorder

contains

   !> All tests of this suite.
   subroutine collect_progress(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("intervals of exponents", test_growth), &
                   new_unittest("samples of a measured run", test_samples), &
                   new_unittest("turns of timed runs", test_turns)]
   end subroutine collect_progress

   !> Keep a call.
   subroutine advance(self, done, total)
      class(recorder), intent(inout) :: self
      integer, intent(in) :: done
      integer, intent(in) :: total

      self%done = [self%done, done]
      self%total = [self%total, total]
   end subroutine advance

   !> Nothing told yet.
   function new_recorder() result(receiver)
      type(recorder) :: receiver

      allocate (receiver%done(0), receiver%total(0))
   end function new_recorder

   !> 1, 2, ... of as many as there are.
   subroutine expect_counted(error, receiver, total)
      type(error_type), allocatable, intent(inout) :: error
      !> What was told
      type(recorder), intent(in) :: receiver
      !> Pieces expected
      integer, intent(in) :: total
      integer :: i

      call expect(error, size(receiver%done) == total, "as many calls as pieces")
      if (allocated(error)) return
      call expect(error, all(receiver%done == [(i, i=1, total)]), "piece by piece")
      call expect(error, all(receiver%total == total), "the same total in each call")
   end subroutine expect_counted

   !> 10 intervals in which vectors turn, 40 that are measured; the growth is that without receiver.
   subroutine test_growth(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(growth_type) :: alone, watched
      type(linear) :: problem
      type(recorder) :: receiver

      problem = linear(n=1, lag=[1.0_wp], component=[1], past=[1.0_wp], first=[1.0_wp])
      settings = growth_settings_type(exponents=2, t_begin=6.0_wp, t_end=26.0_wp, &
                                      t_turning=5.0_wp, interval=0.5_wp, blocks=4)
      receiver = new_recorder()
      call measure_growth(problem, settings, integration_options(), watched, failure, &
                          progress=receiver)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_counted(error, receiver, 50)
      call measure_growth(problem, settings, integration_options(), alone, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, all(.not. abs(alone%growth - watched%growth) > 0.0_wp), "the same growth")
   end subroutine test_growth

   !> 21 samples.
   subroutine test_samples(error)
      type(error_type), allocatable, intent(out) :: error
      type(recorder) :: receiver
      type(run_type) :: run

      receiver = new_recorder()
      run = run_type("explicit", 1.0e-6_wp)
      call measure_run(short_case(), 0.0_wp, 100000_int64, run, receiver)
      call expect(error, run%status == "ok", "status")
      call expect_counted(error, receiver, 21)
   end subroutine test_samples

   !> Three turns of two runs.
   subroutine test_turns(error)
      type(error_type), allocatable, intent(out) :: error
      type(recorder) :: receiver
      type(run_type) :: runs(2)
      integer :: i

      receiver = new_recorder()
      runs = run_type("explicit", 1.0e-6_wp)
      do i = 1, size(runs)
         call measure_run(short_case(), 0.0_wp, 100000_int64, runs(i))
      end do
      call time_runs(short_case(), 100000_int64, 3, 0.0_wp, runs, receiver)
      call expect_counted(error, receiver, 3)
   end subroutine test_turns

   !> The delayed block up to t = 10.
   pure function short_case() result(case)
      type(case_type) :: case

      case = case_type(name="short", parameters=block_parameters_type(tau=1.0_wp, epsilon=0.5_wp), &
                       history=block_history_type(v=1.1_wp), t_end=10.0_wp, sample_interval=0.5_wp)
   end function short_case
end module test_progress
