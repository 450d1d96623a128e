! SPDX-License-Identifier: BSD-3-Clause
!> Cycles of a model along a line of one parameter: branches from all Hopf points on it and from
!> trajectories, with their special points.
module cycle_branches
   use branch_ends, only: follow_settings_type
   use collocation_basis, only: collocation_basis_type
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: error_type, text
   use dde_kinds, only: wp
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use model_family, only: family_type
   use model_modes, only: mode_of
   use model_problem, only: model_type
   use model_roots, only: check_rest
   use natural_units, only: in_own_units
   use orbit_branch, only: branch_type, follow_branch
   use orbit_change, only: orbit_change_type
   use orbit_points, only: find_special_points
   use orbit_start, only: orbit_at_hopf_point, orbit_of_double_period, orbit_of_trajectory
   use periodic_orbit, only: periodic_orbit_type
   use progress_receiver, only: progress_receiver_type
   use special_points, only: period_doubling, special_point_type
   implicit none (type, external)
   private
   public :: cycle_line_type, cycle_settings_type, cycles_type, find_cycles, find_reached_orbit, &
             left_out_type

   !> A line of one parameter.
   type :: cycle_line_type
      !> The model with its other parameters, and with the past of trajectories
      type(model_type) :: model
      !> Number of the parameter that varies, and window on it
      integer :: along = 0
      real(wp) :: window(2) = 0.0_wp
   contains
      procedure :: numbers_at
   end type cycle_line_type

   !> What is computed.
   type :: cycle_settings_type
      !> The line
      type(cycle_line_type) :: line
      !> Values of the parameter from which trajectories are followed to a cycle
      real(wp), allocatable :: starts(:)
      !> Time of these trajectories
      real(wp) :: t_transient = 3000.0_wp
      !> Degree and intervals of the first mesh
      integer :: degree = 7, intervals = 40
      !> Longest period, most orbits of a branch
      real(wp) :: longest_period = 100.0_wp
      integer :: most_orbits = 200
      !> Numbers of two parameters over which curves of special points are followed, and windows on
      !> them, shape (2, 2); no curves where they are not allocated
      integer, allocatable :: curve_along(:)
      real(wp), allocatable :: curve_window(:, :)
   end type cycle_settings_type

   !> A branch and what is on it.
   type :: cycles_type
      !> Where it starts: 'hopf', 'trajectory' or 'period_doubling'
      character(len=16) :: origin = ""
      !> The branch
      type(branch_type) :: branch
      !> Special points of the branch
      type(special_point_type), allocatable :: points(:)
   end type cycles_type

   !> A start from which no branch was followed, or a special point that was not found.
   type :: left_out_type
      !> 'hopf', 'trajectory', 'period_doubling' or 'special point'
      character(len=16) :: origin = ""
      !> Parameter along the line
      real(wp) :: at = 0.0_wp
      !> Why
      character(len=120) :: reason = ""
   end type left_out_type

   !> Amplitude of the first orbit at a Hopf point and at a period doubling, in units of the state
   real(wp), parameter :: first_amplitude = 0.01_wp
   !> Places of a line at which unstable roots are counted
   integer, parameter :: scan_places = 4000
   !> Tolerance of trajectories, and the time in which a period is looked for, in units of time
   real(wp), parameter :: tolerance = 1.0e-9_wp, search_time = 300.0_wp
   !> A branch ends at a Hopf point if parameter and period differ by less than this share. A
   !> trajectory reaches an orbit of a branch if period and amplitude differ by less than the
   !> second share: near a bifurcation it approaches it slowly.
   real(wp), parameter :: same = 1.0e-3_wp, alike = 0.05_wp

contains

   !> All branches along a line that the settings lead to.
   subroutine find_cycles(settings, hopf, found, left_out, error, progress)
      type(cycle_settings_type), intent(in) :: settings
      type(hopf_on_line_type), allocatable, intent(out) :: hopf(:)
      type(cycles_type), allocatable, intent(out) :: found(:)
      !> Starts without a branch of their own
      type(left_out_type), allocatable, intent(out) :: left_out(:)
      !> A search failed
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of the number of starts done
      class(progress_receiver_type), intent(inout), optional :: progress
      type(follow_settings_type) :: how
      type(collocation_basis_type) :: basis
      type(error_type), allocatable :: failure
      type(orbit_change_type) :: tangent
      type(periodic_orbit_type) :: orbit
      type(model_type) :: block
      type(special_point_type), allocatable :: here(:)
      integer :: branches, direction, i, j
      logical :: counted(0:scan_places)

      associate (line => settings%line)
         call find_hopf_on_line(line%model, line%numbers_at(line%window(1)), &
                                line%numbers_at(line%window(2)), scan_places, hopf, error, &
                                counted)
         if (allocated(error)) return
         block = mode_of(line%model, 1)
         how%family = family_type(block, [line%along], [line%window(2) - line%window(1)])
         how%window(:, 1) = line%window
         how%longest_period = settings%longest_period
         how%most_points = settings%most_orbits
         how%least_amplitude = first_amplitude
         basis = collocation_basis_type(settings%degree)
      end associate
      if (.not. any(counted) .and. size(settings%starts) == 0) call check_rest(block, error)
      if (allocated(error)) return
      allocate (found(0), left_out(0))
      if (.not. all(counted)) then
         associate (w => settings%line%window, i => findloc(counted, .false., dim=1) - 1)
            call leave_out("hopf", w(1) + (w(2) - w(1))*i/scan_places, text(count(.not. counted)) &
                           //" of "//text(size(counted))//" places from here have no state at " &
                           //"rest with finite derivatives, or too many roots")
         end associate
      end if
      do i = 1, size(hopf)
         if (present(progress)) call progress%advance(i - 1, size(hopf) + size(settings%starts))
         if (is_end(settings, found, hopf(i))) cycle
         call orbit_at_hopf_point(how%family, hopf(i)%numbers, hopf(i)%omega, first_amplitude, &
                                  basis, settings%intervals, orbit, tangent, failure)
         call append(1, "hopf", hopf(i)%numbers(settings%line%along), tangent)
      end do
      do i = 1, size(settings%starts)
         if (present(progress)) then
            call progress%advance(size(hopf) + i - 1, size(hopf) + size(settings%starts))
         end if
         call orbit_at(settings, i, basis, orbit, failure)
         if (allocated(failure)) then
            call leave_out("trajectory", settings%starts(i), failure%message)
         else if (orbit%amplitude() < first_amplitude) then
            call leave_out("trajectory", settings%starts(i), "it comes to rest")
         else if (is_known(settings, found, orbit)) then
            call leave_out("trajectory", settings%starts(i), "its cycle is on a branch")
         else
            if (settings%line%model%own_units) orbit%unit = orbit%unit*orbit%amplitude()
            do direction = -1, 1, 2
               branches = size(found)
               call append(direction, "trajectory", settings%starts(i))
               if (size(found) == branches) exit
               if (found(size(found))%branch%ending == "closed") exit
            end do
         end if
      end do
      do i = 1, size(found)
         here = found(i)%points
         do j = 1, size(here)
            if (here(j)%kind /= period_doubling) cycle
            call orbit_of_double_period(how%family, here(j), first_amplitude, orbit, tangent, &
                                        failure)
            call append(1, "period_doubling", here(j)%orbit%parameters(settings%line%along), &
                        tangent)
         end do
      end do

   contains

      !> Follow the branch from `orbit` and append it with its special points, or leave it out if
      !> there is none or it cannot be started.
      subroutine append(direction, origin, place, tangent)
         !> 1 or -1
         integer, intent(in) :: direction
         character(len=*), intent(in) :: origin
         real(wp), intent(in) :: place
         type(orbit_change_type), intent(in), optional :: tangent
         type(cycles_type), allocatable :: longer(:)
         type(error_type), allocatable :: reasons(:)
         integer, allocatable :: missed(:)
         integer :: k

         allocate (longer(size(found) + 1))
         longer(:size(found)) = found
         associate (last => longer(size(longer)))
            last%origin = origin
            if (.not. allocated(failure)) then
               call follow_branch(how, orbit, direction, last%branch, failure, tangent)
            end if
            if (allocated(failure)) then
               call leave_out(origin, place, failure%message)
               return
            end if
            call find_special_points(how, last%branch, last%points, missed, reasons)
            do k = 1, size(missed)
               call leave_out("special point", last%branch%orbits(missed(k))%parameters( &
                                               settings%line%along), reasons(k)%message)
            end do
         end associate
         call move_alloc(longer, found)
      end subroutine append

      !> Note a start without a branch.
      subroutine leave_out(origin, place, reason)
         character(len=*), intent(in) :: origin, reason
         real(wp), intent(in) :: place

         left_out = [left_out, left_out_type(origin, place, reason)]
      end subroutine leave_out
   end subroutine find_cycles

   !> The cycle that a trajectory from a start of the line reaches.
   subroutine orbit_at(settings, i, basis, orbit, error)
      type(cycle_settings_type), intent(in) :: settings
      integer, intent(in) :: i
      type(collocation_basis_type), intent(in) :: basis
      type(periodic_orbit_type), intent(out) :: orbit
      !> Error if the trajectory leads to no cycle
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(model_type) :: model

      model = settings%line%model
      call model%put(settings%line%numbers_at(settings%starts(i)))
      options = in_own_units(model, integration_options(relative=tolerance, absolute=tolerance))
      call find_reached_orbit(model, settings%t_transient, options, basis, settings%intervals, &
                              orbit, error)
      ! the size at the start, beside which a small orbit is rest
      if (model%own_units) orbit%unit = maxval(options%each_absolute)/options%share_of_largest
   end subroutine orbit_at

   !> The cycle that a trajectory reaches, before it is corrected.
   subroutine find_reached_orbit(model, time, options, basis, intervals, orbit, error)
      !> The model and its past
      class(model_type), intent(in) :: model
      !> Time of the trajectory before its cycle is taken
      real(wp), intent(in) :: time
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Polynomials of the orbit
      type(collocation_basis_type), intent(in) :: basis
      !> Intervals of the orbit
      integer, intent(in) :: intervals
      type(periodic_orbit_type), intent(out) :: orbit
      !> Error if the trajectory leads to no cycle
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: arrived
      type(integration_result) :: outcome

      call integrate(model, 0.0_wp, time, options, outcome, error, continuation=arrived)
      if (allocated(error)) return
      call orbit_of_trajectory(model, options, arrived, model%sizes%observed%component, &
                               search_time*options%unit_of_time, basis, intervals, orbit, error)
      orbit%parameters = model%numbers
   end subroutine find_reached_orbit

   !> All parameters at a value of the one along the line.
   pure function numbers_at(self, value) result(numbers)
      class(cycle_line_type), intent(in) :: self
      !> Value of this parameter
      real(wp), intent(in) :: value
      real(wp), allocatable :: numbers(:)

      numbers = self%model%numbers
      numbers(self%along) = value
   end function numbers_at

   !> Whether a branch already ends at a Hopf point.
   pure logical function is_end(settings, found, hopf) result(value)
      type(cycle_settings_type), intent(in) :: settings
      type(cycles_type), intent(in) :: found(:)
      type(hopf_on_line_type), intent(in) :: hopf
      integer :: i

      value = .false.
      do i = 1, size(found)
         if (found(i)%branch%ending /= "amplitude") cycle
         associate (last => found(i)%branch%orbits(size(found(i)%branch%orbits)), &
                    along => settings%line%along)
            value = value .or. (abs(last%period*hopf%omega/(2.0_wp*acos(-1.0_wp)) - 1.0_wp) < same &
                                .and. abs(last%parameters(along) - hopf%numbers(along)) &
                                < same*(settings%line%window(2) - settings%line%window(1)))
         end associate
      end do
   end function is_end

   !> Whether a branch already passes an orbit.
   pure logical function is_known(settings, found, orbit) result(value)
      type(cycle_settings_type), intent(in) :: settings
      type(cycles_type), intent(in) :: found(:)
      type(periodic_orbit_type), intent(in) :: orbit
      integer :: i, j

      value = .false.
      do i = 1, size(found)
         do j = 1, size(found(i)%branch%orbits) - 1
            associate (a => found(i)%branch%orbits(j), b => found(i)%branch%orbits(j + 1), &
                       p => settings%line%along)
               if ((a%parameters(p) - orbit%parameters(p)) &
                   *(b%parameters(p) - orbit%parameters(p)) > 0.0_wp) cycle
               value = value .or. (is_between(orbit%period, a%period, b%period) .and. &
                                   is_between(orbit%unit*orbit%amplitude(), &
                                              a%unit*a%amplitude(), b%unit*b%amplitude()))
            end associate
         end do
      end do
   end function is_known

   !> Whether a number lies between two others, or almost so.
   pure logical function is_between(x, a, b) result(value)
      real(wp), intent(in) :: x
      !> The others, > 0
      real(wp), intent(in) :: a, b

      value = x > (1.0_wp - alike)*min(a, b) .and. x < (1.0_wp + alike)*max(a, b)
   end function is_between
end module cycle_branches
