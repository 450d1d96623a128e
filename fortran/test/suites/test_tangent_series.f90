!> Taylor series of small disturbances: they are the derivatives of the series of solutions.
module test_tangent_series
   use block_builder, only: build_block
   use dde, only: problem_with_tangents
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use published_problems, only: mackey_glass
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_tangent_series

   !> Numbers of disturbances: fewer than are computed at a time, as many, and more.
   integer, parameter :: counts(4) = [1, 3, 4, 5]

   !> Central differences of order six: values at 1, 2 and 3 times the distance to both sides.
   real(wp), parameter :: share(3) = [45, -9, 1]/60.0_wp, distance = 4.0e-4_wp

contains

   !> All tests of this suite.
   subroutine collect_tangent_series(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("the block", test_block), &
                   new_unittest("the slow block", test_slow_block), &
                   new_unittest("mackey-glass", test_mackey_glass)]
   end subroutine collect_tangent_series

   !> With and without delay, at degrees 6 to 20, from slow to fast.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: gamma(3) = [0.05_wp, 0.8_wp, 20.0_wp]
      real(wp), parameter :: w(3) = [0.7_wp, -1.0_wp, 1.5_wp]
      type(spring_block_type) :: problem
      integer :: degree, delays, i, j

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.3_wp*i, xi=0.4_wp + 0.2_wp*i, &
                                  gamma=gamma(i), v=1.1_wp)
            do degree = 6, 20, 7
               do j = 1, size(counts)
                  call compare(problem, 0.1_wp/max(1.0_wp, gamma(i)**2), degree, &
                               [0.4_wp, -0.3_wp, w(i)], counts(j), 0, "gamma = "//text(gamma(i)), &
                               error)
               end do
            end do
         end do
      end do
   end subroutine test_block

   !> Each of three iterations of the slow series, from a state with no other terms.
   subroutine test_slow_block(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: gamma(3) = [1.0e3_wp, 1.0e6_wp, 1.0e12_wp]
      type(spring_block_type) :: problem
      integer :: degree, delays, i, iterations

      do i = 1, size(gamma)
         do delays = 0, 1
            problem = build_block(tau=7.0_wp*delays, epsilon=0.6_wp, xi=0.5_wp, gamma=gamma(i), &
                                  v=1.1_wp)
            do degree = 6, 20, 7
               do iterations = 1, 3
                  call compare(problem, 0.05_wp, degree, [0.4_wp, -0.3_wp, 5.0_wp], 3, iterations, &
                               "gamma = "//text(gamma(i)), error)
               end do
            end do
         end do
      end do
   end subroutine test_slow_block

   !> A quotient and a power.
   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: degree

      do degree = 6, 20, 7
         call compare(mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], &
                                   first=[1.2_wp]), &
                      0.5_wp, degree, [0.8_wp], 3, 0, "mackey-glass", error)
      end do
   end subroutine test_mackey_glass

   !> Disturbances of the state and of the delayed values against differences of solutions, degree
   !> by degree.
   subroutine compare(problem, unit, degree, state, vectors, iterations, what, error)
      class(problem_with_tangents), intent(in) :: problem
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree
      !> State, shape (n)
      real(wp), intent(in) :: state(:)
      integer, intent(in) :: vectors
      !> Iterations of the slow series; 0 for the series itself
      integer, intent(in) :: iterations
      character(len=*), intent(in) :: what
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      real(wp), dimension(0:degree, problem%n) :: before, change, y
      real(wp), dimension(0:degree, problem%n, vectors) :: dy, first
      real(wp) :: dz(0:degree, size(problem%lag), vectors), largest, z(0:degree, size(problem%lag))
      integer :: i, k

      z = 0.0_wp
      if (size(z, 2) > 0) z(:3, 1) = [0.9_wp, -0.1_wp, 0.03_wp, 0.01_wp]
      dz = 0.0_wp
      first = 0.0_wp
      do i = 1, vectors
         if (size(dz, 2) > 0) dz(:4, 1, i) = uniform(i, 5, -1.0_wp, 1.0_wp)
         first(0, :, i) = uniform(100 + i, problem%n, -1.0_wp, 1.0_wp)
      end do
      dy = first
      y = 0.0_wp
      y(0, :) = state
      if (iterations == 0) then
         call problem%series(0.0_wp, unit, degree, z, y)
         call problem%tangent_series(0.0_wp, unit, degree, z, y, vectors, dz, dy)
      end if
      do k = 1, iterations
         before = y
         call problem%slow_series(0.0_wp, unit, degree, z, y)
         call problem%slow_tangent_series(0.0_wp, unit, degree, z, before, y, vectors, dz, dy)
      end do
      do i = 1, vectors
         change = 0.0_wp
         do k = 1, size(share)
            change = change + share(k)/distance*(solution(k*distance) - solution(-k*distance))
         end do
         do k = 0, degree
            ! the first iteration knows no rate yet: its last terms may vanish
            largest = max(maxval(abs(change(k, :))), tiny(1.0_wp))
            call expect_close(error, dy(k, :, i)/largest, change(k, :)/largest, 1.0e-9_wp, &
                              what//", term "//text(k)//" of "//text(degree)//", disturbance " &
                              //text(i)//" of "//text(vectors))
         end do
      end do

   contains

      !> Series of the solution that is a multiple of disturbance i away.
      pure function solution(times) result(series)
         real(wp), intent(in) :: times
         real(wp) :: series(0:degree, problem%n)
         integer :: iteration

         series = 0.0_wp
         series(0, :) = state + times*first(0, :, i)
         associate (delayed => z + times*dz(:, :, i))
            if (iterations == 0) call problem%series(0.0_wp, unit, degree, delayed, series)
            do iteration = 1, iterations
               call problem%slow_series(0.0_wp, unit, degree, delayed, series)
            end do
         end associate
      end function solution
   end subroutine compare
end module test_tangent_series
