!> Samples in a table, and the extremes of ln v over a finer grid between them.
module extremes_sampler
   use dde, only: sampler_type
   use dde_kinds, only: wp
   use progress_receiver, only: progress_receiver_type
   use spring_block, only: index_of_ln_v
   implicit none (type, external)
   private
   public :: extremes_sampler_type

   !> Looks at the state from one sample to the next.
   integer, parameter :: looks = 8

   !> Sampler that keeps every eighth state and the extremes of all.
   type, extends(sampler_type) :: extremes_sampler_type
      !> Times of samples, ascending from the initial time
      real(wp), allocatable :: time(:)
      !> Samples, shape (n, times); those not reached are what they were filled with
      real(wp), allocatable :: values(:, :)
      !> Number of samples received
      integer :: received = 0
      !> Smallest and largest ln v
      real(wp) :: least = huge(1.0_wp), most = -huge(1.0_wp)
      !> Receiver of the number of samples received, if any
      class(progress_receiver_type), pointer :: progress => null()
      !> Looks since the last sample
      integer, private :: looked = 0
   contains
      procedure :: take
   end type extremes_sampler_type

   interface extremes_sampler_type
      module procedure :: new_sampler
   end interface extremes_sampler_type

contains

   !> Nothing seen yet.
   pure function new_sampler(n, time, filling) result(sampler)
      !> Number of equations
      integer, intent(in) :: n
      !> Times of samples, ascending from the initial time
      real(wp), intent(in) :: time(:)
      !> What a sample not reached holds
      real(wp), intent(in) :: filling
      type(extremes_sampler_type) :: sampler
      integer :: i

      sampler%wanted = [(i, i=1, n)]
      sampler%time = time
      allocate (sampler%values(n, size(time)), source=filling)
      sampler%next = time(1)
   end function new_sampler

   !> Look at the state; keep it where a sample is due.
   subroutine take(self, y)
      !> The sampler
      class(extremes_sampler_type), intent(inout) :: self
      !> The state
      real(wp), intent(in) :: y(:)

      self%least = min(self%least, y(index_of_ln_v))
      self%most = max(self%most, y(index_of_ln_v))
      if (self%looked == 0) then
         self%received = self%received + 1
         self%values(:, self%received) = y
         if (associated(self%progress)) then
            call self%progress%advance(self%received, size(self%time))
         end if
      end if
      self%looked = modulo(self%looked + 1, looks)
      associate (last => self%received)
         if (last == size(self%time)) then
            self%next = huge(1.0_wp)
         else if (self%looked == 0) then
            self%next = self%time(last + 1)
         else
            self%next = self%time(last) + (self%time(last + 1) - self%time(last)) &
                        *self%looked/looks
         end if
      end associate
   end subroutine take
end module extremes_sampler
