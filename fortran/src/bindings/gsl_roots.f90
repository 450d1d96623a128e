!> Root finding by GSL (Brent's method).
module gsl_roots
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_funptr, c_int, &
                                          c_loc, c_ptr
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_root, scalar_function_type

   !> Most iterations of one search.
   integer, parameter :: most_iterations = 200
   !> How a search that failed ended, as in gsl_accessors.c.
   integer(c_int), parameter :: no_memory = 1, same_signs = 2, no_convergence = 3

   !> A continuous function of one variable; its parameters are components of the extension.
   type, abstract :: scalar_function_type
   contains
      !> Value at x
      procedure(function_value), deferred :: value
   end type scalar_function_type

   abstract interface
      !> Value of the function at x.
      real(wp) function function_value(self, x) result(value)
         import :: scalar_function_type, wp
         implicit none (type, external)
         class(scalar_function_type), intent(in) :: self
         real(wp), intent(in) :: x
      end function function_value
   end interface

   !> What GSL passes to the callback.
   type :: callback_data_type
      class(scalar_function_type), pointer :: f => null()
   end type callback_data_type

   interface
      !> Root by Brent's method (gsl_accessors.c), and how the search ended.
      integer(c_int) function find_root_by_brent(f, params, lower, upper, most, relative, root) &
         result(outcome) bind(c)
         import :: c_double, c_funptr, c_int, c_ptr
         implicit none (type, external)
         type(c_funptr), value :: f
         type(c_ptr), value :: params
         real(c_double), value :: lower, upper, relative
         integer(c_int), value :: most
         real(c_double), intent(inout) :: root
      end function find_root_by_brent
   end interface

contains

   !> The root of `f` between `lower` and `upper`, where its signs differ, to the last few bits.
   subroutine find_root(f, lower, upper, root, error)
      class(scalar_function_type), intent(in), target :: f
      !> Lower end of the bracket
      real(wp), intent(in) :: lower
      !> Upper end
      real(wp), intent(in) :: upper
      real(wp), intent(out) :: root
      !> No bracket, the signs do not differ, or no convergence
      type(error_type), allocatable, intent(out) :: error
      type(callback_data_type), target :: context

      root = lower
      if (.not. lower < upper) then
         call raise(error, "find_root: bracket "//text(lower)//".."//text(upper) &
                    //"; lower end < upper end expected")
         return
      end if
      context%f => f
      select case (find_root_by_brent(c_funloc(callback), c_loc(context), lower, upper, &
                                      most_iterations, 4.0_wp*epsilon(1.0_wp), root))
      case (no_memory)
         call raise(error, "find_root: out of memory")
      case (same_signs)
         call raise(error, "find_root: f("//text(lower)//") = "//text(f%value(lower))//" and f(" &
                    //text(upper)//") = "//text(f%value(upper))//"; opposite signs expected")
      case (no_convergence)
         call raise(error, "find_root: no convergence in "//text(most_iterations)//" iterations")
      case default
      end select
   end subroutine find_root

   !> What GSL calls.
   function callback(x, params) result(value) bind(c)
      !> Where
      real(c_double), value :: x
      !> The callback_data_type
      type(c_ptr), value :: params
      real(c_double) :: value
      type(callback_data_type), pointer :: context

      ! params comes from c_loc (Fortran 2018, 18.2.3.3, case ii); flang 19 warns all the same
      call c_f_pointer(params, context)
      value = context%f%value(x)
   end function callback
end module gsl_roots
