! SPDX-License-Identifier: BSD-3-Clause
!> Attractors at many points: parameters and histories. Points are shared among threads, or stand on
!> a sweep: there each starts where the one before ended, with all of its past, so that the motion
!> stays on its attractor as long as that exists.
module attractor_points
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use motion_classes, only: class_names, cycle_motion, undecided
   use progress_receiver, only: progress_receiver_type
   use refined_grid, only: refined_grid_type, uncertain
   implicit none (type, external)
   private
   public :: finding_type, find_attractors, point_type, sweep_attractors

   !> Change of a state from point to point: of the last coordinate of the section, or of the
   !> signal. Without it the motion would stay at rest where that is unstable.
   real(wp), parameter :: disturbance = 1.0e-2_wp

   !> A point at which an attractor is looked for.
   type :: point_type
      !> Parameters in the order of the definition
      real(wp), allocatable :: numbers(:)
      !> Number of the history, and its states
      integer :: history = 1
      real(wp), allocatable :: past(:)
   end type point_type

   !> Result of a search at a point.
   type :: finding_type
      !> Whether the motion was computed; if not, class and period are those of the neighbours
      logical :: computed = .true.
      !> The attractor; its class is `undecided` where `problem` is allocated
      type(attractor_type) :: attractor
      !> Why no attractor was found
      type(error_type), allocatable :: problem
   end type finding_type

contains

   !> Find the attractor of each point, or on a grid only where neighbours differ: other points take
   !> over the kind of their neighbours. Points do not influence each other: the number of threads
   !> changes no result.
   subroutine find_attractors(model, points, settings, options, findings, progress, columns, &
                              refinements)
      type(model_type), intent(in) :: model
      !> Points; of a grid line by line
      type(point_type), intent(in) :: points(:)
      type(attractor_settings_type), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Results, one for each point
      type(finding_type), allocatable, intent(out) :: findings(:)
      !> Receiver of the number of points whose class is known
      class(progress_receiver_type), intent(inout), optional :: progress
      !> Points in a line of a grid; with `refinements` or not at all
      integer, intent(in), optional :: columns
      !> Every 2**refinements-th line of the grid is computed in full
      integer, intent(in), optional :: refinements
      integer, allocatable :: kinds(:), wanted(:)
      type(refined_grid_type) :: grid
      integer :: done, k

      allocate (findings(size(points)))
      grid = refined_grid_type(size(points), 1, refinements=0)
      if (present(columns)) grid = refined_grid_type(columns, size(points)/columns, refinements)
      do
         call grid%next(wanted)
         if (size(wanted) == 0) exit
         done = grid%settled()
         !$omp parallel do schedule(dynamic)
         do k = 1, size(wanted)
            associate (point => points(wanted(k)), finding => findings(wanted(k)))
               call find_attractor(model_at(model, point%numbers, point%past), settings, options, &
                                   finding%attractor, finding%problem)
            end associate
            !$omp critical (points_done)
            if (.not. grid%knows(wanted(k))) done = done + 1
            ! the last point is reported when all classes are known
            if (present(progress) .and. done < size(points)) then
               call progress%advance(done, size(points))
            end if
            !$omp end critical (points_done)
         end do
         !$omp end parallel do
         call grid%put(wanted, [(kind_of(findings(wanted(k))), k=1, size(wanted))])
      end do
      kinds = reshape(grid%kinds, [size(findings)])
      findings%computed = reshape(grid%computed, [size(findings)])
      where (.not. findings%computed)
         findings%attractor%class = modulo(kinds, size(class_names))
         findings%attractor%period = kinds/size(class_names)
      end where
      if (present(progress)) call progress%advance(size(points), size(points))
   end subroutine find_attractors

   !> Motions of one kind have the same class, cycles also the same number of points in the section.
   pure integer function kind_of(finding) result(number)
      type(finding_type), intent(in) :: finding

      associate (found => finding%attractor)
         number = found%class
         if (found%class == cycle_motion) number = number + size(class_names)*found%period
         if (allocated(finding%problem) .or. found%class == undecided) number = uncertain
      end associate
   end function kind_of

   !> Find the attractors of points in turn. The first point starts from its history. After a point
   !> whose run fails, the next starts from where that one did.
   subroutine sweep_attractors(model, points, settings, options, findings, progress)
      type(model_type), intent(in) :: model
      !> Points, in the order of the sweep
      type(point_type), intent(in) :: points(:)
      type(attractor_settings_type), intent(in) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(in) :: options
      !> Results, one for each point
      type(finding_type), allocatable, intent(out) :: findings(:)
      !> Receiver of the number of points done
      class(progress_receiver_type), intent(inout), optional :: progress
      type(continuation_type) :: arrived, start
      type(model_type) :: here
      real(wp) :: longest_delay, past(model%n)
      integer :: i

      allocate (findings(size(points)))
      past = points(1)%past
      longest_delay = 0.0_wp
      do i = 1, size(points)
         here = model_at(model, points(i)%numbers, past)
         longest_delay = max(longest_delay, maxval(here%lag))
      end do
      do i = 1, size(points)
         here = model_at(model, points(i)%numbers, past)
         call find_attractor(here, settings, options, findings(i)%attractor, &
                             findings(i)%problem, start, arrived)
         if (i < size(points) .and. .not. allocated(findings(i)%problem)) then
            call hand_over(here, model_at(model, points(i + 1)%numbers, past), longest_delay, &
                           options, arrived, past, start)
         end if
         if (present(progress)) call progress%advance(i, size(points))
      end do
   end subroutine sweep_attractors

   !> The model at a point.
   type(model_type) function model_at(model, numbers, past) result(there)
      type(model_type), intent(in) :: model
      !> Parameters, and states before the initial time
      real(wp), intent(in) :: numbers(:), past(:)

      there = model
      there%past = past
      call there%put(numbers)
   end function model_at

   !> Where the next point starts. A run on at the old parameters makes the past as long as the
   !> longest delay of the sweep. There is no past to hand over between models with different
   !> numbers of delays: then the last state holds for t <= 0.
   subroutine hand_over(model, next, longest_delay, options, arrived, past, start)
      type(model_type), intent(in) :: model, next
      real(wp), intent(in) :: longest_delay
      type(integration_options), intent(in) :: options
      type(continuation_type), intent(in) :: arrived
      !> States before the initial time of the next point, used if `start` is empty
      real(wp), intent(inout) :: past(:)
      type(continuation_type), intent(inout) :: start
      type(continuation_type) :: onward
      type(error_type), allocatable :: error
      type(integration_options) :: keeping
      type(integration_result) :: outcome
      real(wp) :: y(model%n)
      integer :: disturbed

      associate (observed => model%sizes%observed)
         disturbed = maxval(observed%coordinates)
         if (disturbed == 0) disturbed = observed%component
      end associate
      if (size(model%lag) /= size(next%lag)) then
         start = continuation_type()
         past = arrived%y
         past(disturbed) = past(disturbed) + disturbance
         return
      end if
      keeping = options
      keeping%past_kept = longest_delay
      onward = arrived
      call integrate(model, onward%time(1), onward%time(1) + longest_delay, keeping, &
                     outcome, error, continuation=onward)
      if (allocated(error)) return
      y = onward%y
      y(disturbed) = y(disturbed) + disturbance
      call onward%change_state(y, error)
      if (.not. allocated(error)) start = onward
   end subroutine hand_over
end module attractor_points
