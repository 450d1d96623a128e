! SPDX-License-Identifier: BSD-3-Clause
!> Receivers of samples. The integrator passes the wanted components at the wanted times, from dense
!> output. The sampler decides what is done with them.
module dde_sampler
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: sampler_type, table_sampler

   !> Receiver of samples.
   type, abstract :: sampler_type
      !> Components wanted, 1..n
      integer, allocatable :: wanted(:)
      !> Time of the next sample; beyond the end of the integration when no more are wanted
      real(wp) :: next = huge(1.0_wp)
      !> Longest time between samples as a share of the step size; the integrator then brings `next`
      !> forward, and samples follow the solution however fast it is
      real(wp) :: share_of_step = huge(1.0_wp)
      !> Work space of the integrator: dense output of the wanted components over a step, and their
      !> values at a sample
      real(wp), allocatable :: dense(:, :), values_here(:)
   contains
      !> Refuse wrong components and times
      procedure :: check => check_wanted
      !> Receive the sample of time `next` and move `next` on
      procedure(take_sample), deferred :: take
      procedure, non_overridable :: limit_next
   end type sampler_type

   abstract interface
      !> Receive the sample of time `self%next` and move `self%next` on.
      subroutine take_sample(self, y)
         import :: sampler_type, wp
         implicit none (type, external)
         class(sampler_type), intent(inout) :: self
         !> Values of the wanted components, shape (size(wanted))
         real(wp), intent(in) :: y(:)
      end subroutine take_sample
   end interface

   !> A table in memory: samples at given times.
   type, extends(sampler_type) :: table_sampler
      !> Times, ascending
      real(wp), allocatable :: time(:)
      !> Samples, shape (wanted, times); not a number where none was received
      real(wp), allocatable :: values(:, :)
      !> Number of samples received
      integer :: received = 0
   contains
      procedure :: check => check_table
      procedure :: take => take_row
   end type table_sampler

   interface table_sampler
      module procedure :: new_table
   end interface table_sampler

contains

   !> Let the next sample follow a time by no more than the share of the step.
   pure subroutine limit_next(self, time, step_size)
      class(sampler_type), intent(inout) :: self
      real(wp), intent(in) :: time, step_size

      if (self%share_of_step >= huge(1.0_wp)) return
      self%next = min(self%next, time + max(self%share_of_step*step_size, spacing(time)))
   end subroutine limit_next

   !> Refuse components outside 1..n, and samples before the run.
   pure subroutine check_wanted(self, n, t_start, goes_on, error)
      class(sampler_type), intent(in) :: self
      integer, intent(in) :: n
      real(wp), intent(in) :: t_start
      !> Whether the run goes on from an earlier one
      logical, intent(in) :: goes_on
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      if (.not. allocated(self%wanted)) then
         call raise(error, "integrate: wanted of the sampler is not allocated; components 1.." &
                    //text(n)//" expected")
         return
      end if
      do i = 1, size(self%wanted)
         if (self%wanted(i) >= 1 .and. self%wanted(i) <= n) cycle
         call raise(error, "integrate: wanted("//text(i)//") = "//text(self%wanted(i)) &
                    //" of the sampler; 1.."//text(n)//" expected")
         return
      end do
      if (.not. self%share_of_step > 0.0_wp) then
         call raise(error, "integrate: share_of_step = "//text(self%share_of_step) &
                    //" of the sampler; a number > 0 expected")
         return
      end if
      if (.not. ieee_is_nan(self%next)) then
         if (self%next >= t_start) return
      end if
      call raise(error, "integrate: next = "//text(self%next)//" of the sampler; a time from " &
                 //text(t_start)//" (t_start) on expected")
   end subroutine check_wanted

   !> Refuse times that do not ascend, and a table that an earlier run filled.
   pure subroutine check_table(self, n, t_start, goes_on, error)
      class(table_sampler), intent(in) :: self
      integer, intent(in) :: n
      real(wp), intent(in) :: t_start
      logical, intent(in) :: goes_on
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call check_wanted(self, n, t_start, goes_on, error)
      if (allocated(error) .or. .not. allocated(self%time)) return
      if (self%received > 0 .and. .not. goes_on) then
         call raise(error, "integrate: the table of samples holds "//text(self%received) &
                    //" samples of an earlier run; a new table expected, or a continuation")
         return
      end if
      do i = 1, size(self%time)
         if (ieee_is_nan(self%time(i))) then
            call raise(error, "integrate: time("//text(i)//") of the table of samples is NaN; a " &
                       //"number expected")
            return
         end if
         if (i == 1) cycle
         if (self%time(i) >= self%time(i - 1)) cycle
         call raise(error, "integrate: time("//text(i)//") = "//text(self%time(i)) &
                    //" of the table of samples after time("//text(i - 1)//") = " &
                    //text(self%time(i - 1))//"; ascending times expected")
         return
      end do
   end subroutine check_table

   !> An empty table for components `wanted` at times `time`.
   pure function new_table(wanted, time) result(table)
      !> Components wanted
      integer, intent(in) :: wanted(:)
      real(wp), intent(in) :: time(:)
      type(table_sampler) :: table

      allocate (table%wanted, source=wanted)
      allocate (table%time, source=time)
      allocate (table%values(size(wanted), size(time)))
      table%values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (size(time) > 0) table%next = time(1)
   end function new_table

   !> Fill the next row.
   subroutine take_row(self, y)
      class(table_sampler), intent(inout) :: self
      !> Values of the wanted components
      real(wp), intent(in) :: y(:)

      self%received = self%received + 1
      self%values(:, self%received) = y
      self%next = huge(1.0_wp)
      if (self%received < size(self%time)) self%next = self%time(self%received + 1)
   end subroutine take_row
end module dde_sampler
