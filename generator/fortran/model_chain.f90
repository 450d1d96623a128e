! SPDX-License-Identifier: BSD-3-Clause
!> Blocks in a row, each coupled to its neighbours by second differences of states. Here
!> is where they stand in the state vector, and which are their neighbours there.
!>
!> The blocks of a ring are folded: 1, N, 2, N - 1, ..., so that neighbours are at most two places
!> apart and the Jacobian is banded.
module model_chain
   use, intrinsic :: iso_c_binding, only: c_int
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: blocks_in_order, chain_ends, find_band, find_neighbours, mode_eigenvalue, word_length

   integer, parameter :: word_length = 8
   !> What may be beyond the last block is no neighbour, the first block, or one that moves with the
   !> plate.
   character(len=word_length), parameter :: chain_ends(3) = ["free    ", "ring    ", "plate   "]

contains

   !> The number of the block at each place of the state vector.
   pure function blocks_in_order(blocks, ends) result(order)
      !> Number of blocks
      integer, intent(in) :: blocks
      !> One of `chain_ends`
      character(len=*), intent(in) :: ends
      integer :: order(blocks), place

      do place = 1, blocks
         order(place) = place
         if (ends /= "ring") cycle
         order(place) = merge(blocks + 1 - place/2, (place + 1)/2, modulo(place, 2) == 0)
      end do
   end function blocks_in_order

   !> The places of the neighbours on both sides; 0: the plate. Without a neighbour a block is its
   !> own, so that the difference between them is 0.
   pure subroutine find_neighbours(blocks, ends, left, right)
      !> Number of blocks
      integer, intent(in) :: blocks
      !> One of `chain_ends`
      character(len=*), intent(in) :: ends
      !> Places, shape (blocks)
      integer, allocatable, intent(out) :: left(:), right(:)
      integer :: order(blocks), place_of(0:blocks + 1), i

      order = blocks_in_order(blocks, ends)
      do i = 1, blocks
         place_of(order(i)) = i
      end do
      select case (ends)
      case ("free")
         place_of([0, blocks + 1]) = place_of([1, blocks])
      case ("ring")
         place_of([0, blocks + 1]) = place_of([blocks, 1])
      case default
         place_of([0, blocks + 1]) = 0
      end select
      left = place_of(order - 1)
      right = place_of(order + 1)
   end subroutine find_neighbours

   !> The band of the Jacobian, and the equations of each delayed value.
   pure subroutine find_band(left, right, couplings, states, delays, reach, lower, upper, rows)
      !> Places of the neighbours, shape (blocks)
      integer(c_int), intent(in) :: left(:), right(:)
      !> Equations with a second difference, and states of which they take it, shape (2, couplings)
      integer, intent(in) :: couplings(:, :)
      !> States and delayed values of a block
      integer, intent(in) :: states, delays
      !> Largest distance of neighbours, at least 1
      integer(c_int), intent(out) :: reach
      !> Diagonals below and above the main one
      integer, intent(out) :: lower, upper
      !> First and last equation of each delayed value, shape (2, delayed values)
      integer, allocatable, intent(out) :: rows(:, :)
      integer :: block, k, last

      reach = 1
      do block = 1, size(left)
         associate (beside => [left(block), right(block)])
            reach = max(reach, maxval(abs(beside - block), mask=beside > 0))
         end associate
      end do
      last = states*size(left) - 1
      associate (row => couplings(1, :), column => couplings(2, :))
         lower = min(last, max(states - 1, states*reach + maxval(row - column)))
         upper = min(last, max(states - 1, states*reach + maxval(column - row)))
      end associate
      rows = reshape([((states*(block - 1) + 1, states*block, k=1, delays), &
                       block=1, size(left))], [2, size(left)*delays])
   end subroutine find_band

   !> Minus the second difference of a mode over the mode.
   pure elemental real(wp) function mode_eigenvalue(mode, blocks, ends) result(value)
      !> Number of the mode: from 0, with `plate` from 1
      integer, intent(in) :: mode
      !> Number of blocks
      integer, intent(in) :: blocks
      !> One of `chain_ends`
      character(len=*), intent(in) :: ends
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: angle

      select case (ends)
      case ("free")
         angle = pi*mode/blocks
      case ("ring")
         angle = 2.0_wp*pi*mode/blocks
      case default
         angle = pi*mode/(blocks + 1)
      end select
      ! 2 - 2 cos(angle) without its cancellation
      value = 4.0_wp*sin(0.5_wp*angle)**2
   end function mode_eigenvalue
end module model_chain
