! SPDX-License-Identifier: BSD-3-Clause
!> The solver for delay differential equations: all that a user of it needs.
module dde
   use dde_continuation, only: continuation_type
   use dde_errors, only: error_type
   use dde_events, only: event_table, event_watcher_type
   use dde_integrator, only: integrate
   use dde_jacobian, only: find_jacobian
   use dde_kinds, only: wp
   use dde_methods, only: methods, read_by_methods
   use dde_outcome, only: event_met, integration_result, interrupted, out_of_memory, reached_end, &
                          refused, slides, step_underflow, stop_requested, too_many_steps, &
                          value_not_finite
   use dde_problem, only: dde_problem_type, not_given, problem_with_tangents
   use dde_request, only: integration_options
   use dde_sampler, only: sampler_type, table_sampler
   use dde_time, only: elapsed, instant
   implicit none (type, external)
   private
   public :: error_type, wp
   public :: dde_problem_type, find_jacobian, not_given, problem_with_tangents
   public :: elapsed, instant
   public :: continuation_type
   public :: event_table, event_watcher_type
   public :: sampler_type, table_sampler
   public :: integrate, integration_options, integration_result, methods, read_by_methods
   public :: event_met, interrupted, out_of_memory, reached_end, refused, slides
   public :: step_underflow, stop_requested, too_many_steps, value_not_finite
end module dde
