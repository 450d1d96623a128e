! SPDX-License-Identifier: BSD-3-Clause
!> One scene in RETARD (workers.py): not stiff, the pair of Dormand and Prince.
module retard_scene
   use dde_kinds, only: wp
   use worker_protocol, only: epsilon, gamma, past, sample_time, samples, t_end, tau, xi
   implicit none (type, external)
   private
   public :: integrate_once

   integer, parameter :: n = 3, delayed = 3, most_steps = 10**8, most_stored = 200000
   integer :: next_sample, stored = most_stored
   real(wp) :: last_tolerance = 0.0_wp
   integer :: components(n + 1)
   real(wp) :: dense((5*n + 2)*most_stored)
   common /corei/ components
   common /corer/ dense
   external :: retard
   real(wp), external :: ylag

contains

   !> Integrate the block once.
   subroutine integrate_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer, parameter :: points = 2, parameters = 20
      integer :: i, iwork(20), ipar(1), kept, outcome
      real(wp) :: absolute(1), grid(points), relative(1), rpar(1), t, t_last, &
                  work(8*n + parameters + 1 + points), y(n)

      t = 0.0_wp
      t_last = t_end
      y = past
      relative = tolerance
      absolute = tolerance
      ! at k delays the derivative of theta of order 2k jumps, which matters up to order 5
      grid = [(i*tau, i=1, points)]
      iwork = 0
      work = 0.0_wp
      work(parameters + 1:parameters + points) = grid
      kept = merge(n, 1, allocated(samples))
      components(2) = delayed
      if (abs(tolerance - last_tolerance) > 0.0_wp) stored = most_stored
      iwork(1) = most_steps
      iwork(3) = -1
      iwork(4) = -1
      iwork(5) = kept
      iwork(6) = count(grid > 0.0_wp .and. grid < t_end)
      next_sample = 0
      call retard(n, right_side, t, y, t_last, relative, absolute, 0, take_samples, &
                  merge(1, 0, allocated(samples)), work, size(work), iwork, size(iwork), &
                  (5*kept + 2)*stored, n + 1, rpar, ipar, outcome)
      if (outcome /= 1) failure = "RETARD returned IDID = -"//achar(iachar("0") - outcome)
      ! its preparation costs time that grows with its storage: the next run gets what this one used
      stored = min(most_stored, iwork(19) + 10)
      last_tolerance = tolerance
   end subroutine integrate_once

   !> Equation (4).
   subroutine right_side(m, t, y, f, rpar, ipar)
      integer, intent(in) :: m, ipar(*)
      real(wp), intent(in) :: t, y(m), rpar(*)
      real(wp), intent(out) :: f(m)
      real(wp) :: v, w

      w = y(3)
      if (tau > 0.0_wp) w = ylag(delayed, t - tau, history, rpar, ipar)
      v = exp(y(3))
      f(1) = -v*(y(1) + (1.0_wp + epsilon)*w)
      f(2) = v - 1.0_wp
      f(3) = -gamma**2/v*(y(2) + (y(1) + y(3))/xi)
   end subroutine right_side

   !> The constant past.
   function history(component, t, rpar, ipar) result(value)
      integer, intent(in) :: component, ipar(*)
      real(wp), intent(in) :: t, rpar(*)
      real(wp) :: value

      value = past(component)
   end function history

   !> Samples in a step, from its dense output.
   subroutine take_samples(step, t_old, t, y, m, rpar, ipar, status)
      integer, intent(in) :: step, m, ipar(*)
      real(wp), intent(in) :: t_old, t, y(m), rpar(*)
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
            samples(i, next_sample) = ylag(i, sample_time(next_sample), history, rpar, ipar)
         end do
         next_sample = next_sample + 1
      end do
   end subroutine take_samples
end module retard_scene

program retard_worker
   use retard_scene, only: integrate_once
   use worker_protocol, only: answer_requests
   implicit none (type, external)

   call answer_requests("1995", integrate_once)
end program retard_worker
