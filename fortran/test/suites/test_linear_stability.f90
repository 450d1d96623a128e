! SPDX-License-Identifier: BSD-3-Clause
!> Linear stability: characteristic roots, their number, and the first Lyapunov coefficient, also
!> at extreme gamma.
module test_linear_stability
   use, intrinsic :: iso_fortran_env, only: real128
   use block_builder, only: block_at, by_epsilon, by_gamma, by_tau, by_xi
   use characteristic_function, only: characteristic_of, characteristic_type
   use characteristic_roots, only: find_roots
   use closed_form, only: block_with_pair
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure, expect_success
   use known_models, only: known_model, neurons
   use lapack, only: solve
   use linear_system, only: linear_part, linear_system_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_roots, only: find_model_roots
   use normal_form, only: first_lyapunov_coefficient
   use root_counts, only: no_count, roots_right_of
   implicit none (type, external)
   private
   public :: collect_linear_stability

contains

   !> All tests of this suite.
   subroutine collect_linear_stability(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("branches of Lambert's W", test_lambert), &
                   new_unittest("roots on Hopf curves", test_curve_roots), &
                   new_unittest("number of roots at large parameters", test_extremes), &
                   new_unittest("refusals", test_refusals), &
                   new_unittest("two neurons", test_neurons), &
                   new_unittest("roots in quadruple precision", test_quadruple)]
   end subroutine collect_linear_stability

   !> x' = -x(t - 1): the roots are the branches of W(-1), s = -exp(-s).
   subroutine test_lambert(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      complex(wp), allocatable :: roots(:)
      complex(wp), parameter :: known(3) = [(-0.3181315052047642_wp, 1.3372357014306894_wp), &
                                            (-2.0622777295982839_wp, 7.5886311784725127_wp), &
                                            (-2.6531919740386973_wp, 13.949208334533215_wp)]
      integer :: i

      call find_roots(delayed_decay(1.0_wp), -2.8_wp, 6, 1.0_wp, roots, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      do i = 1, 3
         call expect_close(error, abs(roots(2*i - 1) - known(i)), 0.0_wp, 1.0e-13_wp, &
                           "distance to root "//text(i))
         call expect_close(error, abs(roots(2*i) - conjg(known(i))), 0.0_wp, 1.0e-13_wp, &
                           "distance to its partner")
      end do
   end subroutine test_lambert

   !> On every branch and for stiff faults the pair i omega is among the roots, and the roots beside
   !> it are counted; at the first delay there are none at gamma = 0.8.
   subroutine test_curve_roots(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: gammas(3) = [0.8_wp, 1.0e8_wp, 1.0e12_wp]
      real(wp) :: omega, p(4)
      integer :: counts(0:20), i, j, k, number

      counts = 0
      do j = 1, size(gammas)
         do i = 1, 10
            omega = 0.2_wp + 0.1_wp*i
            do k = 0, 2
               p = block_with_pair(omega, 0.5_wp, gammas(j), k)
               if (p(by_tau) < 0.0_wp) cycle
               call find_model_roots(block_at(p), -0.01_wp, roots, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, minval(abs(roots - cmplx(0.0_wp, omega, kind=wp))), &
                                 0.0_wp, 1.0e-12_wp, "distance of a root to i omega")
               number = roots_right_of(characteristic_of(block_at(p)), 0.0_wp, [omega])
               call expect(error, number == count(real(roots) > 1.0e-9_wp), &
                           "roots beside omega = "//text(omega)//" on branch "//text(k))
               if (j == 1 .and. k == 0) call expect(error, number == 0, "the first delay")
               counts(number) = counts(number) + 1
            end do
         end do
      end do
      call expect(error, all(counts([0, 2]) > 0), "points with and without unstable roots")
   end subroutine test_curve_roots

   !> Without delay Routh and Hurwitz say where the pair is lost.
   subroutine test_extremes(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: lost, p(4)
      integer :: i, j

      do i = -2, 12
         do j = -2, 2
            p = [0.0_wp, 0.0_wp, 10.0_wp**j, 10.0_wp**i]
            associate (gamma => p(by_gamma), xi => p(by_xi))
               lost = gamma**2*xi/(xi + gamma**2)
               p(by_epsilon) = 0.9_wp*lost
               call expect(error, roots_right(p, 0.0_wp) == 0, "stable at gamma = "//text(gamma) &
                           //", xi = "//text(xi))
               p(by_epsilon) = 1.1_wp*lost
               call expect(error, roots_right(p, 0.0_wp) == 2, "unstable at gamma = "//text(gamma))
            end associate
         end do
      end do
   end subroutine test_extremes

   !> Too many roots above a bound, or to count, a root less than expected, and a singular matrix.
   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      complex(wp), allocatable :: roots(:)
      type(characteristic_type) :: long
      complex(wp) :: right(2, 1), solution(2, 1)

      ! s + 1 + 2 exp(-s 1e9) has 5e8 roots to the right of the axis
      long%n = 1
      long%delay = [0.0_wp, 1.0e9_wp]
      allocate (long%coefficient(0:1, 2))
      long%coefficient(:, :) = reshape([1.0_wp, 1.0_wp, 2.0_wp, 0.0_wp], [2, 2])
      call expect(error, roots_right_of(long, 0.0_wp) == no_count, "no count")
      call find_roots(delayed_decay(1.0_wp), -8.0_wp, 948, 1.0_wp, roots, failure)
      call expect_failure(error, failure, "a bound nearer to 0 expected")
      call find_roots(delayed_decay(1.0_wp), -2.8_wp, 7, 1.0_wp, roots, failure)
      call expect_failure(error, failure, "6 simple roots instead of 7 with real part above -2.8")
      right = 1.0_wp
      call solve(reshape([(1.0_wp, 0.0_wp), (2.0_wp, 0.0_wp), (2.0_wp, 0.0_wp), &
                          (4.0_wp, 0.0_wp)], [2, 2]), right, solution, failure)
      call expect_failure(error, failure, "a regular matrix expected")
   end subroutine test_refusals

   !> DDE-BIFTOOL's demonstration: omega and l1 as published.
   subroutine test_neurons(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(known_model) :: model
      complex(wp), allocatable :: roots(:)
      real(wp) :: l1

      model = known_model(neurons, [0.8071232250_wp, 1.5_wp])
      call find_roots(linear_part(model), -0.01_wp, 2, 1.0_wp, roots, failure)
      call expect_success(error, failure)
      call expect_close(error, real(roots(1)), 0.0_wp, 1.0e-9_wp, "real part of the pair")
      call expect_close(error, aimag(roots(1)), 0.7819651621_wp, 1.0e-9_wp, "omega")
      call first_lyapunov_coefficient(model, aimag(roots(1)), l1, failure)
      call expect_success(error, failure)
      call expect_close(error, l1, -0.39615712_wp, 1.0e-8_wp, "l1")
   end subroutine test_neurons

   !> x' = -rate x(t - 1).
   pure type(linear_system_type) function delayed_decay(rate) result(system)
      real(wp), intent(in) :: rate

      allocate (system%a(1, 1, 1), source=-rate)
      system%lag = [1.0_wp]
   end function delayed_decay

   !> For gamma from 1e-2 to 1e12 there are as many roots as the principle of the argument says.
   !> Newton's method in quadruple precision moves them in the last digits only; it takes (5) over
   !> gamma^2 as a product less its delayed term.
   subroutine test_quadruple(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: p(4)
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: all_tau(5) = [0.0_wp, 0.1_wp, 1.0_wp, 7.0_wp, 10.0_wp]
      real(wp), parameter :: all_xi(3) = [0.01_wp, 0.5_wp, 10.0_wp]
      real(wp), parameter :: bounds(2) = [-0.02_wp, 0.0_wp]
      integer :: i, j, k, m, most

      most = 0
      do k = -2, 12, 2
         do j = 1, size(all_xi)
            do i = 1, size(all_tau)
               p = [all_tau(i), 1.5_wp, all_xi(j), 10.0_wp**k]
               call find_model_roots(block_at(p), bounds(1), roots, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               do m = 1, size(bounds)
                  call expect(error, count(real(roots) > bounds(m)) == roots_right(p, bounds(m)), &
                              "number of roots above "//text(bounds(m))//" at tau " &
                              //text(p(by_tau))//", xi "//text(p(by_xi))//", gamma " &
                              //text(p(by_gamma)))
               end do
               do m = 1, size(roots)
                  call expect_close(error, abs(roots(m) - quadruple_root(p, roots(m))) &
                                    /abs(roots(m)), 0.0_wp, 1.0e-13_wp, "root "//text(m) &
                                    //" at tau "//text(p(by_tau))//", gamma "//text(p(by_gamma)))
               end do
               most = max(most, size(roots))
            end do
         end do
      end do
      call expect(error, most > 8, "some blocks have many roots")
   end subroutine test_quadruple

   !> The root near a start in quadruple precision, rounded.
   pure complex(wp) function quadruple_root(p, start) result(root)
      real(wp), intent(in) :: p(:)
      complex(wp), intent(in) :: start
      complex(real128) :: delayed, s, square
      real(real128) :: inverse, tau, xi
      integer :: i

      s = start
      tau = p(by_tau)
      xi = p(by_xi)
      inverse = 1.0_real128/real(p(by_gamma), real128)**2
      do i = 1, 8
         delayed = (1.0_real128 + p(by_epsilon))/xi*exponential(-s*tau)
         square = s*s*inverse + s/xi + 1.0_real128
         s = s - ((s + 1.0_real128)*square - s*delayed) &
             /(square + (s + 1.0_real128)*(2.0_real128*s*inverse + 1.0_real128/xi) &
               - (1.0_real128 - s*tau)*delayed)
      end do
      root = cmplx(s, kind=wp)
   end function quadruple_root

   !> exp(z), for |z| up to 100, by its series at z/1024 and ten squares: not every compiler has the
   !> intrinsic function in quadruple precision.
   pure complex(real128) function exponential(z) result(value)
      complex(real128), intent(in) :: z
      integer :: i

      value = 1.0_real128
      do i = 20, 1, -1
         value = 1.0_real128 + value*z/(1024.0_real128*i)
      end do
      do i = 1, 10
         value = value*value
      end do
   end function exponential

   !> Roots to the right of a line, by the principle of the argument.
   integer function roots_right(p, bound) result(number)
      real(wp), intent(in) :: p(:), bound

      number = roots_right_of(characteristic_of(block_at(p)), bound)
   end function roots_right
end module test_linear_stability
