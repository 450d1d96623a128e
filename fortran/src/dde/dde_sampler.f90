!> Where samples of a trajectory go: the integrator hands over the wanted components at the wanted
!> times, taken from dense output; what is done with them is the sampler's.
module dde_sampler
   use errors, only: error_type, raise, text
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: sampler_type, table_sampler

   !> Receiver of samples.
   type, abstract :: sampler_type
      !> Components wanted, 1..n
      integer, allocatable :: wanted(:)
      !> Time of the next sample; beyond the end of the integration when none is wanted
      real(wp) :: next = huge(1.0_wp)
   contains
      !> Refuse components that are not there
      procedure :: check => check_wanted
      !> Receive the sample of time `next` and move `next` on
      procedure(take_sample), deferred :: take
   end type sampler_type

   abstract interface
      !> Receive the sample of time `self%next` and move `self%next` on.
      subroutine take_sample(self, y)
         import :: sampler_type, wp
         implicit none (type, external)
         !> The sampler
         class(sampler_type), intent(inout) :: self
         !> Values of the wanted components, shape (size(wanted))
         real(wp), intent(in) :: y(:)
      end subroutine take_sample
   end interface

   !> A table in memory: samples at given times.
   type, extends(sampler_type) :: table_sampler
      !> Times, ascending
      real(wp), allocatable :: time(:)
      !> Samples, shape (wanted, times)
      real(wp), allocatable :: values(:, :)
      !> Number of samples received
      integer :: received = 0
   contains
      procedure :: take => take_row
   end type table_sampler

   interface table_sampler
      module procedure :: new_table
   end interface table_sampler

contains

   !> Refuse components that are not there.
   pure subroutine check_wanted(self, n, error)
      !> The sampler
      class(sampler_type), intent(in) :: self
      !> Number of equations
      integer, intent(in) :: n
      !> What is wrong
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
   end subroutine check_wanted

   !> An empty table for components `wanted` at times `time`.
   pure function new_table(wanted, time) result(table)
      !> Components wanted
      integer, intent(in) :: wanted(:)
      !> Times, ascending
      real(wp), intent(in) :: time(:)
      type(table_sampler) :: table

      allocate (table%wanted, source=wanted)
      allocate (table%time, source=time)
      allocate (table%values(size(wanted), size(time)))
      if (size(time) > 0) table%next = time(1)
   end function new_table

   !> Fill the next row.
   subroutine take_row(self, y)
      !> The table
      class(table_sampler), intent(inout) :: self
      !> Values of the wanted components
      real(wp), intent(in) :: y(:)

      self%received = self%received + 1
      self%values(:, self%received) = y
      self%next = huge(1.0_wp)
      if (self%received < size(self%time)) self%next = self%time(self%received + 1)
   end subroutine take_row
end module dde_sampler
