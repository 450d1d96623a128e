! SPDX-License-Identifier: BSD-3-Clause
!> The command line of the program: a command, a namelist file and the path of the output. How the
!> program ends.
module program_arguments
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use command, only: command_type, names_of
   use dde_errors, only: error_type, raise
   use process, only: end_at_once
   use progress, only: progress_type
   use request, only: ask, ask_for_keys, request_type
   use results, only: written_type
   use unfinished_file, only: check_place
   implicit none (type, external)
   private
   public :: check_input, command_name, run_command

   !> In place of a command or a path: what there is.
   character(len=*), parameter :: help = "--help"

contains

   !> Run the command of the first argument with the paths that the others are, or show help. If
   !> the arguments are wrong, or the input cannot be read, or the output cannot be written, the
   !> program ends.
   subroutine run_command(commands, given, data)
      !> All commands of the program
      type(command_type), intent(in) :: commands(:)
      !> What the command is asked, empty
      class(request_type), intent(inout) :: given
      !> What it returns
      class(written_type), intent(inout) :: data
      type(error_type), allocatable :: error
      integer :: at

      at = findloc(commands%name == argument(1), .true., dim=1)
      if (argument(1) == help) then
         call show_commands(commands)
      else if (at == 0) then
         call raise(error, "the command '"//argument(1)//"'; expected one of: " &
                    //names_of(commands)//", or "//help)
      else if (argument(2) == help) then
         call ask_for_keys(given)
         call commands(at)%run(given, data, error)
         write (output_unit, "(a)") trim(commands(at)%about), "", "Keys of its namelist group " &
            //"&settings, with their values where these are not given:"
         write (output_unit, "(a)", advance="no") given%keys()
         flush (output_unit)
         call end_at_once(0)
      else
         call check_paths(argument(2), argument(3), error)
         call stop_on(error)
         call check_input(argument(2))
         allocate (progress_type :: given%progress)
         call read_request(argument(2), given, error)
         call stop_on(error)
         data%path = argument(3)
         call data%begin()
         call stop_on(data%error)
         call commands(at)%run(given, data, error)
         if (allocated(error)) call data%discard()
         call stop_on(error)
         if (.not. allocated(data%error)) call data%finish()
         call stop_on(data%error)
      end if
      call stop_on(error)
   end subroutine run_command

   !> Read the text of a namelist file.
   subroutine read_request(path, given, error)
      character(len=*), intent(in) :: path
      class(request_type), intent(inout) :: given
      !> It cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: words
      character(len=256) :: reason
      integer :: length, status, unit

      open (newunit=unit, file=path, status="old", action="read", access="stream", &
            iostat=status, iomsg=reason)
      if (status == 0) then
         inquire (unit, size=length)
         allocate (character(len=max(0, length)) :: words)
         read (unit, iostat=status, iomsg=reason) words
         close (unit)
      end if
      if (status == 0) then
         call ask(given, path//": ", words)
      else
         call raise(error, path//": "//trim(reason))
      end if
   end subroutine read_request

   !> How the program is called.
   subroutine show_commands(commands)
      type(command_type), intent(in) :: commands(:)
      integer :: i

      write (output_unit, "(a)") "usage: "//argument(0)//" COMMAND NAMELIST OUTPUT", &
         "       "//argument(0)//" COMMAND "//help, ""
      do i = 1, size(commands)
         write (output_unit, "(2a)") commands(i)%name, trim(commands(i)%about)
      end do
   end subroutine show_commands

   !> Refuse paths that are missing, and an output where no file can be written.
   subroutine check_paths(namelist_path, output_path, error)
      character(len=*), intent(in) :: namelist_path, output_path
      type(error_type), allocatable, intent(out) :: error

      if (command_argument_count() /= 3) then
         call raise(error, "usage: "//argument(0)//" "//argument(1)//" NAMELIST OUTPUT")
      else if (namelist_path == "") then
         call raise(error, "the namelist path is empty; expected the path of a file")
      else if (output_path == "") then
         call raise(error, "the output path is empty; expected the path of a file")
      else
         call check_place(output_path, error)
      end if
   end subroutine check_paths

   !> Refuse to replace what the program reads: the program ends.
   subroutine check_input(input_path)
      !> Path of the file to read
      character(len=*), intent(in) :: input_path
      type(error_type), allocatable :: error
      character(len=:), allocatable :: output_path
      logical :: is_same
      integer :: status, unit

      output_path = argument(3)
      open (newunit=unit, file=input_path, status="old", action="read", iostat=status)
      ! who reads it says why it cannot be opened
      if (status /= 0) return
      inquire (file=output_path, opened=is_same)
      close (unit)
      if (is_same) call raise(error, output_path//": cannot write: it is the input "//input_path &
                              //"; expected another path")
      call stop_on(error)
   end subroutine check_input

   !> Name of the command that the program runs.
   function command_name() result(name)
      character(len=:), allocatable :: name

      name = argument(1)
   end function command_name

   !> One word of the command line.
   function argument(i) result(word)
      integer, intent(in) :: i
      character(len=:), allocatable :: word
      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(len=length) :: word)
      call get_command_argument(i, value=word)
   end function argument

   !> End the program with a message and status 1 if there is an error; with status 2 where not even
   !> the message can be written.
   subroutine stop_on(error)
      !> What went wrong, if anything
      type(error_type), allocatable, intent(in) :: error
      integer :: status

      if (.not. allocated(error)) return
      write (error_unit, "(2a)", iostat=status) "error: ", error%message
      if (status == 0) flush (error_unit, iostat=status)
      call end_at_once(merge(1, 2, status == 0))
   end subroutine stop_on
end module program_arguments
