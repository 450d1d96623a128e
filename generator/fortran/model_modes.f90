! SPDX-License-Identifier: BSD-3-Clause
!> Modes of disturbances of a chain at rest, one for each block.
module model_modes
   use dde_kinds, only: wp
   use model_chain, only: mode_eigenvalue
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: mode_of

contains

   !> One block at rest whose disturbances are those of a mode of the chain; the model itself, with
   !> its delays of 0 kept, where it is no chain.
   function mode_of(model, number) result(block)
      !> The model
      class(model_type), intent(in) :: model
      !> Number of the mode, from 1
      integer, intent(in) :: number
      type(model_type) :: block
      real(wp) :: state(model%n)

      block%code = model%code
      block%sizes = model%sizes
      block%names = model%names
      block%own_units = model%own_units
      if (model%is_chain()) then
         block%left = [1]
         block%right = [1]
         block%shape%mode = mode_eigenvalue(number - merge(0, 1, model%ends == "plate"), &
                                            model%shape%blocks, trim(model%ends))
         ! blocks that move alike have a mode of their own, as in a chain of one block
         if (model%shape%blocks == 1) block%shape%mode = model%shape%mode
      end if
      state = model%steady_state()
      call block%set(model%numbers, state(:model%states()), keep_delays=.true.)
   end function mode_of
end module model_modes
