! SPDX-License-Identifier: BSD-3-Clause
!> Grids that are computed only where neighbours differ, on made-up maps of kinds.
module test_refined_grid
   use dde_errors, only: text
   use expectations, only: expect
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use refined_grid, only: refined_grid_type, uncertain
   implicit none (type, external)
   private
   public :: collect_refined_grid

contains

   subroutine collect_refined_grid(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("sizes", test_sizes), &
                   new_unittest("borders", test_borders), &
                   new_unittest("snake", test_snake), &
                   new_unittest("islands", test_islands), &
                   new_unittest("uncertain", test_uncertain)]
   end subroutine collect_refined_grid

   !> Refine a map. No point is asked for twice, and more and more of them have a kind.
   subroutine refine(error, map, refinements, grid)
      type(error_type), allocatable, intent(inout) :: error
      integer, intent(in) :: map(:, :), refinements
      type(refined_grid_type), intent(out) :: grid
      integer, allocatable :: wanted(:)
      integer :: asked(size(map)), kinds(size(map)), settled

      grid = refined_grid_type(size(map, 1), size(map, 2), refinements)
      kinds = reshape(map, [size(map)])
      asked = 0
      settled = 0
      do
         call grid%next(wanted)
         if (size(wanted) == 0) exit
         asked(wanted) = asked(wanted) + 1
         call grid%put(wanted, kinds(wanted))
         call expect(error, grid%settled() >= settled, "points with a kind")
         settled = grid%settled()
      end do
      call expect(error, grid%settled() == size(map), "all points have a kind")
      call expect(error, all(asked == merge(1, 0, reshape(grid%computed, [size(map)]))), &
                  "computed once")
   end subroutine refine

   !> Lines, single points, and numbers of lines that the distance does not divide.
   subroutine test_sizes(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer, allocatable :: map(:, :)
      integer :: columns, lines, refinements

      do refinements = 0, 4
         do lines = 1, 19
            do columns = 1, 19
               allocate (map(columns, lines), source=1)
               call refine(error, map, refinements, grid)
               call expect(error, all(grid%kinds == 1), "one kind")
               call expect(error, count(grid%computed) &
                           == first_lines(columns, refinements)*first_lines(lines, refinements), &
                           text(columns)//" x "//text(lines)//" points")
               deallocate (map)
            end do
         end do
      end do
   end subroutine test_sizes

   !> Every 2**refinements-th line, and the last one if it is not among them.
   pure integer function first_lines(places, refinements) result(lines)
      integer, intent(in) :: places, refinements

      lines = 1 + (places - 1 + 2**refinements - 1)/2**refinements
   end function first_lines

   !> Regions larger than the first distance are found exactly, at less cost.
   subroutine test_borders(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer :: disc(74, 51), half(74, 51), i, j, refinements, several(74, 51)

      do j = 1, 51
         do i = 1, 74
            disc(i, j) = merge(2, 1, (i - 30)**2 + (j - 22)**2 < 17**2)
            half(i, j) = merge(2, 1, 3*i + 7*j > 251)
            several(i, j) = 1 + (i + 2*j)/60 + 5*((3*i - j + 60)/100)
         end do
      end do
      do refinements = 1, 4
         call refine(error, disc, refinements, grid)
         call expect(error, all(grid%kinds == disc), "disc")
         call expect(error, 10*count(grid%computed) < 7*size(disc), "cost of the disc")
         call refine(error, half, refinements, grid)
         call expect(error, all(grid%kinds == half), "half")
         call expect(error, 10*count(grid%computed) < 6*size(half), "cost of the half")
         call refine(error, several, refinements, grid)
         call expect(error, all(grid%kinds == several), "several regions")
      end do
   end subroutine test_borders

   !> A region of any shape is followed from a single point of the first lines.
   subroutine test_snake(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer :: map(33, 33), refinements

      map = 1
      map(9:30, 10) = 2
      map(30, 10:22) = 2
      map(4:30, 22) = 2
      map(4, 22:32) = 2
      map(4:20, 32) = 2
      do refinements = 1, 3
         map(9, 9) = 1
         call refine(error, map, refinements, grid)
         call expect(error, all(grid%kinds == 1), "no point of it is on the first lines")
         map(9, 9) = 2
         call refine(error, map, refinements, grid)
         call expect(error, all(grid%kinds == map), "one point is")
      end do
   end subroutine test_snake

   !> An island of one point is found if it is on the first lines, and only then.
   subroutine test_islands(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer :: i, j, map(9, 9)

      do j = 1, 9
         do i = 1, 9
            map = 1
            map(i, j) = 2
            call refine(error, map, 2, grid)
            if (modulo(i, 4) == 1 .and. modulo(j, 4) == 1) then
               call expect(error, all(grid%kinds == map), "found")
            else
               call expect(error, all(grid%kinds == 1), "lost")
            end if
         end do
      end do
   end subroutine test_islands

   !> A point whose kind is uncertain says nothing of those beside it.
   subroutine test_uncertain(error)
      type(error_type), allocatable, intent(out) :: error
      type(refined_grid_type) :: grid
      integer :: map(9, 9)

      map = 1
      map(5, 5) = uncertain
      call refine(error, map, 1, grid)
      call expect(error, all(grid%kinds == map), "kept")
      call expect(error, all(grid%computed(4:6, 4:6)), "all around it are computed")
      map = uncertain
      call refine(error, map, 3, grid)
      call expect(error, all(grid%computed), "all are computed")
   end subroutine test_uncertain
end module test_refined_grid
