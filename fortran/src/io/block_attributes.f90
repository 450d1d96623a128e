!> Parameters of the block and scenes in files.
module block_attributes
   use block_parameters, only: block_history_type, block_parameters_type, describe_law, &
                               history_names, parameter_names, vector_of
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use model_description, only: description_type, word_length
   use netcdf_output, only: output_file_type
   use scene_input, only: scene_type
   implicit none (type, external)
   private
   public :: key_length, key_of, put_law, put_parameters, put_scene

   !> Before names of a law's own parameters: other attributes and variables may have the bare name.
   character(len=*), parameter :: own_prefix = "law_"
   !> Letters of a key.
   integer, parameter :: key_length = word_length + len(own_prefix)

contains

   !> The key of a parameter in a file.
   elemental function key_of(name) result(key)
      !> Name of the parameter
      character(len=*), intent(in) :: name
      character(len=key_length) :: key

      key = name
      if (name /= "" .and. all(parameter_names /= name)) key = own_prefix//name
   end function key_of

   !> Write name, source, equations and own parameters of the law as attributes.
   subroutine put_law(file, parameters, but)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Parameters with their law
      type(block_parameters_type), intent(in) :: parameters
      !> Keys of parameters that are left out, if any
      character(len=*), intent(in), optional :: but(:)
      type(description_type) :: law
      character(len=:), allocatable :: equations, own
      type(error_type), allocatable :: error
      integer :: i

      call describe_law(parameters%law, law, error)
      if (allocated(error)) then
         call move_alloc(error, file%error)
         return
      end if
      call file%attribute("law", trim(parameters%law))
      call file%attribute("law_source", trim(law%source))
      equations = trim(law%equations(1))
      do i = 2, size(law%equations)
         equations = equations//"; "//trim(law%equations(i))
      end do
      call file%attribute("law_equations", equations)
      own = ""
      do i = size(parameter_names) + 1, size(law%parameters)
         if (present(but)) then
            if (any(but == key_of(law%parameters(i)%name))) cycle
         end if
         own = own//" "//trim(law%parameters(i)%name)
         call file%attribute(trim(key_of(law%parameters(i)%name)), &
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
      !> Key of a parameter that is left out
      character(len=*), intent(in), optional :: but
      real(wp), allocatable :: vector(:)
      integer :: i

      if (present(but)) then
         call put_law(file, parameters, [but])
      else
         call put_law(file, parameters)
      end if
      if (parameters%is_chain()) then
         call file%attribute("blocks", int(parameters%blocks, int64))
         call file%attribute("kappa", parameters%kappa)
         call file%attribute("ends", trim(parameters%ends))
      end if
      vector = vector_of(parameters)
      do i = 1, size(parameter_names)
         if (present(but)) then
            if (parameter_names(i) == but) cycle
         end if
         call file%attribute(trim(parameter_names(i)), vector(i))
      end do
   end subroutine put_parameters

   !> Write name and parameters of a scene as attributes, and the history: that of a chain as
   !> variables over its blocks.
   subroutine put_scene(file, scene, histories)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> The scene
      type(scene_type), intent(in) :: scene
      !> Values for t <= 0 of each block
      type(block_history_type), intent(in) :: histories(:)
      real(wp) :: values(size(history_names), size(histories))
      integer :: blocks, i

      call file%attribute("scene", trim(scene%name))
      call put_parameters(file, scene%parameters)
      values(1, :) = histories%theta
      values(2, :) = histories%u
      values(3, :) = histories%v
      if (scene%parameters%is_chain()) blocks = file%dimension("block", size(histories))
      do i = 1, size(history_names)
         associate (name => "history_"//trim(history_names(i)))
            if (scene%parameters%is_chain()) then
               call file%column(blocks, name, values(i, :), trim(history_names(i))//" for t <= 0")
            else
               call file%attribute(name, values(i, 1))
            end if
         end associate
      end do
   end subroutine put_scene
end module block_attributes
