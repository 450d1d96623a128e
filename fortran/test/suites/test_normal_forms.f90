! SPDX-License-Identifier: BSD-3-Clause
!> Normal forms beyond the first Lyapunov coefficient.
module test_normal_forms
   use block_builder, only: block_at
   use centre_manifold, only: normal_form_coefficient
   use closed_form, only: block_with_pair
   use dde_errors, only: failure_type => error_type, text
   use double_hopf, only: double_hopf_type, find_double_hopf, word_length
   use expectations, only: expect, expect_close, expect_success
   use known_models, only: block_by_values, duffing_with_pair, known_model, layers, lienard, &
                           neurons, quadratic, transformed
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use normal_form, only: first_lyapunov_coefficient
   use pseudo_random, only: uniform
   implicit none (type, external)
   private
   public :: collect_normal_forms

contains

   subroutine collect_normal_forms(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("first order of the series is l1", test_l1), &
                   new_unittest("planar systems", test_planar), &
                   new_unittest("transformed normal form", test_transformed), &
                   new_unittest("published second coefficients", test_published_l2), &
                   new_unittest("published double Hopf points", test_published_double), &
                   new_unittest("cases of the unfolding", test_unfolding), &
                   new_unittest("tori of the amplitude equations", test_amplitudes), &
                   new_unittest("derivatives of the block", test_block), &
                   new_unittest("the block with large gamma", test_large_gamma)]
   end subroutine collect_normal_forms

   !> A coefficient of the normal form.
   complex(wp) function coefficient(model, omega, m, error) result(value)
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: omega(:)
      integer, intent(in) :: m(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      call normal_form_coefficient(model, omega, m, value, failure)
      call expect_success(error, failure)
   end function coefficient

   !> Of z^2 conj z, over omega, against the other program.
   subroutine test_l1(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      complex(wp) :: c1
      real(wp) :: l1, omega, p(4)
      integer :: i, k

      do i = 1, 10
         omega = 0.15_wp*i
         do k = 1, 2
            p = block_with_pair(omega, 0.5_wp, 0.8_wp, k)
            call first_lyapunov_coefficient(block_at(p), omega, l1, failure)
            call expect_success(error, failure)
            c1 = coefficient(block_at(p), [omega], [2, 1], error)
            call expect_close(error, real(c1)/omega, l1, 1.0e-12_wp*(1.0_wp + abs(l1)), "l1")
         end do
      end do
   end subroutine test_l1

   !> Lienard's equation without cubic term by averaging: for the amplitude A,
   !> A' = -(5/16) a5 A^5, and A = sqrt(2) |z|. The quadratic system: the focal values of Bautin
   !> (1952), V3 = -(pi/4) l5 (l3 - l6) and V5 = (pi/24) l2 l4 (l3 - l6) [l4 + 5 (l3 - l6)], with
   !> A' = (V3 A^3 + V5 A^5)/(2 pi), V5 where l5 = 0.
   subroutine test_planar(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp), a5 = 0.3_wp
      complex(wp) :: c1, c2
      real(wp) :: l(6)

      c2 = coefficient(known_model(lienard, [0.0_wp, a5]), [1.0_wp], [3, 2], error)
      call expect_close(error, real(c2), -1.25_wp*a5, 1.0e-9_wp, "Re c2 of Lienard")
      l = [0.0_wp, 0.3_wp, 0.5_wp, -0.7_wp, 0.0_wp, 1.1_wp]
      associate (v5 => pi/24.0_wp*l(2)*l(4)*(l(3) - l(6))*(l(4) + 5.0_wp*(l(3) - l(6))))
         c2 = coefficient(known_model(quadratic, l), [1.0_wp], [3, 2], error)
         call expect_close(error, real(c2), 2.0_wp*v5/pi, 1.0e-9_wp, "Re c2 of Bautin")
      end associate
      l(5) = 0.4_wp
      c1 = coefficient(known_model(quadratic, l), [1.0_wp], [2, 1], error)
      call expect_close(error, real(c1), -0.25_wp*l(5)*(l(3) - l(6)), 1.0e-9_wp, "Re c1 of Bautin")
   end subroutine test_planar

   !> Coefficients are the same after nonlinear changes of coordinates near the identity, but for
   !> Im c2; with eigenvectors of length 1 those of order 3 are doubled, of order 5 fourfold.
   subroutine test_transformed(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(double_hopf_type) :: form
      type(transformed) :: model
      complex(wp) :: c2, f(2), g(2, 2)
      real(wp), parameter :: omega(2) = [1.0_wp, sqrt(2.0_wp)]
      integer :: j

      g = reshape([(-0.3_wp, 0.2_wp), (0.9_wp, 0.1_wp), (0.5_wp, -0.7_wp), (-0.4_wp, 0.6_wp)], &
                  [2, 2])
      f = [(0.6_wp, 0.3_wp), (-0.2_wp, 0.3_wp)]
      model = transformed(omega, g, f)
      call find_double_hopf(model, omega, form, failure)
      call expect_success(error, failure)
      call expect_close(error, abs(pack(form%g - 2.0_wp*g, .true.)), spread(0.0_wp, 1, 4), &
                        1.0e-11_wp, "error of g_jk")
      do j = 1, 2
         c2 = coefficient(model, [omega(j)], [3, 2], error)
         call expect_close(error, real(c2), 4.0_wp*real(f(j)), 1.0e-9_wp, "Re c2")
      end do
   end subroutine test_transformed

   !> The two generalised Hopf points of the delayed oscillator of Duffing that DDE-BIFTOOL's
   !> demonstration minimal_demo publishes, in its state and in one with quadratic terms.
   subroutine test_published_l2(error)
      type(error_type), allocatable, intent(out) :: error
      complex(wp) :: c
      real(wp) :: bend, ends(2), omega
      real(wp), parameter :: known(2) = [-0.71239_wp, -2.5567_wp]
      real(wp), parameter :: within(2) = [5.0e-6_wp, 5.0e-5_wp]
      integer :: i, j, k

      do j = 1, 2
         bend = 0.4_wp*(j - 1)
         do k = 1, 2
            ends = [0.72_wp, 0.76_wp]
            do i = 1, 60
               omega = 0.5_wp*sum(ends)
               c = coefficient(duffing_with_pair(omega, k, bend), [omega], [2, 1], error)
               if (allocated(error)) return
               ends(merge(1, 2, real(c) < 0.0_wp)) = omega
            end do
            call expect_close(error, real(c), 0.0_wp, 1.0e-9_wp, "Re c1")
            c = coefficient(duffing_with_pair(omega, k, bend), [omega], [3, 2], error)
            call expect_close(error, real(c)/omega, known(k), within(k), "l2 on branch "//text(k))
         end do
      end do
   end subroutine test_published_l2

   !> The points of DDE-BIFTOOL's demonstrations neuron (demo1_simple) and nmfm_demo.
   subroutine test_published_double(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(double_hopf_type) :: form
      complex(wp), parameter :: known(4) = &
         [(-0.030007_wp, -0.0094837_wp), (-0.11318_wp, 0.037831_wp), &
          (-0.060013_wp, -0.018967_wp), (-0.056592_wp, 0.018915_wp)]

      call find_double_hopf(known_model(neurons, [0.2072962626_wp, 8.6340742187_wp]), &
                            [0.3287154065_wp, 0.9157115883_wp], form, failure)
      call expect_success(error, failure)
      call expect_close(error, abs(pack(form%g, .true.) - known), spread(0.0_wp, 1, 4), 1.0e-5_wp, &
                        "error of the neurons' g_jk")
      call expect_close(error, form%ratios(), [1.0605_wp, 3.7719_wp], 5.0e-5_wp, "theta, delta")
      call find_double_hopf(known_model(layers, [0.0899922748_wp, 0.7735178974_wp, &
                                                 12.7_wp, 20.2_wp]), &
                            [0.1560058562_wp, 0.2900084424_wp], form, failure)
      call expect_success(error, failure)
      call expect_close(error, form%ratios(), [1.5255011842_wp, 1.6984697752_wp], 5.0e-9_wp, &
                        "theta, delta of the layers")
   end subroutine test_published_double

   !> The twelve rows of Guckenheimer and Holmes, table 7.5.1, in r1' = r1 (mu1 + r1^2 + b r2^2) and
   !> r2' = r2 (mu2 + c r1^2 + d r2^2), also with time reversed and with r1, r2 of other units.
   subroutine test_unfolding(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=4), parameter :: known(12) = ["Ia  ", "Ib  ", "II  ", "III ", "IVa ", "IVb ", &
                                                  "V   ", "VIa ", "VIb ", "VIIa", "VIIb", "VIII"]
      real(wp), parameter :: d(12) = [spread(1.0_wp, 1, 6), spread(-1.0_wp, 1, 6)]
      real(wp), parameter :: b(12) = [0.5_wp, 2.0_wp, 2.0_wp, -2.0_wp, -0.5_wp, -2.0_wp, &
                                      2.0_wp, 2.0_wp, 0.5_wp, -2.0_wp, -0.5_wp, -2.0_wp]
      real(wp), parameter :: c(12) = [1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, &
                                      1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp]
      type(double_hopf_type) :: form
      integer :: direction, i

      do i = 1, 12
         do direction = -1, 1, 2
            ! |z1|^2 in units of 1/3, |z2|^2 in units of 1/7
            form%g = direction*reshape([3.0_wp, 3.0_wp*c(i), 7.0_wp*b(i), 7.0_wp*d(i)], [2, 2])
            call expect(error, form%unfolding() == known(i), "case "//known(i)//", given " &
                        //form%unfolding())
         end do
      end do
   end subroutine test_unfolding

   !> On both sides of the line of a cycle of r_j' = 2 r_j (mu_j + sum_k p_jk r_k): whether the
   !> fixed point of both pairs exists where the other pair grows along the cycle, and its
   !> eigenvalues.
   subroutine test_amplitudes(error)
      type(error_type), allocatable, intent(out) :: error
      type(double_hopf_type) :: form
      real(wp) :: determinant, growth, mu(2), p(2, 2), r(2), trace
      character(len=word_length) :: known
      integer :: i, j, k, other, side, seen(3)

      seen = 0
      do i = 1, 200
         p = reshape(uniform(i, 4, -1.0_wp, 1.0_wp), [2, 2])
         form%g = p
         determinant = p(1, 1)*p(2, 2) - p(1, 2)*p(2, 1)
         if (min(abs(determinant), minval(abs(p))) < 0.05_wp) cycle
         do j = 1, 2
            other = 3 - j
            do side = -1, 1, 2
               mu = form%torus_rates(j)
               mu(other) = mu(other) + 1.0e-3_wp*side
               growth = mu(other) - p(other, j)*mu(j)/p(j, j)
               r = -[p(2, 2)*mu(1) - p(1, 2)*mu(2), p(1, 1)*mu(2) - p(2, 1)*mu(1)]/determinant
               if (r(other) < 0.0_wp) cycle
               known = merge("supercritical", "subcritical  ", growth > 0.0_wp)
               call expect(error, form%criticality(j) == known, "kind of torus "//text(i))
               trace = 2.0_wp*(p(1, 1)*r(1) + p(2, 2)*r(2))
               if (determinant*product(r) < 0.0_wp) then
                  known = "saddle"
               else
                  known = merge("stable  ", "unstable", trace < 0.0_wp)
               end if
               call expect(error, form%torus_stability(j) == known, "torus "//text(i))
               k = findloc(["saddle  ", "stable  ", "unstable"], known(:8), dim=1)
               seen(k) = seen(k) + 1
            end do
         end do
      end do
      call expect(error, all(seen > 20), "all kinds occur")
   end subroutine test_amplitudes

   !> The derivatives of the block by formula and by values, and its second coefficient in ln v and
   !> in v, which are known to agree.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: block
      type(block_by_values) :: in_v, in_w
      complex(wp) :: by_formula(3), by_values(3), c2(2), x(3, 2, 5)
      real(wp) :: omega, p(4)
      integer :: i, k

      x = reshape([(cmplx(sin(1.0_wp*i), cos(3.0_wp*i), kind=wp), i=1, size(x))], shape(x))
      do i = 1, 10
         omega = 0.15_wp*i
         p = block_with_pair(omega, 0.5_wp, 0.8_wp, 2)
         block = block_at(p)
         in_w = block_by_values(p, .false.)
         in_v = block_by_values(p, .true.)
         do k = 2, 5
            by_formula = block%derivative(x(:, :, :k))
            by_values = in_w%derivative(x(:, :, :k))
            call expect_close(error, maxval(abs(by_formula - by_values)), 0.0_wp, &
                              1.0e-10_wp*maxval(abs(by_formula)), "error of order "//text(k))
         end do
         c2(1) = coefficient(block, [omega], [3, 2], error)
         c2(2) = coefficient(in_v, [omega], [3, 2], error)
         call expect_close(error, real(c2(2)), real(c2(1)), 1.0e-8_wp*(1.0_wp + abs(c2(1))), &
                           "Re c2 at omega = "//text(omega))
      end do
   end subroutine test_block

   !> l1 and c2 have limits for large gamma, with differences of order 1/gamma^2.
   subroutine test_large_gamma(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      complex(wp) :: c2(4)
      real(wp) :: l1(4), omega, p(4)
      integer :: i, j

      do i = 1, 12
         omega = 0.15_wp*i
         do j = 1, 4
            p = block_with_pair(omega, 0.5_wp, 10.0_wp**(3*j), 2)
            c2(j) = coefficient(block_at(p), [omega], [3, 2], error)
            call first_lyapunov_coefficient(block_at(p), omega, l1(j), failure)
            call expect_success(error, failure)
         end do
         call expect_close(error, abs(c2(4)/c2(2) - 1.0_wp), 0.0_wp, 1.0e-8_wp, &
                           "relative change of c2 at omega = "//text(omega))
         call expect_close(error, l1(1), l1(4), 1.0e-5_wp, "l1 at 1e3")
         call expect_close(error, l1(2:3), spread(l1(4), 1, 2), 1.0e-11_wp, "l1 at 1e6 and 1e9")
      end do
   end subroutine test_large_gamma
end module test_normal_forms
