!> Response of friction to an up-step and a down-step of the imposed velocity.
module velocity_step_command
   use dde_errors, only: error_type
   use program_arguments, only: stop_on
   use velocity_step, only: friction_response_type, respond, step_protocol_type
   use velocity_step_files, only: read_protocol, write_response
   implicit none (type, external)
   private
   public :: run_velocity_step

contains

   !> Response of friction to an up-step and a down-step of the imposed velocity.
   subroutine run_velocity_step(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(error_type), allocatable :: error
      type(friction_response_type) :: response
      type(step_protocol_type) :: protocol

      call read_protocol(namelist_path, protocol, error)
      call stop_on(error)
      call respond(protocol, response, error)
      call stop_on(error)
      call write_response(output_path, protocol, response, error)
      call stop_on(error)
   end subroutine run_velocity_step
end module velocity_step_command
