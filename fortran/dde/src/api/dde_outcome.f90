!> The result of an integration, and why it ended.
module dde_outcome
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_request, only: integration_options
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: integration_result, limit_met
   public :: event_met, out_of_memory, reached_end, refused, step_underflow, too_many_steps
   public :: value_not_finite

   !> Why an integration ended.
   enum, bind(c)
      enumerator :: reached_end, event_met, refused, step_underflow, too_many_steps, &
         value_not_finite, out_of_memory
   end enum

   !> The result of an integration.
   type :: integration_result
      !> Why it ended: reached_end, event_met, step_underflow, too_many_steps, value_not_finite,
      !> out_of_memory or refused
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
      !> Breaking points landed on
      integer :: breaking_points = 0
   end type integration_result

contains

   !> The limit that forbids another attempt, or `reached_end` if none does.
   pure integer function limit_met(outcome, last_error, options, h, shortest) result(reason)
      !> Counts so far
      type(integration_result), intent(in) :: outcome
      !> Error estimate of the last attempt
      real(wp), intent(in) :: last_error
      !> Limits
      type(integration_options), intent(in) :: options
      !> Length of the next attempt
      real(wp), intent(in) :: h
      !> Length up to which a step is too short
      real(wp), intent(in) :: shortest

      reason = reached_end
      if (h <= shortest) then
         reason = step_underflow
         if (.not. ieee_is_finite(last_error)) reason = value_not_finite
      else if (outcome%accepted + outcome%rejected >= options%most_steps) then
         reason = too_many_steps
      end if
   end function limit_met
end module dde_outcome
