! SPDX-License-Identifier: BSD-3-Clause
!> What the explicit Runge-Kutta pairs have in common. Each of them writes out its sums over slopes:
!> components are stored in blocks of a few lanes, and the number is known to the compiler, which
!> therefore makes vector instructions without a loop.
module dde_explicit_pair
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: add, evaluate, explicit_pair, lanes, slope_count

   !> Components in a block.
   integer, parameter :: lanes = 4
   !> Most slopes of a step and its dense output.
   integer, parameter :: slope_count = 16

   !> A pair.
   type, abstract :: explicit_pair
      !> Order of the step; the error estimate is proportional to this power of its length, too
      integer :: order = 0
      !> Stages of the step. The slope after them is that at the end.
      integer :: stages = 0
      !> Step size times rate of change of f above which stability limits steps
      real(wp) :: limited_by_stability = 0.0_wp
      !> Places of the stages in the step, ascending, the last at its end, and those of further
      !> stages of the dense output: the past is read in one direction
      real(wp), allocatable :: places(:), dense_places(:)
      !> Newton nodes of the dense output
      real(wp), allocatable :: nodes(:)
   contains
      procedure(take_stages), deferred :: take_stages
      procedure(find_error), deferred :: find_error
      !> Unless a pair has stages for its dense output alone these do nothing.
      procedure :: take_dense_stages, find_dense_error
      procedure(find_coefficients), deferred :: find_coefficients
   end type explicit_pair

   abstract interface
      !> The stages from number 2 on, and the state at the end of the step.
      pure subroutine take_stages(self, context, h, blocks, y, z, k, stage, y_new, finite)
         import :: explicit_pair, lanes, slope_count, step_context, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> The context of the step
         type(step_context), intent(inout) :: context
         !> Length of the step
         real(wp), intent(in) :: h
         !> Number of blocks of lanes
         integer, intent(in) :: blocks
         !> State at the start
         real(wp), intent(in) :: y(lanes, blocks)
         !> Delayed values at `places`
         real(wp), intent(in) :: z(size(context%problem%lag), size(self%places))
         !> Slopes, the first known
         real(wp), intent(inout) :: k(lanes, blocks, slope_count)
         !> Argument of the last stage, and state at the end
         real(wp), intent(inout) :: stage(lanes, blocks), y_new(lanes, blocks)
         !> Whether all slopes are finite
         logical, intent(inout) :: finite
      end subroutine take_stages

      !> Estimated error, the largest of all components.
      pure subroutine find_error(self, n, blocks, k, h, scale, tolerance, embedded, error)
         import :: explicit_pair, lanes, slope_count, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> Number of equations, and of blocks of lanes
         integer, intent(in) :: n, blocks
         !> Slopes
         real(wp), intent(in) :: k(lanes, blocks, slope_count)
         !> Length of the step, tolerance of each component, and its level
         real(wp), intent(in) :: h, scale(n), tolerance
         !> Errors of up to two embedded methods
         real(wp), intent(out) :: embedded(lanes, blocks, 2)
         !> Estimated error in units of the tolerance
         real(wp), intent(out) :: error
      end subroutine find_error

      !> Newton coefficients of one component's dense output.
      pure subroutine find_coefficients(self, k, h, y, y_new, a)
         import :: explicit_pair, slope_count, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> Slopes of the component, length of the step, and the component at its start and end
         real(wp), intent(in) :: k(slope_count), h, y, y_new
         !> Newton coefficients over the nodes 0, 1, 0, 1 and so on
         real(wp), intent(out) :: a(0:size(self%nodes))
      end subroutine find_coefficients
   end interface

contains

   !> The stages of the dense output: as `take_stages`, with delayed values at `dense_places`.
   pure subroutine take_dense_stages(self, context, h, blocks, y, z, k, stage, finite)
      class(explicit_pair), intent(in) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: h
      integer, intent(in) :: blocks
      real(wp), intent(in) :: y(lanes, blocks), z(size(context%problem%lag), &
                              size(self%dense_places))
      real(wp), intent(inout) :: k(lanes, blocks, slope_count), stage(lanes, blocks)
      logical, intent(inout) :: finite
   end subroutine take_dense_stages

   !> Estimated error of the dense output: as `find_error`, with the last Newton coefficient of each
   !> component.
   pure subroutine find_dense_error(self, n, blocks, k, h, scale, tolerance, last, error)
      class(explicit_pair), intent(in) :: self
      integer, intent(in) :: n, blocks
      real(wp), intent(in) :: k(lanes, blocks, slope_count), h, scale(n), tolerance
      real(wp), intent(out) :: last(lanes, blocks), error

      last = 0.0_wp
      error = 0.0_wp
   end subroutine find_dense_error

   !> Add `weight` times the newest slope to a stage and evaluate it, unless an earlier slope was
   !> not finite. The addition is scalar: the evaluation has just stored the slope number by number,
   !> and a vector load would wait until all of them are in the cache.
   pure subroutine add(context, t, stage, weight, newest, z, slope, finite)
      !> The context of the step
      type(step_context), intent(inout) :: context
      !> Time of the stage
      real(wp), intent(in) :: t
      !> State of the stage, completed here
      real(wp), intent(inout) :: stage(context%problem%n)
      !> The newest slope and its weight; delayed values of the stage
      real(wp), intent(in) :: weight, newest(context%problem%n), z(size(context%problem%lag))
      !> Slope of the stage
      real(wp), intent(inout) :: slope(context%problem%n)
      !> Whether all slopes so far are finite
      logical, intent(inout) :: finite

      stage = stage + weight*newest
      call evaluate(context, t, stage, z, slope, finite)
   end subroutine add

   !> Slope at time `t` in state `y`, unless an earlier slope of this step was not finite.
   pure subroutine evaluate(context, t, y, z, slope, finite)
      !> The context of the step
      type(step_context), intent(inout) :: context
      !> Time, state and delayed values
      real(wp), intent(in) :: t, y(context%problem%n), z(size(context%problem%lag))
      !> Slope
      real(wp), intent(inout) :: slope(context%problem%n)
      !> Whether all slopes so far are finite
      logical, intent(inout) :: finite

      if (.not. finite) return
      call context%evaluate(t, y, z, slope)
      finite = all(ieee_is_finite(slope))
   end subroutine evaluate
end module dde_explicit_pair
