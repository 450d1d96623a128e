!> The block's own series and derivatives solve its equations.
module test_block_series
   use block_builder, only: build_block
   use dde_errors, only: text
   use dde_interpolant, only: series_value
   use dde_kinds, only: wp
   use expectations, only: expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_block_series

contains

   !> All tests of this suite.
   subroutine collect_block_series(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("series of the block", test_taylor_series), &
                   new_unittest("slow series of the block", test_slow_series)]
   end subroutine collect_block_series

   !> The series of the block, with a delayed value that is a polynomial, solves its equations: its
   !> derivative is the right-hand side, but for what follows the last term.
   subroutine test_taylor_series(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 20
      real(wp), parameter :: gamma(4) = [0.05_wp, 0.8_wp, 3.0_wp, 20.0_wp], s = 0.5_wp
      real(wp), parameter :: w(4) = [0.7_wp, -1.0_wp, 0.1_wp, 1.5_wp]
      type(spring_block_type) :: problem
      real(wp) :: coefficient(0:degree, 3), found(3), rises(0:degree - 1, 3), slope(3), unit
      real(wp), allocatable :: delayed(:, :)
      integer :: delays, i, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.3_wp*i, xi=0.4_wp + 0.2_wp*i, &
                                  gamma=gamma(i), v=1.1_wp)
            allocate (delayed(0:degree, delays), source=0.0_wp)
            if (delays > 0) delayed(:3, 1) = [0.2_wp, -0.1_wp, 0.03_wp, 0.01_wp]
            coefficient = 0.0_wp
            coefficient(0, :) = [0.4_wp, -0.3_wp, w(i)]
            unit = 0.1_wp/max(1.0_wp, gamma(i)**2)
            call problem%series(0.0_wp, unit, degree, delayed, coefficient)
            call problem%rhs(0.0_wp, polynomial(coefficient, s), polynomial(delayed, s), slope)
            rises = spread([(real(k, wp), k=1, degree)], 2, 3)*coefficient(1:, :)
            found = polynomial(rises, s)/unit
            call expect_close(error, found/maxval(abs(slope)), slope/maxval(abs(slope)), &
                              1.0e-13_wp, "slope for gamma = "//text(gamma(i)))
            deallocate (delayed)
         end do
      end do
   end subroutine test_taylor_series

   !> Polynomials at s.
   pure function polynomial(coefficient, s) result(value)
      !> Coefficients, shape (0:degree, polynomials)
      real(wp), intent(in) :: coefficient(0:, :)
      real(wp), intent(in) :: s
      real(wp) :: value(size(coefficient, 2))
      integer :: k

      value = 0.0_wp
      do k = ubound(coefficient, 1), 0, -1
         value = coefficient(k, :) + s*value
      end do
   end function polynomial

   !> Iterated from a state, the slow series of the block balances w, with theta and u by (4).
   subroutine test_slow_series(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 14
      real(wp), parameter :: gamma(3) = [1.0e3_wp, 1.0e6_wp, 1.0e12_wp], s = 0.7_wp
      type(spring_block_type) :: problem
      real(wp) :: found(3), rises(0:degree - 1, 3), slope(3), state(3), v, y(0:degree, 3)
      real(wp), allocatable :: z(:, :)
      real(wp), parameter :: unit = 0.05_wp
      integer :: delays, i, k

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.6_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            allocate (z(0:degree, delays), source=0.0_wp)
            if (delays > 0) z(:3, 1) = [0.2_wp, -0.1_wp, 0.03_wp, 0.01_wp]
            y = 0.0_wp
            y(0, :) = [0.4_wp, -0.3_wp, 5.0_wp]
            do k = 1, 4
               call problem%slow_series(0.0_wp, unit, degree, z, y)
            end do
            state = [(series_value(degree, y(:, k), s), k=1, 3)]
            rises = spread([(k, k=1, degree)], 2, 3)*y(1:, :)
            found = [(series_value(degree - 1, rises(:, k), s), k=1, 3)]/unit
            v = exp(state(3))
            call problem%rhs(0.0_wp, state, [(series_value(degree, z(:, k), s), k=1, delays)], &
                             slope)
            call expect_close(error, found(:2), slope(:2), 1.0e-12_wp, "theta and u")
            call expect_close(error, state(3), -state(1) - 0.5_wp*state(2) &
                              - 0.5_wp/gamma(i)**2*v*found(3), 1.0e-14_wp, &
                              "balance at gamma = "//text(gamma(i)))
            deallocate (z)
         end do
      end do
   end subroutine test_slow_series
end module test_block_series
