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
   public :: measure_residual, refuse_wrong

   !> A slope may be off by this many times degree tolerance/h: the term after the last one, at the
   !> tolerance, makes 1.
   real(wp), parameter :: allowance = 2.0_wp
   !> It may be off by this share of itself.
   real(wp), parameter :: rounding = 1.0e-13_wp
   !> It may be off by the change that the tolerance of state and delayed values makes. In one
   !> direction of these, changes cancelled once in 1e5 steps.
   integer, parameter :: directions = 3
   !> A first coefficient is refused if it is off by this many times what the tolerance makes: the
   !> series of delayed values may differ from them by some tolerances.
   real(wp), parameter :: refused = 100.0_wp
   !> Its error counts over the reach of the series, at most this many steps.
   real(wp), parameter :: longest = 1000.0_wp
   !> Largest ratio of a residual: it must not overflow.
   real(wp), parameter :: most = 1.0e100_wp

contains

   !> Error of a step along a series: the largest residual at one time of it, over the largest that
   !> is allowed. It is not a number if the right-hand side is not finite there.
   pure subroutine measure_residual(context, series, time, span, scale, y, z, slope, worst, error)
      !> The context of a step along the series
      type(step_context), intent(inout) :: context
      !> The series, with those of its delayed values
      type(taylor_series), intent(in) :: series
      !> Time along the series, and the time over which the residual makes an error
      real(wp), intent(in) :: time, span
      !> Tolerance of each component, and state then
      real(wp), contiguous, intent(in) :: scale(:), y(:)
      !> Delayed values and right-hand side then
      real(wp), contiguous, intent(inout) :: z(:, :), slope(:)
      !> The component with this residual
      integer, intent(out) :: worst
      real(wp), intent(out) :: error
      real(wp), allocatable :: of_tolerance(:)
      real(wp) :: allowed, ratio, residual, t
      integer :: i

      call context%delayed_values([time], z)
      t = context%cursor%inside(context%cursor%t + time)
      call context%problem%rhs(t, y, z(:, 1), slope)
      do
         error = 0.0_wp
         worst = 1
         do i = 1, min(size(y), context%problem%checked_components)
            residual = abs(series%slope_of(i, time) - slope(i))
            if (.not. ieee_is_finite(residual)) then
               error = ieee_value(1.0_wp, ieee_quiet_nan)
               return
            end if
            allowed = allowance*series%degree*scale(i)/span + rounding*abs(slope(i))
            if (allocated(of_tolerance)) allowed = max(allowed, of_tolerance(i))
            ratio = over(residual, allowed)
            if (ratio <= error) cycle
            error = ratio
            worst = i
         end do
         if (error <= 1.0_wp .or. allocated(of_tolerance)) return
         of_tolerance = change_of_slope(context, scale, t, y, z(:, 1), slope)
      end do
   end subroutine measure_residual

   !> Change of the right-hand side that the tolerance of state and delayed values makes.
   pure function change_of_slope(context, scale, t, y, z, slope) result(change)
      type(step_context), intent(in) :: context
      real(wp), intent(in) :: t
      real(wp), contiguous, intent(in) :: scale(:), y(:), z(:), slope(:)
      real(wp), allocatable :: beside(:), change(:), of_past(:)
      integer :: i, j

      allocate (beside(size(y)), change(size(y)))
      associate (component => context%problem%component, tolerance => context%tolerance)
         of_past = [(tolerance%of_component(component(i), z(i)), i=1, size(z))]
      end associate
      change = 0.0_wp
      do j = 1, directions
         call context%problem%rhs(t, y + scale*[(sin(real(i*j, wp)), i=1, size(y))], &
                                  z + of_past*[(cos(real(i*j, wp)), i=1, size(z))], beside)
         where (ieee_is_finite(beside)) change = max(change, abs(beside - slope))
      end do
   end function change_of_slope

   !> A residual over the largest that is allowed, which may be 0.
   elemental function over(residual, allowed) result(ratio)
      real(wp), intent(in) :: residual, allowed
      real(wp) :: ratio

      ratio = most
      if (residual/most <= allowed) ratio = residual/max(allowed, tiny(1.0_wp))
   end function over

   !> Refuse a series of which the first coefficient is wrong, or in two attempts another one or a
   !> delayed value. The first one is compared with the right-hand side; others show in the ratio of
   !> residuals at two places of a step that was rejected: what is left out grows as the last power.
   pure subroutine refuse_wrong(context, series, h, scale, suspect, error)
      type(step_context), intent(inout) :: context
      type(taylor_series), intent(in) :: series
      real(wp), intent(in) :: h
      real(wp), contiguous, intent(in) :: scale(:)
      !> The first coefficient that was wrong in the attempt before, the number of a delayed value
      !> with another sign, or 0; replaced by that of this attempt
      integer, intent(inout) :: suspect
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: found, given, of_series, ratio, residual, slope(size(scale)), time, &
                  y(size(scale)), z(size(context%problem%lag), 1)
      integer :: before, i, ignored, j

      before = suspect
      suspect = 0
      if (series%slow%holds .or. .not. series%reach > 0.0_wp) return
      time = 0.0_wp
      call series%state(time, y)
      call measure_residual(context, series, time, min(series%reach, longest*h), scale, y, z, &
                            slope, i, ratio)
      if (ratio > refused) then
         suspect = 1
      else
         time = 0.5_wp*h
         call series%state(time, y)
         call measure_residual(context, series, time, h, scale, y, z, slope, i, ratio)
         if (.not. ratio > 1.0_wp) return
      end if
      found = series%slope_of(i, time)
      given = slope(i)
      do j = 1, size(z, 1)
         associate (component => context%problem%component(j), &
                    t => context%cursor%t + time - context%problem%lag(j))
            if (elapsed(instant(t), context%past%origin) <= 0.0_wp) cycle
            of_series = series_value(series%degree, series%delayed%coefficients(:, j), &
                                     time/series%unit)
            if (abs(of_series - z(j, 1)) <= scale(component)) cycle
            suspect = -j
            if (suspect /= before) return
            call raise(error, "integrate: past_series: component "//text(component)//" is " &
                       //text(of_series)//" at t = "//text(t)//", history gives " &
                       //text(z(j, 1))//"; the same expected, or a jump in break_at")
            return
         end associate
      end do
      if (suspect == 0) then
         residual = abs(found - given)
         call series%state(0.5_wp*time, y)
         call measure_residual(context, series, 0.5_wp*time, h, scale, y, z, slope, ignored, ratio)
         residual = residual/max(abs(series%slope_of(i, 0.5_wp*time) - slope(i)), tiny(1.0_wp))
         suspect = 1 + nint(log(residual)/log(2.0_wp))
         if (suspect < 2 .or. suspect > series%degree/2) suspect = 0
         if (suspect == 0 .or. suspect /= before) return
      end if
      call raise(error, "integrate: series: the slope of component "//text(i)//" is " &
                 //text(found)//" at t = "//text(context%cursor%t + time)//", rhs gives " &
                 //text(given)//"; the same expected (wrong from about coefficient " &
                 //text(suspect)//" on)")
   end subroutine refuse_wrong
end module dde_series_check
