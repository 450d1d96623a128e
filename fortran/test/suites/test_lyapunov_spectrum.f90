! SPDX-License-Identifier: BSD-3-Clause
!> Growth of tangent vectors: measured in one go and in two, from where a run ended, in halves of an
!> interval, and where vectors are lost.
module test_lyapunov_spectrum
   use block_builder, only: build_block, index_of_ln_v
   use dde, only: continuation_type, dde_problem_type, integrate, integration_options, &
                  integration_result, table_sampler
   use dde_errors, only: failure_type => error_type
   use exponent_runs, only: measure
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: extend_growth, growth_settings_type, growth_type, &
                                interval_observer_type, measure_growth
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use progress_recorder, only: expect_counted, recorder
   use solving, only: at_tolerance, run
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_lyapunov_spectrum

   !> An observer that keeps the beginning and end of each interval, shape (2, intervals).
   type, extends(interval_observer_type) :: witness_type
      real(wp), allocatable :: kept(:, :)
      !> The last interval, and how many were tried
      real(wp) :: last(2) = 0.0_wp
      integer :: tried = 0
   contains
      procedure :: observe_interval, keep_interval
   end type witness_type

contains

   subroutine collect_lyapunov_spectrum(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("in one go and in two halves", test_two_halves), &
                   new_unittest("from where a run ended", test_arrived), &
                   new_unittest("halved intervals", test_divergence), &
                   new_unittest("vectors lost give a bound or an error", test_lost), &
                   new_unittest("a vector that shrinks fast", test_fast), &
                   new_unittest("slips at gamma = 1e8", test_slips), &
                   new_unittest("no vector goes on as noise of any size", test_noise), &
                   new_unittest("an observer", test_observed), &
                   new_unittest("refusals", test_refusals), &
                   new_unittest("progress", test_progress)]
   end subroutine collect_lyapunov_spectrum

   !> The oscillation of the paper.
   type(model_type) function oscillation() result(block)
      block = build_block(tau=10.0_wp, epsilon=0.35_wp, xi=0.8_wp, gamma=0.8_wp, v=1.1_wp)
   end function oscillation

   !> A block without delay whose third vector shrinks by exp(-2e4) in a unit of time.
   type(model_type) function stiff(u) result(block)
      real(wp), intent(in) :: u

      block = build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.5_wp, gamma=100.0_wp, u=u)
   end function stiff

   !> Three exponents of it in four intervals of a given length, each a block.
   pure type(growth_settings_type) function four_intervals(interval) result(settings)
      real(wp), intent(in) :: interval

      settings = growth_settings_type(exponents=3, t_begin=1.0_wp, t_end=1.0_wp + 4*interval, &
                                      t_turning=2*interval, interval=interval, blocks=4)
   end function four_intervals

   !> Twice 100 in 18 intervals are 200 in 36 as long, not in fewer longer ones: only so do all
   !> count alike. The growth is that of one go.
   subroutine test_two_halves(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(growth_type) :: halves, whole

      settings = growth_settings_type(exponents=4, t_begin=150.0_wp, t_end=250.0_wp, &
                                      t_turning=50.0_wp, interval=6.0_wp, blocks=2)
      call measure(error, oscillation(), settings, at_tolerance(1.0e-8_wp), halves)
      if (allocated(error)) return
      call expect(error, all(shape(halves%growth) == [4, 18]), "18 intervals")
      call extend_growth(oscillation(), settings, at_tolerance(1.0e-8_wp), halves, failure)
      call expect_success(error, failure)
      settings%t_end = 350.0_wp
      call measure(error, oscillation(), settings, at_tolerance(1.0e-8_wp), whole)
      if (allocated(error)) return
      call expect(error, all(shape(halves%growth) == [4, 36]), "36 intervals")
      call expect_close(error, halves%interval, 100.0_wp/18, 1.0e-12_wp, "interval")
      call expect_close(error, halves%continuation%time(1), 350.0_wp, 1.0e-10_wp, "the end")
      call expect_close(error, sum(halves%length), sum(whole%length), 1.0e-10_wp, "time")
      call expect_close(error, sum(halves%growth, dim=2), sum(whole%growth, dim=2), 1.0e-4_wp, &
                        "growth")
   end subroutine test_two_halves

   !> A run that ended where the vectors would begin anyway makes no difference. After a shorter run
   !> they begin where the delay is over: before that they have no past.
   subroutine test_arrived(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: alone, continued

      alone = growth_settings_type(exponents=3, t_begin=150.0_wp, t_end=200.0_wp, &
                                   t_turning=50.0_wp, interval=5.0_wp, blocks=2)
      continued = alone
      continued%t_begin = 0.0_wp
      call compare_goes(alone, 100.0_wp, continued, 0.0_wp, error)
      alone = growth_settings_type(exponents=3, t_begin=30.0_wp, t_end=60.0_wp, &
                                   t_turning=20.0_wp, interval=5.0_wp, blocks=2)
      call compare_goes(alone, 3.0_wp, alone, 1.0e-4_wp, error)
   end subroutine test_arrived

   !> Growth in one go is that from where a run ended, which is left as it was.
   subroutine compare_goes(alone, t_arrived, continued, tolerance, error)
      type(growth_settings_type), intent(in) :: alone
      real(wp), intent(in) :: t_arrived
      type(growth_settings_type), intent(in) :: continued
      real(wp), intent(in) :: tolerance
      type(error_type), allocatable, intent(inout) :: error
      type(continuation_type) :: arrived
      type(growth_type) :: one_go, two_goes
      type(integration_result) :: outcome

      call measure(error, oscillation(), alone, at_tolerance(1.0e-8_wp), one_go)
      call run(error, oscillation(), 0.0_wp, t_arrived, at_tolerance(1.0e-8_wp), outcome, &
               continuation=arrived)
      call measure(error, oscillation(), continued, at_tolerance(1.0e-8_wp), two_goes, arrived)
      if (allocated(error)) return
      call expect_close(error, two_goes%t_begin, alone%t_begin, 0.0_wp, "beginning")
      call expect_close(error, pack(two_goes%growth, .true.), pack(one_go%growth, .true.), &
                        tolerance, "growth")
      call expect_close(error, arrived%time(1), t_arrived, 0.0_wp, "the run that ended")
   end subroutine compare_goes

   !> At gamma = 1000 the third vector shrinks by exp(-2e6) in a unit of time: an interval of 0.01
   !> is halved eleven times.
   subroutine test_fast(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_type) :: measured

      call measure(error, build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.5_wp, gamma=1000.0_wp), &
                   growth_settings_type(exponents=3, t_begin=1.0_wp, t_end=1.02_wp, &
                                        interval=0.01_wp, blocks=2), &
                   at_tolerance(1.0e-8_wp, "radau9"), measured)
      if (allocated(error)) return
      call expect_close(error, sum(measured%growth(3, :))/0.02_wp, -2.0e6_wp, 2.0e3_wp, &
                        "the third exponent")
   end subroutine test_fast

   !> In slips at gamma = 1e8 `auto` takes fewer steps than the implicit method: it finds the slow
   !> series of the vectors.
   subroutine test_slips(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=6), parameter :: methods(2) = ["auto  ", "radau9"]
      type(growth_type) :: measured(2)
      type(model_type) :: block
      integer :: i

      block = build_block(tau=4.5_wp, epsilon=1.5_wp, xi=0.5_wp, gamma=1.0e8_wp, v=1.5_wp, &
                          law="slip_delayed_velocity")
      do i = 1, 2
         call measure(error, block, growth_settings_type( &
                      exponents=3, t_begin=40.0_wp, t_end=120.0_wp, interval=20.0_wp, &
                      bounds=.true., across_flow=.true.), &
                      at_tolerance(1.0e-8_wp, methods(i)), measured(i))
      end do
      call expect(error, measured(1)%steps < measured(2)%steps, "more steps than radau9")
   end subroutine test_slips

   !> Without delay at gamma = 1e4, rounding left vectors of size 1e13 and more, until one was
   !> infinite. What is left has the size of the others and is orthogonal to them.
   subroutine test_noise(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_type) :: measured

      call measure(error, &
                   build_block(tau=0.0_wp, epsilon=0.8_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp), &
                   growth_settings_type(exponents=3, t_begin=1000.0_wp, t_end=1100.0_wp, &
                                        interval=20.0_wp, bounds=.true., across_flow=.true.), &
                   at_tolerance(1.0e-8_wp, "auto"), measured)
      if (allocated(error)) return
      associate (vectors => reshape(measured%continuation%y(4:), [3, 2]))
         call expect(error, all(norm2(vectors, dim=1) < 1.0_wp), "a vector is large")
      end associate
      call expect(error, sum(measured%growth(2, :)) < -1.0e4_wp*sum(measured%length), "no bound")
   end subroutine test_noise

   !> An observer sees the whole time once, also where intervals are halved, and changes nothing.
   subroutine test_observed(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(growth_type) :: alone, observed
      type(witness_type) :: witness

      settings = four_intervals(0.02_wp)
      call measure(error, stiff(0.0_wp), settings, at_tolerance(1.0e-8_wp, "radau9"), alone)
      call measure(error, stiff(0.0_wp), settings, at_tolerance(1.0e-8_wp, "radau9"), observed, &
                   observer=witness)
      if (allocated(error)) return
      call extend_growth(stiff(0.0_wp), settings, at_tolerance(1.0e-8_wp, "radau9"), observed, &
                         failure, witness)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, pack(observed%growth(:, :4), .true.), pack(alone%growth, .true.), &
                        0.0_wp, "growth")
      associate (n => size(witness%kept, 2))
         call expect(error, witness%tried > n .and. n > 8, "intervals were halved")
         call expect_close(error, witness%kept(1, 2:), witness%kept(2, :n - 1), 0.0_wp, &
                           "one interval begins where the last one ended")
         call expect_close(error, witness%kept(2, n), observed%continuation%time(1), 0.0_wp, "end")
      end associate
   end subroutine test_observed

   !> Integrate and note the interval.
   subroutine observe_interval(self, problem, time, options, outcome, error, continuation)
      class(witness_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: time
      type(integration_options), intent(in) :: options
      type(integration_result), intent(out) :: outcome
      type(failure_type), allocatable, intent(out) :: error
      type(continuation_type), intent(inout) :: continuation

      self%last = [continuation%time(1), time]
      self%tried = self%tried + 1
      call integrate(problem, continuation%time(1), time, options, outcome, error, &
                     continuation=continuation)
   end subroutine observe_interval

   !> Keep the interval.
   subroutine keep_interval(self)
      class(witness_type), intent(inout) :: self

      if (.not. allocated(self%kept)) allocate (self%kept(2, 0))
      self%kept = reshape([self%kept, self%last], [2, size(self%kept, 2) + 1])
   end subroutine keep_interval

   !> Far from rest: the logarithm of the volume that three vectors span grows by the integral of
   !> the divergence, -v - (gamma^2/xi)/v - dw/dt in (theta, u, w = ln v).
   subroutine test_divergence(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: settings
      type(growth_type) :: measured
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      integer, parameter :: n = 2000
      real(wp) :: divergence, rate(0:n), w(0:n)
      integer :: i

      settings = four_intervals(0.02_wp)
      call measure(error, stiff(-1.0_wp), settings, at_tolerance(1.0e-8_wp, "radau9"), measured)
      samples = table_sampler([index_of_ln_v], &
                              [((1.0_wp - real(i, wp)/n)*settings%t_begin &
                                + real(i, wp)/n*settings%t_end, i=0, n)])
      call run(error, stiff(-1.0_wp), 0.0_wp, settings%t_end, at_tolerance(1.0e-8_wp, "radau9"), &
               outcome, sampler=samples)
      if (allocated(error)) return
      w = samples%values(1, :)
      rate = -exp(w) - 100.0_wp**2/0.5_wp*exp(-w)
      ! the trapezoidal rule
      divergence = (settings%t_end - settings%t_begin)/n*(sum(rate) - 0.5_wp*(rate(0) + rate(n))) &
                   - (w(n) - w(0))
      call expect(error, abs(w(n)) > 0.05_wp, "not at rest")
      call expect_close(error, sum(measured%growth)/divergence, 1.0_wp, 0.1_wp/12.5_wp, &
                        "growth of the volume over the integral of the divergence")
   end subroutine test_divergence

   !> An interval so long that ten halvings do not help: an error, or a bound from above where that
   !> is asked for, and the others as before.
   subroutine test_lost(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(growth_type) :: measured

      settings = growth_settings_type(exponents=3, t_begin=1.0_wp, t_end=3.0_wp, interval=1.0_wp, &
                                      blocks=2)
      call measure_growth(stiff(0.0_wp), settings, at_tolerance(1.0e-3_wp, "radau5"), measured, &
                          failure)
      call expect_failure(error, failure, &
                          "is left of a tangent vector without those before it; expected > 1.0")
      settings%bounds = .true.
      call measure(error, stiff(0.0_wp), settings, at_tolerance(1.0e-4_wp, "radau5"), measured)
      if (allocated(error)) return
      call expect(error, all(measured%growth(3, :) < -log(1.0e1_wp)), "the third is lost")
      call expect_between(error, sum(measured%growth(:2, :))/2, -0.3_wp, 0.1_wp, &
                          "the pair, whose roots sum to -0.2")
   end subroutine test_lost

   !> What cannot be measured is refused in words.
   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type), parameter :: good = &
         growth_settings_type(exponents=1, t_begin=1.0_wp, t_end=2.0_wp, interval=0.5_wp, blocks=2)
      type(growth_settings_type) :: settings

      settings = good
      settings%exponents = 0
      call expect_refusal("exponents: 0 asked for; at least 1 expected")
      settings%exponents = 4
      call expect_refusal("4 asked for of 3 equations without delay; at most 3 expected")
      settings = good
      settings%blocks = 1
      call expect_refusal("exponents: 1 blocks; at least 2 expected")
      settings = good
      settings%interval = 0.0_wp
      call expect_refusal("exponents: interval = 0.0; > 0 expected")
      settings = good
      settings%t_end = 1.0_wp
      call expect_refusal("exponents: t_end = 1.0; expected > 1.0, where the vectors begin")

   contains

      !> The settings are refused in these words.
      subroutine expect_refusal(words)
         character(len=*), intent(in) :: words
         type(failure_type), allocatable :: failure
         type(growth_type) :: measured

         call measure_growth(stiff(0.0_wp), settings, at_tolerance(1.0e-6_wp, "radau5"), &
                             measured, failure)
         call expect_failure(error, failure, words)
      end subroutine expect_refusal
   end subroutine test_refusals

   !> 10 intervals in which vectors turn, 40 that are measured.
   subroutine test_progress(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: settings
      type(growth_type) :: watched
      type(linear) :: problem
      type(recorder) :: receiver

      problem = linear()
      settings = growth_settings_type(exponents=2, t_begin=6.0_wp, t_end=26.0_wp, &
                                      t_turning=5.0_wp, interval=0.5_wp, blocks=4)
      call measure(error, problem, settings, at_tolerance(1.0e-6_wp), watched, progress=receiver)
      if (allocated(error)) return
      call expect_counted(error, receiver, 50)
   end subroutine test_progress
end module test_lyapunov_spectrum
