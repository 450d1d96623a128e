! SPDX-License-Identifier: BSD-3-Clause
!> The past as Taylor series: of which step, carried how far, and how long they are valid.
module test_dde_past_series
   use dde_delayed_series, only: delayed_series
   use dde_step_context, only: step_context
   use dde_time, only: instant
   use dde_tolerance, only: tolerance_type
   use dde_errors, only: text
   use dde_interpolant, only: series_value
   use expectations, only: expect, expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use single_step, only: new_context
   use test_problems, only: wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_past_series

   !> Nodes of a polynomial that is not one of powers.
   real(wp), parameter :: nodes(3) = [0.0_wp, 1.0_wp, 0.0_wp]
   !> Times are read this long after they were.
   real(wp), parameter :: lag = 2.0_wp

contains

   subroutine collect_dde_past_series(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("taylor series", test_series), &
                   new_unittest("a second node at 0", test_second_node), &
                   new_unittest("series of the next step", test_next), &
                   new_unittest("series behind a layer", test_layer), &
                   new_unittest("the last 1e-17 of a step", test_hidden_rest), &
                   new_unittest("series over many steps", test_fit)]
   end subroutine collect_dde_past_series

   !> One cubic has the same series wherever it is read. It is stored over three nodes in the first
   !> step and in powers in the second. The series is valid for as long as the step says.
   subroutine test_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(delayed_series) :: series
      type(step_context) :: context
      type(wille_baker), target :: problem
      real(wp) :: known(0:5), unit, valid_for
      real(wp), parameter :: looks(5) = [0.0_wp, 0.3_wp, 0.5_wp, 0.7_wp, 1.25_wp]
      integer :: degree, i

      ! 1 + 2 t - t^2 + t^3/2 over steps of 0.5 and 1
      problem = delayed()
      context = new_context(problem, 0.0_wp, 0.1_wp, 0.0_wp, 1.0_wp)
      call context%past%append(instant(0.0_wp), 0.5_wp, nodes, &
                               reshape([1.0_wp, 0.8125_wp, -0.1875_wp, 0.0625_wp], [4, 1]), &
                               valid_for=0.5_wp)
      call append(context, 0.5_wp, 1.0_wp, [1.8125_wp, 1.375_wp, -0.25_wp, 0.5_wp], 1.2_wp)
      do i = 1, size(looks)
         associate (t => looks(i))
            valid_for = merge(0.5_wp, 1.7_wp, t < 0.5_wp) - t
            unit = min(0.4_wp, valid_for)
            known = [1.0_wp + t*(2.0_wp - t*(1.0_wp - 0.5_wp*t)), 2.0_wp - t*(2.0_wp - 1.5_wp*t), &
                     -1.0_wp + 1.5_wp*t, 0.5_wp, 0.0_wp, 0.0_wp]*unit**[0, 1, 2, 3, 4, 5]
            do degree = 1, 5, 4
               call expect_series(error, context, t, 0.1_wp, 0.4_wp, .false., known(:degree), &
                                  "series at t = "//text(t), series, valid_for)
            end do
         end associate
      end do
   end subroutine test_series

   !> The polynomial 1 + s (s - 1/2) has the same series if the second of its nodes is 0: it is not
   !> one of powers.
   subroutine test_second_node(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: orders(2, 2) = reshape([0.0_wp, 0.5_wp, 0.5_wp, 0.0_wp], [2, 2])
      type(delayed_series) :: series
      type(step_context) :: context
      type(wille_baker), target :: problem
      integer :: i

      problem = delayed()
      do i = 1, 2
         context = new_context(problem, 0.0_wp, 0.5_wp, 0.0_wp, 1.0_wp)
         call context%past%append(instant(0.0_wp), 1.0_wp, orders(:, i), &
                                  reshape([1.0_wp, 0.0_wp, 1.0_wp], [3, 1]), valid_for=1.0_wp)
         ! in units of 0.75, for which it is valid
         call expect_series(error, context, 0.25_wp, 0.5_wp, 1.0_wp, .false., &
                            [0.9375_wp, 0.0_wp, 0.5625_wp], "series", series)
      end do
   end subroutine test_second_node

   !> If the next step begins nearer, its series is read, unless there is a kink between them. Its
   !> departure from the past before it begins must not exceed the tolerance. A series is used
   !> beyond its step as far as it agrees with what followed.
   subroutine test_next(error)
      type(error_type), allocatable, intent(out) :: error
      type(delayed_series) :: series
      type(step_context) :: context
      type(wille_baker), target :: problem
      real(wp), parameter :: tolerances(2) = [1.0e-2_wp, 1.0e-4_wp]
      real(wp), parameter :: lengths(2) = [1.0_wp, 0.75_wp]
      integer :: i

      problem = delayed()
      context = with_two_steps(problem, valid_for=1.5_wp)
      call expect_series(error, context, 0.75_wp, 0.5_wp, 0.5_wp, .true., &
                         [1.751_wp, 0.5_wp, 0.0_wp], "the next, back", series)
      call expect_length(error, context, series, 0.5_wp, 1.0e-2_wp, 0.5_wp)
      call expect_length(error, context, series, 0.5_wp, 1.0e-4_wp, 0.0_wp)
      call expect_series(error, context, 0.75_wp, 0.5_wp, 0.5_wp, .false., &
                         [1.75_wp, 0.5_wp, 0.0_wp], "the step itself", series)
      do i = 1, 2
         call expect_series(error, context, 0.25_wp, 1.0_wp, 1.0_wp, .true., &
                            [1.25_wp, 1.0_wp, 0.0_wp], "the step itself", series)
         call expect_length(error, context, series, 1.0_wp, tolerances(i), lengths(i))
      end do
      context = with_two_steps(problem, valid_for=1.0_wp)
      call expect_series(error, context, 0.75_wp, 0.25_wp, 0.25_wp, .true., &
                         [1.75_wp, 0.25_wp, 0.0_wp], "not beyond a kink", series)
   end subroutine test_next

   !> Ten steps of 1e-5 that are 0.1 above what follows: skipped if a step of 0.5 is expected and
   !> 1e-5 is less than half the tolerance times its length, not if one of 1e-3 is.
   subroutine test_layer(error)
      type(error_type), allocatable, intent(out) :: error
      type(delayed_series) :: series
      type(step_context) :: context
      type(wille_baker), target :: problem
      integer :: i

      problem = delayed()
      context = new_context(problem, 0.0_wp, 0.1_wp, 0.0_wp, 1.0_wp)
      do i = 0, 9
         call append(context, i*1.0e-5_wp, 1.0e-5_wp, [1.1_wp, 0.0_wp, 0.0_wp], 1.0e-4_wp)
      end do
      do i = 0, 1
         call append(context, 1.0e-4_wp + i, 1.0_wp, [1.0_wp, 0.0_wp, 0.0_wp], 1.0_wp)
      end do
      call expect_series(error, context, 0.0_wp, 0.5_wp, 0.5_wp, .true., &
                         [1.0_wp, 0.0_wp, 0.0_wp], "behind the layer", series)
      call expect_length(error, context, series, 0.5_wp, 1.0e-3_wp, 0.5_wp)
      call expect_length(error, context, series, 0.5_wp, 1.0e-5_wp, 0.0_wp)
      call expect_series(error, context, 0.0_wp, 0.5_wp, 1.0e-3_wp, .true., &
                         [1.1_wp, 0.0_wp, 0.0_wp], "before a short step", series)
   end subroutine test_layer

   !> At t = 1 the next step begins in 1e-17, which is not short for it: it is 1e-15 long. The step
   !> before is valid until then, although its length less the time passed is 0.
   subroutine test_hidden_rest(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: rest = 1.0e-17_wp
      type(delayed_series) :: series
      type(step_context) :: context
      type(wille_baker), target :: problem

      problem = delayed()
      context = new_context(problem, 0.0_wp, 0.1_wp, 0.0_wp, 1.0_wp)
      call append(context, 0.0_wp, 1.0_wp, [1.0_wp, 1.0_wp, 0.0_wp], 1.0_wp)
      call context%past%append(instant(1.0_wp, rest), 1.0e-15_wp, [0.0_wp], &
                               reshape([2.0_wp, 0.0_wp], [2, 1]), 1.0e-15_wp)
      call expect_series(error, context, 1.0_wp, 0.5_wp, 0.5_wp, .false., &
                         [2.0_wp, rest, 0.0_wp], "series over the rest", series)
      call expect_close(error, series%valid_for, rest, 0.01_wp*rest, "the rest")
   end subroutine test_hidden_rest

   !> sin t in 40 cubics of 0.05: after a step that these have cut, one series of degree 13 over 1.2
   !> units replaces them. It does not step over a kink, or over 0.1 more in one of the steps.
   subroutine test_fit(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 13, steps = 40
      real(wp), parameter :: length = 0.05_wp, tolerance = 1.0e-6_wp
      type(delayed_series) :: series
      type(step_context) :: context
      type(wille_baker), target :: problem
      real(wp) :: h, known, past(0:3), unit
      integer :: change, i, place

      problem = delayed()
      do change = 0, 2
         context = new_context(problem, 0.0_wp, 0.1_wp, 0.0_wp, tolerance)
         do i = 0, steps - 1
            associate (t => i*length, by => length**[0, 1, 2, 3])
               past = by*[sin(t), cos(t), -0.5_wp*sin(t), -cos(t)/6]
               if (change == 1 .and. t > 0.49_wp) past(:1) = past(:1) + by(:2)*[t - 0.5_wp, 1.0_wp]
               if (change == 2 .and. i == 8) past(0) = past(0) + 0.1_wp
               call append(context, t, length, past, length)
            end associate
         end do
         series = delayed_series(degree, delays=1)
         call context%go_to(instant(lag), 2.0_wp)
         do i = 1, 2
            unit = 1.0_wp
            call series%read_past(context, .true., unit)
            h = 2.0_wp
            call series%confirm(context, unit, h)
            if (i == 1) call expect_close(error, h, length, 1.0e-12_wp, "cut")
         end do
         call expect_close(error, h, series%valid_for, 0.0_wp, "as long as the series")
         if (change > 0) then
            call expect(error, h < 0.55_wp, "no fit over change "//text(change)//": "//text(h))
            cycle
         end if
         call expect_close(error, h, 1.2_wp, 1.0e-12_wp, "a fit")
         do place = 0, 10
            known = sin(0.1_wp*place*h)
            call expect_close(error, series_value(degree, series%coefficients(:, 1), &
                                                  0.1_wp*place*h/unit), known, tolerance, &
                              "place "//text(place))
         end do
      end do
   end subroutine test_fit

   !> The series at a time is known.
   subroutine expect_series(error, context, t, h, unit, skipping, known, what, series, valid_for)
      type(error_type), allocatable, intent(inout) :: error
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: t
      !> Length of the step that reads it
      real(wp), intent(in) :: h
      !> Unit of time, shortened to the time for which the series is valid
      real(wp), intent(in) :: unit
      logical, intent(in) :: skipping
      real(wp), intent(in) :: known(0:)
      character(len=*), intent(in) :: what
      type(delayed_series), intent(out) :: series
      !> Time for which it is valid, if that is known
      real(wp), intent(in), optional :: valid_for
      real(wp) :: found_unit

      series = delayed_series(degree=ubound(known, 1), delays=1)
      call context%go_to(instant(t + lag), h)
      found_unit = unit
      call series%read_past(context, skipping, found_unit)
      call expect_close(error, series%coefficients(:, 1), known, 1.0e-15_wp, what)
      call expect_close(error, found_unit, min(unit, series%valid_for), 0.0_wp, "unit, "//what)
      if (.not. present(valid_for)) return
      call expect_close(error, series%valid_for, valid_for, 1.0e-15_wp, "validity, "//what)
   end subroutine expect_series

   !> Length of a step for which a series agrees with the past.
   subroutine expect_length(error, context, series, unit, tolerance, known)
      type(error_type), allocatable, intent(inout) :: error
      type(step_context), intent(inout) :: context
      type(delayed_series), intent(inout) :: series
      !> Its unit of time, and the length proposed
      real(wp), intent(in) :: unit
      real(wp), intent(in) :: tolerance, known
      real(wp) :: h

      context%tolerance = tolerance_type(3, 0.0_wp, tolerance)
      h = unit
      call series%confirm(context, unit, h)
      call expect_close(error, h, known, 1.0e-15_wp, "length at tolerance "//text(tolerance))
   end subroutine expect_length

   !> A past of steps 1 + t from 0 to 1, and 0.001 more from there to 3.
   function with_two_steps(problem, valid_for) result(context)
      type(wille_baker), intent(in), target :: problem
      !> Time for which the first is valid
      real(wp), intent(in) :: valid_for
      type(step_context) :: context

      context = new_context(problem, 0.0_wp, 0.1_wp, 0.0_wp, 1.0_wp)
      call append(context, 0.0_wp, 1.0_wp, [1.0_wp, 1.0_wp, 0.0_wp], valid_for)
      call append(context, 1.0_wp, 1.0_wp, [2.001_wp, 1.0_wp, 0.0_wp], 2.0_wp)
      call append(context, 2.0_wp, 1.0_wp, [3.001_wp, 1.0_wp, 0.0_wp], 2.0_wp)
   end function with_two_steps

   !> Append a step in powers to the past.
   subroutine append(context, start, length, coefficients, valid_for)
      type(step_context), intent(inout) :: context
      real(wp), intent(in) :: start, length, valid_for
      !> Coefficients, shape (1 + degree)
      real(wp), intent(in) :: coefficients(:)

      call context%past%append(instant(start), length, &
                               spread(0.0_wp, 1, size(coefficients) - 1), &
                               reshape(coefficients, [size(coefficients), 1]), valid_for)
   end subroutine append

   !> A problem of three components with one delay.
   pure type(wille_baker) function delayed() result(problem)

      problem = wille_baker(n=3, lag=[lag], component=[1], past=[-1.0_wp, -2.0_wp, -3.0_wp], &
                            first=[0.0_wp, 0.0_wp, 0.0_wp])
   end function delayed
end module test_dde_past_series
