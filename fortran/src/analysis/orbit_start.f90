!> First approximations of periodic orbits: from a trajectory that has come to a cycle.
module orbit_start
   use collocation_basis, only: collocation_basis_type
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, table_sampler
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use orbit_mesh, only: adapted_mesh, uniform_mesh
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: orbit_of_trajectory

   !> Maxima at which the states differ by less than this share of their range are the same.
   real(wp), parameter :: same = 1.0e-3_wp
   !> Rounds in which the mesh follows the samples.
   integer, parameter :: rounds = 5

contains

   !> The orbit that a trajectory follows from maximum to maximum of a component. The period ends at
   !> the first maximum that is the same as the first one or, where none is, at the most similar.
   subroutine orbit_of_trajectory(problem, options, arrived, component, longest, basis, intervals, &
                                  orbit, error)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Where the trajectory is
      type(continuation_type), intent(in) :: arrived
      !> The component
      integer, intent(in) :: component
      !> Time to look for a period
      real(wp), intent(in) :: longest
      !> Polynomials of the orbit
      type(collocation_basis_type), intent(in) :: basis
      !> Intervals of the orbit
      integer, intent(in) :: intervals
      !> The orbit, without its parameters
      type(periodic_orbit_type), intent(out) :: orbit
      !> No maximum comes again
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: place
      type(event_table) :: maxima
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      real(wp) :: start
      integer :: i, last, repeated

      maxima = event_table(component=[component], level=[0.0_wp], direction=[-1], of_slope=[.true.])
      place = arrived
      call integrate(problem, arrived%time(1), arrived%time(1) + longest, options, outcome, error, &
                     watcher=maxima, continuation=place)
      if (allocated(error)) return
      if (maxima%received < 2) then
         call raise(error, "periodic orbit: "//text(maxima%received)//" maxima in a time of " &
                    //text(longest)//"; at least 2 expected")
         return
      end if
      repeated = repetition(maxima%y(:, :maxima%received))
      start = maxima%time(1)%hi
      orbit%basis = basis
      orbit%period = maxima%time(repeated)%hi - start
      orbit%mesh = uniform_mesh(intervals)
      do i = 1, rounds
         samples = table_sampler([(last, last=1, problem%n)], start + orbit%period*orbit%node_times())
         place = arrived
         call integrate(problem, arrived%time(1), start + orbit%period, options, outcome, error, &
                        samples, continuation=place)
         if (allocated(error)) return
         orbit%nodes = samples%values
         last = size(orbit%nodes, 2)
         orbit%nodes(:, last) = orbit%nodes(:, 1)
         if (i < rounds) orbit%mesh = adapted_mesh(orbit, intervals)
      end do
   end subroutine orbit_of_trajectory

   !> The first state that is the same as state 1, or else the most similar one.
   pure integer function repetition(states)
      !> The states, shape (n, at least 2)
      real(wp), intent(in) :: states(:, :)
      real(wp) :: distance(2:size(states, 2)), scale(size(states, 1))
      integer :: i

      ! maxima of a cycle of period 1 do not differ at all: then their size counts
      scale = max(maxval(states, dim=2) - minval(states, dim=2), same*maxval(abs(states), dim=2), &
                  tiny(1.0_wp))
      do i = 2, size(states, 2)
         distance(i) = maxval(abs(states(:, i) - states(:, 1))/scale)
      end do
      repetition = findloc(distance <= same, .true., dim=1) + 1
      if (repetition == 1) repetition = minloc(distance, dim=1) + 1
   end function repetition
end module orbit_start
