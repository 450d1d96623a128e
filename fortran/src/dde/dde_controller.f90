!> From the error of one step to the size of the next: proportional-integral control after
!> Gustafsson (Hairer and Wanner 1996, "Solving Ordinary Differential Equations II", sec. IV.2).
module dde_controller
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: controller_type

   !> Share of the last accepted error in the next step (integral part).
   real(wp), parameter :: beta = 0.04_wp
   !> The next step aims this much below the one that would just pass.
   real(wp), parameter :: safety = 0.9_wp
   !> Bounds on the ratio of one step to the one before.
   real(wp), parameter :: least_ratio = 1.0_wp/3.0_wp, most_ratio = 6.0_wp
   !> Ratio after an evaluation that was not finite.
   real(wp), parameter :: ratio_after_failure = 0.1_wp
   !> Accepted errors count as at least this.
   real(wp), parameter :: least_error = 1.0e-4_wp

   !> Step control of one integration.
   type :: controller_type
      !> Order of the step: error ~ h**order
      integer :: order = 0
      !> Error of the last accepted step
      real(wp) :: last_error = least_error
      !> Whether the last step was rejected
      logical :: rejected = .false.
   contains
      !> Length after an accepted step
      procedure :: accept
      !> Length after a rejected step
      procedure :: reject
   end type controller_type

contains

   !> After an accepted step: replace its length by the next.
   pure subroutine accept(self, h, error)
      !> Control
      class(controller_type), intent(inout) :: self
      !> Length of the step, replaced by the next
      real(wp), intent(inout) :: h
      !> Error of the step in units of the tolerance, 0..1
      real(wp), intent(in) :: error
      real(wp) :: ratio

      ratio = most_ratio
      if (error > 0.0_wp) then
         ratio = safety*self%last_error**beta*error**(0.2_wp*beta - 1.0_wp/self%order)
         ratio = min(most_ratio, max(least_ratio, ratio))
      end if
      if (self%rejected) ratio = min(ratio, 1.0_wp)
      h = h*ratio
      self%last_error = max(error, least_error)
      self%rejected = .false.
   end subroutine accept

   !> After a rejected step: replace its length by the next try.
   pure subroutine reject(self, h, error)
      !> Control
      class(controller_type), intent(inout) :: self
      !> Length of the step, replaced by the next try
      real(wp), intent(inout) :: h
      !> Error of the step in units of the tolerance, > 1 or not finite
      real(wp), intent(in) :: error

      if (ieee_is_finite(error)) then
         h = h*max(least_ratio, safety*error**(0.2_wp*beta - 1.0_wp/self%order))
      else
         h = h*ratio_after_failure
      end if
      self%rejected = .true.
   end subroutine reject
end module dde_controller
