! SPDX-License-Identifier: BSD-3-Clause
!> Steady states by Newton's method.
module steady_states
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: approach, solve

   !> Most steps; halvings of a step; whole steps after the first correction that is small.
   integer, parameter :: most_steps = 200, most_halvings = 40, last_steps = 2

   abstract interface
      !> Rates of n equations whose states are alike now and before, not a number where they have no
      !> value, and derivatives by the states and by the parameters.
      pure subroutine rest_equations(parameters, state, rates, by_state, by_parameter)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: parameters(:), state(:)
         real(wp), intent(out) :: rates(:)
         real(wp), intent(out), optional :: by_state(:, :), by_parameter(:, :)
      end subroutine rest_equations
   end interface

contains

   !> The root of the rates near a state; not a number if there is none in reach. A step is halved
   !> until the next correction with the same derivatives is shorter (Deuflhard 2004, "Newton
   !> Methods for Nonlinear Problems", sec. 3.1). Where corrections are small whole steps end it.
   pure subroutine approach(equations, parameters, state)
      !> The rates
      procedure(rest_equations) :: equations
      !> All parameters
      real(wp), intent(in) :: parameters(:)
      !> Where to start; the root, shape (n)
      real(wp), intent(inout) :: state(:)
      real(wp) :: by_state(size(state), size(state))
      real(wp), dimension(size(state)) :: next, rates, scale, step, trial
      real(wp) :: part
      integer :: halving, last, taken

      scale = abs(state)
      last = 0
      do taken = 1, most_steps
         call equations(parameters, state, rates, by_state)
         if (.not. all(ieee_is_finite(rates))) exit
         step = correction(by_state, rates)
         if (.not. all(ieee_is_finite(step))) exit
         scale = max(scale, abs(state))
         if (last > 0 .or. all(abs(step) <= sqrt(epsilon(part))*scale .or. &
                               abs(step) <= 4.0_wp*epsilon(part)*maxval(scale))) then
            state = state + step
            last = last + 1
            if (last > last_steps) return
            cycle
         end if
         part = 1.0_wp
         do halving = 1, most_halvings
            trial = state + part*step
            call equations(parameters, trial, rates)
            next = correction(by_state, rates)
            if (all(ieee_is_finite(next))) then
               if (norm2(next) <= (1.0_wp - 0.25_wp*part)*norm2(step)) exit
            end if
            part = 0.5_wp*part
         end do
         if (halving > most_halvings) exit
         state = trial
      end do
      state = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine approach

   !> Newton's correction, not a number if there is none.
   pure function correction(by_state, rates) result(step)
      real(wp), intent(in) :: by_state(:, :), rates(:)
      real(wp) :: step(size(rates))
      real(wp) :: right(size(rates), 1)

      right(:, 1) = -rates
      call solve(by_state, right)
      step = right(:, 1)
   end function correction

   !> Solutions of linear equations by elimination with pivots; not a number if they have none. An
   !> unknown that any number solves, as by a symmetry of the equations, is 0.
   pure subroutine solve(matrix, right)
      !> Shape (n, n)
      real(wp), intent(in) :: matrix(:, :)
      !> Right-hand sides; the solutions, shape (n, any)
      real(wp), intent(inout) :: right(:, :)
      real(wp) :: a(size(matrix, 1), size(matrix, 2)), row(size(matrix, 2))
      real(wp) :: given(size(right, 1), size(right, 2)), row_right(size(right, 2))
      integer :: i, k, pivot, rank, unknown(size(matrix, 1))

      a = matrix
      given = right
      rank = 0
      do k = 1, size(a, 1)
         pivot = rank + maxloc(abs(a(rank + 1:, k)), 1)
         if (.not. abs(a(pivot, k)) > 0.0_wp) cycle
         rank = rank + 1
         unknown(rank) = k
         row = a(pivot, :)/a(pivot, k)
         row_right = given(pivot, :)/a(pivot, k)
         a(pivot, :) = a(rank, :)
         given(pivot, :) = given(rank, :)
         a(rank, :) = row
         given(rank, :) = row_right
         do i = 1, size(a, 1)
            if (i == rank) cycle
            given(i, :) = given(i, :) - a(i, k)*row_right
            a(i, :) = a(i, :) - a(i, k)*row
         end do
      end do
      right = 0.0_wp
      right(unknown(:rank), :) = given(:rank, :)
      do i = 1, size(right, 2)
         if (.not. all(abs(given(rank + 1:, i)) <= 0.0_wp)) then
            right(:, i) = ieee_value(1.0_wp, ieee_quiet_nan)
         end if
      end do
   end subroutine solve
end module steady_states
