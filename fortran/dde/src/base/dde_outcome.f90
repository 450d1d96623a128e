! SPDX-License-Identifier: BSD-3-Clause
!> The result of an integration, and why it ended.
module dde_outcome
   use, intrinsic :: iso_c_binding, only: c_int
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: integration_result
   public :: event_met, interrupted, out_of_memory, reached_end, refused, slides, step_underflow
   public :: stop_requested, too_many_steps, value_not_finite

   !> Not 0: all runs of this process end before their next step, as `interrupted`.
   integer(c_int), volatile, bind(c, name="dde_stop_requested") :: stop_requested = 0

   !> Why an integration ended.
   enum, bind(c)
      enumerator :: reached_end, event_met, refused, step_underflow, too_many_steps, &
         value_not_finite, out_of_memory, interrupted, slides
   end enum

   !> The result of an integration.
   type :: integration_result
      !> Why it ended: reached_end, event_met, step_underflow, too_many_steps, value_not_finite,
      !> out_of_memory, interrupted, slides or refused
      integer :: reason = refused
      !> Final time reached
      real(wp) :: t = 0.0_wp
      !> State there, shape (n)
      real(wp), allocatable :: y(:)
      !> Steps accepted, and rejected
      integer(int64) :: accepted = 0, rejected = 0
      !> Right-hand sides, or Taylor series, evaluated, those for differences included
      integer(int64) :: evaluations = 0
      !> Work as `auto` counts it, in evaluations of the explicit pair: evaluations times their cost
      !> in each method, plus linear systems
      real(wp) :: work = 0.0_wp
      !> Matrices factorised
      integer(int64) :: factorisations = 0
      !> Accepted steps that were implicit
      integer(int64) :: implicit_steps = 0
      !> Changes of method
      integer(int64) :: switches = 0
      !> How often f changed its side of each switching function, shape (switches)
      integer(int64), allocatable :: switched(:)
      !> Breaking points landed on
      integer :: breaking_points = 0
      !> Kinks too many, or too near to others, for steps that end where delays meet them that move:
      !> the error estimate alone covers them
      integer(int64) :: untracked = 0
   end type integration_result
end module dde_outcome
