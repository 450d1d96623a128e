! SPDX-License-Identifier: BSD-3-Clause
!> The pieces of the past between its kinks, and which of them each delay reads that moves. A step
!> reads one piece alone, also beyond its ends: its f is then smooth. It ends where t - lag passes a
!> kink, and the next step reads the next piece.
module dde_pieces
   use dde_kink, only: kink_type
   use dde_time, only: elapsed, instant
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: pieces_type

   !> The pieces.
   type :: pieces_type
      !> Kinks between them, ascending
      type(kink_type), allocatable :: kinks(:)
      !> Number of the first step after each
      integer(int64), allocatable :: first_step(:)
      !> Number of the kink with which the piece begins that each moving delay reads; 0 before the
      !> first, shape (moving)
      integer, allocatable :: begin(:)
      !> Kinks passed over, since they are too many or too near to others
      integer(int64) :: left_out = 0
   contains
      procedure :: add, forget, find, is_open
   end type pieces_type

   interface pieces_type
      module procedure :: new_pieces
   end interface pieces_type

contains

   !> One piece without kinks.
   pure type(pieces_type) function new_pieces(moving) result(pieces)
      !> Number of delays that move
      integer, intent(in) :: moving

      allocate (pieces%kinks(0), pieces%first_step(0))
      allocate (pieces%begin(moving), source=0)
   end function new_pieces

   !> A piece ends at a kink, after all others, unless it is the last of them again.
   pure subroutine add(self, kink, step, worth, same)
      class(pieces_type), intent(inout) :: self
      type(kink_type), intent(in) :: kink
      !> Number of the first step after it
      integer(int64), intent(in) :: step
      !> Whether it is worth the steps that end where delays meet it
      logical, intent(in) :: worth
      !> Distance up to which two kinks are one
      real(wp), intent(in) :: same

      associate (last => size(self%kinks))
         if (last > 0) then
            if (elapsed(self%kinks(last)%at, kink%at) <= same) then
               if (kink%passages > self%kinks(last)%passages) self%left_out = self%left_out + 1
               call self%kinks(last)%take_in(kink)
               return
            end if
         end if
      end associate
      if (.not. worth) then
         self%left_out = self%left_out + 1
         return
      end if
      self%kinks = [self%kinks, kink]
      self%first_step = [self%first_step, step]
   end subroutine add

   !> Drop the kinks before the last one that lies before `horizon`.
   pure subroutine forget(self, horizon)
      class(pieces_type), intent(inout) :: self
      !> Nothing before this time will be read
      type(instant), intent(in) :: horizon
      integer :: dropped

      dropped = count(elapsed(self%kinks%at, horizon) > 0.0_wp) - 1
      if (dropped < 1) return
      self%kinks = self%kinks(dropped + 1:)
      self%first_step = self%first_step(dropped + 1:)
      self%begin = max(0, self%begin - dropped)
   end subroutine forget

   !> Number of the kink with which the piece begins that a time lies in; the later piece at a kink.
   pure integer function find(self, now, time) result(begin)
      class(pieces_type), intent(in) :: self
      type(instant), intent(in) :: now
      !> Time after now, or before it if < 0
      real(wp), intent(in) :: time

      begin = count(elapsed(self%kinks%at, now) + time >= 0.0_wp)
   end function find

   !> Whether the piece that moving delay number j reads goes on to the present.
   pure logical function is_open(self, j) result(value)
      class(pieces_type), intent(in) :: self
      integer, intent(in) :: j

      value = self%begin(j) == size(self%kinks)
   end function is_open
end module dde_pieces
