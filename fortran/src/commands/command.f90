! SPDX-License-Identifier: BSD-3-Clause
!> A command: what it is asked, and what it returns. It opens no file.
module command
   use dde_errors, only: error_type
   use request, only: request_type
   use results, only: results_type
   implicit none (type, external)
   private
   public :: command_type, names_of

   abstract interface
      !> Read the request, compute, fill in results.
      subroutine run_request(given, data, error)
         import :: error_type, request_type, results_type
         implicit none (type, external)
         class(request_type), intent(inout) :: given
         !> The results, by name, with their meaning
         class(results_type), intent(inout), target :: data
         !> Why there are none
         type(error_type), allocatable, intent(out) :: error
      end subroutine run_request
   end interface

   !> A command.
   type :: command_type
      !> Its name
      character(len=20) :: name
      !> What it does
      procedure(run_request), pointer, nopass :: run
      !> What it makes
      character(len=70) :: about
   end type command_type

contains

   !> Names with commas between them.
   pure function names_of(commands) result(list)
      type(command_type), intent(in) :: commands(:)
      character(len=:), allocatable :: list
      integer :: i

      list = trim(commands(1)%name)
      do i = 2, size(commands)
         list = list//", "//trim(commands(i)%name)
      end do
   end function names_of
end module command
