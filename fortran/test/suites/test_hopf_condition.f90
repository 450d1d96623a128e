!> Characteristic function and Hopf condition: those made from the laws against the determinant of
!> the block's own linearisation; those of the paper's law against (5) to (10) as the paper has
!> them, and these against the curves in closed form.
module test_hopf_condition
   use block_parameters, only: block_history_type, block_parameters_type, law_names, vector_of, &
                               with_vector
   use characteristic_function, only: characteristic_type
   use closed_form, only: closed_epsilon, closed_tau
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect_between, expect_close, expect_success
   use hopf_condition, only: find_hopf_condition, hopf_condition_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use paper_equations, only: delta, hopf_epsilon, hopf_tau, hopf_xi, relative_residual
   use printed_delay, only: printed_tau
   use model_description, only: word_length
   use pseudo_random, only: uniform
   use spring_block, only: block_characteristic, spring_block_type
   implicit none (type, external)
   private
   public :: collect_hopf_condition

   !> Number of random points.
   integer, parameter :: points = 200
   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   subroutine collect_hopf_condition(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("characteristic function of each law", test_linearisation), &
                   new_unittest("equation (5)", test_equation_5), &
                   new_unittest("derivatives", test_derivatives), &
                   new_unittest("residual", test_residual), &
                   new_unittest("curves in closed form", test_curves), &
                   new_unittest("Hopf points of each law", test_laws), &
                   new_unittest("equation (10) as printed", test_printed)]
   end subroutine collect_hopf_condition

   !> Delta(s) of each law is the determinant of s - A0 - A1 exp(-s tau), with the matrices taken
   !> from the right-hand side of the block by differences.
   subroutine test_linearisation(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      type(block_parameters_type) :: p
      type(characteristic_type) :: c
      type(spring_block_type) :: block
      complex(wp) :: matrix(3, 3), s
      real(wp), parameter :: small = 1.0e-5_wp
      real(wp) :: after(3), before(3), shift(4)
      integer :: i, j

      names = law_names()
      do i = 1, points
         call random_point(i, p, s)
         p%law = names(1 + modulo(i, size(names)))
         p%own = 0.5_wp
         block = spring_block_type(p, block_history_type())
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
         c = block_characteristic(p)
         call expect_close(error, abs(c%value(s) - determinant(matrix))/size_of(p, s), 0.0_wp, &
                           1.0e-8_wp, "relative misfit of "//trim(p%law)//", point "//text(i))
      end do
   end subroutine test_linearisation

   !> Delta(s) of the paper's law, and of all that share its linear part, is (5).
   subroutine test_equation_5(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      type(block_parameters_type) :: p
      type(characteristic_type) :: c
      complex(wp) :: s
      integer :: i

      names = law_names()
      do i = 1, points
         call random_point(i, p, s)
         ! without its cut-off, that law is the paper's
         p%law = names(1 + modulo(i, size(names)))
         if (index(p%law, "quasistatic") > 0) cycle
         c = block_characteristic(p)
         call expect_close(error, abs(c%value(s) - delta(p, s))/size_of(p, s), 0.0_wp, &
                           1.0e-14_wp, "relative misfit of "//trim(p%law)//", point "//text(i))
         call expect_between(error, abs(c%relative_residual(s) - relative_residual(p, s)), 0.0_wp, &
                             1.0e-13_wp, "difference of residuals at point "//text(i))
      end do
   end subroutine test_equation_5

   !> Derivatives by s and by parameters against differences of fourth order; the bound of the
   !> slope by s holds it.
   subroutine test_derivatives(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      type(block_parameters_type) :: p
      type(characteristic_type) :: c
      complex(wp) :: known, s
      real(wp), parameter :: h = 5.0e-4_wp
      integer :: by, i

      names = law_names()
      do i = 1, points
         call random_point(i, p, s)
         p%law = names(1 + modulo(i, size(names)))
         p%own = 0.5_wp
         c = block_characteristic(p)
         do by = 1, 5
            if (by < 5) known = c%by_parameter(by, s)
            if (by == 5) known = c%by_s(s)
            call expect_close(error, abs(known - (8.0_wp*(beside(1) - beside(-1)) &
                                                  - (beside(2) - beside(-2)))/(12.0_wp*h)) &
                              /size_of(p, s), 0.0_wp, 1.0e-7_wp, "misfit at point "//text(i) &
                              //", derivative "//text(by))
         end do
         call expect_between(error, abs(c%by_s(s))/c%slope_bound(s), 0.0_wp, 1.0_wp + 1.0e-14_wp, &
                             "slope over its bound at point "//text(i))
      end do

   contains

      !> Delta at a place beside.
      complex(wp) function beside(steps) result(value)
         integer, intent(in) :: steps
         type(block_parameters_type) :: there
         type(characteristic_type) :: delta_there
         real(wp), allocatable :: vector(:)

         vector = vector_of(p)
         if (by < 5) vector(by) = vector(by) + h*steps
         there = with_vector(p, vector)
         delta_there = block_characteristic(there)
         value = delta_there%value(s + merge(h*steps, 0.0_wp, by == 5))
      end function beside
   end subroutine test_derivatives

   !> By hand: at s = 1 with xi = gamma = 1, epsilon = tau = 0 the terms are 1, 2, 2, 1 and -1; at a
   !> root there is no residual.
   subroutine test_residual(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      type(characteristic_type) :: c

      c = block_characteristic(p)
      call expect_close(error, c%relative_residual((1.0_wp, 0.0_wp)), 2.5_wp, 1.0e-15_wp, &
                        "residual")
      p%epsilon = 0.5_wp
      c = block_characteristic(p)
      call expect_close(error, c%relative_residual(cmplx(0.0_wp, sqrt(0.5_wp), kind=wp)), 0.0_wp, &
                        1.0e-15_wp, "residual of a root")
   end subroutine test_residual

   !> For soft and stiff blocks on four branches: epsilon, tau and xi of the paper's law are those
   !> of (7) to (10), epsilon and tau over omega are those in closed form, and i omega is a root of
   !> (5).
   subroutine test_curves(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      type(failure_type), allocatable :: failure
      type(hopf_condition_type) :: condition
      real(wp) :: x(3)
      integer :: i, k

      call find_hopf_condition(p, condition, failure)
      call expect_success(error, failure)
      do i = 1, points
         x = random_omega(i)
         associate (omega => x(1), xi => x(2), gamma => x(3))
            p = block_parameters_type(epsilon=condition%epsilon_at(omega, xi, gamma), xi=xi, &
                                      gamma=gamma)
            call expect_close(error, (1.0_wp + p%epsilon) &
                              /(1.0_wp + closed_epsilon(omega, xi, gamma)), 1.0_wp, 1.0e-13_wp, &
                              "1 + epsilon over its closed form, point "//text(i))
            call expect_close(error, (1.0_wp + p%epsilon) &
                              /(1.0_wp + hopf_epsilon(omega, xi, gamma)), 1.0_wp, &
                              1.0e-13_wp, "1 + epsilon over that of (7), point "//text(i))
            do k = 0, 3
               p%tau = condition%tau_at(omega, p%epsilon, xi, gamma, k)
               call expect_close(error, omega*p%tau, omega*closed_tau(omega, xi, gamma, k), &
                                 1.0e-12_wp, "omega tau of branch "//text(k)//", point "//text(i))
               call expect_close(error, omega*p%tau, omega*hopf_tau(omega, xi, gamma, k), &
                                 1.0e-12_wp, "omega tau of (10), branch "//text(k)//", point " &
                                 //text(i))
               call expect_between(error, relative_residual(p, cmplx(0.0_wp, omega, kind=wp)), &
                                   0.0_wp, 1.0e-13_wp, &
                                   "residual of branch "//text(k)//", point "//text(i))
               call expect_close(error, hopf_xi(omega, p%tau, gamma)/xi, 1.0_wp, 1.0e-9_wp, &
                                 "xi of (9) over xi, point "//text(i))
               call expect_close(error, condition%xi_at(omega, p%tau, gamma)/xi, 1.0_wp, &
                                 1.0e-9_wp, "xi over xi, point "//text(i))
            end do
         end associate
      end do
   end subroutine test_curves

   !> For each law, at random points: i omega is a root at epsilon and tau of its pair; the other
   !> frequency has the same epsilon; xi is found again.
   subroutine test_laws(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length), allocatable :: names(:)
      type(block_parameters_type) :: p
      type(characteristic_type) :: c
      type(failure_type), allocatable :: failure
      type(hopf_condition_type) :: condition
      real(wp) :: partner, x(3)
      integer :: i, law

      names = law_names()
      do law = 1, size(names)
         p = block_parameters_type(law=names(law), own=0.7_wp)
         call find_hopf_condition(p, condition, failure)
         call expect_success(error, failure)
         do i = 1, points/4
            x = random_omega(i)
            associate (omega => x(1))
               p%xi = x(2)
               p%gamma = x(3)
               p%epsilon = condition%epsilon_at(omega, p%xi, p%gamma)
               p%tau = condition%tau_at(omega, p%epsilon, p%xi, p%gamma, 1)
               c = block_characteristic(p)
               call expect_between(error, c%relative_residual(cmplx(0.0_wp, omega, kind=wp)), &
                                   0.0_wp, 1.0e-12_wp, "residual of "//trim(p%law)//", point " &
                                   //text(i))
               partner = condition%partner_omega(omega, p%epsilon, p%xi, p%gamma)
               call expect_close(error, (1.0_wp + condition%epsilon_at(partner, p%xi, p%gamma)) &
                                 /(1.0_wp + p%epsilon), 1.0_wp, 1.0e-9_wp, &
                                 "1 + epsilon of the partner, point "//text(i))
               call expect_close(error, condition%xi_at(omega, p%tau, p%gamma)/p%xi, 1.0_wp, &
                                 1.0e-8_wp, "xi over xi, point "//text(i))
               call expect_between(error, condition%largest_omega(p%epsilon)/omega, &
                                   1.0_wp - 1.0e-12_wp, huge(1.0_wp), "largest omega, point " &
                                   //text(i))
            end associate
         end do
      end do
   end subroutine test_laws

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
