! SPDX-License-Identifier: BSD-3-Clause
!> Blocks and chains for tests from keywords; the history is rest where a value is left out.
module block_builder
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_chain, only: find_neighbours
   use model_library, only: open_model
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: block_at, build_block, by_epsilon, by_gamma, by_tau, by_xi, index_of_ln_v, &
             index_of_theta, index_of_u, paper_law

   !> The law of equation (4).
   character(len=*), parameter :: paper_law = "slip_delayed_logarithm"
   !> Numbers of the parameters of every block; those of its law follow, kappa of a chain is last.
   integer, parameter :: by_tau = 1, by_epsilon = 2, by_xi = 3, by_gamma = 4
   !> Numbers of the states.
   integer, parameter :: index_of_theta = 1, index_of_u = 2, index_of_ln_v = 3

contains

   !> A block at these parameters from this history, or blocks that begin alike.
   type(model_type) function build_block(tau, epsilon, xi, gamma, theta, u, v, law, own, blocks, &
                                         ends, keep_delays) result(model)
      real(wp), intent(in) :: tau, epsilon, xi, gamma
      real(wp), intent(in), optional :: theta, u, v
      !> Name of the model; the paper's law unless given
      character(len=*), intent(in), optional :: law
      !> Parameters beside the four, as many as the model has; 0 unless given
      real(wp), intent(in), optional :: own(:)
      !> Blocks of a chain, and its ends; one with free ends unless given
      integer, intent(in), optional :: blocks
      character(len=*), intent(in), optional :: ends
      !> Whether delays of 0 are delayed values, too
      logical, intent(in), optional :: keep_delays
      type(error_type), allocatable :: error
      character(len=:), allocatable :: name
      real(wp), allocatable :: numbers(:)
      real(wp) :: past(3)
      integer :: i, many

      name = paper_law
      if (present(law)) name = trim(law)
      call open_model(name, model, error)
      if (allocated(error)) error stop "build_block: "//error%message
      numbers = [tau, epsilon, xi, gamma, (0.0_wp, i=by_gamma + 1, model%sizes%parameters)]
      if (present(own)) then
         many = min(size(own), size(numbers) - by_gamma)
         numbers(by_gamma + 1:by_gamma + many) = own(:many)
      end if
      past = 0.0_wp
      if (present(theta)) past(index_of_theta) = theta
      if (present(u)) past(index_of_u) = u
      if (present(v)) past(index_of_ln_v) = log(v)
      many = 1
      if (present(blocks)) many = blocks
      if (present(ends)) model%ends = ends
      if (size(model%sizes%couplings) > 0) then
         call find_neighbours(many, trim(model%ends), model%left, model%right)
      end if
      call model%set(numbers, [(past, i=1, many)], keep_delays)
   end function build_block

   !> A block at rest, with delays of 0 kept.
   type(model_type) function block_at(numbers, law) result(model)
      !> All its parameters
      real(wp), intent(in) :: numbers(:)
      !> Name of the model; the paper's law unless given
      character(len=*), intent(in), optional :: law

      model = build_block(numbers(by_tau), numbers(by_epsilon), numbers(by_xi), numbers(by_gamma), &
                          law=law, own=numbers(by_gamma + 1:), keep_delays=.true.)
   end function block_at
end module block_builder
