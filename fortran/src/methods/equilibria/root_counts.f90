! SPDX-License-Identifier: BSD-3-Clause
!> How many characteristic roots lie to the right of a line, by the principle of the
!> argument: along s = bound + i w, w = 0..infinity, the argument of Delta(s) grows by
!> (n/2 - Z) pi, where Z is their number and n that of equations. The largest terms of Delta(s) at
!> large w are the leading part s^(n-1) (s + c), the argument of which is known.
module root_counts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use characteristic_function, only: characteristic_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: crossing_frequency, far_end, has_more_roots, no_count, roots_right_of, slowest_rate

   !> The number of roots where there is none: the function is not finite, or the walk too long.
   integer, parameter :: no_count = -1

   !> Bound on the change of Delta in a step, in units of Delta: below 1, its argument is certain.
   real(wp), parameter :: step_share = 0.9_wp
   !> Least step, in units of w and of the line, so that a root on the line does not stop the walk.
   real(wp), parameter :: least_share = 1.0e-14_wp, least_step = 1.0e-30_wp
   !> In a step this small in units of the line Delta may be no more than its rounding errors.
   real(wp), parameter :: short_step = 1.0e-10_wp
   !> Radius, in units of omega, of the way around a known root i omega; around a real root on the
   !> line, in units of the slowest rate.
   real(wp), parameter :: radius_share = 1.0e-5_wp
   !> Delta is 0 on the real axis where it is less than this share of its largest term.
   real(wp), parameter :: rounding = 16.0_wp*epsilon(1.0_wp)
   !> Most steps of a walk: a second of a core of 3 GHz, enough for 1e5 unstable roots. Most
   !> halvings to a frequency, down to 1e-60 of the line.
   integer, parameter :: most_steps = 3000000, most_halvings = 200
   !> Steps of that way.
   integer, parameter :: arc_steps = 32
   !> Largest -bound tau: beyond it exp(-s tau) is near the largest number.
   real(wp), parameter :: largest_exponent = 400.0_wp
   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> The unit of frequency of a characteristic function: a power of 2 near the reciprocal of the
   !> longest delay or, where that is less, near the least ratio of two neighbouring coefficients,
   !> which is the rate of the slowest motion. Not a number if a coefficient is not finite.
   pure real(wp) function slowest_rate(c) result(rate)
      !> Characteristic function
      type(characteristic_type), intent(in) :: c
      real(wp) :: sizes(0:c%n)
      integer :: i

      rate = ieee_value(1.0_wp, ieee_quiet_nan)
      sizes = sum(abs(c%coefficient), dim=2)
      if (.not. all(ieee_is_finite(sizes))) return
      rate = huge(rate)
      if (maxval(c%delay) > 0.0_wp) rate = 1.0_wp/maxval(c%delay)
      do i = 0, c%n - 1
         if (min(sizes(i), sizes(i + 1)) > 0.0_wp) rate = min(rate, sizes(i)/sizes(i + 1))
      end do
      if (rate >= huge(rate)) rate = 1.0_wp
      rate = rate/fraction(rate)
   end function slowest_rate

   !> Number of roots with real part above `bound`, or `no_count`: each takes half a turn from the
   !> growth of the argument up to `far_end`, from where it is that of the leading part. A real root
   !> on the line is not counted, nor are pairs on the imaginary axis that are known.
   pure integer function roots_right_of(c, bound, omega) result(number)
      !> Characteristic function
      type(characteristic_type), intent(in) :: c
      !> Real part of the line, on which no other pair lies
      real(wp), intent(in) :: bound
      !> Frequencies of known pairs on the line, ascending; the bound is 0
      real(wp), intent(in), optional :: omega(:)
      complex(wp) :: factor, s
      real(wp) :: from, growth, last, missing, radius
      integer :: i

      number = no_count
      if (.not. ieee_is_finite(slowest_rate(c))) return
      if (-bound*maxval(c%delay) > largest_exponent) return
      last = far_end(c, bound)
      from = 0.0_wp
      growth = 0.0_wp
      s = cmplx(bound, 0.0_wp, kind=wp)
      if (abs(c%value(s)) <= rounding*c%largest_term(s)) then
         from = radius_share*slowest_rate(c)
         if (present(omega)) from = min(from, radius_share*omega(1))
         growth = 0.5_wp*arc_growth(c, s, from)
      end if
      if (present(omega)) then
         do i = 1, size(omega)
            radius = radius_share*omega(i)
            growth = growth + line_growth(c, bound, from, omega(i) - radius) &
                     + arc_growth(c, cmplx(bound, omega(i), kind=wp), radius)
            from = omega(i) + radius
         end do
      end if
      growth = growth + line_growth(c, bound, from, max(from, last))
      s = cmplx(bound, last, kind=wp)
      factor = s + c%coefficient(c%n - 1, 1)
      missing = (c%n - 1)*angle(s) + angle(factor) + angle(c%value(s)/(s**(c%n - 1)*factor)) &
                - growth
      if (ieee_is_finite(missing)) number = nint(missing/pi)
   end function roots_right_of

   !> Frequency at which a pair of roots crosses the imaginary axis between two characteristic
   !> functions that are near each other. From there on along the axis their arguments differ by a
   !> turn.
   pure real(wp) function crossing_frequency(one, other) result(omega)
      !> The characteristic functions on both sides of the crossing
      type(characteristic_type), intent(in) :: one, other
      !> Length of the last interval, relative
      real(wp), parameter :: length = 1.0e-6_wp
      real(wp) :: above, below, growth, more
      integer :: i

      below = 0.0_wp
      above = max(far_end(one, 0.0_wp), far_end(other, 0.0_wp))
      growth = 0.0_wp
      do i = 1, most_halvings
         omega = 0.5_wp*(below + above)
         if (above - below <= length*above) return
         more = growth + line_growth(one, 0.0_wp, below, omega) &
                - line_growth(other, 0.0_wp, below, omega)
         if (abs(more) > pi) then
            above = omega
         else
            below = omega
            growth = more
         end if
      end do
   end function crossing_frequency

   !> Whether there are surely more than `number` roots with real part above `bound`. It does not
   !> count them, which takes long. Where the delayed terms are larger than twice the sum of the
   !> others, the argument of Delta falls by tau per unit of w. The rest of the line changes it by a
   !> few turns.
   pure logical function has_more_roots(c, bound, number) result(value)
      !> Characteristic function
      type(characteristic_type), intent(in) :: c
      !> Real part of the line
      real(wp), intent(in) :: bound
      !> The number
      integer, intent(in) :: number
      real(wp) :: first, last, unit, w
      complex(wp) :: s
      integer :: i

      value = -bound*maxval(c%delay) > largest_exponent
      if (value) return
      if (size(c%delay) /= 2) return
      unit = slowest_rate(c)
      first = 0.0_wp
      last = 0.0_wp
      do i = -16, 200
         w = unit*2.0_wp**i
         s = cmplx(bound, w, kind=wp)
         if (abs(c%part(2, s))*exp(-bound*c%delay(2)) &
             > 2.0_wp*terms_size(c%coefficient(:, 1), s)) then
            if (first <= 0.0_wp) first = w
            last = w
         end if
      end do
      value = c%delay(2)*(last - first)/pi > 2.0_wp*(number + 4)
   end function has_more_roots

   !> Sum of the sizes of the terms of a polynomial.
   pure real(wp) function terms_size(coefficient, s) result(total)
      !> Coefficients of s**0, s**1, ...
      real(wp), intent(in) :: coefficient(0:)
      complex(wp), intent(in) :: s
      integer :: k

      total = 0.0_wp
      do k = size(coefficient) - 1, 0, -1
         total = total*abs(s) + abs(coefficient(k))
      end do
   end function terms_size

   !> A w from which on the leading part outweighs the other terms; their ratio grows with w.
   pure real(wp) function far_end(c, bound) result(w)
      !> Characteristic function
      type(characteristic_type), intent(in) :: c
      !> Real part of the line
      real(wp), intent(in) :: bound
      complex(wp) :: s
      real(wp) :: others
      integer :: i, number

      w = slowest_rate(c)
      do number = 1, maxexponent(w)
         s = cmplx(bound, w, kind=wp)
         others = terms_size(c%coefficient(:c%n - 2, 1), s)
         do i = 2, size(c%delay)
            others = others + terms_size(c%coefficient(:, i), s)*exp(-bound*c%delay(i))
         end do
         if (abs(s**(c%n - 1)*(s + c%coefficient(c%n - 1, 1))) > 2.0_wp*others) exit
         w = 2.0_wp*w
      end do
   end function far_end

   !> Growth of the argument of Delta along s = bound + i w; not a number after too many steps.
   pure real(wp) function line_growth(c, bound, from, to) result(growth)
      type(characteristic_type), intent(in) :: c
      real(wp), intent(in) :: bound, from, to
      complex(wp) :: s, value, value_before
      real(wp) :: change, slope, step, w
      integer :: i

      growth = 0.0_wp
      w = from
      s = cmplx(bound, w, kind=wp)
      value = c%value(s)
      do i = 1, most_steps
         if (w >= to) return
         slope = abs(c%by_s(s))
         change = step_share*abs(value)
         step = step_of(change, slope, c%curvature_bound(s))
         if (step < short_step*to) then
            change = max(change, epsilon(change)*c%largest_term(s))
            step = step_of(change, slope, c%curvature_bound(s))
         end if
         ! the bound grows with w: a step that holds it at the end of a longer one holds it
         step = step_of(change, slope, c%curvature_bound(cmplx(bound, w + step, kind=wp)))
         step = max(step, least_share*w + least_step*to)
         w = min(w + step, to)
         value_before = value
         s = cmplx(bound, w, kind=wp)
         value = c%value(s)
         growth = growth + angle(value*conjg(value_before))
      end do
      growth = ieee_value(1.0_wp, ieee_quiet_nan)
   end function line_growth

   !> The step in which a function changes by at most `change`, given its slope at the start and a
   !> bound on its curvature. Near a double root it is a share of the distance from there.
   pure real(wp) function step_of(change, slope, curvature) result(step)
      real(wp), intent(in) :: change, slope, curvature

      step = 2.0_wp*change/max(slope + sqrt(slope**2 + 2.0_wp*curvature*change), tiny(1.0_wp))
   end function step_of

   !> Growth of the argument of Delta along the half circle to the right of a root.
   pure real(wp) function arc_growth(c, centre, radius) result(growth)
      type(characteristic_type), intent(in) :: c
      complex(wp), intent(in) :: centre
      real(wp), intent(in) :: radius
      complex(wp) :: value, value_before
      integer :: i

      growth = 0.0_wp
      value = c%value(centre - cmplx(0.0_wp, radius, kind=wp))
      do i = 1, arc_steps
         value_before = value
         associate (phi => pi*(real(i, wp)/arc_steps - 0.5_wp))
            value = c%value(centre + radius*cmplx(cos(phi), sin(phi), kind=wp))
         end associate
         growth = growth + angle(value*conjg(value_before))
      end do
   end function arc_growth

   !> Argument of a number, -pi..pi.
   pure real(wp) function angle(z) result(value)
      complex(wp), intent(in) :: z

      value = atan2(aimag(z), real(z))
   end function angle
end module root_counts
