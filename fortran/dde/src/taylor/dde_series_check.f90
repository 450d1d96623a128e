!> Whether the series that a problem gives are those of its right-hand side and its history, seen at
!> the start of a run. Only gross differences are errors: values may differ by rounding.
module dde_series_check
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_errors, only: error_type, raise, text
   use dde_interpolant, only: series_value
   use dde_slow_series, only: series_reach
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: check_coefficients, check_past

   !> Relative difference of a wrong value.
   real(wp), parameter :: gross = 1.0e-3_wp
   !> Relative change of state and delayed values. It changes the right-hand side by more than
   !> rounding does.
   real(wp), parameter :: change = 1.0e-10_wp
   !> Places of the history that are compared, as shares of the time for which its series is valid
   !> or of the unit of its powers.
   real(wp), parameter :: of_reach = 0.1_wp, of_unit = 0.01_wp
   !> Largest departure from proportional differences.
   real(wp), parameter :: proportional = 0.1_wp

contains

   !> Refuse coefficients 1 that are not those of the right-hand side.
   pure subroutine check_coefficients(context, t, unit, y, z, slope, coefficients, error)
      !> The context of the first step
      type(step_context), intent(in) :: context
      !> Time, unit of time of the powers, state, delayed values and right-hand side
      real(wp), intent(in) :: t, unit, y(:), z(:), slope(:)
      !> Coefficients 1
      real(wp), intent(in) :: coefficients(:)
      !> The first that is wrong
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: slope_beside(:), y_beside(:), z_beside(:)
      real(wp) :: allowed
      integer :: i

      allocate (slope_beside(size(y)), y_beside(size(y)), z_beside(size(z)))
      ! changes of different sizes do not cancel
      do i = 1, size(y)
         y_beside(i) = y(i)*(1.0_wp - change*sin(real(i, wp))**2)
      end do
      do i = 1, size(z)
         z_beside(i) = z(i)*(1.0_wp - change*cos(real(i, wp))**2)
      end do
      call context%problem%rhs(t, y_beside, z_beside, slope_beside)
      do i = 1, size(y)
         allowed = abs(slope_beside(i) - slope(i)) + context%tolerance%of_component(i, y(i))/unit
         if (.not. differ(coefficients(i)/unit, slope(i), allowed)) cycle
         call raise(error, "integrate: series: coefficient 1 of component "//text(i) &
                    //" over unit is "//text(coefficients(i)/unit)//" at t = "//text(t) &
                    //", rhs gives "//text(slope(i))//"; the same expected")
         return
      end do
   end subroutine check_coefficients

   !> Refuse series of the past that are not those of the history. They are compared at their start
   !> and at two later times. There a difference is an error if it is proportional to time: that
   !> of a jump is not.
   pure subroutine check_past(context, unit, coefficients, error)
      !> The context of the first step
      type(step_context), intent(in) :: context
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Coefficients of the delayed values
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> The first that is wrong
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: difference(3), found(3), known(3), reach, span(3), t(3), tolerance
      integer :: i, k, place

      do k = 1, size(coefficients, 2)
         associate (degree => ubound(coefficients, 1), component => context%problem%component(k))
            t = context%cursor%time_before(context%past, context%problem%lag(k), 0.0_wp)
            known(1) = context%problem%history(t(1), component)
            found(1) = coefficients(0, k)
            tolerance = context%tolerance%of_component(component, known(1))
            place = merge(1, 0, differ(found(1), known(1), tolerance))
            if (place == 0 .and. ieee_is_finite(known(1)) &
                .and. all(ieee_is_finite(coefficients(:, k)))) then
               call series_reach(degree, coefficients(:, k:k), [tolerance], reach)
               t(2:) = t(1) + min(of_reach*reach, of_unit)*unit*[1.0_wp/3, 1.0_wp]
               span = t - t(1)
               do i = 2, 3
                  known(i) = context%problem%history(t(i), component)
                  found(i) = series_value(degree, coefficients(:, k), span(i)/unit)
               end do
               difference = (found - found(1)) - (known - known(1))
               if (differ(found(3) - found(1), known(3) - known(1), &
                          tolerance + change*abs(known(1))) .and. span(2) > 0.0_wp &
                   .and. abs(difference(3)*span(2) - difference(2)*span(3)) &
                   <= proportional*abs(difference(3))*span(2)) place = 3
            end if
            if (place == 0) cycle
            call raise(error, "integrate: past_series: component "//text(component)//" from t = " &
                       //text(t(1))//" on is "//text(found(place))//" at t = "//text(t(place)) &
                       //", history gives "//text(known(place))//"; the same expected")
            return
         end associate
      end do
   end subroutine check_past

   !> Whether two numbers differ grossly; a known one that is not finite is no error here.
   pure logical function differ(found, known, allowed) result(value)
      real(wp), intent(in) :: found, known
      !> Absolute difference that is allowed
      real(wp), intent(in) :: allowed

      value = .false.
      if (.not. (ieee_is_finite(known) .and. ieee_is_finite(allowed))) return
      value = .not. ieee_is_finite(found)
      if (value) return
      value = abs(found - known) > allowed + gross*max(abs(found), abs(known))
   end function differ
end module dde_series_check
