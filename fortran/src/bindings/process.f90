! SPDX-License-Identifier: BSD-3-Clause
!> The end of the program.
module process
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none (type, external)
   private
   public :: end_at_once

   interface
      !> End the program with this status and without the exit handlers of libraries: after a failed
      !> write, HDF5 tries to write again in its handler, and crashes.
      subroutine end_at_once(status) bind(c, name="_Exit")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine end_at_once
   end interface
end module process
