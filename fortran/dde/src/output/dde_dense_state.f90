! SPDX-License-Identifier: BSD-3-Clause
!> State and slope at any place of an accepted step, from its dense output, of the components that
!> are looked at.
module dde_dense_state
   use dde_interpolant, only: highest_degree, newton_state, taylor_coefficients
   use dde_step, only: step_type
   use dde_time, only: instant, later
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: dense_state

   !> Relative rounding error of a state. Over a step length it is the error of the slope.
   real(wp), parameter :: rounding = 16.0_wp*epsilon(1.0_wp)

   !> A place of a step. Components that are not looked at keep their values of the initial time.
   type :: dense_state
      !> When
      type(instant) :: t
      !> State and its time derivative there, shape (n)
      real(wp), allocatable :: y(:), slope(:)
      !> Bounds of each component over the step, and of its time derivative, shape (n)
      real(wp), allocatable, dimension(:) :: least, most, least_slope, most_slope
      !> Components looked at, and the place of each component among them, shape (n)
      integer, allocatable :: components(:)
      integer, allocatable, private :: row(:)
      !> Start and end of the step
      type(instant), private :: start, finish
      !> Length of the step
      real(wp) :: h = 0.0_wp
      !> State at its end, shape (components)
      real(wp), allocatable, private :: y_end(:)
      !> Newton nodes of its dense output, shape (degree)
      real(wp), allocatable :: nodes(:)
      !> Whether all of them are 0
      logical, private :: powers = .false.
      !> Newton coefficients, shape (0:degree, components)
      real(wp), allocatable, private :: coefficients(:, :)
      !> Slopes at both ends, times h, shape (2, components)
      real(wp), allocatable, private :: ends(:, :)
      !> Whether the step is so short that the slope is interpolated between its ends, shape
      !> (components)
      logical, allocatable, private :: straight(:)
   contains
      procedure :: begin, take_up, go_to, find_bounds
   end type dense_state

contains

   !> The state at the initial time, before any step.
   pure subroutine begin(self, t, y, slope, components)
      class(dense_state), intent(inout) :: self
      type(instant), intent(in) :: t
      real(wp), intent(in) :: y(:), slope(:)
      integer, intent(in) :: components(:)
      integer :: j

      self%t = t
      self%y = y
      self%slope = slope
      self%components = components
      allocate (self%row(size(y)), source=0)
      self%row(components) = [(j, j=1, size(components))]
      allocate (self%ends(2, size(components)), self%straight(size(components)))
      allocate (self%y_end(size(components)), self%coefficients(0:0, size(components)))
      allocate (self%least(size(y)), self%most(size(y)))
      allocate (self%least_slope(size(y)), self%most_slope(size(y)))
   end subroutine begin

   !> Take up an accepted step. The place is its end.
   pure subroutine take_up(self, step, start, finish)
      class(dense_state), intent(inout) :: self
      class(step_type), intent(in) :: step
      type(instant), intent(in) :: start, finish
      real(wp) :: ignored
      integer :: i, j

      self%start = start
      self%finish = finish
      self%h = step%h
      self%nodes = step%nodes
      self%powers = step%powers
      if (ubound(self%coefficients, 1) /= size(step%nodes)) then
         deallocate (self%coefficients)
         allocate (self%coefficients(0:size(step%nodes), size(self%components)))
      end if
      do j = 1, size(self%components)
         i = self%components(j)
         call step%interpolant(i, self%coefficients(:, j))
         associate (a => self%coefficients(:, j), ends => self%ends(:, j))
            call newton_state(self%nodes, a, 0.0_wp, ignored, ends(1))
            call newton_state(self%nodes, a, 1.0_wp, ignored, ends(2))
            self%straight(j) = abs(ends(2) - ends(1)) <= rounding*abs(step%y(i))
         end associate
         self%y_end(j) = step%y_new(i)
      end do
      call self%go_to(1.0_wp)
   end subroutine take_up

   !> Go to a place of the step.
   pure subroutine go_to(self, place, only)
      class(dense_state), intent(inout) :: self
      real(wp), intent(in) :: place
      !> Components that go there, of those looked at; all if it is not present
      integer, intent(in), optional :: only(:)

      self%t = later(self%start, place*self%h)
      ! at the end of the step time and state are those of the next start, without rounding
      if (.not. abs(place - 1.0_wp) > 0.0_wp) self%t = self%finish
      if (present(only)) then
         call place_components(self, place, only)
      else
         call place_components(self, place, self%components)
      end if
   end subroutine go_to

   !> State and slope of some components at a place of the step.
   pure subroutine place_components(self, place, components)
      type(dense_state), intent(inout) :: self
      real(wp), intent(in) :: place
      integer, intent(in) :: components(:)
      real(wp) :: slope
      integer :: i, j, k

      do k = 1, size(components)
         i = components(k)
         j = self%row(i)
         call newton_state(self%nodes, self%coefficients(:, j), place, self%y(i), slope)
         if (.not. abs(place - 1.0_wp) > 0.0_wp) self%y(i) = self%y_end(j)
         if (self%straight(j)) slope = (1.0_wp - place)*self%ends(1, j) + place*self%ends(2, j)
         self%slope(i) = slope/self%h
      end do
   end subroutine place_components

   !> Bounds over the step: by powers of x = 2 s - 1, all of them at most 1.
   pure subroutine find_bounds(self)
      class(dense_state), intent(inout) :: self
      real(wp) :: bend, change, powers(0:highest_degree)
      integer :: i, j, k

      do j = 1, size(self%components)
         i = self%components(j)
         call taylor_coefficients(size(self%nodes), self%nodes, self%powers, &
                                  self%coefficients(:, j), 0.5_wp, 0.5_wp, powers)
         change = abs(powers(1))
         bend = 0.0_wp
         do k = 2, size(self%nodes)
            change = change + abs(powers(k))
            bend = bend + k*abs(powers(k))
         end do
         self%least(i) = powers(0) - change
         self%most(i) = powers(0) + change
         self%least_slope(i) = 2.0_wp*(powers(1) - bend)/self%h
         self%most_slope(i) = 2.0_wp*(powers(1) + bend)/self%h
      end do
   end subroutine find_bounds
end module dde_dense_state
