! SPDX-License-Identifier: BSD-3-Clause
!> Where the stability of a model at rest changes along a parameter: Hopf points of all modes.
module stability_changes
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use model_modes, only: mode_of
   use model_problem, only: model_type
   use root_counts, only: roots_right_of
   implicit none (type, external)
   private
   public :: changes_type, find_changes, roots_without_delay

   !> Places of a line at which unstable roots are counted.
   integer, parameter :: places = 1000

   !> Changes of stability along a parameter.
   type :: changes_type
      !> Number of the parameter
      integer :: along = 0
      !> The Hopf points, the parameter ascending
      type(hopf_on_line_type), allocatable :: points(:)
   end type changes_type

contains

   !> Changes of stability of all modes along a parameter, ascending.
   subroutine find_changes(model, window, changes, error)
      type(model_type), intent(in) :: model
      !> Window on the parameter
      real(wp), intent(in) :: window(2)
      !> What is found along the parameter that it names
      type(changes_type), intent(inout) :: changes
      !> A Hopf point was not found
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: of_mode(:), points(:)
      real(wp) :: from(size(model%numbers)), to(size(model%numbers))
      integer :: i, j, k, l

      from = model%numbers
      to = model%numbers
      from(changes%along) = window(1)
      to(changes%along) = window(2)
      allocate (points(0))
      do i = 1, model%shape%blocks
         call find_hopf_on_line(mode_of(model, i), from, to, places, of_mode, error)
         if (allocated(error)) return
         do j = 1, size(of_mode)
            associate (a => changes%along)
               k = count([(points(l)%numbers(a) < of_mode(j)%numbers(a), l=1, size(points))])
            end associate
            points = [points(:k), of_mode(j), points(k + 1:)]
         end do
      end do
      call move_alloc(points, changes%points)
   end subroutine find_changes

   !> Number of unstable roots without delays, of all modes.
   integer function roots_without_delay(model) result(number)
      type(model_type), intent(in) :: model
      type(characteristic_type) :: c
      integer :: i

      number = 0
      do i = 1, model%shape%blocks
         c = characteristic_of(mode_of(model, i))
         c%delay = 0.0_wp
         number = number + roots_right_of(c, 0.0_wp)
      end do
   end function roots_without_delay
end module stability_changes
