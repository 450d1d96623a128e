!> Receivers of a solution beside which tangent vectors are integrated, interval by interval.
module interval_observer
   use dde, only: continuation_type, dde_problem_type, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: interval_observer_type

   !> An observer. An interval counts once it is kept; one that is not is repeated in shorter ones.
   type, abstract :: interval_observer_type
   contains
      !> Integrate an interval and observe it
      procedure(observe_interval), deferred :: observe_interval
      !> Keep what was seen in the last interval
      procedure(keep_interval), deferred :: keep_interval
   end type interval_observer_type

   abstract interface
      !> Integrate on up to `time` and observe. Intervals before that are not kept are forgotten.
      subroutine observe_interval(self, problem, time, options, outcome, error, continuation)
         import :: continuation_type, dde_problem_type, error_type, integration_options, &
                   integration_result, interval_observer_type, wp
         implicit none (type, external)
         !> The observer
         class(interval_observer_type), intent(inout) :: self
         !> The problem, which may have further components after those observed
         class(dde_problem_type), intent(in) :: problem
         !> Where to
         real(wp), intent(in) :: time
         !> Method and tolerances
         type(integration_options), intent(in) :: options
         !> The result
         type(integration_result), intent(out) :: outcome
         !> The run ended before its time
         type(error_type), allocatable, intent(out) :: error
         !> Where the run stands
         type(continuation_type), intent(inout) :: continuation
      end subroutine observe_interval

      !> Keep what was seen in the last interval.
      subroutine keep_interval(self)
         import :: interval_observer_type
         implicit none (type, external)
         !> The observer
         class(interval_observer_type), intent(inout) :: self
      end subroutine keep_interval
   end interface
end module interval_observer
