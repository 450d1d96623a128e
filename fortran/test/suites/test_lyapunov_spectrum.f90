! SPDX-License-Identifier: BSD-3-Clause
!> Tangent vectors: their equations, norm and restart, and their growth: measured in one go and in
!> two, from where a run ended, in halves of an interval, and where vectors are lost. The suites
!> exponents and floquet_multipliers have known exponents.
module test_lyapunov_spectrum
   use block_builder, only: build_block, index_of_ln_v
   use dde, only: continuation_type, dde_problem_type, integrate, integration_options, &
                  integration_result, table_sampler
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use exponent_runs, only: measure, recorder
   use lyapunov_spectrum, only: extend_growth, growth_settings_type, growth_type, &
                                interval_observer_type, measure_growth
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   use solving, only: at_tolerance, run
   use tangent_problem, only: tangent_problem_type
   use tangent_vectors, only: orthonormalise, start_vectors, undisturbed_part
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_lyapunov_spectrum

   !> An observer of intervals: the last one, how far those kept reach, the largest gap between two,
   !> and how many were tried and kept.
   type, extends(interval_observer_type) :: witness_type
      real(wp) :: last(2) = 0.0_wp, reached = 0.0_wp, gap = 0.0_wp
      integer :: tried = 0, kept = 0
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
                   new_unittest("stiff blocks", test_stiff), &
                   new_unittest("an observer", test_observed), &
                   new_unittest("refusals", test_refusals), &
                   new_unittest("variational equations", test_variational_equations), &
                   new_unittest("norm", test_norm), &
                   new_unittest("smooth restart", test_smooth_restart)]
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

   !> Three exponents of it in four intervals of a given length, each a batch.
   pure type(growth_settings_type) function four_intervals(interval) result(settings)
      real(wp), intent(in) :: interval

      settings = growth_settings_type(exponents=3, t_begin=1.0_wp, t_end=1.0_wp + 4*interval, &
                                      t_turning=2*interval, interval=interval, batches=4)
   end function four_intervals

   !> Twice 100 in 18 intervals are 200 in 36 as long, not in fewer longer ones: only so do all
   !> count alike. The growth is that of one go. Progress counts these and 9 in which vectors turn.
   subroutine test_two_halves(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(growth_type) :: halves, whole
      type(recorder) :: receiver
      integer :: i

      settings = growth_settings_type(exponents=4, t_begin=150.0_wp, t_end=250.0_wp, &
                                      t_turning=50.0_wp, interval=6.0_wp, batches=2)
      call measure(error, oscillation(), settings, at_tolerance(1.0e-8_wp), halves, &
                   progress=receiver)
      if (allocated(error)) return
      call expect(error, all(shape(halves%growth) == [4, 18]), "18 intervals")
      call expect(error, all(receiver%done == [(i, i=1, 27)] .and. receiver%total == 27), "pieces")
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
   !> they begin where the delay is over: before that they have no past. That run is left as it was.
   subroutine test_arrived(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: t_begin(2) = [150.0_wp, 30.0_wp], t_arrived(2) = [100.0_wp, 3.0_wp], &
                             continued(2) = [0.0_wp, 30.0_wp], t_turning(2) = [50.0_wp, 20.0_wp], &
                             within(2) = [0.0_wp, 1.0e-4_wp]
      type(continuation_type) :: arrived
      type(growth_settings_type) :: settings
      type(growth_type) :: one_go, two_goes
      type(integration_result) :: outcome
      integer :: i

      do i = 1, 2
         settings = growth_settings_type(exponents=3, t_begin=t_begin(i), &
                                         t_end=t_begin(i) + 30.0_wp, t_turning=t_turning(i), &
                                         interval=5.0_wp, batches=2)
         call measure(error, oscillation(), settings, at_tolerance(1.0e-8_wp), one_go)
         arrived = continuation_type()
         call run(error, oscillation(), 0.0_wp, t_arrived(i), at_tolerance(1.0e-8_wp), outcome, &
                  continuation=arrived)
         settings%t_begin = continued(i)
         call measure(error, oscillation(), settings, at_tolerance(1.0e-8_wp), two_goes, arrived)
         if (allocated(error)) return
         call expect_close(error, two_goes%t_begin, t_begin(i), 0.0_wp, "beginning")
         call expect_close(error, pack(two_goes%growth, .true.), pack(one_go%growth, .true.), &
                           within(i), "growth")
         call expect_close(error, arrived%time(1), t_arrived(i), 0.0_wp, "the run that ended")
      end do
   end subroutine test_arrived

   !> Without delay at gamma = 1000 the third vector shrinks by exp(-2e6) in a unit of time: an
   !> interval of 0.01 is halved eleven times. In slips at gamma = 1e8 `auto` takes fewer steps than
   !> the implicit method: it finds the slow series of the vectors. At gamma = 1e4, rounding left
   !> vectors of size 1e13 and more, until one was infinite; what is left has the size of the
   !> others.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: settings
      type(growth_type) :: measured(2)
      type(model_type) :: block

      call measure(error, build_block(tau=0.0_wp, epsilon=0.3_wp, xi=0.5_wp, gamma=1000.0_wp), &
                   growth_settings_type(exponents=3, t_begin=1.0_wp, t_end=1.02_wp, &
                                        interval=0.01_wp, batches=2), &
                   at_tolerance(1.0e-8_wp, "radau9"), measured(1))
      if (allocated(error)) return
      call expect_close(error, sum(measured(1)%growth(3, :))/0.02_wp, -2.0e6_wp, 2.0e3_wp, &
                        "the third exponent")
      settings = growth_settings_type(exponents=3, t_begin=40.0_wp, t_end=120.0_wp, &
                                      interval=20.0_wp, bounds=.true., across_flow=.true.)
      block = build_block(tau=4.5_wp, epsilon=1.5_wp, xi=0.5_wp, gamma=1.0e8_wp, v=1.5_wp, &
                          law="slip_delayed_velocity")
      call measure(error, block, settings, at_tolerance(1.0e-8_wp, "auto"), measured(1))
      call measure(error, block, settings, at_tolerance(1.0e-8_wp, "radau9"), measured(2))
      call expect(error, measured(1)%steps < measured(2)%steps, "more steps than radau9")
      settings%t_begin = 1000.0_wp
      settings%t_end = 1100.0_wp
      call measure(error, &
                   build_block(tau=0.0_wp, epsilon=0.8_wp, xi=0.5_wp, gamma=1.0e4_wp, v=1.1_wp), &
                   settings, at_tolerance(1.0e-8_wp, "auto"), measured(1))
      if (allocated(error)) return
      call expect(error, all(norm2(reshape(measured(1)%continuation%y(4:), [3, 2]), dim=1) &
                             < 1.0_wp), "a vector is large")
      call expect(error, sum(measured(1)%growth(2, :)) < -1.0e4_wp*sum(measured(1)%length), &
                  "no bound")
   end subroutine test_stiff

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
      call expect_close(error, pack(observed%growth(:, :4), .true.), pack(alone%growth, .true.), &
                        0.0_wp, "growth")
      call expect(error, witness%tried > witness%kept .and. witness%kept > 8, &
                  "intervals were halved")
      call expect_close(error, [witness%gap, witness%reached], &
                        [0.0_wp, observed%continuation%time(1)], 0.0_wp, "gaps and end")
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

      if (self%kept > 0) self%gap = max(self%gap, abs(self%last(1) - self%reached))
      self%reached = self%last(2)
      self%kept = self%kept + 1
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
      associate (from => settings%t_begin, time => settings%t_end - settings%t_begin)
         samples = table_sampler([index_of_ln_v], [(from + i*(time/n), i=0, n - 1), from + time])
         call run(error, stiff(-1.0_wp), 0.0_wp, from + time, at_tolerance(1.0e-8_wp, "radau9"), &
                  outcome, sampler=samples)
         if (allocated(error)) return
         w = samples%values(1, :)
         rate = -exp(w) - 100.0_wp**2/0.5_wp*exp(-w)
         ! the trapezoidal rule
         divergence = time/n*(sum(rate) - 0.5_wp*(rate(0) + rate(n))) - (w(n) - w(0))
      end associate
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
                                      batches=2)
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

      call refuse(0, 2.0_wp, 0.5_wp, 2, "exponents: 0 asked for; at least 1 expected")
      call refuse(4, 2.0_wp, 0.5_wp, 2, "4 asked for of 3 equations without delay; at most 3 " &
                  //"expected")
      call refuse(1, 2.0_wp, 0.5_wp, 1, "exponents: 1 batches; at least 2 expected")
      call refuse(1, 2.0_wp, 0.0_wp, 2, "exponents: interval = 0.0; > 0 expected")
      call refuse(1, 1.0_wp, 0.5_wp, 2, "exponents: t_end = 1.0; expected > 1.0, where the " &
                  //"vectors begin")

   contains

      !> The settings are refused in these words.
      subroutine refuse(exponents, t_end, interval, batches, words)
         integer, intent(in) :: exponents, batches
         real(wp), intent(in) :: t_end, interval
         character(len=*), intent(in) :: words
         type(failure_type), allocatable :: failure
         type(growth_type) :: measured

         call measure_growth(stiff(0.0_wp), growth_settings_type( &
                             exponents=exponents, t_begin=1.0_wp, t_end=t_end, interval=interval, &
                             batches=batches), at_tolerance(1.0e-6_wp, "radau5"), measured, failure)
         call expect_failure(error, failure, words)
      end subroutine refuse
   end subroutine test_refusals

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
      call expect(error, problem%n == 9 .and. all(problem%component == [3, 6, 9]), "components")
      call expect_close(error, [problem%lag, problem%history(-1.0_wp, 3), &
                                problem%history(-1.0_wp, 6)], &
                        [10.0_wp, 10.0_wp, 10.0_wp, log(1.1_wp), 0.0_wp], 0.0_wp, "delays, history")
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
end module test_lyapunov_spectrum
