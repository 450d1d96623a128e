! SPDX-License-Identifier: BSD-3-Clause
!> Orders of one step, of its interpolant and of its error estimate, and of many steps with delays.
!> Explicit pairs meet Butcher's condition of every rooted tree, Radau IIA his simplifying
!> assumptions, and a Taylor step has the terms of its series.
module test_dde_order
   use dde, only: integration_options
   use dde_bogacki_shampine, only: bogacki_shampine
   use dde_dop853, only: dop853
   use dde_dop853_tableau, only: b1, b10, b11, b12, b6, b7, b8, b9, bhh1, bhh2, bhh3, er1, er10, &
                                 er11, er12, er6, er7, er8, er9
   use dde_errors, only: text
   use dde_explicit_step, only: explicit_step_type
   use dde_implicit_step, only: implicit_step_type
   use dde_kinds, only: wp
   use dde_problem, only: dde_problem_type
   use dde_radau_tableau, only: inverse_of_a, radau_iia, radau_tableau
   use dde_taylor_step, only: taylor_step_type
   use expectations, only: expect, expect_between, expect_close
   use layer_problems, only: relaxation, solved
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use rooted_trees, only: grow_trees, tree_counts, tree_system
   use single_step, only: interpolated, take_step, take_taylor_step
   use solving, only: at_tolerance, solve
   use test_problems, only: constant_past, sine
   use undelayed_problems, only: blow_up, swing
   implicit none (type, external)
   private
   public :: collect_dde_order

   !> Length of the step; a power of two, so that its powers are exact.
   real(wp), parameter :: h = 0.5_wp
   !> Places in the step.
   real(wp), parameter :: places(9) = [0.0_wp, 0.07_wp, 0.21_wp, 0.33_wp, 0.45_wp, 0.62_wp, &
                                       0.71_wp, 0.94_wp, 1.0_wp]
   !> The pairs and their orders.
   character(len=6), parameter :: pairs(2) = ["dop853", "bs5   "]
   integer, parameter :: orders(2) = [8, 5]
   !> Numbers of stages.
   integer, parameter :: stages(3) = [3, 5, 7]

contains

   subroutine collect_dde_order(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("conditions of explicit pairs", test_conditions), &
                   new_unittest("estimate of far too long steps", test_long_steps), &
                   new_unittest("conditions of Radau IIA", test_radau_conditions), &
                   new_unittest("Radau IIA steps of an oscillator", test_oscillator), &
                   new_unittest("Taylor steps", test_taylor), &
                   new_unittest("many steps with a delay", test_fixed_steps)]
   end subroutine collect_dde_order

   !> For every tree, with and without the time of the stages: the step gives h**order/density, and
   !> all over the step the interpolant, one order lower, (s h)**order/density. The mean of that of
   !> the pair 5(4) has the order of the step, since the right-hand side integrates the errors of
   !> delayed values; three Gauss points give the mean of degree 4. Estimates vanish up to their
   !> orders: 5 and 3 of the pair 8(5,3), 4 of the pair 5(4).
   subroutine test_conditions(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp), parameter :: aside = sqrt(0.15_wp)
      real(wp) :: estimate
      real(wp), allocatable :: misfit(:)
      integer :: i, j, k

      trees = grow_trees(9)
      call expect(error, all([(count(trees%order == i) == tree_counts(i), i=1, 9)]), &
                  "the trees of each order are as many as there are known to be")
      do i = 1, 2
         trees%by_the_clock = i == 2
         do j = 1, size(pairs)
            call set_up(trees, pairs(j), step)
            call take_step(trees, 0.0_wp, h, step, estimate)
            associate (order => trees%order, known => h**trees%order/trees%density, &
                       pair => pairs(j))
               call expect_order(error, pair, step%y_new/known - 1.0_wp, order, orders(j))
               misfit = spread(0.0_wp, 1, trees%n)
               do k = 1, size(places)
                  misfit = max(misfit, abs(interpolated(step, places(k))/known - places(k)**order))
               end do
               call expect_order(error, "interpolant of "//pair, misfit, order, orders(j) - 1)
               if (pair == "bs5") then
                  misfit = (5.0_wp*interpolated(step, 0.5_wp - aside) &
                            + 8.0_wp*interpolated(step, 0.5_wp) &
                            + 5.0_wp*interpolated(step, 0.5_wp + aside))/18.0_wp
                  call expect_order(error, "mean", misfit/known - 1.0_wp/(order + 1), order, 5)
                  call expect_order(error, "estimate 4", step%embedded(:, 1)/known, order, 4)
               else
                  call expect_order(error, "estimate 5", h*e_5(step)/known, order, 5)
                  call expect_order(error, "estimate 3", h*e_3(step)/known, order, 3)
               end if
            end associate
         end do
      end do
   end subroutine test_conditions

   !> The step of a pair.
   subroutine set_up(problem, pair, step)
      class(dde_problem_type), intent(in) :: problem
      character(len=*), intent(in) :: pair
      type(explicit_step_type), intent(out) :: step
      real(wp) :: lacking

      if (pair == "bs5") call step%set_up(problem, bogacki_shampine(), lacking)
      if (pair == "dop853") call step%set_up(problem, dop853(), lacking)
   end subroutine set_up

   !> Misfits relative to the known value vanish for trees up to an order, not for all beyond.
   subroutine expect_order(error, what, misfit, order, highest)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: misfit(:)
      integer, intent(in) :: order(:), highest

      call expect_between(error, maxval(abs(misfit), order <= highest), 0.0_wp, 1.0e-12_wp, &
                          what//": largest misfit up to order "//text(highest))
      call expect_between(error, maxval(abs(misfit), order == highest + 1), 1.0e-4_wp, 1.0e2_wp, &
                          what//": largest misfit of order "//text(highest + 1))
   end subroutine expect_order

   !> y' = -rate y, rates up to 40 in a step of length 1: no step passes whose error is above the
   !> tolerance, not even near 5.66, where e5 of the pair 8(5,3) changes its sign and e3 is large.
   subroutine test_long_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(solved) :: problem
      real(wp) :: estimate, tolerance, worst
      integer :: digits, i, j

      problem = relaxation(1.0_wp)
      do j = 1, size(pairs)
         do digits = 4, 10
            tolerance = 10.0_wp**(-digits)
            worst = 0.0_wp
            do i = 1, 4000
               problem%p(1) = 0.01_wp*i
               call set_up(problem, pairs(j), step)
               call take_step(problem, 0.0_wp, 1.0_wp, step, estimate, absolute=tolerance)
               if (estimate > 1.0_wp) cycle
               worst = max(worst, abs(step%y_new(1) - exp(-0.01_wp*i))/tolerance)
            end do
            call expect_between(error, worst, 1.0e-4_wp, 1.0_wp, "largest error of a step of " &
                                //pairs(j)//" that passes at tolerance "//text(tolerance))
         end do
      end do
   end subroutine test_long_steps

   !> Error coefficients of order 5 and of order 3, one for each component.
   pure function e_5(step) result(e)
      type(explicit_step_type), intent(in) :: step
      real(wp) :: e(size(step%y))

      e = matmul([er1, er6, er7, er8, er9, er10, er11, er12], &
                 step%k([1, 6, 7, 8, 9, 10, 11, 12], :))
   end function e_5

   pure function e_3(step) result(e)
      type(explicit_step_type), intent(in) :: step
      real(wp) :: e(size(step%y))

      e = matmul([b1 - bhh1, b6, b7, b8, b9 - bhh2, b10, b11, b12 - bhh3], &
                 step%k([1, 6, 7, 8, 9, 10, 11, 12], :))
   end function e_3

   !> Butcher's conditions B(2 s - 1), C(s) and D(s - 1), which make the order 2 s - 1 (Hairer and
   !> Wanner 1996, theorem IV.5.1). B and D are multiplied by the inverse of A, of which the last
   !> row is b: so b A^-1 is (0, .., 0, 1).
   subroutine test_radau_conditions(error)
      type(error_type), allocatable, intent(out) :: error
      type(radau_tableau) :: method
      real(wp), allocatable :: a_inverse(:, :), b(:)
      integer :: i, q

      do i = 1, size(stages)
         method = radau_iia(stages(i))
         a_inverse = inverse_of_a(method)
         associate (c => method%c(:stages(i)), s => stages(i))
            b = radau_weights(c)
            call expect_close(error, matmul(b, a_inverse), [spread(0.0_wp, 1, s - 1), 1.0_wp], &
                              1.0e-12_wp, "the last row of A")
            do q = 1, 2*s - 1
               call expect_close(error, sum(b*c**(q - 1)), 1.0_wp/q, 1.0e-13_wp, "B "//text(q))
            end do
            do q = 1, s
               call expect_close(error, matmul(a_inverse, c**q/q), c**(q - 1), 1.0e-12_wp, &
                                 "C "//text(q))
            end do
            do q = 1, s - 1
               call expect_close(error, matmul(b*(1.0_wp - c**q)/q, a_inverse), b*c**(q - 1), &
                                 1.0e-12_wp, "D "//text(q))
            end do
            call expect_between(error, abs(sum(b*c**(2*s - 1)) - 0.5_wp/s), 1.0e-10_wp, 1.0_wp, &
                                "B beyond")
         end associate
      end do
   end subroutine test_radau_conditions

   !> Weights (1 + x)/(2 s^2 P_(s-1)(x)^2), x = 2 c - 1, of the quadrature with the end as a node
   !> (Abramowitz and Stegun, 25.4.31, mirrored).
   pure function radau_weights(c) result(b)
      real(wp), intent(in) :: c(:)
      real(wp) :: b(size(c))
      real(wp), dimension(size(c)) :: before, legendre, next, x
      integer :: k

      x = 2.0_wp*c - 1.0_wp
      before = 1.0_wp
      legendre = x
      do k = 2, size(c) - 1
         next = ((2*k - 1)*x*legendre - (k - 1)*before)/k
         before = legendre
         legendre = next
      end do
      b = (1.0_wp + x)/(2*size(c)**2*legendre**2)
   end function radau_weights

   !> Halving the step divides its error by 2**(2 s), that inside it by 2**(s + 2) and the length of
   !> the estimate by 2**(s + 1). It turns with h, so that its largest component, which counts, does
   !> not fall with a power of h. The tolerance asks the iteration to go on to rounding.
   subroutine test_oscillator(error)
      type(error_type), allocatable, intent(out) :: error
      type(implicit_step_type) :: step
      type(constant_past) :: problem
      real(wp), parameter :: longest(3) = [0.5_wp, 2.0_wp, 5.0_wp], rounding = 5.0e-15_wp
      real(wp) :: estimate, inside(2), lacking, length, misfit(2), of_estimate(2), tight
      integer :: i, j, k

      problem = swing()
      do i = 1, size(stages)
         associate (s => stages(i))
            tight = rounding**((s + 2.0_wp)/(s + 1.0_wp))
            do j = 1, 2
               length = longest(i)*0.5_wp**j
               call step%set_up(problem, s, tight, lacking)
               call take_step(problem, 0.0_wp, length, step, estimate, tight, tight)
               of_estimate(j) = norm2(step%error_vector/step%scale)
               call expect(error, estimate >= maxval(abs(step%error_vector)/step%scale), &
                           "the estimate is the embedded error, or more in a step far too long")
               misfit(j) = norm2(step%y_new - [cos(length), -sin(length)])
               inside(j) = maxval([(norm2(interpolated(step, places(k)) - &
                                          [cos(length*places(k)), -sin(length*places(k))]), &
                                    k=1, size(places) - 1)])
            end do
            call expect_between(error, halvings(misfit), 2*s - 0.5_wp, 2*s + 0.6_wp, "step")
            call expect_between(error, halvings(inside), s + 1.7_wp, s + 2.6_wp, "inside")
            call expect_between(error, halvings(of_estimate), s + 0.7_wp, s + 1.6_wp, "estimate")
         end associate
      end do
   end subroutine test_oscillator

   !> Power of 2 between values at h and h/2.
   pure real(wp) function halvings(values) result(power)
      real(wp), intent(in) :: values(2)

      power = log(values(1)/values(2))/log(2.0_wp)
   end function halvings

   !> y' = y^2, y(0) = 1 has the series 1 + t + t^2 + ...: all places of a step show its first
   !> terms, so that the error falls with the power degree + 1 of the step.
   subroutine test_taylor(error)
      type(error_type), allocatable, intent(out) :: error
      type(taylor_step_type) :: step
      real(wp) :: estimate
      integer :: degree, k, place

      do degree = 6, 20
         call take_taylor_step(blow_up(), 10.0_wp**(7 - degree), h/2, step, estimate)
         call expect(error, step%constants%order == degree, "degree "//text(degree))
         do place = 1, size(places)
            associate (s => places(place))
               call expect_close(error, interpolated(step, s), &
                                 [sum([((0.5_wp*s*h)**k, k=0, degree)])], 1.0e-15_wp, &
                                 "place "//text(s)//" at degree "//text(degree))
            end associate
         end do
         call expect_close(error, step%y_new, interpolated(step, 1.0_wp), 1.0e-15_wp, "end")
      end do
   end subroutine test_taylor

   !> In steps of lengths that the delay is no multiple of, global errors fall as the step's order
   !> promises; with an interpolant of low order they would not. The error follows the tolerance
   !> over seven decades: between 0.05 and 1 times it by the pair of order 8, up to 5 times by the
   !> other.
   subroutine test_fixed_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      real(wp), parameter :: least(2) = [0.05_wp, 0.2_wp], most(2) = [1.0_wp, 5.0_wp]
      integer, parameter :: first_digits(2) = [6, 3]
      real(wp) :: misfit(2), tolerance
      integer :: digits, i, j

      do j = 1, size(pairs)
         do i = 1, 2
            options = at_tolerance(1.0_wp, pairs(j))
            options%first_step = 0.65_wp/3**(i - 1)
            options%longest_step = options%first_step
            call solve_sine(options, misfit(i))
         end do
         call expect_between(error, log(misfit(1)/misfit(2))/log(3.0_wp), orders(j) - 1.0_wp, &
                             orders(j) + 0.5_wp, "order of "//pairs(j))
         do digits = first_digits(j), first_digits(j) + 6
            tolerance = 10.0_wp**(-digits)
            call solve_sine(at_tolerance(tolerance, pairs(j)), misfit(1))
            call expect_between(error, misfit(1)/tolerance, least(j), most(j), &
                                "error of "//pairs(j)//" per tolerance "//text(tolerance))
         end do
      end do

   contains

      !> Largest error of `sine` over 14 delays.
      subroutine solve_sine(how, largest)
         type(integration_options), intent(in) :: how
         real(wp), intent(out) :: largest
         real(wp), allocatable :: y(:, :)
         integer :: k
         real(wp), parameter :: time(60) = [(0.37_wp*k, k=1, 60)]

         call solve(sine(), time, how, y, error)
         largest = maxval(abs(y(1, :) - sin(time)))
      end subroutine solve_sine
   end subroutine test_fixed_steps
end module test_dde_order
