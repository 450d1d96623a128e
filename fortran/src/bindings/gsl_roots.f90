!> Root finding by GSL (Brent's method).
module gsl_roots
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, c_funptr, &
                                          c_int, c_loc, c_ptr
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_falling_root, find_root, scalar_function_type

   !> Most iterations of one search.
   integer, parameter :: most_iterations = 200
   !> GSL's status for success.
   integer(c_int), parameter :: gsl_success = 0

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
         !> The function
         class(scalar_function_type), intent(in) :: self
         !> Where
         real(wp), intent(in) :: x
      end function function_value
   end interface

   !> What GSL passes to the callback.
   type :: callback_data_type
      class(scalar_function_type), pointer :: f => null()
   end type callback_data_type

   !> The C type gsl_function.
   type, bind(c) :: gsl_function
      type(c_funptr) :: evaluate
      type(c_ptr) :: params
   end type gsl_function

   interface
      type(c_ptr) function brent_of_gsl() result(value) bind(c)
         import :: c_ptr
         implicit none (type, external)
      end function brent_of_gsl

      type(c_ptr) function gsl_set_error_handler_off() result(value) bind(c)
         import :: c_ptr
         implicit none (type, external)
      end function gsl_set_error_handler_off

      type(c_ptr) function gsl_root_fsolver_alloc(method) result(value) bind(c)
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: method
      end function gsl_root_fsolver_alloc

      integer(c_int) function gsl_root_fsolver_set(solver, f, lower, upper) result(value) bind(c)
         import :: c_double, c_int, c_ptr, gsl_function
         implicit none (type, external)
         type(c_ptr), value :: solver
         type(gsl_function), intent(in) :: f
         real(c_double), value :: lower, upper
      end function gsl_root_fsolver_set

      integer(c_int) function gsl_root_fsolver_iterate(solver) result(value) bind(c)
         import :: c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: solver
      end function gsl_root_fsolver_iterate

      real(c_double) function gsl_root_fsolver_root(solver) result(value) bind(c)
         import :: c_double, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: solver
      end function gsl_root_fsolver_root

      real(c_double) function gsl_root_fsolver_x_lower(solver) result(value) bind(c)
         import :: c_double, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: solver
      end function gsl_root_fsolver_x_lower

      real(c_double) function gsl_root_fsolver_x_upper(solver) result(value) bind(c)
         import :: c_double, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: solver
      end function gsl_root_fsolver_x_upper

      integer(c_int) function gsl_root_test_interval(lower, upper, absolute, relative) &
         result(value) bind(c)
         import :: c_double, c_int
         implicit none (type, external)
         real(c_double), value :: lower, upper, absolute, relative
      end function gsl_root_test_interval

      subroutine gsl_root_fsolver_free(solver) bind(c)
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: solver
      end subroutine gsl_root_fsolver_free
   end interface

contains

   !> The root of `f` between `lower` and `upper`, where its signs differ, to the last few bits.
   subroutine find_root(f, lower, upper, root, error)
      !> The function
      class(scalar_function_type), intent(in), target :: f
      !> Lower end of the bracket
      real(wp), intent(in) :: lower
      !> Upper end
      real(wp), intent(in) :: upper
      !> The root
      real(wp), intent(out) :: root
      !> No bracket, the signs do not differ, or no convergence
      type(error_type), allocatable, intent(out) :: error
      type(callback_data_type), target :: context
      type(c_ptr) :: old_handler, solver
      integer(c_int) :: status
      integer :: i

      root = lower
      if (.not. lower < upper) then
         call raise(error, "find_root: bracket "//text(lower)//".."//text(upper) &
                    //"; lower end < upper end expected")
         return
      end if
      context%f => f
      old_handler = gsl_set_error_handler_off()
      solver = gsl_root_fsolver_alloc(brent_of_gsl())
      if (.not. c_associated(solver)) then
         call raise(error, "find_root: out of memory")
         return
      end if
      status = gsl_root_fsolver_set(solver, gsl_function(c_funloc(callback), c_loc(context)), &
                                    lower, upper)
      if (status /= gsl_success) then
         call raise(error, "find_root: f("//text(lower)//") = "//text(f%value(lower))//" and f(" &
                    //text(upper)//") = "//text(f%value(upper))//"; opposite signs expected")
      end if
      do i = 1, most_iterations
         if (allocated(error)) exit
         status = gsl_root_fsolver_iterate(solver)
         root = gsl_root_fsolver_root(solver)
         if (status == gsl_success) then
            status = gsl_root_test_interval(gsl_root_fsolver_x_lower(solver), &
                                            gsl_root_fsolver_x_upper(solver), 0.0_wp, &
                                            4.0_wp*epsilon(1.0_wp))
            if (status == gsl_success) exit
         end if
         if (i == most_iterations) then
            call raise(error, "find_root: no convergence in "//text(most_iterations)//" iterations")
         end if
      end do
      call gsl_root_fsolver_free(solver)
   end subroutine find_root

   !> The root of `f` where it falls from positive to negative values between 0 and infinity: the
   !> bracket is found by halving and doubling.
   subroutine find_falling_root(f, start, root, error)
      !> The function
      class(scalar_function_type), intent(in), target :: f
      !> Where the search begins, > 0
      real(wp), intent(in) :: start
      !> The root
      real(wp), intent(out) :: root
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: lower, upper

      lower = start
      do while (f%value(lower) <= 0.0_wp)
         lower = 0.5_wp*lower
      end do
      upper = 2.0_wp*lower
      do while (f%value(upper) >= 0.0_wp)
         upper = 2.0_wp*upper
      end do
      call find_root(f, lower, upper, root, error)
   end subroutine find_falling_root

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
