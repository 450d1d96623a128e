!> The dense output of accepted steps: events go to the watcher, samples to the sampler, and the
!> polynomials of delayed components to the past.
module dde_output
   use dde_cursor, only: cursor_type
   use dde_event_search, only: event_search
   use dde_events, only: event_watcher_type
   use dde_history, only: history_type
   use dde_interpolant, only: highest_degree, newton_value
   use dde_problem, only: dde_problem_type
   use dde_sampler, only: sampler_type
   use dde_step, only: step_type
   use dde_time, only: elapsed, instant, instant_at, later
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: deliver, sample_start

contains

   !> Deliver the dense output of an accepted step. It is made only if someone wants it.
   subroutine deliver(problem, step, past, cursor, work, search, start, step_end, smooth, ended, &
                      sampler, watcher)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step, accepted and complete
      class(step_type), intent(inout) :: step
      !> The past
      type(history_type), intent(inout) :: past
      !> The cursor, on this step
      type(cursor_type), intent(inout) :: cursor
      !> Work so far
      type(work_type), intent(inout) :: work
      !> The search for events, begun if there is a watcher
      type(event_search), intent(inout) :: search
      !> Start of the step
      type(instant), intent(in) :: start
      !> Its end; the event that ends the run, if one does
      type(instant), intent(inout) :: step_end
      !> Time from the start to the next kink: no polynomial is valid beyond it
      real(wp), intent(in) :: smooth
      !> Whether an event ends the run
      logical, intent(out) :: ended
      !> Receiver of samples
      class(sampler_type), intent(inout), optional :: sampler
      !> Receiver of events
      class(event_watcher_type), intent(inout), optional :: watcher
      logical :: delayed, sampled
      real(wp) :: share

      delayed = size(problem%lag) > 0
      sampled = .false.
      if (present(sampler)) sampled = elapsed(instant_at(sampler%next), step_end) >= 0.0_wp
      if (delayed .or. sampled .or. present(watcher)) call step%extend(problem, past, cursor, work)
      ended = .false.
      share = 1.0_wp
      if (present(watcher)) then
         call search%search_step(watcher, step, start, step_end, share, ended)
      end if
      if (sampled) call sample(sampler, step, start, step_end)
      if (delayed .and. share > 0.0_wp) then
         call remember(past, step, start, smooth, share)
         call past%forget(later(step_end, -maxval(problem%lag)))
      end if
   end subroutine deliver

   !> Append the delayed components' dense output to the past.
   pure subroutine remember(past, step, start, smooth, share)
      !> The past
      type(history_type), intent(inout) :: past
      !> The step, extended
      class(step_type), intent(in) :: step
      !> Start of the step
      type(instant), intent(in) :: start
      !> Time from there on without a kink
      real(wp), intent(in) :: smooth
      !> Share of the step that belongs to the run, > 0
      real(wp), intent(in) :: share
      integer :: i, j, slot

      if (share < 1.0_wp) then
         ! the same polynomial over a shorter step
         call past%open_slot(start, share*step%h, step%nodes/share, step%powers, 0.0_wp, slot)
      else
         call past%open_slot(start, step%h, step%nodes, step%powers, min(step%valid_for, smooth), &
                             slot)
      end if
      do i = 1, size(past%kept)
         call step%interpolant(past%kept(i), past%coefficients(:size(step%nodes), i, slot))
      end do
      if (share < 1.0_wp) then
         do j = 1, size(step%nodes)
            past%coefficients(j, :, slot) = share**j*past%coefficients(j, :, slot)
         end do
      end if
   end subroutine remember

   !> The first samples: those at (or before) the first instant.
   subroutine sample_start(sampler, start, y)
      !> Receiver
      class(sampler_type), intent(inout) :: sampler
      !> First instant
      type(instant), intent(in) :: start
      !> State there, shape (n)
      real(wp), intent(in) :: y(:)

      do while (elapsed(instant_at(sampler%next), start) >= 0.0_wp)
         call sampler%take(y(sampler%wanted))
      end do
   end subroutine sample_start

   !> The samples that lie in an accepted and extended step.
   subroutine sample(sampler, step, start, step_end)
      !> Receiver
      class(sampler_type), intent(inout) :: sampler
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Where the run stands after it
      type(instant), intent(in) :: step_end
      real(wp) :: s
      integer :: degree, i

      degree = size(step%nodes)
      if (.not. allocated(sampler%values_here)) then
         allocate (sampler%values_here(size(sampler%wanted)))
         allocate (sampler%dense(0:highest_degree, size(sampler%wanted)))
      end if
      do i = 1, size(sampler%wanted)
         call step%interpolant(sampler%wanted(i), sampler%dense(:degree, i))
      end do
      do while (elapsed(instant_at(sampler%next), step_end) >= 0.0_wp)
         s = elapsed(start, instant_at(sampler%next))/step%h
         do i = 1, size(sampler%wanted)
            sampler%values_here(i) = newton_value(degree, step%nodes, sampler%dense(:, i), s)
         end do
         call sampler%take(sampler%values_here)
      end do
   end subroutine sample
end module dde_output
