! SPDX-License-Identifier: BSD-3-Clause
!> Models for tests: any of the build, and blocks and chains from keywords, with rest as history
!> where a value is left out.
module block_builder
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_chain, only: find_neighbours
   use model_library, only: open_model
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: block_at, build_block, by_epsilon, by_gamma, by_tau, by_xi, index_of_ln_v, &
             index_of_theta, index_of_u, made, paper_law

   !> The law of equation (4).
   character(len=*), parameter :: paper_law = "slip_delayed_logarithm"
   !> Numbers of the parameters of every block; those of its law follow, kappa of a chain is last.
   integer, parameter :: by_tau = 1, by_epsilon = 2, by_xi = 3, by_gamma = 4
   !> Numbers of the states.
   integer, parameter :: index_of_theta = 1, index_of_u = 2, index_of_ln_v = 3

contains

   !> A model by its name, with all its parameters and its past.
   type(model_type) function made(name, numbers, past, keep_delays) result(model)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: numbers(:), past(:)
      !> Whether delays of 0 are delayed values, too
      logical, intent(in), optional :: keep_delays

      model = opened(name)
      call model%set(numbers, past, keep_delays)
   end function made

   !> A model that the build has made; otherwise the tests end.
   type(model_type) function opened(name) result(model)
      character(len=*), intent(in) :: name
      type(error_type), allocatable :: error

      call open_model(trim(name), model, error)
      if (allocated(error)) error stop "block_builder: "//error%message
   end function opened

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
      real(wp), allocatable :: numbers(:)
      real(wp) :: past(3)
      integer :: i, many

      if (present(law)) then
         model = opened(law)
      else
         model = opened(paper_law)
      end if
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
