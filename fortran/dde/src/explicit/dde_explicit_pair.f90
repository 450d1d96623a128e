! SPDX-License-Identifier: BSD-3-Clause
!> What the explicit Runge-Kutta pairs have in common. Each of them writes out its sums over slopes:
!> those of a component stand side by side, so that no address is computed.
module dde_explicit_pair
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: explicit_pair, slope_count

   !> Most slopes of a step and its dense output.
   integer, parameter :: slope_count = 16

   !> A pair.
   type, abstract :: explicit_pair
      !> Order of the step; the error estimate is proportional to this power of its length, too
      integer :: order = 0
      !> Stages of the step. The slope after them is that at the end.
      integer :: stages = 0
      !> Places in a step at which delayed values are read, of its stages or of its dense output
      integer :: places = 0
      !> Step size times rate of change of f above which stability limits steps
      real(wp) :: limited_by_stability = 0.0_wp
   contains
      procedure(set_up_pair), deferred :: set_up
      procedure(take_step), deferred :: take_step
      procedure(find_coefficients), deferred :: find_coefficients
   end type explicit_pair

   abstract interface
      !> Constants of the pair.
      pure subroutine set_up_pair(self, nodes)
         import :: explicit_pair, wp
         implicit none (type, external)
         class(explicit_pair), intent(inout) :: self
         !> Newton nodes of the dense output
         real(wp), allocatable, intent(out) :: nodes(:)
      end subroutine set_up_pair

      !> The stages from number 2 on, state and slope at the end, the error, and the stages of the
      !> dense output.
      pure subroutine take_step(self, context, n, h, y, z, k, slope, stage, aside, y_new, scale, &
                                embedded, finite, error)
         import :: explicit_pair, slope_count, step_context, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> The context of the step
         type(step_context), intent(inout) :: context
         !> Number of equations
         integer, intent(in) :: n
         !> Length of the step, and state at its start
         real(wp), intent(in) :: h, y(n)
         !> Delayed values
         real(wp), intent(inout) :: z(size(context%problem%lag), self%places)
         !> Slopes, the first known, and the newest of them
         real(wp), intent(inout) :: k(slope_count, n), slope(n)
         !> Argument of the last stage, and of a stage of the dense output
         real(wp), intent(inout) :: stage(n), aside(n)
         !> State at the end, and tolerance of each component
         real(wp), intent(inout) :: y_new(n), scale(n)
         !> Errors of up to two embedded methods
         real(wp), intent(inout) :: embedded(n, 2)
         !> Whether all slopes are finite
         logical, intent(out) :: finite
         !> Estimated error in units of the tolerance, the largest of all components; where the
         !> step is read between its ends, also of the dense output
         real(wp), intent(out) :: error
      end subroutine take_step

      !> Newton coefficients of one component's dense output.
      pure subroutine find_coefficients(self, k, h, y, y_new, a)
         import :: explicit_pair, slope_count, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> Slopes of the component, length of the step, and the component at its start and end
         real(wp), intent(in) :: k(slope_count), h, y, y_new
         !> Newton coefficients over the nodes 0, 1, 0, 1 and so on
         real(wp), contiguous, intent(out) :: a(0:)
      end subroutine find_coefficients
   end interface
end module dde_explicit_pair
