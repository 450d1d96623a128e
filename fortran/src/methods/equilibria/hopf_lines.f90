! SPDX-License-Identifier: BSD-3-Clause
!> Hopf points on a line of one parameter: where the number of unstable characteristic roots changes
!> by a pair. This holds for every model and parameter.
module hopf_lines
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use model_modes, only: mode_of
   use model_problem, only: model_type
   use root_counts, only: crossing_frequency, far_end, no_count, roots_right_of
   implicit none (type, external)
   private
   public :: find_hopf_on_line, hopf_on_line_type

   !> An interval is halved to this length before Newton's method, one with several pairs, or where
   !> that does not converge, to at least that, in units of the line
   real(wp), parameter :: narrow = 1.0e-7_wp, narrowest = 1.0e-13_wp
   !> Newton's method ends when steps are below this share, or after so many steps
   real(wp), parameter :: accuracy = 1.0e-14_wp
   integer, parameter :: most_steps = 20
   !> Between two places roots are counted up to this many times the largest frequency there: beside
   !> a pole of the equations there are Hopf points without end
   real(wp), parameter :: largest_growth = 8.0_wp
   !> The frequency of a double pair is found between places this far from it; there the slope of
   !> Delta by s is this small in units of its curvature and frequency
   real(wp), parameter :: wide = 1.0e-6_wp, small_slope = 1.0e-4_wp
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

   !> A Hopf point.
   type :: hopf_on_line_type
      !> Parameters in the order of the definition
      real(wp), allocatable :: numbers(:)
      !> Frequency of the pair
      real(wp) :: omega = 0.0_wp
      !> Longest delay there
      real(wp) :: delay = 0.0_wp
      !> Whether a pair is double there; the place is then known to 1e-7 of the line
      logical :: is_double = .false.
      !> Unstable roots before and behind it along the line
      integer :: roots_before = 0, roots_behind = 0
   end type hopf_on_line_type

contains

   !> All Hopf points on a line, by the turns that the pair makes in the longest delay, and by
   !> frequency. Pairs that cross in and out between two places of the scan are missed, and those
   !> beside places where roots cannot be counted.
   subroutine find_hopf_on_line(model, from, to, places, points, error, counted)
      !> The model
      class(model_type), intent(in) :: model
      !> Parameters at both ends, in the order of the definition
      real(wp), intent(in) :: from(:), to(:)
      !> Places of the line at which unstable roots are counted
      integer, intent(in) :: places
      !> The Hopf points
      type(hopf_on_line_type), allocatable, intent(out) :: points(:)
      !> A Hopf point was not found
      type(error_type), allocatable, intent(out) :: error
      !> Whether roots are counted at the places, shape (0:places)
      logical, intent(out), optional :: counted(0:)
      type(model_type) :: block
      logical :: finite(0:places)
      real(wp) :: ends(2), here, highest, next
      integer :: i, roots_here, roots_next

      allocate (points(0))
      block = mode_of(model, 1)
      here = 0.0_wp
      roots_here = unstable_roots(here)
      ends = highest
      finite = roots_here >= 0
      do i = 1, places
         next = real(i, wp)/places
         roots_next = unstable_roots(next)
         ends = [ends(2), highest]
         finite(i) = roots_next >= 0
         call search(here, next, roots_here, roots_next)
         if (allocated(error)) return
         here = next
         roots_here = roots_next
      end do
      if (present(counted)) counted = finite

   contains

      !> Parameters at a share of the line.
      pure function numbers_at(x) result(numbers)
         real(wp), intent(in) :: x
         real(wp) :: numbers(size(from))

         numbers = from
         where (abs(to - from) > 0.0_wp) numbers = from + (to - from)*x
      end function numbers_at

      !> The characteristic function at a share of the line.
      type(characteristic_type) function function_at(x) result(c)
         real(wp), intent(in) :: x

         call block%put(numbers_at(x))
         c = characteristic_of(block)
      end function function_at

      !> Number of unstable roots at a share of the line, and the largest frequency there.
      integer function unstable_roots(x) result(number)
         real(wp), intent(in) :: x
         type(characteristic_type) :: c

         c = function_at(x)
         number = roots_right_of(c, 0.0_wp)
         highest = 0.0_wp
         if (number >= 0) highest = far_end(c, 0.0_wp)
         if (stop_requested /= 0) call raise(error, "Hopf points: interrupted")
      end function unstable_roots

      !> Add the Hopf points of an interval. A change by one is a real root.
      recursive subroutine search(start, end, roots_start, roots_end)
         real(wp), intent(in) :: start, end
         !> Numbers of unstable roots at its ends
         integer, intent(in) :: roots_start, roots_end
         type(hopf_on_line_type) :: point
         logical, allocatable :: earlier(:)
         logical :: found
         real(wp) :: middle
         integer :: j, roots_middle

         if (min(roots_start, roots_end) < 0) return
         if (abs(roots_end - roots_start) < 2 .or. allocated(error)) return
         found = .false.
         if (end - start <= narrow) then
            if (abs(roots_end - roots_start) == 2) call correct(start, end, point, found)
            if (.not. found) call find_double(0.5_wp*(start + end), point, found)
         end if
         if (found) then
            point%roots_before = roots_start
            point%roots_behind = roots_end
            earlier = [(is_before(points(j), point), j=1, size(points))]
            points = [pack(points, earlier), point, pack(points, .not. earlier)]
         else if (end - start <= narrowest) then
            call raise(error, "Hopf points: a pair of roots crosses the axis between the shares " &
                       //text(start)//" and "//text(end)//" of the line, and Newton's method " &
                       //"does not find where")
         else
            middle = 0.5_wp*(start + end)
            roots_middle = unstable_roots(middle)
            if (highest > largest_growth*maxval(ends)) then
               roots_middle = no_count
               finite(i) = .false.
            end if
            call search(start, middle, roots_start, roots_middle)
            call search(middle, end, roots_middle, roots_end)
         end if
      end subroutine search

      !> The Hopf point of a short interval by Newton's method for Delta(i omega) = 0.
      subroutine correct(start, end, point, found)
         real(wp), intent(in) :: start, end
         type(hopf_on_line_type), intent(out) :: point
         logical, intent(out) :: found
         type(characteristic_type) :: c
         complex(wp) :: by_omega, by_x, delta, s
         real(wp) :: step(2), x
         integer :: i

         ! off the ends, at which the pair may be on the axis
         point%omega = crossing_frequency(function_at(2.0_wp*start - end), &
                                          function_at(2.0_wp*end - start))
         x = 0.5_wp*(start + end)
         do i = 1, most_steps
            c = function_at(x)
            s = cmplx(0.0_wp, point%omega, kind=wp)
            delta = c%value(s)
            by_omega = (0.0_wp, 1.0_wp)*c%by_s(s)
            by_x = slope_along(c, s)
            step = -[aimag(conjg(by_x)*delta), -aimag(conjg(by_omega)*delta)] &
                   /aimag(conjg(by_x)*by_omega)
            point%omega = point%omega + step(1)
            x = x + step(2)
            if (all(abs(step) <= accuracy*abs([point%omega, x]))) exit
         end do
         found = abs(x - 0.5_wp*(start + end)) <= 2.0_wp*(end - start) + accuracy
         point%numbers = numbers_at(x)
         point%delay = maxval(c%delay)
      end subroutine correct

      !> A double pair at a place that is known to `narrow`: nearer to it Delta is less than its
      !> rounding.
      subroutine find_double(x, point, found)
         real(wp), intent(in) :: x
         type(hopf_on_line_type), intent(out) :: point
         logical, intent(out) :: found
         type(characteristic_type) :: c
         complex(wp) :: s

         point%omega = crossing_frequency(function_at(x - wide), function_at(x + wide))
         c = function_at(x)
         s = cmplx(0.0_wp, point%omega, kind=wp)
         found = abs(c%by_s(s)) <= small_slope*point%omega*c%curvature_bound(s)
         point%is_double = found
         point%numbers = numbers_at(x)
         point%delay = maxval(c%delay)
      end subroutine find_double

      !> Derivative of Delta along the line.
      pure complex(wp) function slope_along(c, s) result(slope)
         type(characteristic_type), intent(in) :: c
         complex(wp), intent(in) :: s
         integer :: i

         slope = 0.0_wp
         do i = 1, size(from)
            if (abs(to(i) - from(i)) > 0.0_wp) then
               slope = slope + (to(i) - from(i))*c%by_parameter(i, s)
            end if
         end do
      end function slope_along
   end subroutine find_hopf_on_line

   !> Whether a Hopf point has fewer turns in a delay, or as many and a lower frequency.
   pure logical function is_before(one, other) result(value)
      type(hopf_on_line_type), intent(in) :: one, other

      associate (k => nint(one%omega*one%delay/turn), &
                 other_k => nint(other%omega*other%delay/turn))
         value = k < other_k .or. (k == other_k .and. one%omega < other%omega)
      end associate
   end function is_before
end module hopf_lines
