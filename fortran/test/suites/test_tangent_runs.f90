! SPDX-License-Identifier: BSD-3-Clause
!> Tangent vectors: their equations, norm and restart; runs by Taylor series beside other methods.
module test_tangent_runs
   use block_builder, only: build_block
   use dde, only: continuation_type, integration_result
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   use solving, only: at_tolerance, run
   use tangent_problem, only: tangent_problem_type
   use tangent_vectors, only: orthonormalise, start_vectors, undisturbed_part
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_tangent_runs

contains

   subroutine collect_tangent_runs(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("variational equations", test_variational_equations), &
                   new_unittest("norm", test_norm), &
                   new_unittest("smooth restart", test_smooth_restart), &
                   new_unittest("other methods on a cycle", test_cycle), &
                   new_unittest("other methods at gamma = 1e6", test_stiff)]
   end subroutine collect_tangent_runs

   !> Tangent vectors follow small differences of solutions; their derivatives are the blocks.
   subroutine test_variational_equations(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: block
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
      type(continuation_type) :: alone, continuation, undisturbed
      type(integration_result) :: outcome
      type(tangent_problem_type) :: tangent
      real(wp) :: norm(2), share

      call start_after(20.3_wp, 2, tangent, undisturbed, continuation, error)
      if (allocated(error)) return
      continuation%rate = [undisturbed%rate, 0.0_wp, 0.0_wp]
      call run(error, tangent, 20.3_wp, 40.3_wp, at_tolerance(1.0e-9_wp), outcome, &
               continuation=continuation)
      call expect(error, outcome%breaking_points == 7, "the start makes a kink")
      call orthonormalise(tangent, 1.0_wp, .false., continuation, norm, share)
      alone = undisturbed_part(continuation, 1)
      call run(error, tangent, 40.3_wp, 50.3_wp, at_tolerance(1.0e-9_wp), outcome, &
               continuation=continuation)
      call expect(error, outcome%breaking_points == 0, "orthonormalisation makes none")
      call run(error, tangent%base, 40.3_wp, 50.3_wp, at_tolerance(1.0e-9_wp), outcome, &
               continuation=alone)
      if (allocated(error)) return
      call expect(error, outcome%breaking_points == 0, "nor does going on without vectors")
      call expect_close(error, alone%y, continuation%y(:1), 1.0e-8_wp, "the same solution")
   end subroutine test_smooth_restart

   !> y' = -y(t - 1) with 1 as its past, run to a time and given its start vectors.
   subroutine start_after(time, vectors, tangent, undisturbed, continuation, error)
      real(wp), intent(in) :: time
      integer, intent(in) :: vectors
      type(tangent_problem_type), intent(out) :: tangent
      type(continuation_type), intent(out) :: undisturbed, continuation
      type(error_type), allocatable, intent(inout) :: error
      type(integration_result) :: outcome
      type(linear) :: problem

      problem = linear()
      call run(error, problem, 0.0_wp, time, at_tolerance(1.0e-9_wp), outcome, &
               continuation=undisturbed)
      if (allocated(error)) return
      tangent = tangent_problem_type(problem, vectors)
      call start_vectors(tangent, undisturbed, continuation)
   end subroutine start_after

   !> Five vectors over five delays on the paper's cycle of figure 5a.
   subroutine test_cycle(error)
      type(error_type), allocatable, intent(out) :: error

      call compare(build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.5_wp), &
                   5, 50.0_wp, ["taylor  ", "explicit", "radau13 "], error)
   end subroutine test_cycle

   !> `auto` follows the slow series, the implicit method the equations.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error

      call compare(build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e6_wp, v=1.5_wp), &
                   3, 20.0_wp, ["auto    ", "radau13 "], error)
   end subroutine test_stiff

   !> State and vectors by several methods. All but the first take as the start of the vectors what
   !> the first takes.
   subroutine compare(problem, vectors, length, methods, error)
      type(model_type), intent(in) :: problem
      integer, intent(in) :: vectors
      real(wp), intent(in) :: length
      character(len=8), intent(in) :: methods(:)
      type(error_type), allocatable, intent(inout) :: error
      type(continuation_type) :: continuation, start, undisturbed
      type(integration_result) :: outcome
      type(tangent_problem_type) :: tangent
      real(wp), allocatable :: known(:)
      integer :: i

      tangent = tangent_problem_type(problem, vectors)
      call run(error, problem, 0.0_wp, 20.0_wp, at_tolerance(1.0e-11_wp, methods(1)), &
               outcome, continuation=undisturbed)
      if (allocated(error)) return
      call start_vectors(tangent, undisturbed, start)
      start%rate = [undisturbed%rate, (0.0_wp, i=1, tangent%n - problem%n)]
      do i = 1, size(methods)
         continuation = start
         call run(error, tangent, 20.0_wp, 20.0_wp + length, &
                  at_tolerance(1.0e-11_wp, methods(i)), outcome, continuation=continuation)
         if (allocated(error)) return
         if (i == 1) then
            call expect(error, outcome%implicit_steps == 0, trim(methods(i))//" stays with series")
            known = outcome%y
         end if
         call expect_close(error, outcome%y, known, 1.0e-8_wp*maxval(abs(known)), trim(methods(i)))
      end do
   end subroutine compare
end module test_tangent_runs
