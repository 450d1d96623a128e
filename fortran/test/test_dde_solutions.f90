!> The solver against exact solutions and published values (tables in the texts cited in
!> test_problems; piecewise polynomials by hand).
module test_dde_solutions
   use dde, only: dde_problem_type, integrate, integration_options, integration_result, table_sampler
   use errors, only: solver_error => error_type
   use kinds, only: wp
   use mctc_env_testing, only: check, error_type, new_unittest, test_failed, unittest_type
   use test_problems, only: enzyme, infection, linear, mackey_glass, wille_baker
   implicit none
   private
   public :: collect_dde_solutions

contains

   !> All tests of this suite.
   subroutine collect_dde_solutions(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest('linear', test_linear), &
                   new_unittest('linear with a jump', test_jump), &
                   new_unittest('two delays', test_two_delays), &
                   new_unittest('infection', test_infection), &
                   new_unittest('enzyme kinetics', test_enzyme), &
                   new_unittest('mackey-glass', test_mackey_glass), &
                   new_unittest('error follows tolerance', test_proportional)]
   end subroutine collect_dde_solutions

   !> All components at given times, from dense output.
   subroutine solve(problem, time, tolerance, values, error)
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: time(:)
      real(wp), intent(in) :: tolerance
      real(wp), allocatable, intent(out) :: values(:, :)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(solver_error), allocatable :: problem_error
      type(table_sampler) :: table
      integer :: i

      options%relative = tolerance
      options%absolute = tolerance
      table = table_sampler([(i, i=1, problem%n)], time)
      call integrate(problem, 0.0_wp, time(size(time)), options, outcome, problem_error, table)
      values = table%values
      if (allocated(problem_error)) call test_failed(error, problem_error%message)
   end subroutine solve

   !> Compare with known values.
   subroutine compare(error, values, expected, threshold)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: values(:)
      real(wp), intent(in) :: expected(:)
      real(wp), intent(in) :: threshold
      integer :: i

      do i = 1, size(expected)
         if (allocated(error)) return
         call check(error, values(i), expected(i), thr=threshold)
      end do
   end subroutine compare

   subroutine test_linear(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)

      call solve(unit_delay(past=1.0_wp), [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp], 1.0e-12_wp, y, error)
      call compare(error, y(1, :), [0.0_wp, -0.5_wp, 19.0_wp/120, 10493.0_wp/518400], 1.0e-13_wp)
   end subroutine test_linear

   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)

      call solve(unit_delay(past=0.0_wp), [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp], 1.0e-12_wp, y, error)
      call compare(error, y(1, :), [1.0_wp, 0.0_wp, 5.0_wp/24, 19223.0_wp/362880], 1.0e-13_wp)
   end subroutine test_jump

   subroutine test_two_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem
      real(wp), allocatable :: y(:, :)

      problem = wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], past=[1.0_wp, 1.0_wp, 1.0_wp], &
                            first=[1.0_wp, 1.0_wp, 1.0_wp])
      call solve(problem, [1.0_wp, 5.0_wp], 1.0e-12_wp, y, error)
      call compare(error, y(:, 1), [2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], 1.0e-12_wp)
      call compare(error, y(:, 2), [767.0_wp/40, 176.42257844738032_wp, 190.34420193607042_wp], &
                   1.0e-10_wp)
   end subroutine test_two_delays

   subroutine test_infection(error)
      type(error_type), allocatable, intent(out) :: error
      type(infection) :: problem
      real(wp), allocatable :: y(:, :)

      problem = infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], past=[5.0_wp, 0.1_wp, 1.0_wp], &
                          first=[5.0_wp, 0.1_wp, 1.0_wp])
      call solve(problem, [17.3_wp, 40.0_wp], 1.0e-12_wp, y, error)
      call compare(error, y(:, 2), [0.0912491205664_wp, 0.0202995003351_wp, 5.9884513791_wp], &
                   1.0e-10_wp)
      call compare(error, sum(y, dim=1), [6.1_wp, 6.1_wp], 1.0e-13_wp)
   end subroutine test_infection

   subroutine test_enzyme(error)
      type(error_type), allocatable, intent(out) :: error
      type(enzyme) :: problem
      real(wp), allocatable :: y(:, :)

      problem = enzyme(n=4, lag=[4.0_wp], component=[4], past=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp], &
                       first=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      call solve(problem, [160.0_wp], 1.0e-12_wp, y, error)
      call compare(error, y(:, 1), [33.92579471114_wp, 22.70653713103_wp, 18.83057673173_wp, &
                                    22.26599078770_wp], 1.0e-8_wp)
   end subroutine test_enzyme

   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error
      type(mackey_glass) :: problem
      real(wp), allocatable :: y(:, :)

      problem = mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], first=[1.2_wp])
      call solve(problem, [50.0_wp, 100.0_wp, 200.0_wp], 1.0e-13_wp, y, error)
      call compare(error, y(1, :), [1.060954362898_wp, 1.013724016524_wp, 1.186718107117_wp], &
                   1.0e-10_wp)
   end subroutine test_mackey_glass

   !> Enzyme kinetics: the error at t = 160 falls with the tolerance and stays below 100 of it.
   subroutine test_proportional(error)
      type(error_type), allocatable, intent(out) :: error
      type(enzyme) :: problem
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: tolerances(4) = [1.0e-4_wp, 1.0e-6_wp, 1.0e-8_wp, 1.0e-10_wp]
      real(wp), parameter :: published(4) = [33.92579471114_wp, 22.70653713103_wp, &
                                             18.83057673173_wp, 22.26599078770_wp]
      real(wp) :: distance
      integer :: i

      problem = enzyme(n=4, lag=[4.0_wp], component=[4], past=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp], &
                       first=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      do i = 1, size(tolerances)
         call solve(problem, [160.0_wp], tolerances(i), y, error)
         if (allocated(error)) return
         distance = maxval(abs(y(:, 1)/published - 1.0_wp))
         call check(error, distance < 100.0_wp*tolerances(i), more='relative error above 100 x tol')
         if (allocated(error)) return
      end do
   end subroutine test_proportional

   !> y' = -y(t-1) with y(0) = 1.
   pure function unit_delay(past) result(problem)
      real(wp), intent(in) :: past
      type(linear) :: problem

      problem = linear(n=1, lag=[1.0_wp], component=[1], past=[past], first=[1.0_wp])
   end function unit_delay
end module test_dde_solutions
