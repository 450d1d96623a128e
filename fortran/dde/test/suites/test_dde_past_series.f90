!> The past as Taylor series: of which step, carried how far, and how long they are valid.
module test_dde_past_series
   use dde_cursor, only: cursor_type
   use dde_delayed_series, only: delayed_series
   use dde_history, only: history_type
   use dde_interpolant, only: taylor_coefficients
   use dde_time, only: instant_at
   use dde_tolerance, only: tolerance_type
   use dde_errors, only: text
   use expectations, only: expect_close
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use test_problems, only: wille_baker
   implicit none (type, external)
   private
   public :: collect_dde_past_series

   !> Nodes of a polynomial that is not one of powers.
   real(wp), parameter :: nodes(3) = [0.0_wp, 1.0_wp, 0.0_wp]

contains

   !> All tests of this suite.
   subroutine collect_dde_past_series(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("taylor series", test_series), &
                   new_unittest("zeros above the degree", test_padded), &
                   new_unittest("a second node at 0", test_second_node), &
                   new_unittest("series of the next step", test_next), &
                   new_unittest("series beyond its step", test_disagreement), &
                   new_unittest("series behind a layer", test_layer)]
   end subroutine collect_dde_past_series

   !> One cubic, kept over three nodes that are not all 0 in the first step and in powers in the
   !> second, has the same series wherever one looks, as far as there is place for its terms; and it
   !> is valid for as long as the second step says.
   subroutine test_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(cursor_type) :: cursor
      type(delayed_series) :: first_terms, series
      type(history_type) :: past
      type(wille_baker) :: problem
      real(wp) :: known(0:5), valid_for, unit
      real(wp), parameter :: looks(5) = [0.0_wp, 0.3_wp, 0.5_wp, 0.7_wp, 1.25_wp]
      integer :: i

      ! 1 + 2 t - t^2 + t^3/2 over steps of 0.5 and 1
      problem = delayed()
      past = history_type(problem, instant_at(0.0_wp))
      cursor = cursor_type(problem)
      series = delayed_series(degree=5, delays=1)
      first_terms = delayed_series(degree=1, delays=1)
      call past%append(instant_at(0.0_wp), 0.5_wp, nodes, &
                       reshape([1.0_wp, 0.8125_wp, -0.1875_wp, 0.0625_wp], [4, 1]), &
                       valid_for=0.5_wp)
      call past%append(instant_at(0.5_wp), 1.0_wp, [0.0_wp, 0.0_wp, 0.0_wp], &
                       reshape([1.8125_wp, 1.375_wp, -0.25_wp, 0.5_wp], [4, 1]), valid_for=1.2_wp)
      do i = 1, size(looks)
         associate (t => looks(i))
            call cursor%set(problem, past, instant_at(t + problem%lag(1)), 0.1_wp)
            unit = 0.4_wp
            call series%read_past(problem, past, cursor, .false., unit, valid_for)
            call expect_close(error, unit, min(0.4_wp, valid_for), 0.0_wp, "unit")
            known = [1.0_wp + t*(2.0_wp - t*(1.0_wp - 0.5_wp*t)), 2.0_wp - t*(2.0_wp - 1.5_wp*t), &
                     -1.0_wp + 1.5_wp*t, 0.5_wp, 0.0_wp, 0.0_wp]*unit**[0, 1, 2, 3, 4, 5]
            call expect_close(error, series%coefficients(:, 1), known, 1.0e-15_wp, &
                              "series at t = "//text(t))
            call expect_close(error, valid_for, merge(0.5_wp, 1.7_wp, t < 0.5_wp) - t, 1.0e-15_wp, &
                              "how long it is valid at t = "//text(t))
            call first_terms%read_past(problem, past, cursor, .false., unit, valid_for)
            call expect_close(error, first_terms%coefficients(:, 1), known(:1), 1.0e-15_wp, &
                              "two terms of it")
         end associate
      end do
   end subroutine test_series

   !> A polynomial that a continuation gives back has zeros above its degree, nodes among them.
   subroutine test_padded(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: series(0:12), wider(0:12)
      real(wp), parameter :: coefficients(0:3) = [1.0_wp, 0.8125_wp, -0.1875_wp, 0.0625_wp]
      real(wp), parameter :: none(9) = 0.0_wp

      call taylor_coefficients(3, nodes, .false., coefficients, 0.3_wp, 0.5_wp, series)
      call taylor_coefficients(12, [nodes, none], .false., [coefficients, none], 0.3_wp, &
                               0.5_wp, wider)
      call expect_close(error, wider, series, 1.0e-15_wp, "series")
   end subroutine test_padded

   !> The same polynomial over nodes of which the second is 0 has the same series: it is not one of
   !> powers.
   subroutine test_second_node(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: first(2) = [0.0_wp, 0.5_wp], second(2) = [0.5_wp, 0.0_wp]
      type(cursor_type) :: cursor
      type(delayed_series) :: series(2)
      type(history_type) :: past
      type(wille_baker) :: problem
      real(wp) :: valid_for, unit
      integer :: order

      problem = delayed()
      do order = 1, 2
         past = history_type(problem, instant_at(0.0_wp))
         cursor = cursor_type(problem)
         series(order) = delayed_series(degree=2, delays=1)
         ! 1 + s (s - 1/2), of which the slope at 0 is -1/2
         call past%append(instant_at(0.0_wp), 1.0_wp, merge(first, second, order == 1), &
                          reshape([1.0_wp, 0.0_wp, 1.0_wp], [3, 1]), valid_for=1.0_wp)
         call cursor%set(problem, past, instant_at(2.25_wp), 0.5_wp)
         unit = 1.0_wp
         call series(order)%read_past(problem, past, cursor, .false., unit, valid_for)
      end do
      call expect_close(error, series(2)%coefficients(:, 1), series(1)%coefficients(:, 1), &
                        1.0e-15_wp, "series")
   end subroutine test_second_node

   !> Where the next step begins nearer, its series is read, unless there is a kink between them;
   !> what it departs from the past before it begins must not count.
   subroutine test_next(error)
      type(error_type), allocatable, intent(out) :: error
      type(cursor_type) :: cursor
      type(delayed_series) :: series
      type(history_type) :: past
      type(wille_baker) :: problem
      real(wp) :: h, valid_for, unit

      problem = delayed()
      past = two_steps(problem, valid_for=1.5_wp)
      cursor = cursor_type(problem)
      series = delayed_series(degree=2, delays=1)
      call cursor%set(problem, past, instant_at(2.75_wp), 0.5_wp)
      unit = 0.5_wp
      call series%read_past(problem, past, cursor, .true., unit, valid_for)
      call expect_close(error, series%coefficients(:, 1), [1.751_wp, 0.5_wp, 0.0_wp], 1.0e-15_wp, &
                        "the next, back")
      h = 0.5_wp
      call series%confirm(past, cursor, unit, tolerance_type(problem%n, 0.0_wp, 1.0e-2_wp), h)
      call expect_close(error, h, 0.5_wp, 0.0_wp, "a departure of 0.1 tolerances")
      call series%confirm(past, cursor, unit, tolerance_type(problem%n, 0.0_wp, 1.0e-4_wp), h)
      call expect_close(error, h, 0.0_wp, 0.0_wp, "a departure of 10 tolerances")
      unit = 0.5_wp
      call series%read_past(problem, past, cursor, .false., unit, valid_for)
      call expect_close(error, series%coefficients(:, 1), [1.75_wp, 0.5_wp, 0.0_wp], 1.0e-15_wp, &
                        "the step itself")
      past = two_steps(problem, valid_for=1.0_wp)
      cursor = cursor_type(problem)
      call cursor%set(problem, past, instant_at(2.75_wp), 0.25_wp)
      unit = 0.25_wp
      call series%read_past(problem, past, cursor, .true., unit, valid_for)
      call expect_close(error, series%coefficients(:, 1), [1.75_wp, 0.25_wp, 0.0_wp], 1.0e-15_wp, &
                        "not beyond a kink")
   end subroutine test_next

   !> A series is used beyond its step as far as it agrees with what followed.
   subroutine test_disagreement(error)
      type(error_type), allocatable, intent(out) :: error
      type(cursor_type) :: cursor
      type(delayed_series) :: series
      type(history_type) :: past
      type(wille_baker) :: problem
      real(wp) :: h, valid_for, unit
      real(wp), parameter :: tolerances(2) = [1.0e-2_wp, 1.0e-4_wp], lengths(2) = [1.0_wp, 0.75_wp]
      integer :: i

      problem = delayed()
      past = two_steps(problem, valid_for=1.5_wp)
      cursor = cursor_type(problem)
      series = delayed_series(degree=2, delays=1)
      do i = 1, 2
         call cursor%set(problem, past, instant_at(2.25_wp), 1.0_wp)
         unit = 1.0_wp
         call series%read_past(problem, past, cursor, .true., unit, valid_for)
         call expect_close(error, series%coefficients(:, 1), [1.25_wp, 1.0_wp, 0.0_wp], &
                           1.0e-15_wp, "the step itself")
         h = 1.0_wp
         call series%confirm(past, cursor, unit, &
                             tolerance_type(problem%n, 0.0_wp, tolerances(i)), h)
         call expect_close(error, h, lengths(i), 1.0e-15_wp, "length at "//text(tolerances(i)))
      end do
   end subroutine test_disagreement

   !> Two steps, 1 + t from 0 to 1 and 0.001 more from there to 2.
   function two_steps(problem, valid_for) result(past)
      !> The problem
      type(wille_baker), intent(in) :: problem
      !> Time for which the first is valid
      real(wp), intent(in) :: valid_for
      type(history_type) :: past

      past = history_type(problem, instant_at(0.0_wp))
      call past%append(instant_at(0.0_wp), 1.0_wp, [0.0_wp, 0.0_wp], &
                       reshape([1.0_wp, 1.0_wp, 0.0_wp], [3, 1]), valid_for)
      call past%append(instant_at(1.0_wp), 1.0_wp, [0.0_wp, 0.0_wp], &
                       reshape([2.001_wp, 1.0_wp, 0.0_wp], [3, 1]), valid_for=2.0_wp)
      call past%append(instant_at(2.0_wp), 1.0_wp, [0.0_wp, 0.0_wp], &
                       reshape([3.001_wp, 1.0_wp, 0.0_wp], [3, 1]), valid_for=2.0_wp)
   end function two_steps

   !> Ten steps of 1e-5 that are 0.1 above what follows: passed over where a step of 0.5 is expected
   !> and 1e-5 is less than half the tolerance times its length, not where one of 1e-3 is.
   subroutine test_layer(error)
      type(error_type), allocatable, intent(out) :: error
      type(cursor_type) :: cursor
      type(delayed_series) :: series
      type(history_type) :: past
      type(wille_baker) :: problem
      real(wp) :: h, valid_for, unit
      integer :: i

      problem = delayed()
      past = history_type(problem, instant_at(0.0_wp))
      cursor = cursor_type(problem)
      series = delayed_series(degree=2, delays=1)
      do i = 0, 9
         call past%append(instant_at(i*1.0e-5_wp), 1.0e-5_wp, [0.0_wp, 0.0_wp], &
                          reshape([1.1_wp, 0.0_wp, 0.0_wp], [3, 1]), valid_for=1.0e-4_wp)
      end do
      do i = 0, 1
         call past%append(instant_at(1.0e-4_wp + i), 1.0_wp, [0.0_wp, 0.0_wp], &
                          reshape([1.0_wp, 0.0_wp, 0.0_wp], [3, 1]), valid_for=1.0_wp)
      end do
      call cursor%set(problem, past, instant_at(2.0_wp), 0.5_wp)
      unit = 0.5_wp
      call series%read_past(problem, past, cursor, .true., unit, valid_for)
      call expect_close(error, series%coefficients(:, 1), [1.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, &
                        "behind the layer")
      h = 0.5_wp
      call series%confirm(past, cursor, unit, tolerance_type(problem%n, 0.0_wp, 1.0e-3_wp), h)
      call expect_close(error, h, 0.5_wp, 0.0_wp, "a layer that does not count")
      call series%confirm(past, cursor, unit, tolerance_type(problem%n, 0.0_wp, 1.0e-5_wp), h)
      call expect_close(error, h, 0.0_wp, 0.0_wp, "a layer that counts")
      unit = 1.0e-3_wp
      call series%read_past(problem, past, cursor, .true., unit, valid_for)
      call expect_close(error, series%coefficients(0, 1), 1.1_wp, 1.0e-15_wp, &
                        "where a short step is expected")
   end subroutine test_layer

   !> A problem of three components with one delay.
   pure type(wille_baker) function delayed() result(problem)

      problem = wille_baker(n=3, lag=[2.0_wp], component=[1], past=[-1.0_wp, -2.0_wp, -3.0_wp], &
                            first=[0.0_wp, 0.0_wp, 0.0_wp])
   end function delayed
end module test_dde_past_series
