!> Attractors at many points: parameters and histories, shared out among threads.
module attractor_points
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integration_options
   use dde_errors, only: error_type
   use progress_receiver, only: progress_receiver_type
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: finding_type, find_attractors, point_type

   !> Where an attractor is looked for.
   type :: point_type
      !> Parameters, nondimensional
      type(block_parameters_type) :: parameters
      !> Values for t <= 0
      type(block_history_type) :: history
   end type point_type

   !> What was found there.
   type :: finding_type
      !> The attractor; its class is `undecided` where `problem` is allocated
      type(attractor_type) :: attractor
      !> Why there is none
      type(error_type), allocatable :: problem
   end type finding_type

contains

   !> Find the attractor of each point. Each is found by itself: the same whatever the number of
   !> threads.
   subroutine find_attractors(points, settings, options, findings, progress)
      !> Points
      type(point_type), intent(in) :: points(:)
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What was found, one each
      type(finding_type), allocatable, intent(out) :: findings(:)
      !> Receiver of the number of points done
      class(progress_receiver_type), intent(inout), optional :: progress
      integer :: done, i

      allocate (findings(size(points)))
      done = 0
      !$omp parallel do schedule(dynamic)
      do i = 1, size(points)
         call find_attractor(spring_block_type(points(i)%parameters, points(i)%history), &
                             settings, options, findings(i)%attractor, findings(i)%problem)
         !$omp critical (points_done)
         done = done + 1
         if (present(progress)) call progress%advance(done, size(points))
         !$omp end critical (points_done)
      end do
      !$omp end parallel do
   end subroutine find_attractors
end module attractor_points
