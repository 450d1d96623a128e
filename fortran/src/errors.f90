!> Errors as values: a procedure that can fail ends with `error`, its caller tests
!> `allocated(error)`.
module errors
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: error_type, raise, text

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

   !> A real number with the digits that matter to a reader.
   pure function text_of_real(value) result(words)
      !> Number to write
      real(wp), intent(in) :: value
      character(len=:), allocatable :: words
      character(len=32) :: buffer

      write (buffer, "(g0.7)") value
      words = trim(adjustl(buffer))
   end function text_of_real

   !> An integer.
   pure function text_of_integer(value) result(words)
      !> Number to write
      integer, intent(in) :: value
      character(len=:), allocatable :: words

      words = text_of_long_integer(int(value, int64))
   end function text_of_integer

   !> A long integer.
   pure function text_of_long_integer(value) result(words)
      !> Number to write
      integer(int64), intent(in) :: value
      character(len=:), allocatable :: words
      character(len=32) :: buffer

      write (buffer, "(i0)") value
      words = trim(buffer)
   end function text_of_long_integer
end module errors
