! SPDX-License-Identifier: BSD-3-Clause
!> A model by its name, with its parameters by their names, as namelists give it.
module model_settings
   use model_chain, only: chain_ends
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use model_description, only: unbounded, word_length
   use model_library, only: list_models, open_model, path_of_model
   use model_problem, only: model_type
   use value_checks, only: absent, check_choice, check_count, check_number
   implicit none (type, external)
   private
   public :: check_numbers, model_settings_type

   !> Most parameters of a model.
   integer, parameter :: most_parameters = 1024

   !> A model with its parameters.
   type :: model_settings_type
      !> Name of the model
      character(len=word_length) :: name = ""
      !> Names of its parameters, in any order, and their values
      character(len=word_length) :: parameters(most_parameters) = ""
      real(wp) :: values(most_parameters) = absent
      !> Number of blocks of a chain, and what is beyond its ends
      integer :: blocks = 1
      character(len=word_length) :: ends = "free"
      !> Whether its units follow from its motion; otherwise its numbers are of order 1
      logical :: own_units = .false.
   contains
      procedure :: put => put_parameter
      procedure :: open => open_settings
   end type model_settings_type

contains

   !> Give a parameter a value by its name; nothing if the name is blank.
   pure subroutine put_parameter(self, name, value)
      class(model_settings_type), intent(inout) :: self
      !> Name of the parameter
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value
      integer :: number

      if (name == "") return
      number = findloc(self%parameters, name, dim=1)
      if (number == 0) number = findloc(self%parameters, "", dim=1)
      if (number == 0) return
      self%parameters(number) = name
      self%values(number) = value
   end subroutine put_parameter

   !> Open the model and give it its parameters, at rest before the initial time. Refuse a model
   !> that there is not, names that it has not, and values out of range; keep an earlier error.
   subroutine open_settings(self, place, model, error, keep_delays, at_rest, opened)
      class(model_settings_type), intent(in) :: self
      !> What stands before messages
      character(len=*), intent(in) :: place
      type(model_type), intent(out) :: model
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Whether delays of 0 are delayed values, too; .false. unless given
      logical, intent(in), optional :: keep_delays
      !> Whether the model must have a state at rest; .false. unless given
      logical, intent(in), optional :: at_rest
      !> The model, if it is open already
      type(model_type), intent(in), optional :: opened
      real(wp), allocatable :: numbers(:), state(:)
      integer :: block, blocks, i, number

      if (allocated(error)) return
      if (present(opened)) then
         model = opened
      else if (path_of_model(trim(self%name)) == "") then
         call check_choice(error, place, "model", self%name, list_models(""))
      else
         call open_model(trim(self%name), model, error)
      end if
      if (allocated(error)) return
      if (present(at_rest)) then
         if (at_rest .and. .not. associated(model%code%steady_state)) then
            call raise(error, place//"the model "//trim(self%name)//" has no state at rest; " &
                       //"expected one with steady_state in its definition")
            return
         end if
      end if
      do i = 1, most_parameters
         if (self%parameters(i) == "") cycle
         call check_choice(error, place, "parameter of the model "//trim(self%name), &
                           self%parameters(i), model%names)
      end do
      allocate (numbers(size(model%names)), source=absent)
      do i = 1, size(numbers)
         number = findloc(self%parameters, model%names(i), dim=1)
         if (number > 0) numbers(i) = self%values(number)
      end do
      call check_numbers(model, place, numbers, error)
      call check_blocks(self, model, place, error)
      if (allocated(error)) return
      model%own_units = self%own_units
      blocks = self%blocks
      call model%set_blocks(blocks, trim(self%ends))
      allocate (state(model%sizes%states), source=0.0_wp)
      if (associated(model%code%steady_state)) call model%code%steady_state(numbers, state)
      call model%set(numbers, [(state, block=1, blocks)], keep_delays)
   end subroutine open_settings

   !> Refuse a parameter out of its range, and a negative delay; keep an earlier error.
   subroutine check_numbers(model, place, numbers, error)
      type(model_type), intent(in) :: model
      !> What stands before messages
      character(len=*), intent(in) :: place
      !> All parameters, in the order of the definition
      real(wp), intent(in) :: numbers(:)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: lag(:)
      integer :: i

      do i = 1, size(numbers)
         associate (name => model%names(i), above => model%above(i), at_least => model%at_least(i))
            if (at_least > unbounded) then
               call check_number(error, place, trim(name), numbers(i), at_least=at_least)
            else if (above > unbounded) then
               call check_number(error, place, trim(name), numbers(i), above=above)
            else
               call check_number(error, place, trim(name), numbers(i))
            end if
         end associate
      end do
      if (allocated(error)) return
      lag = model%delays(numbers)
      do i = 1, size(lag)
         ! no bound of a delay that moves
         if (i > size(lag) - model%sizes%moving .and. lag(i) >= huge(1.0_wp)) cycle
         call check_number(error, place, "delay "//text(i)//" of the model", lag(i), &
                           at_least=0.0_wp)
      end do
   end subroutine check_numbers

   !> Refuse a chain that there is not; keep an earlier error.
   subroutine check_blocks(self, model, place, error)
      class(model_settings_type), intent(in) :: self
      type(model_type), intent(in) :: model
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error

      call check_count(error, place, "blocks", self%blocks, at_least=1)
      call check_choice(error, place, "ends", self%ends, chain_ends)
      if (allocated(error)) return
      if (self%blocks > 1 .and. size(model%sizes%couplings) == 0) then
         call raise(error, place//"blocks = "//text(self%blocks)//" of the model " &
                    //trim(self%name)//"; expected 1, since it has no second difference")
      else if (self%blocks > 1 .and. self%ends == "ring") then
         call check_count(error, place//"ends = ring: ", "blocks", self%blocks, at_least=3)
      end if
   end subroutine check_blocks
end module model_settings
