! SPDX-License-Identifier: BSD-3-Clause
!> The length of the first step of a run, where it is not given.
module dde_first_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_tolerance, only: hopeless, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: choose_first_step

contains

   !> First step length: about a hundredth of |y|/|y'|, refined by the second derivative (Hairer,
   !> Norsett and Wanner 1993, sec. II.4).
   pure subroutine choose_first_step(context, step, unit, longest, h)
      type(step_context), intent(inout) :: context
      !> The step, its first slope known
      class(step_type), intent(inout) :: step
      !> Unit of time; time to the end of the run, or the longest step allowed, the shorter
      real(wp), intent(in) :: unit, longest
      real(wp), intent(out) :: h
      real(wp), allocatable :: slope_ahead(:)
      real(wp) :: bend, slope

      allocate (slope_ahead, mold=step%slope)
      call context%tolerance%scale(step%y, step%scale)
      h = 1.0e-6_wp*longest
      slope = unit*length_of(step%slope, step%scale)
      if (slope > hopeless) return
      h = 1.0e-6_wp*unit
      if (slope > 1.0e-5_wp .and. length_of(step%y, step%scale) > 1.0e-5_wp) then
         h = 0.01_wp*length_of(step%y, step%scale)/slope*unit
      end if
      h = min(h, longest, minval(context%problem%lag))
      call context%delayed_values([h], step%z)
      step%y_new = step%y + h*step%slope
      call context%evaluate(context%cursor%t + h, step%y_new, step%z, slope_ahead)
      slope_ahead = slope_ahead - step%slope
      bend = unit*length_of(slope_ahead, step%scale)
      if (bend > hopeless) return
      bend = bend/(h/unit)
      if (max(slope, bend) > 1.0e-15_wp) then
         h = min(100.0_wp*h, &
                 unit*(0.01_wp/max(slope, bend))**(1.0_wp/step%constants%error_order))
      else
         h = min(100.0_wp*h, max(1.0e-6_wp*unit, 1.0e-3_wp*h))
      end if
   end subroutine choose_first_step

   !> The norm of x; huge if x is not finite.
   pure function length_of(x, scale) result(length)
      real(wp), intent(in) :: x(:), scale(:)
      real(wp) :: length

      length = scaled_norm(size(x), x, scale)
      if (.not. ieee_is_finite(length)) length = huge(1.0_wp)
   end function length_of
end module dde_first_step
