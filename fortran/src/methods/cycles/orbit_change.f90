! SPDX-License-Identifier: BSD-3-Clause
!> Changes of periodic orbits as vectors, with an inner product.
module orbit_change
   use dde_kinds, only: wp
   use model_family, only: family_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: amplitude_direction, difference_of, inner_product, orbit_change_type, &
             parameter_direction, phase_condition, weights_of

   !> A change of an orbit, on its mesh.
   type :: orbit_change_type
      !> Change of the state at the nodes, shape (n, nodes)
      real(wp), allocatable :: nodes(:, :)
      !> Change of the period over the period
      real(wp) :: period = 0.0_wp
      !> Changes of free parameters in their units
      real(wp), allocatable :: parameters(:)
   contains
      procedure :: add_to, size_against, times, plus, on_mesh
   end type orbit_change_type

contains

   !> The direction in which an orbit grows away from its mean at fixed parameters.
   pure function amplitude_direction(orbit, free) result(direction)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Number of free parameters
      integer, intent(in) :: free
      type(orbit_change_type) :: direction

      direction%nodes = orbit%deviations()
      allocate (direction%parameters(free), source=0.0_wp)
   end function amplitude_direction

   !> The direction in which only the last free parameter changes.
   pure function parameter_direction(orbit, free) result(direction)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Number of free parameters
      integer, intent(in) :: free
      type(orbit_change_type) :: direction

      allocate (direction%nodes(size(orbit%nodes, 1), size(orbit%nodes, 2)), source=0.0_wp)
      allocate (direction%parameters(free), source=0.0_wp)
      direction%parameters(free) = 1.0_wp
   end function parameter_direction

   !> The condition that the integral of x . x_ref' over the period is 0, divided by the norm of
   !> x_ref' and the unit.
   function phase_condition(reference, free) result(condition)
      !> The reference
      type(periodic_orbit_type), intent(in) :: reference
      !> Number of free parameters
      integer, intent(in) :: free
      type(orbit_change_type) :: condition
      real(wp), allocatable :: slope(:, :, :)
      real(wp) :: square
      integer :: i

      associate (m => reference%basis%degree, basis => reference%basis, mesh => reference%mesh)
         allocate (slope(size(reference%nodes, 1), m, reference%intervals()))
         square = 0.0_wp
         do i = 1, size(slope, 3)
            associate (h => mesh(i + 1) - mesh(i))
               slope(:, :, i) = matmul(reference%nodes(:, (i - 1)*m + 1:i*m + 1), basis%slope)/h
               square = square + h*sum(matmul(slope(:, :, i)**2, basis%weight))
            end associate
         end do
      end associate
      condition%nodes = reference%functional(slope/(sqrt(max(square, tiny(square)))*reference%unit))
      allocate (condition%parameters(free), source=0.0_wp)
   end function phase_condition

   !> Weights of the inner product with a direction.
   function weights_of(orbit, direction) result(condition)
      !> The orbit, on whose mesh the direction is
      type(periodic_orbit_type), intent(in) :: orbit
      !> The direction
      type(orbit_change_type), intent(in) :: direction
      type(orbit_change_type) :: condition
      real(wp), allocatable :: values(:, :, :)
      integer :: i

      associate (m => orbit%basis%degree)
         allocate (values(size(orbit%nodes, 1), m, orbit%intervals()))
         do i = 1, size(values, 3)
            values(:, :, i) = matmul(direction%nodes(:, (i - 1)*m + 1:i*m + 1), orbit%basis%value) &
                              /orbit%unit**2
         end do
      end associate
      condition = direction
      condition%nodes = orbit%functional(values)
   end function weights_of

   !> Inner product of two changes of an orbit: the integral over the period in units of the state,
   !> and the products of the changes of period and parameters.
   real(wp) function inner_product(orbit, a, b) result(value)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Changes
      type(orbit_change_type), intent(in) :: a, b

      type(orbit_change_type) :: weights

      weights = weights_of(orbit, a)
      value = sum(weights%nodes*b%nodes) + a%period*b%period &
                      + dot_product(a%parameters, b%parameters)
   end function inner_product

   !> Change from one orbit to another on the same mesh.
   pure function difference_of(orbit, reference, family) result(change)
      !> The orbit, the one it is compared with
      type(periodic_orbit_type), intent(in) :: orbit, reference
      !> The free parameters
      type(family_type), intent(in) :: family
      type(orbit_change_type) :: change

      change%nodes = orbit%nodes - reference%nodes
      change%period = (orbit%period - reference%period)/reference%period
      change%parameters = (orbit%parameters(family%free) - reference%parameters(family%free)) &
                          /family%unit
   end function difference_of

   !> Add a change to an orbit.
   subroutine add_to(self, orbit, family)
      class(orbit_change_type), intent(in) :: self
      type(periodic_orbit_type), intent(inout) :: orbit
      type(family_type), intent(in) :: family

      orbit%nodes = orbit%nodes + self%nodes
      orbit%nodes(:, size(orbit%nodes, 2)) = orbit%nodes(:, 1)
      orbit%period = orbit%period*(1.0_wp + self%period)
      orbit%parameters(family%free) = orbit%parameters(family%free) + self%parameters*family%unit
   end subroutine add_to

   !> The largest change of a component over its greatest value, of the period over the period and
   !> of a parameter in its unit.
   pure real(wp) function size_against(self, orbit) result(value)
      class(orbit_change_type), intent(in) :: self
      type(periodic_orbit_type), intent(in) :: orbit

      associate (greatest => max(maxval(abs(orbit%nodes), dim=2), tiny(1.0_wp)))
         value = maxval([maxval(maxval(abs(self%nodes), dim=2)/greatest), &
                           abs(self%period), abs(self%parameters)])
      end associate
   end function size_against

   !> A multiple of a change.
   pure type(orbit_change_type) function times(self, factor) result(value)
      class(orbit_change_type), intent(in) :: self
      real(wp), intent(in) :: factor

      value%nodes = factor*self%nodes
      value%period = factor*self%period
      value%parameters = factor*self%parameters
   end function times

   !> A change and a multiple of another one.
   pure type(orbit_change_type) function plus(self, other, factor) result(value)
      class(orbit_change_type), intent(in) :: self
      type(orbit_change_type), intent(in) :: other
      !> Factor of the other one
      real(wp), intent(in) :: factor

      value%nodes = self%nodes + factor*other%nodes
      value%period = self%period + factor*other%period
      value%parameters = self%parameters + factor*other%parameters
   end function plus

   !> A change interpolated on another mesh.
   pure type(orbit_change_type) function on_mesh(self, orbit, mesh) result(value)
      class(orbit_change_type), intent(in) :: self
      type(periodic_orbit_type), intent(in) :: orbit
      real(wp), intent(in) :: mesh(:)
      type(periodic_orbit_type) :: carrier

      carrier = orbit
      carrier%nodes = self%nodes
      carrier = carrier%on_mesh(mesh)
      value%nodes = carrier%nodes
      value%period = self%period
      value%parameters = self%parameters
   end function on_mesh
end module orbit_change
