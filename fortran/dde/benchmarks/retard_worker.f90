! SPDX-License-Identifier: BSD-3-Clause
!> One problem in RETARD (workers.py): not stiff, the pair of Dormand and Prince. It uses
!> f alone, whatever the argument says.
module retard_scene
   use dde_kinds, only: wp
   use peer_problems, only: breaking_points, component, delayed, n, slopes
   use test_problems, only: constant_past
   use worker_protocol, only: sample_time, samples, t_end
   implicit none (type, external)
   private
   public :: integrate_once, prepare, problem

   integer, parameter :: most_steps = 10**8, most_stored = 200000
   !> The problem
   class(constant_past), allocatable :: problem
   !> The same as this solver holds it
   integer :: delays
   real(wp) :: lags(delayed), past(n)
   real(wp), allocatable :: grid(:)
   integer :: next_sample, stored = most_stored
   real(wp) :: last_tolerance = 0.0_wp
   integer :: components(n + 1)
   real(wp) :: dense((5*n + 2)*most_stored)
   common /corei/ components
   common /corer/ dense
   external :: retard
   real(wp), external :: ylag

contains

   !> Keep what does not change from run to run.
   subroutine prepare()
      delays = size(problem%lag)
      lags(:delays) = problem%lag
      past = problem%past
      grid = breaking_points(problem%lag, t_end)
   end subroutine prepare

   !> Integrate the problem once.
   subroutine integrate_once(tolerance, failure)
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
      allocate (work(8*n + parameters + 1 + size(grid)), source=0.0_wp)
      iwork = 0
      work(parameters + 1:parameters + size(grid)) = grid
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
      iwork(6) = size(grid)
      next_sample = 0
      call retard(n, right_side, t, y, t_last, relative, absolute, 0, take_samples, &
                  merge(1, 0, allocated(samples)), work, size(work), iwork, size(iwork), &
                  (5*kept + 2)*stored, n + 1, rpar, ipar, outcome)
      if (outcome /= 1) failure = "RETARD returned IDID = -"//achar(iachar("0") - outcome)
      ! its preparation costs time that grows with its storage: the next run gets what this one used
      stored = min(most_stored, iwork(19) + 10)
      last_tolerance = tolerance
   end subroutine integrate_once

   !> f(t, y, z).
   subroutine right_side(m, t, y, f, rpar, ipar)
      integer, intent(in) :: m, ipar(*)
      real(wp), intent(in) :: t, y(m), rpar(*)
      real(wp), intent(out) :: f(m)
      real(wp) :: z(n)
      integer :: k

      z(1) = y(component(1))
      if (delays > 0) then
         do k = 1, delayed
            z(k) = ylag(component(k), t - lags(k), history, rpar, ipar)
         end do
      end if
      call slopes(y, z, f)
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
   use peer_problems, only: problem_of
   use retard_scene, only: integrate_once, prepare, problem
   use worker_protocol, only: answer_requests, read_scene
   implicit none (type, external)

   call read_scene()
   call problem_of("f", problem)
   call prepare()
   call answer_requests("1995", problem%n, integrate_once)
end program retard_worker
