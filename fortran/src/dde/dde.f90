!> The solver for delay differential equations: all that a user of it needs.
module dde
   use dde_integrator, only: integrate
   use dde_outcome, only: integration_result, reached_end, refused, step_underflow, &
                          too_many_steps, value_not_finite
   use dde_problem, only: dde_problem_type
   use dde_request, only: integration_options
   use dde_sampler, only: sampler_type, table_sampler
   implicit none (type, external)
   private
   public :: dde_problem_type
   public :: sampler_type, table_sampler
   public :: integrate, integration_options, integration_result
   public :: reached_end, refused, step_underflow, too_many_steps, value_not_finite
end module dde
