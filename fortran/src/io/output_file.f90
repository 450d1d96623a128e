!> NetCDF-4 files by the CF conventions, which appear only when they are complete.
module output_file
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only: compiler_version
   use dde_errors, only: error_type, raise
   use dde_kinds, only: int64, wp
   use netcdf, only: nf90_char, nf90_close, nf90_create, nf90_def_dim, nf90_def_var, nf90_double, &
                     nf90_global, nf90_inq_dimid, nf90_int, nf90_netcdf4, nf90_noerr, &
                     nf90_put_att, nf90_put_var, nf90_strerror
   use program_arguments, only: command_name
   use unfinished_file, only: unfinished_type
   use version, only: project_version
   implicit none (type, external)
   private
   public :: joined, output_file_type

   !> Level of compression: higher levels take longer and save at most 1 % more
   integer, parameter :: level = 4
   !> What all results are made from
   character(len=*), parameter :: paper = "S. Kostic, N. Vasovic, I. Franovic, K. Todorovic: &
                                          &Time-delay in spring-block model for aperiodicity in &
                                          &earthquakes"

   !> A dimension.
   type :: axis_type
      !> Name of the dimension
      character(len=64) :: name = ""
      !> Names of variables that say where along it a value belongs, with blanks between
      character(len=64) :: coordinates = ""
      !> What the names of variables begin with that have it as their slowest dimension
      character(len=64) :: prefix = ""
   end type axis_type

   !> A file in the making; after the first error all further calls do nothing. A variable has a
   !> name, dimensions, values and a description, its `long_name`.
   type :: output_file_type
      private
      !> Where it stands
      type(unfinished_type) :: place
      !> NetCDF id
      integer :: id = -1
      !> Dimensions of the file
      type(axis_type), allocatable :: axes(:)
      !> First error met
      type(error_type), allocatable, public :: error
   contains
      generic :: column => column_of_reals, column_of_integers
      procedure :: create, dimension, real_variable, put, words, flags, answers, table, attribute, &
         finish, discard
      procedure, private :: note, variable, column_of_reals, column_of_integers
   end type output_file_type

contains

   !> Begin a file with the attributes that all files have.
   subroutine create(self, path, title)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      !> Title of the file: what it holds
      character(len=*), intent(in) :: title

      call self%place%begin(path, self%error)
      if (allocated(self%error)) return
      call self%note(nf90_create(self%place%part, nf90_netcdf4, self%id))
      allocate (self%axes(0))
      call self%attribute("Conventions", "CF-1.8")
      call self%attribute("title", title)
      call self%attribute("institution", "the maintainers of this reproduction")
      call self%attribute("source", "program "//command_name()//" "//project_version)
      call self%attribute("history", "written by "//command_name() &
                          //"; without a time, so that two runs give the same bytes")
      call self%attribute("references", paper)
      call self%attribute("program_version", project_version)
      call self%attribute("compiler", compiler_version())
   end subroutine create

   !> Keep the first error and leave nothing behind.
   subroutine note(self, status)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: status

      if (status == nf90_noerr .or. allocated(self%error)) return
      call self%place%fail(trim(nf90_strerror(status)), self%error)
      call self%discard()
   end subroutine note

   !> Define a dimension, if there is none of this name.
   integer function dimension(self, name, length, coordinates, prefix) result(id)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: length
      !> Names of variables that say where along it a value belongs, with blanks between
      character(len=*), intent(in), optional :: coordinates
      !> What the names of variables begin with that have it as their slowest dimension
      character(len=*), intent(in), optional :: prefix

      id = -1
      if (allocated(self%error)) return
      if (nf90_inq_dimid(self%id, name, id) == nf90_noerr) return
      call self%note(nf90_def_dim(self%id, name, length, id))
      self%axes = [self%axes, axis_type(name)]
      if (present(coordinates)) self%axes(size(self%axes))%coordinates = coordinates
      if (present(prefix)) self%axes(size(self%axes))%prefix = prefix
   end function dimension

   !> Define a variable, compressed and with a checksum, so that readers refuse damaged values. NaN
   !> is a missing value of real numbers.
   integer function variable(self, name, kind, dimensions, long_name, units) result(id)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> NetCDF's number of its type
      integer, intent(in) :: kind
      !> Dimensions of the variable, the fastest first
      integer, intent(in) :: dimensions(:)
      character(len=*), intent(in) :: long_name
      character(len=*), intent(in), optional :: units
      character(len=:), allocatable :: coordinates, whole
      integer :: i

      id = -1
      if (allocated(self%error)) return
      whole = trim(self%axes(dimensions(size(dimensions)))%prefix)//name
      call self%note(nf90_def_var(self%id, whole, kind, dimensions, id, deflate_level=level, &
                                  shuffle=.true., fletcher32=.true.))
      call self%attribute("long_name", long_name, id)
      coordinates = ""
      do i = 1, size(dimensions)
         coordinates = trim(coordinates//" "//self%axes(dimensions(i))%coordinates)
      end do
      ! those variables themselves have none
      if (coordinates /= "" .and. index(coordinates//" ", " "//whole//" ") == 0) then
         call self%attribute("coordinates", coordinates(2:), id)
      end if
      if (present(units)) call self%attribute("units", units, id)
      ! values along an axis cannot be missing
      if (kind == nf90_double .and. whole /= self%axes(dimensions(1))%name) then
         call self%attribute("_FillValue", ieee_value(1.0_wp, ieee_quiet_nan), id)
      end if
   end function variable

   !> Define a variable of real numbers.
   integer function real_variable(self, name, dimensions, long_name, units) result(id)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Dimensions of the variable, the fastest first
      integer, intent(in) :: dimensions(:)
      character(len=*), intent(in) :: long_name
      !> Unit of the variable, if it is not nondimensional
      character(len=*), intent(in), optional :: units
      character(len=:), allocatable :: unit

      unit = "1"
      if (present(units)) unit = units
      id = self%variable(name, nf90_double, dimensions, long_name, unit)
   end function real_variable

   !> Define and write a variable of real numbers over one dimension.
   subroutine column_of_reals(self, dimension, name, values, long_name, units)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      !> Unit of the variable, if it is not nondimensional
      character(len=*), intent(in), optional :: units

      call self%put(self%real_variable(name, [dimension], long_name, units), values)
   end subroutine column_of_reals

   !> Define and write a variable of integers over one dimension.
   subroutine column_of_integers(self, dimension, name, values, long_name, lengths_along)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      integer, intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      !> Dimension along which lines of these lengths stand one after another, as CF 1.8 marks them
      character(len=*), intent(in), optional :: lengths_along
      integer :: id

      id = self%variable(name, nf90_int, [dimension], long_name, "1")
      if (present(lengths_along)) call self%attribute("sample_dimension", lengths_along, id)
      call self%note(nf90_put_var(self%id, id, values))
   end subroutine column_of_integers

   !> Define and write a variable of words over one dimension, filled up with null characters.
   subroutine words(self, dimension, name, values, long_name)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      character(len=max(1, maxval(len_trim(values)))) :: ended(size(values))
      integer :: i, id, letters

      do i = 1, size(values)
         ended(i) = trim(values(i))//repeat(achar(0), len(ended) - len_trim(values(i)))
      end do
      if (allocated(self%error)) return
      letters = self%dimension(trim(self%axes(dimension)%prefix)//name//"_letters", len(ended))
      id = self%variable(name, nf90_char, [letters, dimension], long_name)
      call self%attribute("_Encoding", "utf-8", id)
      call self%note(nf90_put_var(self%id, id, ended))
   end subroutine words

   !> Define and write a variable whose values stand for words.
   subroutine flags(self, dimension, name, values, meanings, long_name, codes)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      integer, intent(in) :: values(:)
      !> The word of each value, in their order
      character(len=*), intent(in) :: meanings(:)
      character(len=*), intent(in) :: long_name
      !> All values that it can have; if they are left out, 0, 1, ...
      integer, intent(in), optional :: codes(:)
      integer :: i, id, numbers(size(meanings))

      numbers = [(i, i=0, size(meanings) - 1)]
      if (present(codes)) numbers = codes
      id = self%variable(name, nf90_int, [dimension], long_name)
      call self%note(nf90_put_att(self%id, id, "flag_values", numbers))
      call self%attribute("flag_meanings", joined(meanings), id)
      call self%note(nf90_put_var(self%id, id, values))
   end subroutine flags

   !> Define and write a variable of yes and no.
   subroutine answers(self, dimension, name, values, long_name)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name, long_name
      logical, intent(in) :: values(:)

      call self%flags(dimension, name, merge(1, 0, values), ["no ", "yes"], long_name)
   end subroutine answers

   !> Words in one line, with underscores for blanks within them.
   pure function joined(words) result(line)
      character(len=*), intent(in) :: words(:)
      character(len=:), allocatable :: line
      integer :: i, j

      line = ""
      do i = 1, size(words)
         if (i > 1) line = line//" "
         do j = 1, len_trim(words(i))
            line = line//merge("_", words(i) (j:j), words(i) (j:j) == " ")
         end do
      end do
   end function joined

   !> Define and write nondimensional real numbers over two dimensions.
   subroutine table(self, dimensions, name, values, long_name)
      class(output_file_type), intent(inout) :: self
      !> Dimensions of the variable, the faster first
      integer, intent(in) :: dimensions(2)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:, :)
      character(len=*), intent(in) :: long_name

      call self%put(self%real_variable(name, dimensions, long_name), [values], &
                    count=shape(values))
   end subroutine table

   !> Set an attribute of the file or of a variable.
   subroutine attribute(self, name, value, variable)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Text, a real number or a long integer
      class(*), intent(in) :: value
      !> Variable that the attribute belongs to, if not to the file
      integer, intent(in), optional :: variable
      integer :: owner

      owner = nf90_global
      if (present(variable)) owner = variable
      select type (value)
      type is (character(len=*))
         call self%note(nf90_put_att(self%id, owner, name, value))
      type is (real(wp))
         call self%note(nf90_put_att(self%id, owner, name, value))
      type is (integer(int64))
         ! NetCDF's Fortran interface takes no longer integers
         if (abs(value) > huge(1)) then
            call self%note(nf90_put_att(self%id, owner, name, real(value, wp)))
         else
            call self%note(nf90_put_att(self%id, owner, name, int(value)))
         end if
      class default
         call raise(self%error, "attribute "//name//": neither text, real nor long integer")
      end select
   end subroutine attribute

   !> Write values of a variable of real numbers.
   subroutine put(self, variable, values, start, count)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: variable
      real(wp), intent(in) :: values(:)
      !> Indices of the first value, 1 if they are left out, and numbers of values along dimensions
      integer, intent(in), optional :: start(:), count(:)

      call self%note(nf90_put_var(self%id, variable, values, start=start, count=count))
   end subroutine put

   !> Close the file and give it its name; on an error nothing is left behind.
   subroutine finish(self, error)
      class(output_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(self%error)) call self%note(nf90_close(self%id))
      if (.not. allocated(self%error)) call self%place%publish("", self%error)
      if (allocated(self%error)) allocate (error, source=self%error)
   end subroutine finish

   !> Leave nothing behind.
   subroutine discard(self)
      class(output_file_type), intent(inout) :: self
      integer :: status

      status = nf90_close(self%id)
      self%id = -1
      call self%place%discard()
   end subroutine discard
end module output_file
