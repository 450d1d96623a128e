!> Lyapunov exponents against characteristic roots, published values, and what must be zero;
!> averages of growth and the dimension against values by hand.
module test_exponents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use block_builder, only: build_block
   use dde, only: dde_problem_type, integration_options
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close, expect_success
   use exponent_averages, only: average_growth, dimension_of, exponent_type, without_sign
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use pseudo_random, only: uniform
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
                   new_unittest("mackey-glass", test_mackey_glass), &
                   new_unittest("a cycle has one zero exponent", test_cycle), &
                   new_unittest("error control", test_error_control), &
                   new_unittest("stiff", test_stiff), &
                   new_unittest("averages", test_averages), &
                   new_unittest("errors of averages", test_errors), &
                   new_unittest("dimension", test_dimension)]
   end subroutine collect_exponents

   !> Derivatives of 0.2 z/(1 + z^10) - 0.1 y.
   pure subroutine mackey_glass_jacobian(self, t, y, z, by_y, by_z)
      class(smooth_mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: by_y(self%n, self%n), by_z(self%n, size(self%lag))

      by_y = -0.1_wp
      by_z = 0.2_wp*(1.0_wp - 9.0_wp*z(1)**10)/(1.0_wp + z(1)**10)**2
   end subroutine mackey_glass_jacobian

   !> Derivatives of (z1, z1 + z2, y2).
   pure subroutine wille_baker_jacobian(self, t, y, z, by_y, by_z)
      class(smooth_wille_baker), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: by_y(self%n, self%n), by_z(self%n, size(self%lag))

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

   !> Four exponents of the equation of Mackey and Glass at tau = 17: the well-resolved values of
   !> the literature, with bounds as wide as their spread.
   subroutine test_mackey_glass(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: known(4) = [0.00575_wp, 0.0_wp, -0.039_wp, -0.053_wp]
      real(wp), parameter :: spread(4) = [0.00175_wp, 5.0e-4_wp, 0.003_wp, 0.004_wp]
      type(exponent_type), allocatable :: exponents(:)
      type(smooth_mackey_glass) :: problem
      integer :: i

      problem%mackey_glass = mackey_glass(n=1, lag=[17.0_wp], component=[1], past=[1.2_wp], &
                                          first=[1.2_wp])
      call solve(problem, &
                 growth_settings_type(exponents=4, t_begin=1000.0_wp, t_end=25000.0_wp, &
                                      t_turning=700.0_wp, interval=20.0_wp, blocks=4), &
                 at_tolerance(1.0e-5_wp), exponents, error)
      if (allocated(error)) return
      do i = 1, size(known)
         call expect_close(error, exponents(i)%value, known(i), spread(i), "exponent "//text(i))
      end do
   end subroutine test_mackey_glass

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
end module test_exponents
