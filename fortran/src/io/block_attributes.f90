!> Parameters and history of the block in files.
module block_attributes
   use block_parameters, only: block_history_type, block_parameters_type, history_names, &
                               parameter_names, vector_of
   use dde_kinds, only: wp
   use netcdf_output, only: output_file_type
   implicit none (type, external)
   private
   public :: put_history, put_parameters

contains

   !> Write the parameters as attributes.
   subroutine put_parameters(file, parameters, but)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Parameters
      type(block_parameters_type), intent(in) :: parameters
      !> Number of a parameter that is left out, if any
      integer, intent(in), optional :: but
      real(wp) :: vector(size(parameter_names))
      integer :: i

      vector = vector_of(parameters)
      do i = 1, size(vector)
         if (present(but)) then
            if (i == but) cycle
         end if
         call file%attribute(trim(parameter_names(i)), vector(i))
      end do
   end subroutine put_parameters

   !> Write the history as attributes.
   subroutine put_history(file, history)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Values for t <= 0
      type(block_history_type), intent(in) :: history
      real(wp) :: values(size(history_names))
      integer :: i

      values = [history%theta, history%u, history%v]
      do i = 1, size(values)
         call file%attribute("history_"//trim(history_names(i)), values(i))
      end do
   end subroutine put_history
end module block_attributes
