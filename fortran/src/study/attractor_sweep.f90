!> Attractors along a sweep: each point starts where the one before ended, with all of its past, so
!> that the block stays on its attractor as long as that exists.
module attractor_sweep
   use attractor_points, only: finding_type, point_type
   use attractors, only: attractor_settings_type, find_attractor
   use block_parameters, only: block_history_type
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use progress_receiver, only: progress_receiver_type
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: sweep_attractors

   !> Change of u from point to point. Without it the block would stay in steady sliding where that
   !> is unstable.
   real(wp), parameter :: disturbance = 1.0e-2_wp

contains

   !> Find the attractors of points in turn. The first point starts from its history. After a point
   !> whose run fails, the next starts from where that one did.
   subroutine sweep_attractors(points, settings, options, findings, progress)
      !> Points, in the order of the sweep
      type(point_type), intent(in) :: points(:)
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What was found, one each
      type(finding_type), allocatable, intent(out) :: findings(:)
      !> Receiver of the number of points done
      class(progress_receiver_type), intent(inout), optional :: progress
      type(block_history_type) :: history
      type(continuation_type) :: arrived, start
      type(spring_block_type) :: block_model
      integer :: i

      allocate (findings(size(points)))
      history = points(1)%history
      do i = 1, size(points)
         block_model = spring_block_type(points(i)%parameters, history)
         call find_attractor(block_model, settings, options, findings(i)%attractor, &
                             findings(i)%problem, start, arrived)
         if (i < size(points) .and. .not. allocated(findings(i)%problem)) then
            call hand_over(block_model, points(i + 1), maxval(points%parameters%tau), options, &
                           arrived, history, start)
         end if
         if (present(progress)) call progress%advance(i, size(points))
      end do
   end subroutine sweep_attractors

   !> Where the next point starts. A run on at the old parameters makes the past as long as the
   !> longest delay of the sweep. There is no past to hand over between a block without delay and
   !> one with a delay: then the last state holds for t <= 0.
   subroutine hand_over(block_model, next, longest_delay, options, arrived, history, start)
      !> The block of this point
      type(spring_block_type), intent(in) :: block_model
      !> The next point
      type(point_type), intent(in) :: next
      !> Longest delay of the sweep
      real(wp), intent(in) :: longest_delay
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Where this point ended
      type(continuation_type), intent(in) :: arrived
      !> Values for t <= 0 of the next point, used if `start` is empty
      type(block_history_type), intent(inout) :: history
      !> Where the next point starts
      type(continuation_type), intent(inout) :: start
      type(continuation_type) :: onward
      type(error_type), allocatable :: error
      type(integration_options) :: keeping
      type(integration_result) :: outcome
      real(wp) :: y(block_model%n)

      if ((size(block_model%lag) > 0) .neqv. (next%parameters%tau > 0.0_wp)) then
         start = continuation_type()
         history = block_history_type(theta=arrived%y(index_of_theta), &
                                      u=arrived%y(index_of_u) + disturbance, &
                                      v=exp(arrived%y(index_of_ln_v)))
         return
      end if
      keeping = options
      keeping%past_kept = longest_delay
      onward = arrived
      call integrate(block_model, onward%time(1), onward%time(1) + longest_delay, keeping, &
                     outcome, error, continuation=onward)
      if (allocated(error)) return
      y = onward%y
      y(index_of_u) = y(index_of_u) + disturbance
      call onward%change_state(y, error)
      if (.not. allocated(error)) start = onward
   end subroutine hand_over
end module attractor_sweep
