! SPDX-License-Identifier: BSD-3-Clause
!> One problem in RADAR5, version 2.1 (workers.py): stiff, Radau IIA of order 5. Argument: what
!> the problem gives besides f; in place of a series it gives its derivatives.
module radar5_task
   use dde_kinds, only: wp
   use moving_peers, only: delayed_time_of => delayed_time, derivatives, filled, waltman
   use peer_problems, only: breaks, component, delay_of, delayed, delays, epsilon, finest, gamma, &
                            history, lags, moves, n, problem, slopes, units, xi
   use worker_protocol, only: next_sample, sample_is_due, samples, t_end
   implicit none (type, external)
   private
   public :: given, run_once

   integer, parameter :: most_steps = 10**7, most_stored = 200000, &
                         entries = merge(size(filled, 2), 1, PROBLEM == waltman)
   character(len=16) :: given
   integer :: stored = most_stored
   real(wp) :: last_tolerance = 0.0_wp
   external :: lagr5, radar5
   real(wp), external :: contr5, ylagr5

contains

   !> Integrate the problem once.
   subroutine run_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer :: band(2), iwork(30), k, kept(n), outcome, ipar(1)
      real(wp) :: absolute(n), relative(n), rpar(1), step, t, t_last, work(30), y(n)
      real(wp), allocatable :: points(:)
      logical :: analytic, by_past

      t = 0.0_wp
      t_last = t_end
      call problem%initial(y)
      ! of the stiff block the fast time; where delays move as in its example; 1e-3 else
      step = merge(1e-6_wp, 1e-3_wp, moves)
      if (gamma > 0.0_wp) step = min(step, 1.0_wp/gamma**2)
      relative = tolerance
      absolute = tolerance*finest
      analytic = given /= "f"
      ! without them it does not look for breaking points
      by_past = analytic .or. moves
      ! RADAR5 changes them
      band = n
      points = [breaks, t_end]
      iwork = 0
      work = 0.0_wp
      if (abs(tolerance - last_tolerance) > 0.0_wp) stored = most_stored
      iwork(2) = most_steps
      iwork(12) = stored
      iwork(13) = size(breaks)
      kept = pack([(k, k=1, n)], [(any(component == k), k=1, n)], [(0, k=1, n)])
      iwork(15) = merge(count(kept > 0), 0, delays > 0)
      if (moves) then
         ! as in its example
         work(10:11) = 1.0_wp
         iwork(14) = 2
      end if
      call radar5(n, right_side, history, delayed_time, t, y, t_last, step, relative, absolute, 1, &
                  jacobian, merge(1, 0, analytic), band(1), band(2), delayed_jacobian, &
                  merge(delays, 0, by_past), merge(entries, 0, by_past), 0, &
                  take_samples, merge(1, 0, allocated(samples)), work, iwork, rpar, ipar, &
                  outcome, points, kept, right_side, n, n)
      if (outcome /= 1) failure = "RADAR5 returned IDID = -"//achar(iachar("0") - outcome)
      ! its preparation costs time that grows with its storage: the next run gets what this one used
      stored = min(most_stored, iwork(17) + 10)
      last_tolerance = tolerance
   end subroutine run_once

   !> f(t, y, z).
   subroutine right_side(m, t, y, f, lag, phi, rpar, ipar, dense, ipast, nrds)
      integer, intent(in) :: m, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(m), rpar(*), dense(*)
      real(wp), intent(out) :: f(m)
      external :: lag, phi
      real(wp) :: z(delayed)

      call delayed_values(t, y, z, rpar, ipar, dense, ipast, nrds)
      call slopes(t, y, z, f)
   end subroutine right_side

   !> Derivatives by y.
   subroutine jacobian(m, t, y, by_y, rows, lag, phi, rpar, ipar, dense, ipast, nrds)
      integer, intent(in) :: m, rows, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(m), rpar(*), dense(*)
      real(wp), intent(out) :: by_y(rows, m)
      external :: lag, phi
      real(wp) :: by_z(n, delayed), stiffness, v, z(delayed)

      call delayed_values(t, y, z, rpar, ipar, dense, ipast, nrds)
      if (moves) then
         call derivatives(t, y, z, by_y, by_z)
         return
      end if
      v = exp(y(3))
      stiffness = gamma**2/v
      by_y(1, :) = [-v, 0.0_wp, -v*(y(1) + (1.0_wp + epsilon)*z(1))]
      if (delays == 0) by_y(1, 3) = by_y(1, 3) - v*(1.0_wp + epsilon)
      by_y(2, :) = [0.0_wp, 0.0_wp, v]
      by_y(3, :) = [-stiffness/xi, -stiffness, stiffness*(y(2) + (y(1) + y(3) - 1.0_wp)/xi)]
   end subroutine jacobian

   !> Derivatives by delayed values; of the block only that of theta' by w(t - tau).
   subroutine delayed_jacobian(m, t, y, by_z, lag, phi, row, column, delay, rpar, ipar, dense, &
                               ipast, nrds)
      integer, intent(in) :: m, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(m), rpar(*), dense(*)
      real(wp), intent(out) :: by_z(entries)
      integer, intent(out) :: row(entries), column(entries), delay(entries)
      external :: lag, phi
      real(wp) :: all_by_y(n, n), all_by_z(n, delayed), z(delayed)
      integer :: k

      if (moves) then
         call delayed_values(t, y, z, rpar, ipar, dense, ipast, nrds)
         call derivatives(t, y, z, all_by_y, all_by_z)
         do k = 1, entries
            row(k) = filled(1, k)
            column(k) = component(filled(2, k))
            delay(k) = delay_of(filled(2, k))
            by_z(k) = all_by_z(row(k), filled(2, k))
         end do
         return
      end if
      delay(1) = 1
      row(1) = 1
      column(1) = 3
      by_z(1) = -exp(y(3))*(1.0_wp + epsilon)
   end subroutine delayed_jacobian

   !> The delayed values.
   subroutine delayed_values(t, y, z, rpar, ipar, dense, ipast, nrds)
      integer, intent(in) :: ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(*), rpar(*), dense(*)
      real(wp), intent(inout) :: z(delayed)
      integer :: k, place
      real(wp) :: share

      z(1) = y(component(1))
      do k = 1, merge(delayed, 0, delays > 0)
         if (all(delay_of(:k - 1) /= delay_of(k))) then
            call lagr5(delay_of(k), t, y, delayed_time, dense, share, place, rpar, ipar, history, &
                       ipast, nrds)
         end if
         z(k) = ylagr5(component(k), share, place, history, rpar, ipar, dense, ipast, nrds)
      end do
   end subroutine delayed_values

   !> t minus a delay.
   function delayed_time(delay, t, y, rpar, ipar, phi, dense, ipast, nrds) result(time)
      integer, intent(in) :: delay, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(n), rpar(*), dense(*)
      external :: phi
      real(wp) :: time

      if (moves) then
         time = delayed_time_of(delay, t, y)
      else
         time = t - lags(delay)
      end if
   end function delayed_time

   !> Samples in a step, from its dense output.
   subroutine take_samples(step, t_old, t, h, y, coefficients, size_of_coefficients, m, rpar, &
                           ipar, status)
      integer, intent(in) :: step, size_of_coefficients, m, ipar(*)
      real(wp), intent(in) :: t_old, t, h, y(m), coefficients(size_of_coefficients), rpar(*)
      integer, intent(inout) :: status
      integer :: i

      if (step == 1) then
         samples(1:, 0) = y/units
         next_sample = 1
      end if
      do while (sample_is_due(t))
         do i = 1, m
            samples(i, next_sample) = contr5(i, m, samples(0, next_sample), coefficients, t, &
                                             h)/units(i)
         end do
         next_sample = next_sample + 1
      end do
   end subroutine take_samples
end module radar5_task

program radar5_worker
   use peer_problems, only: n, prepare
   use radar5_task, only: given, run_once
   use worker_protocol, only: answer_requests
   implicit none (type, external)

   call get_command_argument(1, given)
   call prepare(trim(given))
   call answer_requests("2.1", n, run_once)
end program radar5_worker
