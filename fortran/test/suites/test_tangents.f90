!> Tangent vectors, and averages of their growth.
module test_tangents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use block_builder, only: build_block
   use dde, only: continuation_type, integrate, integration_result
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use exponent_averages, only: average_growth, dimension_of, exponent_type, without_sign
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   use tangent_problem, only: tangent_problem_type
   use tangent_vectors, only: orthonormalise, start_vectors, undisturbed_part
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_tangents

contains

   !> All tests of this suite.
   subroutine collect_tangents(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("variational equations", test_variational_equations), &
                   new_unittest("norm", test_norm), &
                   new_unittest("smooth restart", test_smooth_restart), &
                   new_unittest("averages", test_averages), &
                   new_unittest("errors of averages", test_errors), &
                   new_unittest("dimension", test_dimension)]
   end subroutine collect_tangents

   !> Tangent vectors follow small differences of solutions; their derivatives are the blocks.
   subroutine test_variational_equations(error)
      type(error_type), allocatable, intent(out) :: error
      type(spring_block_type) :: block
      type(tangent_problem_type) :: problem
      real(wp), parameter :: h = 1.0e-6_wp
      real(wp) :: by_y(9, 9), by_z(9, 3), dydt(9), ahead(3), back(3), y(9), z(3)
      integer :: i, j

      block = build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=2.0_wp, theta=0.1_wp, &
                          u=0.2_wp, v=1.1_wp)
      problem = tangent_problem_type(block, 2)
      call expect(error, problem%n == 9, "equations")
      call expect(error, all(problem%component == [3, 6, 9]), "delayed components")
      call expect_close(error, problem%lag, [10.0_wp, 10.0_wp, 10.0_wp], 0.0_wp, "delays")
      call expect_close(error, problem%history(-1.0_wp, 3), log(1.1_wp), 0.0_wp, "history")
      call expect_close(error, problem%history(-1.0_wp, 6), 0.0_wp, 0.0_wp, "history of a vector")
      do i = 1, 20
         y = uniform(i, 9, -1.0_wp, 1.0_wp)
         z = uniform(100 + i, 3, -1.0_wp, 1.0_wp)
         call problem%rhs(0.0_wp, y, z, dydt)
         call problem%jacobian(0.0_wp, y, z, by_y, by_z)
         do j = 1, 2
            associate (delta => y(3*j + 1:3*j + 3), slope => dydt(3*j + 1:3*j + 3))
               call block%rhs(0.0_wp, y(:3) + h*delta, z(:1) + h*z(j + 1), ahead)
               call block%rhs(0.0_wp, y(:3) - h*delta, z(:1) - h*z(j + 1), back)
               call expect_close(error, slope, (ahead - back)/(2.0_wp*h), 1.0e-7_wp, &
                                 "slope of vector "//text(j))
               call expect_close(error, matmul(by_y(3*j + 1:3*j + 3, :), y) &
                                 + matmul(by_z(3*j + 1:3*j + 3, :), z), slope, 1.0e-12_wp, &
                                 "derivatives of vector "//text(j))
            end associate
         end do
      end do
   end subroutine test_variational_equations

   !> The first start vector of y' = -y(t - 1) has cos(1) as state and all of its past: with the
   !> weight 0.1 of the state its norm is cos(1) sqrt(1.01). Its orthonormal successors stay so.
   subroutine test_norm(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: continuation, undisturbed
      type(tangent_problem_type) :: tangent
      real(wp) :: norm(4), share

      call start_after(2.3_wp, 4, tangent, undisturbed, continuation, error)
      if (allocated(error)) return
      call orthonormalise(tangent, 1.0_wp, .false., continuation, norm, share)
      call expect_close(error, norm(1), cos(1.0_wp)*sqrt(1.01_wp), 1.0e-14_wp, "first norm")
      call expect_between(error, share, 0.01_wp, 0.999_wp, "least share")
      call orthonormalise(tangent, 0.5_wp, .false., continuation, norm, share)
      call expect_close(error, norm, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], 1.0e-12_wp, "norms")
      call expect_close(error, share, 1.0_wp, 1.0e-12_wp, "share of orthonormal vectors")
      call orthonormalise(tangent, 1.0_wp, .false., continuation, norm, share)
      call expect_close(error, norm, [0.5_wp, 0.5_wp, 0.5_wp, 0.5_wp], 1.0e-12_wp, "smaller ones")
      call expect_close(error, continuation%y(1), undisturbed%y(1), 0.0_wp, "the state itself")
      call expect_close(error, pack(continuation%coefficients(:, 1, :), .true.), &
                        pack(undisturbed%coefficients, .true.), 0.0_wp, "its past")
   end subroutine test_norm

   !> Other vectors of the same solutions make no kink.
   subroutine test_smooth_restart(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(continuation_type) :: alone, continuation, undisturbed
      type(integration_result) :: outcome
      type(tangent_problem_type) :: tangent
      real(wp) :: norm(2), share

      call start_after(20.3_wp, 2, tangent, undisturbed, continuation, error)
      if (allocated(error)) return
      continuation%rate = [undisturbed%rate, 0.0_wp, 0.0_wp]
      call integrate(tangent, 20.3_wp, 40.3_wp, at_tolerance(1.0e-9_wp), outcome, failure, &
                     continuation=continuation)
      call expect_success(error, failure)
      call expect(error, outcome%breaking_points == 7, "the start makes a kink")
      call orthonormalise(tangent, 1.0_wp, .false., continuation, norm, share)
      alone = undisturbed_part(continuation, 1)
      call integrate(tangent, 40.3_wp, 50.3_wp, at_tolerance(1.0e-9_wp), outcome, failure, &
                     continuation=continuation)
      call expect_success(error, failure)
      call expect(error, outcome%breaking_points == 0, "orthonormalisation makes none")
      call integrate(tangent%base, 40.3_wp, 50.3_wp, at_tolerance(1.0e-9_wp), outcome, failure, &
                     continuation=alone)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, outcome%breaking_points == 0, "nor does going on without vectors")
      call expect_close(error, alone%y, continuation%y(:1), 1.0e-8_wp, "the same solution")
   end subroutine test_smooth_restart

   !> y' = -y(t - 1) with 1 as its past, run to a time and given its start vectors.
   subroutine start_after(time, vectors, tangent, undisturbed, continuation, error)
      !> End of the run
      real(wp), intent(in) :: time
      !> Number of vectors
      integer, intent(in) :: vectors
      !> The equation with its vectors
      type(tangent_problem_type), intent(out) :: tangent
      !> Where the run ended, without and with the vectors
      type(continuation_type), intent(out) :: undisturbed, continuation
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(linear) :: problem

      problem = linear(n=1, lag=[1.0_wp], component=[1], past=[1.0_wp], first=[1.0_wp])
      call integrate(problem, 0.0_wp, time, at_tolerance(1.0e-9_wp), outcome, failure, &
                     continuation=undisturbed)
      call expect_success(error, failure)
      if (allocated(error)) return
      tangent = tangent_problem_type(problem, vectors)
      call start_vectors(tangent, undisturbed, continuation)
   end subroutine start_after

   !> Constant growth is its own average, whatever the lengths of the intervals; a sine hardly
   !> counts; the order is descending, and the flow has its place in it.
   subroutine test_averages(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      real(wp) :: growth(2, 400), length(400), time(0:400)
      integer :: i

      length = uniform(3, 400, 0.3_wp, 0.7_wp)
      time = [(sum(length(:i)), i=0, 400)]
      growth(1, :) = -length
      growth(2, :) = 0.5_wp*length + sin(1.4_wp*time(1:)) - sin(1.4_wp*time(:399))
      exponents = average_growth(growth, length, 4, flow=.true.)
      call expect_close(error, exponents%value, [0.5_wp, 0.0_wp, -1.0_wp], 1.0e-4_wp, "values")
      call expect_close(error, exponents(3)%blocks, spread(-1.0_wp, 1, 4), 1.0e-12_wp, "blocks")
      call expect_close(error, exponents(2:3)%error, [0.0_wp, 0.0_wp], 1.0e-12_wp, "no error")
      call expect_between(error, exponents(1)%error, 1.0e-16_wp, 1.0e-3_wp, "error of the sine")
      exponents = average_growth(growth, length, 4, flow=.false.)
      call expect(error, size(exponents) == 2, "without the flow")
   end subroutine test_averages

   !> Even noise of variance 1/12 has a mean of variance 1/(12 n), 1.3 times that with smooth ends.
   !> Of 400 samples at least 98 per cent have their mean within three errors of the true one; so
   !> have a sine of ten periods and noise that is correlated over twenty values.
   subroutine test_errors(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      integer, parameter :: n = 400, samples = 400, memory = 20
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
      real(wp) :: errors(3, samples), growth(3, n), noise(n + memory), values(3, samples)
      integer :: i, k

      do k = 1, samples
         noise = uniform(k, n + memory, -0.5_wp, 0.5_wp)
         growth(1, :) = 20.0_wp + noise(:n)
         growth(2, :) = 10.0_wp + [(sin(turn*(10.0_wp*i/n + real(k, wp)/samples)), i=1, n)]
         growth(3, :) = [(sum(noise(i:i + memory)), i=1, n)]
         exponents = average_growth(growth, [(1.0_wp, i=1, n)], 4, flow=.false.)
         values(:, k) = exponents%value - [20.0_wp, 10.0_wp, 0.0_wp]
         errors(:, k) = exponents%error
      end do
      do i = 1, 3
         call expect_between(error, count(abs(values(i, :)) <= 3.0_wp*errors(i, :)) &
                             /real(samples, wp), 0.98_wp, 1.0_wp, "covered, "//text(i))
      end do
      call expect_between(error, norm2(values(1, :))/sqrt(samples/(12.0_wp*n)), 0.95_wp, 1.3_wp, &
                          "error of the mean of noise")
      call expect_between(error, norm2(errors(1, :))/norm2(values(1, :)), 1.0_wp, 1.4_wp, &
                          "estimated error over true error, noise")
      call expect_between(error, norm2(errors(3, :))/norm2(values(3, :)), 0.9_wp, 1.4_wp, &
                          "estimated error over true error, correlated noise")
   end subroutine test_errors

   !> Worked by hand; a zero exponent counts as 0 on either side; nothing where more are needed.
   subroutine test_dimension(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type) :: exponents(3)
      real(wp) :: dimension, spread
      integer :: i

      do i = 1, 3
         exponents(i)%blocks = [0.0_wp, 0.0_wp]
      end do
      call find([0.1_wp, 0.0_wp, -0.4_wp])
      call expect_close(error, dimension, 2.25_wp, 1.0e-15_wp, "chaos")
      call find([-1.0e-6_wp, -0.1_wp, -0.4_wp])
      call expect_close(error, dimension, 1.0_wp, 0.0_wp, "cycle")
      call find([-0.1_wp, -0.1_wp, -0.4_wp])
      call expect_close(error, dimension, 0.0_wp, 0.0_wp, "fixed point")
      call find([0.1_wp, 0.0_wp, -0.05_wp])
      call expect(error, ieee_is_nan(dimension), "unknown")
      exponents(1)%error = 0.04_wp
      call expect(error, without_sign(exponents(1), 1.0e-5_wp), "within three error bars")
      exponents(1)%error = 0.03_wp
      call expect(error, .not. without_sign(exponents(1), 1.0e-5_wp), "beyond them")

   contains

      !> Dimension for exponents the same in all blocks.
      subroutine find(values)
         real(wp), intent(in) :: values(3)
         integer :: j

         do j = 1, 3
            exponents(j)%value = values(j)
            exponents(j)%blocks = values(j)
         end do
         call dimension_of(exponents, 1.0e-5_wp, dimension, spread)
         if (ieee_is_nan(dimension)) return
         call expect_close(error, spread, 0.0_wp, 0.0_wp, "error of the dimension")
      end subroutine find
   end subroutine test_dimension

end module test_tangents
