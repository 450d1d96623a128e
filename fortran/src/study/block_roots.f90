!> Characteristic roots of the delayed block, found and counted in two independent ways.
module block_roots
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: characteristic_type
   use characteristic_roots, only: find_roots, most_roots
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use root_counts, only: has_more_roots, roots_right_of
   use spring_block, only: block_characteristic
   implicit none (type, external)
   private
   public :: roots_of_block

contains

   !> All characteristic roots with real part above `bound`, the rightmost first.
   subroutine roots_of_block(p, bound, roots, error)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Least real part
      real(wp), intent(in) :: bound
      !> The roots
      complex(wp), allocatable, intent(out) :: roots(:)
      !> Too many, or not as many found as the principle of the argument says
      type(error_type), allocatable, intent(out) :: error
      type(block_equation_type) :: equation
      type(characteristic_type) :: c

      equation = block_equation_type(p)
      c = block_characteristic(p)
      if (has_more_roots(c, bound, most_roots)) then
         call raise(error, "roots_of_block: more than "//text(most_roots)//" roots above " &
                    //text(bound)//"; a bound nearer to 0 expected")
         return
      end if
      call find_roots(equation%linear, bound, roots, error, expected=roots_right_of(c, bound))
   end subroutine roots_of_block
end module block_roots
