! SPDX-License-Identifier: BSD-3-Clause
!> Special points of periodic orbits with their test functions.
module special_points
   use branch_ends, only: follow_settings_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: branching, cusp, fold, judge_point, kind_length, nearest_resonance, &
             period_doubling, special_point_type, torus_bifurcation

   !> Kinds of special points.
   character(len=*), parameter :: fold = "fold", period_doubling = "period_doubling", &
                                  torus_bifurcation = "torus", branching = "branching", &
                                  cusp = "cusp"
   !> Letters of a kind and of a criticality.
   integer, parameter :: kind_length = 20
   !> The sign of a coefficient is certain if it is at least this multiple of its error.
   real(wp), parameter :: certain = 10.0_wp
   !> An angle this near to a strong resonance, in turns, counts as one.
   real(wp), parameter :: near_resonance = 1.0e-3_wp

   !> A special point.
   type :: special_point_type
      !> Kind of the point
      character(len=kind_length) :: kind = ""
      !> The orbit
      type(periodic_orbit_type) :: orbit
      !> The critical multiplier; of a pair the one with positive imaginary part
      complex(wp) :: multiplier = (0.0_wp, 0.0_wp)
      !> Distance of the trivial multiplier from 1
      real(wp) :: trivial_error = 0.0_wp
      !> Difference of the parameter between the two meshes
      real(wp) :: mesh_error = 0.0_wp
      !> Unstable multipliers before and behind it on the branch
      integer :: unstable(2) = 0
      !> Of a torus point: coefficient of its normal form (`torus_normal_form`) and the difference
      !> between the two meshes; not allocated where they were not found
      real(wp), allocatable :: coefficient, coefficient_error
      !> Of a torus point: |q| of each component when that is greatest, shape (n)
      real(wp), allocatable :: disturbed(:)
      !> Of a torus point: the rate at which q grows along the cycle, by the parameter
      real(wp), allocatable :: growth
   contains
      procedure :: angle, criticality, torus_amplitude
   end type special_point_type

contains

   !> Angle of the multiplier over a full turn.
   pure real(wp) function angle(self) result(value)
      class(special_point_type), intent(in) :: self
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

      value = atan2(aimag(self%multiplier), real(self%multiplier))/turn
   end function angle

   !> 'supercritical' where the tori are on the side on which the cycle has two more unstable
   !> multipliers, 'subcritical' on the other side, 'not determined', or '' for other kinds.
   pure function criticality(self) result(word)
      class(special_point_type), intent(in) :: self
      character(len=kind_length) :: word
      real(wp) :: angle
      integer :: q

      word = ""
      if (self%kind /= torus_bifurcation) return
      word = "not determined"
      if (.not. allocated(self%coefficient_error)) return
      if (.not. abs(self%coefficient) > certain*self%coefficient_error) return
      ! at a resonance 1:1 to 1:4 there is another normal form
      angle = self%angle()
      if (any([(abs(angle*q - nint(angle*q)) <= q*near_resonance, q=1, 4)])) return
      word = merge("supercritical", "subcritical  ", self%coefficient < 0.0_wp)
   end function criticality

   !> Half the range of the maxima of a component on the tori, over the root of the distance of the
   !> parameter from the torus point, to first order; coefficient and growth must be known.
   pure real(wp) function torus_amplitude(self, component) result(value)
      class(special_point_type), intent(in) :: self
      integer, intent(in) :: component

      value = 2.0_wp*self%disturbed(component)*sqrt(abs(self%growth/self%coefficient))
   end function torus_amplitude

   !> The fraction p/q with q up to 10 that is nearest to an angle in turns.
   pure function nearest_resonance(angle) result(fraction)
      !> The angle, 0 to 1/2
      real(wp), intent(in) :: angle
      integer :: fraction(2)
      integer, parameter :: largest = 10
      integer :: p, q

      fraction = [nint(angle), 1]
      do q = 2, largest
         p = nint(angle*q)
         if (abs(angle - real(p, wp)/q) < abs(angle - real(fraction(1), wp)/fraction(2))) then
            fraction = [p, q]
         end if
      end do
   end function nearest_resonance

   !> The critical multiplier of a point, its accuracy, and the test function by multipliers.
   subroutine judge_point(settings, point, linear, g, error)
      !> Problems and number of multipliers
      type(follow_settings_type), intent(in) :: settings
      !> The point, of known kind and orbit
      type(special_point_type), intent(inout) :: point
      !> Linear equations about the orbit
      type(orbit_passes_type), intent(in) :: linear
      !> The test function
      real(wp), intent(out) :: g
      !> No multipliers
      type(error_type), allocatable, intent(out) :: error
      type(multipliers_type) :: multipliers

      g = 0.0_wp
      call find_multipliers(linear, settings%refinement%multipliers, multipliers, error)
      if (allocated(error)) return
      call test_value(point%kind, multipliers, point%multiplier, g)
      point%trivial_error = multipliers%trivial_error
   end subroutine judge_point

   !> Test function of a kind of point by multipliers: m - 1 or |m| - 1 for the one nearest to 1, or
   !> to the unit circle off the real axis; for a period doubling the product of all m + 1, of which
   !> those greater than 1 count with modulus 1.
   pure subroutine test_value(kind, multipliers, critical, g)
      character(len=*), intent(in) :: kind
      type(multipliers_type), intent(in) :: multipliers
      complex(wp), intent(out) :: critical
      real(wp), intent(out) :: g
      logical :: real_ones(size(multipliers%values))

      associate (m => multipliers%values)
         real_ones = abs(aimag(m)) <= 0.0_wp
         critical = (0.0_wp, 0.0_wp)
         select case (kind)
         case (torus_bifurcation)
            if (.not. all(real_ones)) then
               critical = m(minloc(abs(abs(m) - 1.0_wp), dim=1, mask=aimag(m) > 0.0_wp))
            end if
            g = abs(critical) - 1.0_wp
         case (period_doubling)
            critical = m(minloc(abs(m + 1.0_wp), dim=1))
            ! it stays smooth where another multiplier reaches -1
            g = real(product((m + 1.0_wp)/max(abs(m + 1.0_wp), 1.0_wp)))
         case default
            critical = m(minloc(abs(m - 1.0_wp), dim=1))
            g = real(critical) - 1.0_wp
         end select
      end associate
   end subroutine test_value
end module special_points
