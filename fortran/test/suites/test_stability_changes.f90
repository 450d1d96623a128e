!> Changes of stability with the delay and with epsilon, against the number of roots between them;
!> blocks that approach steady sliding, and the exponents there.
module test_stability_changes
   use block_parameters, only: block_parameters_type
   use block_roots, only: roots_of_block
   use closed_form, only: block_with_pair
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use exponent_averages, only: exponent_type
   use lapack, only: eigenvalues
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use paper_equations, only: relative_residual
   use pseudo_random, only: uniform
   use root_counts, only: pairs_beside, roots_right_of
   use spring_block, only: block_characteristic
   use stability_changes, only: changes_with_epsilon, changes_with_tau, stability_change_type
   use steady_sliding, only: settles, sliding_exponents
   implicit none (type, external)
   private
   public :: collect_stability_changes

contains

   subroutine collect_stability_changes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("with the delay and with epsilon", test_random_blocks), &
                   new_unittest("known crossings", test_known), &
                   new_unittest("roots of the block", test_roots), &
                   new_unittest("decay, growth and neither", test_signals), &
                   new_unittest("roots of the cubic", test_cubic), &
                   new_unittest("Hopf points in closed form", test_hopf_points)]
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
      real(wp), intent(in) :: places(:), ends(2)
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
         pairs = roots_right_of(block_characteristic(there), 0.0_wp)/2
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

   !> An oscillation of ln v that grows at a rate, from an amplitude, in 400 units of time.
   pure function oscillation(amplitude, rate) result(w)
      real(wp), intent(in) :: amplitude, rate
      real(wp) :: w(4000)
      integer :: i

      w = [(amplitude*exp(rate*0.1_wp*i)*cos(0.7_wp*0.1_wp*i), i=0, 3999)]
   end function oscillation

   !> What shrinks by a fifth from half to half, within 0.2, comes to rest, and so does what stays
   !> within 1e-3.
   subroutine test_signals(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: fifth = -log(0.8_wp)/200.0_wp
      ! fast decay, a little over a fifth and a little less, decay still far away, none, growth,
      ! none but very small, not so small
      real(wp), parameter :: amplitude(8) = [1.0_wp, 0.1_wp, 0.1_wp, 1.0_wp, 0.1_wp, 0.01_wp, &
                                             0.9e-3_wp, 1.1e-3_wp]
      real(wp), parameter :: rate(8) = [-0.1_wp, -1.1_wp*fifth, -0.9_wp*fifth, -1.1_wp*fifth, &
                                        0.0_wp, 0.002_wp, 0.0_wp, 0.0_wp]
      logical, parameter :: known(8) = [.true., .true., .false., .false., .false., .false., &
                                        .true., .false.]
      integer :: i

      do i = 1, size(known)
         call expect(error, settles(oscillation(amplitude(i), rate(i))) .eqv. known(i), &
                     "oscillation "//text(i))
         call expect(error, settles(-oscillation(amplitude(i), rate(i))) .eqv. known(i), &
                     "oscillation of other sign "//text(i))
      end do
      call expect(error, .not. settles(spread(0.1_wp, 1, 100)), "a constant away from 0")
      call expect(error, settles(spread(0.0_wp, 1, 100)), "always at rest")
   end subroutine test_signals

   !> Without delay: the eigenvalues of the cubic's companion matrix by LAPACK.
   subroutine test_cubic(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(exponent_type), allocatable :: exponents(:)
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: all_epsilon(3) = [-0.5_wp, 0.3_wp, 0.7_wp]
      real(wp), parameter :: all_gamma(2) = [0.8_wp, 1.5_wp], xi = 0.8_wp
      real(wp) :: companion(3, 3), known(3)
      integer :: i, j

      do j = 1, size(all_gamma)
         do i = 1, size(all_epsilon)
            associate (square => all_gamma(j)**2, epsilon => all_epsilon(i))
               companion = 0.0_wp
               companion(2, 1) = 1.0_wp
               companion(3, 2) = 1.0_wp
               companion(1, :) = -[1.0_wp + square/xi, square*(1.0_wp - epsilon/xi), square]
               call eigenvalues(companion, [1.0_wp, 1.0_wp, 1.0_wp], roots, failure)
               call expect_success(error, failure)
               known = [maxval(roots%re), sum(roots%re) - maxval(roots%re) - minval(roots%re), &
                        minval(roots%re)]
               call sliding_exponents(block_parameters_type(0.0_wp, epsilon, xi, all_gamma(j)), &
                                      3, exponents, failure)
            end associate
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect_close(error, exponents%value, known, 1.0e-12_wp, &
                              "exponents at epsilon = "//text(all_epsilon(i)))
            call expect(error, all(abs(exponents%error) <= 0.0_wp), "no error bars")
         end do
      end do
      call sliding_exponents(block_parameters_type(0.0_wp, 0.3_wp, 1.0_wp, 10.0_wp), 3, exponents, &
                             failure)
      call expect_success(error, failure)
      call expect(error, size(exponents) == 2, "the third root is below the last bound, -8")
   end subroutine test_cubic

   !> On the Hopf set in closed form a pair of roots is imaginary. At the first delay and
   !> gamma = 0.8 it is the rightmost.
   subroutine test_hopf_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(exponent_type), allocatable :: exponents(:)
      real(wp), parameter :: all_omega(3) = [0.3_wp, 0.45_wp, 0.56568542494923802_wp]
      real(wp), parameter :: all_gamma(3) = [0.8_wp, 1.0e8_wp, 1.0e12_wp]
      type(block_parameters_type) :: p
      integer :: i, j, k

      do j = 1, size(all_gamma)
         do i = 1, size(all_omega)
            do k = 0, 1
               associate (omega => all_omega(i), gamma => all_gamma(j))
                  p = block_with_pair(omega, 0.8_wp, gamma, k)
                  call sliding_exponents(p, 30, exponents, failure)
                  call expect_success(error, failure)
                  if (allocated(error)) return
                  call expect(error, count(abs(exponents%value) <= 1.0e-9_wp) == 2, &
                              "two zero exponents at tau = "//text(p%tau)//", epsilon = " &
                              //text(p%epsilon)//", gamma = "//text(gamma))
                  call expect(error, count(exponents%value > 1.0e-9_wp) &
                              == 2*pairs_beside(block_characteristic(p), [omega]), &
                              "unstable pairs beside it at tau = "//text(p%tau))
                  if (j == 1 .and. k == 0) call expect(error, &
                                                       all(exponents(3:)%value < -1.0e-3_wp), &
                                                       "none at tau = "//text(p%tau))
               end associate
            end do
         end do
      end do
   end subroutine test_hopf_points
end module test_stability_changes
