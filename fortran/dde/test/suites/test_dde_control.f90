! SPDX-License-Identifier: BSD-3-Clause
!> Time and the control of steps: bounds on the ratio of steps (those of Hairer, Norsett and
!> Wanner's DOP853, 1/3 and 6), where the closed loop settles, the first step, samples, the work
!> that is needed, and time that does not lose small steps.
module test_dde_control
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_controller, only: controller_type, method_constants
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: int64, wp
   use dde_time, only: elapsed, instant, later
   use expectations, only: expect, expect_between, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run
   use test_problems, only: constant_past, linear
   use undelayed_problems, only: fall_to, swing
   implicit none (type, external)
   private
   public :: collect_dde_control

   !> Constants as of the explicit method, and its factor below the step size at which the error
   !> would be equal to the tolerance.
   type(method_constants), parameter :: method = method_constants(error_order=8)
   real(wp), parameter :: safety = 0.9_wp
   !> What one step must exceed to move a plain number of size 100 (half its spacing).
   real(wp), parameter :: spacing_of_100 = 2.0_wp**(-46)

contains

   subroutine collect_dde_control(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("ratios of steps", test_ratios), &
                   new_unittest("a near-jump", test_jump), &
                   new_unittest("closed loop", test_closed_loop), &
                   new_unittest("first and longest step", test_steps), &
                   new_unittest("estimates by accident", test_accidents), &
                   new_unittest("samples", test_samples), &
                   new_unittest("work", test_work), &
                   new_unittest("sums of small steps", test_sums)]
   end subroutine collect_dde_control

   !> However small or large an error, steps grow at most sixfold and shrink at most to a third.
   !> Where there was no value at all, the next try is much shorter. The step that follows a
   !> rejection does not grow, the one after that may.
   subroutine test_ratios(error)
      type(error_type), allocatable, intent(out) :: error
      type(controller_type) :: control
      real(wp) :: h, h_accepted

      call expect_ratio(.true., 0.0_wp, 6.0_wp, 6.0_wp)
      call expect_ratio(.true., 1.0e-30_wp, 6.0_wp, 6.0_wp)
      call expect_ratio(.true., 1.0_wp, 1.0_wp/3, 0.95_wp)
      call expect_ratio(.false., 1.01_wp, 0.5_wp, 0.95_wp)
      call expect_ratio(.false., 1.0e30_wp, 1.0_wp/3, 1.0_wp/3)
      call expect_ratio(.false., ieee_value(1.0_wp, ieee_quiet_nan), 0.01_wp, 0.2_wp)
      h = 1.0_wp
      call control%reject(method, safety, h, 3.0_wp)
      h_accepted = h
      call control%accept(method, safety, h, 1.0e-20_wp)
      call expect_close(error, h, h_accepted, 0.0_wp, "step after a rejection")
      call control%accept(method, safety, h, 1.0e-20_wp)
      call expect(error, h > h_accepted, "the step after that grows")

   contains

      !> Next step over this one, after this error of a first step.
      subroutine expect_ratio(passes, estimate, least, most)
         logical, intent(in) :: passes
         real(wp), intent(in) :: estimate, least, most
         type(controller_type) :: first
         real(wp) :: ratio

         ratio = 1.0_wp
         if (passes) call first%accept(method, safety, ratio, estimate)
         if (.not. passes) call first%reject(method, safety, ratio, estimate)
         call expect_between(error, ratio, least - 1.0e-14_wp, most + 1.0e-14_wp, &
                             "ratio after an error of "//text(estimate))
      end subroutine expect_ratio
   end subroutine test_ratios

   !> A near-jump in the past makes the error fall as a low power of the step: few rejections find
   !> the step, and one that is not much too short.
   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: powers(3) = [0.6_wp, 1.0_wp, 2.0_wp]
      type(controller_type) :: control
      real(wp) :: estimate, h
      integer :: i, rejected

      do i = 1, size(powers)
         control = controller_type()
         h = 1.0_wp
         rejected = 0
         do
            estimate = 1.0e6_wp*h**powers(i)
            if (estimate <= 1.0_wp) exit
            call control%reject(method, safety, h, estimate)
            rejected = rejected + 1
         end do
         call expect_between(error, real(rejected, wp), 2.0_wp, 4.0_wp, "rejections")
         call expect(error, estimate > 0.1_wp, "a step not much too short")
      end do
   end subroutine test_jump

   !> Where the error is (h/scale)**order, the step settles at an error that is neither wasteful nor
   !> near rejection, from far below and from far above.
   subroutine test_closed_loop(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: scale = 0.37_wp, starts(2) = [1.0e-9_wp, 1.0e3_wp]
      type(controller_type) :: control
      real(wp) :: estimate, h
      integer :: i, j

      do i = 1, 2
         control = controller_type()
         h = starts(i)
         do j = 1, 40
            estimate = (h/scale)**method%error_order
            if (estimate <= 1.0_wp) then
               call control%accept(method, safety, h, estimate)
            else
               call control%reject(method, safety, h, estimate)
               call expect(error, j <= 20, "no rejection in the long run")
            end if
         end do
         call expect_between(error, (h/scale)**method%error_order, 0.1_wp, 0.7_wp, "error at last")
      end do
   end subroutine test_closed_loop

   !> The first step is as long as asked for, no step longer. One that the solver chooses passes,
   !> and fits the problem: between a thousandth of a radian and one of a slow and of a fast
   !> oscillator.
   subroutine test_steps(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: rates(2) = [1.0_wp, 1.0e6_wp]
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: i

      options = integration_options("explicit", first_step=0.125_wp, most_steps=1_int64)
      call integrate(swing(), 0.0_wp, 9.0_wp, options, outcome, failure)
      call expect_close(error, outcome%t, 0.125_wp, 0.0_wp, "end of the first step")
      options = integration_options("explicit", longest_step=0.03125_wp)
      call run(error, swing(), 0.0_wp, 9.0_wp, options, outcome)
      call expect_between(error, real(outcome%accepted, wp), 288.0_wp, 300.0_wp, "number of steps")
      options = at_tolerance(1.0e-9_wp)
      options%most_steps = 1
      do i = 1, 2
         call integrate(swing(rates(i)), 0.0_wp, 9.0_wp, options, outcome, failure)
         call expect(error, outcome%accepted == 1, "the first step passes")
         call expect_between(error, rates(i)*outcome%t, 1.0e-3_wp, 1.0_wp, "first step")
      end do
   end subroutine test_steps

   !> No step passes because its estimate vanishes by accident, however small what decays is beside
   !> the rest. With dop853 that was 5000 tolerances where h times the rate is 5.659.
   subroutine test_accidents(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=8), parameter :: pairs(5) = [character(len=8) :: "bs5", "dop853", "radau5", &
                                                 "radau9", "radau13"]
      type(constant_past) :: problem
      real(wp) :: h, tolerance, y(1)
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer :: digits, i, j, k

      do i = 1, size(pairs)
         do digits = 2, 10, 2
            tolerance = 10.0_wp**(-digits)
            do k = 0, 6, 2
               do j = 0, 180
                  h = merge(5.659_wp, 0.2_wp*10.0_wp**(j/90.0_wp), j == 180)
                  options = at_tolerance(tolerance, pairs(i))
                  options%first_step = h
                  problem = fall_to(10.0_wp**k)
                  call run(error, problem, 0.0_wp, h, options, outcome)
                  if (allocated(error)) return
                  if (outcome%rejected > 0) cycle
                  call problem%exact(problem%p, h, y)
                  call expect_close(error, outcome%y(1), y(1), 10.0_wp*tolerance*(1.0_wp + y(1)), &
                                    pairs(i)//" at "//text(tolerance)//", step "//text(h) &
                                    //" towards 1e"//text(k))
                  if (allocated(error)) return
               end do
            end do
         end do
      end do
   end subroutine test_accidents

   !> Samples are the wanted components, in their order, at the times wanted: the start, the end,
   !> one time twice, some a hundredth of a step apart. Those after the end are not taken.
   subroutine test_samples(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(table_sampler) :: table
      real(wp), parameter :: t_end = 0.1_wp + 0.2_wp + 7.0_wp
      real(wp), parameter :: times(8) = [0.0_wp, 1.0e-9_wp, 2.0_wp, 2.001_wp, 2.002_wp, 2.002_wp, &
                                         5.5_wp, t_end]

      table = table_sampler([2, 1], [times, nearest(t_end, 1.0_wp), 30.0_wp])
      call run(error, swing(), 0.0_wp, t_end, at_tolerance(1.0e-12_wp), outcome, table)
      call expect(error, table%received == size(times), text(table%received)//" samples")
      call expect_close(error, table%values(:, 1), [0.0_wp, 1.0_wp], 0.0_wp, "start")
      call expect_close(error, table%values(1, :8), -sin(times), 1.0e-11_wp, "-sin t")
      call expect_close(error, table%values(2, :8), cos(times), 1.0e-11_wp, "cos t")
      call expect_close(error, table%values(:, 8), outcome%y([2, 1]), 3.0e-16_wp, "end")
      call expect_close(error, outcome%t, t_end, 0.0_wp, "t")
   end subroutine test_samples

   !> Twelve evaluations a try, three more where a sample wants dense output, one at the start. With
   !> a delay each step needs dense output, and each breaking point a new first slope.
   subroutine test_work(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome, sampled
      type(table_sampler) :: table

      options = integration_options("explicit", first_step=3.0_wp)
      call run(error, swing(), 0.0_wp, 20.0_wp, options, outcome)
      call expect(error, outcome%rejected > 0, "a first step that is too long is rejected")
      call expect(error, outcome%evaluations == 1 + 12*(outcome%accepted + outcome%rejected), &
                  "evaluations without samples: "//text(outcome%evaluations))
      table = table_sampler([1], [0.0_wp, 10.0_wp, 10.0_wp, 20.0_wp])
      call run(error, swing(), 0.0_wp, 20.0_wp, options, sampled, table)
      call expect(error, sampled%evaluations == outcome%evaluations + 6, &
                  "evaluations for two steps with samples: "//text(sampled%evaluations))
      call expect_close(error, sampled%y, outcome%y, 0.0_wp, "state with and without samples")
      options%first_step = 0.9_wp
      call run(error, linear(), 0.0_wp, 20.0_wp, options, outcome)
      call expect(error, outcome%evaluations == 1 + 12*(outcome%accepted + outcome%rejected) &
                  + 3*outcome%accepted + outcome%breaking_points, &
                  "evaluations: "//text(outcome%evaluations))
   end subroutine test_work

   !> Steps of 1e-20 and of 1e-17 at t = 100, none of which moves a plain number, add up; the latter
   !> to several spacings. Powers of two add up without any error, and what is lost in a difference
   !> of the leading parts is made good.
   subroutine test_sums(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: steps(2) = [1.0e-20_wp, 1.0e-17_wp]
      integer, parameter :: many = 100000
      type(instant) :: now(2), one
      integer :: i

      now = instant(100.0_wp)
      do i = 1, many
         now = later(now, steps)
      end do
      call expect_close(error, elapsed(instant(100.0_wp), now)/(many*steps), &
                        [1.0_wp, 1.0_wp], 1.0e-12_wp, "time elapsed over time stepped")
      call expect(error, now(2)%hi > 100.0_wp, "the leading part moves in the end")
      call expect(error, all(abs(now%lo) <= 0.5_wp*spacing_of_100), "the rest stays below rounding")
      one = instant(1.0e6_wp)
      do i = 1, 65536
         one = later(one, 2.0_wp**(-60))
      end do
      call expect_close(error, elapsed(instant(1.0e6_wp), one), 2.0_wp**(-44), 0.0_wp, "time")
      call expect_close(error, elapsed(one, instant(1.0e6_wp)), -2.0_wp**(-44), 0.0_wp, "back")
      call expect_close(error, elapsed(one, instant(1000003.0_wp)), 3.0_wp - 2.0_wp**(-44), &
                        0.0_wp, "time to a later instant")
      one = later(instant(1.0_wp), 2.0_wp**(-54))
      call expect_close(error, elapsed(instant(1.5_wp*2.0_wp**(-53)), one), &
                        1.0_wp - 2.0_wp**(-53), 0.0_wp, "time over almost 1")
   end subroutine test_sums
end module test_dde_control
