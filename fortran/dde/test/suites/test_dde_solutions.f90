!> All methods against exact solutions and published values (tables in the texts cited in
!> test_problems; piecewise polynomials by hand).
module test_dde_solutions
   use dde, only: dde_problem_type, methods
   use dde_errors, only: text
   use expectations, only: expect_between, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme, infection, mackey_glass
   use solving, only: at_tolerance, solve
   use test_problems, only: linear, sine, wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_solutions

contains

   !> All tests of this suite.
   subroutine collect_dde_solutions(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("linear, with and without a jump", test_linear), &
                   new_unittest("sine", test_sine), &
                   new_unittest("two delays", test_two_delays), &
                   new_unittest("infection", test_infection), &
                   new_unittest("enzyme kinetics", test_enzyme), &
                   new_unittest("mackey-glass", test_mackey_glass), &
                   new_unittest("error follows tolerance", test_proportional)]
   end subroutine collect_dde_solutions

   !> y' = -y(t - 1), y = 1 up to t = 0, or y = 0 before t = 0: piecewise polynomials.
   subroutine test_linear(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: times(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]

      call compare(error, linear(n=1, lag=[1.0_wp], component=[1], past=[1.0_wp], &
                                 first=[1.0_wp]), times, &
                   reshape([0.0_wp, -0.5_wp, 19.0_wp/120, 10493.0_wp/518400], [1, 4]), &
                   [1.0e-12_wp, 1.0e-9_wp])
      call compare(error, linear(n=1, lag=[1.0_wp], component=[1], past=[0.0_wp], &
                                 first=[1.0_wp]), times, &
                   reshape([1.0_wp, 0.0_wp, 5.0_wp/24, 19223.0_wp/362880], [1, 4]), &
                   [1.0e-12_wp, 1.0e-9_wp])
   end subroutine test_linear

   !> y' = -y(t - pi/2) with the history sin t goes on as sin t: a history that varies.
   subroutine test_sine(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp), parameter :: times(4) = [pi/6, 5*pi/6, 13*pi/6, 20.0_wp]

      call compare(error, sine(), times, reshape(sin(times), [1, 4]), [5.0e-12_wp, 1.0e-9_wp])
   end subroutine test_sine

   !> Wille and Baker's two delays, whose breaking points lie so close that some Taylor steps are of
   !> the size of rounding.
   subroutine test_two_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(wille_baker) :: problem

      problem = wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], &
                            past=[1.0_wp, 1.0_wp, 1.0_wp], first=[1.0_wp, 1.0_wp, 1.0_wp])
      call compare(error, problem, [1.0_wp], &
                   reshape([2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], [3, 1]), &
                   [1.0e-12_wp, 1.0e-6_wp])
      call compare(error, problem, [5.0_wp], &
                   reshape([767.0_wp/40, 176.42257844738032_wp, 190.34420193607042_wp], [3, 1]), &
                   [1.0e-10_wp, 1.0e-6_wp])
   end subroutine test_two_delays

   !> Two delays of one component, and an invariant.
   subroutine test_infection(error)
      type(error_type), allocatable, intent(out) :: error
      type(infection) :: problem
      real(wp), allocatable :: y(:, :)

      problem = infection(n=3, lag=[1.0_wp, 10.0_wp], component=[2, 2], &
                          past=[5.0_wp, 0.1_wp, 1.0_wp], first=[5.0_wp, 0.1_wp, 1.0_wp])
      call compare(error, problem, [40.0_wp], &
                   reshape([0.0912491205664_wp, 0.0202995003351_wp, 5.9884513791_wp], [3, 1]), &
                   [1.0e-10_wp, 2.0e-8_wp])
      call solve(problem, [17.3_wp, 40.0_wp], at_tolerance(1.0e-12_wp), y, error)
      call expect_close(error, sum(y, dim=1), [6.1_wp, 6.1_wp], 1.0e-13_wp, "sum of all")
   end subroutine test_infection

   !> Enzyme kinetics.
   subroutine test_enzyme(error)
      type(error_type), allocatable, intent(out) :: error

      call compare(error, kinetics(), [160.0_wp], reshape(published_kinetics(), [4, 1]), &
                   [1.0e-8_wp, 1.0e-6_wp])
   end subroutine test_enzyme

   !> The chaotic equation of Mackey and Glass, before chaos shows.
   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error

      call compare(error, mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], &
                                       first=[1.2_wp]), [50.0_wp, 100.0_wp, 200.0_wp], &
                   reshape([1.060954362898_wp, 1.013724016524_wp, 1.186718107117_wp], [1, 3]), &
                   [1.0e-10_wp, 2.0e-7_wp])
   end subroutine test_mackey_glass

   !> Solutions by all methods: by explicit ones at tolerance 1e-13, by implicit ones at 1e-11.
   subroutine compare(error, problem, times, known, within)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Times
      real(wp), intent(in) :: times(:)
      !> Solution, shape (n, times)
      real(wp), intent(in) :: known(:, :)
      !> Largest error of explicit methods and of `auto`, and of implicit ones
      real(wp), intent(in) :: within(2)
      real(wp), allocatable :: y(:, :)
      integer :: class, i, k

      do i = 1, size(methods)
         if (methods(i) == "taylor" .and. .not. problem%analytic) cycle
         class = merge(2, 1, index(methods(i), "radau") == 1)
         call solve(problem, times, at_tolerance(merge(1.0e-11_wp, 1.0e-13_wp, class == 2), &
                                                 methods(i)), y, error)
         if (allocated(error)) return
         do k = 1, size(times)
            call expect_close(error, y(:, k), known(:, k), within(class), &
                              trim(methods(i))//" at t = "//text(times(k)))
         end do
      end do
   end subroutine compare

   !> Enzyme kinetics: the relative error at t = 160 stays below 100 times the tolerance.
   subroutine test_proportional(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:, :)
      real(wp), parameter :: tolerances(4) = [1.0e-4_wp, 1.0e-6_wp, 1.0e-8_wp, 1.0e-10_wp]
      integer :: i

      do i = 1, size(tolerances)
         call solve(kinetics(), [160.0_wp], at_tolerance(tolerances(i)), y, error)
         call expect_between(error, maxval(abs(y(:, 1)/published_kinetics() - 1.0_wp)), 0.0_wp, &
                             100.0_wp*tolerances(i), "relative error")
      end do
   end subroutine test_proportional

   !> Enzyme kinetics from its published start.
   pure type(enzyme) function kinetics() result(problem)
      problem = enzyme(n=4, lag=[4.0_wp], component=[4], &
                       past=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp], &
                       first=[60.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
   end function kinetics

   !> Its published state at t = 160.
   pure function published_kinetics() result(y)
      real(wp) :: y(4)

      y = [33.92579471114_wp, 22.70653713103_wp, 18.83057673173_wp, 22.26599078770_wp]
   end function published_kinetics
end module test_dde_solutions
