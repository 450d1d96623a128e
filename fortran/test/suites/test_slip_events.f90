! SPDX-License-Identifier: BSD-3-Clause
!> Slip events of prescribed velocities, ln v = a sin t + b sin 3t, by integrals in closed form.
module test_slip_events
   use block_builder, only: build_block, index_of_ln_v, index_of_theta, index_of_u
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_description, only: observed_type
   use model_problem, only: model_type
   use slip_events, only: find_slip_events, slip_event_type
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_slip_events

   real(wp), parameter :: pi = acos(-1.0_wp), tolerance = 1.0e-12_wp, bound = 1.0e-9_wp

   !> u' = v - 1 with ln v = a sin t + b sin 3t.
   type, extends(model_type) :: prescribed_type
      !> Amplitudes
      real(wp) :: a = 1.0_wp, b = 0.0_wp
   contains
      procedure :: rhs, jacobian
   end type prescribed_type

contains

   subroutine collect_slip_events(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("known slip", test_known), &
                   new_unittest("two maxima in an event", test_two_maxima), &
                   new_unittest("two thresholds in one run", test_two_thresholds), &
                   new_unittest("transient and unfinished events", test_ends), &
                   new_unittest("a signal without integral", test_plain_signal), &
                   new_unittest("a signal below zero", test_negative_signal), &
                   new_unittest("peaks at the threshold", test_tiny_events), &
                   new_unittest("no event", test_none)]
   end subroutine collect_slip_events

   !> Time derivatives.
   pure subroutine rhs(self, t, y, z, dydt)
      class(prescribed_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt(index_of_theta) = 0.0_wp
      dydt(index_of_u) = exp(y(index_of_ln_v)) - 1.0_wp
      dydt(index_of_ln_v) = self%a*cos(t) + 3.0_wp*self%b*cos(3.0_wp*t)
   end subroutine rhs

   !> Their derivatives.
   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(prescribed_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      by_y = 0.0_wp
      by_y(index_of_u, index_of_ln_v) = exp(y(index_of_ln_v))
      by_z = 0.0_wp
   end subroutine jacobian

   !> The motion with these amplitudes, observed as a block.
   pure type(prescribed_type) function prescribed(a, b) result(model)
      real(wp), intent(in) :: a, b

      model%n = 3
      model%past = [0.0_wp, 0.0_wp, 0.0_wp]
      allocate (model%lag(0), model%component(0))
      model%sizes%observed = observed_type(component=index_of_ln_v, is_exponential=.true., &
                                           event=0.0_wp, integral=index_of_u, with_time=.true.)
      model%a = a
      model%b = b
   end function prescribed

   !> Events of a model up to a time.
   subroutine events_of(model, thresholds, t_transient, t_end, events, error)
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: thresholds(:), t_transient, t_end
      type(slip_event_type), allocatable, intent(out) :: events(:)
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      call find_slip_events(model, thresholds, t_transient, t_end, at_tolerance(tolerance), &
                            events, failure)
      call expect_success(error, failure)
   end subroutine events_of

   !> The integral of exp(sin t) over half a period is pi (I0(1) + L0(1)), by the modified functions
   !> of Bessel and Struve.
   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: i0 = 1.266065877752008336_wp, l0 = 0.710243185937890861_wp
      type(slip_event_type), allocatable :: events(:)
      integer :: i

      call events_of(prescribed(1.0_wp, 0.0_wp), [1.0_wp], 0.0_wp, 40.0_wp, events, error)
      if (allocated(error)) return
      call expect(error, size(events%onset) == 5, "onsets at 2 pi to 10 pi; the last has no next")
      if (allocated(error)) return
      call expect_close(error, events%onset, [(2.0_wp*pi*i, i=1, 5)], bound, "onset")
      call expect_close(error, events%recurrence_time, [(2.0_wp*pi, i=1, 5)], bound, "recurrence")
      call expect_close(error, events%duration, [(pi, i=1, 5)], bound, "duration")
      call expect_close(error, events%slip, [(pi*(i0 + l0), i=1, 5)], bound, "slip")
      call expect_close(error, events%peak_velocity, [(exp(1.0_wp), i=1, 5)], bound, "peak")
      call expect_close(error, events%least_velocity, [(exp(-1.0_wp), i=1, 5)], bound, "least")
   end subroutine test_known

   !> 2 sin t + sin 3t has maxima of (10/3) sqrt(5/12) before and after its minimum at pi/2.
   subroutine test_two_maxima(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: highest = 10.0_wp/3.0_wp*sqrt(5.0_wp/12.0_wp)
      type(slip_event_type), allocatable :: events(:)

      call events_of(prescribed(2.0_wp, 1.0_wp), [1.0_wp], 0.0_wp, 20.0_wp, events, error)
      if (allocated(error)) return
      call expect(error, size(events%onset) == 2, "onsets at 2 pi and 4 pi")
      if (allocated(error)) return
      call expect_close(error, events%duration, [pi, pi], bound, "one event, not two")
      call expect_close(error, log(events%peak_velocity), [highest, highest], bound, "peak")
      call expect_close(error, log(events%least_velocity), -[highest, highest], bound, "least")
   end subroutine test_two_maxima

   !> sin t > 1/2 from pi/6 to 5 pi/6: the slip there by the midpoint rule; those with v > 1 stay.
   subroutine test_two_thresholds(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: parts = 100000
      real(wp), parameter :: high = exp(0.5_wp), time = 2.0_wp/3.0_wp*pi
      type(slip_event_type), allocatable :: events(:)
      integer :: i

      call events_of(prescribed(1.0_wp, 0.0_wp), [1.0_wp, high], 1.0_wp, 19.0_wp, events, error)
      if (allocated(error)) return
      call expect(error, size(events) == 3, "onsets at 2 pi, 13 pi/6, 4 pi; others have no next")
      if (allocated(error)) return
      call expect_close(error, events%threshold, [1.0_wp, high, 1.0_wp], bound, "threshold")
      call expect_close(error, events%onset, pi*[2.0_wp, 13.0_wp/6.0_wp, 4.0_wp], bound, "onset")
      call expect_close(error, events%duration, [pi, time, pi], bound, "duration")
      call expect_close(error, events(2:2)%slip, &
                        [time/parts*sum([(exp(sin(pi/6.0_wp + time*(i - 0.5_wp)/parts)), &
                                          i=1, parts)])], bound, "slip")
      call expect_close(error, events(2:2)%least_velocity, [exp(-1.0_wp)], bound, "least")
   end subroutine test_two_thresholds

   !> Only events that begin after the transient count, and only with the loading after them.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      type(slip_event_type), allocatable :: events(:)

      call events_of(prescribed(1.0_wp, 0.0_wp), [1.0_wp], 2.1_wp*pi, 7.9_wp*pi, events, error)
      if (allocated(error)) return
      call expect(error, size(events%onset) == 1, "the event from 4 pi to 5 pi")
      if (allocated(error)) return
      call expect_close(error, events%onset, [4.0_wp*pi], bound, "onset")
   end subroutine test_ends

   !> A signal that is no exponential, of which no state is the integral, at the threshold of the
   !> definition: sin t > 1/2.
   subroutine test_plain_signal(error)
      type(error_type), allocatable, intent(out) :: error
      type(prescribed_type) :: model
      type(slip_event_type), allocatable :: events(:)

      model = prescribed(1.0_wp, 0.0_wp)
      model%sizes%observed = observed_type(component=index_of_ln_v, event=0.5_wp)
      call events_of(model, [real(wp) ::], 0.0_wp, 14.0_wp, events, error)
      if (allocated(error)) return
      call expect(error, size(events) == 2, "onsets at pi/6 and 13 pi/6")
      if (allocated(error)) return
      call expect_close(error, events%onset, pi*[1.0_wp, 13.0_wp]/6.0_wp, bound, "onset")
      call expect_close(error, events%threshold, [0.5_wp, 0.5_wp], 0.0_wp, "threshold")
      call expect_close(error, events%duration, pi*[2.0_wp, 2.0_wp]/3.0_wp, bound, "duration")
      call expect_close(error, events%slip, [0.0_wp, 0.0_wp], 0.0_wp, "no integral")
      call expect_close(error, events%peak_velocity, [1.0_wp, 1.0_wp], bound, "peak")
      call expect_close(error, events%least_velocity, [-1.0_wp, -1.0_wp], bound, "least")
   end subroutine test_plain_signal

   !> sin t > -1/2: peaks are largest values of any sign.
   subroutine test_negative_signal(error)
      type(error_type), allocatable, intent(out) :: error
      type(prescribed_type) :: model
      type(slip_event_type), allocatable :: events(:)

      model = prescribed(1.0_wp, 0.0_wp)
      model%past(index_of_ln_v) = -3.0_wp
      model%sizes%observed = observed_type(component=index_of_ln_v)
      call events_of(model, [-2.5_wp], 0.0_wp, 14.0_wp, events, error)
      if (allocated(error)) return
      call expect_close(error, events%peak_velocity, [-2.0_wp, -2.0_wp], bound, "peak")
   end subroutine test_negative_signal

   !> sin t - sin 3t has one maximum of 2 in a period, and two of (2/3)**1.5: events of those are
   !> none at a threshold of one part in 1e7 below, and do not end the loading after the large ones.
   subroutine test_tiny_events(error)
      type(error_type), allocatable, intent(out) :: error
      type(slip_event_type), allocatable :: events(:)
      real(wp), parameter :: height = (2.0_wp/3.0_wp)**1.5_wp
      integer :: i

      call events_of(prescribed(1.0_wp, -1.0_wp), exp([height - 1.0e-7_wp]), 0.0_wp, 5.0_wp*pi, &
                     events, error)
      if (allocated(error)) return
      call expect(error, size(events) == 2, "large events")
      if (allocated(error)) return
      call expect_close(error, events%recurrence_time, [(2.0_wp*pi, i=1, 2)], bound, "recurrence")
      call expect_close(error, events%least_velocity, exp([(-2.0_wp, i=1, 2)]), bound, "least")
      call events_of(prescribed(1.0_wp, -1.0_wp), exp([height - 1.0e-5_wp]), 0.0_wp, 5.0_wp*pi, &
                     events, error)
      if (allocated(error)) return
      call expect(error, size(events) == 6, "large and small events")
   end subroutine test_tiny_events

   !> Without motion there is no event.
   subroutine test_none(error)
      type(error_type), allocatable, intent(out) :: error
      type(slip_event_type), allocatable :: events(:)

      call events_of(build_block(1.0_wp, 0.1_wp, 0.5_wp, 0.8_wp), [1.0_wp], 0.0_wp, 50.0_wp, &
                     events, error)
      if (allocated(error)) return
      call expect(error, size(events%onset) == 0, "none")
   end subroutine test_none
end module test_slip_events
