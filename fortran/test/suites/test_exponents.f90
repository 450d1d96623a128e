! SPDX-License-Identifier: BSD-3-Clause
!> Lyapunov exponents: at rest they are the real parts of characteristic roots, on tori known zeros;
!> averages of growth and the dimension against values by hand. Published values:
!> python/gallery/mackey_glass.py.
module test_exponents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use block_builder, only: build_block, made
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use exponent_averages, only: average_growth, dimension_of, exponent_type, sign_of, unclear, &
                                without_sign, zero
   use exponent_runs, only: solve => find_exponents
   use expectations, only: expect, expect_between, expect_close, expect_success
   use lyapunov_spectrum, only: growth_settings_type, growth_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use model_roots, only: find_rightmost
   use motion_classes, only: class_by_exponents, three_torus
   use pseudo_random, only: uniform
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_exponents

   real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

   subroutine collect_exponents(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("roots at rest with one to three delays", test_delays), &
                   new_unittest("roots of blocks at rest", test_rest), &
                   new_unittest("exponents of oscillators", test_oscillators), &
                   new_unittest("averages", test_averages), &
                   new_unittest("errors of averages", test_errors), &
                   new_unittest("dimension", test_dimension)]
   end subroutine collect_exponents

   !> x' = -x(t - 1), of which the first root is known, by two methods; with two delays; two neurons
   !> with three.
   subroutine test_delays(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      type(model_type) :: decay

      decay = made("made_decay", [0.0_wp, 0.0_wp, 1.0_wp], [1.0e-9_wp])
      call check(decay, "explicit", 6, 0.04_wp, 1.0e-6_wp)
      call check(decay, "radau9", 6, 0.04_wp, 1.0e-6_wp)
      if (allocated(error)) return
      call expect_close(error, exponents(1)%value, -0.3181315052047642_wp, 1.0e-6_wp, "first")
      ! the error bars also hold what uneven intervals add to their estimate
      call expect_between(error, maxval(exponents%error), 0.0_wp, 1.0e-4_wp, "error bars")
      call check(made("made_decay", [0.3_wp, -0.7_wp, 1.0_wp], [1.0e-9_wp]), "dop853", 4, 0.1_wp, &
                 1.0e-5_wp)
      call check(made("made_neuron", [0.5_wp, -0.3_wp, 0.6_wp, 0.5_wp, 0.2_wp, 0.7_wp, 1.1_wp], &
                      [1.0e-9_wp, 2.0e-9_wp]), "dop853", 4, 0.1_wp, 1.0e-5_wp)

   contains

      !> The exponents at rest by a method, roots pair by pair.
      subroutine check(model, method, many, interval, within)
         type(model_type), intent(in) :: model
         character(len=*), intent(in) :: method
         integer, intent(in) :: many
         real(wp), intent(in) :: interval, within
         type(failure_type), allocatable :: failure
         type(growth_type) :: measured
         complex(wp), allocatable :: roots(:)

         call solve(model, growth_settings_type(exponents=many, t_begin=50.0_wp, t_end=350.0_wp, &
                                                t_turning=49.0_wp, interval=interval, batches=3), &
                    at_tolerance(1.0e-10_wp, method), exponents, error, measured)
         call find_rightmost(model, many, roots, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         call expect_close(error, exponents%value, real(roots), within, "exponents by "//method)
      end subroutine check
   end subroutine test_delays

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
                                            t_turning=380.0_wp, interval=1.0_wp, batches=2), &
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

   !> Three uncoupled oscillators: a zero exponent each, the next one is the root of s + 2 + k =
   !> k exp(-s) that a disturbance of |z| has. No combination of the frequencies is 0. With vectors
   !> across the flow that of the flow is exactly zero.
   subroutine test_oscillators(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      real(wp), parameter :: k = 0.3_wp, f(3) = 0.113_wp*sqrt([1.0_wp, 1.0_wp/3, 0.85_wp])
      type(growth_type) :: measured
      integer :: across, i
      real(wp) :: s

      s = -1.0_wp
      do i = 1, 50
         s = s - (s + 2.0_wp + k*(1.0_wp - exp(-s)))/(1.0_wp + k*exp(-s))
      end do
      do across = 0, 1
         call solve(made("made_oscillators", [k, turn*f], [(1.0_wp, 0.0_wp, i=1, 3)]), &
                    growth_settings_type(exponents=4, t_begin=50.0_wp, t_end=450.0_wp, &
                                         t_turning=40.0_wp, interval=2.0_wp, &
                                         across_flow=across == 1), &
                    at_tolerance(1.0e-8_wp, "auto"), exponents, error, measured)
         if (allocated(error)) return
         call expect_close(error, exponents%value, [0.0_wp, 0.0_wp, 0.0_wp, s], 1.0e-6_wp, &
                           "exponents")
         call expect(error, count(.not. abs(exponents%value) > 0.0_wp) == across, "exact zeros")
         call expect(error, class_by_exponents(exponents, 3.0e-5_wp, 1.0e-3_wp) == three_torus, &
                     "the class")
      end do
   end subroutine test_oscillators

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
      call expect_close(error, exponents(3)%batches, spread(-1.0_wp, 1, 4), 1.0e-12_wp, "batches")
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
   !> With one exponent that varies the error is that of its mean.
   subroutine test_dimension(error)
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type) :: exponents(3)
      real(wp), parameter :: varied(3) = 0.1_wp + [-0.03_wp, 0.01_wp, 0.02_wp]
      real(wp) :: dimension, spread
      integer :: i

      call find([0.1_wp, 0.0_wp, -0.4_wp])
      call expect_close(error, [dimension, spread], [2.25_wp, 0.0_wp], 1.0e-15_wp, "chaos")
      exponents(1)%batches = varied
      call dimension_of(exponents, 1.0e-5_wp, dimension, spread)
      call expect_close(error, spread, norm2(varied - 0.1_wp)/sqrt(3*2.0_wp)/0.4_wp, 1.0e-15_wp, &
                        "error of the dimension")
      call find([-1.0e-6_wp, -0.1_wp, -0.4_wp])
      call expect_close(error, [dimension, spread], [1.0_wp, 0.0_wp], 0.0_wp, "cycle")
      call find([-0.1_wp, -0.1_wp, -0.4_wp])
      call expect_close(error, [dimension, spread], [0.0_wp, 0.0_wp], 0.0_wp, "fixed point")
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

      !> Dimension for exponents the same in all batches.
      subroutine find(values)
         real(wp), intent(in) :: values(3)

         exponents%value = values
         do i = 1, 3
            exponents(i)%batches = [values(i), values(i), values(i)]
         end do
         call dimension_of(exponents, 1.0e-5_wp, dimension, spread)
      end subroutine find
   end subroutine test_dimension
end module test_exponents
