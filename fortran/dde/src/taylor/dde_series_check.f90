! SPDX-License-Identifier: BSD-3-Clause
!> Whether the series of a step solves the equations of the problem: its slope is compared with the
!> right-hand side within the step.
module dde_series_check
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_errors, only: error_type, raise, text
   use dde_interpolant, only: series_value
   use dde_step_context, only: step_context
   use dde_taylor_series, only: taylor_series
   use dde_time, only: elapsed, instant
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: check_residual

   !> Places of the step. The ratio of the residuals there tells the first wrong coefficient.
   real(wp), parameter :: places(2) = [0.25_wp, 0.5_wp]
   !> A slope may be off by this many times the change that the tolerance of state and delayed
   !> values makes, and by this share of itself.
   real(wp), parameter :: allowance = 100.0_wp, rounding = 1.0e-8_wp
   !> In one direction of state and delayed values, changes cancelled once in 1e5 checks.
   integer, parameter :: directions = 3

contains

   !> Refuse a series whose slope is not the right-hand side, by the component and the coefficient
   !> that are wrong.
   pure subroutine check_residual(context, series, h, scale, error)
      !> The context of a step along the series
      type(step_context), intent(inout) :: context
      !> The series, with those of its delayed values
      type(taylor_series), intent(in) :: series
      !> Length of the step
      real(wp), intent(in) :: h
      !> Tolerance of each component
      real(wp), contiguous, intent(in) :: scale(:)
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: allowed(:), beside(:), found(:, :), residual(:, :), slope(:, :), &
                               y(:), z(:, :)
      character(len=:), allocatable :: name
      integer :: i, j, k
      real(wp) :: given

      associate (n => size(scale), delays => size(context%problem%lag), &
                 degree => series%degree, t => context%cursor%t + h*places)
         allocate (allowed(n), found(n, 2), residual(n, 2), slope(n, 2), y(n), z(delays, 2))
         call context%delayed_values(h*places, z)
         do j = 2, 1, -1
            call series%state(h*places(j), y)
            call context%problem%rhs(t(j), y, z(:, j), slope(:, j))
            found(:, j) = series%slope(h*places(j))
            residual(:, j) = abs(found(:, j) - slope(:, j))
            if (.not. all(ieee_is_finite(residual(:, j)))) return
            if (j == 1) exit
            allowed = allowance*degree*scale/h + rounding*abs(slope(:, 2))
            if (all(residual(:, 2) <= allowed)) return
         end do
         ! changes that cancel in one of these directions do not in the others
         call series%state(h*places(2), y)
         allocate (beside(n))
         do j = 1, directions
            call context%problem%rhs(t(2), y + scale*[(sin(real(i*j, wp)), i=1, n)], z(:, 2) &
                                     + scale(context%problem%component) &
                                     *[(cos(real(k*j, wp)), k=1, delays)], beside)
            allowed = max(allowed, allowance*abs(beside - slope(:, 2)))
         end do
         if (.not. all(ieee_is_finite(allowed))) return
         if (all(residual(:, 2) <= allowed)) return
         i = maxloc(residual(:, 2)/allowed, dim=1)
         k = 1 + max(0, min(degree - 1, nint(log(residual(i, 2)/max(residual(i, 1), tiny(1.0_wp))) &
                                             /log(places(2)/places(1)))))
         name = merge("slow_series", "series     ", series%slow%holds)
         do j = 1, delays
            associate (component => context%problem%component(j), &
                       time => t(2) - context%problem%lag(j))
               if (elapsed(instant(time), context%past%origin) <= 0.0_wp) cycle
               given = series_value(degree, series%delayed%coefficients(:, j), &
                                    h*places(2)/series%unit)
               if (abs(given - z(j, 2)) <= allowance*scale(component)) cycle
               call raise(error, "integrate: past_series: component "//text(component)//" is " &
                          //text(given)//" at t = "//text(time)//", history gives " &
                          //text(z(j, 2))//"; the same expected, or a jump in break_at")
               return
            end associate
         end do
         call raise(error, "integrate: "//trim(name)//": the slope of component "//text(i)//" is " &
                    //text(found(i, 2))//" at t = "//text(t(2))//", rhs gives "//text(slope(i, 2)) &
                    //"; the same expected (wrong from about coefficient "//text(k)//" on)")
      end associate
   end subroutine check_residual
end module dde_series_check
