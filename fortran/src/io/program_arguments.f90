!> The command line of every program: a namelist file and the path of the output.
module program_arguments
   use, intrinsic :: iso_fortran_env, only: error_unit
   use dde_errors, only: error_type, raise
   use file_system, only: file_is_same, file_is_special, nul
   use process, only: end_at_once
   use unfinished_file, only: check_place
   implicit none (type, external)
   private
   public :: check_input, get_paths, program_name, stop_on

contains

   !> The two arguments. If there are not two, or the input cannot be read, or the output cannot be
   !> written, the program ends.
   subroutine get_paths(namelist_path, output_path)
      !> First argument
      character(len=:), allocatable, intent(out) :: namelist_path
      !> Second argument
      character(len=:), allocatable, intent(out) :: output_path
      type(error_type), allocatable :: error

      namelist_path = argument(1)
      output_path = argument(2)
      if (command_argument_count() /= 2) then
         call raise(error, "usage: "//argument(0)//" NAMELIST OUTPUT")
      else if (namelist_path == "") then
         call raise(error, "the namelist path is empty; expected the path of a file")
      else if (output_path == "") then
         call raise(error, "the output path is empty; expected the path of a file")
      else
         call check_place(output_path, error)
      end if
      call stop_on(error)
      call check_input(namelist_path, output_path)
   end subroutine get_paths

   !> Refuse to read what may have no end, and to replace what the program reads: the program ends.
   subroutine check_input(input_path, output_path)
      !> Path of the file to read
      character(len=*), intent(in) :: input_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(error_type), allocatable :: error

      if (file_is_special(input_path//nul) == 1) then
         call raise(error, input_path//": cannot be read: a folder, a device or a pipe is there; " &
                    //"expected a file")
      else if (file_is_same(input_path//nul, output_path//nul) == 1) then
         call raise(error, output_path//": cannot write: it is the input "//input_path &
                    //"; expected another path")
      end if
      call stop_on(error)
   end subroutine check_input

   !> Name of this program, without its folder.
   function program_name() result(name)
      character(len=:), allocatable :: name

      name = argument(0)
      name = name(index(name, "/", back=.true.) + 1:)
   end function program_name

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
