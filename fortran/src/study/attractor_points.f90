!> Attractors at many points: parameters and histories, shared out among threads.
module attractor_points
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integration_options
   use dde_errors, only: error_type
   use motion_classes, only: class_names, cycle_motion, undecided
   use progress_receiver, only: progress_receiver_type
   use refined_grid, only: refined_grid_type, uncertain
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
      !> Whether the motion was computed; if not, class and period are those of the neighbours
      logical :: computed = .true.
      !> The attractor; its class is `undecided` where `problem` is allocated
      type(attractor_type) :: attractor
      !> Why there is none
      type(error_type), allocatable :: problem
   end type finding_type

contains

   !> Find the attractor of each point, or on a grid only where neighbours differ. Each is found by
   !> itself: the same whatever the number of threads.
   subroutine find_attractors(points, settings, options, findings, progress, columns, refinements)
      !> Points; of a grid line by line
      type(point_type), intent(in) :: points(:)
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What was found, one each
      type(finding_type), allocatable, intent(out) :: findings(:)
      !> Receiver of the number of points whose class is known
      class(progress_receiver_type), intent(inout), optional :: progress
      !> Points in a line of a grid; with `refinements` or not at all
      integer, intent(in), optional :: columns
      !> Every 2**refinements-th line of the grid is computed in full
      integer, intent(in), optional :: refinements
      integer, allocatable :: wanted(:)
      type(refined_grid_type) :: grid
      integer :: k

      allocate (findings(size(points)))
      grid = refined_grid_type(size(points), 1, refinements=0)
      if (present(columns)) grid = refined_grid_type(columns, size(points)/columns, refinements)
      do
         call grid%next(wanted)
         if (size(wanted) == 0) exit
         call find_wanted(points, wanted, settings, options, grid, findings, progress)
         call grid%put(wanted, [(kind_of(findings(wanted(k))), k=1, size(wanted))])
      end do
      call take_over(grid, findings)
      if (present(progress)) call progress%advance(size(points), size(points))
   end subroutine find_attractors

   !> Find the attractors of some points.
   subroutine find_wanted(points, wanted, settings, options, grid, findings, progress)
      !> All points
      type(point_type), intent(in) :: points(:)
      !> Numbers of those that are looked for
      integer, intent(in) :: wanted(:)
      !> How
      type(attractor_settings_type), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> What was known before
      type(refined_grid_type), intent(in) :: grid
      !> What was found, one for each of all points
      type(finding_type), intent(inout) :: findings(:)
      !> Receiver of the number of points whose class is known; the last point is not reported
      class(progress_receiver_type), intent(inout), optional :: progress
      integer :: done, k

      done = grid%settled()
      !$omp parallel do schedule(dynamic)
      do k = 1, size(wanted)
         associate (point => points(wanted(k)), finding => findings(wanted(k)))
            call find_attractor(spring_block_type(point%parameters, point%history), settings, &
                                options, finding%attractor, finding%problem)
         end associate
         !$omp critical (points_done)
         if (.not. grid%knows(wanted(k))) done = done + 1
         if (present(progress) .and. done < size(points)) then
            call progress%advance(done, size(points))
         end if
         !$omp end critical (points_done)
      end do
      !$omp end parallel do
   end subroutine find_wanted

   !> Motions of one kind have the same class, cycles also the same number of points in the section.
   pure integer function kind_of(finding) result(number)
      !> What was found
      type(finding_type), intent(in) :: finding

      associate (found => finding%attractor)
         number = found%class
         if (found%class == cycle_motion) number = number + size(class_names)*found%period
         if (allocated(finding%problem) .or. found%class == undecided) number = uncertain
      end associate
   end function kind_of

   !> Give points that were not computed the class and the period of their kind.
   pure subroutine take_over(grid, findings)
      !> The grid
      type(refined_grid_type), intent(in) :: grid
      !> What was found
      type(finding_type), intent(inout) :: findings(:)
      integer :: kinds(size(findings))

      kinds = reshape(grid%kinds, [size(findings)])
      findings%computed = reshape(grid%computed, [size(findings)])
      where (.not. findings%computed)
         findings%attractor%class = modulo(kinds, size(class_names))
         findings%attractor%period = kinds/size(class_names)
      end where
   end subroutine take_over
end module attractor_points
