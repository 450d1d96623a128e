!> The number of unstable pairs of characteristic roots over a plane of parameters.
module stability_map
   use block_parameters, only: law_parameters
   use characteristic_function, only: characteristic_of
   use dde_kinds, only: wp
   use hopf_planes, only: curve_plane_type
   use model_problem, only: model_type
   use root_counts, only: roots_right_of
   use spring_block, only: find_model
   implicit none (type, external)
   private
   public :: middles, unstable_pairs

contains

   !> Number of unstable pairs in the middle of each cell of the plane's window.
   function unstable_pairs(plane, cells) result(pairs)
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> Cells along each side
      integer, intent(in) :: cells
      integer :: pairs(cells, cells)
      real(wp) :: x(cells), y(cells)
      type(model_type) :: model
      integer :: i, j

      call find_model(plane%parameters(plane%epsilon_window(2), plane%ordinate_window(2)), model)
      x = middles(plane%epsilon_window, cells)
      y = middles(plane%ordinate_window, cells)
      do j = 1, cells
         do i = 1, cells
            call model%set(law_parameters(plane%parameters(x(i), y(j)), model), model%past)
            pairs(i, j) = roots_right_of(characteristic_of(model), 0.0_wp)/2
         end do
      end do
   end function unstable_pairs

   !> Middles of equal cells of an interval.
   pure function middles(window, cells) result(x)
      !> The interval
      real(wp), intent(in) :: window(2)
      !> Cells
      integer, intent(in) :: cells
      real(wp) :: x(cells)
      integer :: i

      x = [(window(1) + (window(2) - window(1))*(i - 0.5_wp)/cells, i=1, cells)]
   end function middles
end module stability_map
