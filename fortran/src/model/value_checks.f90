! SPDX-License-Identifier: BSD-3-Clause
!> Values of settings that were not given, and refusal of values out of range: the message names
!> place, key, value and range.
module value_checks
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: absent, check_choice, check_count, check_number, missing, missing_count, most_samples

   !> Default of a number that must be given: not a number.
   real(wp), parameter :: missing = transfer([-1_int64, -1_int64], 1.0_wp)
   !> Default of an integer that must be given.
   integer, parameter :: missing_count = -huge(1)
   !> Default of a number that may be left out, as the last of a list.
   real(wp), parameter :: absent = huge(1.0_wp)
   !> Most samples of a run: their spectrum takes 3 GB of memory, and default integers count them.
   integer, parameter :: most_samples = 100000000

contains

   !> Refuse a number that is not finite or out of range; keep an earlier error.
   pure subroutine check_number(error, place, key, value, above, at_least)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> What stands before the key in a message, its colon included; key
      character(len=*), intent(in) :: place, key
      !> Value of the key
      real(wp), intent(in) :: value
      !> Exclusive lower bound, inclusive lower bound
      real(wp), intent(in), optional :: above, at_least
      character(len=:), allocatable :: range
      logical :: fine

      if (allocated(error)) return
      fine = ieee_is_finite(value)
      if (fine) fine = abs(value) < absent
      if (fine .and. present(above)) fine = value > above
      if (fine .and. present(at_least)) fine = value >= at_least
      if (fine) return
      range = "a finite number"
      if (present(above)) range = range//" > "//text(above)
      if (present(at_least)) range = range//" >= "//text(at_least)
      if (ieee_is_nan(value)) range = range//" (NaN: missing, or not a number)"
      if (value == absent) then
         call raise(error, place//key//" is missing; expected "//range)
      else
         call raise(error, place//key//" = "//text(value)//"; expected "//range)
      end if
   end subroutine check_number

   !> Refuse a count that is too small or too large; keep an earlier error.
   pure subroutine check_count(error, place, key, value, at_least, at_most)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> What stands before the key in a message, its colon included; key
      character(len=*), intent(in) :: place, key
      !> Value of the key, least value allowed
      integer, intent(in) :: value, at_least
      !> Most that memory and time allow
      integer, intent(in), optional :: at_most
      character(len=:), allocatable :: range
      logical :: fine

      if (allocated(error)) return
      fine = value >= at_least
      range = "a whole number >= "//text(at_least)
      if (present(at_most)) then
         fine = fine .and. value <= at_most
         range = range//" and <= "//text(at_most)
      end if
      if (.not. fine) call raise(error, place//key//" = "//text(value)//"; expected "//range)
   end subroutine check_count

   !> Refuse a word that is not among the choices; keep an earlier error.
   pure subroutine check_choice(error, place, key, value, choices)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> What stands before the key in a message, its colon included; key
      character(len=*), intent(in) :: place, key
      !> Value of the key, words allowed
      character(len=*), intent(in) :: value, choices(:)
      character(len=:), allocatable :: list
      integer :: i

      if (allocated(error) .or. any(choices == value)) return
      list = ""
      do i = 1, size(choices)
         list = list//" '"//trim(choices(i))//"'"
      end do
      call raise(error, place//key//" = '"//trim(value)//"'; expected one of"//list)
   end subroutine check_choice
end module value_checks
