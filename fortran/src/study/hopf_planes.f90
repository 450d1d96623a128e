! SPDX-License-Identifier: BSD-3-Clause
!> A plane of two parameters of a model with a window, in which Hopf curves are drawn, and points of
!> these curves: where Delta(i omega) = 0.
module hopf_planes
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde, only: stop_requested
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use root_counts, only: no_count, roots_right_of
   implicit none (type, external)
   private
   public :: axis_point_type, chord_of, curve_plane_type, middles, side, turn

   !> One turn.
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
   !> Newton's method ends when its last step is this small in units of the window and of omega, or
   !> when steps no longer become smaller below the second bound, or after so many steps.
   real(wp), parameter :: last_step = 1.0e-15_wp, small_step = 1.0e-9_wp
   integer, parameter :: most_steps = 12
   !> Least cosine of the angle of the curve to the direction along which the distance is given.
   real(wp), parameter :: least_cosine = 1.0e-6_wp

   !> A plane (abscissa, ordinate) with a window.
   type :: curve_plane_type
      !> The model with its fixed parameters, delays of 0 kept
      type(model_type) :: model
      !> Numbers of the parameters that are abscissa and ordinate
      integer :: along(2) = 0
      !> Window on both: least, most, shape (2, 2)
      real(wp) :: window(2, 2) = 0.0_wp
   contains
      procedure :: numbers_at, model_at, function_at, place_of, root_slopes, unstable_roots, correct
   end type curve_plane_type

   !> A pair of roots on the imaginary axis.
   type :: axis_point_type
      !> Place in units of the window, 0..1 inside
      real(wp) :: place(2) = 0.0_wp
      !> Frequency of the pair
      real(wp) :: omega = 0.0_wp
   contains
      procedure :: moved, along
   end type axis_point_type

contains

   !> A point further along a direction in (place, ln omega).
   pure type(axis_point_type) function moved(self, direction, length) result(there)
      class(axis_point_type), intent(in) :: self
      real(wp), intent(in) :: direction(3), length

      there%place = self%place + length*direction(:2)
      there%omega = self%omega*exp(length*direction(3))
   end function moved

   !> How far a point is along a direction in (place, ln omega).
   pure real(wp) function along(self, direction) result(value)
      class(axis_point_type), intent(in) :: self
      real(wp), intent(in) :: direction(3)

      value = dot_product(direction, [self%place, log(self%omega)])
   end function along

   !> The way from one point to another in (place, ln omega).
   pure function chord_of(from, to) result(chord)
      type(axis_point_type), intent(in) :: from, to
      real(wp) :: chord(3)

      chord = [to%place - from%place, log(to%omega/from%omega)]
   end function chord_of

   !> On which side of a line a place is.
   pure real(wp) function side(from, to, place) result(value)
      !> Two places of the line, and the place
      real(wp), intent(in) :: from(2), to(2), place(2)

      value = (to(1) - from(1))*(place(2) - from(2)) - (to(2) - from(2))*(place(1) - from(1))
   end function side

   !> All parameters at a place.
   pure function numbers_at(self, place) result(numbers)
      class(curve_plane_type), intent(in) :: self
      !> Place in units of the window
      real(wp), intent(in) :: place(2)
      real(wp), allocatable :: numbers(:)

      numbers = self%model%numbers
      ! the ends of the window to all digits
      numbers(self%along) = (1.0_wp - place)*self%window(1, :) + place*self%window(2, :)
   end function numbers_at

   !> The model at parameters.
   function model_at(self, numbers) result(model)
      class(curve_plane_type), intent(in) :: self
      !> All parameters
      real(wp), intent(in) :: numbers(:)
      type(model_type) :: model

      model = self%model
      call model%put(numbers)
   end function model_at

   !> The characteristic function at a place.
   function function_at(self, place) result(c)
      class(curve_plane_type), intent(in) :: self
      !> Place in units of the window
      real(wp), intent(in) :: place(2)
      type(characteristic_type) :: c

      c = characteristic_of(self%model_at(self%numbers_at(place)))
   end function function_at

   !> The place of parameters in units of the window.
   pure function place_of(self, numbers) result(place)
      class(curve_plane_type), intent(in) :: self
      !> All parameters
      real(wp), intent(in) :: numbers(:)
      real(wp) :: place(2)

      place = (numbers(self%along) - self%window(1, :))/(self%window(2, :) - self%window(1, :))
   end function place_of

   !> Derivatives of a root by abscissa and ordinate.
   function root_slopes(self, numbers, s) result(slopes)
      class(curve_plane_type), intent(in) :: self
      !> All parameters
      real(wp), intent(in) :: numbers(:)
      !> The root
      complex(wp), intent(in) :: s
      complex(wp) :: slopes(2)
      type(characteristic_type) :: c

      c = characteristic_of(self%model_at(numbers))
      slopes = [c%root_by(self%along(1), s), c%root_by(self%along(2), s)]
   end function root_slopes

   !> Number of unstable roots at places on a grid, `no_count` where there is none.
   function unstable_roots(self, x, y) result(roots)
      class(curve_plane_type), intent(in) :: self
      !> Places of columns and lines in units of the window
      real(wp), intent(in) :: x(:), y(:)
      integer :: roots(size(x), size(y))
      integer :: i, j

      roots = no_count
      do j = 1, size(y)
         do i = 1, size(x)
            if (stop_requested /= 0) return
            roots(i, j) = roots_right_of(self%function_at([x(i), y(j)]), 0.0_wp)
         end do
      end do
   end function unstable_roots

   !> Middles of equal cells of an interval.
   pure function middles(window, cells) result(x)
      !> The interval
      real(wp), intent(in) :: window(2)
      integer, intent(in) :: cells
      real(wp) :: x(cells)
      integer :: i

      x = [(window(1) + (window(2) - window(1))*(i - 0.5_wp)/cells, i=1, cells)]
   end function middles

   !> Newton's method to the point of a curve at which direction . (place, ln omega) has a value.
   subroutine correct(self, point, direction, value, found, tangent)
      class(curve_plane_type), intent(in) :: self
      !> First guess, then the point
      type(axis_point_type), intent(inout) :: point
      !> Direction along which the distance is given, and the value
      real(wp), intent(in) :: direction(3), value
      !> Whether it converged
      logical, intent(out) :: found
      !> Direction of the curve there, of length 1, towards `direction`
      real(wp), intent(out), optional :: tangent(3)
      type(characteristic_type) :: c
      complex(wp) :: delta, slopes(3), s
      real(wp) :: before, curve(3), matrix(3, 3), step(3)
      integer :: i, k

      found = .false.
      before = huge(before)
      do i = 1, most_steps
         c = self%function_at(point%place)
         s = cmplx(0.0_wp, point%omega, kind=wp)
         delta = c%value(s)
         do k = 1, 2
            slopes(k) = c%by_parameter(self%along(k), s)*(self%window(2, k) - self%window(1, k))
         end do
         slopes(3) = s*c%by_s(s)
         ! rows of one size
         associate (scale => maxval(abs(slopes)))
            matrix = reshape([real(slopes)/scale, aimag(slopes)/scale, direction], [3, 3], &
                             order=[2, 1])
            curve = cross(matrix(1, :), matrix(2, :))
            if (found) exit
            if (abs(dot_product(curve, direction)) <= least_cosine*norm2(curve)) return
            step = solution(matrix, [-[real(delta), aimag(delta)]/scale, &
                                     value - point%along(direction)])
         end associate
         if (.not. all(abs(step) < 1.0_wp)) return
         point = point%moved(step, 1.0_wp)
         associate (size_of_step => maxval(abs(step)))
            found = size_of_step <= last_step .or. &
                    (size_of_step <= small_step .and. size_of_step > 0.5_wp*before)
            before = size_of_step
         end associate
      end do
      found = found .or. before <= small_step
      if (.not. present(tangent) .or. .not. found) return
      tangent = sign(1.0_wp, dot_product(curve, direction))*curve/norm2(curve)
   end subroutine correct

   !> Solution of three equations, by Cramer's rule.
   pure function solution(matrix, right) result(x)
      real(wp), intent(in) :: matrix(3, 3), right(3)
      real(wp) :: x(3)

      associate (a => matrix(:, 1), b => matrix(:, 2), c => matrix(:, 3))
         x = [dot_product(right, cross(b, c)), dot_product(a, cross(right, c)), &
              dot_product(a, cross(b, right))]/dot_product(a, cross(b, c))
      end associate
   end function solution

   !> Vector product.
   pure function cross(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)

      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross
end module hopf_planes
