!> The constants of a method that the run needs.
module dde_method_constants
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: method_constants

   !> Constants of a method.
   type :: method_constants
      !> Name
      character(len=8) :: name = ""
      !> Order of the method
      integer :: order = 0
      !> The error estimate is proportional to this power of the step size
      integer :: error_order = 0
      !> Whether the method is implicit: its steps may then be longer than the shortest delay
      logical :: implicit = .false.
      !> Cost of one evaluation, in evaluations of the explicit pair
      real(wp) :: evaluation_cost = 1.0_wp
      !> Whether step control extrapolates the error from the last two steps (predictive control)
      logical :: predictive = .false.
      !> The step size is kept if the proposed ratio lies between 1 and this
      real(wp) :: largest_kept_ratio = 1.0_wp
   end type method_constants
end module dde_method_constants
