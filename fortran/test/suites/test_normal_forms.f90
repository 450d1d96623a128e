! SPDX-License-Identifier: BSD-3-Clause
!> Normal forms of Hopf points: published coefficients, coefficients in closed form, and those that
!> do not change with coordinates or units.
module test_normal_forms
   use block_builder, only: block_at, made
   use centre_manifold, only: normal_form_coefficient
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use double_hopf, only: double_hopf_type, find_double_hopf, word_length
   use expectations, only: expect, expect_close, expect_success
   use hopf_normal_form, only: first_lyapunov_coefficient
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use model_roots, only: find_rightmost
   use paper_equations, only: block_with_pair
   use pseudo_random, only: uniform
   implicit none (type, external)
   private
   public :: collect_normal_forms

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   subroutine collect_normal_forms(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("planar systems", test_planar), &
                   new_unittest("other coordinates", test_coordinates), &
                   new_unittest("published l1", test_published_l1), &
                   new_unittest("published second coefficients", test_published_l2), &
                   new_unittest("published double Hopf points", test_published_double), &
                   new_unittest("cases of the unfolding", test_unfolding), &
                   new_unittest("tori of the amplitude equations", test_amplitudes), &
                   new_unittest("the block in v, l1 and c2", test_block), &
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

   !> Lienard's equation by averaging: for the amplitude A, A' = -(5/16) a5 A^5, and A = sqrt(2)
   !> |z|. The quadratic system: the focal values of Bautin (1952), V3 = -(pi/4) l5 (l3 - l6) and V5
   !> = (pi/24) l2 l4 (l3 - l6) [l4 + 5 (l3 - l6)], with A' = (V3 A^3 + V5 A^5)/(2 pi), V5 where l5
   !> = 0.
   subroutine test_planar(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: at_0(2) = 0.0_wp, l2 = 0.3_wp, l3 = 0.5_wp, l4 = -0.7_wp, &
                             l5 = 0.4_wp, l6 = 1.1_wp, a5 = 0.3_wp
      complex(wp) :: c

      c = coefficient(made("made_planar", [spread(0.0_wp, 1, 5), a5], at_0), [1.0_wp], [3, 2], &
                      error)
      call expect_close(error, real(c), -1.25_wp*a5, 1.0e-9_wp, "Re c2 of Lienard")
      c = coefficient(made("made_planar", [l2, l3, l4, 0.0_wp, l6, 0.0_wp], at_0), [1.0_wp], &
                      [3, 2], error)
      call expect_close(error, real(c), l2*l4*(l3 - l6)*(l4 + 5.0_wp*(l3 - l6))/12.0_wp, &
                        1.0e-9_wp, "Re c2 of Bautin")
      c = coefficient(made("made_planar", [l2, l3, l4, l5, l6, 0.0_wp], at_0), [1.0_wp], [2, 1], &
                      error)
      call expect_close(error, real(c), -0.25_wp*l5*(l3 - l6), 1.0e-9_wp, "Re c1 of Bautin")
   end subroutine test_planar

   !> Coefficients are the same after nonlinear changes of coordinates, but for Im c2. There y4 = x4
   !> + x2, so that |z1|^2 = (4/3) |zeta1|^2 and |z2|^2 = 2 |zeta2|^2 with eigenvectors of length 1.
   subroutine test_coordinates(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(double_hopf_type) :: form
      type(model_type) :: model
      complex(wp) :: c2
      real(wp), parameter :: omega(2) = [1.0_wp, sqrt(2.0_wp)], units(2) = [4.0_wp/3, 2.0_wp]
      complex(wp), parameter :: f(2) = [(0.6_wp, 0.3_wp), (-0.2_wp, 0.3_wp)]
      complex(wp), parameter :: g(2, 2) = reshape([(-0.3_wp, 0.2_wp), (0.9_wp, 0.1_wp), &
                                                   (0.5_wp, -0.7_wp), (-0.4_wp, 0.6_wp)], [2, 2])
      integer :: j, k

      model = made("made_waves", [1.0_wp, 0.0_wp, 0.0_wp, 0.6_wp, 0.7_wp, 0.0_wp, omega(1), &
                                  0.0_wp, omega(2), ((g(j, k)%re, g(j, k)%im, j=1, 2), k=1, 2), &
                                  0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, (f(j)%re, f(j)%im, j=1, 2)], &
                   spread(0.0_wp, 1, 4))
      call find_double_hopf(model, omega, form, failure)
      call expect_success(error, failure)
      call expect_close(error, abs(pack(form%g - g*spread(units, 1, 2), .true.)), &
                        spread(0.0_wp, 1, 4), 1.0e-11_wp, "error of g_jk")
      do j = 1, 2
         c2 = coefficient(model, [omega(j)], [3, 2], error)
         call expect_close(error, real(c2), units(j)**2*real(f(j)), 1.0e-9_wp, "Re c2")
      end do
   end subroutine test_coordinates

   !> Two neurons (Shayer and Campbell 2000, SIAM J. Appl. Math. 61, 673) with the weight a21 and
   !> the delay of a neuron for itself.
   type(model_type) function neurons(a21, tau_s) result(model)
      real(wp), intent(in) :: a21, tau_s

      model = made("made_neuron", [0.5_wp, -1.0_wp, 1.0_wp, a21, 0.2_wp, 0.2_wp, tau_s], &
                     [0.1_wp, 0.1_wp])
   end function neurons

   !> "neuron" of DDE-BIFTOOL: omega and l1.
   subroutine test_published_l1(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      complex(wp), allocatable :: roots(:)
      real(wp) :: l1

      call find_rightmost(neurons(0.8071232250_wp, 1.5_wp), 2, roots, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, [roots(1)%re, roots(1)%im], [0.0_wp, 0.7819651621_wp], 1.0e-9_wp, &
                        "the pair")
      call first_lyapunov_coefficient(neurons(0.8071232250_wp, 1.5_wp), roots(1)%im, l1, failure)
      call expect_success(error, failure)
      call expect_close(error, l1, -0.39615712_wp, 1.0e-8_wp, "l1")
   end subroutine test_published_l1

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

   !> Duffing's oscillator at a frequency above sqrt(a) with this pair on the axis, on branch k.
   type(model_type) function duffing_with_pair(omega, k, bend) result(model)
      real(wp), intent(in) :: omega, bend
      integer, intent(in) :: k
      real(wp), parameter :: a = 0.5_wp, d = 0.05_wp
      real(wp) :: b, excess

      excess = omega**2 - a
      b = (excess**2 + (d*omega)**2)/(2.0_wp*excess)
      model = made("made_duffing", [(atan2(-d*omega, b - excess) + 2.0_wp*pi*k)/omega, a, b, d, &
                                    bend], [0.5_wp, 0.0_wp])
   end function duffing_with_pair

   !> The points of DDE-BIFTOOL's demonstrations neuron (demo1_simple) and nmfm_demo.
   subroutine test_published_double(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(double_hopf_type) :: form
      complex(wp), parameter :: known(4) = &
         [(-0.030007_wp, -0.0094837_wp), (-0.11318_wp, 0.037831_wp), &
          (-0.060013_wp, -0.018967_wp), (-0.056592_wp, 0.018915_wp)]

      call find_double_hopf(neurons(0.2072962626_wp, 8.6340742187_wp), &
                            [0.3287154065_wp, 0.9157115883_wp], form, failure)
      call expect_success(error, failure)
      call expect_close(error, abs(pack(form%g, .true.) - known), spread(0.0_wp, 1, 4), 1.0e-5_wp, &
                        "error of the neurons' g_jk")
      call expect_close(error, form%ratios(), [1.0605_wp, 3.7719_wp], 5.0e-5_wp, "theta, delta")
      call find_double_hopf(made("made_layers", [0.0899922748_wp, 0.7735178974_wp, 12.7_wp, &
                                                 20.2_wp], [0.1_wp, 0.1_wp]), &
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

   !> c1 of z^2 conj z over omega is l1 of the other program; c1 and c2 of the block in ln v, with
   !> derivatives of up to order 5, are those in v.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(model_type) :: in_v
      complex(wp) :: c(2), c_in_v(2)
      real(wp) :: l1, omega, p(4), units(2)
      integer :: i, k

      do i = 1, 10
         omega = 0.15_wp*i
         do k = 1, 2
            p = block_with_pair(omega, 0.5_wp, 0.8_wp, k)
            in_v = made("made_block_in_v", p, spread(0.0_wp, 1, 3), keep_delays=.true.)
            call first_lyapunov_coefficient(block_at(p), omega, l1, failure)
            call expect_success(error, failure)
            c = [coefficient(block_at(p), [omega], [2, 1], error), &
                 coefficient(block_at(p), [omega], [3, 2], error)]
            c_in_v = [coefficient(in_v, [omega], [2, 1], error), &
                      coefficient(in_v, [omega], [3, 2], error)]
            units = 1.0_wp + abs(c)
            call expect_close(error, real(c(1))/omega, l1, 1.0e-12_wp*(1.0_wp + abs(l1)), "l1")
            call expect_close(error, real(c_in_v)/units, real(c)/units, 1.0e-8_wp, &
                              "c1 and c2 at omega = "//text(omega))
         end do
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
