!> The program as a process: its number and its end.
module process
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none (type, external)
   private
   public :: end_at_once, number_of_process

   interface
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
