!> What the program `velocity_step` reads and writes: a velocity step and the friction law; the
!> response.
module velocity_step_files
   use dde_errors, only: error_type
   use namelist_input, only: namelist_file_type
   use netcdf_output, only: output_file_type
   use value_checks, only: check_count
   use velocity_step, only: friction_response_type, step_protocol_type
   use velocity_step_friction, only: friction_coefficient, steady_state
   implicit none (type, external)
   private
   public :: read_protocol, write_response

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

   !> Write the response, and the sizes of the two effects in the up-step.
   subroutine write_response(path, protocol, response, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What was imposed
      type(step_protocol_type), intent(in) :: protocol
      !> What was seen
      type(friction_response_type), intent(in) :: response
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows

      call file%create(path, "Response of friction to steps of the imposed velocity")
      rows = file%dimension("sample", size(response%time), coordinates="time")
      associate (law => protocol%law, v => protocol%law%v0 + protocol%delta_v)
         call file%attribute("mu0", law%mu0)
         call file%attribute("a", law%a)
         call file%attribute("b", law%b)
         call file%attribute("dc", law%dc)
         call file%attribute("v0", law%v0)
         call file%attribute("b_state", law%b_state)
         call file%attribute("delta_v", protocol%delta_v)
         call file%attribute("tolerance", protocol%tolerance)
         call file%attribute("direct_effect", &
                             friction_coefficient(law, v, steady_state(law, law%v0)) &
                             - friction_coefficient(law, law%v0, steady_state(law, law%v0)))
         call file%attribute("evolution_effect", &
                             friction_coefficient(law, v, steady_state(law, v)) &
                             - friction_coefficient(law, v, steady_state(law, law%v0)))
      end associate
      call file%column(rows, "time", response%time, "time", "s")
      call file%column(rows, "slip", response%slip, "slip", "m")
      call file%column(rows, "velocity", response%velocity, "imposed velocity", "m s-1")
      call file%column(rows, "theta", response%theta, "state", "s")
      call file%column(rows, "mu", response%mu, "friction coefficient")
      call file%finish(error)
   end subroutine write_response
end module velocity_step_files
