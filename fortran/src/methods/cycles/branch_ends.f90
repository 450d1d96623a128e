!> How far a branch or a curve of periodic orbits is followed.
module branch_ends
   use dde_kinds, only: wp
   use orbit_passes, only: orbit_scale_type
   use orbit_refinement, only: refinement_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: branch_settings_type, has_ended, is_closed, longer_step, shorter

   !> Factors of the step after one that was easy, or failed
   real(wp), parameter :: longer = 1.5_wp, shorter = 0.5_wp

   !> How far a branch is followed, and how.
   type :: branch_settings_type
      !> The free parameter and its unit
      type(orbit_scale_type) :: scale
      !> Window on the parameter
      real(wp) :: window(2) = [-huge(1.0_wp), huge(1.0_wp)]
      !> First and least step, in units of arclength, and longest step over the amplitude
      real(wp) :: first_step = 0.01_wp, least_step = 1.0e-6_wp, longest_step = 0.05_wp
      !> Most orbits
      integer :: most_orbits = 200
      !> The branch ends where no component has a larger range.
      real(wp) :: least_amplitude = 1.0e-3_wp
      !> The branch ends where the period is longer.
      real(wp) :: longest_period = huge(1.0_wp)
      !> Multipliers and their accuracy
      type(refinement_type) :: refinement
   end type branch_settings_type

   !> A smaller amplitude counts as this one: near a Hopf point the parameters make the step.
   real(wp), parameter :: amplitude_of_steps = 2.0_wp

contains

   !> The step after one that was easy.
   pure real(wp) function longer_step(step, longest, orbit) result(next)
      !> That step
      real(wp), intent(in) :: step
      !> The longest step over the amplitude
      real(wp), intent(in) :: longest
      !> The orbit it led to
      type(periodic_orbit_type), intent(in) :: orbit

      next = min(longer*step, longest*max(amplitude_of_steps, orbit%amplitude()))
   end function longer_step

   !> Whether a branch ends at its last orbit, and why.
   logical function has_ended(settings, orbits, step, same_direction, reason) result(value)
      !> Limits of the branch
      type(branch_settings_type), intent(in) :: settings
      !> Orbits of the branch
      type(periodic_orbit_type), intent(in) :: orbits(:)
      !> Length of the last step
      real(wp), intent(in) :: step
      !> Whether the parameter changes in the same direction as at the first orbit
      logical, intent(in) :: same_direction
      !> Why, where it ends
      character(len=:), allocatable, intent(inout) :: reason

      value = .true.
      associate (orbit => orbits(size(orbits)), &
                 parameter_value => orbits(size(orbits))%parameters(settings%scale%free(1)))
         if (parameter_value < settings%window(1) .or. parameter_value > settings%window(2)) then
            reason = "window"
         else if (orbit%amplitude() < settings%least_amplitude) then
            reason = "amplitude"
         else if (orbit%period > settings%longest_period) then
            reason = "period"
         else if (orbit%comes_to_shorter(orbits(size(orbits) - 1))) then
            reason = "shorter_period"
         else if (same_direction .and. is_closed(settings%scale, orbits, step)) then
            reason = "closed"
         else
            value = .false.
         end if
      end associate
   end function has_ended

   !> Whether a branch or a curve comes back to its first orbit.
   pure logical function is_closed(scale, orbits, step) result(value)
      !> The free parameters and their units
      type(orbit_scale_type), intent(in) :: scale
      !> Orbits of the branch
      type(periodic_orbit_type), intent(in) :: orbits(:)
      !> Length of the last step
      real(wp), intent(in) :: step
      real(wp) :: distance(size(orbits)), ends(size(orbits(1)%nodes, 1), 2), range
      integer :: i

      associate (first => orbits(1), free => scale%free)
         ends(:, 1) = minval(first%nodes, dim=2)
         ends(:, 2) = maxval(first%nodes, dim=2)
         range = maxval(ends(:, 2) - ends(:, 1))
         do i = 1, size(orbits)
            associate (x => orbits(i)%nodes)
               distance(i) = max(maxval(abs(minval(x, dim=2) - ends(:, 1)))/range, &
                                 maxval(abs(maxval(x, dim=2) - ends(:, 2)))/range, &
                                 maxval(abs(orbits(i)%parameters(free) &
                                            - first%parameters(free))/scale%unit), &
                                 abs(orbits(i)%period/first%period - 1.0_wp))
            end associate
         end do
      end associate
      value = distance(size(orbits)) < 0.5_wp*min(step, maxval(distance))
   end function is_closed
end module branch_ends
