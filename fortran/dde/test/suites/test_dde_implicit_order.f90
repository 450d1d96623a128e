! SPDX-License-Identifier: BSD-3-Clause
!> Order of one Radau IIA step, of its interpolant and of its error estimate, for 3, 5 and 7 stages.
module test_dde_implicit_order
   use dde_collocation, only: combine, lagrange_factors, lagrange_weights
   use dde_implicit_step, only: implicit_step_type
   use dde_jacobian, only: jacobian_type
   use dde_radau_tableau, only: radau_iia, radau_tableau
   use dde_stage_systems, only: stage_systems
   use dde_systems, only: complex_system, real_system
   use dde_work, only: work_type
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use single_step, only: interpolated, take_step
   use undelayed_problems, only: swing, undelayed
   implicit none (type, external)
   private
   public :: collect_dde_implicit_order

   !> Numbers of stages.
   integer, parameter :: stages(3) = [3, 5, 7]
   !> Places in the step.
   real(wp), parameter :: places(5) = [0.05_wp, 0.31_wp, 0.52_wp, 0.77_wp, 0.93_wp]
   !> What the estimate is asked for, so that the iteration goes on to rounding.
   real(wp), parameter :: rounding = 5.0e-15_wp

contains

   subroutine collect_dde_implicit_order(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("conditions B, C and D", test_conditions), &
                   new_unittest("one step of an oscillator", test_oscillator), &
                   new_unittest("elimination", test_elimination), &
                   new_unittest("a row of huge numbers", test_huge_row), &
                   new_unittest("delayed values in the step", test_coupling)]
   end subroutine collect_dde_implicit_order

   !> Butcher's conditions B(2 s - 1), C(s) and D(s - 1), which make the order 2 s - 1 (Hairer and
   !> Wanner 1996, theorem IV.5.1).
   subroutine test_conditions(error)
      type(error_type), allocatable, intent(out) :: error
      type(radau_tableau) :: method
      type(real_system) :: transposed
      type(stage_systems) :: systems
      real(wp), allocatable :: a_inverse(:, :), b(:)
      integer :: i, q
      logical :: singular

      do i = 1, size(stages)
         method = radau_iia(stages(i))
         systems = stage_systems(method, 1)
         associate (c => method%c, s => stages(i))
            a_inverse = systems%a_inverse(:s, :)
            ! b is the last row of A
            call transposed%fill(full_matrix(-transpose(a_inverse)), 0.0_wp)
            call transposed%factorise(singular)
            b = [spread(0.0_wp, 1, s - 1), 1.0_wp]
            call transposed%solve(b)
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
   end subroutine test_conditions

   !> Halving h divides the error of a step by 2**(2 s), that inside the step by 2**(s + 2) and the
   !> length of the estimate by 2**(s + 1). It turns with h, so that its largest component, which
   !> counts, does not fall with a power of h.
   subroutine test_oscillator(error)
      type(error_type), allocatable, intent(out) :: error
      type(implicit_step_type) :: step
      type(undelayed) :: problem
      real(wp), parameter :: longest(3) = [0.5_wp, 2.0_wp, 5.0_wp]
      real(wp) :: estimate, h, inside(2), lacking, misfit(2), of_estimate(2)
      integer :: i, j, k

      problem = swing()
      do i = 1, size(stages)
         do j = 1, 2
            h = longest(i)*0.5_wp**j
            call step%set_up(problem, stages(i), tight(stages(i)), lacking)
            call take_step(problem, 0.0_wp, h, step, estimate, tight(stages(i)), tight(stages(i)))
            of_estimate(j) = norm2(step%error_vector/step%scale)
            call expect(error, estimate >= maxval(abs(step%error_vector)/step%scale), &
                        "the estimate is the embedded error, or more in a step far too long")
            misfit(j) = norm2(step%y_new - [cos(h), -sin(h)])
            inside(j) = maxval([(norm2(interpolated(step, places(k)) &
                                       - [cos(h*places(k)), -sin(h*places(k))]), &
                                 k=1, size(places))])
         end do
         associate (s => stages(i))
            call expect_between(error, halvings(misfit), 2*s - 0.5_wp, 2*s + 0.6_wp, "step")
            call expect_between(error, halvings(inside), s + 1.7_wp, s + 2.6_wp, "inside")
            call expect_between(error, halvings(of_estimate), s + 0.7_wp, s + 1.6_wp, "estimate")
         end associate
      end do
   end subroutine test_oscillator

   !> Real and complex systems are solved, full and banded, with rows exchanged.
   subroutine test_elimination(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 20, lower(3) = [2, 1, n - 1], upper(3) = [1, 3, n - 1]
      type(complex_system) :: complex
      type(jacobian_type) :: jacobian
      type(real_system) :: real_one
      real(wp) :: a(n, n), side(n), x(n)
      complex(wp) :: z(n)
      integer :: i, k
      logical :: singular

      side = uniform(5, n, -1.0_wp, 1.0_wp)
      do k = 1, size(lower)
         a = reshape(uniform(6, n*n, -1.0_wp, 1.0_wp), [n, n])
         jacobian = full_matrix(a)
         if (k < 3) call cut_band(a, lower(k), upper(k), jacobian)
         x = side
         call real_one%fill(jacobian, 0.0_wp)
         call real_one%factorise(singular)
         call real_one%solve(x)
         call expect(error, any(real_one%pivot /= [(i, i=1, n)]), "rows are exchanged")
         call expect_close(error, -matmul(a, x), side, 1.0e-12_wp, "real")
         z = side
         call complex%fill(jacobian, (0.0_wp, 2.0_wp))
         call complex%factorise(singular)
         call complex%solve(z)
         z = (0.0_wp, 2.0_wp)*z - matmul(a, z)
         call expect_close(error, real(z), side, 1.0e-12_wp, "complex")
         call expect_close(error, aimag(z), 0.0_wp*side, 1.0e-12_wp, "complex")
      end do
   end subroutine test_elimination

   !> A full matrix as the Jacobian of a problem with one delayed value.
   pure type(jacobian_type) function full_matrix(a) result(jacobian)
      real(wp), intent(in) :: a(:, :)

      jacobian%by_y = a
      jacobian%row_sums = sum(abs(a), 2)
      jacobian%lower = size(a, 1) - 1
      jacobian%upper = size(a, 1) - 1
   end function full_matrix

   !> Cut a matrix to a band, and store that as a Jacobian.
   pure subroutine cut_band(a, lower, upper, jacobian)
      real(wp), intent(inout) :: a(:, :)
      integer, intent(in) :: lower, upper
      type(jacobian_type), intent(inout) :: jacobian
      integer :: i, j

      jacobian%banded = .true.
      jacobian%row_sums = sum(abs(a), 2)
      jacobian%lower = lower
      jacobian%upper = upper
      jacobian%by_y = spread(spread(0.0_wp, 1, 1 + lower + upper), 2, size(a, 2))
      do j = 1, size(a, 2)
         do i = 1, size(a, 1)
            if (i - j > lower .or. j - i > upper) then
               a(i, j) = 0.0_wp
            else
               jacobian%by_y(1 + upper + i - j, j) = a(i, j)
            end if
         end do
      end do
   end subroutine cut_band

   !> One Newton correction of a block deep in stick (stiffness 1e23, near balance of forces), alone
   !> and with the delay inside the step: theta stays, u falls by h c. The row of ln v must not
   !> be the pivot for the others.
   subroutine test_huge_row(error)
      type(error_type), allocatable, intent(out) :: error
      type(radau_tableau) :: method
      type(stage_systems) :: systems
      real(wp), parameter :: h = 2.8e-4_wp, stiffness = 1.0e23_wp
      real(wp), allocatable, dimension(:, :) :: change, correction, own_place, slopes
      type(jacobian_type) :: jacobian
      integer :: i, lag
      logical :: singular
      type(work_type) :: work

      jacobian = full_matrix(spread(spread(0.0_wp, 1, 3), 2, 3))
      allocate (jacobian%by_z(3, 1), source=0.0_wp)
      jacobian%rows = reshape([1, 3], [2, 1])
      jacobian%row_sums(3) = 5.0_wp*stiffness
      jacobian%by_y(3, :) = -stiffness*[2.0_wp, 1.0_wp, 2.0_wp - 2.0e-8_wp]
      do i = 1, size(stages)
         do lag = 0, 1
            method = radau_iia(stages(i))
            systems = stage_systems(method, 3)
            own_place = reshape(method%c - (0.35_wp + lag), [1, stages(i)])
            slopes = spread([0.0_wp, -1.0_wp, -2.0e-8_wp*stiffness], 2, stages(i))
            change = slopes
            correction = slopes
            call systems%prepare(method, h, jacobian, [3], own_place, &
                                 weights_at(method, own_place), work, singular)
            call systems%correct(method, slopes, 0.0_wp*slopes, work, correction)
            call combine(3, stages(i), systems%t, correction, change)
            call expect(error, systems%coupled .neqv. lag == 1, "coupled by a short delay")
            call expect_close(error, change(1, :), 0.0_wp*method%c, 1.0e-15_wp, "theta")
            call expect_close(error, change(2, :), -h*method%c, 1.0e-15_wp, "u")
         end do
      end do
   end subroutine test_huge_row

   !> A correction solves the linearised equations of all stages, and the filter its own, with two
   !> delays that lie in the step at all stages, at some and at none; full and banded.
   subroutine test_coupling(error)
      type(error_type), allocatable, intent(out) :: error
      type(jacobian_type) :: banded, full
      integer, parameter :: n = 6
      real(wp), parameter :: lags(2, 3) = reshape([0.01_wp, 0.3_wp, 0.5_wp, 0.02_wp, 0.4_wp, &
                                                   0.9_wp], [2, 3])
      real(wp) :: band_by_z(n, 2), by_y(n, n), by_z(n, 2), in_band(n, n)
      integer :: i, lag

      by_y = reshape(uniform(1, n*n, -2.0_wp, 2.0_wp), [n, n])
      by_z = reshape(uniform(2, n*2, -2.0_wp, 2.0_wp), [n, 2])
      full = full_matrix(by_y)
      full%by_z = by_z
      full%rows = reshape([1, n, 1, n], [2, 2])
      in_band = by_y
      call cut_band(in_band, 1, 2, banded)
      banded%by_z = by_z(:3, :)
      banded%rows = reshape([4, 6, 2, 3], [2, 2])
      band_by_z = 0.0_wp
      band_by_z(4:6, 1) = by_z(:3, 1)
      band_by_z(2:3, 2) = by_z(:2, 2)
      do i = 1, size(stages)
         do lag = 1, size(lags, 2)
            call check_systems(error, radau_iia(stages(i)), full, by_y, by_z, lags(:, lag))
            call check_systems(error, radau_iia(stages(i)), banded, in_band, band_by_z, &
                               lags(:, lag))
         end do
      end do
   end subroutine test_coupling

   !> The systems of a step of length 0.7 with two delayed values, of components 3 and 1.
   subroutine check_systems(error, method, jacobian, by_y, by_z, lags)
      type(error_type), allocatable, intent(inout) :: error
      type(radau_tableau), intent(in) :: method
      type(jacobian_type), intent(in) :: jacobian
      !> Its elements
      real(wp), intent(in) :: by_y(:, :), by_z(:, :)
      real(wp), intent(in) :: lags(2)
      type(stage_systems) :: systems
      real(wp), parameter :: h = 0.7_wp
      integer, parameter :: component(2) = [3, 1]
      real(wp), dimension(size(by_y, 1), method%stages) :: change, correction, left, slopes
      real(wp) :: own_place(2, method%stages), weights(method%stages, 2, method%stages)
      real(wp), dimension(size(by_y, 1)) :: filtered, vector
      integer :: j, k
      logical :: singular
      type(work_type) :: work

      associate (n => size(by_y, 1), s => method%stages)
         vector = uniform(3, n, -1.0_wp, 1.0_wp)
         systems = stage_systems(method, n)
         do j = 1, s
            own_place(:, j) = method%c(j) - lags/h
         end do
         slopes = reshape(uniform(4, n*s, -1.0_wp, 1.0_wp), [n, s])
         weights = weights_at(method, own_place)
         call systems%prepare(method, h, jacobian, component, own_place, weights, work, singular)
         call systems%correct(method, slopes, 0.0_wp*slopes, work, correction)
         call combine(n, s, systems%t, correction, change)
         left = matmul(change, transpose(systems%a_inverse(:s, :)))/h - matmul(by_y, change)
         do j = 1, s
            do k = 1, 2
               if (own_place(k, j) <= 0.0_wp) cycle
               left(:, j) = left(:, j) - by_z(:, k)*sum(weights(:, k, j)*change(component(k), :))
            end do
         end do
         call expect(error, .not. singular, "there is a solution")
         do j = 1, s
            call expect_close(error, left(:, j), slopes(:, j), 1.0e-12_wp, "stage "//text(j))
         end do
         filtered = vector
         call systems%filter(filtered)
         left(:, 1) = method%real_eigenvalue/h*filtered - matmul(by_y, filtered)
         do k = 1, 2
            if (own_place(k, s) > 0.0_wp) then
               left(:, 1) = left(:, 1) - by_z(:, k)*filtered(component(k))
            end if
         end do
         call expect_close(error, left(:, 1), vector, 1.0e-13_wp, "the filter")
      end associate
   end subroutine check_systems

   !> Weights of the stage increments in the delayed values of each stage.
   pure function weights_at(method, own_place) result(weights)
      type(radau_tableau), intent(in) :: method
      !> Places of the delayed values in the step, shape (delayed values, stages)
      real(wp), intent(in) :: own_place(:, :)
      real(wp) :: weights(method%stages, size(own_place, 1), method%stages)
      integer :: i, k

      do i = 1, method%stages
         do k = 1, size(own_place, 1)
            associate (x => [0.0_wp, method%c])
               call lagrange_weights(method%stages, x, lagrange_factors(x), own_place(k, i), &
                                     weights(:, k, i))
            end associate
         end do
      end do
   end function weights_at

   !> Tolerance at which a method of s stages asks `rounding` of its estimate of order s.
   pure real(wp) function tight(s) result(tolerance)
      integer, intent(in) :: s

      tolerance = rounding**((s + 2.0_wp)/(s + 1.0_wp))
   end function tight

   !> Power of 2 between two values.
   pure real(wp) function halvings(values) result(power)
      !> Values at h and h/2
      real(wp), intent(in) :: values(2)

      power = log(values(1)/values(2))/log(2.0_wp)
   end function halvings
end module test_dde_implicit_order
