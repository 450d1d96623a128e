! SPDX-License-Identifier: BSD-3-Clause
!> The class of motion by the points of a Poincare section: a few points that repeat are a cycle;
!> points that are a smooth function of two phases, each turning at a fundamental frequency, are a
!> torus, and a smooth function of three phases but not of two is a 3-torus. Other points have no
!> class: they may be those of chaos, of a long cycle, or of a torus that is not smooth at this
!> resolution.
module section_motion
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: drifts, find_third_phase, not_measured, period_of_tail, section_roughness
   public :: torus_roughness

   !> Fewest and most points whose roughness is found. Those of a 3-torus cover a surface and not a
   !> line, so that more are needed.
   integer, parameter :: fewest_points = 40, most_points = 1000, most_on_surface = 2000
   !> Lines tried as the third base, and the largest roughness with it over that without it.
   integer, parameter :: most_tried = 8
   real(wp), parameter :: most_left = 0.5_wp
   !> Longest period of a cycle, in points.
   integer, parameter :: longest_period = 128
   !> The last points of a cycle that is reached repeat within the first share of the scale, those
   !> of one that is near within the second, in at least `last_turns` turns and `last_points`
   !> points. From the first half of them to the second the largest distance may not grow by more
   !> than the factor `most_growth`, unless it is below the third share.
   real(wp), parameter :: reached = 1.0e-5_wp, near = 1.0e-3_wp, negligible = 1.0e-6_wp
   real(wp), parameter :: most_growth = 1.1_wp
   integer, parameter :: last_turns = 3, last_points = 12
   !> Maxima drift if two conditions hold. Of the 66 pairs of means of `drift_blocks` blocks, those
   !> in one order are `least_score` more than the others (by chance: 1 in 1000). And the means
   !> differ by the share `least_drift`.
   integer, parameter :: drift_blocks = 12, least_score = 48
   real(wp), parameter :: least_drift = 1.0e-3_wp
   !> Roughness that was not measured.
   real(wp), parameter :: not_measured = -1.0_wp
   !> Largest roughness of a torus.
   real(wp), parameter :: torus_roughness = 0.05_wp

contains

   !> Roughness of the last points of a section as a function of phases, two or three: the mean
   !> square distance of the points that are nearest in phase, over twice the variance. It is 1 for
   !> points in random order, 0 for a smooth function, and `not_measured` where a phase is missing.
   pure real(wp) function section_roughness(points, times, scale, bases) result(roughness)
      !> Points in order of time, shape (coordinates, points); when each was met, shape (points)
      real(wp), intent(in) :: points(:, :), times(:)
      !> Scale of the motion in each coordinate, > 0
      real(wp), intent(in) :: scale(:)
      !> Fundamental frequencies, 0 for one that is missing
      real(wp), intent(in) :: bases(:)
      real(wp), allocatable :: scaled(:, :)
      integer :: first, i

      roughness = not_measured
      if (size(times) < fewest_points .or. .not. all(bases > 0.0_wp)) return
      first = max(1, size(times) + 1 - merge(most_on_surface, most_points, size(bases) > 2))
      scaled = points(:, first:)
      do i = 1, size(scaled, 2)
         scaled(:, i) = scaled(:, i)/scale
      end do
      roughness = roughness_of(scaled, spread(times(first:), 2, size(bases)) &
                               *spread(bases, 1, size(scaled, 2)))
   end function section_roughness

   !> Find a third phase of which a section is a smooth function, while it is none of two phases,
   !> whichever of the lines turns the second one.
   pure subroutine find_third_phase(points, times, scale, bases, lines, third, roughness)
      !> Points in order of time, shape (coordinates, points); when each was met, shape (points)
      real(wp), intent(in) :: points(:, :), times(:)
      !> Scale of the motion in each coordinate, > 0; two fundamental frequencies
      real(wp), intent(in) :: scale(:), bases(2)
      !> Frequencies of lines that these do not explain, the highest line first
      real(wp), intent(in) :: lines(:)
      !> Third fundamental frequency, 0 if there is none; roughness with it
      real(wp), intent(out) :: third, roughness
      real(wp) :: of_three, of_two
      integer :: i

      third = 0.0_wp
      roughness = not_measured
      of_two = section_roughness(points, times, scale, bases)
      if (of_two < 0.0_wp) return
      roughness = huge(1.0_wp)
      do i = 1, min(most_tried, size(lines))
         of_two = min(of_two, section_roughness(points, times, scale, [bases(1), lines(i)]))
         of_three = section_roughness(points, times, scale, [bases, lines(i)])
         if (of_three >= roughness) cycle
         roughness = of_three
         third = lines(i)
      end do
      if (roughness <= min(torus_roughness, most_left*of_two)) return
      third = 0.0_wp
      roughness = not_measured
   end subroutine find_third_phase

   !> Points after which the last ones repeat so closely that the cycle is reached, 0 if it is not.
   pure integer function period_of_tail(points, scale, on_the_way) result(period)
      !> Points in order of time, shape (coordinates, points)
      real(wp), intent(in) :: points(:, :)
      !> Scale of the motion in each coordinate, > 0
      real(wp), intent(in) :: scale(:)
      !> Whether a cycle that is near is enough
      logical, intent(in) :: on_the_way
      real(wp) :: distance(size(points, 2))
      integer :: i, repeats

      associate (n => size(points, 2))
         do period = 1, longest_period
            repeats = max(last_turns*period, last_points)
            if (repeats + period > n) exit
            do i = n - repeats + 1, n
               distance(i) = norm2((points(:, i) - points(:, i - period))/scale)
               if (distance(i) > merge(near, reached, on_the_way)) exit
            end do
            if (i <= n) cycle
            associate (first => maxval(distance(n - repeats + 1:n - repeats/2)), &
                       last => maxval(distance(n - repeats/2 + 1:n)))
               if (last <= max(most_growth*first, negligible)) return
            end associate
            exit
         end do
      end associate
      period = 0
   end function period_of_tail

   !> Whether maxima, or their distances from their mean, grow or shrink all the time: then the
   !> attractor is not reached. The distances grow near an unstable cycle.
   pure logical function drifts(maxima) result(value)
      !> Maxima in order of time
      real(wp), intent(in) :: maxima(:)

      value = has_trend(maxima)
      if (.not. value .and. size(maxima) > 0) then
         value = has_trend(abs(maxima - sum(maxima)/size(maxima)))
      end if
   end function drifts

   !> Whether values have a trend, by Kendall's rank correlation of the means of blocks with time.
   pure logical function has_trend(values) result(value)
      real(wp), intent(in) :: values(:)
      real(wp) :: mean(drift_blocks)
      integer :: i, j, length, score

      value = .false.
      length = size(values)/drift_blocks
      if (length == 0) return
      mean = [(sum(values((i - 1)*length + 1:i*length))/length, i=1, drift_blocks)]
      score = 0
      do j = 2, drift_blocks
         score = score + count(mean(:j - 1) < mean(j)) - count(mean(:j - 1) > mean(j))
      end do
      value = abs(score) >= least_score .and. &
              maxval(mean) - minval(mean) > least_drift*abs(sum(mean)/drift_blocks)
   end function has_trend

   !> Roughness of points as a function of phases.
   pure real(wp) function roughness_of(points, phases) result(roughness)
      real(wp), intent(in) :: points(:, :)
      !> Phases of each in turns, shape (points, phases)
      real(wp), intent(in) :: phases(:, :)
      real(wp) :: distance(size(points, 2)), fraction(size(phases, 1), size(phases, 2)), total
      integer :: i, k, nearest

      total = 0.0_wp
      fraction = modulo(phases, 1.0_wp)
      associate (n => size(points, 2))
         do i = 1, n
            distance = 0.0_wp
            do k = 1, size(phases, 2)
               associate (apart => abs(fraction(:, k) - fraction(i, k)))
                  distance = distance + min(apart, 1.0_wp - apart)**2
               end associate
            end do
            distance(i) = huge(1.0_wp)
            nearest = minloc(distance, dim=1)
            total = total + sum((points(:, nearest) - points(:, i))**2)
         end do
         roughness = 0.5_wp*total &
                     /sum((points - spread(sum(points, dim=2)/n, 2, n))**2)
      end associate
   end function roughness_of
end module section_motion
