!> Ranges of the block's parameters and history, and the words of a refusal.
module test_block_parameters
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
   use block_parameters, only: block_parameters_type, check_quantity
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   implicit none (type, external)
   private
   public :: collect_block_parameters

contains

   subroutine collect_block_parameters(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("allowed values", test_allowed), &
                   new_unittest("refused values", test_refused), &
                   new_unittest("the first error stays", test_first_error)]
   end subroutine collect_block_parameters

   !> The ends of the ranges and the defaults.
   subroutine test_allowed(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: parameters
      type(failure_type), allocatable :: failure
      character(len=*), parameter :: quantity(7) = ["tau    ", "epsilon", "xi     ", "gamma  ", &
                                                    "theta  ", "u      ", "v      "]
      real(wp) :: value(7)
      integer :: i

      value = [0.0_wp, nearest(-1.0_wp, 1.0_wp), tiny(1.0_wp), nearest(huge(1.0_wp), -1.0_wp), &
               -1.0e300_wp, -1.0e300_wp, tiny(1.0_wp)]
      call parameters%check("input.nml", failure)
      do i = 1, size(value)
         call check_quantity(failure, "input.nml", trim(quantity(i)), value(i))
      end do
      call expect_success(error, failure)
   end subroutine test_allowed

   !> The message has the place, the key, the value and the range.
   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: parameters
      type(failure_type), allocatable :: failure
      real(wp) :: infinity, no_number

      infinity = ieee_value(1.0_wp, ieee_positive_inf)
      no_number = ieee_value(1.0_wp, ieee_quiet_nan)
      call refuse("tau", -0.1_wp, "input.nml: tau = -0.1; expected a finite number >= 0.0")
      call refuse("tau", infinity, "finite number >= 0.0")
      call refuse("epsilon", -1.0_wp, "epsilon = -1.0; expected a finite number > -1.0")
      call refuse("xi", 0.0_wp, "xi = 0.0; expected a finite number > 0.0")
      call refuse("gamma", 0.0_wp, "gamma = 0.0; expected a finite number > 0.0")
      call refuse("theta", infinity, "theta = ")
      call refuse("u", no_number, "missing")
      call refuse("v", 0.0_wp, "input.nml: history%v = 0.0", key="history%v")
      parameters%gamma = no_number
      call parameters%check("input.nml", failure)
      call expect_failure(error, failure, "gamma = NaN")

   contains

      !> A value is refused with these words.
      subroutine refuse(quantity, value, words, key)
         character(len=*), intent(in) :: quantity, words
         real(wp), intent(in) :: value
         character(len=*), intent(in), optional :: key
         type(failure_type), allocatable :: why

         call check_quantity(why, "input.nml", quantity, value, key)
         call expect_failure(error, why, words)
      end subroutine refuse
   end subroutine test_refused

   !> Of several values out of range the first is reported.
   subroutine test_first_error(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: parameters
      type(failure_type), allocatable :: failure

      parameters = block_parameters_type(tau=-1.0_wp, epsilon=-2.0_wp, xi=-3.0_wp, gamma=-4.0_wp)
      call parameters%check("input.nml", failure)
      call expect_failure(error, failure, "tau = -1.0")
      call expect(error, index(failure%message, "epsilon") == 0, "one value")
   end subroutine test_first_error
end module test_block_parameters
