! SPDX-License-Identifier: BSD-3-Clause
!> The dense output of accepted steps: events go to the watcher, samples to the sampler, and the
!> polynomials of the components that are kept to the past.
module dde_output
   use dde_events, only: event_watcher_type
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree, newton_state
   use dde_run, only: run_type
   use dde_sampler, only: sampler_type
   use dde_step, only: step_type
   use dde_time, only: elapsed, instant, later
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: deliver, is_read

contains

   !> Whether a step up to `step_end` is read between its ends: as the past, at samples, by events.
   logical function is_read(run, h, step_end, sampler, watcher) result(value)
      !> The run at the start of the step
      class(run_type), intent(in) :: run
      !> Length of the step
      real(wp), intent(in) :: h
      !> End of the step
      type(instant), intent(in) :: step_end
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(in), optional :: watcher

      value = size(run%context%past%kept) > 0 .or. present(watcher) .or. size(run%sides%above) > 0
      if (.not. present(sampler)) return
      call limit_next(sampler, run%now%hi, h)
      value = value .or. sample_is_due(sampler, step_end)
   end function is_read

   !> Whether the next sample is at a time or before.
   pure logical function sample_is_due(sampler, time) result(value)
      class(sampler_type), intent(in) :: sampler
      type(instant), intent(in) :: time

      value = elapsed(instant(sampler%next), time) >= 0.0_wp
   end function sample_is_due

   !> Pass on the dense output of an accepted step, as far as it is read.
   subroutine deliver(run, step_end, ended, sampler, watcher)
      !> The run at the start of the step, which is accepted
      class(run_type), intent(inout) :: run
      !> End of the step; where f changes its side, or the event that ends the run, if one does
      type(instant), intent(inout) :: step_end
      !> Whether an event ends the run
      logical, intent(out) :: ended
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(inout), optional :: watcher
      real(wp) :: share

      ended = .false.
      share = 1.0_wp
      if (size(run%sides%above) > 0) then
         call run%sides%end_step(run%context, run%step, run%now, step_end, share)
      end if
      if (present(watcher) .and. share > 0.0_wp) then
         call run%search%search_step(watcher, run%step, run%now, step_end, share, ended)
         if (ended) run%sides%passed = .false.
      end if
      if (present(sampler)) then
         if (sample_is_due(sampler, step_end)) call sample(sampler, run%step, run%now, step_end)
      end if
      if (size(run%context%past%kept) > 0 .and. share > 0.0_wp) then
         ! no polynomial is valid beyond the next kink
         call remember(run%context%past, run%step, run%now, run%points%time_to_next(run%now), share)
         if (run%reach < huge(1.0_wp)) call run%context%past%forget(later(step_end, -run%reach))
      end if
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
      real(wp) :: a(0:highest_degree)
      integer :: degree, i, j

      degree = size(step%nodes)
      if (share < 1.0_wp) then
         ! the same polynomial over a shorter step
         call past%open_step(start, share*step%h, step%nodes/share, step%powers, 0.0_wp)
      else
         call past%open_step(start, step%h, step%nodes, step%powers, min(step%valid_for, smooth))
      end if
      do i = 1, size(past%kept)
         call step%interpolant(past%kept(i), a(:degree))
         if (share < 1.0_wp) a(1:degree) = [(share**j*a(j), j=1, degree)]
         call past%fill(i, a(:degree))
      end do
   end subroutine remember

   !> The samples that lie in an accepted step.
   subroutine sample(sampler, step, start, step_end)
      class(sampler_type), intent(inout) :: sampler
      class(step_type), intent(in) :: step
      type(instant), intent(in) :: start
      !> Where the run stands after it
      type(instant), intent(in) :: step_end
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
         call limit_next(sampler, time, step%h)
      end do
   end subroutine sample

   !> Let the next sample follow a time by no more than the sampler's share of the step.
   pure subroutine limit_next(sampler, time, step_size)
      class(sampler_type), intent(inout) :: sampler
      real(wp), intent(in) :: time, step_size

      if (sampler%share_of_step >= huge(1.0_wp)) return
      sampler%next = min(sampler%next, time + max(sampler%share_of_step*step_size, spacing(time)))
   end subroutine limit_next
end module dde_output
