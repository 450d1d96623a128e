!> NetCDF-4 files, which appear only when they are complete.
module netcdf_output
   use, intrinsic :: iso_fortran_env, only: compiler_version
   use dde_errors, only: error_type, raise
   use dde_kinds, only: int64, wp
   use netcdf, only: nf90_char, nf90_close, nf90_create, nf90_def_dim, nf90_def_var, nf90_double, &
                     nf90_global, nf90_int, nf90_netcdf4, nf90_noclobber, nf90_noerr, &
                     nf90_put_att, nf90_put_var, nf90_strerror
   use unfinished_file, only: remedy, unfinished_type
   use version, only: project_version
   implicit none (type, external)
   private
   public :: output_file_type

   !> A file in the making; after the first error all further calls do nothing.
   type :: output_file_type
      private
      !> Where it stands
      type(unfinished_type) :: place
      !> NetCDF id
      integer :: id = -1
      !> First error met
      type(error_type), allocatable, public :: error
   contains
      !> Begin a file
      procedure :: create
      !> A dimension
      procedure :: dimension
      !> A variable of real numbers or integers
      procedure :: real_variable, integer_variable
      !> An attribute of a variable or, without one, of the file
      generic :: attribute => text_attribute, real_attribute, integer_attribute
      !> Values of a variable
      generic :: put => put_reals, put_integers
      !> A variable of words, or a compressed one over two dimensions, with its values
      procedure :: words, table
      !> Complete the file
      procedure :: finish
      !> Give it up
      procedure :: discard
      procedure, private :: note, text_attribute, real_attribute, integer_attribute
      procedure, private :: put_reals, put_integers
   end type output_file_type

contains

   !> Begin a file with the attributes that all files have.
   subroutine create(self, path, title)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its path once complete
      character(len=*), intent(in) :: path
      !> What it holds
      character(len=*), intent(in) :: title

      call self%place%begin(path, self%error)
      if (allocated(self%error)) return
      call self%note(nf90_create(self%place%other_path, ior(nf90_netcdf4, nf90_noclobber), self%id))
      call self%attribute("title", title)
      call self%attribute("program_version", project_version)
      call self%attribute("compiler", compiler_version())
   end subroutine create

   !> Keep the first error and leave nothing behind.
   subroutine note(self, status)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> What a NetCDF call returned
      integer, intent(in) :: status

      if (status == nf90_noerr .or. allocated(self%error)) return
      call raise(self%error, self%place%path//": cannot write: "//trim(nf90_strerror(status)) &
                 //remedy)
      call self%discard()
   end subroutine note

   !> Define a dimension.
   integer function dimension(self, name, length) result(id)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its length
      integer, intent(in) :: length

      id = -1
      if (allocated(self%error)) return
      call self%note(nf90_def_dim(self%id, name, length, id))
   end function dimension

   !> Define a variable of real numbers over one dimension.
   integer function real_variable(self, name, dimension, long_name, units) result(id)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its dimension
      integer, intent(in) :: dimension
      !> What it is
      character(len=*), intent(in) :: long_name
      !> Its unit, '1' where nondimensional
      character(len=*), intent(in) :: units

      id = -1
      if (allocated(self%error)) return
      call self%note(nf90_def_var(self%id, name, nf90_double, [dimension], id))
      call self%attribute("long_name", long_name, id)
      call self%attribute("units", units, id)
   end function real_variable

   !> Define a variable of integers over one dimension.
   integer function integer_variable(self, name, dimension, long_name) result(id)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its dimension
      integer, intent(in) :: dimension
      !> What it is
      character(len=*), intent(in) :: long_name

      id = -1
      if (allocated(self%error)) return
      call self%note(nf90_def_var(self%id, name, nf90_int, [dimension], id))
      call self%attribute("long_name", long_name, id)
   end function integer_variable

   !> Define and write a variable of words over one dimension.
   subroutine words(self, name, dimension, values, long_name)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its dimension
      integer, intent(in) :: dimension
      !> Its values
      character(len=*), intent(in) :: values(:)
      !> What it is
      character(len=*), intent(in) :: long_name
      integer :: id, letters

      letters = self%dimension(name//"_letters", len(values))
      if (allocated(self%error)) return
      call self%note(nf90_def_var(self%id, name, nf90_char, [letters, dimension], id))
      call self%attribute("_Encoding", "utf-8", id)
      call self%attribute("long_name", long_name, id)
      if (.not. allocated(self%error)) call self%note(nf90_put_var(self%id, id, values))
   end subroutine words

   !> Define and write a compressed variable of nondimensional real numbers over two dimensions.
   subroutine table(self, name, dimensions, values, long_name)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its dimensions, the faster first
      integer, intent(in) :: dimensions(2)
      !> Its values
      real(wp), intent(in) :: values(:, :)
      !> What it is
      character(len=*), intent(in) :: long_name
      integer :: id

      if (allocated(self%error)) return
      call self%note(nf90_def_var(self%id, name, nf90_double, dimensions, id, deflate_level=4, &
                                  shuffle=.true.))
      call self%attribute("long_name", long_name, id)
      call self%attribute("units", "1", id)
      if (.not. allocated(self%error)) call self%note(nf90_put_var(self%id, id, values))
   end subroutine table

   !> A word or sentence.
   subroutine text_attribute(self, name, value, variable)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its value
      character(len=*), intent(in) :: value
      !> Variable it belongs to
      integer, intent(in), optional :: variable

      if (allocated(self%error)) return
      call self%note(nf90_put_att(self%id, owner(variable), name, value))
   end subroutine text_attribute

   !> A real number.
   subroutine real_attribute(self, name, value, variable)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), intent(in) :: value
      !> Variable it belongs to
      integer, intent(in), optional :: variable

      if (allocated(self%error)) return
      call self%note(nf90_put_att(self%id, owner(variable), name, value))
   end subroutine real_attribute

   !> An integer.
   subroutine integer_attribute(self, name, value, variable)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its value
      integer(int64), intent(in) :: value
      !> Variable it belongs to
      integer, intent(in), optional :: variable

      if (allocated(self%error)) return
      if (abs(value) > huge(1)) then
         ! NetCDF's Fortran interface takes no longer integers
         call self%real_attribute(name, real(value, wp), variable)
      else
         call self%note(nf90_put_att(self%id, owner(variable), name, int(value)))
      end if
   end subroutine integer_attribute

   !> Id of an attribute's owner.
   pure integer function owner(variable) result(value)
      !> Variable, if any
      integer, intent(in), optional :: variable

      value = nf90_global
      if (present(variable)) value = variable
   end function owner

   !> Write real numbers, from index `first` on.
   subroutine put_reals(self, variable, values, first)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Variable
      integer, intent(in) :: variable
      !> Values
      real(wp), intent(in) :: values(:)
      !> Index of the first, from 1
      integer, intent(in), optional :: first
      integer :: start

      if (allocated(self%error)) return
      start = 1
      if (present(first)) start = first
      call self%note(nf90_put_var(self%id, variable, values, start=[start]))
   end subroutine put_reals

   !> Write integers.
   subroutine put_integers(self, variable, values)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> Variable
      integer, intent(in) :: variable
      !> Values
      integer, intent(in) :: values(:)

      if (allocated(self%error)) return
      call self%note(nf90_put_var(self%id, variable, values))
   end subroutine put_integers

   !> Close the file and give it its name; on an error nothing is left behind.
   subroutine finish(self, error)
      !> The file
      class(output_file_type), intent(inout) :: self
      !> First error met
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(self%error)) call self%note(nf90_close(self%id))
      if (.not. allocated(self%error)) then
         call self%place%publish(self%error)
      end if
      if (allocated(self%error)) allocate (error, source=self%error)
   end subroutine finish

   !> Leave nothing behind.
   subroutine discard(self)
      !> The file
      class(output_file_type), intent(inout) :: self
      integer :: status

      status = nf90_close(self%id)
      call self%place%discard()
   end subroutine discard
end module netcdf_output
