! SPDX-License-Identifier: BSD-3-Clause
!> Hopf points on lines of one parameter, against the closed form and against the number of roots
!> between them.
module test_hopf_lines
   use block_builder, only: block_at, by_epsilon, by_gamma, by_tau, by_xi
   use characteristic_function, only: characteristic_of
   use closed_form, only: closed_epsilon, closed_tau
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use paper_equations, only: relative_residual
   use pseudo_random, only: uniform
   use root_counts, only: roots_right_of
   implicit none (type, external)
   private
   public :: collect_hopf_lines

contains

   subroutine collect_hopf_lines(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("with the delay and with epsilon", test_random_blocks), &
                   new_unittest("known crossings", test_known), &
                   new_unittest("along a law's own parameter", test_own_parameter)]
   end subroutine collect_hopf_lines

   !> Hopf points along one parameter of a block.
   subroutine find_along(block, along, ends, found, error)
      type(model_type), intent(in) :: block
      integer, intent(in) :: along
      real(wp), intent(in) :: ends(2)
      type(hopf_on_line_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: numbers(size(block%numbers), 2)

      numbers = spread(block%numbers, 2, 2)
      numbers(along, :) = ends
      call find_hopf_on_line(block, numbers(:, 1), numbers(:, 2), 400, found, failure)
      call expect_success(error, failure)
   end subroutine find_along

   !> Of random blocks, with the delay from 0, where the closed form says how many there are, and
   !> with epsilon from -1.
   subroutine test_random_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: found(:)
      type(model_type) :: block
      integer :: i, total(2)
      real(wp), parameter :: delays(2) = [0.0_wp, 25.0_wp], epsilons(2) = [-1.0_wp, 2.0_wp]

      total = 0
      do i = 1, 30
         block = random_block(i)
         call find_along(block, by_tau, delays, found, error)
         if (allocated(error)) return
         call expect(error, size(found) == known_crossings(block%numbers, delays(2)), &
                     text(size(found))//" crossings with tau of block "//text(i))
         call check_points(block, by_tau, delays, found, error)
         total(1) = total(1) + size(found)
         call find_along(block, by_epsilon, epsilons, found, error)
         if (allocated(error)) return
         call check_points(block, by_epsilon, epsilons, found, error)
         call expect(error, all(found%roots_behind > found%roots_before), &
                     "a larger epsilon makes no pair stable")
         total(2) = total(2) + size(found)
      end do
      call expect(error, all(total > 50), "many crossings")
   end subroutine test_random_blocks

   !> Random parameters; every third gamma is between 1e-2 and 1e12.
   type(model_type) function random_block(i) result(block)
      integer, intent(in) :: i
      real(wp) :: gamma, x(4)

      x = uniform(i, 4, 0.0_wp, 1.0_wp)
      gamma = 0.3_wp + x(4)
      if (modulo(i, 3) == 0) gamma = 10.0_wp**(14.0_wp*x(4) - 2.0_wp)
      block = block_at([15.0_wp*x(1), 1.5_wp*x(2), 0.2_wp + x(3), gamma])
   end function random_block

   !> Number of delays up to a longest at which a pair is on the axis: those of all branches at the
   !> frequencies that have this epsilon.
   pure integer function known_crossings(p, longest) result(number)
      real(wp), intent(in) :: p(:), longest
      real(wp), parameter :: least = 1.0e-3_wp, growth = 1.0001_wp, most = 4.0_wp
      real(wp) :: omega
      integer :: i, k

      number = 0
      do i = 0, ceiling(log(most/least)/log(growth))
         omega = least*growth**i
         associate (here => closed_epsilon(omega, p(by_xi), p(by_gamma)) - p(by_epsilon), &
                    next => closed_epsilon(omega*growth, p(by_xi), p(by_gamma)) - p(by_epsilon))
            if (here*next > 0.0_wp) cycle
         end associate
         associate (tau => closed_tau(omega, p(by_xi), p(by_gamma), [(k, k=0, 20)]))
            number = number + count(tau > 0.0_wp .and. tau < longest)
         end associate
      end do
   end function known_crossings

   !> Points are inside, join in their order along the line, have their pair on the axis, and the
   !> roots between them are counted.
   subroutine check_points(block, along, ends, found, error)
      type(model_type), intent(in) :: block
      integer, intent(in) :: along
      real(wp), intent(in) :: ends(2)
      type(hopf_on_line_type), intent(in) :: found(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: edges(0:size(found) + 1), places(size(found))
      integer :: i, place

      places = [(found(i)%numbers(along), i=1, size(found))]
      edges = [ends(1), places, ends(2)]
      do i = 1, size(found)
         edges(1 + count(places < places(i))) = places(i)
      end do
      do i = 1, size(found)
         place = 1 + count(places < places(i))
         associate (point => found(i), p => found(i)%numbers)
            call expect_between(error, relative_residual(p, cmplx(0.0_wp, point%omega, kind=wp)), &
                                0.0_wp, 1.0e-11_wp, "residual")
            call expect(error, all(pack(p - block%numbers, [1, 2, 3, 4] /= along) &
                                   == [0.0_wp, 0.0_wp, 0.0_wp]), "on the line")
            call expect(error, p(along) > ends(1) .and. p(along) < ends(2), "inside")
            call expect(error, roots_at(0.5_wp*(edges(place - 1) + edges(place))) &
                        == point%roots_before, "roots before "//text(places(i)))
            call expect(error, roots_at(0.5_wp*(edges(place) + edges(place + 1))) &
                        == point%roots_behind, "roots behind "//text(places(i)))
         end associate
      end do

   contains

      !> Unstable roots at another place.
      integer function roots_at(place) result(number)
         real(wp), intent(in) :: place
         real(wp) :: numbers(4)

         numbers = block%numbers
         numbers(along) = place
         number = roots_right_of(characteristic_of(block_at(numbers)), 0.0_wp)
      end function roots_at
   end subroutine check_points

   !> At tau = 0 there is one epsilon, that of Routh and Hurwitz. Below the least epsilon of all
   !> curves no delay makes a change. Points with fewer turns in the delay come first. A line in tau
   !> meets Hopf points of lines in xi and gamma.
   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: across(:), found(:)
      integer, parameter :: along(2) = [by_xi, by_gamma]
      integer :: i, j

      call find_along(block_at([0.0_wp, 0.0_wp, 0.5_wp, 0.8_wp]), by_epsilon, [-1.0_wp, 5.0_wp], &
                      found, error)
      if (allocated(error)) return
      call expect(error, size(found) == 1, "one crossing without delay")
      if (allocated(error)) return
      call expect_close(error, found(1)%numbers(by_epsilon), 0.32_wp/1.14_wp, 1.0e-14_wp, "epsilon")
      call find_along(block_at([0.0_wp, 0.2_wp, 0.5_wp, 0.8_wp]), by_tau, [0.0_wp, 1.0e3_wp], &
                      found, error)
      if (allocated(error)) return
      call expect(error, size(found) == 0, "no crossing")
      do j = 1, size(along)
         call find_along(block_at([10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp]), along(j), &
                         [0.01_wp, 2.0_wp], found, error)
         if (allocated(error)) return
         call expect(error, size(found) > 0, "Hopf points")
         do i = 1, size(found)
            call find_along(block_at(found(i)%numbers), by_tau, [0.0_wp, 20.0_wp], across, error)
            if (allocated(error)) return
            associate (turns => nint(across%omega*across%delay/(2.0_wp*acos(-1.0_wp))), &
                       n => size(across))
               call expect(error, all(turns(2:) >= turns(:n - 1)), "fewer turns first")
            end associate
            call expect_close(error, minval(abs(across%delay - 10.0_wp)), 0.0_wp, 1.0e-9_wp, &
                              "tau of the line across")
         end do
      end do
   end subroutine test_known

   !> About steady sliding the law with a cut-off is the paper's at (1 + c) xi.
   subroutine test_own_parameter(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: along_c(:), of_paper(:)
      integer :: i

      call find_along(block_at([10.0_wp, 0.5_wp, 0.4_wp, 0.8_wp]), by_xi, [0.4_wp, 4.0_wp], &
                      of_paper, error)
      call find_along(block_at([10.0_wp, 0.5_wp, 0.4_wp, 0.8_wp], "slip_cut_off"), by_gamma + 1, &
                      [0.0_wp, 9.0_wp], along_c, error)
      if (allocated(error)) return
      call expect(error, size(along_c) > 0 .and. size(along_c) == size(of_paper), "as many")
      if (allocated(error)) return
      do i = 1, size(along_c)
         call expect_close(error, [0.4_wp*(1.0_wp + along_c(i)%numbers(by_gamma + 1)), &
                                   along_c(i)%omega], &
                           [of_paper(i)%numbers(by_xi), of_paper(i)%omega], 1.0e-12_wp, &
                           "(1 + c) xi and omega")
      end do
   end subroutine test_own_parameter
end module test_hopf_lines
