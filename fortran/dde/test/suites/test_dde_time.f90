! SPDX-License-Identifier: BSD-3-Clause
!> Time that does not lose small steps, by itself and in an integration.
module test_dde_time
   use dde, only: integration_options, integration_result
   use dde_time, only: elapsed, instant, later
   use expectations, only: expect, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run
   use test_problems, only: linear
   implicit none (type, external)
   private
   public :: collect_dde_time

   !> What one step must exceed to move a plain number of size 100 (half its spacing).
   real(wp), parameter :: spacing_of_100 = 2.0_wp**(-46)

contains

   subroutine collect_dde_time(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("many small steps", test_small_steps), &
                   new_unittest("exact sums", test_exact_sums), &
                   new_unittest("a short delay at a late time", test_short_delay)]
   end subroutine collect_dde_time

   !> Steps of 1e-20 and of 1e-17 at t = 100, none of which moves a plain number, add up; the latter
   !> to several spacings.
   subroutine test_small_steps(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: steps(2) = [1.0e-20_wp, 1.0e-17_wp]
      integer, parameter :: many = 100000
      type(instant) :: now(2)
      integer :: i

      now = instant(100.0_wp)
      do i = 1, many
         now = later(now, steps)
      end do
      call expect_close(error, elapsed(instant(100.0_wp), now)/(many*steps), &
                        [1.0_wp, 1.0_wp], 1.0e-12_wp, "time elapsed over time stepped")
      call expect(error, now(2)%hi > 100.0_wp, "the leading part moves in the end")
      call expect(error, all(abs(now%lo) <= 0.5_wp*spacing_of_100), "the rest stays below rounding")
   end subroutine test_small_steps

   !> Powers of two add up without any error, and what is lost in a difference of the leading parts
   !> is made good.
   subroutine test_exact_sums(error)
      type(error_type), allocatable, intent(out) :: error
      type(instant) :: now
      integer :: i

      now = instant(1.0e6_wp)
      do i = 1, 65536
         now = later(now, 2.0_wp**(-60))
      end do
      call expect_close(error, elapsed(instant(1.0e6_wp), now), 2.0_wp**(-44), 0.0_wp, "time")
      call expect_close(error, elapsed(now, instant(1.0e6_wp)), -2.0_wp**(-44), 0.0_wp, &
                        "time back")
      call expect_close(error, elapsed(now, instant(1000003.0_wp)), 3.0_wp - 2.0_wp**(-44), &
                        0.0_wp, "time to a later instant")
      now = later(instant(1.0_wp), 2.0_wp**(-54))
      call expect_close(error, elapsed(instant(1.5_wp*2.0_wp**(-53)), now), &
                        1.0_wp - 2.0_wp**(-53), 0.0_wp, "time over almost 1")
   end subroutine test_exact_sums

   !> y' = -y(t - lag)/lag with a delay of 8 spacings, exact after 5 and 10 delays; the same at
   !> t = 1e6 with a delay of 2**(-24).
   subroutine test_short_delay(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_decay(error, 100.0_wp, 8*spacing_of_100)
      call expect_decay(error, 1.0e6_wp, 2.0_wp**(-24))
   end subroutine test_short_delay

   !> The exact values after 5 and 10 delays.
   subroutine expect_decay(error, t_start, lag)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: t_start, lag
      type(linear) :: problem
      type(integration_options) :: options
      type(integration_result) :: outcome

      problem = linear(lag=[lag], rate=1.0_wp/lag)
      options = at_tolerance(1.0e-12_wp)
      options%longest_step = lag/7
      call run(error, problem, t_start, t_start + 5*lag, options, outcome)
      call expect(error, outcome%breaking_points == 4, "4 breaking points before 5 delays")
      call expect_close(error, outcome%y, [19.0_wp/120], 1.0e-13_wp, "y after 5 delays")
      call run(error, problem, t_start, t_start + 10*lag, options, outcome)
      call expect_close(error, outcome%y, [10493.0_wp/518400], 1.0e-13_wp, "y after 10 delays")
   end subroutine expect_decay
end module test_dde_time
