!> Stiff runs of the implicit methods and of `auto`: accuracy at and between the ends of steps,
!> slips, the fall of v after them, and a quantity that is conserved at infinite gamma.
module test_dde_stiff
   use block_builder, only: build_block
   use dde, only: integrate, integration_result
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect_between, expect_close, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, solve
   use spring_block, only: spring_block_type
   use stiff_problems, only: prothero_robinson
   implicit none (type, external)
   private
   public :: collect_dde_stiff

   !> Methods under test.
   character(len=8), parameter :: methods(4) = ["radau5  ", "radau9  ", "radau13 ", "auto    "]

contains

   !> All tests of this suite.
   subroutine collect_dde_stiff(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("stiff accuracy", test_prothero_robinson), &
                   new_unittest("between the ends of stiff steps", test_inside), &
                   new_unittest("through slips at gamma 1e12", test_slips), &
                   new_unittest("down to where v is 1e-34", test_fall), &
                   new_unittest("conserved at infinite gamma", test_conserved)]
   end subroutine collect_dde_stiff

   !> y = cos t at rates up to -1e12, in steps that the solution needs and not the rate. Here the
   !> order falls to s + 1 (order reduction); the error stays within a hundred tolerances.
   subroutine test_prothero_robinson(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      integer :: i, power

      do power = 2, 12, 5
         do i = 1, size(methods)
            call integrate(prothero_robinson(-10.0_wp**power), 0.0_wp, 10.0_wp, &
                           at_tolerance(1.0e-8_wp, methods(i)), outcome, failure)
            call expect_success(error, failure)
            call expect_close(error, outcome%y, [cos(10.0_wp)], 1.0e-6_wp, trim(methods(i)))
            call expect_between(error, real(outcome%accepted, wp), 5.0_wp, 800.0_wp, "steps")
         end do
      end do
   end subroutine test_prothero_robinson

   !> Samples between the ends of steps that are far longer than the time in which y follows cos t.
   !> As rounding goes, radau5 ends at 5 to 20 times the smaller tolerance, the others below 1.
   subroutine test_inside(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: tolerance(2) = [1.0e-6_wp, 1.0e-10_wp]
      real(wp) :: time(1000)
      integer :: i, j

      time = [(0.02_wp*i, i=1, size(time))]
      do j = 1, size(tolerance)
         do i = 1, size(methods)
            call solve(prothero_robinson(-1.0e6_wp), time, at_tolerance(tolerance(j), methods(i)), &
                       y, error)
            call expect_close(error, y(1, :), cos(time), 30.0_wp*tolerance(j), trim(methods(i)))
         end do
      end do
   end subroutine test_inside

   !> Without delay, gamma = 1e12: the run passes several slips, in which steps are far below the
   !> spacing of t, and methods of different order agree.
   subroutine test_slips(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      real(wp) :: first(3)
      integer :: i

      block_model = build_block(tau=0.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e12_wp, &
                                u=0.5_wp, v=1.1_wp)
      do i = 1, size(methods)
         call integrate(block_model, 0.0_wp, 100.0_wp, at_tolerance(1.0e-9_wp, methods(i)), &
                        outcome, failure)
         call expect_success(error, failure)
         if (i == 1) first = outcome%y
         call expect_close(error, outcome%y, first, 1.0e-4_wp, trim(methods(i)))
      end do
   end subroutine test_slips

   !> After a slip at great epsilon v falls to 1e-34 within 1e-29 of time, less than moves even a
   !> compensated time. A false solution of a step's equations would throw the block far off; on the
   !> true one forces balance before and after.
   subroutine test_fall(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      real(wp), parameter :: tolerance(3) = [1.0e-4_wp, 1.0e-6_wp, 1.0e-9_wp]
      integer :: i, j

      block_model = build_block(tau=0.0_wp, epsilon=5.0_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp)
      do j = 1, size(tolerance)
         do i = 1, size(methods)
            call integrate(block_model, 0.0_wp, 50.0_wp, at_tolerance(tolerance(j), methods(i)), &
                           outcome, failure)
            call expect_success(error, failure)
            associate (theta => outcome%y(1), u => outcome%y(2), w => outcome%y(3))
               call expect_between(error, abs(u), 0.0_wp, 1000.0_wp, trim(methods(i))//": u")
               call expect_close(error, [u + (theta + w)/0.5_wp], [0.0_wp], &
                                 1000.0_wp*tolerance(j), trim(methods(i))//": balance of forces")
            end associate
         end do
      end do
   end subroutine test_fall

   !> Without delay, at epsilon = xi and infinite gamma, theta = -w - xi u, u' = v - 1 and
   !> w' = xi [v (w - u - 1) + 1]. Then H = exp(-xi u) [1/xi + 1 + u - w - 1/v] is constant: with Q
   !> its bracket, exp(xi u) H' = (v - 1)(1 - xi Q) - (1 - 1/v) w' = 0. At finite gamma H drifts by
   !> D/gamma^2 + O(gamma^-4). D is taken from gamma = 1e3. Up to gamma = 1e5 the drift is more than
   !> ten times what is allowed, ten tolerances; at gamma = 1e8 and 1e12 no drift may exceed these.
   subroutine test_conserved(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(spring_block_type) :: block_model
      real(wp), parameter :: xi = 0.5_wp, w0 = 1.2_wp, tolerance = 1.0e-12_wp
      integer, parameter :: powers(10) = [6, 3, 4, 5, 7, 8, 9, 10, 16, 24]
      real(wp) :: drift, times_square
      integer :: i, j

      do i = 1, size(methods)
         do j = 1, size(powers)
            associate (square => 10.0_wp**powers(j))
               block_model = build_block(tau=0.0_wp, epsilon=xi, xi=xi, gamma=sqrt(square), &
                                         theta=-w0, v=exp(w0))
               call integrate(block_model, 0.0_wp, 30.0_wp, at_tolerance(tolerance, methods(i)), &
                              outcome, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               drift = conserved(outcome%y(2), outcome%y(3)) - conserved(0.0_wp, w0)
               if (j == 1) times_square = drift*square
               call expect_close(error, drift, times_square/square, &
                                 10.0_wp*(1.0_wp/square**2 + 2.0e-6_wp/square + tolerance), &
                                 trim(methods(i))//": drift at gamma^2 = 1e"//text(powers(j)))
            end associate
         end do
         call expect_between(error, abs(times_square), 0.1_wp, 10.0_wp, "drift times gamma^2")
      end do

   contains

      !> H.
      pure real(wp) function conserved(u, w) result(value)
         !> Displacement and ln v
         real(wp), intent(in) :: u, w

         value = exp(-xi*u)*(1.0_wp/xi + 1.0_wp + u - w - exp(-w))
      end function conserved
   end subroutine test_conserved
end module test_dde_stiff
