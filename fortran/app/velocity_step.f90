!> Response of friction to an up-step and a down-step of the imposed velocity.
program velocity_step_program
   use dde_errors, only: error_type
   use program_arguments, only: get_paths, stop_on
   use velocity_step, only: friction_response_type, respond, step_protocol_type
   use velocity_step_files, only: read_protocol, write_response
   implicit none (type, external)
   character(len=:), allocatable :: namelist_path, output_path
   type(error_type), allocatable :: error
   type(friction_response_type) :: response
   type(step_protocol_type) :: protocol

   call get_paths(namelist_path, output_path)
   call read_protocol(namelist_path, protocol, error)
   call stop_on(error)
   call respond(protocol, response, error)
   call stop_on(error)
   call write_response(output_path, protocol, response, error)
   call stop_on(error)
end program velocity_step_program
