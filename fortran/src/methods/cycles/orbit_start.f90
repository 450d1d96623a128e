! SPDX-License-Identifier: BSD-3-Clause
!> First approximations of periodic orbits: from a trajectory that has reached a cycle, from a
!> Hopf point, and from a period doubling.
module orbit_start
   use collocation_basis, only: collocation_basis_type
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, table_sampler
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use lapack_algebra, only: null_vectors
   use linear_system, only: linear_part, linear_system_type
   use model_family, only: family_type
   use model_problem, only: model_type
   use hopf_normal_form, only: first_lyapunov_coefficient
   use orbit_change, only: orbit_change_type
   use orbit_linearisation, only: linearise_orbit
   use orbit_mesh, only: adapted_mesh, uniform_mesh
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   use special_points, only: period_doubling, special_point_type
   implicit none (type, external)
   private
   public :: orbit_at_hopf_point, orbit_of_double_period, orbit_of_trajectory

   !> Maxima at which the states differ by less than this share of their range are the same.
   real(wp), parameter :: same = 1.0e-3_wp
   !> Rounds in which the mesh follows the samples.
   integer, parameter :: rounds = 5
   !> Multipliers among which that at -1 is looked for.
   integer, parameter :: multipliers_wanted = 8

contains

   !> The orbit that a trajectory follows from maximum to maximum of a component. The period ends at
   !> the first maximum that is the same as the first one or, if there is none, at the most similar.
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
      !> Error if no maximum returns
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: place
      type(event_table) :: maxima
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      real(wp), allocatable :: sizes(:)
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
      allocate (sizes(problem%n), source=0.0_wp)
      if (options%share_of_largest > 0.0_wp) then
         sizes = options%each_absolute/options%share_of_largest
      end if
      repeated = repetition(maxima%y(:, :maxima%received), sizes)
      start = maxima%time(1)%hi
      orbit%basis = basis
      orbit%period = maxima%time(repeated)%hi - start
      orbit%mesh = uniform_mesh(intervals)
      do i = 1, rounds
         samples = table_sampler([(last, last=1, problem%n)], &
                                 start + orbit%period*orbit%node_times())
         place = arrived
         call integrate(problem, arrived%time(1), start + orbit%period, options, outcome, error, &
                        samples, continuation=place)
         if (allocated(error)) return
         orbit%nodes = samples%values
         call close_orbit(orbit)
         if (i < rounds) orbit%mesh = adapted_mesh(orbit, intervals)
      end do
   end subroutine orbit_of_trajectory

   !> Distribute the difference between the ends over the period: the mesh would follow a jump.
   pure subroutine close_orbit(orbit)
      type(periodic_orbit_type), intent(inout) :: orbit
      real(wp) :: gap(size(orbit%nodes, 1)), times(size(orbit%nodes, 2))
      integer :: i

      times = orbit%node_times()
      gap = orbit%nodes(:, size(times)) - orbit%nodes(:, 1)
      do i = 1, size(times)
         orbit%nodes(:, i) = orbit%nodes(:, i) - times(i)*gap
      end do
      orbit%nodes(:, size(times)) = orbit%nodes(:, 1)
   end subroutine close_orbit

   !> The first state that is the same as state 1, or else the most similar one.
   pure integer function repetition(states, sizes) result(value)
      !> The states, shape (n, at least 2)
      real(wp), intent(in) :: states(:, :)
      !> Known sizes of components: at a maximum one may be 0 but for rounding
      real(wp), intent(in) :: sizes(:)
      real(wp) :: distance(2:size(states, 2)), scale(size(states, 1))
      integer :: i

      ! maxima of a cycle of one loop do not differ at all: then their size counts
      scale = max(maxval(states, dim=2) - minval(states, dim=2), tiny(1.0_wp), &
                  same*max(sizes, maxval(abs(states), dim=2)))
      do i = 2, size(states, 2)
         distance(i) = maxval(abs(states(:, i) - states(:, 1))/scale)
      end do
      value = findloc(distance <= same, .true., dim=1) + 1
      if (value == 1) value = minloc(distance, dim=1) + 1
   end function repetition

   !> The small orbit x = x0 + a Re(q exp(2 pi i s)), T = 2 pi/omega, near a Hopf point of the
   !> state at rest x0, where q is the null vector of the characteristic matrix at i omega and its
   !> greatest component is the unit: 1 or, in own units, the size of the cycle at which cubic terms
   !> change its growth by omega.
   subroutine orbit_at_hopf_point(family, parameters, omega, amplitude, basis, intervals, orbit, &
                                  tangent, error)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> Parameters of the Hopf point; frequency of the imaginary pair, > 0
      real(wp), intent(in) :: parameters(:), omega
      !> Amplitude a > 0
      real(wp), intent(in) :: amplitude
      !> Polynomials of the orbit
      type(collocation_basis_type), intent(in) :: basis
      !> Intervals of the orbit
      integer, intent(in) :: intervals
      !> The orbit
      type(periodic_orbit_type), intent(out) :: orbit
      !> Direction of growing amplitude
      type(orbit_change_type), intent(out) :: tangent
      !> There is no null vector
      type(error_type), allocatable, intent(out) :: error
      complex(wp), dimension(family%model%n) :: p, q
      real(wp) :: l1, state(family%model%n)
      class(model_type), allocatable :: problem
      type(error_type), allocatable :: failure
      type(linear_system_type) :: linear
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
      integer :: i

      call family%at(parameters, problem)
      state = problem%steady_state()
      linear = linear_part(problem)
      call null_vectors(linear%characteristic_matrix(cmplx(0.0_wp, omega, kind=wp)), q, p, error)
      if (allocated(error)) return
      q = q/q(maxloc(abs(q), dim=1))
      if (problem%own_units) then
         call first_lyapunov_coefficient(problem, omega, l1, failure)
         if (.not. allocated(failure) .and. abs(l1) > 0.0_wp) orbit%unit = 1.0_wp/sqrt(abs(l1))
         q = orbit%unit*q
      end if
      orbit%basis = basis
      orbit%mesh = uniform_mesh(intervals)
      orbit%period = turn/omega
      orbit%parameters = parameters
      associate (times => orbit%node_times())
         allocate (tangent%nodes(size(state), size(times)))
         do i = 1, size(times) - 1
            tangent%nodes(:, i) = real(q)*cos(turn*times(i)) - aimag(q)*sin(turn*times(i))
         end do
         tangent%nodes(:, size(times)) = tangent%nodes(:, 1)
      end associate
      tangent%parameters = [0.0_wp]
      orbit%nodes = spread(state, 2, size(tangent%nodes, 2)) + amplitude*tangent%nodes
   end subroutine orbit_at_hopf_point

  !> First approximation of an orbit on the branch of twice the period that starts at a period
   !> doubling: the orbit passed twice, plus a multiple of the
   !> disturbance v with v(s + 1) = -v(s).
   subroutine orbit_of_double_period(family, point, amplitude, orbit, tangent, error)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> The period doubling
      type(special_point_type), intent(in) :: point
      !> Largest change of a component, in its unit
      real(wp), intent(in) :: amplitude
      !> The orbit
      type(periodic_orbit_type), intent(out) :: orbit
      !> Direction of growing amplitude
      type(orbit_change_type), intent(out) :: tangent
      !> Error if the point is no period doubling
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: disturbances(:, :, :)
      type(multipliers_type) :: multipliers
      type(orbit_passes_type) :: linear
      integer :: critical, last

      if (point%kind /= period_doubling) then
         call raise(error, "double period: a point of kind "//trim(point%kind)//"; " &
                    //period_doubling//" expected")
         return
      end if
      call linearise_orbit(family, point%orbit, linear, error)
      if (allocated(error)) return
      call find_multipliers(linear, multipliers_wanted, multipliers, error, disturbances)
      if (allocated(error)) return
      critical = minloc(abs(multipliers%values + 1.0_wp), dim=1)
      last = size(point%orbit%nodes, 2)
      allocate (tangent%nodes(size(point%orbit%nodes, 1), 2*last - 1))
      associate (v => real(disturbances(:, :, critical)))
         tangent%nodes(:, :last) = v/maxval(abs(v))*point%orbit%unit
      end associate
      tangent%nodes(:, last + 1:) = -tangent%nodes(:, 2:last)
      tangent%nodes(:, 2*last - 1) = tangent%nodes(:, 1)
      tangent%parameters = [0.0_wp]
      orbit = point%orbit
      orbit%period = 2.0_wp*orbit%period
      associate (mesh => point%orbit%mesh)
         orbit%mesh = [0.5_wp*mesh, 0.5_wp + 0.5_wp*mesh(2:)]
      end associate
      orbit%nodes = reshape([point%orbit%nodes, point%orbit%nodes(:, 2:)], shape(tangent%nodes)) &
                    + amplitude*tangent%nodes
   end subroutine orbit_of_double_period
end module orbit_start
