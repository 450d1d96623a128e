!> State and slope at any place of an accepted step, from its dense output.
module dde_dense_state
   use dde_interpolant, only: newton_state
   use dde_step, only: step_type
   use dde_time, only: instant, later
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: dense_state

   !> Relative rounding error of a state. Over a step length it is the error of the slope.
   real(wp), parameter :: rounding = 16.0_wp*epsilon(1.0_wp)

   !> A place of a step.
   type :: dense_state
      !> When
      type(instant) :: t
      !> State and its time derivative there, shape (n)
      real(wp), allocatable :: y(:), slope(:)
      !> Start and end of the step
      type(instant), private :: start, finish
      !> Its length
      real(wp) :: h = 0.0_wp
      !> State at its end, shape (n)
      real(wp), allocatable, private :: y_end(:)
      !> Newton nodes of its dense output, shape (degree)
      real(wp), allocatable, private :: nodes(:)
      !> Newton coefficients, shape (n, 0:degree)
      real(wp), allocatable, private :: coefficients(:, :)
      !> Slopes at both ends, times h, shape (n, 2)
      real(wp), allocatable, private :: ends(:, :)
      !> Whether the step is so short that the slope is interpolated between its ends, shape (n)
      logical, allocatable, private :: straight(:)
   contains
      !> The state at the first instant
      procedure :: begin
      !> Take up a step
      procedure :: take_up
      !> Go to a place of it
      procedure :: go_to
      !> Degree of its dense output
      procedure :: degree
      !> Bounds of the state and the slope over the step
      procedure :: bounds
   end type dense_state

contains

   !> The state at the first instant, before any step.
   pure subroutine begin(self, t, y, slope)
      !> The state
      class(dense_state), intent(inout) :: self
      !> When
      type(instant), intent(in) :: t
      !> State there, shape (n)
      real(wp), intent(in) :: y(:)
      !> Its time derivative, shape (n)
      real(wp), intent(in) :: slope(:)

      self%t = t
      self%y = y
      self%slope = slope
      allocate (self%ends(size(y), 2), self%coefficients(size(y), 0:0))
   end subroutine begin

   !> Take up an accepted and extended step.
   pure subroutine take_up(self, step, start, finish)
      !> The state
      class(dense_state), intent(inout) :: self
      !> The step
      class(step_type), intent(in) :: step
      !> Its start
      type(instant), intent(in) :: start
      !> Its end
      type(instant), intent(in) :: finish
      integer :: i

      self%start = start
      self%finish = finish
      self%h = step%h
      self%y_end = step%y_new
      self%nodes = step%nodes
      if (ubound(self%coefficients, 2) /= size(step%nodes)) then
         deallocate (self%coefficients)
         allocate (self%coefficients(size(step%y), 0:size(step%nodes)))
      end if
      do i = 1, size(step%y)
         call step%interpolant(i, self%coefficients(i, :))
      end do
      call newton_state(self%nodes, self%coefficients, 0.0_wp, self%y, self%ends(:, 1))
      call newton_state(self%nodes, self%coefficients, 1.0_wp, self%y, self%ends(:, 2))
      self%straight = abs(self%ends(:, 2) - self%ends(:, 1)) <= rounding*abs(step%y)
   end subroutine take_up

   !> Go to a place of the step. At its end the state is exactly that of the next start.
   pure subroutine go_to(self, place)
      !> The state
      class(dense_state), intent(inout) :: self
      !> The place, 0..1
      real(wp), intent(in) :: place

      self%t = later(self%start, place*self%h)
      call newton_state(self%nodes, self%coefficients, place, self%y, self%slope)
      where (self%straight)
         self%slope = (1.0_wp - place)*self%ends(:, 1) + place*self%ends(:, 2)
      end where
      self%slope = self%slope/self%h
      if (place < 1.0_wp) return
      self%t = self%finish
      self%y = self%y_end
   end subroutine go_to

   !> Degree of dense output.
   pure integer function degree(self)
      !> The state, in a step
      class(dense_state), intent(in) :: self

      degree = size(self%nodes)
   end function degree

   !> Bounds of the state and the slope over the step: places and nodes lie in 0..1, so that a
   !> factor (s - x) of a term is at most 1, and term k has the sum of k products as its derivative.
   pure subroutine bounds(self, least, most, least_slope, most_slope)
      !> The state, in a step
      class(dense_state), intent(in) :: self
      !> Bounds of each component, shape (n)
      real(wp), intent(out) :: least(:), most(:)
      !> Bounds of its time derivative, shape (n)
      real(wp), intent(out) :: least_slope(:), most_slope(:)
      real(wp) :: change(size(least)), change_of_slope(size(least))
      integer :: k

      change = 0.0_wp
      change_of_slope = 0.0_wp
      do k = 2, size(self%nodes)
         change = change + abs(self%coefficients(:, k))
         change_of_slope = change_of_slope + k*abs(self%coefficients(:, k))
      end do
      associate (first => self%coefficients(:, 0), slope => self%coefficients(:, 1))
         least = first - abs(slope) - change
         most = first + abs(slope) + change
         least_slope = (slope - change_of_slope)/self%h
         most_slope = (slope + change_of_slope)/self%h
      end associate
   end subroutine bounds
end module dde_dense_state
