!> The spring block with delayed friction, or a chain of blocks: the model of its law
!> (spring_block.yaml, chain.yaml and laws/ in this folder), by the names of its parameters. All
!> quantities are nondimensional.
module spring_block
   use block_parameters, only: block_history_type, block_parameters_type, chain_law, law_parameters
   use block_state, only: components_of_block, index_of_ln_v, index_of_theta, index_of_u
   use chain, only: blocks_in_order, find_neighbours
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_library, only: open_model
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: block_characteristic, components_of_block, find_model, index_of_ln_v, &
             index_of_theta, index_of_u, spring_block_type, transverse_block

   !> The model of a law, or of a chain, with the parameters of the block by name.
   type, extends(model_type) :: spring_block_type
      !> Parameters of the block and name of its law
      type(block_parameters_type) :: parameters
   end type spring_block_type

   interface spring_block_type
      module procedure :: new_spring_block, new_blocks
   end interface spring_block_type

contains

   !> A block, or blocks that begin alike, from the parameters, which were checked, and the history;
   !> without delay it is equation (3).
   function new_spring_block(parameters, history, keep_delays) result(block)
      type(block_parameters_type), intent(in) :: parameters
      type(block_history_type), intent(in) :: history
      !> Whether a delay of 0 is a delayed value, too; .false. unless given
      logical, intent(in), optional :: keep_delays
      type(spring_block_type) :: block

      block = new_blocks(parameters, spread(history, 1, parameters%blocks), keep_delays)
   end function new_spring_block

   !> Blocks from their parameters and their histories.
   function new_blocks(parameters, histories, keep_delays) result(block)
      type(block_parameters_type), intent(in) :: parameters
      !> That of each block
      type(block_history_type), intent(in) :: histories(:)
      !> Whether a delay of 0 is a delayed value, too; .false. unless given
      logical, intent(in), optional :: keep_delays
      type(spring_block_type) :: block

      block%parameters = parameters
      call find_model(parameters, block%model_type, histories, keep_delays)
   end function new_blocks

   !> A block of which disturbances are those of a mode of a chain: blocks that move alike, and a
   !> second difference of -stiffening times the disturbance of u, with kappa = 1.
   function transverse_block(parameters, history, stiffening, keep_delays) result(block)
      !> Parameters of one block, which were checked
      type(block_parameters_type), intent(in) :: parameters
      !> Values for t <= 0
      type(block_history_type), intent(in) :: history
      !> kappa times the eigenvalue of the mode
      real(wp), intent(in) :: stiffening
      !> Whether a delay of 0 is a delayed value, too; .false. unless given
      logical, intent(in), optional :: keep_delays
      type(spring_block_type) :: block

      block%parameters = parameters
      block%parameters%kappa = 1.0_wp
      call find_chain(block%parameters, block%model_type, [history], keep_delays)
      block%shape%mode = stiffening
   end function transverse_block

   !> The model of a law, or of a chain, with its parameters; from steady sliding unless histories
   !> are given.
   subroutine find_model(parameters, model, histories, keep_delays)
      !> Parameters, with the name of a law that there is
      type(block_parameters_type), intent(in) :: parameters
      !> The model
      type(model_type), intent(out) :: model
      !> Values for t <= 0 of each block
      type(block_history_type), intent(in), optional :: histories(:)
      !> Whether a delay of 0 is a delayed value, too; .false. unless given
      logical, intent(in), optional :: keep_delays
      type(block_history_type) :: past(parameters%blocks)

      if (present(histories)) past = histories
      if (parameters%is_chain()) then
         call find_chain(parameters, model, past, keep_delays)
      else
         call open_checked(trim(parameters%law), model)
         call model%set(law_parameters(parameters, model), states_of(past), keep_delays)
      end if
   end subroutine find_model

   !> The model of a chain, even of one block.
   subroutine find_chain(parameters, model, histories, keep_delays)
      !> Parameters, with the name of a law that chains have
      type(block_parameters_type), intent(in) :: parameters
      !> The model
      type(model_type), intent(out) :: model
      !> Values for t <= 0 of each block
      type(block_history_type), intent(in) :: histories(:)
      !> Whether a delay of 0 is a delayed value, too; .false. unless given
      logical, intent(in), optional :: keep_delays

      call open_checked(chain_law(parameters%law), model)
      associate (blocks => parameters%blocks, ends => parameters%ends)
         call find_neighbours(blocks, ends, model%left, model%right)
         call model%set(law_parameters(parameters, model), &
                        states_of(histories(blocks_in_order(blocks, ends))), keep_delays)
      end associate
   end subroutine find_chain

   !> Open a model that was there when its parameters were checked.
   subroutine open_checked(name, model)
      character(len=*), intent(in) :: name
      type(model_type), intent(out) :: model
      type(error_type), allocatable :: error

      call open_model(name, model, error)
      if (allocated(error)) error stop error%message
   end subroutine open_checked

   !> States of blocks, one after another.
   pure function states_of(histories) result(states)
      type(block_history_type), intent(in) :: histories(:)
      real(wp) :: states(components_of_block*size(histories))
      integer :: i

      do i = 1, size(histories)
         states(components_of_block*(i - 1) + 1:components_of_block*i) &
            = [histories(i)%theta, histories(i)%u, log(histories(i)%v)]
      end do
   end function states_of

   !> The characteristic function of steady sliding.
   type(characteristic_type) function block_characteristic(parameters) result(function_of_block)
      !> Parameters, with the name of a law that there is
      type(block_parameters_type), intent(in) :: parameters
      type(model_type) :: model

      call find_model(parameters, model)
      function_of_block = characteristic_of(model)
   end function block_characteristic
end module spring_block
