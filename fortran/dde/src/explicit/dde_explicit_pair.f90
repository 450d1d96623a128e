! SPDX-License-Identifier: BSD-3-Clause
!> What the explicit Runge-Kutta pairs have in common. Each of them writes out its sums over slopes:
!> those of a component stand side by side, so that no address is computed.
module dde_explicit_pair
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_step_context, only: step_context
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: evaluate, explicit_pair, slope_count

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
   contains
      procedure(set_up_pair), deferred :: set_up
      procedure(take_stages), deferred :: take_stages
      procedure(find_error), deferred :: find_error
      !> Nothing unless a pair has stages for its dense output alone
      procedure :: take_dense_stages
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

      !> The stages from number 2 on, state and slope at the end of the step.
      pure subroutine take_stages(self, context, n, h, y, z, k, slope, stage, y_new, finite)
         import :: explicit_pair, slope_count, step_context, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> The context of the step
         type(step_context), intent(inout) :: context
         !> Number of equations
         integer, intent(in) :: n
         !> Length of the step, state at the start, and delayed values at `places`
         real(wp), intent(in) :: h, y(n), z(size(context%problem%lag), size(self%places))
         !> Slopes, the first known; the newest of them
         real(wp), intent(inout) :: k(slope_count, n), slope(n)
         !> Argument of the last stage, and state at the end
         real(wp), intent(inout) :: stage(n), y_new(n)
         !> Whether all slopes are finite
         logical, intent(inout) :: finite
      end subroutine take_stages

      !> Estimated error, the largest of all components.
      pure subroutine find_error(self, n, k, h, scale, tolerance, embedded, error)
         import :: explicit_pair, slope_count, wp
         implicit none (type, external)
         class(explicit_pair), intent(in) :: self
         !> Number of equations
         integer, intent(in) :: n
         !> Slopes, length of the step, tolerance of each component, and its level
         real(wp), intent(in) :: k(slope_count, n), h, scale(n), tolerance
         !> Errors of up to two embedded methods
         real(wp), intent(out) :: embedded(n, 2)
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
         real(wp), contiguous, intent(out) :: a(0:)
      end subroutine find_coefficients
   end interface

contains

   !> The stages of the dense output: as `take_stages`, with delayed values at `dense_places`, and
   !> its error in units of the tolerances `scale`.
   pure subroutine take_dense_stages(self, context, n, h, scale, y, z, k, slope, stage, finite, &
                                     error)
      class(explicit_pair), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: n
      real(wp), intent(in) :: h, scale(n), y(n)
      real(wp), intent(in) :: z(size(context%problem%lag), size(self%dense_places))
      real(wp), intent(inout) :: k(slope_count, n), slope(n), stage(n)
      logical, intent(inout) :: finite
      real(wp), intent(out) :: error

      error = 0.0_wp
   end subroutine take_dense_stages

   !> Slope number `j` at time `t` in state `y`, unless an earlier slope of the step was not finite.
   pure subroutine evaluate(context, t, z, j, y, k, slope, finite)
      !> The context of the step
      type(step_context), intent(inout) :: context
      !> Time, delayed values and state
      real(wp), intent(in) :: t, z(size(context%problem%lag)), y(context%problem%n)
      integer, intent(in) :: j
      !> All slopes, and this one, which is computed in one piece
      real(wp), intent(inout) :: k(slope_count, context%problem%n), slope(context%problem%n)
      !> Whether all slopes so far are finite
      logical, intent(inout) :: finite
      real(wp) :: total
      integer :: i

      if (.not. finite) return
      call context%evaluate(t, y, z, slope)
      total = 0.0_wp
      do i = 1, context%problem%n
         k(j, i) = slope(i)
         total = total + abs(slope(i))
      end do
      finite = ieee_is_finite(total)
   end subroutine evaluate
end module dde_explicit_pair
