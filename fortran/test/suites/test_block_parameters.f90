!> Ranges of the block's parameters and history, and the words of a refusal.
module test_block_parameters
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
   use block_parameters, only: block_history_type, block_parameters_type
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use value_checks, only: absent
   implicit none (type, external)
   private
   public :: collect_block_parameters

contains

   subroutine collect_block_parameters(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("allowed values", test_allowed), &
                   new_unittest("refused values", test_refused), &
                   new_unittest("parameters by name", test_names), &
                   new_unittest("the first error stays", test_first_error)]
   end subroutine collect_block_parameters

   !> The ends of the ranges and the defaults.
   subroutine test_allowed(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_history_type) :: history
      type(block_parameters_type) :: parameters
      type(failure_type), allocatable :: failure

      call parameters%check("input.nml", failure)
      parameters = block_parameters_type(tau=0.0_wp, epsilon=nearest(-1.0_wp, 1.0_wp), &
                                         xi=tiny(1.0_wp), gamma=nearest(huge(1.0_wp), -1.0_wp))
      call parameters%check("input.nml", failure)
      history = block_history_type(theta=-1.0e300_wp, u=-1.0e300_wp, v=tiny(1.0_wp))
      call history%check("input.nml", failure)
      call expect_success(error, failure)
   end subroutine test_allowed

   !> The message has the place, the key, the value and the range.
   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: words(3) = ["theta = ", "missing ", "v = 0.0 "]
      type(block_history_type), allocatable :: history(:)
      type(failure_type), allocatable :: failure
      real(wp) :: infinity, no_number
      integer :: i

      infinity = ieee_value(1.0_wp, ieee_positive_inf)
      no_number = ieee_value(1.0_wp, ieee_quiet_nan)
      call refuse(block_parameters_type(tau=-0.1_wp), &
                  "input.nml: tau = -0.1; expected a finite number >= 0.0")
      call refuse(block_parameters_type(tau=infinity), "finite number >= 0.0")
      call refuse(block_parameters_type(epsilon=-1.0_wp), &
                  "epsilon = -1.0; expected a finite number > -1.0")
      call refuse(block_parameters_type(xi=0.0_wp), "xi = 0.0; expected a finite number > 0.0")
      call refuse(block_parameters_type(gamma=0.0_wp), &
                  "gamma = 0.0; expected a finite number > 0.0")
      call refuse(block_parameters_type(gamma=no_number), "gamma = NaN")
      call refuse(block_parameters_type(law="slip"), &
                  "input.nml: law = 'slip'; expected one of 'ageing_delayed_logarithm'")
      call refuse(block_parameters_type(law="slip_cut_off", own=-0.5_wp), &
                  "input.nml: c = -0.5; expected a finite number >= 0.0")
      call refuse(block_parameters_type(law="slip_cut_off", own=absent), "c is missing")
      history = [block_history_type(theta=infinity), block_history_type(u=no_number), &
                 block_history_type(v=0.0_wp)]
      do i = 1, size(history)
         if (allocated(failure)) deallocate (failure)
         call history(i)%check("input.nml", failure)
         call expect_failure(error, failure, trim(words(i)))
      end do

   contains

      !> Parameters are refused with these words.
      subroutine refuse(refused, why)
         type(block_parameters_type), intent(in) :: refused
         character(len=*), intent(in) :: why
         type(block_parameters_type) :: checked
         type(failure_type), allocatable :: met

         checked = refused
         call checked%check("input.nml", met)
         call expect_failure(error, met, why)
      end subroutine refuse
   end subroutine test_refused

   !> A law's own parameters have their values by name, in whatever order they are given.
   subroutine test_names(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: parameters
      type(failure_type), allocatable :: failure

      parameters%law = "quasistatic_slip_cut_off"
      call parameters%put("zeta", 0.1_wp)
      call parameters%put("c", 0.5_wp)
      call parameters%put("xi", 0.7_wp)
      call parameters%check("input.nml", failure)
      call expect_success(error, failure)
      call expect(error, all(parameters%names() == [character(len=7) :: "tau", "epsilon", "xi", &
                                                    "gamma", "c", "zeta"]), "order")
      call expect_close(error, [parameters%xi, parameters%own(:2)], [0.7_wp, 0.5_wp, 0.1_wp], &
                        0.0_wp, "xi, c and zeta")
      parameters%law = "slip_cut_off"
      call parameters%check("input.nml", failure)
      call expect_failure(error, failure, "input.nml: parameter of the law slip_cut_off = " &
                          //"'zeta'; expected one of 'tau' 'epsilon' 'xi' 'gamma' 'c'")
   end subroutine test_names

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
