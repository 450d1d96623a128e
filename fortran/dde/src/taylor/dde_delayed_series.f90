! SPDX-License-Identifier: BSD-3-Clause
!> The delayed values over one step as Taylor series: the polynomials of the past, shifted to the
!> start of the step. Where many delays would make many short steps, each polynomial is one over
!> several steps of the past.
module dde_delayed_series
   use dde_interpolant, only: series_value
   use dde_past_fit, only: past_fit
   use dde_step_context, only: step_context
   use dde_time, only: elapsed
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: delayed_series

   !> The rest of a past step is not read if it is shorter than this share of the next. Otherwise a
   !> step of rounding size would follow. The polynomial of the next is as good there.
   real(wp), parameter :: negligible = 1.0e-3_wp
   !> Total length of past steps that may be skipped, over the expected length of the step.
   real(wp), parameter :: thin = 0.01_wp
   !> Largest difference between a series and the past that it stands for, over the tolerance.
   real(wp), parameter :: agreement = 0.5_wp
   !> Delayed values are fitted, over the expected length of the step and a little more, after the
   !> past made a step this many times shorter, for as long as fits make steps so much longer. In
   !> four chains of 10 to 100 blocks (`dde_chain_costs`) the values 1 and 1.5, and 1.3 and 4, take
   !> 0.97 to 1.06 times the instructions.
   real(wp), parameter :: expected = 1.2_wp, worth_a_fit = 2.0_wp
   !> The length of a fit is reduced by a power of its misfit, at most by the second factor. In the
   !> same chains the values 0.2 and 0.5, and 0.15 and 0.6, take 0.97 to 1.04 times as many.
   real(wp), parameter :: reducing_power = 0.33_wp, most_reduced = 0.3_wp

   !> The series of all delayed values.
   type :: delayed_series
      !> Coefficients, shape (0:degree, delayed values)
      real(wp), allocatable :: coefficients(:, :)
      !> Time from the start of the step for which all of them are valid
      real(wp) :: valid_for = 0.0_wp
      !> Whether the solution takes averages of them over the expected step: in a shorter one they
      !> may differ more from the past
      logical :: averaged = .true.
      !> Integral of the difference between the skipped past and the series, per delayed value
      real(wp), allocatable, private :: skipped(:)
      !> Number of the past step that each delayed value would read if none were skipped
      integer(int64), allocatable, private :: first(:)
      !> Time over which each delayed value is fitted, 0 if it is not
      real(wp), allocatable, private :: fitted(:)
      !> Whether the past makes steps short, and whether delayed values are fitted in this one
      logical, private :: cut = .false., fitting = .false.
      !> How they are fitted
      type(past_fit), allocatable, private :: fits
   contains
      procedure :: read_past, confirm, change_unit
   end type delayed_series

   interface delayed_series
      module procedure :: new_series
   end interface delayed_series

contains

   !> Storage.
   pure function new_series(degree, delays) result(series)
      integer, intent(in) :: degree, delays
      type(delayed_series) :: series

      allocate (series%coefficients(0:degree, delays))
      allocate (series%skipped(delays), series%first(delays))
      allocate (series%fitted(delays), source=0.0_wp)
   end function new_series

   !> Series of the delayed values from the start of the step on.
   pure subroutine read_past(self, context, skipping, unit)
      class(delayed_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      !> Whether very short past steps may be skipped
      logical, intent(in) :: skipping
      !> Unit of time of the powers. It is shortened to the time for which all are valid: powers of
      !> it over the length of a very short step must not overflow.
      real(wp), intent(inout) :: unit
      integer :: j, k

      associate (past => context%past, cursor => context%cursor, problem => context%problem)
         self%fitting = .false.
         if (self%cut) call fit_past(self, context, unit)
         if (.not. self%fitting) then
            call choose_steps(self, context, skipping, min(unit, cursor%h))
         end if
         unit = min(unit, self%valid_for)
         do k = 1, size(self%first)
            self%skipped(k) = 0.0_wp
            if (self%fitting .and. self%fitted(k) > 0.0_wp) then
               do j = 1, ubound(self%coefficients, 1)
                  self%coefficients(j, k) = (unit/self%fitted(k))**j*self%coefficients(j, k)
               end do
            else if (cursor%before_origin(k)) then
               call problem%past_series(cursor%time_before(past, problem%lag(k), 0.0_wp), &
                                        problem%component(k), unit, self%coefficients(:, k))
            else
               call past%series(cursor%step(k), k, cursor%offset(k), unit, self%coefficients(:, k))
               if (cursor%step(k) > self%first(k)) then
                  self%skipped(k) = skipped_integral(context, k, self%first(k), &
                                                     self%coefficients(0, k))
               end if
            end if
         end do
      end associate
   end subroutine read_past

   !> The past step that each delayed value reads.
   pure subroutine choose_steps(self, context, skipping, h)
      type(delayed_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      logical, intent(in) :: skipping
      !> Expected length of the step
      real(wp), intent(in) :: h
      real(wp) :: valid_for
      integer :: k

      self%valid_for = huge(1.0_wp)
      associate (past => context%past, cursor => context%cursor)
         do k = 1, size(self%first)
            if (cursor%before_origin(k)) then
               self%valid_for = min(self%valid_for, cursor%passes_origin(k))
               cycle
            end if
            call read_start(context, k)
            self%first(k) = cursor%step(k)
            if (skipping) call skip_short(context, k, thin*h)
            valid_for = past%validity_of(cursor%step(k)) - cursor%offset(k)
            if (.not. valid_for > 0.0_wp .and. cursor%step(k) < past%newest) then
               ! rounding hides the rest of this step, but not the start of the next
               valid_for = elapsed(cursor%delayed_start(k), past%start_of(cursor%step(k) + 1))
            end if
            self%valid_for = min(self%valid_for, valid_for)
         end do
      end associate
   end subroutine choose_steps

   !> Fit the delayed values whose past steps end before the step, if that is worth it.
   pure subroutine fit_past(self, context, unit)
      type(delayed_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      !> Expected length of the step
      real(wp), intent(in) :: unit
      real(wp) :: h, misfit, nearest
      integer :: k

      call choose_steps(self, context, .false., unit)
      associate (past => context%past, cursor => context%cursor)
         nearest = unit
         do k = 1, size(self%first)
            nearest = min(nearest, end_of(context, k))
         end do
         ! a step to a breaking point shows nothing of the past behind it
         self%cut = worth_a_fit*nearest < unit .or. cursor%h < unit
         self%fitted = 0.0_wp
         h = min(expected*unit, cursor%h)
         if (h < worth_a_fit*nearest) return
         if (.not. allocated(self%fits)) self%fits = past_fit(ubound(self%coefficients, 1))
         do k = 1, size(self%first)
            do
               if (end_of(context, k) >= h) exit
               self%fitted(k) = h
               call self%fits%fit(context, k, h, agreement*merge(unit/h, 1.0_wp, self%averaged), &
                                  self%coefficients(:, k), misfit)
               if (misfit <= 1.0_wp) exit
               self%fitted(k) = 0.0_wp
               h = h*max(most_reduced, 0.9_wp*misfit**(-reducing_power))
               self%cut = h >= worth_a_fit*nearest
               if (.not. self%cut) return
               if (.not. cursor%before_origin(k)) call cursor%read_from(past, k, self%first(k))
            end do
         end do
      end associate
      self%fitting = .true.
      self%valid_for = h
   end subroutine fit_past

   !> Time from the start of the step to the end of what delayed value k reads there.
   pure real(wp) function end_of(context, k) result(time)
      type(step_context), intent(in) :: context
      integer, intent(in) :: k

      associate (past => context%past, cursor => context%cursor)
         time = cursor%passes_origin(k)
         if (.not. cursor%before_origin(k)) then
            time = past%length_of(cursor%step(k)) - cursor%offset(k)
         end if
      end associate
   end function end_of

   !> Shorten a step to the length for which the series agree with the past. A step reads its past
   !> from one series, although the past may consist of several polynomials there. The length is 0
   !> if the skipped past differs by more than the tolerance.
   pure subroutine confirm(self, context, unit, h)
      class(delayed_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: unit
      !> Length of the step: proposed, then possible
      real(wp), intent(inout) :: h
      real(wp) :: actual, agreed, difference, time, wanted
      integer(int64) :: step
      integer :: k

      wanted = h
      h = min(h, self%valid_for)
      if (self%fitting) return
      associate (past => context%past, cursor => context%cursor, tolerance => context%tolerance, &
                 component => context%problem%component, z => self%coefficients)
         do k = 1, size(z, 2)
            if (cursor%before_origin(k) .or. cursor%step(k) == past%newest) cycle
            step = cursor%step(k)
            agreed = past%length_of(step) - cursor%offset(k)
            do while (h > agreed)
               time = h
               if (component(k) > context%problem%checked_components) then
                  call cursor%walk_to(past, k, h)
               else
                  ! at the end of each past step: a pulse may be over at the end of this one
                  call cursor%read_from(past, k, min(step + 1, past%newest))
                  if (cursor%step(k) < past%newest) then
                     time = min(h, past%length_of(cursor%step(k)) - cursor%offset(k))
                  end if
               end if
               actual = past%value(cursor%step(k), k, cursor%offset(k) + time)
               difference = abs(series_value(ubound(z, 1), z(:, k), time/unit) - actual) &
                            /(agreement*tolerance%of_component(component(k), actual))
               if (difference <= 1.0_wp) then
                  agreed = time
                  step = cursor%step(k)
               else
                  h = max(agreed, 0.9_wp*time/difference**(1.0_wp/ubound(z, 1)))
               end if
            end do
         end do
         do k = 1, size(z, 2)
            if (.not. self%skipped(k) > 0.0_wp) cycle
            actual = agreement*tolerance%of_component(component(k), z(0, k))
            if (self%skipped(k) > actual*h) h = 0.0_wp
         end do
      end associate
      if (h > 0.0_wp .and. worth_a_fit*h < wanted) self%cut = .true.
   end subroutine confirm

   !> Change the unit of time of the powers.
   pure subroutine change_unit(self, ratio)
      class(delayed_series), intent(inout) :: self
      !> The new unit over the old one
      real(wp), intent(in) :: ratio
      real(wp) :: power
      integer :: k

      power = 1.0_wp
      do k = 1, ubound(self%coefficients, 1)
         power = power*ratio
         self%coefficients(k, :) = power*self%coefficients(k, :)
      end do
   end subroutine change_unit

   !> Let delayed value k read the past step that holds its place at the start of the step, or the
   !> next one if that is about to end.
   pure subroutine read_start(context, k)
      type(step_context), intent(inout) :: context
      integer, intent(in) :: k

      associate (past => context%past, cursor => context%cursor)
         do while (cursor%offset(k) < 0.0_wp .and. cursor%step(k) > past%oldest)
            call cursor%read_from(past, k, cursor%step(k) - 1)
         end do
         do while (cursor%step(k) < past%newest)
            ! not the length less the offset: its rounding error may be many lengths of the next
            if (elapsed(cursor%delayed_start(k), past%start_of(cursor%step(k) + 1)) &
                > negligible*past%length_of(cursor%step(k) + 1)) exit
            call cursor%read_from(past, k, cursor%step(k) + 1)
         end do
      end associate
   end subroutine read_start

   !> Let delayed value k read a later past step. A transient leaves very short steps behind: these
   !> are skipped. Where no step is very short, the next one is read if its start is nearer than
   !> that of the present one and no kink lies between them.
   pure subroutine skip_short(context, k, most)
      type(step_context), intent(inout) :: context
      integer, intent(in) :: k
      !> Largest length of a very short step, and of all that are skipped together
      real(wp), intent(in) :: most
      real(wp) :: ahead, length
      integer(int64) :: first

      associate (past => context%past, cursor => context%cursor)
         if (cursor%step(k) == past%newest) return
         first = cursor%step(k)
         length = past%length_of(first)
         ahead = length - cursor%offset(k)
         if (ahead >= cursor%h) return
         if (ahead > most) then
            if (ahead < cursor%offset(k) .and. past%validity_of(first) > length) then
               call cursor%read_from(past, k, first + 1)
            end if
            return
         end if
         do
            if (cursor%step(k) == past%newest .or. -cursor%offset(k) > most) then
               call cursor%read_from(past, k, first)
               return
            end if
            call cursor%read_from(past, k, cursor%step(k) + 1)
            if (past%length_of(cursor%step(k)) > most) exit
         end do
      end associate
   end subroutine skip_short

   !> Integral of |skipped past - value that is read instead|.
   pure function skipped_integral(context, k, first, value) result(integral)
      type(step_context), intent(in) :: context
      integer, intent(in) :: k
      integer(int64), intent(in) :: first
      !> The value that is read at the start of the step
      real(wp), intent(in) :: value
      real(wp) :: integral, offset
      integer(int64) :: step

      associate (past => context%past, cursor => context%cursor)
         offset = elapsed(past%start_of(first), cursor%delayed_start(k))
         integral = (past%length_of(first) - offset)*abs(past%value(first, k, offset) - value)
         do step = first + 1, cursor%step(k) - 1
            integral = integral &
                       + past%length_of(step)*abs(past%value(step, k, 0.0_wp) - value)
         end do
      end associate
   end function skipped_integral
end module dde_delayed_series
