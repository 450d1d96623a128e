! SPDX-License-Identifier: BSD-3-Clause
!> Results in memory: dimensions, variables over them and attributes, by names. A variable has a
!> name, dimensions, values and a description, its `long_name`.
module results
   use dde_errors, only: error_type, raise
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: attribute_type, joined, results_type, variable_type, written_type

   !> Letters of a name.
   integer, parameter :: name_length = 64

   !> A dimension.
   type :: dimension_type
      character(len=name_length) :: name = ""
      !> 0 if variables over it grow
      integer :: length = 0
      !> Names of variables that say where along it a value belongs, with blanks between
      character(len=name_length) :: coordinates = ""
      !> What the names of variables begin with that have it as their slowest dimension
      character(len=name_length) :: prefix = ""
   end type dimension_type

   !> An attribute: a text, or a real number, or integers, whichever is allocated.
   type :: attribute_type
      character(len=name_length) :: name = ""
      character(len=:), allocatable :: text
      real(wp), allocatable :: number
      integer, allocatable :: integers(:)
   end type attribute_type

   !> A variable. Its values, whichever are allocated, stand in a row, the first dimension the
   !> fastest.
   type :: variable_type
      character(len=name_length) :: name = ""
      !> Numbers of its dimensions, the fastest first
      integer, allocatable :: dimensions(:)
      type(attribute_type), allocatable :: attributes(:)
      !> NaN is a missing value
      real(wp), allocatable :: reals(:)
      !> Digits after the first of these in a table of text
      integer :: digits = 19
      integer, allocatable :: integers(:)
      !> Words of one length, filled up with null characters
      character(len=:), allocatable :: letters
   end type variable_type

   !> Results.
   type :: results_type
      type(dimension_type), allocatable :: dimensions(:)
      type(attribute_type), allocatable :: attributes(:)
      type(variable_type), allocatable :: variables(:)
      !> First error met
      type(error_type), allocatable :: error
   contains
      generic :: column => column_of_reals, column_of_integers
      procedure :: answers, attribute, dimension, flags, table, words, write_values
      procedure, private :: add, column_of_integers, column_of_reals
   end type results_type

   !> Results that are written to a file.
   type, abstract, extends(results_type) :: written_type
      !> Path of the file
      character(len=:), allocatable :: path
   contains
      procedure(change_file), deferred :: begin, finish, discard
   end type written_type

   abstract interface
      !> Begin the file before the work; write what is left and give it its name; or leave nothing
      !> behind.
      subroutine change_file(self)
         import :: written_type
         implicit none (type, external)
         class(written_type), intent(inout) :: self
      end subroutine change_file
   end interface

contains

   !> The number of a dimension; it is defined if there is none of this name.
   integer function dimension(self, name, length, coordinates, prefix) result(number)
      class(results_type), intent(inout) :: self
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
      class(results_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Text, a real number or a long integer
      class(*), intent(in) :: value
      !> Number of the variable that it belongs to, if not to the whole
      integer, intent(in), optional :: variable
      type(attribute_type) :: one

      one%name = name
      select type (value)
      type is (character(len=*))
         one%text = value
      type is (real(wp))
         one%number = value
      type is (integer(int64))
         ! NetCDF's Fortran interface takes no longer integers
         if (abs(value) > huge(1)) one%number = real(value, wp)
         if (abs(value) <= huge(1)) one%integers = [int(value)]
      class default
         call raise(self%error, "attribute "//name//": neither text, real nor long integer")
      end select
      if (present(variable)) then
         call append(self%variables(variable)%attributes, one)
      else
         call append(self%attributes, one)
      end if
   end subroutine attribute

   !> A variable of real numbers over one dimension.
   subroutine column_of_reals(self, dimension, name, values, long_name, units, digits)
      class(results_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      !> Unit of the variable, if it is not nondimensional
      character(len=*), intent(in), optional :: units
      !> Digits after the first in a table of text, if fewer than usual
      integer, intent(in), optional :: digits

      call self%add(name, [dimension], long_name, units)
      allocate (self%variables(size(self%variables))%reals, source=values)
      if (present(digits)) self%variables(size(self%variables))%digits = digits
   end subroutine column_of_reals

   !> A variable of nondimensional real numbers over two dimensions.
   subroutine table(self, dimensions, name, values, long_name)
      class(results_type), intent(inout) :: self
      !> Numbers of the dimensions, the faster first
      integer, intent(in) :: dimensions(2)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:, :)
      character(len=*), intent(in) :: long_name

      call self%add(name, dimensions, long_name)
      self%variables(size(self%variables))%reals = reshape(values, [size(values)])
   end subroutine table

   !> A variable of integers over one dimension.
   subroutine column_of_integers(self, dimension, name, values, long_name, lengths_along)
      class(results_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      integer, intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      !> Dimension along which lines of these lengths stand one after another, as CF 1.8 marks them
      character(len=*), intent(in), optional :: lengths_along

      call self%add(name, [dimension], long_name)
      allocate (self%variables(size(self%variables))%integers, source=values)
      if (.not. present(lengths_along)) return
      call self%attribute("sample_dimension", lengths_along, size(self%variables))
   end subroutine column_of_integers

   !> A variable of words over one dimension.
   subroutine words(self, dimension, name, values, long_name)
      class(results_type), intent(inout) :: self
      !> Number of the dimension
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: values(:)
      character(len=*), intent(in) :: long_name
      character(len=:), allocatable :: line
      integer :: i, length, letters

      length = max(1, maxval(len_trim(values)))
      letters = self%dimension(trim(self%dimensions(dimension)%prefix)//name//"_letters", length)
      call self%add(name, [letters, dimension], long_name)
      line = repeat(achar(0), length*size(values))
      do i = 1, size(values)
         line(length*(i - 1) + 1:length*(i - 1) + len_trim(values(i))) = trim(values(i))
      end do
      call move_alloc(line, self%variables(size(self%variables))%letters)
   end subroutine words

   !> A variable of integers that stand for words.
   subroutine flags(self, dimension, name, values, meanings, long_name, codes)
      class(results_type), intent(inout) :: self
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

      call self%add(name, [dimension], long_name)
      allocate (self%variables(size(self%variables))%integers, source=values)
      given%name = "flag_values"
      given%integers = [(i, i=0, size(meanings) - 1)]
      if (present(codes)) given%integers = codes
      call append(self%variables(size(self%variables))%attributes, given)
      call self%attribute("flag_meanings", joined(meanings), size(self%variables))
   end subroutine flags

   !> A variable of yes and no.
   subroutine answers(self, dimension, name, values, long_name)
      class(results_type), intent(inout) :: self
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name, long_name
      logical, intent(in) :: values(:)

      call self%flags(dimension, name, merge(1, 0, values), ["no ", "yes"], long_name)
   end subroutine answers

   !> Let go of values of which more are to come. Results in memory keep them all, so that they take
   !> none in parts.
   subroutine write_values(self, first)
      class(results_type), intent(inout) :: self
      !> Place of the first values along the slowest dimension, if it grows
      integer, intent(in), optional :: first

      call raise(self%error, "results that come in parts go to a file; there is none")
   end subroutine write_values

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

   !> Begin a variable: all but its values.
   subroutine add(self, name, dimensions, long_name, units)
      class(results_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: dimensions(:)
      character(len=*), intent(in) :: long_name
      character(len=*), intent(in), optional :: units
      type(variable_type), allocatable :: longer(:)
      integer :: i

      if (.not. allocated(self%variables)) allocate (self%variables(0))
      allocate (longer(size(self%variables) + 1))
      do i = 1, size(self%variables)
         call take(self%variables(i), longer(i))
      end do
      call move_alloc(longer, self%variables)
      i = size(self%variables)
      self%variables(i)%name = trim(self%dimensions(dimensions(size(dimensions)))%prefix)//name
      self%variables(i)%dimensions = dimensions
      call self%attribute("long_name", long_name, i)
      if (present(units)) call self%attribute("units", units, i)
   end subroutine add

   !> Move a variable without a copy of its values.
   subroutine take(from, to)
      type(variable_type), intent(inout) :: from
      type(variable_type), intent(out) :: to

      to%name = from%name
      to%digits = from%digits
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

      if (.not. allocated(attributes)) allocate (attributes(0))
      attributes = [attributes, one]
   end subroutine append
end module results
