! SPDX-License-Identifier: BSD-3-Clause
!> How far a Taylor series is valid, and the series of a slow solution, which is valid farther. On a
!> slow solution fast components are in balance with the others, so that their rates do not limit
!> the step size. The difference between state and slow solution is at most the tolerance.
module dde_slow_series
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: least_balance, series_reach, slow_series

   !> Factor below the time at which the last two terms reach the tolerance, for the terms left out.
   real(wp), parameter :: share = 0.9_wp
   !> Largest reach: its powers must not overflow.
   real(wp), parameter :: farthest = 1.0e15_wp
   !> The relaxation rate limits a series of the state whose reach exceeds this many times one over
   !> the rate.
   real(wp), parameter :: limited = 3.0_wp
   !> Least reach of a slow series in the same units: it is asymptotic.
   real(wp), parameter :: least_balance = 20.0_wp
   !> Largest distance of a state from the balance, in units of the tolerance.
   real(wp), parameter :: transient = 1.0_wp
   !> Largest remaining error of the iteration, in units of the tolerance.
   real(wp), parameter :: left_open = 0.01_wp
   !> Most iterations.
   integer, parameter :: most_iterations = 6
   !> Most limited steps between two searches.
   integer, parameter :: most_patience = 7

   !> Whether there is a slow series near the solution, and when to search for it.
   type :: slow_series
      !> Whether the last step used it
      logical :: holds = .false.
      !> How far it reaches, in units of its powers
      real(wp) :: reach = 0.0_wp
      !> Limited steps since the last search, and how many pass until the next
      integer, private :: waited = 0, patience = 0
      !> Change of the coefficients by an iteration, shape (0:degree, n), and the state, shape (n)
      real(wp), allocatable, private :: change(:, :), state(:)
   contains
      procedure :: decide_search, find, forget, give_up
   end type slow_series

contains

   !> Whether to search in this step. The relaxation rate must limit it, and searches become rarer
   !> after each one that failed.
   pure subroutine decide_search(self, measure, value)
      class(slow_series), intent(inout) :: self
      !> How far the series of the state reaches, times the relaxation rate
      real(wp), intent(in) :: measure
      logical, intent(out) :: value

      value = .false.
      if (measure <= limited) return
      value = self%waited >= self%patience
      self%waited = merge(0, self%waited + 1, value)
      if (value) self%patience = min(2*self%patience + 1, most_patience)
   end subroutine decide_search

   !> Search in the next limited step: earlier ones show nothing of those from here on.
   pure subroutine forget(self)
      class(slow_series), intent(inout) :: self

      self%waited = self%patience
   end subroutine forget

   !> Leave a slow series that the right-hand side does not confirm.
   pure subroutine give_up(self)
      class(slow_series), intent(inout) :: self

      self%holds = .false.
      self%waited = 0
      self%patience = most_patience
   end subroutine give_up

   !> Iterate from the state. The series holds if it converges to the tolerance over its reach and
   !> if the state is that near to it.
   pure subroutine find(self, context, t, unit, degree, z, scale, rate, y)
      class(slow_series), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(context%problem%lag)), scale(context%problem%n), rate
      !> Coefficients, of which y(0, :) is given, the state; the slow series if it holds
      real(wp), intent(inout) :: y(0:degree, context%problem%n)
      real(wp) :: distance, open
      integer :: iteration, k

      self%holds = .false.
      if (.not. allocated(self%state)) then
         allocate (self%change(0:degree, size(scale)), self%state(size(scale)))
      end if
      self%state = y(0, :)
      y(1:, :) = 0.0_wp
      do iteration = 1, most_iterations
         self%change = y
         call context%problem%slow_series(t, unit, degree, z, y)
         context%work%evaluations = context%work%evaluations + 1
         call series_reach(degree, y, scale, self%reach)
         if (.not. self%reach*unit*rate >= least_balance) return
         self%change = y - self%change
         ! change by the next iteration, from that by the last one: w'/rate
         do k = 0, degree - 1
            self%change(k, :) = (k + 1)/(unit*rate)*self%change(k + 1, :)
         end do
         self%change(degree, :) = 0.0_wp
         open = largest_term(degree, size(scale), self%change, scale, self%reach)
         distance = maxval(abs(y(0, :) - self%state)/scale)
         if (distance <= transient + 2*open) then
            if (open < left_open) exit
         else if (iteration > 1) then
            ! the first iteration has no w', which disturbances of 1/rate are proportional to;
            ! a limited step reduces the distance by `limited` e-foldings at least
            self%patience = min(int(log(distance)/limited), self%patience)
            return
         end if
      end do
      self%holds = open < left_open
      if (.not. self%holds) return
      self%waited = 0
      self%patience = 0
   end subroutine find

   !> Largest term of several series at s, in units of their scales.
   pure real(wp) function largest_term(degree, n, coefficients, scale, s) result(largest)
      integer, intent(in) :: degree, n
      real(wp), intent(in) :: coefficients(0:degree, n), scale(n), s
      real(wp) :: power
      integer :: i, k

      largest = 0.0_wp
      do i = 1, n
         largest = max(largest, abs(coefficients(0, i))/scale(i))
         power = 1.0_wp
         do k = 1, degree
            power = power*s
            ! a power over the scale may overflow
            largest = max(largest, power*abs(coefficients(k, i))/scale(i))
         end do
      end do
   end function largest_term

   !> How far the series is valid, in units of the powers: the last two terms are within the
   !> tolerance there, and terms do not grow. Growing terms would exceed the tolerance later even if
   !> they are very small.
   pure subroutine series_reach(degree, coefficients, scale, reach)
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients, one series a component
      real(wp), contiguous, intent(in) :: coefficients(0:, :)
      !> Tolerance of each component
      real(wp), contiguous, intent(in) :: scale(:)
      !> How far; 0 if they are not finite
      real(wp), intent(out) :: reach
      real(wp) :: growth, last(0:2)
      integer :: i, k

      reach = 0.0_wp
      do i = 1, size(scale)
         reach = reach + (coefficients(degree - 1, i) + coefficients(degree, i))
      end do
      if (.not. ieee_is_finite(reach)) then
         reach = 0.0_wp
         return
      end if
      last = tiny(1.0_wp)
      do i = 1, size(scale)
         do k = 0, 2
            last(k) = max(last(k), abs(coefficients(degree - 2 + k, i))/scale(i))
         end do
      end do
      reach = exp(-max(log(last(1))/(degree - 1), log(last(2))/degree))
      growth = huge(1.0_wp)
      ! one term may vanish by chance; if others are at the floor, nothing is known
      if (last(2) > tiny(1.0_wp) .and. max(last(0), last(1)) > tiny(1.0_wp)) then
         growth = max(last(1)/last(2), sqrt(last(0)/last(2)))
      end if
      reach = share*min(reach, growth, farthest)
   end subroutine series_reach
end module dde_slow_series
