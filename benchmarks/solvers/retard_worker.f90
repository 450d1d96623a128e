! SPDX-License-Identifier: BSD-3-Clause
!> One problem in RETARD (workers.py): not stiff, the pair of Dormand and Prince. It uses
!> f alone, whatever the argument says.
module retard_task
   use dde_kinds, only: wp
   use moving_peers, only: delayed_time
   use peer_problems, only: breaks, component, delay_of, delayed, delays, history, lags, moves, n, &
                            problem, slopes
   use worker_protocol, only: next_sample, sample_is_due, samples, t_end
   implicit none (type, external)
   private
   public :: run_once

   integer, parameter :: most_steps = 10**8, most_stored = 200000
   integer :: components(n + 1), stored = most_stored
   real(wp) :: last_tolerance = 0.0_wp
   real(wp) :: dense((5*n + 2)*most_stored)
   common /corei/ components
   common /corer/ dense
   external :: retard
   real(wp), external :: ylag

contains

   !> Integrate the problem once.
   subroutine run_once(tolerance, failure)
      real(wp), intent(in) :: tolerance
      character(len=:), allocatable, intent(out) :: failure
      integer, parameter :: parameters = 20
      integer :: iwork(20), ipar(1), k, kept, outcome
      real(wp) :: absolute(1), relative(1), rpar(1), t, t_last, y(n)
      real(wp), allocatable :: work(:)

      t = 0.0_wp
      t_last = t_end
      call problem%initial(y)
      relative = tolerance
      absolute = tolerance
      allocate (work(8*n + parameters + 1 + size(breaks)), source=0.0_wp)
      iwork = 0
      work(parameters + 1:parameters + size(breaks)) = breaks
      kept = n
      if (.not. allocated(samples)) then
         kept = count([(any(component == k), k=1, n)])
         components(2:kept + 1) = pack([(k, k=1, n)], [(any(component == k), k=1, n)])
      end if
      if (abs(tolerance - last_tolerance) > 0.0_wp) stored = most_stored
      iwork(1) = most_steps
      iwork(3) = -1
      iwork(4) = -1
      iwork(5) = kept
      iwork(6) = size(breaks)
      call retard(n, right_side, t, y, t_last, relative, absolute, 0, take_samples, &
                  merge(1, 0, allocated(samples)), work, size(work), iwork, size(iwork), &
                  (5*kept + 2)*stored, n + 1, rpar, ipar, outcome)
      if (outcome /= 1) failure = "RETARD returned IDID = -"//achar(iachar("0") - outcome)
      ! its preparation costs time that grows with its storage: the next run gets what this one used
      stored = min(most_stored, iwork(19) + 10)
      last_tolerance = tolerance
   end subroutine run_once

   !> f(t, y, z).
   subroutine right_side(m, t, y, f, rpar, ipar)
      integer, intent(in) :: m, ipar(*)
      real(wp), intent(in) :: t, y(m), rpar(*)
      real(wp), intent(out) :: f(m)
      real(wp) :: time, z(delayed)
      integer :: k

      z(1) = y(component(1))
      if (delays > 0) then
         do k = 1, delayed
            time = t - lags(k)
            if (moves) time = delayed_time(delay_of(k), t, y)
            z(k) = ylag(component(k), time, history, rpar, ipar)
         end do
      end if
      call slopes(t, y, z, f)
   end subroutine right_side

   !> Samples in a step, from its dense output.
   subroutine take_samples(step, t_old, t, y, m, rpar, ipar, status)
      integer, intent(in) :: step, m, ipar(*)
      real(wp), intent(in) :: t_old, t, y(m), rpar(*)
      integer, intent(inout) :: status
      integer :: i

      if (step == 1) then
         samples(1:, 0) = y
         next_sample = 1
      end if
      do while (sample_is_due(t))
         do i = 1, m
            samples(i, next_sample) = ylag(i, samples(0, next_sample), history, rpar, ipar)
         end do
         next_sample = next_sample + 1
      end do
   end subroutine take_samples
end module retard_task

program retard_worker
   use peer_problems, only: n, prepare
   use retard_task, only: run_once
   use worker_protocol, only: answer_requests
   implicit none (type, external)

   call prepare("f")
   call answer_requests("1995", n, run_once)
end program retard_worker
