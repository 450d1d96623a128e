! SPDX-License-Identifier: BSD-3-Clause
!> Step control: bounds on the ratio of steps (those of Hairer, Norsett and Wanner's DOP853, 1/3 and
!> 6), no growth after a rejection, few rejections at a near-jump, where the closed loop settles.
module test_dde_controller
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_controller, only: controller_type, method_constants
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   implicit none (type, external)
   private
   public :: collect_dde_controller

   !> Order of the step, as of the explicit method.
   integer, parameter :: order = 8
   !> Its constants.
   type(method_constants), parameter :: method = method_constants(error_order=order)
   !> Factor below the step size at which the error would be equal to the tolerance.
   real(wp), parameter :: safety = 0.9_wp

contains

   subroutine collect_dde_controller(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("bounds", test_bounds), &
                   new_unittest("no growth after a rejection", test_after_rejection), &
                   new_unittest("a near-jump", test_jump), &
                   new_unittest("closed loop", test_closed_loop)]
   end subroutine collect_dde_controller

   !> However small or large an error, steps grow at most sixfold and shrink at most to a third.
   !> Where there was no value at all, the next try is much shorter.
   subroutine test_bounds(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_close(error, ratio_accepted(0.0_wp), 6.0_wp, 1.0e-14_wp, "ratio without an error")
      call expect_close(error, ratio_accepted(1.0e-30_wp), 6.0_wp, 1.0e-14_wp, &
                        "ratio after a tiny error")
      call expect_between(error, ratio_accepted(1.0_wp), 1.0_wp/3.0_wp, 0.95_wp, &
                          "ratio after an error that just passes")
      call expect_between(error, ratio_rejected(1.01_wp), 0.5_wp, 0.95_wp, &
                          "ratio after an error that just fails")
      call expect_close(error, ratio_rejected(1.0e30_wp), 1.0_wp/3.0_wp, 1.0e-14_wp, &
                        "ratio after a huge error")
      call expect_between(error, ratio_rejected(ieee_value(1.0_wp, ieee_quiet_nan)), 0.01_wp, &
                          0.2_wp, "ratio without a value")
   end subroutine test_bounds

   !> The step that follows a rejection does not grow, the one after that may.
   subroutine test_after_rejection(error)
      type(error_type), allocatable, intent(out) :: error
      type(controller_type) :: control
      real(wp) :: h, h_accepted

      h = 1.0_wp
      call control%reject(method, safety, h, 3.0_wp)
      h_accepted = h
      call control%accept(method, safety, h, 1.0e-20_wp)
      call expect_close(error, h, h_accepted, 0.0_wp, "step after a rejection")
      call control%accept(method, safety, h, 1.0e-20_wp)
      call expect(error, h > h_accepted, "the step after that grows")
   end subroutine test_after_rejection

   !> A near-jump in the past makes the error fall as a low power of the step: few rejections find
   !> the step, and one that is not much too short.
   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: powers(3) = [0.6_wp, 1.0_wp, 2.0_wp]
      type(controller_type) :: control
      real(wp) :: estimate, h
      integer :: i, rejected

      do i = 1, size(powers)
         control = controller_type()
         h = 1.0_wp
         rejected = 0
         do
            estimate = 1.0e6_wp*h**powers(i)
            if (estimate <= 1.0_wp) exit
            call control%reject(method, safety, h, estimate)
            rejected = rejected + 1
         end do
         call expect_between(error, real(rejected, wp), 2.0_wp, 4.0_wp, "rejections")
         call expect(error, estimate > 0.1_wp, "a step not much too short")
      end do
   end subroutine test_jump

   !> Where the error is (h/scale)**order, the step settles at an error that is neither wasteful nor
   !> near rejection, from far below and from far above.
   subroutine test_closed_loop(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: scale = 0.37_wp, starts(2) = [1.0e-9_wp, 1.0e3_wp]
      type(controller_type) :: control
      real(wp) :: estimate, h
      integer :: i, j, rejected

      do i = 1, 2
         control = controller_type()
         h = starts(i)
         rejected = 0
         do j = 1, 40
            estimate = (h/scale)**order
            if (estimate <= 1.0_wp) then
               call control%accept(method, safety, h, estimate)
            else
               call control%reject(method, safety, h, estimate)
               if (j > 20) rejected = rejected + 1
            end if
         end do
         call expect_between(error, (h/scale)**order, 0.1_wp, 0.7_wp, "error in the long run")
         call expect(error, rejected == 0, "no rejection in the long run")
      end do
   end subroutine test_closed_loop

   !> Next step over this one, after this error of a first step.
   pure real(wp) function ratio_accepted(estimate) result(ratio)
      real(wp), intent(in) :: estimate
      type(controller_type) :: control

      ratio = 1.0_wp
      call control%accept(method, safety, ratio, estimate)
   end function ratio_accepted

   !> The same for an error that is too large.
   pure real(wp) function ratio_rejected(estimate) result(ratio)
      real(wp), intent(in) :: estimate
      type(controller_type) :: control

      ratio = 1.0_wp
      call control%reject(method, safety, ratio, estimate)
   end function ratio_rejected
end module test_dde_controller
