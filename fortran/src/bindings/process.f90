!> The program as a process: its number, whether its messages go to a terminal, and its end.
module process
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none (type, external)
   private
   public :: end_at_once, number_of_process, standard_error_is_terminal

   interface
      integer(c_int) function c_isatty(descriptor) result(value) bind(c, name="isatty")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: descriptor
      end function c_isatty

      integer(c_int) function c_getpid() result(value) bind(c, name="getpid")
         import :: c_int
         implicit none (type, external)
      end function c_getpid

      subroutine c_exit(status) bind(c, name="_Exit")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

contains

   !> Whether standard error is a terminal, not a file or a pipe.
   logical function standard_error_is_terminal() result(value)

      value = c_isatty(2_c_int) == 1
   end function standard_error_is_terminal

   !> The number of the process, which no other process of this computer has.
   integer function number_of_process() result(value)

      value = c_getpid()
   end function number_of_process

   !> End the program without the exit handlers of libraries: after a failed write, HDF5 tries to
   !> write again in its handler, and crashes.
   subroutine end_at_once(status)
      !> Exit status
      integer, intent(in) :: status

      call c_exit(int(status, c_int))
   end subroutine end_at_once
end module process
