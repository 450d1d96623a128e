!> Characteristic function and Hopf condition: equation (5) against the determinant of the block's
!> own linearisation, (6) to (10) against the curves in closed form.
module test_hopf_condition
   use block_builder, only: build_block
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: by_epsilon, by_tau, by_xi, delta, delta_by, delta_by_s, &
                                      relative_residual
   use closed_form, only: closed_epsilon, closed_tau
   use dde_errors, only: text
   use expectations, only: expect_between, expect_close
   use hopf_condition, only: hopf_epsilon, hopf_tau, hopf_xi, printed_tau
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_hopf_condition

   !> Number of random points.
   integer, parameter :: points = 200
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   subroutine collect_hopf_condition(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("equation (5) from the block", test_linearisation), &
                   new_unittest("derivatives of (5)", test_derivatives), &
                   new_unittest("residual", test_residual), &
                   new_unittest("curves in closed form", test_curves), &
                   new_unittest("equation (10) as printed", test_printed)]
   end subroutine collect_hopf_condition

   !> Delta(s) is the determinant of s - A0 - A1 exp(-s tau), with the matrices taken from the
   !> right-hand side of the block by differences.
   subroutine test_linearisation(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      type(spring_block_type) :: block
      complex(wp) :: matrix(3, 3), s
      real(wp), parameter :: small = 1.0e-5_wp
      real(wp) :: after(3), before(3), shift(4)
      integer :: i, j

      do i = 1, points
         call random_point(i, p, s)
         block = build_block(tau=p%tau, epsilon=p%epsilon, xi=p%xi, gamma=p%gamma)
         matrix = 0.0_wp
         do j = 1, 4
            shift = 0.0_wp
            shift(j) = small
            call block%rhs(0.0_wp, shift(:3), shift(4:4), after)
            call block%rhs(0.0_wp, -shift(:3), -shift(4:4), before)
            associate (column => merge(3, j, j == 4), weight => merge(exp(-s*p%tau), &
                                                                      (1.0_wp, 0.0_wp), j == 4))
               matrix(:, column) = matrix(:, column) - weight*(after - before)/(2.0_wp*small)
            end associate
         end do
         do j = 1, 3
            matrix(j, j) = matrix(j, j) + s
         end do
         call expect_close(error, abs(delta(p, s) - determinant(matrix))/size_of(p, s), 0.0_wp, &
                           1.0e-8_wp, "relative misfit at point "//text(i))
      end do
   end subroutine test_linearisation

   !> Derivatives by s and by parameters against differences of fourth order.
   subroutine test_derivatives(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      complex(wp) :: known, s
      real(wp), parameter :: h = 5.0e-4_wp
      integer :: by, i

      do i = 1, points
         call random_point(i, p, s)
         do by = by_epsilon, by_xi + 1
            if (by <= by_xi) known = delta_by(by, p, s)
            if (by > by_xi) known = delta_by_s(p, s)
            call expect_close(error, abs(known - (8.0_wp*(beside(1) - beside(-1)) &
                                                  - (beside(2) - beside(-2)))/(12.0_wp*h)) &
                              /size_of(p, s), 0.0_wp, 1.0e-7_wp, "misfit at point "//text(i) &
                              //", derivative "//text(by))
         end do
      end do

   contains

      !> Delta at a place beside.
      complex(wp) function beside(steps) result(value)
         integer, intent(in) :: steps
         type(block_parameters_type) :: there

         there = p
         if (by == by_epsilon) there%epsilon = p%epsilon + h*steps
         if (by == by_tau) there%tau = p%tau + h*steps
         if (by == by_xi) there%xi = p%xi + h*steps
         value = delta(there, s + merge(h*steps, 0.0_wp, by > by_xi))
      end function beside
   end subroutine test_derivatives

   !> By hand: at s = 1 with xi = gamma = 1, epsilon = tau = 0 the terms are 1, 2, 2, 1 and -1; at a
   !> root there is no residual.
   subroutine test_residual(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p

      call expect_close(error, relative_residual(p, (1.0_wp, 0.0_wp)), 2.5_wp, 1.0e-15_wp, &
                        "residual")
      p%epsilon = 0.5_wp
      call expect_close(error, relative_residual(p, cmplx(0.0_wp, sqrt(0.5_wp), kind=wp)), 0.0_wp, &
                        1.0e-15_wp, "residual of a root")
   end subroutine test_residual

   !> For soft and stiff blocks on four branches: epsilon and tau over omega are those in closed
   !> form, i omega is a root of (5) there, and equation (9) gives back the xi from which (10) gave
   !> tau.
   subroutine test_curves(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      real(wp) :: x(3)
      integer :: i, k

      do i = 1, points
         x = random_omega(i)
         associate (omega => x(1), xi => x(2), gamma => x(3))
            p = block_parameters_type(epsilon=hopf_epsilon(omega, xi, gamma), xi=xi, gamma=gamma)
            call expect_close(error, (1.0_wp + p%epsilon) &
                              /(1.0_wp + closed_epsilon(omega, xi, gamma)), 1.0_wp, 1.0e-13_wp, &
                              "1 + epsilon over its closed form, point "//text(i))
            do k = 0, 3
               p%tau = hopf_tau(omega, xi, gamma, k)
               call expect_close(error, omega*p%tau, omega*closed_tau(omega, xi, gamma, k), &
                                 1.0e-12_wp, "omega tau of branch "//text(k)//", point "//text(i))
               call expect_between(error, relative_residual(p, cmplx(0.0_wp, omega, kind=wp)), &
                                   0.0_wp, 1.0e-13_wp, &
                                   "residual of branch "//text(k)//", point "//text(i))
               call expect_close(error, hopf_xi(omega, p%tau, gamma)/xi, 1.0_wp, 1.0e-9_wp, &
                                 "xi over xi, point "//text(i))
            end do
         end associate
      end do
   end subroutine test_curves

   !> (10) as printed, by hand at xi = gamma = 1, and its residual: nowhere a root.
   subroutine test_printed(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      real(wp) :: omega
      integer :: i

      call expect_close(error, printed_tau(1.0_wp, 1.0_wp, 1.0_wp, 1), turn - atan(2.0_wp), &
                        1.0e-14_wp, "printed tau at omega = 1")
      call expect_close(error, printed_tau(2.0_wp, 1.0_wp, 1.0_wp, 3), &
                        0.5_wp*(atan(2.0_wp) + 3.0_wp*turn), 1.0e-14_wp, &
                        "printed tau at omega = 2")
      do i = 1, 20
         omega = 0.1_wp*i
         p = block_parameters_type(tau=printed_tau(omega, 0.5_wp, 0.8_wp, 1), xi=0.5_wp, &
                                   gamma=0.8_wp, epsilon=hopf_epsilon(omega, 0.5_wp, 0.8_wp))
         call expect_between(error, relative_residual(p, cmplx(0.0_wp, omega, kind=wp)), &
                             1.0e-3_wp, 2.0_wp, "residual as printed at omega = "//text(omega))
      end do
   end subroutine test_printed

   !> Random parameters and a random place beside the imaginary axis.
   pure subroutine random_point(i, p, s)
      integer, intent(in) :: i
      type(block_parameters_type), intent(out) :: p
      complex(wp), intent(out) :: s
      real(wp) :: x(6)

      x = uniform(i, 6, 0.1_wp, 2.0_wp)
      p = block_parameters_type(tau=2.0_wp*x(1), epsilon=x(2) - 1.0_wp, xi=x(3), gamma=x(4))
      s = cmplx(x(5) - 1.0_wp, 2.0_wp*x(6) - 2.0_wp, kind=wp)
   end subroutine random_point

   !> Random omega in 0.05..3, xi and gamma in 0.1..10.
   pure function random_omega(i) result(x)
      integer, intent(in) :: i
      real(wp) :: x(3)

      x = uniform(i, 3, 0.0_wp, 1.0_wp)
      x = [0.05_wp + 2.95_wp*x(1), 10.0_wp**(2.0_wp*x(2) - 1.0_wp), 10.0_wp**(2.0_wp*x(3) - 1.0_wp)]
   end function random_omega

   !> Size of the terms of Delta(s).
   pure real(wp) function size_of(p, s) result(value)
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: s

      value = 1.0_wp + abs(s)**3 + (1.0_wp + p%gamma**2*(1.0_wp + abs(s))*(1.0_wp + 1.0_wp/p%xi)) &
              *(1.0_wp + abs(s))*max(1.0_wp, exp(-real(s)*p%tau))
   end function size_of

   !> Determinant of three by three.
   pure complex(wp) function determinant(m) result(value)
      complex(wp), intent(in) :: m(3, 3)

      value = m(1, 1)*(m(2, 2)*m(3, 3) - m(2, 3)*m(3, 2)) &
              - m(1, 2)*(m(2, 1)*m(3, 3) - m(2, 3)*m(3, 1)) &
              + m(1, 3)*(m(2, 1)*m(3, 2) - m(2, 2)*m(3, 1))
   end function determinant
end module test_hopf_condition
