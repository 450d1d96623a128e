! SPDX-License-Identifier: BSD-3-Clause
!> Models made from definitions, in quadruple precision: all forms against the right-hand side, and
!> against the same models written by hand.
module test_generated_models
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde, only: problem_with_tangents
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_consistency, only: check_forms, check_model, check_rest
   use model_description, only: word_length
   use model_library, only: list_models, open_model
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   use published_problems, only: enzyme, infection, mackey_glass
   use solving, only: at_tolerance, solve
   implicit none (type, external)
   private
   public :: collect_generated_models

contains

   subroutine collect_generated_models(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("two delays, powers, time", test_zoo), &
                   new_unittest("functions", test_functions), &
                   new_unittest("a fast state", test_fast), &
                   new_unittest("Mackey-Glass", test_mackey_glass), &
                   new_unittest("a steady state that is computed", test_rest), &
                   new_unittest("two neurons, three delays", test_neurons), &
                   new_unittest("infection and enzyme kinetics", test_runs), &
                   new_unittest("laws of friction", test_laws), &
                   new_unittest("chains", test_chains), &
                   new_unittest("a chain with time", test_row), &
                   new_unittest("modes of chains", test_modes)]
   end subroutine collect_generated_models

   !> One of everything, with both delays and with one of 0.
   subroutine test_zoo(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: zoo
      integer :: i

      call open_there(error, "made_zoo", zoo)
      if (allocated(error)) return
      do i = 0, 1
         call zoo%set([1.3_wp, 0.9_wp*i], [0.0_wp, 0.0_wp, 0.0_wp])
         call check_model(error, zoo, [0.4_wp, -0.7_wp, 0.3_wp], &
                          uniform(i + 1, size(zoo%lag), 0.1_wp, 0.9_wp), "zoo")
      end do
   end subroutine test_zoo

   !> All functions, and their derivatives at rest; with both delays and with one of 0.
   subroutine test_functions(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      integer :: i

      call open_there(error, "made_functions", model)
      if (allocated(error)) return
      do i = 0, 1
         call model%set([1.3_wp, 0.9_wp*i], [0.0_wp, 0.0_wp])
         call check_model(error, model, [0.4_wp, -0.7_wp], &
                          uniform(i + 1, size(model%lag), 0.1_wp, 0.9_wp), "functions")
      end do
      call check_forms(error, model, "functions")
      call check_rest(error, model, "functions")
   end subroutine test_functions

   !> A balance with a constant part, from soft to stiff.
   subroutine test_fast(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      integer :: i

      call open_there(error, "made_fast", model)
      if (allocated(error)) return
      do i = 0, 3
         call model%set([10.0_wp**(2*i), 1.5_wp*modulo(i, 2)], [0.0_wp, 0.0_wp])
         call check_model(error, model, [0.4_wp, -0.7_wp], &
                          uniform(i + 1, size(model%lag), 0.1_wp, 0.9_wp), "fast state")
      end do
   end subroutine test_fast

   !> Series and series of disturbances of the model written by hand; itself with and without delay.
   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: made
      type(mackey_glass) :: hand
      real(wp), dimension(0:12, 1) :: y, y_by_hand, z
      real(wp), dimension(0:12, 1, 5) :: dy, dy_by_hand, dz

      call open_there(error, "made_mackey_glass", made)
      if (allocated(error)) return
      call made%set([17.0_wp], [1.2_wp])
      hand = mackey_glass()
      z(:, 1) = uniform(1, 13, 0.2_wp, 0.9_wp)
      dz = reshape(uniform(2, 65, -1.0_wp, 1.0_wp), shape(dz))
      y(0, :) = 0.8_wp
      y_by_hand(0, :) = y(0, :)
      call made%series(0.0_wp, 0.7_wp, 12, z, y)
      call hand%series(0.0_wp, 0.7_wp, 12, z, y_by_hand)
      call expect_close(error, y(:, 1), y_by_hand(:, 1), 1.0e-25_wp, "series")
      dy(0, 1, :) = uniform(3, 5, -1.0_wp, 1.0_wp)
      dy_by_hand(0, 1, :) = dy(0, 1, :)
      call made%tangent_series(0.0_wp, 0.7_wp, 12, z, y, 5, dz, dy)
      call hand%tangent_series(0.0_wp, 0.7_wp, 12, z, y, 5, dz, dy_by_hand)
      call expect_close(error, [dy], [dy_by_hand], 1.0e-23_wp, "series of disturbances")
      call check_model(error, made, [0.8_wp], [0.9_wp], "Mackey-Glass")
      call made%set([0.0_wp], [1.2_wp])
      call check_model(error, made, [0.8_wp], [real(wp) ::], "Mackey-Glass without delay")
   end subroutine test_mackey_glass

   !> The model of Mackey and Glass, whose steady state and Hopf points are known.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      type(characteristic_type) :: c
      real(wp), parameter :: beta = 2.0_wp, n = 9.65_wp, rate = 0.9_wp
      real(wp), parameter :: y = (beta/rate - 1.0_wp)**(1.0_wp/n)
      real(wp), parameter :: slope = rate*(1.0_wp - n*(1.0_wp - rate/beta))
      real(wp), parameter :: omega = sqrt(slope**2 - rate**2)

      call open_there(error, "made_mackey_glass_near", model)
      if (allocated(error)) return
      call model%set([beta, n, rate, acos(rate/slope)/omega], [1.2_wp])
      call check_model(error, model, [0.8_wp], [0.9_wp], "Mackey-Glass")
      call expect_close(error, model%steady_state(), [y], 1.0e-32_wp, "steady state")
      call check_forms(error, model, "Mackey-Glass")
      call check_rest(error, model, "Mackey-Glass")
      c = characteristic_of(model)
      call expect_close(error, abs(c%value(cmplx(0.0_wp, omega, wp))), 0.0_wp, 1.0e-32_wp, &
                        "characteristic function at the Hopf point")
      ! without the other steady state 0, where the power has no derivatives
      call model%set([0.5_wp, n, rate, 1.0_wp], [1.2_wp])
      call expect(error, all(ieee_is_nan(model%steady_state())), "no steady state")
   end subroutine test_rest

   !> All forms, and the published Hopf point. python/gallery/neurons.py has its first Lyapunov
   !> coefficient.
   subroutine test_neurons(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: neurons
      type(characteristic_type) :: c
      complex(wp), parameter :: s = (0.0_wp, 0.7819651621_wp)

      call open_there(error, "made_neuron", neurons)
      if (allocated(error)) return
      call neurons%set([0.5_wp, -1.0_wp, 1.0_wp, 0.807123225_wp, 0.2_wp, 0.2_wp, 1.5_wp], &
                       [0.0_wp, 0.0_wp])
      call check_model(error, neurons, [0.4_wp, -0.7_wp], [0.1_wp, 0.5_wp, -0.3_wp, 0.8_wp], &
                       "neurons")
      call check_forms(error, neurons, "neurons")
      call check_rest(error, neurons, "neurons")
      c = characteristic_of(neurons)
      call expect_close(error, abs(c%value(s)), 0.0_wp, 1.0e-9_wp, &
                        "characteristic function at the Hopf point")
   end subroutine test_neurons

   !> Whole runs of models written by hand; that of the enzyme has no series.
   subroutine test_runs(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: made

      call open_there(error, "made_infection", made)
      if (allocated(error)) return
      call made%set([real(wp) ::], [5.0_wp, 0.1_wp, 1.0_wp])
      call compare_runs(error, made, infection(), 15.0_wp, "taylor")
      call check_model(error, made, [2.0_wp, 0.3_wp, 1.0_wp], [0.4_wp, 0.2_wp], "infection")
      call open_there(error, "made_enzyme", made)
      if (allocated(error)) return
      call made%set([real(wp) ::], [60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      call compare_runs(error, made, enzyme(), 6.0_wp, "dop853")
      call check_model(error, made, [50.0_wp, 12.0_wp, 9.0_wp, 15.0_wp], [14.0_wp], "enzyme")
   end subroutine test_runs

   !> Solutions of a made model by Taylor steps and of the model by hand by another method.
   subroutine compare_runs(error, made, hand, t_end, method)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: made
      class(problem_with_tangents), intent(in) :: hand
      real(wp), intent(in) :: t_end
      character(len=*), intent(in) :: method
      real(wp), allocatable :: by_hand(:, :), values(:, :)
      real(wp), parameter :: tolerance = 1.0e-18_wp

      call solve(made, [0.5_wp*t_end, t_end], at_tolerance(tolerance, "taylor"), values, error)
      call solve(hand, [0.5_wp*t_end, t_end], at_tolerance(tolerance, method), by_hand, error)
      if (allocated(error)) return
      call expect_close(error, [values], [by_hand], 1.0e-15_wp, "states")
   end subroutine compare_runs

   !> Every law at random states, with delay and without, and its derivative forms.
   subroutine test_laws(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      real(wp), allocatable :: own(:)
      character(len=word_length), allocatable :: names(:)
      integer :: i, law

      names = list_models("")
      names = pack(names, index(names, "made_") /= 1 .and. index(names, "chain_") /= 1)
      do law = 1, size(names)
         do i = 1, 8
            call open_there(error, trim(names(law)), model)
            own = uniform(10 + i, model%sizes%parameters - 4, 0.1_wp, 1.0_wp)
            ! from soft to stiff
            call model%set([2.0_wp*modulo(i, 2), uniform(20 + i, 2, 0.3_wp, 2.0_wp), &
                            10.0_wp**(i - 2), own], [0.0_wp, 0.0_wp, 0.0_wp])
            call check_model(error, model, uniform(30 + i, 3, -1.0_wp, 1.0_wp), &
                             uniform(40 + i, size(model%lag), -1.0_wp, 1.0_wp), &
                             trim(names(law)))
            if (modulo(i, 2) == 0) cycle
            call check_forms(error, model, trim(names(law)))
            call check_rest(error, model, trim(names(law)))
         end do
      end do
   end subroutine test_laws

   !> Chains of every law and length, with each kind of ends: beside one block and the pull of its
   !> neighbours, and all forms against the right-hand side.
   subroutine test_chains(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model, one
      integer, parameter :: lengths(5) = [1, 2, 3, 5, 11]
      real(wp), allocatable :: dydt(:), own(:), shared(:), y(:), z(:)
      real(wp) :: expected(3), pull
      character(len=word_length), allocatable :: names(:)
      integer :: block, i, law, n

      names = list_models("chain_")
      do law = 1, size(names)
         do i = 1, 3*size(lengths)
            n = lengths(1 + modulo(i, size(lengths)))
            call open_there(error, "chain_"//trim(names(law)), model)
            call open_there(error, trim(names(law)), one)
            own = uniform(10 + i, model%sizes%parameters - 5, 0.1_wp, 1.0_wp)
            ! from soft to stiff, with and without delay
            shared = [2.0_wp*modulo(i, 2), uniform(20 + i, 2, 0.3_wp, 2.0_wp), &
                      10.0_wp**modulo(i, 4), own]
            call put_neighbours(model, n, modulo(i, 3))
            call model%set([shared, 1.7_wp], [(0.0_wp, block=1, 3*n)])
            call one%set(shared, [0.0_wp, 0.0_wp, 0.0_wp])
            y = uniform(30 + i, 3*n, -1.0_wp, 1.0_wp)
            z = uniform(40 + i, size(model%lag), -1.0_wp, 1.0_wp)
            allocate (dydt(3*n), source=0.0_wp)
            call model%rhs(0.0_wp, y, z, dydt)
            do block = 1, n
               associate (u => y(2::3), mine => y(3*block - 2:3*block))
                  pull = -2.0_wp*u(block)
                  if (model%left(block) > 0) pull = pull + u(model%left(block))
                  if (model%right(block) > 0) pull = pull + u(model%right(block))
                  call one%rhs(0.0_wp, mine, z((block - 1)*size(one%lag) + 1:block*size(one%lag)), &
                               expected)
                  expected(3) = expected(3) + shared(4)**2/exp(mine(3))*1.7_wp*pull
               end associate
               call expect_close(error, dydt(3*block - 2:3*block), expected, &
                                 1.0e-28_wp*max(1.0_wp, maxval(abs(expected))), "equations")
            end do
            deallocate (dydt)
            call check_model(error, model, y, z, trim(names(law)))
         end do
      end do
   end subroutine test_chains

   !> The characteristic function of each mode of a chain, and that of the block that it is.
   subroutine test_modes(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model, one
      type(characteristic_type) :: c, expected
      real(wp), parameter :: kappa = 1.7_wp
      character(len=word_length), allocatable :: names(:)
      real(wp), allocatable :: own(:)
      real(wp) :: factor
      integer :: i, law

      names = list_models("chain_")
      do law = 1, size(names)
         do i = 0, 2
            call open_there(error, "chain_"//trim(names(law)), model)
            call open_there(error, trim(names(law)), one)
            if (allocated(error)) return
            own = uniform(10 + i, model%sizes%parameters - 5, 0.1_wp, 1.0_wp)
            call put_neighbours(model, 1, 0)
            call model%set([1.5_wp, 0.4_wp, 0.7_wp, 0.9_wp, own, kappa], [0.0_wp, 0.0_wp, 0.0_wp])
            model%shape%mode = 1.3_wp*i
            factor = 1.0_wp + kappa*model%shape%mode
            call one%set([1.5_wp, 0.4_wp, 0.7_wp*factor, 0.9_wp*sqrt(factor), own], &
                         [0.0_wp, 0.0_wp, 0.0_wp])
            call check_rest(error, model, "mode of "//trim(names(law)))
            c = characteristic_of(model)
            expected = characteristic_of(one)
            call expect_close(error, [c%coefficient], [expected%coefficient], 1.0e-32_wp, "modes")
         end do
      end do
      call open_there(error, "made_row_near", model)
      if (allocated(error)) return
      call put_neighbours(model, 1, 0)
      call model%set([0.7_wp, 0.9_wp, 1.3_wp], [0.0_wp, 0.0_wp])
      model%shape%mode = 0.8_wp
      call check_rest(error, model, "mode of a row")
      ! blocks are alike
      associate (rest => model%steady_state())
         call put_neighbours(model, 4, 0)
         call model%set(model%numbers, [(0.0_wp, i=1, 8)])
         call expect_close(error, model%steady_state(), [rest, rest, rest, rest], 0.0_wp, "blocks")
      end associate
   end subroutine test_modes

   !> A chain with time and several second differences.
   subroutine test_row(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: row
      integer, parameter :: lengths(3) = [1, 2, 7]
      integer :: i, n

      call open_there(error, "made_row", row)
      if (allocated(error)) return
      do i = 1, 6
         n = lengths(1 + modulo(i, 3))
         call put_neighbours(row, n, modulo(i, 2))
         call row%set([0.7_wp, 0.9_wp*modulo(i, 2), 1.3_wp], uniform(i, 2*n, -1.0_wp, 1.0_wp))
         call check_model(error, row, uniform(10 + i, 2*n, -1.0_wp, 1.0_wp), &
                          uniform(20 + i, size(row%lag), -1.0_wp, 1.0_wp), "row")
      end do
   end subroutine test_row

   !> A model that the build has made.
   subroutine open_there(error, name, model)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: name
      type(model_type), intent(out) :: model
      type(failure_type), allocatable :: failure

      call open_model(name, model, failure)
      call expect_success(error, failure)
   end subroutine open_there

   !> Neighbours of a chain with free ends, with the plate at its ends, and of a folded ring.
   subroutine put_neighbours(model, blocks, kind)
      class(model_type), intent(inout) :: model
      integer, intent(in) :: blocks, kind
      integer :: i

      model%left = [(max(i - 1, 1), i=1, blocks)]
      model%right = [(min(i + 1, blocks), i=1, blocks)]
      if (kind == 1) then
         model%left(1) = 0
         model%right(blocks) = 0
      else if (kind == 2 .and. blocks > 2) then
         model%left = [2, 1, (i, i=1, blocks - 2)]
         model%right = [(i, i=3, blocks), blocks, blocks - 1]
      end if
   end subroutine put_neighbours
end module test_generated_models
