! SPDX-License-Identifier: BSD-3-Clause
!> A grid that is computed only where neighbours differ. It knows the kind of each point, a number.
!>
!> The points on every s-th line and on the last one are computed first. Then s is halved until it
!> is 1, each time with two steps:
!> 1. A new point takes the kind of the nearest known points, two on a line or four in the middle of
!>    a cell, if they are of one kind.
!> 2. A point is computed if it has no kind, or if a neighbour at the distance s has another one.
!>    This is repeated until there is no such point.
!>
!> So borders run between computed points, and a region that is connected along lines is found as
!> a whole if one of its points is computed. A region between the first lines may be lost.
module refined_grid
   implicit none (type, external)
   private
   public :: refined_grid_type, uncertain

   !> Kind of a computed point whose kind says nothing of the points near it.
   integer, parameter :: uncertain = 0
   !> Kind of a point that has none yet.
   integer, parameter :: unknown = -1

   !> Kinds of the points, and which of them were computed.
   type :: refined_grid_type
      !> Positive numbers, `uncertain` or `unknown`
      integer, allocatable :: kinds(:, :)
      !> Which points were computed
      logical, allocatable :: computed(:, :)
      !> Distance of the lines that are being computed
      integer, private :: spacing = 1
   contains
      procedure :: next, put, knows, settled
      procedure, private :: fill, due
   end type refined_grid_type

   interface refined_grid_type
      module procedure :: new_grid
   end interface refined_grid_type

contains

   !> A grid of which nothing is known.
   pure type(refined_grid_type) function new_grid(columns, lines, refinements) result(grid)
      !> Number of points along the first axis
      integer, intent(in) :: columns
      !> Number of points along the second
      integer, intent(in) :: lines
      !> How often the distance of lines is halved; 0: all points are computed
      integer, intent(in) :: refinements

      grid%spacing = 2**refinements
      allocate (grid%kinds(columns, lines), source=unknown)
      allocate (grid%computed(columns, lines), source=.false.)
   end function new_grid

   !> Numbers of the points to compute next, the first axis runs fastest; none when all have a kind.
   pure subroutine next(self, numbers)
      class(refined_grid_type), intent(inout) :: self
      integer, allocatable, intent(out) :: numbers(:)

      do
         numbers = self%due()
         if (size(numbers) > 0 .or. self%spacing == 1) return
         self%spacing = self%spacing/2
         call self%fill()
      end do
   end subroutine next

   !> Give each new point the kind of the known points around it, if that is one.
   pure subroutine fill(self)
      class(refined_grid_type), intent(inout) :: self
      integer, allocatable :: columns(:), lines(:)
      integer :: around(2, 2), i, j

      columns = lines_of(size(self%kinds, 1), self%spacing)
      lines = lines_of(size(self%kinds, 2), self%spacing)
      do j = 1, size(lines)
         do i = 1, size(columns)
            associate (kind_here => self%kinds(columns(i), lines(j)))
               if (kind_here /= unknown) cycle
               around = self%kinds(beside(columns(i), self%spacing, size(self%kinds, 1)), &
                                   beside(lines(j), self%spacing, size(self%kinds, 2)))
               if (any(around == uncertain) .or. any(around /= around(1, 1))) cycle
               kind_here = around(1, 1)
            end associate
         end do
      end do
   end subroutine fill

   !> Numbers of the points that were not computed and have no kind, or are beside another kind.
   pure function due(self) result(numbers)
      class(refined_grid_type), intent(in) :: self
      integer, allocatable :: numbers(:)
      integer, allocatable :: columns(:), kinds(:, :), lines(:)
      logical, allocatable :: affected(:, :)
      integer :: i, j, m, n

      columns = lines_of(size(self%kinds, 1), self%spacing)
      lines = lines_of(size(self%kinds, 2), self%spacing)
      m = size(columns)
      n = size(lines)
      kinds = self%kinds(columns, lines)
      affected = kinds == unknown
      affected(2:, :) = affected(2:, :) .or. differ(kinds(2:, :), kinds(:m - 1, :))
      affected(:m - 1, :) = affected(:m - 1, :) .or. differ(kinds(2:, :), kinds(:m - 1, :))
      affected(:, 2:) = affected(:, 2:) .or. differ(kinds(:, 2:), kinds(:, :n - 1))
      affected(:, :n - 1) = affected(:, :n - 1) .or. differ(kinds(:, 2:), kinds(:, :n - 1))
      affected = affected .and. .not. self%computed(columns, lines)
      numbers = pack(reshape([((columns(i) + (lines(j) - 1)*size(self%kinds, 1), i=1, m), &
                               j=1, n)], [m, n]), affected)
   end function due

   !> Set the kinds of computed points.
   pure subroutine put(self, numbers, kinds)
      class(refined_grid_type), intent(inout) :: self
      integer, intent(in) :: numbers(:)
      !> Kinds of the points, positive or `uncertain`
      integer, intent(in) :: kinds(:)
      integer :: k

      do k = 1, size(numbers)
         associate (m => size(self%kinds, 1), number => numbers(k))
            self%kinds(1 + modulo(number - 1, m), 1 + (number - 1)/m) = kinds(k)
            self%computed(1 + modulo(number - 1, m), 1 + (number - 1)/m) = .true.
         end associate
      end do
   end subroutine put

   !> Whether a point has a kind.
   pure logical function knows(self, number) result(value)
      class(refined_grid_type), intent(in) :: self
      integer, intent(in) :: number

      associate (m => size(self%kinds, 1))
         value = self%kinds(1 + modulo(number - 1, m), 1 + (number - 1)/m) /= unknown
      end associate
   end function knows

   !> Number of points that have a kind.
   pure integer function settled(self) result(points)
      class(refined_grid_type), intent(in) :: self

      points = count(self%kinds /= unknown)
   end function settled

   !> Lines of this distance, and the last one.
   pure function lines_of(places, spacing) result(lines)
      integer, intent(in) :: places
      integer, intent(in) :: spacing
      integer, allocatable :: lines(:)
      integer :: i

      lines = [(i, i=1, places - 1, spacing), places]
   end function lines_of

   !> The lines of twice the distance on both sides of a line, twice itself if it is one of them.
   pure function beside(line, spacing, places) result(lines)
      integer, intent(in) :: line
      integer, intent(in) :: spacing
      integer, intent(in) :: places
      integer :: lines(2)

      lines = line
      if (line < places .and. modulo(line - 1, 2*spacing) /= 0) then
         lines = [line - spacing, min(line + spacing, places)]
      end if
   end function beside

   !> Whether two points have different kinds.
   elemental logical function differ(a, b) result(value)
      integer, intent(in) :: a
      integer, intent(in) :: b

      value = a /= b .and. a /= unknown .and. b /= unknown
   end function differ
end module refined_grid
