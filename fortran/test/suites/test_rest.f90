! SPDX-License-Identifier: BSD-3-Clause
!> Motions that approach rest, the exponents there, and the characteristic roots of the block.
module test_rest
   use block_builder, only: block_at
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use exponent_averages, only: exponent_type
   use lapack, only: eigenvalues
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use model_roots, only: find_model_roots
   use rest, only: exponents_at_rest, settles
   implicit none (type, external)
   private
   public :: collect_rest

contains

   subroutine collect_rest(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("roots of the block", test_roots), &
                   new_unittest("decay, growth and neither", test_signals), &
                   new_unittest("roots of the cubic", test_cubic)]
   end subroutine collect_rest

   !> The paper's torus has one unstable pair; a bound far away is refused.
   subroutine test_roots(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(model_type) :: torus
      complex(wp), allocatable :: roots(:)

      torus = block_at([10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp])
      call find_model_roots(torus, -0.1_wp, roots, failure)
      call expect_success(error, failure)
      call expect(error, count(real(roots) > 0.0_wp) == 2, "one unstable pair")
      call expect_close(error, abs(aimag(roots(1)) - 0.619666_wp), 0.0_wp, 1.0e-6_wp, "frequency")
      call find_model_roots(torus, -1.0_wp, roots, failure)
      call expect_failure(error, failure, "a bound nearer to 0 expected")
      ! there are exp(100), or more than the largest number
      call find_model_roots(torus, -10.0_wp, roots, failure)
      call expect_failure(error, failure, "more than 512 above -10.0; a bound nearer to 0")
      call find_model_roots(torus, -100.0_wp, roots, failure)
      call expect_failure(error, failure, "more than 512 above -100.0; a bound nearer to 0")
   end subroutine test_roots

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
      real(wp), parameter :: all_gamma(3) = [0.8_wp, 1.5_wp, 10.0_wp], xi = 0.8_wp
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
               call exponents_at_rest(block_at([0.0_wp, epsilon, xi, all_gamma(j)]), 3, &
                                      exponents, failure)
            end associate
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect_close(error, exponents%value, known, 1.0e-12_wp, &
                              "exponents at epsilon = "//text(all_epsilon(i)))
            call expect(error, all(abs(exponents%error) <= 0.0_wp), "no error bars")
         end do
      end do
   end subroutine test_cubic
end module test_rest
