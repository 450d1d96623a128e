! SPDX-License-Identifier: BSD-3-Clause
!> Jumps: those that the caller declares, changes of the state between runs, and the breaking points
!> of many delays.
module test_dde_breaks
   use dde, only: continuation_type, integration_options, integration_result
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_close, expect_success
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use piecewise_problems, only: delayed_pulse, jumping_history, many_delays, piecewise
   use pseudo_random, only: uniform
   use solving, only: at_tolerance, run
   use test_problems, only: fill, linear
   implicit none (type, external)
   private
   public :: collect_dde_breaks

   !> Methods that do not need a series.
   character(len=8), parameter :: methods(5) = [character(len=8) :: "explicit", "radau5", &
                                                "radau9", "radau13", "auto"]

contains

   subroutine collect_dde_breaks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a pulse", test_pulse), &
                   new_unittest("a history that jumps", test_history), &
                   new_unittest("a changed state", test_changed_state), &
                   new_unittest("many doses", test_doses), &
                   new_unittest("many delays", test_many_delays)]
   end subroutine collect_dde_breaks

   !> A short pulse late in the run, and what comes of it one delay later: the solution is piecewise
   !> polynomial, so that it comes out exact at any tolerance where all jumps are landed on. A run
   !> ends within the pulse and another goes on.
   subroutine test_pulse(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(piecewise) :: problem
      type(integration_options) :: options
      type(integration_result) :: outcome
      real(wp), parameter :: ends(4) = [50.05_wp, 50.1_wp, 51.0_wp, 55.0_wp]
      integer :: i, part

      call fill(problem, 2, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [1.0_wp], [1])
      problem%kind = delayed_pulse
      do i = 1, size(methods)
         options = at_tolerance(1.0e-3_wp, methods(i))
         options%break_at = [50.1_wp, 50.0_wp, 80.0_wp]
         state = continuation_type()
         do part = 1, size(ends)
            call run(error, problem, state%time(1), ends(part), options, outcome, &
                     continuation=state)
            if (allocated(error)) return
         end do
         call expect_close(error, outcome%y, [10.0_wp, 39.5_wp], 1.0e-10_wp, methods(i))
      end do
   end subroutine test_pulse

   !> A hundred thousand points at which the right-hand side may jump. Where each cost a look at all
   !> others this took minutes.
   subroutine test_doses(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      integer, parameter :: doses = 100000
      integer :: i

      options = at_tolerance(1.0e-3_wp, "bs5")
      options%break_at = [(i*1.0e-3_wp, i=1, doses)]
      call run(error, linear(), 0.0_wp, doses*1.0e-3_wp, options, outcome)
      if (allocated(error)) return
      call expect(error, outcome%breaking_points >= doses - 1, "a step ends at each")
   end subroutine test_doses

   !> A jump inside the history comes back as a kink.
   subroutine test_history(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(jumping_history) :: problem
      integer :: i

      call fill(problem, 1, [0.0_wp], [0.0_wp], [1.0_wp], [1])
      problem%rate = -1.0_wp
      do i = 1, size(methods)
         options = at_tolerance(1.0e-3_wp, methods(i))
         options%break_at = [-0.5_wp]
         call run(error, problem, 0.0_wp, 2.5_wp, options, outcome)
         if (allocated(error)) return
         call expect_close(error, outcome%y, [0.875_wp], 1.0e-13_wp, methods(i))
      end do
   end subroutine test_history

   !> y' = y(t - 1) from rest, put to 1 at t = 5/2: 7/2 at t = 11/2, exact at any tolerance.
   subroutine test_changed_state(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(failure_type), allocatable :: failure
      type(integration_result) :: outcome
      type(linear) :: problem
      integer :: i

      problem = linear(past=[0.0_wp], first=[0.0_wp], rate=-1.0_wp)
      do i = 1, size(methods)
         state = continuation_type()
         call run(error, problem, 0.0_wp, 2.5_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome, &
                  continuation=state)
         call state%change_state([1.0_wp], failure)
         call expect_success(error, failure)
         call run(error, problem, 2.5_wp, 5.5_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome, &
                  continuation=state)
         if (allocated(error)) return
         call expect_close(error, outcome%y, [3.5_wp], 1.0e-13_wp, methods(i))
      end do
   end subroutine test_changed_state

   !> Random delays from 1/2 to 3/2, t = 10: no more than three times the steps that landing on the
   !> first generation alone takes, which is all delays and 20 steps for 1e-6, half as many steps as
   !> delays if these are very many, and errors as small as the tolerance allows: the solution
   !> is compared at 1e-6 and 1e-11.
   subroutine test_many_delays(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: counts(6) = [10, 12, 20, 50, 100, 2000]
      type(integration_result) :: fine, outcome
      type(piecewise) :: problem
      integer :: i, k

      problem%kind = many_delays
      do i = 1, size(counts)
         call fill(problem, 1, [1.0_wp], [1.0_wp], uniform(i, counts(i), 0.5_wp, 1.5_wp), &
                   [(1, k=1, counts(i))])
         call run(error, problem, 0.0_wp, 10.0_wp, at_tolerance(1.0e-11_wp, "explicit"), fine)
         do k = 1, size(methods)
            call run(error, problem, 0.0_wp, 10.0_wp, at_tolerance(1.0e-6_wp, methods(k)), outcome)
            if (allocated(error)) return
            associate (case_name => methods(k)//", "//text(counts(i))//" delays")
               call expect(error, outcome%accepted <= min(3*(20 + counts(i)), 800), &
                           text(outcome%accepted)//" steps by "//case_name)
               call expect_close(error, outcome%y, fine%y, &
                                 1.0e-5_wp*max(1.0_wp, maxval(abs(fine%y))), case_name)
            end associate
         end do
      end do
   end subroutine test_many_delays
end module test_dde_breaks
