! SPDX-License-Identifier: BSD-3-Clause
!> Characteristic roots of steady sliding: the equations and their linear part as the paper has
!> them, roots in quadruple precision, and their number by the principle of the argument. The suite
!> generated_models has the derivatives of Delta by parameters.
module test_roots
   use, intrinsic :: iso_fortran_env, only: real128
   use block_builder, only: block_at, build_block, by_epsilon, by_gamma, by_tau, by_xi, &
                            index_of_ln_v, index_of_theta, index_of_u
   use characteristic_function, only: characteristic_of, characteristic_type
   use characteristic_roots, only: find_roots
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use exponent_averages, only: exponent_type
   use lapack_algebra, only: solve
   use linear_system, only: linear_part, linear_system_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_description, only: word_length
   use model_library, only: list_models
   use model_problem, only: model_type
   use model_roots, only: find_model_roots
   use paper_equations, only: delta, relative_residual
   use pseudo_random, only: uniform
   use rest, only: exponents_at_rest
   use root_counts, only: no_count, roots_right_of
   implicit none (type, external)
   private
   public :: collect_roots

   !> Number of random points.
   integer, parameter :: points = 200

contains

   subroutine collect_roots(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("equation (4)", test_equation_4), &
                   new_unittest("equation (5), determinant, slope and bound", test_equation_5), &
                   new_unittest("number of roots at large parameters", test_extremes), &
                   new_unittest("refusals", test_refusals), &
                   new_unittest("roots in quadruple precision", test_quadruple)]
   end subroutine collect_roots

   !> With a delay, at random states and parameters; dw/dt = (dv/dt)/v.
   subroutine test_equation_4(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: block
      real(wp) :: dydt(3), x(8)
      integer :: i

      do i = 1, 50
         x = uniform(i, 8, 0.05_wp, 3.0_wp)
         x(5:6) = x(5:6) - 1.5_wp
         associate (epsilon => x(1), xi => x(2), gamma => x(3), v => x(4), theta => x(5), &
                    u => x(6), delayed_v => x(7))
            block = build_block(tau=10.0_wp, epsilon=epsilon, xi=xi, gamma=gamma)
            call block%rhs(x(8), [theta, u, log(v)], [log(delayed_v)], dydt)
            call expect_close(error, dydt([index_of_theta, index_of_u, index_of_ln_v]), &
                              [-v*(theta + (1.0_wp + epsilon)*log(delayed_v)), v - 1.0_wp, &
                               -gamma**2*(u + (theta + log(v))/xi)/v], &
                              1.0e-11_wp*max(1.0_wp, 1.0_wp/v), "state "//text(i))
         end associate
      end do
   end subroutine test_equation_4

   !> At random places Delta(s) of each law is the determinant of s - A0 - A1 exp(-s tau), its slope
   !> is that by differences of fourth order, and the bound of the curvature holds. With inertia it
   !> is (5): the laws share their linear part but for a cut-off, which is 0 here.
   subroutine test_equation_5(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      character(len=:), allocatable :: name
      type(characteristic_type) :: c
      type(linear_system_type) :: linear
      type(model_type) :: block
      complex(wp) :: s
      real(wp), parameter :: h = 5.0e-4_wp
      real(wp) :: p(4), unit, x(6)
      integer :: i

      names = list_models("")
      names = pack(names, index(names, "chain_") /= 1 .and. index(names, "made_") /= 1)
      do i = 1, points
         x = uniform(i, 6, 0.1_wp, 2.0_wp)
         p = [2.0_wp*x(1), x(2) - 1.0_wp, x(3), x(4)]
         s = cmplx(x(5) - 1.0_wp, 2.0_wp*x(6) - 2.0_wp, kind=wp)
         name = trim(names(1 + modulo(i, size(names))))
         block = block_at([p, 0.0_wp, 0.5_wp], name)
         c = characteristic_of(block)
         linear = linear_part(block)
         unit = 1.0_wp + abs(s)**3 + (1.0_wp + p(by_gamma)**2*(1.0_wp + abs(s)) &
                                      *(1.0_wp + 1.0_wp/p(by_xi))) &
                *(1.0_wp + abs(s))*max(1.0_wp, exp(-real(s)*p(by_tau)))
         call expect_close(error, abs(c%value(s) - determinant(linear%characteristic_matrix(s))) &
                           /unit, 0.0_wp, 1.0e-13_wp, "misfit of the determinant, "//name)
         call expect_close(error, abs(c%by_s(s) - (8.0_wp*(c%value(s + h) - c%value(s - h)) &
                                                   - (c%value(s + 2*h) - c%value(s - 2*h))) &
                                      /(12.0_wp*h))/unit, 0.0_wp, 1.0e-7_wp, "misfit of the slope")
         associate (there => s + cmplx(0.0_wp, h, kind=wp))
            call expect_between(error, abs(c%by_s(there) - c%by_s(s)) &
                                /(h*max(c%curvature_bound(s), c%curvature_bound(there))), &
                                0.0_wp, 1.0_wp + 1.0e-9_wp, "curvature over its bound, "//name)
         end associate
         if (index(name, "quasistatic") > 0) cycle
         call expect_close(error, abs(c%value(s) - delta(p, s))/unit, 0.0_wp, 1.0e-14_wp, &
                           "misfit of (5), "//name)
         call expect_close(error, c%relative_residual((0.0_wp, 0.7_wp)), &
                           relative_residual(p, 0.7_wp), 1.0e-13_wp, "residual, "//name)
      end do
   end subroutine test_equation_5

   !> Determinant of three by three.
   pure complex(wp) function determinant(m) result(value)
      complex(wp), intent(in) :: m(3, 3)

      value = m(1, 1)*(m(2, 2)*m(3, 3) - m(2, 3)*m(3, 2)) &
              - m(1, 2)*(m(2, 1)*m(3, 3) - m(2, 3)*m(3, 1)) &
              + m(1, 3)*(m(2, 1)*m(3, 2) - m(2, 2)*m(3, 1))
   end function determinant

   !> x' = -x(t - 1).
   pure type(linear_system_type) function delayed_decay() result(system)
      allocate (system%a(1, 1, 1), source=-1.0_wp)
      system%lag = [1.0_wp]
   end function delayed_decay

   !> Without delay Routh and Hurwitz say where the pair is lost.
   subroutine test_extremes(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: lost
      integer :: i, j, side

      do i = -2, 12
         do j = -2, 2
            associate (gamma => 10.0_wp**i, xi => 10.0_wp**j)
               lost = gamma**2*xi/(xi + gamma**2)
               do side = -1, 1, 2
                  call expect(error, roots_right([0.0_wp, (1.0_wp + 0.1_wp*side)*lost, xi, gamma], &
                                                 0.0_wp) == 1 + side, &
                              "roots at gamma = "//text(gamma)//", xi = "//text(xi))
               end do
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
      real(wp), parameter :: bounds(3) = [-1.0_wp, -10.0_wp, -100.0_wp]
      integer :: i

      ! s + 1 + 2 exp(-s 1e9) has 5e8 roots to the right of the axis
      long%n = 1
      long%delay = [0.0_wp, 1.0e9_wp]
      allocate (long%coefficient(0:1, 2))
      long%coefficient(:, :) = reshape([1.0_wp, 1.0_wp, 2.0_wp, 0.0_wp], [2, 2])
      call expect(error, roots_right_of(long, 0.0_wp) == no_count, "no count")
      call find_roots(delayed_decay(), -8.0_wp, 948, 1.0_wp, roots, failure)
      call expect_failure(error, failure, "a bound nearer to 0 expected")
      call find_roots(delayed_decay(), -2.8_wp, 7, 1.0_wp, roots, failure)
      call expect_failure(error, failure, "6 simple roots instead of 7 with real part above -2.8")
      right = 1.0_wp
      call solve(reshape([(1.0_wp, 0.0_wp), (2.0_wp, 0.0_wp), (2.0_wp, 0.0_wp), &
                          (4.0_wp, 0.0_wp)], [2, 2]), right, solution, failure)
      call expect_failure(error, failure, "a regular matrix expected")
      ! at the last bound there are more than the largest number
      do i = 1, size(bounds)
         call find_model_roots(block_at([10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp]), bounds(i), roots, &
                               failure)
         call expect_failure(error, failure, "a bound nearer to 0 expected")
      end do
      call expect_failure(error, failure, "more than 512 above -100.0")
   end subroutine test_refusals

   !> For gamma from 1e-2 to 1e12 there are as many roots as the principle of the argument says, and
   !> their real parts are the exponents at rest. Newton's method in quadruple precision moves them
   !> in the last digits only; it takes (5) over gamma^2 as a product less its delayed term.
   subroutine test_quadruple(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      type(failure_type), allocatable :: failure
      real(wp) :: p(4)
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: all_tau(5) = [0.0_wp, 0.1_wp, 1.0_wp, 7.0_wp, 10.0_wp]
      real(wp), parameter :: all_xi(3) = [0.01_wp, 0.5_wp, 10.0_wp]
      real(wp), parameter :: bounds(2) = [-0.02_wp, 0.0_wp]
      character(len=:), allocatable :: place
      integer :: i, j, k, m, most

      most = 0
      do k = -2, 12, 2
         do j = 1, size(all_xi)
            do i = 1, size(all_tau)
               p = [all_tau(i), 1.5_wp, all_xi(j), 10.0_wp**k]
               place = " at tau "//text(p(by_tau))//", xi "//text(p(by_xi))//", gamma 1e"//text(k)
               call find_model_roots(block_at(p), bounds(1), roots, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               do m = 1, size(bounds)
                  call expect(error, count(real(roots) > bounds(m)) == roots_right(p, bounds(m)), &
                              "number of roots above "//text(bounds(m))//place)
               end do
               do m = 1, size(roots)
                  call expect_close(error, abs(roots(m) - quadruple_root(p, roots(m))) &
                                    /abs(roots(m)), 0.0_wp, 1.0e-13_wp, "root "//text(m)//place)
               end do
               most = max(most, size(roots))
               if (size(roots) == 0 .or. modulo(k, 6) /= 0) cycle
               call exponents_at_rest(block_at(p), size(roots), exponents, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, exponents%value/abs(roots), real(roots)/abs(roots), &
                                 1.0e-12_wp, "exponents"//place)
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
end module test_roots
