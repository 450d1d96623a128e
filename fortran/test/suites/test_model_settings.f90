! SPDX-License-Identifier: BSD-3-Clause
!> Models by the names and values of their parameters, histories by the names of states, and the
!> words of a refusal.
module test_model_settings
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
   use block_builder, only: build_block
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_history, only: history_type, read_history, shown_name, signal_name
   use model_problem, only: model_type
   use model_settings, only: model_settings_type
   implicit none (type, external)
   private
   public :: collect_model_settings

contains

   subroutine collect_model_settings(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("models", test_models), &
                   new_unittest("refused models", test_refused_models), &
                   new_unittest("histories", test_histories), &
                   new_unittest("refused histories", test_refused_histories)]
   end subroutine collect_model_settings

   !> Settings of a block, the last parameter first; c may be missing, and an empty name is none.
   pure type(model_settings_type) function block_settings(numbers) result(settings)
      !> tau, epsilon, xi, gamma, c
      real(wp), intent(in) :: numbers(:)
      character(len=7), parameter :: names(5) = [character(len=7) :: "tau", "epsilon", "xi", &
                                                 "gamma", "c"]
      integer :: i

      settings%name = "slip_cut_off"
      do i = size(numbers), 1, -1
         call settings%put(names(i), numbers(i))
         call settings%put("", 7.0_wp)
      end do
   end function block_settings

   !> Parameters have their values by name, in whatever order they are given, and the last value
   !> counts. The ends of ranges are allowed. The model is at rest.
   subroutine test_models(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(model_settings_type) :: settings
      type(model_type) :: model
      real(wp) :: least(5)
      integer :: kept

      settings = block_settings([7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp, 0.3_wp])
      call settings%put("xi", 0.6_wp)
      settings%name = "quasistatic_slip_cut_off"
      call settings%put("zeta", 0.1_wp)
      call settings%open("input.nml: ", model, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, all(model%names == [character(len=7) :: "tau", "epsilon", "xi", "gamma", &
                                             "c", "zeta"]), "names")
      call expect_close(error, [model%numbers, model%past], &
                        [7.0_wp, 0.7_wp, 0.6_wp, 0.8_wp, 0.3_wp, 0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
                        0.0_wp, "numbers, and rest")
      least = [0.0_wp, nearest(-1.0_wp, 1.0_wp), tiny(1.0_wp), nearest(huge(1.0_wp), -1.0_wp), &
               0.0_wp]
      settings = block_settings(least)
      do kept = 0, 1
         call settings%open("input.nml: ", model, failure, keep_delays=kept == 1)
         call expect_success(error, failure)
         if (allocated(error)) return
         call expect_close(error, model%numbers, least, 0.0_wp, "ends of the ranges")
         call expect(error, size(model%lag) == kept, "a delay of 0 only if it is kept")
      end do
   end subroutine test_models

   !> The message has the place, the key, the value and the range; of several errors the first.
   !> tests/test_programs.py has other names.
   subroutine test_refused_models(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: at_least_0 = "; expected a finite number >= 0.0"
      real(wp), parameter :: good(5) = [1.0_wp, 0.5_wp, 0.5_wp, 0.8_wp, 0.0_wp]
      real(wp), parameter :: bad(4) = [-0.1_wp, -1.0_wp, 0.0_wp, -0.5_wp]
      character(len=7), parameter :: words(4) = [character(len=7) :: "tau", "epsilon", "xi", "c"], &
                                     ranges(4) = [character(len=7) :: ">= 0.0", "> -1.0", &
                                                  "> 0.0", ">= 0.0"]
      type(model_settings_type) :: settings
      integer :: i

      do i = 1, 4
         settings = block_settings(good)
         call settings%put(trim(words(i)), bad(i))
         call refuse(settings, trim(words(i))//" = "//text(bad(i))//"; expected a finite number " &
                     //trim(ranges(i)))
      end do
      call settings%put("c", 0.0_wp)
      call settings%put("tau", ieee_value(1.0_wp, ieee_positive_inf))
      call refuse(settings, at_least_0)
      settings = block_settings(good)
      call settings%put("gamma", ieee_value(1.0_wp, ieee_quiet_nan))
      call refuse(settings, "gamma = NaN; expected a finite number > 0.0 (NaN: missing, or not a " &
                  //"number)")
      call refuse(block_settings(good(:4)), "c is missing"//at_least_0)
      call refuse(block_settings([-1.0_wp, -2.0_wp, -3.0_wp, -4.0_wp]), "tau = -1.0"//at_least_0)

      settings = block_settings(good)
      settings%blocks = 2
      call refuse(settings, "blocks = 2 of the model slip_cut_off; expected 1, since it has no " &
                  //"second difference")

      settings = block_settings(good)
      settings%name = "chain_slip_cut_off"
      call settings%put("kappa", 1.0_wp)
      settings%blocks = 0
      call refuse(settings, "blocks = 0; expected a whole number >= 1")
      settings%blocks = 2
      settings%ends = "ring"
      call refuse(settings, "ends = ring: blocks = 2; expected a whole number >= 3")
      settings%ends = "open"
      call refuse(settings, "ends = 'open'; expected one of 'free' 'ring' 'plate'")

      call refuse(model_settings_type(name="made_enzyme"), "the model made_enzyme has no state " &
                  //"at rest; expected one with steady_state in its definition", at_rest=.true.)

   contains

      !> Settings are refused with these words.
      subroutine refuse(refused, why, at_rest)
         type(model_settings_type), intent(in) :: refused
         character(len=*), intent(in) :: why
         logical, intent(in), optional :: at_rest
         type(failure_type), allocatable :: met
         type(model_type) :: model

         call refused%open("input.nml: ", model, met, at_rest=at_rest)
         call expect_failure(error, met, "input.nml: ")
         call expect_failure(error, met, why)
      end subroutine refuse
   end subroutine test_refused_models

   !> Values by names in any order, of a state or of its exponential. Files show the exponential.
   !> Values are given along a ring, and states are where its blocks stand when it is folded.
   subroutine test_histories(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(history_type) :: history
      type(model_type) :: block, ring
      integer, parameter :: folded(5) = [1, 5, 2, 4, 3]
      integer :: i
      real(wp), parameter :: values(3, 2) = reshape( &
         [1.5_wp, 0.1_wp, -0.2_wp, tiny(1.0_wp), -1.0e300_wp, 0.0_wp], [3, 2])

      block = build_block(1.0_wp, 0.5_wp, 0.5_wp, 0.8_wp)
      call expect(error, signal_name(block) == "v" .and. shown_name(block, 3) == "ln_v" &
                  .and. shown_name(block, 1) == "theta", "names of components")
      call read_history("input.nml: ", block, [character(len=5) :: "v", "theta", "u"], [values], &
                        history, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, history%count() == 2 .and. &
                  all(history%names == [character(len=5) :: "theta", "u", "v"]), "names")
      call expect_close(error, [history%values(:, 1, :)], [values([2, 3, 1], :)], 0.0_wp, "values")
      call expect_close(error, history%past(block, 1), [0.1_wp, -0.2_wp, log(1.5_wp)], 0.0_wp, &
                        "states")
      call read_history("input.nml: ", block, ["w    ", "u    ", "theta"], &
                        [-2.0_wp, 3.0_wp, 4.0_wp], history, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, history%past(block, 1), [4.0_wp, 3.0_wp, -2.0_wp], 0.0_wp, &
                        "a state by its own name")
      call expect_close(error, history%values(3, 1, 1), exp(-2.0_wp), 0.0_wp, "its exponential")
      ring = build_block(1.0_wp, 0.5_wp, 0.5_wp, 0.8_wp, law="chain_slip_cut_off", &
                         own=[0.0_wp, 1.0_wp], blocks=5, ends="ring")
      call read_history("input.nml: ", ring, ["w    ", "theta", "u    "], &
                        [(real([3*i, 3*i + 1, 3*i + 2], wp), i=1, 10)], history, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, history%past(ring, 2), &
                        [(real(3*folded(i) + 15 + [1, 2, 0], wp), i=1, 5)], 0.0_wp, "a ring")
   end subroutine test_histories

   !> The message has the place, the name, the value and the range.
   subroutine test_refused_histories(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=5), parameter :: names(3) = [character(len=5) :: "theta", "u", "v"]
      type(model_type) :: block

      block = build_block(1.0_wp, 0.5_wp, 0.5_wp, 0.8_wp)
      call refuse(names, [ieee_value(1.0_wp, ieee_positive_inf), 0.0_wp, 1.0_wp], &
                  "history of theta = ")
      call refuse(names, [0.0_wp, ieee_value(1.0_wp, ieee_quiet_nan), 1.0_wp], "missing")
      call refuse(names, [0.0_wp, 0.0_wp, 0.0_wp], &
                  "history of v = 0.0; expected a finite number > 0.0")
      call refuse(names, [0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -1.0_wp], "history of v = -1.0")
      call refuse(names, [0.0_wp, 0.0_wp], "history has 3 names and 2 values; expected 3 names, " &
                  //"and a value for each name and each of 1 blocks")
      call refuse(names(:2), [0.0_wp, 0.0_wp, 0.0_wp], "history has 2 names and 3 values")
      call refuse(names, [real(wp) ::], "number of histories = 0; expected a whole number >= 1")
      call refuse(["theta", "u    ", "x    "], [0.0_wp, 0.0_wp, 1.0_wp], &
                  "history of v is missing; expected a finite number")
      call refuse(["theta", "theta", "v    "], [0.0_wp, 0.0_wp, 1.0_wp], "history of u is missing")

   contains

      !> A history is refused with these words.
      subroutine refuse(given, values, why)
         character(len=*), intent(in) :: given(:), why
         real(wp), intent(in) :: values(:)
         type(failure_type), allocatable :: met
         type(history_type) :: history

         call read_history("input.nml: ", block, given, values, history, met)
         call expect_failure(error, met, "input.nml: ")
         call expect_failure(error, met, why)
      end subroutine refuse
   end subroutine test_refused_histories
end module test_model_settings
