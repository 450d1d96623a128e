! SPDX-License-Identifier: BSD-3-Clause
!> Lyapunov exponents against characteristic roots; averages of growth and the dimension against
!> values by hand. Published values: python/gallery/mackey_glass.py.
module test_exponents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use block_builder, only: build_block
   use dde_errors, only: failure_type => error_type, text
   use exponent_runs, only: solve => find_exponents
   use expectations, only: expect, expect_between, expect_close, expect_success
   use exponent_averages, only: average_growth, dimension_of, exponent_type, sign_of, unclear, &
                                without_sign, zero
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: growth_settings_type, growth_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use model_roots, only: find_rightmost
   use pseudo_random, only: uniform
   use solving, only: at_tolerance
   use test_problems, only: linear, wille_baker
   implicit none (type, external)
   private
   public :: collect_exponents

   !> With derivatives of its own.
   type, extends(wille_baker) :: smooth_wille_baker
   contains
      procedure :: jacobian => wille_baker_jacobian
   end type smooth_wille_baker

contains

   subroutine collect_exponents(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("roots of a linear equation", test_linear), &
                   new_unittest("roots with two delays", test_two_delays), &
                   new_unittest("roots at rest", test_rest), &
                   new_unittest("exponents across the flow", test_across), &
                   new_unittest("averages", test_averages), &
                   new_unittest("errors of averages", test_errors), &
                   new_unittest("dimension", test_dimension)]
   end subroutine collect_exponents

   !> Derivatives of (z1, z1 + z2, y2).
   pure subroutine wille_baker_jacobian(self, t, y, z, by_y, by_z)
      class(smooth_wille_baker), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      by_y = 0.0_wp
      by_y(3, 2) = 1.0_wp
      by_z = 0.0_wp
      by_z(:2, 1) = 1.0_wp
      by_z(2, 2) = 1.0_wp
   end subroutine wille_baker_jacobian

   !> y' = -y(t - 1): the roots of s + exp(-s) = 0, pair by pair.
   subroutine test_linear(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      complex(wp) :: s
      integer :: i, method
      character(len=8), parameter :: names(2) = ["explicit", "radau9  "]

      do method = 1, size(names)
         call solve(linear(), &
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
      problem%wille_baker = wille_baker()
      call solve(problem, &
                 growth_settings_type(exponents=3, t_begin=80.0_wp, t_end=100.0_wp, &
                                      t_turning=70.0_wp, interval=0.5_wp, blocks=2), &
                 at_tolerance(1.0e-9_wp), exponents, error)
      if (allocated(error)) return
      call expect_close(error, exponents%value, roots, 1.0e-6_wp, "exponents")
   end subroutine test_two_delays

   !> Where steady sliding attracts, exponents are the real parts of characteristic roots, at gamma
   !> = 0.8 as at 1e6 to 1e12, and a unit of time costs hardly more steps. The vectors begin before
   !> the block is at rest, where a trial of the implicit method may be under way.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(exponent_type), allocatable :: exponents(:)
      type(growth_type) :: measured
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: gamma(4) = [0.8_wp, 1.0e6_wp, 1.0e9_wp, 1.0e12_wp]
      real(wp), parameter :: tau(3) = [1.0_wp, 3.0_wp, 7.0_wp]
      real(wp), parameter :: epsilon(size(tau)) = [0.3_wp, 0.3_wp, 0.1_wp]
      !> At the longest delay other roots lie close to the second pair.
      real(wp), parameter :: within(2) = [1.0e-6_wp, 5.0e-3_wp]
      real(wp) :: steps(size(gamma))
      type(model_type) :: block
      integer :: i, j, k

      do j = 1, size(tau)
         do i = 1, size(gamma)
            block = build_block(tau=tau(j), epsilon=epsilon(j), xi=0.5_wp, gamma=gamma(i), &
                                v=1.01_wp)
            call solve(block, &
                       growth_settings_type(exponents=4, t_begin=400.0_wp, t_end=700.0_wp, &
                                            t_turning=380.0_wp, interval=1.0_wp, blocks=2), &
                       at_tolerance(1.0e-9_wp, "auto"), exponents, error, measured)
            if (allocated(error)) return
            call find_rightmost(block, 4, roots, failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            do k = 1, size(within)
               call expect_close(error, sum(exponents(2*k - 1:2*k)%value), &
                                 sum(roots(2*k - 1:2*k)%re), within(k), "pair "//text(k) &
                                 //", tau = "//text(tau(j))//", gamma = "//text(gamma(i)))
            end do
            call expect(error, measured%implicit_steps == 0, "series are enough: " &
                        //text(measured%implicit_steps)//" implicit steps, tau = " &
                        //text(tau(j))//", gamma = "//text(gamma(i)))
            steps(i) = measured%steps/measured%time
         end do
         call expect_between(error, maxval(steps(2:))/steps(1), 0.0_wp, 2.0_wp, &
                             "steps over those at 0.8, tau = "//text(tau(j)))
      end do
   end subroutine test_rest

   !> The paper's cycle of figure 5a, and the torus at a longer delay.
   subroutine test_across(error)
      type(error_type), allocatable, intent(out) :: error

      call compare_across(10.0_wp, 10000.0_wp, 1, error)
      call compare_across(12.5_wp, 15000.0_wp, 2, error)
   end subroutine test_across

   !> Exponents with vectors across the flow, and with one more vector and none across.
   subroutine compare_across(tau, transient, zeros, error)
      real(wp), intent(in) :: tau, transient
      integer, intent(in) :: zeros
      type(error_type), allocatable, intent(inout) :: error
      type(exponent_type), allocatable :: across(:), all_directions(:)
      type(growth_settings_type) :: settings
      type(model_type) :: problem
      integer :: i

      problem = build_block(tau=tau, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
      settings = growth_settings_type(exponents=3, t_begin=transient, &
                                      t_end=transient + 8000.0_wp, t_turning=8000.0_wp, &
                                      interval=5.0_wp, blocks=2)
      call solve(problem, settings, at_tolerance(1.0e-8_wp, "taylor"), all_directions, error)
      settings%across_flow = .true.
      call solve(problem, settings, at_tolerance(1.0e-8_wp, "taylor"), across, error)
      if (allocated(error)) return
      call expect_close(error, across%value, all_directions%value, 2.0e-5_wp, "exponents")
      call expect(error, count(.not. abs(across%value) > 0.0_wp) == 1, "the flow's is exactly zero")
      call expect_close(error, across(:zeros)%value, [(0.0_wp, i=1, zeros)], 2.0e-5_wp, "zeros")
      call expect_between(error, -across(zeros + 1)%value, 5.0e-4_wp, 1.0_wp, "the next one")
   end subroutine compare_across

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
      exponents%value = [1.0e-6_wp, 1.0e-6_wp, -2.0e-5_wp]
      exponents%error = [1.0e-4_wp, 1.0e-3_wp, 1.0e-5_wp]
      call expect(error, all(sign_of(exponents, 1.0e-5_wp, 1.0e-3_wp) &
                              == [zero, unclear, unclear]), &
                  "zero within the level and a short bar alone")

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
