! SPDX-License-Identifier: BSD-3-Clause
!> From the error of one step to the size of the next: proportional-integral control after
!> Gustafsson (Hairer and Wanner 1996, "Solving Ordinary Differential Equations II", sec. IV.2).
module dde_controller
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: controller_type, method_constants

   !> Weight of the error of the step before in proportional-integral control, of 1 (METHODS.md).
   real(wp), parameter :: weight_before = 0.25_wp
   !> Bounds on the ratio of one step to the one before.
   real(wp), parameter :: least_ratio = 1.0_wp/3.0_wp, most_ratio = 6.0_wp
   !> If a step is rejected again, the order observed between the two attempts replaces that of the
   !> method (Gustafsson 1994, ACM Trans. Math. Softw. 20, 496). Least value of this order, and
   !> least ratio of the steps then.
   real(wp), parameter :: least_order = 0.5_wp, least_ratio_again = 1.0e-4_wp
   !> Ratio after an evaluation that was not finite.
   real(wp), parameter :: ratio_after_failure = 0.1_wp
   !> Lower bounds on the logarithms of accepted errors in proportional and in predictive control:
   !> errors of 1e-4 and 1e-2.
   real(wp), parameter :: least_log_error = -9.2_wp, least_log_predicted = -4.6_wp

   !> Constants of a method that the run needs.
   type :: method_constants
      !> Name, as the table of methods has it
      character(len=8) :: name = ""
      !> Order of the method
      integer :: order = 0
      !> The error estimate is proportional to this power of the step size
      integer :: error_order = 0
      !> Whether the method is implicit: its steps may then be longer than the shortest delay
      logical :: implicit = .false.
      !> Cost of one evaluation, in evaluations of the explicit pair
      real(wp) :: evaluation_cost = 1.0_wp
      !> Whether step control extrapolates the error from the last two steps (predictive control)
      logical :: predictive = .false.
      !> The step size is kept if the proposed ratio lies between 1 and this
      real(wp) :: largest_kept_ratio = 1.0_wp
   end type method_constants

   !> Step control of one integration.
   type :: controller_type
      !> Logarithm of the error of the last accepted step, or of the least
      real(wp), private :: last_log_error = least_log_error
      !> Length of the last accepted step, 0 before the first
      real(wp), private :: last_h = 0.0_wp
      !> Whether the last step was rejected
      logical, private :: rejected = .false.
      !> Error of the last step, if rejected, 0 where that was not finite, and its length
      real(wp), private :: rejected_error = 0.0_wp, rejected_h = 0.0_wp
   contains
      procedure :: accept, reject
   end type controller_type

contains

   !> After an accepted step: replace its length by the next.
   pure subroutine accept(self, method, safety, h, error)
      class(controller_type), intent(inout) :: self
      type(method_constants), intent(in) :: method
      !> Factor below the step size at which the error would be equal to the tolerance
      real(wp), intent(in) :: safety
      !> Length of the step, replaced by the next
      real(wp), intent(inout) :: h
      !> Error of the step in units of the tolerance, 0..1
      real(wp), intent(in) :: error
      real(wp) :: log_error, power, ratio, taken

      taken = h
      ratio = most_ratio
      power = 1.0_wp/method%error_order
      log_error = log(max(error, tiny(1.0_wp)))
      if (method%predictive) then
         ratio = exp(-power*log_error)
         if (self%last_h > 0.0_wp) then
            ratio = ratio*min(1.0_wp, h/self%last_h*exp(power*(self%last_log_error - log_error)))
         end if
      else
         ratio = exp(power*(weight_before*self%last_log_error - (1.0_wp - weight_before)*log_error))
      end if
      ratio = min(most_ratio, max(least_ratio, safety*ratio))
      if (self%rejected) ratio = min(ratio, 1.0_wp)
      if (ratio < 1.0_wp .or. ratio > method%largest_kept_ratio) h = h*ratio
      self%last_log_error = max(log_error, merge(least_log_predicted, least_log_error, &
                                                 method%predictive))
      self%last_h = taken
      self%rejected = .false.
   end subroutine accept

   !> After a rejected step: replace its length by the next attempt.
   pure subroutine reject(self, method, safety, h, error)
      class(controller_type), intent(inout) :: self
      type(method_constants), intent(in) :: method
      real(wp), intent(in) :: safety
      !> Length of the step, replaced by the next attempt
      real(wp), intent(inout) :: h
      !> Error of the step in units of the tolerance, > 1 or not finite
      real(wp), intent(in) :: error
      real(wp) :: least, order, taken

      taken = h
      if (ieee_is_finite(error)) then
         order = method%error_order
         least = least_ratio
         if (self%rejected .and. self%rejected_error > error .and. self%rejected_h > h) then
            ! a near-jump inside the step: its error is proportional to a low power of its length
            order = log(self%rejected_error/error)/log(self%rejected_h/h)
            order = max(least_order, min(order, real(method%error_order, wp)))
            least = least_ratio_again
         end if
         h = h*max(least, safety*error**(-1.0_wp/order))
      else
         h = h*ratio_after_failure
      end if
      self%rejected_error = merge(error, 0.0_wp, ieee_is_finite(error))
      self%rejected_h = taken
      self%rejected = .true.
   end subroutine reject
end module dde_controller
