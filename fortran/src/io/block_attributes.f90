!> Parameters of the block and scenes in files.
module block_attributes
   use block_parameters, only: block_parameters_type, describe_law, history_names, &
                               parameter_names, vector_of
   use dde_kinds, only: wp
   use model_problem, only: description_type
   use netcdf_output, only: output_file_type
   use scene_input, only: scene_type
   implicit none (type, external)
   private
   public :: put_law, put_parameters, put_scene

contains

   !> Write name, source, equations and own parameters of the law as attributes.
   subroutine put_law(file, parameters)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Parameters with their law
      type(block_parameters_type), intent(in) :: parameters
      type(description_type) :: law
      character(len=:), allocatable :: equations, own
      integer :: i

      call describe_law(parameters%law, law)
      call file%attribute("law", trim(parameters%law))
      call file%attribute("law_source", trim(law%source))
      equations = trim(law%equations(1))
      do i = 2, size(law%equations)
         equations = equations//"; "//trim(law%equations(i))
      end do
      call file%attribute("law_equations", equations)
      own = ""
      do i = size(parameter_names) + 1, size(law%parameters)
         own = own//" "//trim(law%parameters(i)%name)
         ! other attributes may have the bare name
         call file%attribute("law_"//trim(law%parameters(i)%name), &
                             parameters%own(i - size(parameter_names)))
      end do
      if (own /= "") call file%attribute("law_parameters", own(2:))
   end subroutine put_law

   !> Write the parameters and their law as attributes.
   subroutine put_parameters(file, parameters, but)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Parameters
      type(block_parameters_type), intent(in) :: parameters
      !> Number of a parameter that is left out, if any
      integer, intent(in), optional :: but
      real(wp) :: vector(size(parameter_names))
      integer :: i

      call put_law(file, parameters)
      vector = vector_of(parameters)
      do i = 1, size(vector)
         if (present(but)) then
            if (i == but) cycle
         end if
         call file%attribute(trim(parameter_names(i)), vector(i))
      end do
   end subroutine put_parameters

   !> Write name, parameters and history of a scene as attributes.
   subroutine put_scene(file, scene)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> The scene
      type(scene_type), intent(in) :: scene
      real(wp) :: values(size(history_names))
      integer :: i

      call file%attribute("scene", trim(scene%name))
      call put_parameters(file, scene%parameters)
      values = [scene%history%theta, scene%history%u, scene%history%v]
      do i = 1, size(values)
         call file%attribute("history_"//trim(history_names(i)), values(i))
      end do
   end subroutine put_scene
end module block_attributes
