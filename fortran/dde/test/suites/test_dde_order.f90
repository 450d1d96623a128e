!> Order of one step of the explicit pairs 8(5,3) and 5(4), of its interpolant and of its error
!> estimate: Butcher's condition of every rooted tree, and powers of t.
module test_dde_order
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

      testsuite = [new_unittest("conditions of the steps", test_step_conditions), &
                   new_unittest("conditions of the interpolants", test_interpolant_conditions), &
                   new_unittest("mean of the interpolant", test_mean), &
                   new_unittest("conditions of the estimates", test_estimate_conditions), &
                   new_unittest("estimate of the error", test_estimate), &
                   new_unittest("estimate of far too long steps", test_long_steps)]
   end subroutine collect_dde_order

   !> The step gives h**order/density for every tree up to its order, but not for those of the next;
   !> with and without the time of its stages.
   subroutine test_step_conditions(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp) :: estimate
      real(wp), allocatable :: misfit(:)
      integer :: i, j

      trees = grow_trees(9)
      call expect(error, all([(count(trees%order == i) == tree_counts(i), i=1, 9)]), &
                  "the trees of each order are as many as there are known to be")
      do i = 1, 2
         trees%by_the_clock = i == 2
         do j = 1, size(pairs)
            call step%set_up(trees, pairs(j))
            call take_step(trees, 0.0_wp, h, step, estimate)
            misfit = abs(step%y_new/h**trees%order - 1.0_wp/trees%density)
            call expect_between(error, maxval(misfit, trees%order <= orders(j)), 0.0_wp, &
                                1.0e-14_wp, "largest misfit up to order "//text(orders(j)))
            call expect_between(error, maxval(misfit, trees%order == orders(j) + 1), 1.0e-6_wp, &
                                1.0e-4_wp, "largest misfit beyond order "//text(orders(j)))
         end do
      end do
   end subroutine test_step_conditions

   !> All over the step, the interpolant gives (s h)**order/density for every tree up to an order
   !> one lower, but not for the next; with and without the time of its stages.
   subroutine test_interpolant_conditions(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp) :: estimate
      real(wp), allocatable :: misfit(:)
      integer :: i, j, k

      trees = grow_trees(8)
      do i = 1, 2
         trees%by_the_clock = i == 2
         do k = 1, size(pairs)
            call step%set_up(trees, pairs(k))
            call take_step(trees, 0.0_wp, h, step, estimate)
            misfit = spread(0.0_wp, 1, trees%n)
            do j = 1, size(places)
               misfit = max(misfit, abs(interpolated(step, places(j))/h**trees%order &
                                        - places(j)**trees%order/trees%density))
            end do
            call expect_between(error, maxval(misfit, trees%order < orders(k)), 0.0_wp, &
                                1.0e-14_wp, "largest misfit below order "//text(orders(k)))
            call expect_between(error, maxval(misfit, trees%order == orders(k)), 1.0e-5_wp, &
                                1.0e-2_wp, "largest misfit of order "//text(orders(k)))
         end do
      end do
   end subroutine test_interpolant_conditions

   !> The estimate of order 5 of the pair 8(5,3) vanishes for every tree up to order 5, that of
   !> order 3 up to order 3, that of the pair 5(4) up to order 4, and none beyond; with and without
   !> the time of the stages.
   subroutine test_estimate_conditions(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp) :: estimate
      integer :: i, j

      trees = grow_trees(6)
      do i = 1, 2
         trees%by_the_clock = i == 2
         call step%set_up(trees, pairs(2))
         call take_step(trees, 0.0_wp, 1.0_wp, step, estimate)
         do j = 1, 2
            associate (e => pack(abs(step%embedded(:, :, j)), .true.), order => trees%order)
               call expect_between(error, maxval(e(:trees%n), order <= 4), 0.0_wp, 1.0e-14_wp, &
                                   "estimate 4 of orders 1 to 4")
               call expect_between(error, maxval(e(:trees%n), order == 5), 1.0e-5_wp, 1.0e-1_wp, &
                                   "estimate 4 of order 5")
            end associate
         end do
         call step%set_up(trees, pairs(1))
         call take_step(trees, 0.0_wp, 1.0_wp, step, estimate)
         associate (e3 => abs(e_3(step)), e5 => abs(e_5(step)), order => trees%order)
            call expect_between(error, maxval(e5, order <= 5), 0.0_wp, 1.0e-14_wp, &
                                "estimate 5 of orders 1 to 5")
            call expect_between(error, maxval(e5, order == 6), 1.0e-5_wp, 1.0e-2_wp, &
                                "estimate 5 of order 6")
            call expect_between(error, maxval(e3, order <= 3), 0.0_wp, 1.0e-14_wp, &
                                "estimate 3 of orders 1 to 3")
            call expect_between(error, maxval(e3, order == 4), 1.0e-3_wp, 1.0_wp, &
                                "estimate 3 of order 4")
         end associate
      end do
   end subroutine test_estimate_conditions

   !> The two make the estimate of eq. (II.10.17) of Hairer, Norsett and Wanner (1993) for each
   !> component, of which the largest counts.
   subroutine test_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp), parameter :: absolute = 1.0e-9_wp, relative = 1.0e-8_wp
      real(wp) :: estimate
      real(wp), dimension(sum(tree_counts(:6))) :: of_order_3, of_order_5, unit

      trees = grow_trees(6)
      call step%set_up(trees, pairs(1))
      call take_step(trees, 0.0_wp, h, step, estimate, relative, absolute)
      unit = absolute + relative*step%y_new
      of_order_3 = h*e_3(step)/unit
      of_order_5 = h*e_5(step)/unit
      call expect_close(error, estimate, &
                        maxval(of_order_5**2/hypot(of_order_5, 0.1_wp*of_order_3), &
                               abs(of_order_5) > 0.0_wp), 1.0e-12_wp*estimate, "the estimate")
   end subroutine test_estimate

   !> The mean of the interpolant of the pair 5(4) has the order of the step: the right-hand side
   !> integrates the errors of delayed values. Three Gauss points give the mean of degree 4.
   subroutine test_mean(error)
      type(error_type), allocatable, intent(out) :: error
      type(explicit_step_type) :: step
      type(tree_system) :: trees
      real(wp), parameter :: aside = sqrt(0.15_wp)
      real(wp) :: estimate
      real(wp), allocatable :: mean(:), misfit(:)

      trees = grow_trees(6)
      call step%set_up(trees, "bs5")
      call take_step(trees, 0.0_wp, h, step, estimate)
      mean = (5.0_wp*interpolated(step, 0.5_wp - aside) + 8.0_wp*interpolated(step, 0.5_wp) &
              + 5.0_wp*interpolated(step, 0.5_wp + aside))/18.0_wp
      misfit = abs(mean/h**trees%order - 1.0_wp/((trees%order + 1)*trees%density))
      call expect_between(error, maxval(misfit, trees%order <= 5), 0.0_wp, 1.0e-14_wp, &
                          "largest misfit of orders 1 to 5")
      call expect_between(error, maxval(misfit, trees%order == 6), 1.0e-6_wp, 1.0e-2_wp, &
                          "largest misfit of order 6")
   end subroutine test_mean

   !> y' = -rate y, rates up to 40 in a step of length 1: no step passes whose error is above the
   !> tolerance, not even near 5.66, where e5 of the pair 8(5,3) changes its sign and e3 is large.
   subroutine test_long_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(undelayed) :: problem
      type(explicit_step_type) :: step
      real(wp) :: estimate, tolerance, worst
      integer :: digits, i, j

      problem = decay(1.0_wp)
      do j = 1, size(pairs)
         do digits = 4, 10
            tolerance = 10.0_wp**(-digits)
            worst = 0.0_wp
            do i = 1, 4000
               problem%rate = 0.01_wp*i
               call step%set_up(problem, pairs(j))
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
      real(wp) :: by_component(size(step%k, 1)*size(step%k, 2), size(step%k, 3))

      by_component = reshape(step%k, shape(by_component))
      k = by_component(:size(step%y), [1, 6, 7, 8, 9, 10, 11, 12])
   end function slopes
end module test_dde_order
