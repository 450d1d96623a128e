!> Lyapunov exponents against characteristic roots, published values, and what must be zero.
module test_exponents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use block_builder, only: build_block
   use dde, only: dde_problem_type, integration_options
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use exponent_averages, only: average_growth, dimension_of, exponent_type, without_sign
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: mackey_glass
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   use test_problems, only: linear, wille_baker
   implicit none (type, external)
   private
   public :: collect_exponents

   !> With derivatives of its own.
   type, extends(mackey_glass) :: smooth_mackey_glass
   contains
      procedure :: jacobian => mackey_glass_jacobian
   end type smooth_mackey_glass

   !> With derivatives of its own.
   type, extends(wille_baker) :: smooth_wille_baker
   contains
      procedure :: jacobian => wille_baker_jacobian
   end type smooth_wille_baker

contains

   !> All tests of this suite.
   subroutine collect_exponents(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("roots of a linear equation", test_linear), &
                   new_unittest("roots with two delays", test_two_delays), &
                   new_unittest("roots without delay", test_without_delay), &
                   new_unittest("mackey-glass, tau = 17", test_mackey_glass_17), &
                   new_unittest("mackey-glass, tau = 23", test_mackey_glass_23), &
                   new_unittest("a cycle has one zero exponent", test_cycle), &
                   new_unittest("error control", test_error_control), &
                   new_unittest("stiff", test_stiff)]
   end subroutine collect_exponents

   !> Derivatives of 0.2 z/(1 + z^10) - 0.1 y.
   pure subroutine mackey_glass_jacobian(self, t, y, z, by_y, by_z)
      class(smooth_mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: by_y(self%n, self%n)
      real(wp), intent(out) :: by_z(self%n, size(self%lag))

      by_y = -0.1_wp
      by_z = 0.2_wp*(1.0_wp - 9.0_wp*z(1)**10)/(1.0_wp + z(1)**10)**2
   end subroutine mackey_glass_jacobian

   !> Derivatives of (z1, z1 + z2, y2).
   pure subroutine wille_baker_jacobian(self, t, y, z, by_y, by_z)
      class(smooth_wille_baker), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: by_y(self%n, self%n)
      real(wp), intent(out) :: by_z(self%n, size(self%lag))

      by_y = 0.0_wp
      by_y(3, 2) = 1.0_wp
      by_z = 0.0_wp
      by_z(:2, 1) = 1.0_wp
      by_z(2, 2) = 1.0_wp
   end subroutine wille_baker_jacobian

   !> Exponents of a problem.
   subroutine solve(problem, settings, options, exponents, error)
      class(dde_problem_type), intent(in) :: problem
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      type(exponent_type), allocatable, intent(out) :: exponents(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(growth_type) :: measured

      call measure_growth(problem, settings, options, measured, failure)
      call expect_success(error, failure)
      allocate (exponents(0))
      if (allocated(error)) return
      exponents = average_growth(measured%growth, measured%length, settings%blocks, flow=.false.)
      call expect(error, size(exponents) == settings%exponents, "as many exponents as asked for")
   end subroutine solve

   !> y' = -y(t - 1): the roots of s + exp(-s) = 0, pair by pair.
   subroutine test_linear(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      complex(wp) :: s
      integer :: i, method
      character(len=8), parameter :: names(2) = ["explicit", "radau9  "]

      do method = 1, size(names)
         call solve(linear(n=1, lag=[1.0_wp], component=[1], past=[1.0_wp], first=[1.0_wp]), &
                    growth_settings_type(exponents=6, t_begin=50.0_wp, t_end=350.0_wp, &
                                         t_turning=49.0_wp, interval=0.04_wp, blocks=3), &
                    at_tolerance(1.0e-10_wp, names(method)), exponents, error)
         if (allocated(error)) return
         do i = 0, 2
            s = root(cmplx(-0.3_wp - i, 1.3_wp + 6.2_wp*i, wp))
            if (i == 0) call expect_close(error, s%re, -0.3181315052047642_wp, 1.0e-14_wp, "root")
            call expect_close(error, exponents(2*i + 1:2*i + 2)%value, [s%re, s%re], 1.0e-6_wp, &
                              "exponents of pair "//text(i)//", "//names(method))
            ! the error bars also hold what uneven intervals add to their estimate
            call expect_between(error, maxval(exponents(2*i + 1:2*i + 2)%error), 0.0_wp, &
                                1.0e-4_wp, "error bars")
         end do
      end do

   contains

      !> Newton's iteration on s + exp(-s) = 0.
      pure complex(wp) function root(start) result(s)
         complex(wp), intent(in) :: start
         integer :: iteration

         s = start
         do iteration = 1, 50
            s = s - (s + exp(-s))/(1.0_wp - exp(-s))
         end do
      end function root
   end subroutine test_linear

   !> Wille and Baker's problem: the real roots of s = exp(-lag s) for its delays 0.2 and 1, and 0.
   subroutine test_two_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      type(smooth_wille_baker) :: problem
      real(wp) :: roots(3)
      integer :: iteration

      roots = 0.0_wp
      do iteration = 1, 50
         associate (s => roots(:2), lag => [0.2_wp, 1.0_wp])
            s = s - (s - exp(-lag*s))/(1.0_wp + lag*exp(-lag*s))
         end associate
      end do
      problem%wille_baker = wille_baker(n=3, lag=[1.0_wp, 0.2_wp], component=[1, 2], &
                                        past=[1.0_wp, 1.0_wp, 1.0_wp], &
                                        first=[1.0_wp, 1.0_wp, 1.0_wp])
      call solve(problem, &
                 growth_settings_type(exponents=3, t_begin=80.0_wp, t_end=100.0_wp, &
                                      t_turning=70.0_wp, interval=0.5_wp, blocks=2), &
                 at_tolerance(1.0e-9_wp), exponents, error)
      if (allocated(error)) return
      call expect_close(error, exponents%value, roots, 1.0e-6_wp, "exponents")
   end subroutine test_two_delays

   !> The fixed point of the block without delay: one real root of the cubic, and a pair.
   subroutine test_without_delay(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      real(wp) :: s
      integer :: iteration

      call solve(build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp), &
                 growth_settings_type(exponents=3, t_begin=200.0_wp, t_end=500.0_wp, &
                                      t_turning=100.0_wp, interval=0.5_wp, blocks=2), &
                 at_tolerance(1.0e-9_wp), exponents, error)
      if (allocated(error)) return
      s = -2.0_wp
      do iteration = 1, 50
         s = s - (((s + 1.8_wp)*s + 0.4_wp)*s + 0.64_wp)/((3.0_wp*s + 3.6_wp)*s + 0.4_wp)
      end do
      call expect_close(error, exponents(3)%value, s, 1.0e-6_wp, "the real root")
      call expect_close(error, exponents(:2)%value, -0.5_wp*[1.8_wp + s, 1.8_wp + s], 1.0e-6_wp, &
                        "the pair")
   end subroutine test_without_delay

   !> The well-resolved values of the literature, with bounds as wide as their spread.
   subroutine test_mackey_glass_17(error)
      type(error_type), allocatable, intent(out) :: error

      call compare_mackey_glass(17.0_wp, [0.00575_wp, 0.0_wp, -0.039_wp, -0.053_wp], &
                                [0.00175_wp, 5.0e-4_wp, 0.003_wp, 0.004_wp], error)
   end subroutine test_mackey_glass_17

   !> The same for the longer delay.
   subroutine test_mackey_glass_23(error)
      type(error_type), allocatable, intent(out) :: error

      call compare_mackey_glass(23.0_wp, [0.0096_wp, 0.0_wp, -0.012_wp, -0.034_wp], &
                                [0.002_wp, 5.0e-4_wp, 0.003_wp, 0.003_wp], error)
   end subroutine test_mackey_glass_23

   !> Four exponents of the equation of Mackey and Glass.
   subroutine compare_mackey_glass(tau, expected, spread, error)
      !> Delay
      real(wp), intent(in) :: tau
      !> Exponents, and how far from them they may be
      real(wp), intent(in) :: expected(4), spread(4)
      type(error_type), allocatable, intent(inout) :: error
      type(exponent_type), allocatable :: exponents(:)
      type(smooth_mackey_glass) :: problem
      integer :: i

      problem%mackey_glass = mackey_glass(n=1, lag=[tau], component=[1], past=[1.2_wp], &
                                          first=[1.2_wp])
      call solve(problem, &
                 growth_settings_type(exponents=4, t_begin=1000.0_wp, t_end=25000.0_wp, &
                                      t_turning=700.0_wp, interval=20.0_wp, blocks=4), &
                 at_tolerance(1.0e-5_wp), exponents, error)
      if (allocated(error)) return
      do i = 1, 4
         call expect_close(error, exponents(i)%value, expected(i), spread(i), &
                           "exponent "//text(i))
      end do
   end subroutine compare_mackey_glass

   !> The limit cycle of the paper's oscillation, and so a dimension of 1.
   subroutine test_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      real(wp) :: dimension, dimension_error

      call solve(oscillation(), cycle_settings(), at_tolerance(1.0e-7_wp), exponents, error)
      if (allocated(error)) return
      call expect_close(error, exponents(1)%value, 0.0_wp, 1.0e-4_wp, "first exponent")
      call expect(error, count(without_sign(exponents, 1.0e-4_wp)) == 1, "one zero exponent")
      call expect_close(error, exponents(2)%value, -0.00295_wp, 2.0e-4_wp, "second exponent")
      call dimension_of(exponents, 1.0e-4_wp, dimension, dimension_error)
      call expect_close(error, dimension, 1.0_wp, 0.0_wp, "dimension")
   end subroutine test_cycle

   !> Exponents are the same whether the vectors claim their part of the tolerance or, made a
   !> hundred times smaller, less; and at another tolerance.
   subroutine test_error_control(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:), others(:)
      type(growth_settings_type) :: settings

      settings = cycle_settings()
      settings%t_begin = 300.0_wp
      settings%t_end = 500.0_wp
      call solve(oscillation(), settings, at_tolerance(1.0e-8_wp), exponents, error)
      settings%vector_size = 1.0e-4_wp
      call solve(oscillation(), settings, at_tolerance(1.0e-8_wp), others, error)
      if (allocated(error)) return
      call expect_close(error, others%value, exponents%value, 1.0e-6_wp, "without the vectors")
      call solve(oscillation(), settings, at_tolerance(1.0e-6_wp), others, error)
      if (allocated(error)) return
      call expect_close(error, others%value, exponents%value, 1.0e-5_wp, "at another tolerance")
   end subroutine test_error_control

   !> The block of figure 4b; its history lies near the cycle.
   type(spring_block_type) function oscillation() result(block)
      block = build_block(tau=10.0_wp, epsilon=0.35_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
   end function oscillation

   !> Its exponents.
   type(growth_settings_type) function cycle_settings() result(settings)
      settings = growth_settings_type(exponents=3, t_begin=7000.0_wp, t_end=9000.0_wp, &
                                      t_turning=2000.0_wp, interval=5.0_wp, blocks=2)
   end function cycle_settings

   !> A frequency that the paper left out: implicit steps, the same exponents by two methods.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:), others(:)
      type(growth_settings_type), parameter :: settings = &
         growth_settings_type(exponents=4, t_begin=20.0_wp, t_end=60.0_wp, t_turning=15.0_wp, &
                              interval=1.0_wp, blocks=2)
      type(spring_block_type) :: block

      block = build_block(tau=1.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp)
      call solve(block, settings, at_tolerance(1.0e-7_wp, "auto"), exponents, error)
      call solve(block, settings, at_tolerance(1.0e-8_wp, "radau5"), others, error)
      if (allocated(error)) return
      call expect(error, all(ieee_is_finite(exponents%value)), "finite exponents")
      call expect_close(error, sum(others(:2)%value), sum(exponents(:2)%value), 1.0e-5_wp, &
                        "first pair by another method")
      call expect_close(error, sum(others(3:)%value), sum(exponents(3:)%value), 1.0e-3_wp, &
                        "second pair by another method")
   end subroutine test_stiff
end module test_exponents
