! SPDX-License-Identifier: BSD-3-Clause
!> Whether blocks that move alike on a cycle stay alike: the largest exponents of disturbances of
!> the modes of a chain by Floquet multipliers, ln|mu|/T, with the same linear equations as in
!> `transverse_growth`. All is found on two meshes, the second finer.
module transverse_multipliers
   use branch_ends, only: refinement_type
   use collocation_basis, only: collocation_basis_type
   use cycle_branches, only: find_reached_orbit
   use dde, only: integration_options
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use model_family, only: family_type, fixed_model
   use model_problem, only: model_type
   use orbit_branch, only: make_accurate
   use orbit_change, only: orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type
   use orbit_linearisation, only: linearise_orbit
   use orbit_mesh, only: adapted_mesh
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   use sign_change, only: sign_change_type
   use transverse_growth, only: of_mode, transverse_growth_type, zero_type
   implicit none (type, external)
   private
   public :: find_transverse_cycle, transverse_cycle_type

   !> Degree and intervals of the first mesh, and intervals of the second mesh over those of the
   !> first
   integer, parameter :: degree = 7, first_intervals = 40
   real(wp), parameter :: finer = 1.5_wp
   !> Meshes that are tried: the last has the most intervals of `refinement_type`.
   integer, parameter :: most_rounds = 9
   !> The trajectory is on the cycle if no component differs by more than this share of its range.
   real(wp), parameter :: closed = 1.0e-3_wp
   !> A motion in which no component has a larger range is rest.
   real(wp), parameter :: least_amplitude = 1.0e-3_wp
   !> A zero is found when it moves by this share, or after so many steps.
   real(wp), parameter :: last_move = 1.0e-14_wp
   integer, parameter :: most_steps = 60
   !> The exponent is 0 at s = 1. Its sign beside 1 is taken at this share of the way to the next s.
   real(wp), parameter :: beside = 1.0e-3_wp

   !> Exponents along a cycle.
   type :: transverse_cycle_type
      !> Why there are none, as the motion is no cycle; empty where there are exponents
      character(len=:), allocatable :: reason
      !> Period of the cycle
      real(wp) :: period = 0.0_wp
      !> Exponents in the order of s; their errors are the differences between the meshes
      type(transverse_growth_type), allocatable :: growth(:)
      !> Where they are zero beside s = 1, ascending, with errors of the same kind
      type(zero_type), allocatable :: zeros(:)
   end type transverse_cycle_type

   !> The largest exponent as a function of s.
   type :: exponent_of_mode_type
      !> A chain of one block with kappa = 1
      type(model_type) :: model
      !> Its cycle
      type(periodic_orbit_type) :: orbit
   end type exponent_of_mode_type

contains

   !> Exponents along the cycle at which a motion of one block ends.
   subroutine find_transverse_cycle(model, t_end, options, s, on_cycle)
      !> A chain of one block with kappa = 1, and its past
      type(model_type), intent(in) :: model
      !> Time at which the cycle is looked for
      real(wp), intent(in) :: t_end
      !> Method and tolerances of the motion
      type(integration_options), intent(in) :: options
      !> Stiffness of the modes over that of one block, >= 1, ascending
      real(wp), intent(in) :: s(:)
      type(transverse_cycle_type), intent(out) :: on_cycle
      type(error_type), allocatable :: error
      type(periodic_orbit_type) :: orbits(2)

      allocate (on_cycle%growth(0), on_cycle%zeros(0))
      call find_cycle(model, t_end, options, orbits, error)
      if (.not. allocated(error)) then
         on_cycle%period = orbits(2)%period
         call find_exponents(exponent_of_mode_type(kept(model), orbits(1)), &
                             exponent_of_mode_type(kept(model), orbits(2)), s, on_cycle, error)
      end if
      on_cycle%reason = ""
      if (allocated(error)) on_cycle%reason = error%message
   end subroutine find_transverse_cycle

   !> The stable cycle on which a motion is at a time, on both meshes.
   subroutine find_cycle(model, t_end, options, orbits, error)
      type(model_type), intent(in) :: model
      real(wp), intent(in) :: t_end
      type(integration_options), intent(in) :: options
      type(periodic_orbit_type), intent(out) :: orbits(2)
      !> There is none
      type(error_type), allocatable, intent(out) :: error
      type(family_type) :: family
      type(multipliers_type) :: multipliers
      type(periodic_orbit_type) :: reached
      type(error_type), allocatable :: problem
      real(wp) :: distance

      call find_reached_orbit(model, t_end, options, &
                              collocation_basis_type(degree), first_intervals, &
                              reached, error)
      if (allocated(error)) return
      if (reached%amplitude() < least_amplitude) then
         call raise(error, "the motion comes to rest")
         return
      end if
      family = fixed_model(kept(model))
      call correct_cycle(family, reached, orbits(1), multipliers, problem)
      if (allocated(problem)) then
         call raise(error, "no cycle was found at the end of the motion: "//problem%message)
         return
      end if
      distance = distance_of(reached, orbits(1))
      if (distance > closed) then
         call raise(error, "the motion differs from the nearest cycle by "//text(distance) &
                    //" of a range; at most "//text(closed)//" expected")
      else if (multipliers%unstable() > 0) then
         call raise(error, "the nearest cycle has "//text(multipliers%unstable()) &
                    //" multipliers outside of the unit circle; none expected")
      end if
      if (allocated(error)) return
      associate (intervals => nint(finer*orbits(1)%intervals()))
         call correct_cycle(family, orbits(1)%on_mesh(adapted_mesh(orbits(1), intervals)), &
                            orbits(2), multipliers, error)
      end associate
   end subroutine find_cycle

   !> Correct a cycle, on adapted meshes until its trivial multiplier is accurate.
   subroutine correct_cycle(family, start, orbit, multipliers, error)
      type(family_type), intent(in) :: family
      type(periodic_orbit_type), intent(in) :: start
      type(periodic_orbit_type), intent(out) :: orbit
      type(multipliers_type), intent(out) :: multipliers
      type(error_type), allocatable, intent(out) :: error
      type(newton_type) :: newton
      type(orbit_change_type) :: no_direction(0)
      type(refinement_type), parameter :: refinement = refinement_type(most_rounds=most_rounds)

      orbit = start
      call correct_orbit(family, start, no_direction, [real(wp) ::], orbit, newton, error)
      if (allocated(error)) return
      call make_accurate(family, refinement, orbit, no_direction, newton, multipliers, .true., &
                         error)
      if (allocated(error) .or. multipliers%trivial_error <= refinement%accuracy) return
      call raise(error, "cycle: the trivial multiplier differs from 1 by " &
                 //text(multipliers%trivial_error)//"; at most "//text(refinement%accuracy) &
                 //" expected")
   end subroutine correct_cycle

   !> The largest difference of a component at the nodes of the first orbit, over its range.
   pure real(wp) function distance_of(first, second) result(distance)
      type(periodic_orbit_type), intent(in) :: first, second
      real(wp) :: range(size(first%nodes, 1)), times(size(first%nodes, 2))
      integer :: i

      range = maxval(first%nodes, dim=2) - minval(first%nodes, dim=2)
      times = first%node_times()
      distance = 0.0_wp
      do i = 1, size(times)
         distance = max(distance, maxval(abs(first%nodes(:, i) - second%at(times(i))) &
                                         /max(range, tiny(1.0_wp))))
      end do
   end function distance_of

   !> Exponents for each s, and their zeros between neighbours.
   subroutine find_exponents(coarse, fine, s, on_cycle, error)
      !> The exponent on both meshes
      type(exponent_of_mode_type), intent(in) :: coarse, fine
      real(wp), intent(in) :: s(:)
      type(transverse_cycle_type), intent(inout) :: on_cycle
      type(error_type), allocatable, intent(out) :: error
      real(wp), dimension(size(s)) :: on_coarse, on_fine, places
      real(wp) :: zeros(2)
      integer :: i

      places = s
      if (s(1) <= 1.0_wp) places(1) = s(1) + beside*(s(2) - s(1))
      do i = 1, size(s)
         call find_exponent(coarse, places(i), on_coarse(i), error)
         if (allocated(error)) return
         call find_exponent(fine, places(i), on_fine(i), error)
         if (allocated(error)) return
         if (s(i) <= 1.0_wp) then
            ! the multiplier of the flow, 1, is the largest of a stable cycle
            on_cycle%growth = [on_cycle%growth, transverse_growth_type(s(i))]
         else
            on_cycle%growth = [on_cycle%growth, &
                               transverse_growth_type(s(i), on_fine(i), &
                                                       abs(on_fine(i) - on_coarse(i)))]
         end if
      end do
      do i = 1, size(s) - 1
         if ((on_fine(i) > 0.0_wp) .eqv. (on_fine(i + 1) > 0.0_wp)) cycle
         call find_zero(coarse, places(i:i + 1), on_coarse(i:i + 1), zeros(1), error)
         if (allocated(error)) return
         call find_zero(fine, places(i:i + 1), on_fine(i:i + 1), zeros(2), error)
         if (allocated(error)) return
         on_cycle%zeros = [on_cycle%zeros, zero_type(zeros(2), abs(zeros(2) - zeros(1)), &
                                               on_fine(i + 1) > 0.0_wp)]
      end do
   end subroutine find_exponents

   !> The largest exponent of disturbances of a mode.
   subroutine find_exponent(self, s, exponent, error)
      type(exponent_of_mode_type), intent(in) :: self
      !> Stiffness of the mode over that of one block
      real(wp), intent(in) :: s
      real(wp), intent(out) :: exponent
      type(error_type), allocatable, intent(out) :: error
      type(multipliers_type) :: found
      type(orbit_passes_type) :: linear

      exponent = -huge(1.0_wp)
      call linearise_orbit(fixed_model(of_mode(self%model, s)), self%orbit, linear, error)
      if (allocated(error)) return
      call find_multipliers(linear, 0, found, error)
      if (allocated(error)) return
      exponent = log(found%greatest)/self%orbit%period
   end subroutine find_exponent

   !> Where the exponent is 0 between two places at which its signs differ.
   subroutine find_zero(of, places, values, zero, error)
      type(exponent_of_mode_type), intent(in) :: of
      !> Places, and exponents there, of any of the meshes
      real(wp), intent(in) :: places(2), values(2)
      real(wp), intent(out) :: zero
      type(error_type), allocatable, intent(out) :: error
      type(sign_change_type) :: change
      real(wp) :: moved, value
      integer :: i

      change = sign_change_type(places, values)
      do i = 1, most_steps
         zero = change%next()
         call find_exponent(of, zero, value, error)
         if (allocated(error)) return
         call change%narrow(zero, value, moved)
         if (moved <= last_move*zero .or. abs(value) <= tiny(value)) return
      end do
   end subroutine find_zero

   !> A model that keeps delays of 0.
   type(model_type) function kept(model) result(keeping)
      type(model_type), intent(in) :: model

      keeping = model
      keeping%keeps_delays = .true.
      call keeping%put(model%numbers)
   end function kept
end module transverse_multipliers
