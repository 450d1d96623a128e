!> What the points of a Poincare section tell: a few points that come again and again are a cycle;
!> points that lie on a closed curve, in the order of a steady rotation, are a torus.
module section_motion
   use errors, only: error_type
   use gsl_sort, only: ascending_order
   use kinds, only: wp
   use motion_classes, only: chaos, cycle_motion, torus, undecided
   use spectral_peaks, only: find_peaks, peak_type
   use spectrum, only: power_spectrum
   implicit none (type, external)
   private
   public :: section_verdict, judge_section

   !> Fewest points to judge by, and how often a cycle must come again.
   integer, parameter :: fewest_points = 40, fewest_turns = 4
   !> Longest period of a cycle, in points.
   integer, parameter :: longest_period = 64
   !> Points of a cycle come again within this share of the scale.
   real(wp), parameter :: same_point = 1.0e-3_wp
   !> Largest roughness of a closed curve: 1 for points in random order, about (pi/N)^2 for N points
   !> on a circle.
   real(wp), parameter :: curve_roughness = 0.05_wp
   !> Largest gap between phases, in turns: a rotation by p/q turns is a cycle, whatever its scatter.
   real(wp), parameter :: largest_gap = 0.1_wp
   !> Rotations tried: the highest peaks in the spectrum of the points.
   integer, parameter :: most_rotations = 5
   real(wp), parameter :: peak_floor = 1.0e-3_wp, peak_prominence = 3.0_wp

   !> What was found.
   type :: section_verdict
      !> cycle_motion, torus, chaos or undecided
      integer :: class = undecided
      !> Points after which a cycle repeats, 0 where it is none
      integer :: period = 0
      !> Turns from point to point on the closed curve, 0 where there is none
      real(wp) :: rotation = 0.0_wp
      !> Roughness of the points in the order of that rotation; 1 where none was found
      real(wp) :: roughness = 1.0_wp
   end type section_verdict

contains

   !> Judge the points of a section.
   subroutine judge_section(points, scale, verdict)
      !> Points in order of time, shape (coordinates, points)
      real(wp), intent(in) :: points(:, :)
      !> How far the motion reaches in each coordinate, > 0
      real(wp), intent(in) :: scale(:)
      !> What they tell
      type(section_verdict), intent(out) :: verdict
      real(wp) :: scaled(size(points, 1), size(points, 2))
      integer :: i

      if (size(points, 2) < fewest_points) return
      do i = 1, size(points, 2)
         scaled(:, i) = points(:, i)/scale
      end do
      verdict%period = period_of(scaled)
      if (verdict%period > 0) then
         verdict%class = cycle_motion
         return
      end if
      call find_rotation(scaled, verdict%rotation, verdict%roughness)
      verdict%class = merge(torus, chaos, verdict%roughness <= curve_roughness)
   end subroutine judge_section

   !> Points after which all come again, 0 when they do not.
   pure integer function period_of(points) result(period)
      !> Points
      real(wp), intent(in) :: points(:, :)
      real(wp) :: distance

      associate (n => size(points, 2))
         do period = 1, min(longest_period, n/fewest_turns)
            distance = norm2(points(:, 1 + period:) - points(:, :n - period))/sqrt(n - period + 0.0_wp)
            if (distance <= same_point) return
         end do
      end associate
      period = 0
   end function period_of

   !> The rotation in whose order the points are least rough.
   subroutine find_rotation(points, rotation, roughness)
      !> Points
      real(wp), intent(in) :: points(:, :)
      !> Turns from point to point
      real(wp), intent(out) :: rotation
      !> Roughness in its order
      real(wp), intent(out) :: roughness
      type(error_type), allocatable :: error
      type(peak_type), allocatable :: peaks(:)
      real(wp), allocatable :: frequency(:), power(:)
      real(wp) :: centred(size(points, 1), size(points, 2)), tried
      integer :: i, widest

      rotation = 0.0_wp
      roughness = 1.0_wp
      associate (n => size(points, 2))
         centred = points - spread(sum(points, dim=2)/n, 2, n)
         widest = maxloc(sum(centred**2, dim=2), dim=1)
         call power_spectrum(centred(widest, :), 1.0_wp, "hann", 1, 0.0_wp, frequency, power, error)
         if (allocated(error)) return
         peaks = find_peaks(frequency, power, peak_floor, peak_prominence)
         do i = 1, min(most_rotations, size(peaks))
            associate (highest => maxloc(peaks%power, dim=1))
               tried = roughness_of(centred, peaks(highest)%frequency)
               if (tried < roughness) then
                  roughness = tried
                  rotation = peaks(highest)%frequency
               end if
               peaks(highest)%power = 0.0_wp
            end associate
         end do
      end associate
   end subroutine find_rotation

   !> Mean square of the way from point to point in the order of their phases, over twice the
   !> variance; 1 where the phases leave a gap.
   pure real(wp) function roughness_of(centred, rotation) result(roughness)
      !> Points, their mean taken off
      real(wp), intent(in) :: centred(:, :)
      !> Turns from point to point
      real(wp), intent(in) :: rotation
      real(wp) :: phase(size(centred, 2))
      integer :: order(size(centred, 2)), i

      phase = [(modulo(i*rotation, 1.0_wp), i=1, size(phase))]
      order = ascending_order(phase)
      roughness = 1.0_wp
      associate (sorted => phase(order))
         if (maxval(cshift(sorted, 1) - sorted + merge(1.0_wp, 0.0_wp, &
                    [(i == size(phase), i=1, size(phase))])) > largest_gap) return
      end associate
      roughness = 0.5_wp*sum((centred(:, cshift(order, 1)) - centred(:, order))**2)/sum(centred**2)
   end function roughness_of
end module section_motion
