!> Files of the response to velocity steps.
module velocity_step_output
   use dde_errors, only: error_type
   use velocity_step_friction, only: friction_coefficient, steady_state
   use netcdf_output, only: output_file_type
   use velocity_step, only: friction_response_type, step_protocol_type
   implicit none (type, external)
   private
   public :: write_response

contains

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
end module velocity_step_output
