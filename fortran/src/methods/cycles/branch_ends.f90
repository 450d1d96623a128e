! SPDX-License-Identifier: BSD-3-Clause
!> How far a branch or a curve of periodic orbits is followed.
module branch_ends
   use dde_kinds, only: wp
   use model_family, only: family_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: follow_settings_type, has_ended, is_closed, longer_step, refinement_type, shorter

   !> Factors of the step after one that was easy, or failed
   real(wp), parameter :: longer = 1.5_wp, shorter = 0.5_wp

   !> Multipliers and their accuracy.
   type :: refinement_type
      !> Number of multipliers
      integer :: multipliers = 8
      !> Distance of the trivial multiplier from 1 beyond which the mesh is adapted and gets more
      !> intervals
      real(wp) :: accuracy = 1.0e-7_wp
      !> Most intervals, and adaptions of a mesh that is not accurate
      integer :: most_intervals = 200, most_rounds = 4
   contains
      procedure :: next_intervals
   end type refinement_type

   !> How far a branch or a curve is followed, and how.
   type :: follow_settings_type
      !> The problems, and one free parameter of a branch, two of a curve
      type(family_type) :: family
      !> Windows on the free parameters, shape (2, parameters)
      real(wp) :: window(2, 2) = reshape([-1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp]*huge(1.0_wp), [2, 2])
      !> First and least step, in units of arclength, and longest step over the amplitude
      real(wp) :: first_step = 0.01_wp, least_step = 1.0e-6_wp, longest_step = 0.05_wp
      !> Most orbits of a branch, or points of a curve
      integer :: most_points = 200
      !> The end where no component has a larger range: a Hopf point, or a Hopf curve
      real(wp) :: least_amplitude = 1.0e-3_wp
      !> The end where the period is longer
      real(wp) :: longest_period = huge(1.0_wp)
      !> Multipliers and their accuracy
      type(refinement_type) :: refinement
   contains
      procedure :: is_outside
   end type follow_settings_type

   !> How the intervals of a mesh that is not accurate grow after its second adaption
   real(wp), parameter :: growth = 1.3_wp
   !> A smaller amplitude counts as this one: near a Hopf point the parameters make the step.
   real(wp), parameter :: amplitude_of_steps = 2.0_wp

contains

   !> Intervals of the mesh after one that is not accurate.
   pure integer function next_intervals(self, intervals) result(next)
      class(refinement_type), intent(in) :: self
      integer, intent(in) :: intervals

      next = max(intervals, min(ceiling(growth*intervals), self%most_intervals))
   end function next_intervals

   !> Whether a free parameter of an orbit is outside of its window.
   pure logical function is_outside(self, orbit) result(value)
      class(follow_settings_type), intent(in) :: self
      type(periodic_orbit_type), intent(in) :: orbit

      associate (p => orbit%parameters(self%family%free))
         value = any(p < self%window(1, :size(p)) .or. p > self%window(2, :size(p)))
      end associate
   end function is_outside

   !> The step after one that was easy.
   pure real(wp) function longer_step(step, longest, orbit) result(next)
      !> Length of the last step, the longest step over the amplitude
      real(wp), intent(in) :: step, longest
      !> The orbit at its end
      type(periodic_orbit_type), intent(in) :: orbit

      next = min(longer*step, longest*max(amplitude_of_steps, orbit%amplitude()))
   end function longer_step

   !> Whether a branch ends at its last orbit, and why.
   logical function has_ended(settings, orbits, step, same_direction, reason) result(value)
      !> How far the branch is followed
      type(follow_settings_type), intent(in) :: settings
      !> Orbits of the branch
      type(periodic_orbit_type), intent(in) :: orbits(:)
      !> Length of the last step
      real(wp), intent(in) :: step
      !> Whether the parameter changes in the same direction as at the first orbit
      logical, intent(in) :: same_direction
      !> Why, where it ends
      character(len=:), allocatable, intent(inout) :: reason

      value = .true.
      associate (orbit => orbits(size(orbits)))
         if (settings%is_outside(orbit)) then
            reason = "window"
         else if (orbit%amplitude() < settings%least_amplitude) then
            reason = "amplitude"
         else if (orbit%period > settings%longest_period) then
            reason = "period"
         else if (orbit%comes_to_shorter(orbits(size(orbits) - 1))) then
            reason = "shorter_period"
         else if (same_direction .and. is_closed(settings%family, orbits, step)) then
            reason = "closed"
         else
            value = .false.
         end if
      end associate
   end function has_ended

   !> Whether a branch or a curve comes back to its first orbit.
   pure logical function is_closed(family, orbits, step) result(value)
      !> What the orbits have in common
      type(family_type), intent(in) :: family
      !> Orbits of the branch
      type(periodic_orbit_type), intent(in) :: orbits(:)
      !> Length of the last step
      real(wp), intent(in) :: step
      real(wp) :: distance(size(orbits)), ends(size(orbits(1)%nodes, 1), 2), range
      integer :: i

      associate (first => orbits(1), free => family%free)
         ends(:, 1) = minval(first%nodes, dim=2)
         ends(:, 2) = maxval(first%nodes, dim=2)
         range = maxval(ends(:, 2) - ends(:, 1))
         do i = 1, size(orbits)
            associate (x => orbits(i)%nodes)
               distance(i) = max(maxval(abs(minval(x, dim=2) - ends(:, 1)))/range, &
                                 maxval(abs(maxval(x, dim=2) - ends(:, 2)))/range, &
                                 maxval(abs(orbits(i)%parameters(free) &
                                            - first%parameters(free))/family%unit), &
                                 abs(orbits(i)%period/first%period - 1.0_wp))
            end associate
         end do
      end associate
      value = distance(size(orbits)) < 0.5_wp*min(step, maxval(distance))
   end function is_closed
end module branch_ends
