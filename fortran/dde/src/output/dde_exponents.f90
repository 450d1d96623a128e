! SPDX-License-Identifier: BSD-3-Clause
!> How far the exponents of the exponential terms of f move in a step. Where |a| is large exp(a) or
!> exp(-a) vanishes in the rounding of other terms, and a step that ends beyond a switch, or holds a
!> pulse between its stages, looks as accurate as one without. The exponents themselves are as
!> smooth as the solution: three places of a step show how far each of them comes.
module dde_exponents
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: exponent_watch

   !> Places of the step at which they are taken: a parabola through the values bounds an exponent.
   real(wp), parameter :: places(3) = [0.0_wp, 0.5_wp, 1.0_wp]
   !> A term below exp(-hidden) of the tolerance is not seen.
   real(wp), parameter :: hidden = 5.0_wp
   !> Largest change of an exponent in a step, as far as its term is seen.
   real(wp), parameter :: most_change = 10.0_wp
   !> Exponents beyond this are ignored: their sums may overflow.
   real(wp), parameter :: farthest = 0.1_wp*huge(1.0_wp)
   !> Uncertainty of a bound, over the second difference.
   real(wp), parameter :: uncertain = 0.125_wp

   !> The exponents over a step.
   type :: exponent_watch
      !> Whether those at its start are known
      logical :: begun = .false.
      !> Exponents at the places of the step, shape (exponentials, places)
      real(wp), allocatable, private :: a(:, :)
      !> State in the middle, and delayed values
      real(wp), allocatable, private :: middle(:), z(:, :)
   contains
      procedure :: judge, advance
   end type exponent_watch

contains

   !> Reject a step in which an exponent moves by so much that its term may have been missed.
   pure subroutine judge(self, context, step, error)
      class(exponent_watch), intent(inout) :: self
      !> The context of a step that is within the tolerance otherwise
      type(step_context), intent(inout) :: context
      !> The step
      class(step_type), intent(in) :: step
      !> Error of the step in units of the tolerance
      real(wp), intent(inout) :: error
      real(wp) :: far
      integer :: k

      associate (problem => context%problem)
         if (.not. allocated(self%a)) then
            allocate (self%a(problem%exponentials, 3), self%z(size(problem%lag), 1))
            allocate (self%middle(problem%n))
         end if
         if (.not. self%begun) call find_exponents(self, context, step, 1, step%y)
         call step%state_at(places(2), self%middle)
         call find_exponents(self, context, step, 2, self%middle)
         call find_exponents(self, context, step, 3, step%y_new)
         self%begun = .true.
         far = hidden - log(context%tolerance%level)
         do k = 1, problem%exponentials
            if (change(self%a(k, :), far) > most_change) error = huge(1.0_wp)
         end do
      end associate
   end subroutine judge

   !> Exponents at place number j.
   pure subroutine find_exponents(self, context, step, j, y)
      class(exponent_watch), intent(inout) :: self
      type(step_context), intent(inout) :: context
      class(step_type), intent(in) :: step
      integer, intent(in) :: j
      !> State there
      real(wp), contiguous, intent(in) :: y(:)

      associate (problem => context%problem, time => step%h*places(j))
         if (problem%delayed_exponents) then
            call step%delayed_at(problem, context%past, context%cursor, time, self%z)
         end if
         call problem%exponents(context%cursor%inside(step%t + time), y, self%z(:, 1), self%a(:, j))
      end associate
   end subroutine find_exponents

   !> Go to the end of an accepted step.
   pure subroutine advance(self, smooth)
      class(exponent_watch), intent(inout) :: self
      !> Whether delayed values do not jump there
      logical, intent(in) :: smooth

      self%begun = self%begun .and. smooth
      if (self%begun) self%a(:, 1) = self%a(:, 3)
   end subroutine advance

   !> Change of an exponent within -far and far, from its values at the places.
   pure function change(a, far) result(value)
      real(wp), intent(in) :: a(3), far
      real(wp) :: value
      real(wp) :: bend, extreme, least, most, rise, s

      value = 0.0_wp
      if (.not. all(abs(a) < farthest)) return
      bend = a(1) - 2.0_wp*a(2) + a(3)
      rise = 4.0_wp*a(2) - 3.0_wp*a(1) - a(3)
      extreme = a(2)
      if (abs(rise) < 4.0_wp*abs(bend)) then
         s = -0.25_wp*rise/bend
         if (s > 0.0_wp) extreme = a(1) + 0.5_wp*s*rise
      end if
      least = min(extreme, minval(a)) - uncertain*abs(bend)
      most = max(extreme, maxval(a)) + uncertain*abs(bend)
      value = max(-far, min(far, most)) - max(-far, min(far, least))
   end function change
end module dde_exponents
