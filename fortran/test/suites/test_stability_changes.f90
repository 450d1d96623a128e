!> Changes of stability with the delay and with epsilon, against the number of roots between them.
module test_stability_changes
   use block_roots, only: roots_of_block
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: relative_residual
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use root_counts, only: roots_right_of
   use stability_changes, only: changes_with_epsilon, changes_with_tau, stability_change_type
   implicit none (type, external)
   private
   public :: collect_stability_changes

contains

   !> All tests of this suite.
   subroutine collect_stability_changes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("with the delay and with epsilon", test_random_blocks), &
                   new_unittest("known crossings", test_known), &
                   new_unittest("roots of the block", test_roots)]
   end subroutine collect_stability_changes

   !> Of random blocks, with the delay from 0 and with epsilon from -1: between crossings the number
   !> of roots is the one found, and every crossing has its pair.
   subroutine test_random_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(stability_change_type), allocatable :: changes(:)
      integer :: i, total(2)

      total = 0
      do i = 1, 30
         call changes_with_tau(random_block(i), 25.0_wp, changes, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         call check_changes(changes, changes%parameters%tau, [0.0_wp, 25.0_wp], error)
         total(1) = total(1) + size(changes)
         call changes_with_epsilon(random_block(i), 2.0_wp, changes, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         call check_changes(changes, changes%parameters%epsilon, [-1.0_wp, 2.0_wp], error)
         call expect(error, all(changes%pairs_after > changes%pairs_before), &
                     "a larger epsilon makes no pair stable")
         total(2) = total(2) + size(changes)
      end do
      call expect(error, all(total > 50), "many crossings")
   end subroutine test_random_blocks

   !> Crossings ascend, join, have their pair on the axis, and the roots between them are counted.
   subroutine check_changes(changes, places, ends, error)
      type(stability_change_type), intent(in) :: changes(:)
      !> Where: tau or epsilon
      real(wp), intent(in) :: places(:)
      real(wp), intent(in) :: ends(2)
      type(error_type), allocatable, intent(inout) :: error
      type(block_parameters_type) :: p
      real(wp) :: edges(0:size(changes) + 1)
      integer :: i

      edges = [ends(1), places, ends(2)]
      do i = 1, size(changes)
         p = changes(i)%parameters
         associate (s => cmplx(0.0_wp, changes(i)%omega, kind=wp))
            call expect_between(error, relative_residual(p, s), 0.0_wp, 1.0e-11_wp, "residual")
         end associate
         call expect(error, places(i) > edges(i - 1) .and. places(i) < edges(i + 1), "ascending")
         call expect(error, pairs_at(0.5_wp*(edges(i - 1) + edges(i))) &
                     == changes(i)%pairs_before, "pairs before "//text(places(i)))
         call expect(error, pairs_at(0.5_wp*(edges(i) + edges(i + 1))) &
                     == changes(i)%pairs_after, "pairs after "//text(places(i)))
      end do

   contains

      !> Unstable pairs at another place.
      integer function pairs_at(place) result(pairs)
         real(wp), intent(in) :: place
         type(block_parameters_type) :: there

         there = p
         if (ends(1) < 0.0_wp) then
            there%epsilon = place
         else
            there%tau = place
         end if
         pairs = roots_right_of(there, 0.0_wp)/2
      end function pairs_at
   end subroutine check_changes

   !> At tau = 0 there is one epsilon, that of Routh and Hurwitz. Below the least epsilon of all
   !> Hopf curves no delay makes a change.
   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(stability_change_type), allocatable :: changes(:)

      call changes_with_epsilon(block_parameters_type(xi=0.5_wp, gamma=0.8_wp), 5.0_wp, changes, &
                                failure)
      call expect_success(error, failure)
      call expect_close(error, changes%parameters%epsilon, [0.32_wp/1.14_wp], 1.0e-14_wp, "epsilon")
      call changes_with_tau(block_parameters_type(xi=0.5_wp, gamma=0.8_wp, epsilon=0.2_wp), &
                            1.0e3_wp, changes, failure)
      call expect_success(error, failure)
      call expect(error, size(changes) == 0, "no crossing")
   end subroutine test_known

   !> The paper's torus has one unstable pair; a bound far away is refused.
   subroutine test_roots(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(block_parameters_type) :: torus
      complex(wp), allocatable :: roots(:)

      torus = block_parameters_type(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp)
      call roots_of_block(torus, -0.1_wp, roots, failure)
      call expect_success(error, failure)
      call expect(error, count(real(roots) > 0.0_wp) == 2, "one unstable pair")
      call expect_close(error, abs(aimag(roots(1)) - 0.619666_wp), 0.0_wp, 1.0e-6_wp, "frequency")
      call roots_of_block(torus, -1.0_wp, roots, failure)
      call expect_failure(error, failure, "a bound nearer to 0 expected")
      ! there are exp(100), or more than the largest number
      call roots_of_block(torus, -10.0_wp, roots, failure)
      call expect_failure(error, failure, "more than 512 roots above -10.0; a bound nearer to 0")
      call roots_of_block(torus, -100.0_wp, roots, failure)
      call expect_failure(error, failure, "more than 512 roots above -100.0; a bound nearer to 0")
   end subroutine test_roots

   !> Random parameters; every third gamma is between 1e-2 and 1e12.
   pure type(block_parameters_type) function random_block(i) result(p)
      integer, intent(in) :: i
      real(wp) :: x(4)

      x = uniform(i, 4, 0.0_wp, 1.0_wp)
      p = block_parameters_type(tau=15.0_wp*x(1), epsilon=1.5_wp*x(2), xi=0.2_wp + x(3), &
                                gamma=0.3_wp + x(4))
      if (modulo(i, 3) == 0) p%gamma = 10.0_wp**(14.0_wp*x(4) - 2.0_wp)
   end function random_block
end module test_stability_changes
