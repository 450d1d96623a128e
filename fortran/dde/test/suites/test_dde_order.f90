! SPDX-License-Identifier: BSD-3-Clause
!> Order of one step of the explicit pairs 8(5,3) and 5(4), of its interpolant and of its error
!> estimate: Butcher's condition of every rooted tree, and powers of t.
module test_dde_order
   use dde_bogacki_shampine, only: bogacki_shampine
   use dde_dop853, only: dop853
   use dde_dop853_tableau, only: b1, b10, b11, b12, b6, b7, b8, b9, bhh1, bhh2, bhh3, er1, er10, &
                                 er11, er12, er6, er7, er8, er9
   use dde_explicit_step, only: explicit_step_type
   use dde_errors, only: text
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use rooted_trees, only: grow_trees, tree_counts, tree_system
   use single_step, only: interpolated, take_step
   use undelayed_problems, only: decay, undelayed
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

contains

   subroutine collect_dde_order(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("conditions of order", test_conditions), &
                   new_unittest("estimate of the error", test_estimate), &
                   new_unittest("estimate of far too long steps", test_long_steps)]
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
      real(wp) :: estimate, lacking
      real(wp), allocatable :: misfit(:)
      integer :: i, j, k

      trees = grow_trees(9)
      call expect(error, all([(count(trees%order == i) == tree_counts(i), i=1, 9)]), &
                  "the trees of each order are as many as there are known to be")
      do i = 1, 2
         trees%by_the_clock = i == 2
         do j = 1, size(pairs)
            if (pairs(j) == "bs5") call step%set_up(trees, bogacki_shampine(), lacking)
            if (pairs(j) == "dop853") call step%set_up(trees, dop853(), lacking)
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

   !> The two make the estimate of eq. (II.10.17) of Hairer, Norsett and Wanner (1993) for each
   !> component, of which the largest counts.
   subroutine test_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp), parameter :: absolute = 1.0e-9_wp, relative = 1.0e-8_wp
      real(wp) :: estimate, lacking
      real(wp), dimension(sum(tree_counts(:6))) :: of_order_3, of_order_5, unit

      trees = grow_trees(6)
      call step%set_up(trees, dop853(), lacking)
      call take_step(trees, 0.0_wp, h, step, estimate, relative, absolute)
      unit = absolute + relative*step%y_new
      of_order_3 = h*e_3(step)/unit
      of_order_5 = h*e_5(step)/unit
      call expect_close(error, estimate, &
                        maxval(of_order_5**2/hypot(of_order_5, 0.1_wp*of_order_3), &
                               abs(of_order_5) > 0.0_wp), 1.0e-12_wp*estimate, "the estimate")
   end subroutine test_estimate

   !> y' = -rate y, rates up to 40 in a step of length 1: no step passes whose error is above the
   !> tolerance, not even near 5.66, where e5 of the pair 8(5,3) changes its sign and e3 is large.
   subroutine test_long_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(undelayed) :: problem
      type(explicit_step_type) :: step
      real(wp) :: estimate, lacking, tolerance, worst
      integer :: digits, i, j

      problem = decay(1.0_wp)
      do j = 1, size(pairs)
         do digits = 4, 10
            tolerance = 10.0_wp**(-digits)
            worst = 0.0_wp
            do i = 1, 4000
               problem%rate = 0.01_wp*i
               if (pairs(j) == "bs5") call step%set_up(problem, bogacki_shampine(), lacking)
               if (pairs(j) == "dop853") call step%set_up(problem, dop853(), lacking)
               call take_step(problem, 0.0_wp, 1.0_wp, step, estimate, absolute=tolerance)
               if (estimate > 1.0_wp) cycle
               worst = max(worst, abs(step%y_new(1) - exp(-problem%rate))/tolerance)
            end do
            call expect_between(error, worst, 1.0e-4_wp, 1.0_wp, "largest error of a step of " &
                                //pairs(j)//" that passes at tolerance "//text(tolerance))
         end do
      end do
   end subroutine test_long_steps

   !> Error coefficients of order 5, one for each component.
   pure function e_5(step) result(e)
      type(explicit_step_type), intent(in) :: step
      real(wp) :: e(size(step%y))

      e = matmul(slopes(step), &
                 [er1, er6, er7, er8, er9, er10, er11, er12])
   end function e_5

   !> Error coefficients of order 3, one for each component.
   pure function e_3(step) result(e)
      type(explicit_step_type), intent(in) :: step
      real(wp) :: e(size(step%y))

      e = matmul(slopes(step), &
                 [b1 - bhh1, b6, b7, b8, b9 - bhh2, b10, b11, b12 - bhh3])
   end function e_3

   !> Slopes 1 and 6 to 12, shape (n, 8).
   pure function slopes(step) result(k)
      type(explicit_step_type), intent(in) :: step
      real(wp) :: k(size(step%y), 8)

      k = transpose(step%k([1, 6, 7, 8, 9, 10, 11, 12], :))
   end function slopes
end module test_dde_order
