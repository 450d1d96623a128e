! SPDX-License-Identifier: BSD-3-Clause
!> Units of time and of states that a model itself gives, where no number of it is known to be of
!> order 1.
module natural_units
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde, only: find_jacobian, integration_options
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use tangent_problem, only: allocate_slopes
   implicit none (type, external)
   private
   public :: in_own_units

   !> The absolute tolerance of a state is at least the first share of its relative one and the
   !> second share, which is above rounding errors of a past, times its largest value so far. In the
   !> gallery of the Python package steps at 1e-9 are 0 to 15 % more than with the relative one, of
   !> Radau 0 to 32 %; without the second share Taylor steps of `lang_kobayashi` vanish.
   real(wp), parameter :: least_share = 1.0e-6_wp, rounding = 100.0_wp*epsilon(1.0_wp)

contains

   !> Options with tolerances and a unit of time by the start of a run, unless numbers of the model
   !> are of order 1. The unit of time is the longest delay there or, without one, the inverse of
   !> the fastest rate there; the size of a state is that of its value or of its change in this time
   !> or, where that is shorter, in its own.
   pure type(integration_options) function in_own_units(model, options, t, known) result(own)
      !> The model with its past
      class(model_type), intent(in) :: model
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Where the run starts, and known sizes: with these it does not matter what the model says
      real(wp), intent(in), optional :: t, known(:)
      real(wp) :: moving(model%moving), rate(model%n), sizes(model%n), slope(model%n), start

      own = options
      if (.not. (model%own_units .or. present(known))) return
      start = 0.0_wp
      if (present(t)) start = t
      associate (time => own%unit_of_time, n => model%n, y => model%past)
         sizes = abs(y)
         if (present(known)) sizes = max(sizes, known)
         call model%rhs(start, y, y(model%component), slope)
         where (.not. ieee_is_finite(slope)) slope = 0.0_wp
         rate = rates(model, start, y)
         moving = 0.0_wp
         if (size(moving) > 0) call model%moving_lags(start, y, moving)
         time = maxval([0.0_wp, model%lag(:size(model%lag) - size(moving)), moving])
         if (size(model%lag) == 0 .or. size(moving) > 0 .and. .not. time > 0.0_wp) then
            time = maxval(rate)
            if (.not. time > 0.0_wp) time = maxval(abs(slope)/sizes, mask=sizes > 0.0_wp)
            time = 1.0_wp/time
         end if
         if (.not. (time > 0.0_wp .and. ieee_is_finite(time))) time = 1.0_wp
         sizes = max(sizes, abs(slope)/max(1.0_wp/time, rate))
      end associate
      if (.not. any(sizes > 0.0_wp)) sizes = 1.0_wp
      where (.not. sizes > 0.0_wp) sizes = maxval(sizes)
      own%share_of_largest = max(least_share*options%relative, rounding)
      own%each_absolute = own%share_of_largest*sizes
   end function in_own_units

   !> How fast states change by themselves and in pairs: the largest root of a product of two
   !> elements of the Jacobian, in which units of states cancel.
   pure function rates(model, t, y) result(rate)
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rate(size(y))
      real(wp), allocatable :: by_y(:, :), by_z(:, :)
      integer :: band, i, j

      band = merge(min(model%lower, model%upper), model%n, model%lower >= 0)
      call allocate_slopes(model, by_y, by_z)
      call find_jacobian(model, t, y, y(model%component), by_y, by_z)
      rate = 0.0_wp
      do j = 1, model%n
         do i = max(1, j - band), min(model%n, j + band)
            if (model%lower >= 0) then
               rate(i) = max(rate(i), abs(by_y(1 + model%upper + i - j, j) &
                                          *by_y(1 + model%upper + j - i, i)))
            else
               rate(i) = max(rate(i), abs(by_y(i, j)*by_y(j, i)))
            end if
         end do
      end do
      rate = merge(sqrt(rate), 0.0_wp, ieee_is_finite(rate))
   end function rates
end module natural_units
