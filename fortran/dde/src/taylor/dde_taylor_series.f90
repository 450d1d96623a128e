! SPDX-License-Identifier: BSD-3-Clause
!> The Taylor series of the solution from the start of a step on, and the time for which it is
!> valid. It is the series of the state, or that of a slow solution near it.
module dde_taylor_series
   use dde_delayed_series, only: delayed_series
   use dde_interpolant, only: series_value
   use dde_problem, only: dde_problem_type
   use dde_slow_series, only: series_reach, slow_series
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: taylor_series

   !> Longest unit of the series of a state, in units of one over the relaxation rate: powers of it
   !> must not overflow.
   real(wp), parameter :: longest_unit = 1000.0_wp

   !> The series of all components.
   type :: taylor_series
      !> Degree
      integer :: degree = 0
      !> Unit of time of its powers
      real(wp) :: unit = 0.0_wp
      !> Time for which it is valid; 0 if it is not finite
      real(wp) :: reach = 0.0_wp
      !> Coefficients of the solution, shape (0:degree, n)
      real(wp), allocatable :: coefficients(:, :)
      !> Series of the delayed values
      type(delayed_series) :: delayed
      !> Coefficients of the series of the state during the search for a slow one, shape (0:degree,
      !> n)
      real(wp), allocatable, private :: of_state(:, :)
      !> Whether the series is that of a slow solution, and when to search for one
      type(slow_series) :: slow
   contains
      procedure :: expand, expand_state, slope_of, state
   end type taylor_series

   interface taylor_series
      module procedure :: new_series
   end interface taylor_series

contains

   !> Storage.
   pure function new_series(problem, degree) result(series)
      class(dde_problem_type), intent(in) :: problem
      integer, intent(in) :: degree
      type(taylor_series) :: series

      series%degree = degree
      allocate (series%coefficients(0:degree, problem%n))
      series%delayed = delayed_series(degree, size(problem%lag))
   end function new_series

   !> The slow series if it holds: the state is then moved onto the slow solution. Otherwise the
   !> series of the state.
   pure subroutine expand(self, context, t, scale, y)
      class(taylor_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: t
      real(wp), contiguous, intent(in) :: scale(:)
      real(wp), contiguous, intent(inout) :: y(:)
      real(wp) :: rate
      logical :: trying

      rate = context%problem%relaxation_rate(t, y)
      trying = self%slow%holds
      if (trying) call find_slow(self, context, t, scale, rate, y)
      if (self%slow%holds) return
      call self%expand_state(context, t, rate, y)
      context%work%evaluations = context%work%evaluations + 1
      call series_reach(self%degree, self%coefficients, scale, self%reach)
      self%reach = self%unit*self%reach
      if (trying) return
      call self%slow%decide_search(rate*self%reach, trying)
      if (.not. trying) return
      self%of_state = self%coefficients
      call find_slow(self, context, t, scale, rate, y)
      if (.not. self%slow%holds) self%coefficients = self%of_state
   end subroutine expand

   !> The series of the state.
   pure subroutine expand_state(self, context, t, rate, y)
      class(taylor_series), intent(inout) :: self
      type(step_context), intent(in) :: context
      real(wp), intent(in) :: t
      !> Relaxation rate
      real(wp), intent(in) :: rate
      real(wp), contiguous, intent(in) :: y(:)

      if (self%unit*rate > longest_unit) then
         call self%delayed%change_unit(longest_unit/rate/self%unit)
         self%unit = longest_unit/rate
      end if
      self%coefficients(0, :) = y
      call context%problem%series(t, self%unit, self%degree, self%delayed%coefficients, &
                                  self%coefficients)
   end subroutine expand_state

   !> Take the slow series if it holds.
   pure subroutine find_slow(self, context, t, scale, rate, y)
      class(taylor_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: t
      real(wp), contiguous, intent(in) :: scale(:)
      real(wp), intent(in) :: rate
      !> State; that on the slow solution
      real(wp), contiguous, intent(inout) :: y(:)

      self%coefficients(0, :) = y
      call self%slow%find(context, t, self%unit, self%degree, self%delayed%coefficients, scale, &
                          rate, self%coefficients)
      if (.not. self%slow%holds) return
      y = self%coefficients(0, :)
      self%reach = self%unit*self%slow%reach
   end subroutine find_slow

   !> The state at a time.
   pure subroutine state(self, time, y)
      class(taylor_series), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(out) :: y(:)
      integer :: i

      do i = 1, size(y)
         y(i) = series_value(self%degree, self%coefficients(:, i), time/self%unit)
      end do
   end subroutine state

   !> The slope of a component at a time.
   pure real(wp) function slope_of(self, i, time) result(value)
      class(taylor_series), intent(in) :: self
      !> Number of the component
      integer, intent(in) :: i
      real(wp), intent(in) :: time
      real(wp) :: s
      integer :: k

      value = self%coefficients(1, i)/self%unit
      ! at the start it is known even if later terms are not finite
      if (.not. time > 0.0_wp) return
      s = time/self%unit
      value = 0.0_wp
      do k = self%degree, 1, -1
         value = k*self%coefficients(k, i) + s*value
      end do
      value = value/self%unit
   end function slope_of
end module dde_taylor_series
