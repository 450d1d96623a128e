! SPDX-License-Identifier: BSD-3-Clause
!> Models made from definitions, in quadruple precision: all forms of each against its right-hand
!> side, and right-hand sides against published solutions, known points and one block of a chain;
!> chains of blocks, their order and their modes.
module test_generated_models
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_chain, only: blocks_in_order, chain_ends, find_neighbours, mode_eigenvalue
   use model_consistency, only: check_forms, check_model, check_rest
   use model_description, only: word_length
   use model_library, only: list_models, open_model
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   use published_problems, only: published_enzyme, published_infection
   use solving, only: at_tolerance, solve
   implicit none (type, external)
   private
   public :: collect_generated_models

   !> Numbers of blocks of chains.
   integer, parameter :: lengths(5) = [1, 2, 3, 5, 11]
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_generated_models(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("forms of all models", test_forms), &
                   new_unittest("published solutions", test_published), &
                   new_unittest("known states at rest and a Hopf point", test_rest), &
                   new_unittest("chains beside one block", test_chains), &
                   new_unittest("modes of chains", test_modes), &
                   new_unittest("order of blocks and modes", test_order)]
   end subroutine collect_generated_models

   !> A model that the build has made, at random parameters, a chain of some length: with all its
   !> delays in odd rounds, without the first in even ones, from soft to stiff.
   subroutine open_at(name, round, model)
      character(len=*), intent(in) :: name
      integer, intent(in) :: round
      type(model_type), intent(out) :: model
      type(failure_type), allocatable :: failure
      real(wp), allocatable :: numbers(:)
      integer :: ends, i, n

      call open_model(trim(name), model, failure)
      if (allocated(failure)) error stop "generated_models: "//failure%message
      numbers = uniform(10 + round, model%sizes%parameters, 0.3_wp, 1.3_wp)
      associate (names => model%names)
         where (names == "tau" .or. names == "tau1" .or. names == "q") &
            numbers = 2.0_wp*modulo(round, 2)
         where (names == "gamma" .or. names == "r") numbers = 10.0_wp**(round - 2)
      end associate
      n = 1
      if (size(model%sizes%couplings) > 0) then
         n = lengths(1 + modulo(round, size(lengths)))
         ends = 1 + modulo(round, 3)
         if (n < 3 .and. chain_ends(ends) == "ring") ends = 1
         call find_neighbours(n, chain_ends(ends), model%left, model%right)
      end if
      call model%set(numbers, [(0.0_wp, i=1, n*model%sizes%states)])
   end subroutine open_at

   !> Jacobian and series of each model at random states, within the domain of every function, and
   !> of one that is no chain its forms and characteristic function at rest. Where delays move there
   !> are neither series nor forms.
   subroutine test_forms(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      character(len=word_length), allocatable :: names(:)
      real(wp) :: least
      integer :: i, k, rounds

      names = list_models("")
      do k = 1, size(names)
         rounds = merge(15, 6, index(names(k), "chain_") == 1)
         least = merge(0.1_wp, -1.0_wp, index(names(k), "made_") == 1)
         do i = 1, rounds
            call open_at(names(k), i, model)
            call check_model(error, model, uniform(30 + i, model%n, -0.7_wp, 0.7_wp), &
                             uniform(40 + i, size(model%lag), least, 0.9_wp), trim(names(k)))
            if (model%is_chain() .or. .not. associated(model%code%steady_state)) cycle
            if (modulo(i, 2) == 0 .or. any(ieee_is_nan(model%steady_state()))) cycle
            if (model%moving == 0) call check_forms(error, model, trim(names(k)))
            call check_rest(error, model, trim(names(k)))
         end do
      end do
   end subroutine test_forms

   !> Infection and enzyme kinetics from their published start.
   subroutine test_published(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      real(wp), allocatable :: found(:, :)

      call open_at("made_infection", 1, model)
      call model%set([real(wp) ::], [5.0_wp, 0.1_wp, 1.0_wp])
      call solve(model, [40.0_wp], at_tolerance(1.0e-15_wp, "taylor"), found, error)
      if (allocated(error)) return
      call expect_close(error, found(:, 1), published_infection, 1.0e-10_wp, "infection")
      call open_at("made_enzyme", 1, model)
      call model%set([real(wp) ::], [60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      call solve(model, [160.0_wp], at_tolerance(1.0e-15_wp, "taylor"), found, error)
      if (allocated(error)) return
      call expect_close(error, found(:, 1), published_enzyme, 1.0e-9_wp, "enzyme")
   end subroutine test_published

   !> The model of Mackey and Glass at a Hopf point; without the other steady state, as at 0, where
   !> the power has no derivatives, there is none. The blocks of a chain are alike at rest.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      type(characteristic_type) :: c
      real(wp), parameter :: beta = 2.0_wp, n = 9.65_wp, rate = 0.9_wp
      real(wp), parameter :: y = (beta/rate - 1.0_wp)**(1.0_wp/n)
      real(wp), parameter :: slope = rate*(1.0_wp - n*(1.0_wp - rate/beta))
      real(wp), parameter :: omega = sqrt(slope**2 - rate**2)
      integer :: i

      call open_at("made_mackey_glass_near", 1, model)
      call model%set([beta, n, rate, acos(rate/slope)/omega], [1.2_wp])
      call expect_close(error, model%steady_state(), [y], 1.0e-32_wp, "steady state")
      call check_forms(error, model, "Mackey-Glass")
      call check_rest(error, model, "Mackey-Glass")
      c = characteristic_of(model)
      call expect_close(error, abs(c%value(cmplx(0.0_wp, omega, wp))), 0.0_wp, 1.0e-32_wp, &
                        "characteristic function at the Hopf point")
      call model%set([0.5_wp, n, rate, 1.0_wp], [1.2_wp])
      call expect(error, all(ieee_is_nan(model%steady_state())), "no steady state")
      call open_at("made_row_near", 1, model)
      call find_neighbours(1, "free", model%left, model%right)
      call model%set([0.7_wp, 0.9_wp, 1.3_wp], [0.0_wp, 0.0_wp])
      model%shape%mode = 0.8_wp
      call check_rest(error, model, "mode of a row")
      associate (rest => model%steady_state())
         call find_neighbours(4, "free", model%left, model%right)
         call model%set(model%numbers, [(0.0_wp, i=1, 8)])
         call expect_close(error, model%steady_state(), [rest, rest, rest, rest], 0.0_wp, "blocks")
      end associate
   end subroutine test_rest

   !> Chains of every law and length, with each kind of ends, are blocks and the pull of their
   !> neighbours.
   subroutine test_chains(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model, one
      character(len=word_length), allocatable :: names(:)
      real(wp), allocatable :: dydt(:), y(:), z(:)
      real(wp) :: expected(3), pull
      integer :: block, delays, i, law, shared

      names = list_models("chain_")
      do law = 1, size(names)
         do i = 1, 15
            call open_at("chain_"//names(law), i, model)
            call open_at(names(law), i, one)
            shared = size(one%numbers)
            call one%put(model%numbers(:shared))
            y = uniform(30 + i, model%n, -1.0_wp, 1.0_wp)
            z = uniform(40 + i, size(model%lag), -1.0_wp, 1.0_wp)
            delays = size(one%lag)
            dydt = 0.0_wp*y
            call model%rhs(0.0_wp, y, z, dydt)
            do block = 1, model%shape%blocks
               associate (u => y(2::3), mine => y(3*block - 2:3*block))
                  pull = -2.0_wp*u(block)
                  if (model%left(block) > 0) pull = pull + u(model%left(block))
                  if (model%right(block) > 0) pull = pull + u(model%right(block))
                  call one%rhs(0.0_wp, mine, z((block - 1)*delays + 1:block*delays), expected)
                  expected(3) = expected(3) + one%numbers(4)**2/exp(mine(3)) &
                                *model%numbers(shared + 1)*pull
               end associate
               call expect_close(error, dydt(3*block - 2:3*block), expected, &
                                 1.0e-28_wp*max(1.0_wp, maxval(abs(expected))), "equations")
            end do
         end do
      end do
   end subroutine test_chains

   !> The characteristic function of each mode of a chain is the determinant, and that of the block
   !> that it is: at xi s and gamma sqrt(s), with s = 1 + kappa times the eigenvalue.
   subroutine test_modes(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model, one
      type(characteristic_type) :: c, expected
      character(len=word_length), allocatable :: names(:)
      real(wp), allocatable :: numbers(:)
      integer :: i, law

      names = list_models("chain_")
      do law = 1, size(names)
         do i = 0, 2
            call open_at("chain_"//names(law), 3 + 2*i, model)
            call open_at(names(law), 1, one)
            call find_neighbours(1, "free", model%left, model%right)
            call model%set(model%numbers, [0.0_wp, 0.0_wp, 0.0_wp])
            model%shape%mode = 1.3_wp*i
            numbers = model%numbers(:size(one%numbers))
            associate (s => 1.0_wp + model%numbers(size(model%numbers))*model%shape%mode)
               numbers(3:4) = numbers(3:4)*[s, sqrt(s)]
            end associate
            call one%put(numbers)
            call check_rest(error, model, "mode of "//trim(names(law)))
            c = characteristic_of(model)
            expected = characteristic_of(one)
            call expect_close(error, [c%coefficient]/maxval(abs(expected%coefficient)), &
                              [expected%coefficient]/maxval(abs(expected%coefficient)), &
                              1.0e-32_wp, "modes")
         end do
      end do
   end subroutine test_modes

   !> Each block has one place, and neighbours are near each other. Second differences of modes are
   !> minus the eigenvalue times the mode.
   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      integer, allocatable :: left(:), right(:)
      real(wp), allocatable :: mode(:), shown(:)
      integer :: i, k, m, n

      call expect(error, all(blocks_in_order(5, "ring") == [1, 5, 2, 4, 3]), "five folded")
      do k = 1, size(chain_ends)
         do n = merge(3, 2, chain_ends(k) == "ring"), 10
            associate (order => blocks_in_order(n, chain_ends(k)))
               call expect(error, all([(any(order == i), i=1, n)]), "each block once")
            end associate
            call find_neighbours(n, chain_ends(k), left, right)
            call expect(error, maxval(abs([left, right] - [([(i, i=1, n)], m=1, 2)]), &
                                      mask=[left, right] > 0) <= 2, "near neighbours")
            do m = merge(1, 0, chain_ends(k) == "plate"), n - 1
               mode = mode_shape(m, n, chain_ends(k))
               shown = [0.0_wp, mode]
               call expect_close(error, shown(1 + left) + shown(1 + right) - 2.0_wp*mode, &
                                 -mode_eigenvalue(m, n, chain_ends(k))*mode, 1.0e-30_wp, &
                                 trim(chain_ends(k)))
            end do
         end do
      end do
   end subroutine test_order

   !> The mode at the places of the state vector, by the formulas of vibrating strings.
   pure function mode_shape(mode, blocks, ends) result(values)
      integer, intent(in) :: mode, blocks
      character(len=*), intent(in) :: ends
      real(wp) :: values(blocks)

      associate (j => blocks_in_order(blocks, ends))
         select case (ends)
         case ("free")
            values = cos(pi*mode*(j - 0.5_wp)/blocks)
         case ("ring")
            values = cos(2.0_wp*pi*mode*j/blocks + 0.3_wp)
         case default
            values = sin(pi*mode*j/(blocks + 1))
         end select
      end associate
   end function mode_shape
end module test_generated_models
