! SPDX-License-Identifier: BSD-3-Clause
!> What the solver does on its way: samples, breaking points, limits, and only the work it needs.
module test_dde_behaviour
   use dde, only: dde_problem_type, integrate, integration_options, integration_result, &
                  sampler_type, table_sampler
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_between, expect_close
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run, solve
   use test_problems, only: linear, wille_baker
   use undelayed_problems, only: blow_up, swing
   implicit none (type, external)
   private
   public :: collect_dde_behaviour

   !> A sampler that wants no times of its own.
   type, extends(sampler_type) :: following_sampler
      !> Times and values
      real(wp), allocatable :: time(:), y(:)
   contains
      procedure :: take => append_sample
   end type following_sampler

contains

   subroutine collect_dde_behaviour(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("samples", test_samples), &
                   new_unittest("samples that follow the steps", test_following), &
                   new_unittest("breaking points", test_points), &
                   new_unittest("kinks are landed on", test_landing), &
                   new_unittest("first and longest step", test_steps), &
                   new_unittest("first step chosen", test_first_step), &
                   new_unittest("work", test_work)]
   end subroutine collect_dde_behaviour

   !> Samples are the wanted components, in their order, at the times wanted: the start, the end,
   !> one time twice, some a hundredth of a step apart. Those after the end are not taken.
   subroutine test_samples(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(table_sampler) :: table
      real(wp), parameter :: t_end = 0.1_wp + 0.2_wp + 7.0_wp
      real(wp), parameter :: times(8) = [0.0_wp, 1.0e-9_wp, 2.0_wp, 2.001_wp, 2.002_wp, 2.002_wp, &
                                         5.5_wp, t_end]
      real(wp), parameter :: after(2) = [nearest(t_end, 1.0_wp), 30.0_wp]

      table = table_sampler([2, 1], [times, after])
      call run(error, swing(), 0.0_wp, t_end, at_tolerance(1.0e-12_wp), outcome, table)
      call expect(error, table%received == size(times), text(table%received)//" samples")
      call expect_close(error, table%values(:, 1), [0.0_wp, 1.0_wp], 0.0_wp, "start")
      call expect_close(error, table%values(1, :8), -sin(times), 1.0e-11_wp, "-sin t")
      call expect_close(error, table%values(2, :8), cos(times), 1.0e-11_wp, "cos t")
      call expect_close(error, table%values(:, 8), outcome%y([2, 1]), 3.0e-16_wp, "end")
      call expect(error, outcome%t >= t_end .and. outcome%t <= t_end, "t is t_end")
   end subroutine test_samples

   !> y = 1/(1 - t) grows a thousandfold before the end, between two samples by a small part.
   subroutine test_following(error)
      type(error_type), allocatable, intent(out) :: error
      type(following_sampler) :: samples
      type(integration_result) :: outcome

      samples%wanted = [1]
      samples%share_of_step = 0.25_wp
      samples%time = [0.0_wp]
      samples%y = [1.0_wp]
      call run(error, blow_up(), 0.0_wp, 0.999_wp, at_tolerance(1.0e-9_wp), outcome, samples)
      if (allocated(error)) return
      associate (t => samples%time, y => samples%y, n => size(samples%time))
         call expect(error, all(t(2:) > t(:n - 1)), "times ascend")
         call expect_between(error, maxval(y(2:)/y(:n - 1)), 1.0_wp, 1.2_wp, "growth")
         call expect_between(error, y(n), 800.0_wp, 1000.0_wp, "last sample")
         call expect_close(error, y*(1.0_wp - t), spread(1.0_wp, 1, n), 1.0e-6_wp, "y")
      end associate
   end subroutine test_following

   !> Append a sample.
   subroutine append_sample(self, y)
      class(following_sampler), intent(inout) :: self
      real(wp), intent(in) :: y(:)

      self%time = [self%time, self%next]
      self%y = [self%y, y]
      self%next = huge(1.0_wp)
   end subroutine append_sample

   !> A method of order 8 needs a continuous eighth derivative: a kink is landed on 7 times, a jump
   !> 8 times, as far as the multiples of the delay lie before the end. Two delays are counted by
   !> hand. Delays 1 and 0.2 to t = 2.1: 0.2, 0.4, .. 2.0, where many sums meet. Delays 1 and 0.1 to
   !> t = 1.85: 0.1 .. 0.7, 1.0 .. 1.6, for 0.8 and 1.7 are sums of eight. Delays 1 and sqrt 2 to
   !> t = 4.5: 4, 4, 2 and 1 with 0, 1, 2 and 3 times the root.
   subroutine test_points(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_points(error, linear(), 30.0_wp, 7)
      call expect_points(error, linear(past=[0.0_wp]), 30.0_wp, 8)
      call expect_points(error, linear(), 3.5_wp, 3)
      call expect_points(error, linear(past=[0.0_wp]), 3.5_wp, 3)
      call expect_points(error, linear(), 3.0_wp, 2)
      call expect_points(error, linear(), 1.0_wp, 0)
      call expect_points(error, linear(past=[0.0_wp]), 8.5_wp, 8)
      call expect_points(error, linear(), 8.5_wp, 7)
      call expect_points(error, wille_baker(), 2.1_wp, 10)
      call expect_points(error, wille_baker(lag=[1.0_wp, 0.1_wp]), 1.85_wp, 14)
      call expect_points(error, wille_baker(lag=[1.0_wp, sqrt(2.0_wp)]), 4.5_wp, 11)
   end subroutine test_points

   !> Where all kinks are landed on, piecewise polynomials up to degree 7 come out exact at any
   !> tolerance: with one delay and with two.
   subroutine test_landing(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: time(28)
      real(wp), allocatable :: y(:, :)
      integer :: i

      time = [(0.25_wp*i, i=1, size(time))]
      call solve(linear(), time, at_tolerance(1.0_wp), y, error)
      call expect_close(error, y(1, :), [(decayed(time(i) + 1.0_wp), i=1, size(time))], &
                        1.0e-14_wp, "y with a kink")
      call solve(linear(past=[0.0_wp]), time, at_tolerance(1.0_wp), y, error)
      call expect_close(error, y(1, :), [(decayed(time(i)), i=1, size(time))], 1.0e-14_wp, &
                        "y with a jump")
      call solve(wille_baker(), [1.0_wp], at_tolerance(1.0_wp), y, error)
      call expect_close(error, y(:, 1), [2.0_wp, 696401.0_wp/187500, 17896711.0_wp/5625000], &
                        1.0e-14_wp, "y(1)")
   end subroutine test_landing

   !> The first step is as long as asked for, no step longer.
   subroutine test_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome

      options = integration_options("explicit", first_step=0.125_wp, most_steps=1_int64)
      call integrate(swing(), 0.0_wp, 9.0_wp, options, outcome, failure)
      call expect_close(error, outcome%t, 0.125_wp, 0.0_wp, "end of the first step")
      options = integration_options("explicit", longest_step=0.03125_wp)
      call run(error, swing(), 0.0_wp, 9.0_wp, options, outcome)
      call expect_between(error, real(outcome%accepted, wp), 288.0_wp, 300.0_wp, "number of steps")
   end subroutine test_steps

   !> The first step that the solver chooses passes, and fits the problem: between a thousandth of a
   !> radian and one of a slow and of a fast oscillator.
   subroutine test_first_step(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp), parameter :: rates(2) = [1.0_wp, 1.0e6_wp]
      integer :: i

      options = at_tolerance(1.0e-9_wp)
      options%most_steps = 1
      do i = 1, 2
         call integrate(swing(rates(i)), 0.0_wp, 9.0_wp, options, outcome, failure)
         call expect(error, outcome%accepted == 1, "the first step passes")
         call expect_between(error, rates(i)*outcome%t, 1.0e-3_wp, 1.0_wp, "first step")
      end do
   end subroutine test_first_step

   !> Twelve evaluations a try, three more where a sample wants dense output, one at the start. With
   !> a delay each step needs dense output, and each breaking point a new first slope.
   subroutine test_work(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome, sampled
      type(table_sampler) :: table

      options = integration_options("explicit", first_step=3.0_wp)
      call run(error, swing(), 0.0_wp, 20.0_wp, options, outcome)
      call expect(error, outcome%rejected > 0, "a first step that is too long is rejected")
      call expect(error, outcome%evaluations == 1 + 12*tries(outcome), &
                  "evaluations without samples: "//text(outcome%evaluations))
      table = table_sampler([1], [0.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      call integrate(swing(), 0.0_wp, 20.0_wp, options, sampled, failure, table)
      call expect(error, sampled%evaluations == outcome%evaluations + 6, &
                  "evaluations for two steps with samples: "//text(sampled%evaluations))
      call expect_close(error, sampled%y, outcome%y, 0.0_wp, "state with and without samples")
      call run(error, linear(), 0.0_wp, 20.0_wp, &
               integration_options("explicit", first_step=0.9_wp), outcome)
      call expect(error, outcome%evaluations == 1 + 12*tries(outcome) + 3*outcome%accepted &
                  + outcome%breaking_points, "evaluations: "//text(outcome%evaluations))
   end subroutine test_work

   !> Steps tried.
   pure integer(int64) function tries(outcome) result(value)
      type(integration_result), intent(in) :: outcome

      value = outcome%accepted + outcome%rejected
   end function tries

   !> A number of breaking points are landed on before t_end.
   subroutine expect_points(error, problem, t_end, points)
      type(error_type), allocatable, intent(inout) :: error
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: t_end
      integer, intent(in) :: points
      type(integration_result) :: outcome

      call run(error, problem, 0.0_wp, t_end, at_tolerance(1.0e-6_wp), outcome)
      call expect(error, outcome%breaking_points == points, text(points) &
                  //" breaking points before t = "//text(t_end)//", but " &
                  //text(outcome%breaking_points))
   end subroutine expect_points

   !> Exact solution of y' = -y(t - 1), y(0) = 1: the sum of (-1)^k (s - k)^k/k! over 0 <= k <= s,
   !> where s = t after a jump and t + 1 without one.
   pure real(wp) function decayed(s) result(y)
      !> Time since the first kink
      real(wp), intent(in) :: s
      integer :: k

      y = sum([((-1)**k*(s - k)**k/gamma(k + 1.0_wp), k=0, floor(s))])
   end function decayed
end module test_dde_behaviour
