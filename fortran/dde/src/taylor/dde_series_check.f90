! SPDX-License-Identifier: BSD-3-Clause
!> Whether the series of a step solves the equations of the problem: its slope is compared with the
!> right-hand side. The last coefficients of a series do not show what is below their rounding, nor
!> terms that vanish by chance.
module dde_series_check
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_errors, only: error_type, raise, text
   use dde_interpolant, only: series_value
   use dde_step_context, only: step_context
   use dde_taylor_series, only: taylor_series
   use dde_time, only: elapsed, instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_wrong, measure_residual

   !> Places of the step. The ratio of the residuals there tells the first wrong coefficient.
   real(wp), parameter :: places(2) = [0.25_wp, 0.5_wp]
   !> A slope may be off by this many times degree tolerance/h: the term after the last one, at the
   !> tolerance, makes 1.
   real(wp), parameter :: allowance = 2.0_wp
   !> It may be off by this share of itself.
   real(wp), parameter :: rounding = 1.0e-13_wp
   !> It may be off by the change that the tolerance of state and delayed values makes. In one
   !> direction of these, changes cancelled once in 1e5 steps.
   integer, parameter :: directions = 3

contains

   !> Error of a step along a series: the largest residual at one place, over the largest that is
   !> allowed. It is not a number if the right-hand side is not finite there.
   pure subroutine measure_residual(context, series, h, place, scale, y, z, slope, worst, error)
      !> The context of a step along the series
      type(step_context), intent(inout) :: context
      !> The series, with those of its delayed values
      type(taylor_series), intent(in) :: series
      !> Length of the step, and the place in units of it
      real(wp), intent(in) :: h, place
      !> Tolerance of each component, and state at the place
      real(wp), contiguous, intent(in) :: scale(:), y(:)
      !> Delayed values and right-hand side there
      real(wp), contiguous, intent(inout) :: z(:, :), slope(:)
      !> The component with this residual
      integer, intent(out) :: worst
      real(wp), intent(out) :: error
      real(wp) :: allowed, ratio, t
      integer :: i

      call context%delayed_values([h*place], z)
      t = context%cursor%inside(context%cursor%t + h*place)
      call context%problem%rhs(t, y, z(:, 1), slope)
      error = 0.0_wp
      worst = 1
      do i = 1, size(y)
         allowed = allowance*series%degree*scale(i)/h + rounding*abs(slope(i))
         ratio = abs(series%slope_of(i, h*place) - slope(i))/max(allowed, tiny(1.0_wp))
         if (ratio <= error) cycle
         error = ratio
         worst = i
         if (.not. ieee_is_finite(ratio)) exit
      end do
      if (error > 1.0_wp) then
         call allow_for_tolerance(context, series, h, place, scale, y, z, slope, t, worst, error)
      end if
      if (.not. ieee_is_finite(error)) error = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine measure_residual

   !> The residual over that which the tolerance of state and delayed values makes.
   pure subroutine allow_for_tolerance(context, series, h, place, scale, y, z, slope, t, worst, &
                                       error)
      type(step_context), intent(in) :: context
      type(taylor_series), intent(in) :: series
      real(wp), intent(in) :: h, place, t
      real(wp), contiguous, intent(in) :: scale(:), y(:), z(:, :), slope(:)
      integer, intent(inout) :: worst
      real(wp), intent(inout) :: error
      real(wp), allocatable :: allowed(:), beside(:)
      integer :: i, j

      allocate (beside(size(y)))
      allowed = allowance*series%degree*scale/h + rounding*abs(slope)
      do j = 1, directions
         call context%problem%rhs(t, y + scale*[(sin(real(i*j, wp)), i=1, size(y))], &
                                  z(:, 1) + scale(context%problem%component) &
                                  *[(cos(real(i*j, wp)), i=1, size(z, 1))], beside)
         beside = abs(beside - slope)
         where (ieee_is_finite(beside)) allowed = max(allowed, beside)
      end do
      beside = [(abs(series%slope_of(i, h*place) - slope(i)), i=1, size(y))] &
               /max(allowed, tiny(1.0_wp))
      worst = maxloc(beside, dim=1)
      error = beside(worst)
   end subroutine allow_for_tolerance

   !> The first coefficient that is wrong, from the ratio of residuals at two places, and the error
   !> that names it.
   pure subroutine find_wrong(context, series, h, scale, wrong, error)
      type(step_context), intent(inout) :: context
      type(taylor_series), intent(in) :: series
      real(wp), intent(in) :: h
      real(wp), contiguous, intent(in) :: scale(:)
      !> Its number; 0 if none is
      integer, intent(out) :: wrong
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: found(2), given(2), of_series, ratio, slope(size(scale)), t, &
                  y(size(scale)), z(size(context%problem%lag), 1)
      character(len=:), allocatable :: name
      integer :: i, ignored, j

      wrong = 0
      associate (degree => series%degree)
         call series%state(h*places(2), y)
         call measure_residual(context, series, h, places(2), scale, y, z, slope, i, ratio)
         if (.not. ratio > 1.0_wp) return
         given(2) = slope(i)
         t = context%cursor%t + h*places(2)
         do j = 1, size(z, 1)
            associate (component => context%problem%component(j), &
                       time => t - context%problem%lag(j))
               if (elapsed(instant(time), context%past%origin) <= 0.0_wp) cycle
               of_series = series_value(degree, series%delayed%coefficients(:, j), &
                                        h*places(2)/series%unit)
               if (abs(of_series - z(j, 1)) <= allowance*degree*scale(component)) cycle
               call raise(error, "integrate: past_series: component "//text(component)//" is " &
                          //text(of_series)//" at t = "//text(time)//", history gives " &
                          //text(z(j, 1))//"; the same expected, or a jump in break_at")
               exit
            end associate
         end do
         call series%state(h*places(1), y)
         call measure_residual(context, series, h, places(1), scale, y, z, slope, ignored, ratio)
         given(1) = slope(i)
         found = [(series%slope_of(i, h*places(j)), j=1, 2)]
         associate (residual => max(abs(found - given), tiny(1.0_wp)))
            wrong = 1 + max(0, min(degree - 1, nint(log(residual(2)/residual(1)) &
                                                    /log(places(2)/places(1)))))
         end associate
         if (allocated(error)) return
         name = merge("slow_series", "series     ", series%slow%holds)
         call raise(error, "integrate: "//trim(name)//": the slope of component "//text(i)//" is " &
                    //text(found(2))//" at t = "//text(t)//", rhs gives "//text(given(2)) &
                    //"; the same expected (wrong from about coefficient "//text(wrong)//" on)")
      end associate
   end subroutine find_wrong
end module dde_series_check
