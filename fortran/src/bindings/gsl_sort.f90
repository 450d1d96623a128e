!> Sorting by GSL.
module gsl_sort
   use, intrinsic :: iso_c_binding, only: c_double, c_size_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: ascending_order

   interface
      pure subroutine gsl_sort_index(p, data, stride, n) bind(c)
         import :: c_double, c_size_t
         implicit none (type, external)
         integer(c_size_t), intent(out) :: p(*)
         real(c_double), intent(in) :: data(*)
         integer(c_size_t), value :: stride, n
      end subroutine gsl_sort_index
   end interface

contains

   !> Indices of the values, the least first.
   pure function ascending_order(values) result(order)
      !> Values
      real(wp), intent(in) :: values(:)
      integer :: order(size(values))
      integer(c_size_t) :: place(size(values))

      call gsl_sort_index(place, values, 1_c_size_t, int(size(values), c_size_t))
      order = int(place) + 1
   end function ascending_order
end module gsl_sort
