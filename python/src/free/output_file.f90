! SPDX-License-Identifier: BSD-3-Clause
!> Results that go to a caller, in place of the files of `fortran/src/io/output_file.f90`.
module output_file
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_intptr_t, c_null_ptr, c_ptr
   use dde_errors, only: error_type
   use results, only: results_type
   implicit none (type, external)
   private
   public :: output_file_type, place_of

   !> Results in the making.
   type, extends(results_type) :: output_file_type
      !> Where they go when they are complete
      type(c_ptr), private :: place = c_null_ptr
   contains
      procedure :: create, finish
   end type output_file_type

contains

   !> The path that stands for results of a caller: the digits of their address.
   function place_of(address) result(path)
      type(c_ptr), intent(in) :: address
      character(len=:), allocatable :: path
      character(len=24) :: digits

      write (digits, "(i0)") transfer(address, 0_c_intptr_t)
      path = trim(digits)
   end function place_of

   !> Begin results that go to a place.
   subroutine create(self, path, title)
      class(output_file_type), intent(inout) :: self
      !> Of `place_of`
      character(len=*), intent(in) :: path
      !> What they are
      character(len=*), intent(in) :: title
      integer(c_intptr_t) :: address

      read (path, *) address
      self%place = transfer(address, self%place)
      call self%attribute("title", title)
   end subroutine create

   !> Give the results to the caller.
   subroutine finish(self, error)
      class(output_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      type(results_type), pointer :: given

      call c_f_pointer(self%place, given)
      call move_alloc(self%dimensions, given%dimensions)
      call move_alloc(self%attributes, given%attributes)
      call move_alloc(self%variables, given%variables)
      if (allocated(self%error)) allocate (error, source=self%error)
   end subroutine finish
end module output_file
