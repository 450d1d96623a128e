!> A velocity step and the friction law it tries, from a namelist.
module velocity_step_input
   use dde_errors, only: error_type
   use namelist_input, only: namelist_file_type
   use velocity_step, only: step_protocol_type
   use value_checks, only: check_count
   implicit none (type, external)
   private
   public :: read_protocol

contains

   !> Read and check a protocol.
   subroutine read_protocol(path, velocity_step, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The protocol
      type(step_protocol_type), intent(out) :: velocity_step
      !> Error if the file cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ velocity_step

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_count(error, path, "samples", velocity_step%samples, at_least=2)
   end subroutine read_protocol
end module velocity_step_input
