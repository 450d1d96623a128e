!> Taylor steps in runs cut into pieces: what the past is valid for, and where it begins.
module test_dde_pieces
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: int64, wp
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: mackey_glass
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_dde_pieces

contains

   !> All tests of this suite.
   subroutine collect_dde_pieces(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("steps", test_steps), &
                   new_unittest("rounding of the oldest step", test_rounding)]
   end subroutine collect_dde_pieces

   !> A cut costs a step, not those of a whole delay.
   subroutine test_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome, whole
      integer, parameter :: pieces = 20
      integer(int64) :: steps
      integer :: i

      call integrate(problem(), 0.0_wp, 600.0_wp, options(), whole, failure)
      call expect_success(error, failure)
      steps = 0
      do i = 1, pieces
         call integrate(problem(), (i - 1)*600.0_wp/pieces, i*600.0_wp/pieces, &
                        options(), outcome, failure, continuation=continuation)
         call expect_success(error, failure)
         if (allocated(error)) return
         steps = steps + outcome%accepted
      end do
      call expect_close(error, outcome%y, whole%y, 1.0e-6_wp, "the end")
      call expect(error, steps <= whole%accepted + pieces, text(steps)//" steps in pieces, " &
                  //text(whole%accepted)//" in one")
   end subroutine test_steps

   !> The oldest step may begin a rounding after t - lag, 83 here; not more.
   subroutine test_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation
      type(failure_type), allocatable :: failure
      type(integration_result) :: known, outcome
      real(wp), parameter :: late(2) = [spacing(100.0_wp), 1.0e-9_wp]
      integer :: i

      call integrate(problem(), 0.0_wp, 110.0_wp, options(), known, failure)
      call expect_success(error, failure)
      do i = 1, size(late)
         continuation = continuation_type()
         ! the end of the first run is the start of the oldest step kept by the second
         call integrate(problem(), 0.0_wp, 83.0_wp, options(), outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
         call integrate(problem(), 83.0_wp, 100.0_wp, options(), outcome, failure, &
                        continuation=continuation)
         call expect_success(error, failure)
         if (allocated(error)) return
         associate (start => continuation%step_start(:, 1))
            call expect_close(error, start, [83.0_wp, 0.0_wp], 0.0_wp, "the oldest step")
            start(1) = start(1) + late(i)
         end associate
         call integrate(problem(), 100.0_wp, 110.0_wp, options(), outcome, failure, &
                        continuation=continuation)
         if (i == 1) then
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect_close(error, outcome%y, known%y, 1.0e-8_wp, "the end")
         else
            call expect_failure(error, failure, "reaches beyond the past")
         end if
      end do
   end subroutine test_rounding

   !> Of all runs here.
   type(integration_options) function options() result(taylor)
      taylor = at_tolerance(1.0e-10_wp, "taylor")
   end function options

   !> Mackey and Glass's equation.
   type(mackey_glass) function problem() result(equation)
      equation = mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], first=[1.2_wp])
   end function problem
end module test_dde_pieces
