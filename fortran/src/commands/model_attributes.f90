! SPDX-License-Identifier: BSD-3-Clause
!> Models, their parameters and histories in results.
module model_attributes
   use dde_kinds, only: int64, wp
   use model_description, only: description_type
   use model_history, only: history_type, signal_name
   use model_problem, only: model_type
   use results, only: joined, results_type
   implicit none (type, external)
   private
   public :: name_of_blocks, put_history, put_model, put_places

contains

   !> What the dimension of the blocks or nodes is called.
   pure function name_of_blocks(model) result(name)
      class(model_type), intent(in) :: model
      character(len=:), allocatable :: name

      name = trim(merge("node ", "block", model%is_network()))
   end function name_of_blocks

   !> Write name, kind, source, equations and parameters of a model as attributes.
   subroutine put_model(data, model, but)
      class(results_type), intent(inout) :: data
      class(model_type), intent(in) :: model
      !> Names of parameters that are left out, if any
      character(len=*), intent(in), optional :: but(:)
      type(description_type) :: about
      character(len=:), allocatable :: equations
      integer :: i

      about = model%describe()
      call data%attribute("model", trim(about%name))
      if (about%kind /= "") call data%attribute("model_kind", trim(about%kind))
      call data%attribute("model_source", trim(about%source))
      equations = trim(about%equations(1))
      do i = 2, size(about%equations)
         equations = equations//"; "//trim(about%equations(i))
      end do
      call data%attribute("model_equations", equations)
      call data%attribute("parameters", joined(model%names))
      call data%attribute("signal", signal_name(model))
      do i = 1, size(model%names)
         if (present(but)) then
            if (any(but == model%names(i))) cycle
         end if
         call data%attribute(trim(model%names(i)), model%numbers(i))
      end do
      if (model%shape%blocks == 1) return
      call data%attribute(name_of_blocks(model)//"s", int(model%shape%blocks, int64))
      if (model%is_chain()) call data%attribute("ends", trim(model%ends))
   end subroutine put_model

   !> Write a history as attributes, that of a chain or a network as variables over its blocks.
   subroutine put_history(data, model, history)
      class(results_type), intent(inout) :: data
      class(model_type), intent(in) :: model
      !> The history, the first of these
      type(history_type), intent(in) :: history
      character(len=:), allocatable :: name
      integer :: blocks, i

      if (.not. allocated(history%values)) return
      if (model%shape%blocks > 1) blocks = data%dimension(name_of_blocks(model), model%shape%blocks)
      do i = 1, size(history%names)
         name = "history_"//trim(history%names(i))
         associate (values => history%values(i, :, 1))
            if (model%shape%blocks > 1) then
               call data%column(blocks, name, values, trim(history%names(i))//" for t <= 0")
            else
               call data%attribute(name, values(1))
            end if
         end associate
      end do
   end subroutine put_history

   !> Write a column for each parameter.
   subroutine put_places(data, rows, model, numbers)
      class(results_type), intent(inout) :: data
      !> Dimension of the rows
      integer, intent(in) :: rows
      class(model_type), intent(in) :: model
      !> Parameters of all rows, one row after another
      real(wp), intent(in) :: numbers(:)
      type(description_type) :: about
      integer :: i

      about = model%describe()
      do i = 1, size(model%names)
         call data%column(rows, trim(model%names(i)), numbers(i::size(model%names)), &
                          trim(about%parameters(i)%meaning))
      end do
   end subroutine put_places
end module model_attributes
