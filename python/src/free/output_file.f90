!> Results in memory, in place of the NetCDF files of `fortran/src/io/output_file.f90`: dimensions,
!> variables over them and attributes, which callers read by names.
module output_file
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_intptr_t, c_null_ptr, c_ptr
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: attribute_type, integers, joined, letters, output_file_type, place_of, reals, &
             variable_type

   !> Letters of a name.
   integer, parameter :: name_length = 64
   !> Kinds of values.
   integer, parameter :: reals = 1, integers = 2, letters = 3

   !> A dimension.
   type :: dimension_type
      !> Its name
      character(len=name_length) :: name = ""
      !> Its length
      integer :: length = 0
      !> Names of variables that say where along it a value belongs, with blanks between
      character(len=name_length) :: coordinates = ""
      !> What the names of variables begin with that have it as their slowest dimension
      character(len=name_length) :: prefix = ""
   end type dimension_type

   !> An attribute: a text, or numbers.
   type :: attribute_type
      character(len=name_length) :: name = ""
      !> One of the kinds of values
      integer :: kind = letters
      character(len=:), allocatable :: text
      real(wp), allocatable :: reals(:)
      integer, allocatable :: integers(:)
   end type attribute_type

   !> A variable. Its values stand in a row, the first dimension the fastest.
   type :: variable_type
      character(len=name_length) :: name = ""
      !> One of the kinds of values
      integer :: kind = reals
      !> Numbers of its dimensions, the fastest first
      integer, allocatable :: dimensions(:)
      type(attribute_type), allocatable :: attributes(:)
      real(wp), allocatable :: reals(:)
      integer, allocatable :: integers(:)
      character(len=:), allocatable :: letters
   end type variable_type

   !> Results.
   type :: output_file_type
      type(dimension_type), allocatable :: dimensions(:)
      type(attribute_type), allocatable :: attributes(:)
      type(variable_type), allocatable :: variables(:)
      !> First error met
      type(error_type), allocatable :: error
      !> Where the results go when they are complete
      type(c_ptr), private :: place = c_null_ptr
   contains
      generic :: column => column_of_reals, column_of_integers
      procedure :: answers, attribute, create, dimension, finish, flags, table, words
      procedure, private :: add, column_of_integers, column_of_reals
   end type output_file_type

contains

   !> The path that stands for results of a caller: the digits of their address.
   function place_of(results) result(path)
      type(c_ptr), intent(in) :: results
      character(len=:), allocatable :: path
      character(len=24) :: digits

      write (digits, "(i0)") transfer(results, 0_c_intptr_t)
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
      type(output_file_type), pointer :: results

      call c_f_pointer(self%place, results)
      call move_alloc(self%dimensions, results%dimensions)
      call move_alloc(self%attributes, results%attributes)
      call move_alloc(self%variables, results%variables)
      if (allocated(self%error)) allocate (error, source=self%error)
   end subroutine finish

   !> The number of a dimension; it is defined if there is none of this name.
   integer function dimension(self, name, length, coordinates, prefix) result(number)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: length
      !> Names of variables that say where along it a value belongs, with blanks between
      character(len=*), intent(in), optional :: coordinates
      !> What the names of variables begin with that have it as their slowest dimension
      character(len=*), intent(in), optional :: prefix

      if (.not. allocated(self%dimensions)) allocate (self%dimensions(0))
      number = findloc(self%dimensions%name == name, .true., dim=1)
      if (number > 0) return
      self%dimensions = [self%dimensions, dimension_type(name, length)]
      number = size(self%dimensions)
      if (present(coordinates)) self%dimensions(number)%coordinates = coordinates
      if (present(prefix)) self%dimensions(number)%prefix = prefix
   end function dimension

   !> Set an attribute of the whole, or of a variable.
   subroutine attribute(self, name, value, variable)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Text, a real number, an integer or a long one
      class(*), intent(in) :: value
      !> Number of the variable that it belongs to, if not to the whole
      integer, intent(in), optional :: variable
      type(attribute_type) :: one

      one%name = name
      select type (value)
      type is (character(len=*))
         one%text = value
      type is (real(wp))
         one%kind = reals
         one%reals = [value]
      type is (integer)
         one%kind = integers
         one%integers = [value]
      type is (integer(int64))
         ! NetCDF's Fortran interface takes no longer integers
         one%kind = merge(reals, integers, abs(value) > huge(1))
         if (one%kind == reals) one%reals = [real(value, wp)]
         if (one%kind == integers) one%integers = [int(value)]
      end select
      if (present(variable)) then
         call append(self%variables(variable)%attributes, one)
      else
         call append(self%attributes, one)
      end if
   end subroutine attribute

   !> A variable of real numbers over one dimension; NaN is a missing value.
   subroutine column_of_reals(self, dimension, name, values, long_name, units)
      class(output_file_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      !> Unit of the variable, if it is not nondimensional
      character(len=*), intent(in), optional :: units

      call self%add(name, reals, [dimension], long_name)
      associate (last => self%variables(size(self%variables)))
         allocate (last%reals, source=values)
      end associate
      if (present(units)) then
         call self%attribute("units", units, size(self%variables))
      else
         call self%attribute("units", "1", size(self%variables))
      end if
   end subroutine column_of_reals

   !> A variable of nondimensional real numbers over two dimensions; NaN is a missing value.
   subroutine table(self, dimensions, name, values, long_name)
      class(output_file_type), intent(inout) :: self
      !> Numbers of the dimensions, the faster first
      integer, intent(in) :: dimensions(2)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:, :)
      character(len=*), intent(in) :: long_name

      call self%add(name, reals, dimensions, long_name)
      associate (last => self%variables(size(self%variables)))
         last%reals = reshape(values, [size(values)])
      end associate
      call self%attribute("units", "1", size(self%variables))
   end subroutine table

   !> A variable of integers over one dimension.
   subroutine column_of_integers(self, dimension, name, values, long_name, lengths_along)
      class(output_file_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      integer, intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      !> Dimension along which lines of these lengths stand one after another, as CF 1.8 marks them
      character(len=*), intent(in), optional :: lengths_along

      call self%add(name, integers, [dimension], long_name)
      associate (last => self%variables(size(self%variables)))
         allocate (last%integers, source=values)
      end associate
      call self%attribute("units", "1", size(self%variables))
      if (.not. present(lengths_along)) return
      call self%attribute("sample_dimension", lengths_along, size(self%variables))
   end subroutine column_of_integers

   !> A variable of words over one dimension, filled up with null characters.
   subroutine words(self, dimension, name, values, long_name)
      class(output_file_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      integer :: i, length

      length = max(1, maxval(len_trim(values)))
      i = self%dimension(trim(self%dimensions(dimension)%prefix)//name//"_letters", length)
      call self%add(name, letters, [i, dimension], long_name)
      associate (last => self%variables(size(self%variables)))
         last%letters = repeat(achar(0), length*size(values))
         do i = 1, size(values)
            last%letters(length*(i - 1) + 1:length*(i - 1) + len_trim(values(i))) = trim(values(i))
         end do
      end associate
   end subroutine words

   !> A variable of integers that stand for words.
   subroutine flags(self, dimension, name, values, meanings, long_name, codes)
      class(output_file_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      integer, intent(in) :: values(:)
      !> The word of each value, in their order
      character(len=*), intent(in) :: meanings(:)
      character(len=*), intent(in) :: long_name
      !> All values that it can have; if they are left out, 0, 1, ...
      integer, intent(in), optional :: codes(:)
      type(attribute_type) :: given
      integer :: i

      call self%add(name, integers, [dimension], long_name)
      given%name = "flag_values"
      given%kind = integers
      given%integers = [(i, i=0, size(meanings) - 1)]
      if (present(codes)) given%integers = codes
      associate (last => self%variables(size(self%variables)))
         allocate (last%integers, source=values)
         call append(last%attributes, given)
      end associate
      call self%attribute("flag_meanings", joined(meanings), size(self%variables))
   end subroutine flags

   !> A variable of yes and no.
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

   !> Begin a variable: its name, dimensions and description.
   subroutine add(self, name, kind, dimensions, long_name)
      class(output_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: kind, dimensions(:)
      character(len=*), intent(in) :: long_name
      type(variable_type), allocatable :: longer(:)
      integer :: i, there

      there = 0
      if (allocated(self%variables)) there = size(self%variables)
      allocate (longer(there + 1))
      do i = 1, there
         call take(self%variables(i), longer(i))
      end do
      longer(there + 1)%name = trim(self%dimensions(dimensions(size(dimensions)))%prefix)//name
      longer(there + 1)%kind = kind
      longer(there + 1)%dimensions = dimensions
      call move_alloc(longer, self%variables)
      call self%attribute("long_name", long_name, there + 1)
   end subroutine add

   !> Move a variable without a copy of its values.
   subroutine take(from, to)
      type(variable_type), intent(inout) :: from
      type(variable_type), intent(out) :: to

      to%name = from%name
      to%kind = from%kind
      call move_alloc(from%dimensions, to%dimensions)
      call move_alloc(from%attributes, to%attributes)
      call move_alloc(from%reals, to%reals)
      call move_alloc(from%integers, to%integers)
      call move_alloc(from%letters, to%letters)
   end subroutine take

   !> Append an attribute.
   subroutine append(attributes, one)
      type(attribute_type), allocatable, intent(inout) :: attributes(:)
      type(attribute_type), intent(in) :: one
      type(attribute_type), allocatable :: longer(:)
      integer :: there

      there = 0
      if (allocated(attributes)) there = size(attributes)
      allocate (longer(there + 1))
      if (there > 0) longer(:there) = attributes
      longer(there + 1) = one
      call move_alloc(longer, attributes)
   end subroutine append
end module output_file
