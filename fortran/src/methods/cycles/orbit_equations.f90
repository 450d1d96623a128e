! SPDX-License-Identifier: BSD-3-Clause
!> Periodic orbits by Newton's method: collocation equations, phase condition and further linear
!> conditions. Unknowns are the past of one period, the period and free parameters.
module orbit_equations
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use orbit_map, only: linear_map_type, solve_by_gmres
   use model_family, only: family_type
   use orbit_change, only: difference_of, inner_product, orbit_change_type, phase_condition, &
                           weights_of
   use orbit_linearisation, only: linearise_orbit
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: correct_orbit, find_tangents, newton_type, turn_to_tangent

   !> Newton's method.
   type :: newton_type
      !> Iterations allowed
      integer :: most_iterations = 10
      !> The iteration ends where no component changes by more than this share of its largest value.
      real(wp) :: tolerance = 1.0e-10_wp
      !> Iterations made
      integer :: iterations = 0
      !> The last change
      real(wp) :: last_change = 0.0_wp
      !> Linear equations about the orbit, for tangents and multipliers
      type(orbit_passes_type) :: linear
   end type newton_type

   !> Residual of the linear systems.
   real(wp), parameter :: linear_tolerance = 1.0e-10_wp
   !> A change of this size that does not decrease by half is one of rounding errors.
   real(wp), parameter :: rounding = 1.0e-7_wp
   !> After a change of this size the linear equations before it are those about the orbit.
   real(wp), parameter :: negligible = 1.0e-12_wp
   !> A change so much larger than the orbit is divergence.
   real(wp), parameter :: divergence = 1.0e3_wp

   !> The linear system of an iteration; the vector is the past in units of the state, then the
   !> changes of the period and of the free parameters.
   type, extends(linear_map_type) :: orbit_map_type
      !> Collocation equations, prepared for the sums over the nodes in the conditions
      type(orbit_passes_type) :: linear
      !> The phase condition, then a condition for each free parameter
      type(orbit_change_type), allocatable :: conditions(:)
   contains
      procedure :: apply => defect_of_change
   end type orbit_map_type

contains

   !> Correct an orbit: the collocation equations, the phase of the reference, and for each free
   !> parameter a condition that the inner product of a direction with the change from the reference
   !> is given.
   subroutine correct_orbit(family, reference, directions, distances, orbit, newton, error)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> An orbit on the same mesh
      type(periodic_orbit_type), intent(in) :: reference
      !> Directions, one for each free parameter
      type(orbit_change_type), intent(in) :: directions(:)
      !> The inner products
      real(wp), intent(in) :: distances(:)
      !> First an approximation, then the orbit
      type(periodic_orbit_type), intent(inout) :: orbit
      !> The method, and its effort
      type(newton_type), intent(inout) :: newton
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: change(1), conditions(1 + size(directions))
      real(wp) :: before, target(1 + size(directions), 1)
      integer :: i

      call set_conditions(reference, directions, conditions)
      newton%last_change = huge(1.0_wp)
      do i = 1, newton%most_iterations
         newton%iterations = i
         if (stop_requested /= 0) call raise(error, "periodic orbit: interrupted")
         if (allocated(error)) return
         call find_targets(reference, family, conditions, distances, orbit, target(:, 1))
         call linearise_orbit(family, orbit, newton%linear, error)
         if (allocated(error)) return
         call solve_conditions(newton%linear, conditions, 1.0_wp, target, change, error)
         if (allocated(error)) return
         before = newton%last_change
         newton%last_change = change(1)%size_against(orbit)
         if (.not. newton%last_change <= divergence) exit
         call change(1)%add_to(orbit, family)
         if (newton%last_change <= newton%tolerance &
             .or. (newton%last_change <= rounding .and. newton%last_change >= 0.5_wp*before)) then
            if (newton%last_change <= negligible) return
            call linearise_orbit(family, orbit, newton%linear, error)
            return
         end if
         if (.not. orbit%period > 0.0_wp) exit
      end do
      call raise(error, "periodic orbit: Newton's method changes it by " &
                 //text(newton%last_change)//" after "//text(newton%iterations) &
                 //" iterations; at most "//text(newton%tolerance)//" expected")
   end subroutine correct_orbit

   !> Changes that keep an orbit one: tangents. Tangent i has the inner product 1 with
   !> direction i and 0 with the others.
   subroutine find_tangents(orbit, linear, directions, tangents, error)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Linear equations about it
      type(orbit_passes_type), intent(in) :: linear
      !> Directions, one for each free parameter
      type(orbit_change_type), intent(in) :: directions(:)
      !> The tangents
      type(orbit_change_type), intent(out) :: tangents(:)
      !> The directions do not determine them
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: conditions(1 + size(directions))
      type(orbit_passes_type) :: equations
      real(wp) :: targets(1 + size(directions), size(directions))
      integer :: i

      targets = 0.0_wp
      do i = 1, size(directions)
         targets(i + 1, i) = 1.0_wp
      end do
      equations = linear
      call set_conditions(orbit, directions, conditions)
      call solve_conditions(equations, conditions, 0.0_wp, targets, tangents, error)
   end subroutine find_tangents

   !> The phase condition at an orbit, and a condition for each direction.
   subroutine set_conditions(orbit, directions, conditions)
      type(periodic_orbit_type), intent(in) :: orbit
      type(orbit_change_type), intent(in) :: directions(:)
      type(orbit_change_type), intent(out) :: conditions(:)
      integer :: i

      conditions(1) = phase_condition(orbit, size(directions))
      do i = 1, size(directions)
         conditions(i + 1) = weights_of(orbit, directions(i))
      end do
   end subroutine set_conditions

   !> Turn a direction to the tangent of norm 1 whose inner product with it is positive.
   subroutine turn_to_tangent(orbit, linear, direction, error)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Linear equations about it
      type(orbit_passes_type), intent(in) :: linear
      !> The direction, then the tangent
      type(orbit_change_type), intent(inout) :: direction
      !> There is none
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: tangent(1)

      call find_tangents(orbit, linear, [direction], tangent, error)
      if (allocated(error)) return
      direction = tangent(1)%times(1.0_wp/sqrt(inner_product(orbit, tangent(1), tangent(1))))
   end subroutine turn_to_tangent

   !> Solve the linear equations about an orbit.
   subroutine solve_conditions(linear, conditions, residual, targets, changes, error)
      type(orbit_passes_type), intent(inout) :: linear
      type(orbit_change_type), intent(in) :: conditions(:)
      !> 1 if the change removes the residual of the orbit, 0 if it leaves it
      real(wp), intent(in) :: residual
      !> Values of the conditions, shape (conditions, changes)
      real(wp), intent(in) :: targets(:, :)
      type(orbit_change_type), intent(out) :: changes(:)
      type(error_type), allocatable, intent(out) :: error
      type(orbit_map_type) :: map
      real(wp), allocatable :: right(:), solution(:), weights(:, :, :)
      integer :: i, past

      allocate (weights(linear%n, linear%intervals*linear%degree + 1, size(conditions)))
      do i = 1, size(conditions)
         weights(:, :, i) = conditions(i)%nodes
      end do
      call linear%prepare(weights)
      map = orbit_map_type(linear, conditions)
      past = linear%past_size()
      allocate (right(past + size(conditions)), solution(past + size(conditions)))
      do i = 1, size(changes)
         solution = 0.0_wp
         call find_defects(map, solution, residual, right)
         right = -right
         right(past + 1:) = right(past + 1:) + targets(:, i)
         call solve_by_gmres(map, right, linear_tolerance, solution, error)
         if (allocated(error)) return
         allocate (changes(i)%nodes(size(weights, 1), size(weights, 2)))
         call find_defects(map, solution, residual, right, changes(i)%nodes)
         changes(i)%period = solution(past + 1)
         changes(i)%parameters = solution(past + 2:)
      end do
   end subroutine solve_conditions

   !> The past less the past a period later, and the values of the conditions.
   subroutine defect_of_change(self, vector, image)
      class(orbit_map_type), intent(inout) :: self
      real(wp), intent(in) :: vector(:)
      real(wp), intent(out) :: image(:)

      call find_defects(self, vector, 0.0_wp, image)
   end subroutine defect_of_change

   !> Defect of a change, plus a multiple of the residual of the orbit.
   subroutine find_defects(self, vector, residual, image, nodes)
      class(orbit_map_type), intent(in) :: self
      real(wp), intent(in) :: vector(:), residual
      real(wp), intent(out) :: image(:)
      !> The change of the nodes
      real(wp), intent(out), contiguous, optional :: nodes(:, :)
      integer :: i, past

      past = self%linear%past_size()
      call self%linear%pass(self%linear%unit*vector(:past), [residual, vector(past + 1:)], &
                            image(:past), image(past + 1:), nodes)
      image(:past) = vector(:past) - image(:past)/self%linear%unit
      do i = 1, size(self%conditions)
         associate (c => self%conditions(i))
            image(past + i) = image(past + i) + c%period*vector(past + 1) &
                              + dot_product(c%parameters, vector(past + 2:))
         end associate
      end do
   end subroutine find_defects

   !> Values that the conditions must still gain.
   subroutine find_targets(reference, family, conditions, distances, orbit, target)
      type(periodic_orbit_type), intent(in) :: reference
      type(family_type), intent(in) :: family
      type(orbit_change_type), intent(in) :: conditions(:)
      !> Inner products wanted, one less than conditions
      real(wp), intent(in) :: distances(:)
      type(periodic_orbit_type), intent(in) :: orbit
      real(wp), intent(out) :: target(:)
      type(orbit_change_type) :: made
      integer :: i

      target = [0.0_wp, distances]
      made = difference_of(orbit, reference, family)
      do i = 1, size(conditions)
         associate (c => conditions(i))
            target(i) = target(i) - sum(c%nodes*made%nodes) - c%period*made%period &
                        - dot_product(c%parameters, made%parameters)
         end associate
      end do
   end subroutine find_targets
end module orbit_equations
