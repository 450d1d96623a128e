! SPDX-License-Identifier: BSD-3-Clause
!> Methods for callers in C: the commands of the program, with requests and results in memory.
module delaykit_methods
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_loc, c_ptr
   use all_commands, only: list_commands
   use command, only: command_type, names_of
   use dde_errors, only: error_type, raise
   use delaykit_handles, only: message_of, string_of
   use request, only: ask, request_type
   use results, only: results_type
   implicit none (type, external)
   private

contains

   !> Run a command on a model; 0 if it succeeded, else 1 with a message.
   integer(c_int) function dk_command(model, name, namelist, result, message, length) &
      result(status) bind(c)
      !> The model or null, name of the command, and the text of its namelist
      type(c_ptr), value :: model, name, namelist
      !> The results
      type(c_ptr), intent(out) :: result
      !> Room for a message and its size
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int), value :: length
      type(command_type), allocatable :: commands(:)
      type(error_type), allocatable :: error
      type(request_type) :: given
      type(results_type), pointer :: found
      integer :: at

      allocate (found)
      result = c_loc(found)
      if (c_associated(model)) call c_f_pointer(model, given%model)
      call ask(given, "", string_of(namelist))
      commands = list_commands()
      at = findloc(commands%name == string_of(name), .true., dim=1)
      if (at > 0) then
         call commands(at)%run(given, found, error)
      else
         call raise(error, "the command '"//string_of(name)//"'; expected one of: " &
                    //names_of(commands))
      end if
      if (.not. allocated(error) .and. allocated(found%error)) error = found%error
      status = message_of(error, message, length)
   end function dk_command
end module delaykit_methods
