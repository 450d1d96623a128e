! SPDX-License-Identifier: BSD-3-Clause
!> Values up to the initial time by their names: of states, or of exponentials of states.
module model_history
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use model_chain, only: blocks_in_order
   use model_description, only: description_type, word_length
   use model_problem, only: model_type
   use value_checks, only: check_count, check_number
   implicit none (type, external)
   private
   public :: display_names, history_type, read_history, shown_name, signal_name

   !> Constant histories of all blocks of a model.
   type :: history_type
      !> Names of the values, one for each state, in the order of the states
      character(len=word_length), allocatable :: names(:)
      !> Which of them are exponentials of their state
      logical, allocatable :: exponential(:)
      !> Values and states, shape (names, blocks, histories), blocks in the order of the chain
      real(wp), allocatable :: values(:, :, :), states(:, :, :)
   contains
      procedure :: count => count_histories
      procedure :: past => past_of_history
   end type history_type

contains

   !> Names under which states are shown: that of the exponential where there is one.
   pure function display_names(about) result(names)
      !> What the definition says
      type(description_type), intent(in) :: about
      character(len=word_length) :: names(size(about%states))
      integer :: i

      names = about%states
      do i = 1, size(about%auxiliaries)
         names(about%auxiliaries(i)%state) = about%auxiliaries(i)%name
      end do
   end function display_names

   !> Name of the signal.
   function signal_name(model) result(name)
      class(model_type), intent(in) :: model
      character(len=:), allocatable :: name
      character(len=word_length), allocatable :: names(:)
      type(description_type) :: about

      about = model%describe()
      names = about%states
      if (model%sizes%observed%is_exponential) names = display_names(about)
      name = trim(names(model%sizes%observed%component))
   end function signal_name

   !> Name of a component of the state: of one whose exponential has a name the logarithm of this.
   function shown_name(model, component) result(name)
      class(model_type), intent(in) :: model
      !> Number of the component
      integer, intent(in) :: component
      character(len=:), allocatable :: name
      character(len=word_length) :: names(model%sizes%states)
      type(description_type) :: about

      about = model%describe()
      names = display_names(about)
      name = trim(names(component))
      if (name /= about%states(component)) name = "ln_"//name
   end function shown_name

   !> Number of histories.
   pure integer function count_histories(self) result(number)
      class(history_type), intent(in) :: self

      number = size(self%values, 3)
   end function count_histories

   !> The states of all blocks, in their places, before the initial time.
   pure function past_of_history(self, model, number) result(past)
      class(history_type), intent(in) :: self
      !> The model with its blocks
      class(model_type), intent(in) :: model
      !> Number of the history
      integer, intent(in) :: number
      real(wp) :: past(model%n)

      associate (order => blocks_in_order(model%shape%blocks, trim(model%ends)))
         past = reshape(self%states(:, order, number), [model%n])
      end associate
   end function past_of_history

   !> Histories from their names and values. Refuse names that are not those of all states, each
   !> once, and values out of range; keep an earlier error.
   subroutine read_history(place, model, names, values, history, error)
      !> What stands before messages
      character(len=*), intent(in) :: place
      !> The model with its blocks
      class(model_type), intent(in) :: model
      !> Names of states or of their exponentials
      character(len=*), intent(in) :: names(:)
      !> Values of one name after another, block after block, history after history
      real(wp), intent(in) :: values(:)
      type(history_type), intent(out) :: history
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      type(description_type) :: about
      real(wp), allocatable :: given(:, :, :), least
      integer :: i, j, number, state

      if (allocated(error)) return
      about = model%describe()
      history%names = display_names(about)
      history%exponential = history%names /= about%states
      associate (blocks => model%shape%blocks, states => size(about%states))
         if (size(names) /= states .or. modulo(size(values), states*blocks) /= 0) then
            call raise(error, place//"history has "//text(size(names))//" names and " &
                       //text(size(values))//" values; expected "//text(states) &
                       //" names, and a value for each name and each of "//text(blocks)//" blocks")
            return
         end if
         call check_count(error, place, "number of histories", size(values)/(states*blocks), &
                          at_least=1)
         given = reshape(values, [states, blocks, size(values)/(states*blocks)])
      end associate
      allocate (history%values, history%states, source=given)
      do state = 1, size(about%states)
         associate (shown => history%names(state), own => about%states(state))
            number = findloc(names, shown, dim=1)
            if (number == 0) number = -findloc(names, own, dim=1)
            if (number == 0) then
               call raise(error, place//"history of "//trim(shown) &
                          //" is missing; expected a finite number")
            end if
            if (allocated(error)) return
            if (allocated(least)) deallocate (least)
            if (shown /= own .and. number > 0) least = 0.0_wp
            do j = 1, size(given, 3)
               do i = 1, size(given, 2)
                  call check_number(error, place, "history of "//trim(names(abs(number))), &
                                    given(abs(number), i, j), above=least)
               end do
            end do
            if (allocated(error)) return
            history%values(state, :, :) = given(abs(number), :, :)
            history%states(state, :, :) = given(abs(number), :, :)
            if (number < 0) history%values(state, :, :) = exp(given(-number, :, :))
            if (allocated(least)) history%states(state, :, :) = log(given(number, :, :))
         end associate
      end do
   end subroutine read_history
end module model_history
