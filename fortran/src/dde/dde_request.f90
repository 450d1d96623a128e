!> What a caller asks of an integration, and the refusal of what cannot be done.
module dde_request
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_problem, only: dde_problem_type
   use errors, only: error_type, raise, text
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: check, integration_options

   !> Methods to choose from.
   character(len=8), parameter :: methods(5) = ["auto    ", "explicit", "radau5  ", "radau9  ", &
                                                "radau13 "]

   !> What a caller may choose.
   type :: integration_options
      !> 'auto' or 'explicit'
      character(len=8) :: method = "auto"
      !> Relative tolerance of one step
      real(wp) :: relative = 1.0e-9_wp
      !> Absolute tolerance of one step
      real(wp) :: absolute = 1.0e-9_wp
      !> Length of the first step; chosen by the solver when 0
      real(wp) :: first_step = 0.0_wp
      !> Longest step
      real(wp) :: longest_step = huge(1.0_wp)
      !> Most steps, accepted and rejected
      integer(int64) :: most_steps = 100000000_int64
   end type integration_options

contains

   !> Refuse what cannot be integrated.
   pure subroutine check(problem, t_start, t_end, options, error)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> First instant
      real(wp), intent(in) :: t_start
      !> Last instant
      real(wp), intent(in) :: t_end
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      if (problem%n < 1) then
         call raise(error, "integrate: n = "//text(problem%n)//" equations; at least 1 expected")
      else if (.not. (allocated(problem%lag) .and. allocated(problem%component))) then
         call raise(error, "integrate: lag and component are not allocated; expected to be, of " &
                    //"size 0 without delays")
      else if (size(problem%lag) /= size(problem%component)) then
         call raise(error, "integrate: "//text(size(problem%lag))//" delays for " &
                    //text(size(problem%component))//" delayed components; as many expected")
      else if (.not. all(problem%lag > 0.0_wp .and. ieee_is_finite(problem%lag))) then
         call raise(error, "integrate: smallest delay = "//text(minval(problem%lag)) &
                    //"; finite and > 0 expected")
      else if (any(problem%component < 1 .or. problem%component > problem%n)) then
         call raise(error, "integrate: a delayed component lies outside 1.."//text(problem%n))
      else if (.not. (all(ieee_is_finite([t_start, t_end])) .and. t_end > t_start)) then
         call raise(error, "integrate: t_end = "//text(t_end)//"; finite and > "//text(t_start) &
                    //" expected")
      else if (.not. (options%relative >= 0.0_wp .and. options%absolute > 0.0_wp)) then
         call raise(error, "integrate: tolerances relative = "//text(options%relative) &
                    //", absolute = "//text(options%absolute)//"; >= 0 and > 0 expected")
      else if (.not. (options%first_step >= 0.0_wp .and. ieee_is_finite(options%first_step))) then
         call raise(error, "integrate: first_step = "//text(options%first_step) &
                    //"; finite and >= 0 expected (0: chosen by the solver)")
      else if (.not. options%longest_step > 0.0_wp) then
         call raise(error, "integrate: longest_step = "//text(options%longest_step) &
                    //"; > 0 expected")
      else if (all(options%method /= methods)) then
         call raise(error, "integrate: method = '"//trim(options%method) &
                    //"'; 'auto' or 'explicit' expected")
      end if
   end subroutine check
end module dde_request
