! SPDX-License-Identifier: BSD-3-Clause
!> The tolerance of one step, absolute(i) + relative(i) |y(i)| for component i, and the norm in
!> which errors are measured.
module dde_tolerance
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: all_finite, hopeless, scaled_norm, tolerance_type

   !> Bounds of `level`: a smaller tolerance is below rounding, a larger one asks for no digit.
   real(wp), parameter :: least_level = epsilon(1.0_wp), most_level = 1.0_wp
   !> Elements above this many scales may overflow when divided by them: the norm is huge.
   real(wp), parameter :: hopeless = 1.0e100_wp

   !> The tolerance of all components.
   type :: tolerance_type
      !> Relative and absolute tolerance, shape (n)
      real(wp), allocatable :: relative(:), absolute(:)
      !> The strictest relative tolerance above 0, which has no unit: orders and bounds of errors
      !> follow from it. Where all are 0 it is the strictest absolute one, as for a state of size 1.
      real(wp) :: level = 0.0_wp
      !> Least absolute tolerance over the largest value so far
      real(wp) :: share_of_largest = 0.0_wp
   contains
      procedure, non_overridable :: scale, of_component, take_in
   end type tolerance_type

   interface tolerance_type
      module procedure :: new_tolerance
   end interface tolerance_type

contains

   !> Scalars hold for all components, lists for one each.
   pure function new_tolerance(n, relative, absolute, each_relative, each_absolute) &
      result(tolerance)
      integer, intent(in) :: n
      real(wp), intent(in) :: relative, absolute
      real(wp), intent(in), optional :: each_relative(:), each_absolute(:)
      type(tolerance_type) :: tolerance

      allocate (tolerance%relative(n), source=relative)
      allocate (tolerance%absolute(n), source=absolute)
      if (present(each_relative)) tolerance%relative = each_relative
      if (present(each_absolute)) tolerance%absolute = each_absolute
      tolerance%level = minval(tolerance%relative, mask=tolerance%relative > 0.0_wp)
      if (.not. any(tolerance%relative > 0.0_wp)) tolerance%level = minval(tolerance%absolute)
      tolerance%level = min(most_level, max(least_level, tolerance%level))
   end function new_tolerance

   !> Tolerances for a state.
   pure subroutine scale(self, y, values)
      class(tolerance_type), intent(in) :: self
      real(wp), contiguous, intent(in) :: y(:)
      !> Tolerance of each component, shape (n)
      real(wp), contiguous, intent(out) :: values(:)

      values = self%absolute + self%relative*abs(y)
   end subroutine scale

   !> Take in values of a state.
   pure subroutine take_in(self, y)
      class(tolerance_type), intent(inout) :: self
      real(wp), contiguous, intent(in) :: y(:)

      if (self%share_of_largest > 0.0_wp) then
         self%absolute = max(self%absolute, self%share_of_largest*abs(y))
      end if
   end subroutine take_in

   !> Tolerance of one component.
   pure real(wp) function of_component(self, i, value) result(tolerance)
      class(tolerance_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), intent(in) :: value

      tolerance = self%absolute(i) + self%relative(i)*abs(value)
   end function of_component

   !> The largest |x|/scale. It is huge if an element is above `hopeless` scales and not a number if
   !> one is not finite.
   pure function scaled_norm(n, x, scale) result(norm)
      !> Number of elements
      integer, intent(in) :: n
      !> Elements
      real(wp), intent(in) :: x(n)
      !> Scales of the elements, > 0
      real(wp), intent(in) :: scale(n)
      real(wp) :: norm
      integer :: i

      if (.not. all_finite(n, x)) then
         norm = ieee_value(1.0_wp, ieee_quiet_nan)
         return
      end if
      norm = 0.0_wp
      do i = 1, n
         if (abs(x(i))*(1.0_wp/hopeless) > scale(i)) then
            norm = huge(1.0_wp)
         else
            norm = max(norm, abs(x(i))/scale(i))
         end if
      end do
   end function scaled_norm

   !> Whether n numbers are finite, and their sum, too.
   pure logical function all_finite(n, x) result(value)
      integer, intent(in) :: n
      real(wp), intent(in) :: x(n)
      real(wp) :: total
      integer :: i

      total = 0.0_wp
      do i = 1, n
         total = total + abs(x(i))
      end do
      value = ieee_is_finite(total)
   end function all_finite
end module dde_tolerance
