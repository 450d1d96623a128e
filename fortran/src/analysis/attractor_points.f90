!> Attractors at many points: parameters and histories, shared out among threads.
module attractor_points
   use attractors, only: attractor_settings, attractor_type, find_attractor
   use characteristic_function, only: block_parameters
   use dde, only: integration_options
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use progress_receivers, only: progress_receiver
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: finding_type, find_attractors, point_type

   !> Where an attractor is looked for.
   type :: point_type
      !> Parameters, nondimensional
      type(block_parameters) :: parameters
      !> Constant values of theta, u and v for t <= 0
      real(wp) :: history(3) = [0.0_wp, 0.0_wp, 1.0_wp]
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
      type(attractor_settings), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What was found, one each
      type(finding_type), allocatable, intent(out) :: findings(:)
      !> Receiver of the number of points done
      class(progress_receiver), intent(inout), optional :: progress
      integer :: done, i

      allocate (findings(size(points)))
      done = 0
      !$omp parallel do schedule(dynamic)
      do i = 1, size(points)
         associate (p => points(i)%parameters, past => points(i)%history)
            call find_attractor(spring_block_type(p%tau, p%epsilon, p%xi, p%gamma, past(1), &
                                                  past(2), past(3)), settings, options, &
                                findings(i)%attractor, findings(i)%problem)
         end associate
         !$omp critical (points_done)
         done = done + 1
         if (present(progress)) call progress%advance(done, size(points))
         !$omp end critical (points_done)
      end do
      !$omp end parallel do
   end subroutine find_attractors
end module attractor_points
