! SPDX-License-Identifier: BSD-3-Clause
!> Errors as values: a procedure that can fail ends with `error`, its caller tests
!> `allocated(error)`.
module dde_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: check_finite, error_type, raise, text

   !> What went wrong, where, the value met and the range allowed.
   type :: error_type
      !> One sentence for people.
      character(len=:), allocatable :: message
   end type error_type

   !> A number as short text for a message.
   interface text
      module procedure :: text_of_real
      module procedure :: text_of_integer
      module procedure :: text_of_long_integer
   end interface text

contains

   !> Set an error with its message.
   pure subroutine raise(error, message)
      !> The error to set
      type(error_type), allocatable, intent(out) :: error
      !> What, where, the value met, the range allowed
      character(len=*), intent(in) :: message

      allocate (error)
      error%message = message
   end subroutine raise

   !> Refuse values that are not finite.
   pure subroutine check_finite(name, values, error)
      !> Words before the number of a value
      character(len=*), intent(in) :: name
      !> Values to look at
      real(wp), intent(in) :: values(:)
      !> The first value that is not finite
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(values)
         if (ieee_is_finite(values(i))) cycle
         call raise(error, name//"("//text(i)//") = "//text(values(i)) &
                    //"; a finite number expected")
         return
      end do
   end subroutine check_finite

   !> A real number, filled up with blanks: 15 digits, which any decimal keeps in double
   !> precision, without the zeros at their end.
   pure function written_real(value) result(words)
      real(wp), intent(in) :: value
      character(len=32) :: words
      character(len=16) :: form
      integer :: exponent_at, last, power

      if (ieee_is_finite(value)) then
         write (words, "(es32.14e3)") value
         exponent_at = index(words, "E")
         read (words(exponent_at + 1:), *) power
         if (power >= -3 .and. power < 7) then
            write (form, "(a, i0, a)") "(f32.", 14 - power, ")"
            write (words, form) value
         end if
         words = adjustl(words)
         exponent_at = scan(trim(words)//"E", "E")
         last = verify(words(:exponent_at - 1), "0", back=.true.)
         if (words(last:last) == ".") last = last + 1
         words = words(:min(last, exponent_at - 1))//words(exponent_at:)
      else
         write (words, "(g0)") value
         words = adjustl(words)
      end if
   end function written_real

   !> An integer, filled up with blanks.
   pure function written_integer(value) result(words)
      integer(int64), intent(in) :: value
      character(len=32) :: words

      write (words, "(i0)") value
   end function written_integer

   !> A real number with the digits that matter to a reader. The length of the result is a
   !> specification expression: gfortran keeps the length of an allocatable result in static
   !> storage, which threads share.
   pure function text_of_real(value) result(words)
      real(wp), intent(in) :: value
      character(len=len_trim(written_real(value))) :: words

      words = written_real(value)
   end function text_of_real

   !> An integer.
   pure function text_of_integer(value) result(words)
      integer, intent(in) :: value
      character(len=len_trim(written_integer(int(value, int64)))) :: words

      words = written_integer(int(value, int64))
   end function text_of_integer

   !> A long integer.
   pure function text_of_long_integer(value) result(words)
      integer(int64), intent(in) :: value
      character(len=len_trim(written_integer(value))) :: words

      words = written_integer(value)
   end function text_of_long_integer
end module dde_errors
