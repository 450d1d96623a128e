! SPDX-License-Identifier: BSD-3-Clause
!> An attempt of a Radau IIA step for any number of equations, full or banded.
module dde_attempts_of_any
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_collocation, only: lagrange_weights
   use dde_jacobian, only: jacobian_type
   use dde_implicit_state, only: implicit_state, iterations_of_three, iterations_per_stage, &
                                 largest_remainder, least_hidden
   use dde_radau_tableau, only: most_stages
   use dde_stage_systems, only: fill_end
   use dde_step_context, only: step_context
   use dde_systems, only: real_system
   use dde_tolerance, only: all_finite, hopeless, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: attempt_any_3, attempt_any_5, attempt_any_7

contains

   !> Three stages.
   subroutine attempt_any_3(self, context, error, n)
      integer, parameter :: s = 3
      include "attempt_of_any.inc"
   end subroutine attempt_any_3

   !> Five stages.
   subroutine attempt_any_5(self, context, error, n)
      integer, parameter :: s = 5
      include "attempt_of_any.inc"
   end subroutine attempt_any_5

   !> Seven stages.
   subroutine attempt_any_7(self, context, error, n)
      integer, parameter :: s = 7
      include "attempt_of_any.inc"
   end subroutine attempt_any_7
end module dde_attempts_of_any
