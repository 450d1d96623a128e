!> How many characteristic roots of (5) lie to the right of a line, by the principle of the
!> argument: along s = bound + i w, w = 0..infinity, the argument of Delta(s) grows by
!> (3/2 - Z) pi, where Z is their number. The largest terms of Delta(s) at large w are the leading
!> part s^2 (s + 1 + gamma^2/xi), the argument of which is known.
module root_counts
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: delta, slope_bound, terms
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: has_more_roots, pairs_beside, roots_right_of

   !> Bound on the change of Delta in a step, in units of Delta: below 1, its argument is certain.
   real(wp), parameter :: step_share = 0.9_wp
   !> Least step, in units of w and for w = 0, so that a root on the line does not stop the walk.
   real(wp), parameter :: least_share = 1.0e-14_wp, least_step = 1.0e-30_wp
   !> Radius, in units of omega, of the way around a known root i omega.
   real(wp), parameter :: radius_share = 1.0e-5_wp
   !> Steps of that way.
   integer, parameter :: arc_steps = 32
   !> Largest -bound tau: beyond it exp(-s tau) is near the largest number.
   real(wp), parameter :: largest_exponent = 400.0_wp
   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> Number of roots with real part above `bound`.
   pure integer function roots_right_of(p, bound) result(number)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Real part of the line, on which no root lies
      real(wp), intent(in) :: bound

      number = number_of(p, line_growth(p, bound, 0.0_wp, far_end(p, bound)), bound)
   end function roots_right_of

   !> Whether there are surely more than `number` roots with real part above `bound`. It does not
   !> count them, which takes long. Where the delayed term is larger than twice the sum of the
   !> others, the argument of Delta falls by tau per unit of w. The rest of the line changes it by a
   !> few turns.
   pure logical function has_more_roots(p, bound, number) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Real part of the line
      real(wp), intent(in) :: bound
      !> The number
      integer, intent(in) :: number
      real(wp) :: first, last, size_of(5), w
      integer :: i

      value = -bound*p%tau > largest_exponent
      if (value) return
      first = 0.0_wp
      last = 0.0_wp
      do i = -16, 200
         w = 2.0_wp**i
         size_of = abs(terms(p, cmplx(bound, w, kind=wp)))
         if (size_of(5) > 2.0_wp*sum(size_of(:4))) then
            if (first <= 0.0_wp) first = w
            last = w
         end if
      end do
      value = p%tau*(last - first)/pi > 2.0_wp*(number + 4)
   end function has_more_roots

   !> Number of pairs of roots with positive real part where some pairs i omega are on the
   !> imaginary axis, which are left out.
   pure integer function pairs_beside(p, omega) result(number)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Frequencies of the pairs on the axis, ascending
      real(wp), intent(in) :: omega(:)
      real(wp) :: from, growth, radius
      integer :: i

      from = 0.0_wp
      growth = 0.0_wp
      do i = 1, size(omega)
         radius = radius_share*omega(i)
         growth = growth + line_growth(p, 0.0_wp, from, omega(i) - radius) &
                  + arc_growth(p, omega(i), radius)
         from = omega(i) + radius
      end do
      growth = growth + line_growth(p, 0.0_wp, from, max(from, far_end(p, 0.0_wp)))
      number = number_of(p, growth, 0.0_wp)/2
   end function pairs_beside

   !> Number of roots from the growth of the argument up to `far_end`; from there on the argument
   !> grows as that of the leading part.
   pure integer function number_of(p, growth, bound) result(number)
      type(block_parameters_type), intent(in) :: p
      real(wp), intent(in) :: growth, bound
      complex(wp) :: factor, s
      real(wp) :: rest

      s = cmplx(bound, far_end(p, bound), kind=wp)
      factor = s + (1.0_wp + p%gamma**2/p%xi)
      rest = 1.5_wp*pi - 2.0_wp*angle(s) - angle(factor) - angle(delta(p, s)/(s**2*factor))
      number = nint(1.5_wp - (growth + rest)/pi)
   end function number_of

   !> A w from which on the leading part outweighs the other terms; their ratio grows with w.
   pure real(wp) function far_end(p, bound) result(w)
      type(block_parameters_type), intent(in) :: p
      real(wp), intent(in) :: bound
      complex(wp) :: term(5)

      w = 1.0_wp
      do
         term = terms(p, cmplx(bound, w, kind=wp))
         if (abs(term(1) + term(2)) > 2.0_wp*sum(abs(term(3:)))) exit
         w = 2.0_wp*w
      end do
   end function far_end

   !> Growth of the argument of Delta along s = bound + i w.
   pure real(wp) function line_growth(p, bound, from, to) result(growth)
      type(block_parameters_type), intent(in) :: p
      real(wp), intent(in) :: bound, from, to
      complex(wp) :: s, value, value_before
      real(wp) :: step, w

      growth = 0.0_wp
      w = from
      s = cmplx(bound, w, kind=wp)
      value = delta(p, s)
      do while (w < to)
         ! the bound grows with w: a step that holds it at the end of a longer one holds it
         step = step_share*abs(value)/slope_bound(p, s)
         step = step_share*abs(value)/slope_bound(p, cmplx(bound, w + step, kind=wp))
         step = max(step, least_share*w + least_step)
         w = min(w + step, to)
         value_before = value
         s = cmplx(bound, w, kind=wp)
         value = delta(p, s)
         growth = growth + angle(value*conjg(value_before))
      end do
   end function line_growth

   !> Growth of the argument of Delta along the half circle to the right of i omega.
   pure real(wp) function arc_growth(p, omega, radius) result(growth)
      type(block_parameters_type), intent(in) :: p
      real(wp), intent(in) :: omega, radius
      complex(wp) :: value, value_before
      integer :: i

      growth = 0.0_wp
      value = delta(p, cmplx(0.0_wp, omega - radius, kind=wp))
      do i = 1, arc_steps
         value_before = value
         associate (phi => pi*(real(i, wp)/arc_steps - 0.5_wp))
            value = delta(p, cmplx(radius*cos(phi), omega + radius*sin(phi), kind=wp))
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
