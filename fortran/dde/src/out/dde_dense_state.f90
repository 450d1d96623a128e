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
      !> Bounds of each component over the step, and of its time derivative, shape (n)
      real(wp), allocatable, dimension(:) :: least, most, least_slope, most_slope
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
      !> Take up a step, at its end
      procedure :: take_up
      !> Go to a place of it
      procedure :: go_to
      !> Degree of its dense output
      procedure :: degree
      !> Find the bounds
      procedure :: find_bounds
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
      allocate (self%least(size(y)), self%most(size(y)))
      allocate (self%least_slope(size(y)), self%most_slope(size(y)))
   end subroutine begin

   !> Take up an accepted and extended step. The place is its end.
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
      self%slope = self%ends(:, 2)/self%h
      call stop_at_end(self)
   end subroutine take_up

   !> Go to a place of the step.
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
      if (.not. place < 1.0_wp) call stop_at_end(self)
   end subroutine go_to

   !> At the end of the step the state is that of the next start, without rounding.
   pure subroutine stop_at_end(self)
      !> The state
      class(dense_state), intent(inout) :: self

      self%t = self%finish
      self%y = self%y_end
   end subroutine stop_at_end

   !> Degree of dense output.
   pure integer function degree(self) result(value)
      !> The state, in a step
      class(dense_state), intent(in) :: self

      value = size(self%nodes)
   end function degree

   !> Bounds over the step: places and nodes lie in 0..1, so that a factor (s - x) of a term is at
   !> most 1, and term k has the sum of k products as its derivative.
   pure subroutine find_bounds(self)
      !> The state, in a step
      class(dense_state), intent(inout) :: self
      real(wp) :: bend, change, term
      integer :: i, k

      do i = 1, size(self%least)
         change = abs(self%coefficients(i, 1))
         bend = 0.0_wp
         do k = 2, size(self%nodes)
            term = abs(self%coefficients(i, k))
            change = change + term
            bend = bend + k*term
         end do
         self%least(i) = self%coefficients(i, 0) - change
         self%most(i) = self%coefficients(i, 0) + change
         self%least_slope(i) = (self%coefficients(i, 1) - bend)/self%h
         self%most_slope(i) = (self%coefficients(i, 1) + bend)/self%h
      end do
   end subroutine find_bounds
end module dde_dense_state
