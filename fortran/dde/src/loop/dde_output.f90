! SPDX-License-Identifier: BSD-3-Clause
!> The output of a run: events go to the watcher, samples to the sampler, and the polynomials of the
!> components that are kept to the past.
module dde_output
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree, newton_state
   use dde_run, only: run_type
   use dde_sampler, only: sampler_type
   use dde_step, only: step_type
   use dde_time, only: elapsed, instant, later
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: begin_output, deliver, is_read

contains

   !> Pass on the first samples, those at (or before) the initial time, and begin the search for
   !> events.
   subroutine begin_output(run)
      !> The run at its start
      type(run_type), intent(inout) :: run

      if (associated(run%sampler)) then
         do while (sample_is_due(run%sampler, run%now))
            call run%sampler%take(run%step%y(run%sampler%wanted))
         end do
      end if
      if (associated(run%watcher)) then
         call run%search%begin(run%watcher, run%now, run%step%y, run%first_slope)
      end if
   end subroutine begin_output

   !> Whether the planned step is read between its ends: as the past, at samples, by events.
   logical function is_read(run) result(value)
      !> The run at the start of the step
      type(run_type), intent(in) :: run

      value = size(run%context%past%kept) > 0 .or. associated(run%watcher) &
              .or. size(run%sides%above) > 0
      if (.not. associated(run%sampler)) return
      call run%sampler%limit_next(run%now%hi, run%next%h)
      value = value .or. sample_is_due(run%sampler, run%next%finish)
   end function is_read

   !> Whether the next sample is at a time or before.
   pure logical function sample_is_due(sampler, time) result(value)
      class(sampler_type), intent(in) :: sampler
      type(instant), intent(in) :: time

      value = elapsed(instant(sampler%next), time) >= 0.0_wp
   end function sample_is_due

   !> Pass on the dense output of an accepted step, as far as it is read. Where f changes its side,
   !> or an event ends the run, the step ends before the end that was planned.
   subroutine deliver(run, ended)
      !> The run at the start of the step, which is accepted
      type(run_type), intent(inout) :: run
      !> Whether an event ends the run
      logical, intent(out) :: ended
      real(wp) :: last, share

      ended = .false.
      share = 1.0_wp
      associate (step_end => run%next%finish, landing => run%next%landing)
         if (size(run%sides%above) > 0) then
            share = run%sides%share
            step_end = run%sides%finish
         end if
         if (associated(run%watcher) .and. share + run%sides%margin > 0.0_wp) then
            call run%search%search_step(run%watcher, run%step, run%now, step_end, share, &
                                        run%sides%margin/run%step%h, ended)
            ! an event that changes the state there does so yet
            if (ended .and. (share < run%sides%share .or. .not. run%sides%margin > 0.0_wp)) then
               run%sides%passed = .false.
            end if
         end if
         if (any(run%sides%passed)) then
            landing = landing .and. .not. elapsed(step_end, run%points%at(run%next%goal)) > 0.0_wp
         end if
         landing = landing .and. .not. ended
         if (associated(run%sampler)) then
            last = -huge(1.0_wp)
            if (run%sides%margin > 0.0_wp) then
               ! the state may jump there: a sample just before it
               last = step_end%hi - 2.0_wp*spacing(step_end%hi)
               call run%sampler%limit_next(last, 0.0_wp)
            end if
            if (sample_is_due(run%sampler, step_end)) then
               call sample(run%sampler, run%step, run%now, step_end, last)
            end if
         end if
         if (size(run%context%past%kept) > 0 .and. share > 0.0_wp) then
            ! no polynomial is valid beyond the next kink
            call remember(run%context%past, run%step, run%now, run%points%time_to_next(run%now), &
                          share)
            if (run%reach < huge(1.0_wp)) call run%context%past%forget(later(step_end, -run%reach))
         end if
      end associate
   end subroutine deliver

   !> Append the dense output of the components that are kept to the past.
   pure subroutine remember(past, step, start, smooth, share)
      type(history_type), intent(inout) :: past
      class(step_type), intent(in) :: step
      type(instant), intent(in) :: start
      !> Time from there on without a kink
      real(wp), intent(in) :: smooth
      !> Share of the step that belongs to the run, > 0
      real(wp), intent(in) :: share
      integer :: degree, i, j, place

      degree = size(step%nodes)
      if (share < 1.0_wp) then
         ! the same polynomial over a shorter step
         call past%open_step(start, share*step%h, step%nodes/share, step%powers, 0.0_wp, place)
      else
         call past%open_step(start, step%h, step%nodes, step%powers, min(step%valid_for, smooth), &
                             place)
      end if
      associate (a => past%stored(place)%a)
         do i = 1, size(past%kept)
            call step%interpolant(past%kept(i), a(:degree, i))
            if (share < 1.0_wp) a(1:degree, i) = [(share**j*a(j, i), j=1, degree)]
         end do
      end associate
   end subroutine remember

   !> The samples that lie in an accepted step.
   subroutine sample(sampler, step, start, step_end, last)
      class(sampler_type), intent(inout) :: sampler
      class(step_type), intent(in) :: step
      type(instant), intent(in) :: start
      !> Where the run stands after it
      type(instant), intent(in) :: step_end
      !> A sampler that follows the steps takes one behind this time
      real(wp), intent(in) :: last
      real(wp) :: s, slope, time
      integer :: degree, i

      degree = size(step%nodes)
      if (.not. allocated(sampler%values_here)) then
         allocate (sampler%values_here(size(sampler%wanted)))
         allocate (sampler%dense(0:highest_degree, size(sampler%wanted)))
      end if
      do i = 1, size(sampler%wanted)
         call step%interpolant(sampler%wanted(i), sampler%dense(:degree, i))
      end do
      do while (sample_is_due(sampler, step_end))
         time = sampler%next
         s = elapsed(start, instant(time))/step%h
         do i = 1, size(sampler%wanted)
            call newton_state(step%nodes, sampler%dense(:degree, i), s, sampler%values_here(i), &
                              slope)
         end do
         call sampler%take(sampler%values_here)
         call sampler%limit_next(time, step%h)
         if (time < last) call sampler%limit_next(last, 0.0_wp)
      end do
   end subroutine sample
end module dde_output
