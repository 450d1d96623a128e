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

   !> The residual of a series at places of a step, over the largest that is allowed.
   pure subroutine find_residual(context, series, h, scale, at, found, slope, z, ratio)
      type(step_context), intent(inout) :: context
      type(taylor_series), intent(in) :: series
      !> Length of the step, tolerance of each component, and places in the step, ascending
      real(wp), intent(in) :: h, scale(:), at(:)
      !> Slope of the series, and of the right-hand side, shape (n, places); delayed values there
      real(wp), intent(out) :: found(:, :), slope(:, :), z(:, :)
      !> Residual over the largest allowed, shape (n, places); not a number without a value
      real(wp), intent(out) :: ratio(:, :)
      real(wp) :: allowed(size(scale)), beside(size(scale)), y(size(scale))
      integer :: i, j, k

      call context%delayed_values(h*at, z)
      do j = 1, size(at)
         associate (t => context%cursor%inside(context%cursor%t + h*at(j)))
            call series%state(h*at(j), y)
            call context%problem%rhs(t, y, z(:, j), slope(:, j))
            found(:, j) = series%slope(h*at(j))
            allowed = allowance*series%degree*scale/h + rounding*abs(slope(:, j))
            if (any(abs(found(:, j) - slope(:, j)) > allowed)) then
               do i = 1, directions
                  call context%problem%rhs(t, y + scale*[(sin(real(i*k, wp)), k=1, size(y))], &
                                           z(:, j) + scale(context%problem%component) &
                                           *[(cos(real(i*k, wp)), k=1, size(z, 1))], beside)
                  beside = abs(beside - slope(:, j))
                  where (ieee_is_finite(beside)) allowed = max(allowed, beside)
               end do
            end if
         end associate
         ratio(:, j) = abs(found(:, j) - slope(:, j))/max(allowed, tiny(1.0_wp))
      end do
   end subroutine find_residual

   !> Error of a step along a series, from its residual at the end; not a number if the right-hand
   !> side is not finite there.
   pure subroutine measure_residual(context, series, h, scale, error)
      !> The context of a step along the series
      type(step_context), intent(inout) :: context
      !> The series, with those of its delayed values
      type(taylor_series), intent(in) :: series
      !> Length of the step
      real(wp), intent(in) :: h
      !> Tolerance of each component
      real(wp), contiguous, intent(in) :: scale(:)
      !> The largest residual over the largest allowed
      real(wp), intent(out) :: error
      real(wp), dimension(size(scale), 1) :: found, ratio, slope
      real(wp) :: z(size(context%problem%lag), 1)

      call find_residual(context, series, h, scale, [1.0_wp], found, slope, z, ratio)
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (all(ieee_is_finite(ratio))) error = maxval(ratio)
   end subroutine measure_residual

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
      real(wp), dimension(size(scale), 2) :: found, ratio, slope
      real(wp) :: given, z(size(context%problem%lag), 2)
      character(len=:), allocatable :: name
      integer :: i, j

      wrong = 0
      call find_residual(context, series, h, scale, places, found, slope, z, ratio)
      if (.not. all(ieee_is_finite(ratio)) .or. all(ratio(:, 2) <= 1.0_wp)) return
      i = maxloc(ratio(:, 2), dim=1)
      associate (degree => series%degree, residual => abs(found(i, :) - slope(i, :)), &
                 t => context%cursor%t + h*places(2))
         wrong = 1 + max(0, min(degree - 1, nint(log(residual(2)/max(residual(1), tiny(1.0_wp))) &
                                                 /log(places(2)/places(1)))))
         name = merge("slow_series", "series     ", series%slow%holds)
         do j = 1, size(z, 1)
            associate (component => context%problem%component(j), &
                       time => t - context%problem%lag(j))
               if (elapsed(instant(time), context%past%origin) <= 0.0_wp) cycle
               given = series_value(degree, series%delayed%coefficients(:, j), &
                                    h*places(2)/series%unit)
               if (abs(given - z(j, 2)) <= allowance*degree*scale(component)) cycle
               call raise(error, "integrate: past_series: component "//text(component)//" is " &
                          //text(given)//" at t = "//text(time)//", history gives " &
                          //text(z(j, 2))//"; the same expected, or a jump in break_at")
               return
            end associate
         end do
         call raise(error, "integrate: "//trim(name)//": the slope of component "//text(i)//" is " &
                    //text(found(i, 2))//" at t = "//text(t)//", rhs gives "//text(slope(i, 2)) &
                    //"; the same expected (wrong from about coefficient "//text(wrong)//" on)")
      end associate
   end subroutine find_wrong
end module dde_series_check
