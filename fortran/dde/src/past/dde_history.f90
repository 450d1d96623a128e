!> The past: the polynomials of accepted steps for the delayed components only, in a ring that
!> forgets what no delay can reach any more; before the first instant, the problem's own history.
!> Here as Taylor series, which one step reads for all of its length.
module dde_history
   use dde_interpolant, only: newton_value, series_value, taylor_coefficients
   use dde_past_values, only: past_values
   use dde_problem, only: dde_problem_type
   use dde_time, only: elapsed, instant
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: history_type

   !> Part of a step that rounding may hide.
   real(wp), parameter :: hidden = 4.0_wp*epsilon(1.0_wp)
   !> What is left of a step need not be read, in units of the next: the next series, carried back,
   !> serves as well, and steps of rounding size would not end.
   real(wp), parameter :: negligible = 1.0e-3_wp
   !> Length of a layer that may be passed over, in units of the step that is expected.
   real(wp), parameter :: thin = 0.01_wp
   !> How far, in units of the tolerance, a series may depart from the past that it stands for.
   real(wp), parameter :: agreement = 0.5_wp

   !> The past of one integration.
   type, extends(past_values) :: history_type
      !> What the series of each delayed value passed over: time times difference
      real(wp), allocatable, private :: passed_over(:)
      !> Step that each delayed value would be read from if none were passed over
      integer(int64), allocatable, private :: first(:)
   contains
      !> Taylor series of the delayed values from the start of the current step on
      procedure :: series
      !> How long these agree with the past
      procedure :: confirm
   end type history_type

   interface history_type
      module procedure :: new_history
   end interface history_type

contains

   !> An empty past that begins at `origin`.
   pure function new_history(problem, origin) result(past)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant of the integration
      type(instant), intent(in) :: origin
      type(history_type) :: past

      past%past_values = past_values(problem, origin)
      allocate (past%passed_over(size(problem%lag)), past%first(size(problem%lag)))
   end function new_history

   !> Taylor series of the delayed values from the start of the current step on.
   pure subroutine series(self, problem, passing, unit, z, serves)
      !> The past, facing this step
      class(history_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Whether a series may be that of a later step than the first to read, carried back
      logical, intent(in) :: passing
      !> Unit of time of the powers, shortened to what the series serve: powers of it over the
      !> length of a very short step must not overflow
      real(wp), intent(inout) :: unit
      !> Coefficients, shape (0:degree, size(problem%lag))
      real(wp), contiguous, intent(out) :: z(0:, :)
      !> How long they serve
      real(wp), intent(out) :: serves
      real(wp) :: place
      integer :: k, slot

      serves = huge(1.0_wp)
      do k = 1, size(z, 2)
         if (self%before_origin(k)) cycle
         call point_at_start(self, k)
         self%first(k) = self%found(k)
         if (passing) call look_beyond(self, k, thin*unit)
         serves = min(serves, self%serves(self%slot(k)) - self%offset(k))
      end do
      unit = min(unit, serves)
      do k = 1, size(z, 2)
         self%passed_over(k) = 0.0_wp
         if (self%before_origin(k)) then
            call problem%past_series(self%time_before(problem%lag(k), 0.0_wp), &
                                     problem%component(k), unit, z(:, k))
         else
            slot = self%slot(k)
            place = self%offset(k)/self%length(slot)
            if (abs(place) < hidden) place = 0.0_wp
            call taylor_coefficients(self%degree(slot), self%nodes(:, slot), self%powers(slot), &
                                     self%coefficients(:, self%row(k), slot), place, &
                                     unit/self%length(slot), z(:, k))
            if (self%found(k) > self%first(k)) then
               self%passed_over(k) = integral_passed(self, k, self%first(k), z(0, k))
            end if
         end if
      end do
   end subroutine series

   !> Let delayed value k read a later step: the first that is not much shorter than what is
   !> expected, where a transient has left very short ones; and the next where it begins nearer,
   !> unless there is a kink between them.
   pure subroutine look_beyond(self, k, most)
      !> The past
      class(history_type), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> How long very short steps, and all of them together, are at most
      real(wp), intent(in) :: most
      real(wp) :: ahead
      integer(int64) :: first

      if (self%found(k) == self%newest) return
      associate (slot => self%slot(k))
         ahead = self%length(slot) - self%offset(k)
         if (ahead > most) then
            if (ahead < self%offset(k) .and. self%serves(slot) > self%length(slot)) then
               call self%point_at(k, self%found(k) + 1)
            end if
            return
         end if
      end associate
      first = self%found(k)
      do
         if (self%found(k) == self%newest .or. -self%offset(k) > most) then
            call self%point_at(k, first)
            return
         end if
         call self%point_at(k, self%found(k) + 1)
         if (self%length(self%slot(k)) > most) exit
      end do
   end subroutine look_beyond

   !> Integral of what delayed value k is not read from, less what is read in its place.
   pure function integral_passed(self, k, first, read) result(integral)
      !> The past
      class(history_type), intent(in) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> The first step that it is not read from
      integer(int64), intent(in) :: first
      !> The value that is read where the current step starts
      real(wp), intent(in) :: read
      real(wp) :: integral, offset
      integer(int64) :: step
      integer :: slot

      slot = self%slot_of(first)
      offset = elapsed(self%start(slot), self%delayed_start(k))
      integral = (self%length(slot) - offset) &
                 *abs(newton_value(self%degree(slot), self%nodes(:, slot), &
                                   self%coefficients(:, self%row(k), slot), &
                                   offset/self%length(slot)) - read)
      do step = first + 1, self%found(k) - 1
         slot = self%slot_of(step)
         integral = integral + self%length(slot)*abs(self%coefficients(0, self%row(k), slot) - read)
      end do
   end function integral_passed

   !> How long the series of delayed values are used: as far as they agree with the past. A step
   !> reads its past from one series, though other steps than the one this comes from may have
   !> followed. No use at all of those that passed over a layer whose integral counts.
   pure subroutine confirm(self, z, unit, tolerance, h)
      !> The past, facing this step
      class(history_type), intent(inout) :: self
      !> Coefficients of the series, as `series` gave them
      real(wp), contiguous, intent(in) :: z(0:, :)
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Length of the step: proposed, then possible
      real(wp), intent(inout) :: h
      real(wp) :: actual, difference, own
      integer :: k

      do k = 1, size(z, 2)
         if (self%before_origin(k) .or. self%found(k) == self%newest) cycle
         own = self%length(self%slot(k)) - self%offset(k)
         do while (h > own)
            call read_ahead(self, k, h, actual)
            difference = abs(series_value(ubound(z, 1), z(:, k), h/unit) - actual) &
                         /(agreement*tolerance%of_component(self%kept(self%row(k)), actual))
            if (difference <= 1.0_wp) exit
            h = max(own, 0.9_wp*h/difference**(1.0_wp/ubound(z, 1)))
         end do
      end do
      do k = 1, size(z, 2)
         actual = agreement*tolerance%of_component(self%kept(self%row(k)), z(0, k))
         if (self%passed_over(k) > actual*h) h = 0.0_wp
      end do
   end subroutine confirm

   !> One delayed value at one place ahead.
   pure subroutine read_ahead(self, k, ahead, z)
      !> The past
      class(history_type), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k
      !> Time since the start of the current step
      real(wp), intent(in) :: ahead
      !> The delayed value there
      real(wp), intent(out) :: z
      integer :: slot

      do while (self%offset(k) + ahead < 0.0_wp)
         call self%point_at(k, self%found(k) - 1)
      end do
      do
         slot = self%slot(k)
         if (self%offset(k) + ahead <= self%length(slot) .or. self%found(k) == self%newest) exit
         call self%point_at(k, self%found(k) + 1)
      end do
      z = newton_value(self%degree(slot), self%nodes(:, slot), &
                       self%coefficients(:, self%row(k), slot), &
                       (self%offset(k) + ahead)/self%length(slot))
   end subroutine read_ahead

   !> Let delayed value k read the step in which the current one's start is, less its delay, or the
   !> next where that is about to end.
   pure subroutine point_at_start(self, k)
      !> The past
      class(history_type), intent(inout) :: self
      !> Which delayed value
      integer, intent(in) :: k

      do while (self%offset(k) < 0.0_wp .and. self%found(k) > self%oldest)
         call self%point_at(k, self%found(k) - 1)
      end do
      do while (self%found(k) < self%newest)
         if (self%length(self%slot(k)) - self%offset(k) &
             > negligible*self%length(self%slot_of(self%found(k) + 1))) exit
         call self%point_at(k, self%found(k) + 1)
      end do
   end subroutine point_at_start
end module dde_history
