! SPDX-License-Identifier: BSD-3-Clause
!> Characteristic functions made from the laws against the determinant of the model's own
!> linearisation; those of the paper's law against (5) as the paper has it, and (5) to (10) against
!> the Hopf curves in closed form.
module test_characteristic_function
   use block_builder, only: block_at, by_epsilon, by_gamma, by_tau, by_xi
   use characteristic_function, only: characteristic_of, characteristic_type
   use closed_form, only: block_with_pair
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect_between, expect_close
   use linear_system, only: linear_part, linear_system_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_description, only: word_length
   use model_library, only: list_models
   use model_problem, only: model_type
   use paper_equations, only: delta, hopf_epsilon, hopf_tau, hopf_xi, relative_residual
   use pseudo_random, only: uniform
   implicit none (type, external)
   private
   public :: collect_characteristic_function

   !> Number of random points.
   integer, parameter :: points = 200

contains

   subroutine collect_characteristic_function(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("determinant, bound and derivatives of each law", test_laws), &
                   new_unittest("equation (5)", test_equation_5), &
                   new_unittest("residual", test_residual), &
                   new_unittest("equations (5) to (10) in closed form", test_curves)]
   end subroutine collect_characteristic_function

   !> Names of the laws of one block.
   function law_names() result(names)
      character(len=word_length), allocatable :: names(:)

      names = list_models("")
      names = pack(names, index(names, "chain_") /= 1 .and. index(names, "made_") /= 1)
   end function law_names

   !> Delta(s) of each law is the determinant of s - A0 - A1 exp(-s tau). Its derivatives by s and
   !> all parameters are those by differences of fourth order. The bound of the slope by s holds it.
   subroutine test_laws(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      type(characteristic_type) :: c
      type(linear_system_type) :: linear
      type(model_type) :: block
      complex(wp) :: known, s
      real(wp), parameter :: h = 5.0e-4_wp
      complex(wp), parameter :: unit_step = (0.0_wp, 1.0_wp)
      real(wp) :: numbers(4), unit
      integer :: by, i

      names = law_names()
      do i = 1, points
         call random_point(i, numbers, s)
         block = block_at([numbers, 0.5_wp, 0.5_wp], trim(names(1 + modulo(i, size(names)))))
         c = characteristic_of(block)
         linear = linear_part(block)
         unit = size_of(numbers, s)
         call expect_close(error, abs(c%value(s) - determinant(linear%characteristic_matrix(s))) &
                           /unit, 0.0_wp, 1.0e-13_wp, "relative misfit at point "//text(i))
         do by = 0, size(block%numbers)
            known = c%by_s(s)
            if (by > 0) known = c%by_parameter(by, s)
            call expect_close(error, abs(known - (8.0_wp*(beside(1) - beside(-1)) &
                                                  - (beside(2) - beside(-2)))/(12.0_wp*h))/unit, &
                              0.0_wp, 1.0e-7_wp, "misfit at point "//text(i)//", derivative " &
                              //text(by))
         end do
         call expect_between(error, abs(c%by_s(s + h*unit_step) - c%by_s(s)) &
                             /(h*max(c%curvature_bound(s), c%curvature_bound(s + h*unit_step))), &
                             0.0_wp, 1.0_wp + 1.0e-9_wp, &
                             "curvature over its bound at point "//text(i))
      end do

   contains

      !> Delta at a place beside.
      complex(wp) function beside(steps) result(value)
         integer, intent(in) :: steps
         type(characteristic_type) :: c_there
         type(model_type) :: there
         real(wp) :: changed(size(block%numbers))

         there = block
         changed = block%numbers
         if (by > 0) changed(by) = changed(by) + h*steps
         call there%put(changed)
         c_there = characteristic_of(there)
         value = c_there%value(s + merge(h*steps, 0.0_wp, by == 0))
      end function beside
   end subroutine test_laws

   !> Delta(s) of the paper's law, and of all that share its linear part, is (5).
   subroutine test_equation_5(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      type(characteristic_type) :: c
      complex(wp) :: s
      real(wp) :: numbers(4)
      integer :: i

      names = law_names()
      names = pack(names, index(names, "quasistatic") == 0)
      do i = 1, points
         call random_point(i, numbers, s)
         ! without its cut-off, that law is the paper's
         c = characteristic_of(block_at(numbers, trim(names(1 + modulo(i, size(names))))))
         call expect_close(error, abs(c%value(s) - delta(numbers, s))/size_of(numbers, s), 0.0_wp, &
                           1.0e-14_wp, "relative misfit at point "//text(i))
         call expect_between(error, abs(c%relative_residual(s) - relative_residual(numbers, s)), &
                             0.0_wp, 1.0e-13_wp, "difference of residuals at point "//text(i))
      end do
   end subroutine test_equation_5

   !> By hand: at s = 1 with xi = gamma = 1, epsilon = tau = 0 the terms are 1, 2, 2, 1 and -1; at a
   !> root there is no residual.
   subroutine test_residual(error)
      type(error_type), allocatable, intent(out) :: error
      type(characteristic_type) :: c

      c = characteristic_of(block_at([0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp]))
      call expect_close(error, c%relative_residual((1.0_wp, 0.0_wp)), 2.5_wp, 1.0e-15_wp, &
                        "residual")
      c = characteristic_of(block_at([0.0_wp, 0.5_wp, 1.0_wp, 1.0_wp]))
      call expect_close(error, c%relative_residual(cmplx(0.0_wp, sqrt(0.5_wp), kind=wp)), 0.0_wp, &
                        1.0e-15_wp, "residual of a root")
   end subroutine test_residual

   !> For soft and stiff blocks on four branches: (7) to (10) are the curves in closed form, and
   !> i omega is a root of (5).
   subroutine test_curves(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: numbers(4), x(3)
      integer :: i, k

      do i = 1, points
         x = uniform(i, 3, 0.0_wp, 1.0_wp)
         associate (omega => 0.05_wp + 2.95_wp*x(1), xi => 10.0_wp**(2.0_wp*x(2) - 1.0_wp), &
                    gamma => 10.0_wp**(2.0_wp*x(3) - 1.0_wp))
            do k = 0, 3
               numbers = block_with_pair(omega, xi, gamma, k)
               call expect_close(error, (1.0_wp + hopf_epsilon(omega, xi, gamma)) &
                                 /(1.0_wp + numbers(by_epsilon)), 1.0_wp, 1.0e-13_wp, &
                                 "1 + epsilon of (7) over its closed form, point "//text(i))
               call expect_close(error, omega*hopf_tau(omega, xi, gamma, k), &
                                 omega*numbers(by_tau), 1.0e-12_wp, &
                                 "omega tau of (10), branch "//text(k)//", point "//text(i))
               call expect_close(error, hopf_xi(omega, numbers(by_tau), gamma)/xi, 1.0_wp, &
                                 1.0e-9_wp, "xi of (9) over xi, point "//text(i))
               call expect_between(error, relative_residual(numbers, &
                                                            cmplx(0.0_wp, omega, kind=wp)), &
                                   0.0_wp, 1.0e-13_wp, &
                                   "residual of branch "//text(k)//", point "//text(i))
            end do
         end associate
      end do
   end subroutine test_curves

   !> Random parameters and a random place beside the imaginary axis.
   pure subroutine random_point(i, numbers, s)
      integer, intent(in) :: i
      real(wp), intent(out) :: numbers(4)
      complex(wp), intent(out) :: s
      real(wp) :: x(6)

      x = uniform(i, 6, 0.1_wp, 2.0_wp)
      numbers = [2.0_wp*x(1), x(2) - 1.0_wp, x(3), x(4)]
      s = cmplx(x(5) - 1.0_wp, 2.0_wp*x(6) - 2.0_wp, kind=wp)
   end subroutine random_point

   !> Size of the terms of Delta(s).
   pure real(wp) function size_of(p, s) result(value)
      real(wp), intent(in) :: p(:)
      complex(wp), intent(in) :: s

      value = 1.0_wp + abs(s)**3 &
              + (1.0_wp + p(by_gamma)**2*(1.0_wp + abs(s))*(1.0_wp + 1.0_wp/p(by_xi))) &
              *(1.0_wp + abs(s))*max(1.0_wp, exp(-real(s)*p(by_tau)))
   end function size_of

   !> Determinant of three by three.
   pure complex(wp) function determinant(m) result(value)
      complex(wp), intent(in) :: m(3, 3)

      value = m(1, 1)*(m(2, 2)*m(3, 3) - m(2, 3)*m(3, 2)) &
              - m(1, 2)*(m(2, 1)*m(3, 3) - m(2, 3)*m(3, 1)) &
              + m(1, 3)*(m(2, 1)*m(3, 2) - m(2, 2)*m(3, 1))
   end function determinant
end module test_characteristic_function
