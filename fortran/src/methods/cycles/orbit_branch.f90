! SPDX-License-Identifier: BSD-3-Clause
!> Branches of periodic orbits in one parameter by pseudo-arclength continuation, through folds. The
!> step is controlled by the effort of Newton's method.
module orbit_branch
   use branch_ends, only: follow_settings_type, has_ended, longer_step, refinement_type, shorter
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use model_family, only: family_type
   use orbit_change, only: amplitude_direction, inner_product, orbit_change_type, &
                           parameter_direction
   use orbit_equations, only: correct_orbit, newton_type, turn_to_tangent
   use orbit_mesh, only: adapted_mesh
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: branch_type, follow_branch, make_accurate

   !> Orbits in the order of the branch.
   type :: branch_type
      !> The orbits
      type(periodic_orbit_type), allocatable :: orbits(:)
      !> Tangents, of norm 1, in the direction of the branch
      type(orbit_change_type), allocatable :: tangents(:)
      !> Multipliers
      type(multipliers_type), allocatable :: multipliers(:)
      !> Why it ends: 'window', 'amplitude', 'period', 'closed', 'shorter_period' (at a cycle of a
      !> part of its period), 'intervals' (more than the most are needed), 'orbits',
      !> 'convergence'
      character(len=:), allocatable :: ending
      !> Iterations of Newton's method, also of steps that failed
      integer :: iterations = 0
   end type branch_type

   !> Iterations up to which the next step is longer
   integer, parameter :: easy = 4
   !> Iterations after which a step has failed
   integer, parameter :: most_iterations = 8
   !> Least cosine of the angle between tangents of neighbours
   real(wp), parameter :: least_cosine = 0.8_wp
   !> Least share of its amplitude that an orbit has after its correction
   real(wp), parameter :: remaining_share = 0.1_wp
   !> Error after an adaption over that before, from which on another one on as many intervals does
   !> not help
   real(wp), parameter :: gain = 0.9_wp
   !> Orbits between two adaptions of an accurate mesh
   integer, parameter :: adapt_every = 5

contains

   !> Follow a branch from an orbit.
   subroutine follow_branch(settings, start, direction, branch, error, tangent)
      !> How far and how
      type(follow_settings_type), intent(in) :: settings
      !> Approximation of the first orbit
      type(periodic_orbit_type), intent(in) :: start
      !> 1 or -1: towards greater or smaller parameters, or along the tangent or against it
      integer, intent(in) :: direction
      !> The branch
      type(branch_type), intent(out) :: branch
      !> There is no first orbit
      type(error_type), allocatable, intent(out) :: error
      !> Tangent at the start, where the parameter does not determine the orbit
      type(orbit_change_type), intent(in), optional :: tangent
      type(error_type), allocatable :: failure
      type(newton_type) :: newton
      type(orbit_change_type) :: along(1)
      type(periodic_orbit_type) :: orbit
      real(wp) :: step
      integer :: i, iterations
      logical :: passed, passes

      associate (family => settings%family)
         call first_orbit(family, start, orbit, along(1), newton, error, tangent)
         if (allocated(error)) return
         if (settings%is_outside(orbit)) then
            call raise(error, "branch: the first orbit is at " &
                       //text(orbit%parameters(family%free(1)))//"; " &
                       //text(settings%window(1, 1))//".."//text(settings%window(2, 1)) &
                       //" expected")
            return
         end if
         branch%iterations = newton%iterations
         if (present(tangent)) then
            along(1) = along(1)%times(real(direction, wp))
         else if (along(1)%parameters(1)*direction < 0.0_wp) then
            along(1) = along(1)%times(-1.0_wp)
         end if
         allocate (branch%orbits(settings%most_points), branch%tangents(settings%most_points), &
                   branch%multipliers(settings%most_points))
         call make_accurate(family, settings%refinement, orbit, along, newton, &
                            branch%multipliers(1), .true., error)
         if (allocated(error)) return
         branch%orbits(1) = orbit
         branch%tangents(1) = along(1)
         step = settings%first_step
         i = 1
         branch%ending = "orbits"
         passed = .false.
         do while (i < settings%most_points)
            call take_step(settings, branch, i, step, newton, passes, failure)
            branch%iterations = branch%iterations + newton%iterations
            if (.not. allocated(failure)) then
               iterations = newton%iterations
               call make_accurate(family, settings%refinement, branch%orbits(i + 1), &
                                  branch%tangents(i + 1:i + 1), newton, &
                                  branch%multipliers(i + 1), mod(i, adapt_every) == 0, failure)
            end if
            if (allocated(failure)) then
               step = shorter*step
               passed = passed .or. passes
               if (step >= settings%least_step) cycle
               branch%ending = trim(merge("shorter_period", "convergence   ", passed))
               exit
            end if
            passed = .false.
            i = i + 1
            if (has_ended(settings, branch%orbits(:i), step, branch%tangents(1)%parameters(1) &
                          *branch%tangents(i)%parameters(1) > 0.0_wp, branch%ending)) exit
            ! near a fold the trivial multiplier is double, and its error the root of others
            if (branch%multipliers(i)%trivial_error > sqrt(settings%refinement%accuracy)) then
               branch%ending = "intervals"
               exit
            end if
            if (iterations <= easy) then
               step = longer_step(step, settings%longest_step, branch%orbits(i))
            end if
         end do
      end associate
      branch%orbits = branch%orbits(:i)
      branch%tangents = branch%tangents(:i)
      branch%multipliers = branch%multipliers(:i)
      if (branch%ending == "window") call end_at_window(settings, branch)
   end subroutine follow_branch

   !> The first orbit of a branch and its tangent.
   subroutine first_orbit(family, start, orbit, along, newton, error, tangent)
      type(family_type), intent(in) :: family
      type(periodic_orbit_type), intent(in) :: start
      type(periodic_orbit_type), intent(out) :: orbit
      type(orbit_change_type), intent(out) :: along
      type(newton_type), intent(out) :: newton
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type), intent(in), optional :: tangent
      type(orbit_change_type) :: directions(1)

      directions(1) = parameter_direction(start, 1)
      if (present(tangent)) directions(1) = tangent
      orbit = start
      call correct_orbit(family, start, directions, [0.0_wp], orbit, newton, error)
      if (allocated(error) .or. orbit%amplitude() < remaining_share*start%amplitude()) then
         ! at these parameters it becomes the stationary state, so its amplitude is kept
         directions(1) = amplitude_direction(start, 1)
         orbit = start
         call correct_orbit(family, start, directions, [0.0_wp], orbit, newton, error)
         if (allocated(error)) return
      end if
      along = directions(1)
      call turn_to_tangent(orbit, newton%linear, along, error)
   end subroutine first_orbit

   !> The next orbit of a branch.
   subroutine take_step(settings, branch, i, step, newton, passes, error)
      type(follow_settings_type), intent(in) :: settings
      type(branch_type), intent(inout) :: branch
      integer, intent(in) :: i
      real(wp), intent(in) :: step
      type(newton_type), intent(out) :: newton
      !> Whether the branch passes through a shorter cycle
      logical, intent(out) :: passes
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: along(1), move
      type(periodic_orbit_type) :: orbit

      passes = .false.
      associate (before => branch%orbits(i), family => settings%family)
         newton%most_iterations = most_iterations
         along(1) = branch%tangents(i)
         orbit = before
         move = along(1)%times(step)
         call move%add_to(orbit, family)
         call correct_orbit(family, before, along, [step], orbit, newton, error)
         if (allocated(error)) return
         move = along(1)
         call turn_to_tangent(orbit, newton%linear, along(1), error)
         if (allocated(error)) return
         passes = orbit%opposite_parts(before) > 0
         if (passes) then
            call raise(error, "the step passes through a shorter cycle")
         else if (inner_product(orbit, along(1), move) < least_cosine &
                  .and. step > settings%least_step/shorter) then
            call raise(error, "the branch turns")
         end if
         if (allocated(error)) return
         branch%orbits(i + 1) = orbit
         branch%tangents(i + 1) = along(1)
      end associate
   end subroutine take_step

   !> Find the multipliers, on an adapted mesh where that is due or where the trivial multiplier is
   !> not accurate, and on more intervals where that is not enough.
   subroutine make_accurate(family, refinement, orbit, along, newton, multipliers, due, error)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> What is accurate
      type(refinement_type), intent(in) :: refinement
      !> The orbit
      type(periodic_orbit_type), intent(inout) :: orbit
      !> The tangent there, if a parameter is free
      type(orbit_change_type), intent(inout) :: along(:)
      !> What corrected the orbit
      type(newton_type), intent(inout) :: newton
      !> The multipliers
      type(multipliers_type), intent(out) :: multipliers
      !> Whether the mesh is to be adapted anyway
      logical, intent(in) :: due
      !> There are no multipliers on the first mesh
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: failure
      type(multipliers_type) :: better
      type(newton_type) :: anew
      type(orbit_change_type) :: direction(size(along))
      type(periodic_orbit_type) :: adapted, reference
      real(wp) :: before
      integer :: i, intervals, round

      call find_multipliers(newton%linear, refinement%multipliers, multipliers, error)
      if (allocated(error)) return
      intervals = orbit%intervals()
      newton = anew
      before = huge(before)
      do round = 1, refinement%most_rounds
         if (multipliers%trivial_error <= refinement%accuracy) then
            if (round > 1 .or. .not. due) return
         end if
         if (round > 2 .and. intervals == orbit%intervals() &
             .and. multipliers%trivial_error > gain*before) return
         before = multipliers%trivial_error
         reference = orbit%on_mesh(adapted_mesh(orbit, intervals))
         do i = 1, size(along)
            direction(i) = along(i)%on_mesh(orbit, reference%mesh)
         end do
         adapted = reference
         call correct_orbit(family, reference, direction, [(0.0_wp, i=1, size(along))], adapted, &
                            newton, failure)
         if (allocated(failure)) return
         do i = 1, size(along)
            call turn_to_tangent(adapted, newton%linear, direction(i), failure)
            if (allocated(failure)) return
         end do
         call find_multipliers(newton%linear, refinement%multipliers, better, failure)
         if (allocated(failure)) return
         orbit = adapted
         along = direction
         multipliers = better
         if (round > 1) intervals = refinement%next_intervals(intervals)
      end do
   end subroutine make_accurate

   !> Replace the last orbit by that at the edge of the window.
   subroutine end_at_window(settings, branch)
      type(follow_settings_type), intent(in) :: settings
      type(branch_type), intent(inout) :: branch
      type(error_type), allocatable :: error
      type(multipliers_type) :: multipliers
      type(newton_type) :: newton
      type(orbit_change_type) :: along(1), fixed(1), move
      type(periodic_orbit_type) :: orbit, reference
      real(wp) :: edge
      integer :: i, last

      last = size(branch%orbits)
      associate (family => settings%family, p => settings%family%free(1))
         orbit = branch%orbits(last)
         edge = min(max(orbit%parameters(p), settings%window(1, 1)), settings%window(2, 1))
         along(1) = branch%tangents(last)
         move = along(1)%times((edge - orbit%parameters(p))/(along(1)%parameters(1)*family%unit(1)))
         call move%add_to(orbit, family)
         do i = 1, 2
            orbit%parameters(p) = edge
            reference = orbit
            fixed(1) = parameter_direction(orbit, 1)
            call correct_orbit(family, reference, fixed, [0.0_wp], orbit, newton, error)
            if (allocated(error)) return
            orbit%parameters(p) = edge
            call turn_to_tangent(orbit, newton%linear, along(1), error)
            if (allocated(error)) return
            if (i == 2) exit
            ! a finer mesh changes the parameter a little
            call make_accurate(family, settings%refinement, orbit, along, newton, multipliers, &
                               .false., error)
            if (allocated(error)) return
         end do
         branch%orbits(last) = orbit
         branch%tangents(last) = along(1)
         branch%multipliers(last) = multipliers
      end associate
   end subroutine end_at_window
end module orbit_branch
