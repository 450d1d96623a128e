! SPDX-License-Identifier: BSD-3-Clause
!> An attempt of a Radau IIA step for one to four equations with a full Jacobian.
module dde_attempts_of_few
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_collocation, only: lagrange_weights
   use dde_jacobian, only: jacobian_type
   use dde_implicit_state, only: implicit_state, iterations_of_three, iterations_per_stage, &
                                 largest_remainder, least_hidden
   use dde_radau_tableau, only: most_stages
   use dde_stage_systems, only: fill_end
   use dde_step_context, only: step_context
   use dde_systems, only: real_system, size_of
   use dde_tolerance, only: all_finite, hopeless, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: attempt_1_3, attempt_1_5, attempt_1_7, attempt_2_3, attempt_2_5, attempt_2_7
   public :: attempt_3_3, attempt_3_5, attempt_3_7, attempt_4_3, attempt_4_5, attempt_4_7

contains

   !> One equation, three stages.
   subroutine attempt_1_3(self, context, error)
      integer, parameter :: n = 1, s = 3
      include "attempt_of_few.inc"
   end subroutine attempt_1_3

   !> One equation, five stages.
   subroutine attempt_1_5(self, context, error)
      integer, parameter :: n = 1, s = 5
      include "attempt_of_few.inc"
   end subroutine attempt_1_5

   !> One equation, seven stages.
   subroutine attempt_1_7(self, context, error)
      integer, parameter :: n = 1, s = 7
      include "attempt_of_few.inc"
   end subroutine attempt_1_7

   !> Two equations, three stages.
   subroutine attempt_2_3(self, context, error)
      integer, parameter :: n = 2, s = 3
      include "attempt_of_few.inc"
   end subroutine attempt_2_3

   !> Two equations, five stages.
   subroutine attempt_2_5(self, context, error)
      integer, parameter :: n = 2, s = 5
      include "attempt_of_few.inc"
   end subroutine attempt_2_5

   !> Two equations, seven stages.
   subroutine attempt_2_7(self, context, error)
      integer, parameter :: n = 2, s = 7
      include "attempt_of_few.inc"
   end subroutine attempt_2_7

   !> Three equations, three stages.
   subroutine attempt_3_3(self, context, error)
      integer, parameter :: n = 3, s = 3
      include "attempt_of_few.inc"
   end subroutine attempt_3_3

   !> Three equations, five stages.
   subroutine attempt_3_5(self, context, error)
      integer, parameter :: n = 3, s = 5
      include "attempt_of_few.inc"
   end subroutine attempt_3_5

   !> Three equations, seven stages.
   subroutine attempt_3_7(self, context, error)
      integer, parameter :: n = 3, s = 7
      include "attempt_of_few.inc"
   end subroutine attempt_3_7

   !> Four equations, three stages.
   subroutine attempt_4_3(self, context, error)
      integer, parameter :: n = 4, s = 3
      include "attempt_of_few.inc"
   end subroutine attempt_4_3

   !> Four equations, five stages.
   subroutine attempt_4_5(self, context, error)
      integer, parameter :: n = 4, s = 5
      include "attempt_of_few.inc"
   end subroutine attempt_4_5

   !> Four equations, seven stages.
   subroutine attempt_4_7(self, context, error)
      integer, parameter :: n = 4, s = 7
      include "attempt_of_few.inc"
   end subroutine attempt_4_7
end module dde_attempts_of_few
