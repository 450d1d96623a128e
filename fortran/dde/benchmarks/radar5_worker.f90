! SPDX-License-Identifier: BSD-3-Clause
!> One scene in RADAR5, version 2.1 (workers.py): stiff, Radau IIA of order 5.
module radar5_scene
   use dde_kinds, only: wp
   use worker_protocol, only: epsilon, gamma, past, sample_time, samples, t_end, tau, xi
   implicit none (type, external)
   private
   public :: integrate_once

   integer, parameter :: n = 3, delayed = 3, most_steps = 10**7, most_stored = 200000
   integer :: next_sample, stored = most_stored
   real(wp) :: last_tolerance = 0.0_wp
   external :: lagr5, radar5
   real(wp), external :: contr5, ylagr5

contains

   !> Integrate the block once.
   subroutine integrate_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer, parameter :: points = 2
      integer :: band(2), delays, i, iwork(30), outcome, past_components(2), ipar(1)
      real(wp) :: absolute(1), grid(points + 1), relative(1), rpar(1), step, t, t_last, &
                  work(30), y(n)

      t = 0.0_wp
      t_last = t_end
      y = past
      step = min(1e-3_wp, 1.0_wp/gamma**2)
      relative = tolerance
      absolute = tolerance
      ! at k delays the derivative of theta of order 2k jumps, which matters up to order 5
      grid = [(i*tau, i=1, points), t_end]
      band = n
      iwork = 0
      work = 0.0_wp
      delays = merge(1, 0, tau > 0.0_wp)
      if (abs(tolerance - last_tolerance) > 0.0_wp) stored = most_stored
      past_components(1) = delayed
      iwork(2) = most_steps
      iwork(12) = stored
      iwork(13) = count(grid(:points) > 0.0_wp .and. grid(:points) < t_end)
      iwork(15) = 1
      next_sample = 0
      call radar5(n, right_side, history, delayed_time, t, y, t_last, step, relative, absolute, 0, &
                  jacobian, 1, band(1), band(2), delayed_jacobian, delays, delays, 0, &
                  take_samples, merge(1, 0, allocated(samples)), work, iwork, rpar, ipar, &
                  outcome, grid, past_components, right_side, n, n)
      if (outcome /= 1) failure = "RADAR5 returned IDID = -"//achar(iachar("0") - outcome)
      ! its preparation costs time that grows with its storage: the next run gets what this one used
      stored = min(most_stored, iwork(17) + 10)
      last_tolerance = tolerance
   end subroutine integrate_once

   !> Equation (4).
   subroutine right_side(m, t, y, f, lag, phi, rpar, ipar, dense, ipast, nrds)
      integer, intent(in) :: m, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(m), rpar(*), dense(*)
      real(wp), intent(out) :: f(m)
      external :: lag, phi
      real(wp) :: v

      v = exp(y(3))
      f(1) = -v*(y(1) + (1.0_wp + epsilon)*delayed_w(t, y, rpar, ipar, dense, ipast, nrds))
      f(2) = v - 1.0_wp
      f(3) = -gamma**2/v*(y(2) + (y(1) + y(3))/xi)
   end subroutine right_side

   !> Derivatives by y.
   subroutine jacobian(m, t, y, by_y, rows, lag, phi, rpar, ipar, dense, ipast, nrds)
      integer, intent(in) :: m, rows, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(m), rpar(*), dense(*)
      real(wp), intent(out) :: by_y(rows, m)
      external :: lag, phi
      real(wp) :: stiffness, v

      v = exp(y(3))
      stiffness = gamma**2/v
      by_y(1, :) = [-v, 0.0_wp, -v*(y(1) + (1.0_wp + epsilon) &
                                    *delayed_w(t, y, rpar, ipar, dense, ipast, nrds))]
      if (.not. tau > 0.0_wp) by_y(1, 3) = by_y(1, 3) - v*(1.0_wp + epsilon)
      by_y(2, :) = [0.0_wp, 0.0_wp, v]
      by_y(3, :) = [-stiffness/xi, -stiffness, stiffness*(y(2) + (y(1) + y(3) - 1.0_wp)/xi)]
   end subroutine jacobian

   !> Derivative of theta' by w(t - tau).
   subroutine delayed_jacobian(m, t, y, by_z, lag, phi, row, column, delay, rpar, ipar, dense, &
                               ipast, nrds)
      integer, intent(in) :: m, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(m), rpar(*), dense(*)
      real(wp), intent(out) :: by_z(1)
      integer, intent(out) :: row(1), column(1), delay(1)
      external :: lag, phi

      delay(1) = 1
      row(1) = 1
      column(1) = delayed
      by_z(1) = -exp(y(3))*(1.0_wp + epsilon)
   end subroutine delayed_jacobian

   !> w(t - tau).
   function delayed_w(t, y, rpar, ipar, dense, ipast, nrds) result(w)
      integer, intent(in) :: ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(n), rpar(*), dense(*)
      integer :: place
      real(wp) :: share, w

      w = y(3)
      if (.not. tau > 0.0_wp) return
      call lagr5(1, t, y, delayed_time, dense, share, place, rpar, ipar, history, ipast, nrds)
      w = ylagr5(delayed, share, place, history, rpar, ipar, dense, ipast, nrds)
   end function delayed_w

   !> t - tau.
   function delayed_time(delay, t, y, rpar, ipar, phi, dense, ipast, nrds) result(time)
      integer, intent(in) :: delay, ipar(*), ipast(*), nrds
      real(wp), intent(in) :: t, y(n), rpar(*), dense(*)
      external :: phi
      real(wp) :: time

      time = t - tau
   end function delayed_time

   !> The constant past.
   function history(component, t, rpar, ipar) result(value)
      integer, intent(in) :: component, ipar(*)
      real(wp), intent(in) :: t, rpar(*)
      real(wp) :: value

      value = past(component)
   end function history

   !> Samples in a step, from its dense output.
   subroutine take_samples(step, t_old, t, h, y, coefficients, size_of_coefficients, m, rpar, &
                           ipar, status)
      integer, intent(in) :: step, size_of_coefficients, m, ipar(*)
      real(wp), intent(in) :: t_old, t, h, y(m), coefficients(size_of_coefficients), rpar(*)
      integer, intent(inout) :: status
      integer :: i

      if (step == 1) then
         samples(:, 0) = y
         next_sample = 1
         return
      end if
      do while (next_sample <= ubound(samples, 2))
         if (sample_time(next_sample) > t + 1e-13_wp*t_end) exit
         do i = 1, m
            samples(i, next_sample) = contr5(i, m, sample_time(next_sample), coefficients, t, h)
         end do
         next_sample = next_sample + 1
      end do
   end subroutine take_samples
end module radar5_scene

program radar5_worker
   use radar5_scene, only: integrate_once
   use worker_protocol, only: answer_requests
   implicit none (type, external)

   call answer_requests("2.1", integrate_once)
end program radar5_worker
