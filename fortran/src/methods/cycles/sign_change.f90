! SPDX-License-Identifier: BSD-3-Clause
!> A change of sign of a function whose evaluation may fail, narrowed by the secant method with the
!> Illinois rule: Dowell and Jarratt (1971), BIT 11, 168. The caller evaluates the function.
module sign_change
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: sign_change_type

   !> Two places with different signs of the function.
   type :: sign_change_type
      !> Places
      real(wp) :: places(2) = [0.0_wp, 1.0_wp]
      !> Values there
      real(wp) :: values(2) = 0.0_wp
      !> Which of the two places was replaced last; 0 at first
      integer, private :: last = 0
   contains
      procedure :: next, narrow
   end type sign_change_type

contains

   !> Where the line through both points is zero.
   pure real(wp) function next(self) result(place)
      class(sign_change_type), intent(in) :: self

      associate (x => self%places, f => self%values)
         place = x(1) + (x(2) - x(1))*f(1)/(f(1) - f(2))
      end associate
   end function next

   !> Replace the place with the same sign by a new one.
   pure subroutine narrow(self, place, value, moved)
      class(sign_change_type), intent(inout) :: self
      real(wp), intent(in) :: place, value
      !> Distance from the place that is replaced
      real(wp), intent(out) :: moved
      integer :: side

      side = merge(1, 2, value*self%values(1) > 0.0_wp)
      moved = abs(place - self%places(side))
      self%places(side) = place
      self%values(side) = value
      ! otherwise the other end might never move
      if (side == self%last) self%values(3 - side) = 0.5_wp*self%values(3 - side)
      self%last = side
   end subroutine narrow
end module sign_change
