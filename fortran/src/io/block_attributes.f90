!> Parameters and history of the block as attributes of a file.
module block_attributes
   use block_parameters, only: block_history_type, block_parameters_type
   use netcdf_output, only: output_file_type
   implicit none (type, external)
   private
   public :: put_history, put_parameters

contains

   !> Write the parameters.
   subroutine put_parameters(file, parameters)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Parameters
      type(block_parameters_type), intent(in) :: parameters

      call file%attribute("tau", parameters%tau)
      call file%attribute("epsilon", parameters%epsilon)
      call file%attribute("xi", parameters%xi)
      call file%attribute("gamma", parameters%gamma)
   end subroutine put_parameters

   !> Write the history.
   subroutine put_history(file, history)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Values for t <= 0
      type(block_history_type), intent(in) :: history

      call file%attribute("history_theta", history%theta)
      call file%attribute("history_u", history%u)
      call file%attribute("history_v", history%v)
   end subroutine put_history
end module block_attributes
