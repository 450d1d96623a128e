!> What the definition of a compiled model says, read from the lines of its description.
module model_description
   use, intrinsic :: iso_c_binding, only: c_char
   use dde_kinds, only: wp
   use model_border, only: describe_line, letters => line_length
   implicit none (type, external)
   private
   public :: description_of, description_type, line_length, parameter_type, sizes_of, sizes_type, &
             unbounded, word_length

   !> Letters of names; of meanings and equations.
   integer, parameter :: word_length = 64, line_length = 512
   !> Bound of a parameter that has none.
   real(wp), parameter :: unbounded = -huge(1.0_wp)

   !> A parameter.
   type :: parameter_type
      !> Its name
      character(len=word_length) :: name = ""
      !> What it is
      character(len=line_length) :: meaning = ""
      !> Its unit, or "nondimensional"
      character(len=word_length) :: unit = ""
      !> Values are above this, and at least that
      real(wp) :: above = unbounded, at_least = unbounded
   end type parameter_type

   !> What a definition says, for messages and files.
   type :: description_type
      !> Name, and where the equations are from
      character(len=line_length) :: name = "", source = ""
      !> Parameters
      type(parameter_type), allocatable :: parameters(:)
      !> Equations and definitions as they are written, one a line
      character(len=line_length), allocatable :: equations(:)
   end type description_type

   !> Sizes of a definition.
   type :: sizes_type
      !> Numbers of parameters, of equations with their parts, of states and of delayed states, and
      !> of terms of the characteristic function
      integer :: parameters = 0, equations = 0, states = 0, delayed = 0, terms = 0
      !> Equations of a chain with a second difference, and the states of which they take it, shape
      !> (2, couplings)
      integer, allocatable :: couplings(:, :)
   end type sizes_type

contains

   !> What the definition says.
   type(description_type) function description_of(lines, sizes) result(description)
      !> The lines of the description
      procedure(describe_line), pointer, intent(in) :: lines
      !> Sizes of the definition
      type(sizes_type), intent(in) :: sizes
      character(len=line_length) :: words(4)
      integer :: equation, number, parameter
      real(wp) :: bound

      allocate (description%parameters(sizes%parameters), description%equations(sizes%equations))
      equation = 0
      parameter = 0
      number = 2
      do while (has_line(lines, number, words))
         select case (words(1))
         case ("name")
            description%name = words(2)
         case ("source")
            description%source = words(2)
         case ("equation")
            equation = equation + 1
            description%equations(equation) = words(2)
         case ("parameter")
            parameter = parameter + 1
            description%parameters(parameter) = parameter_type(words(2), words(3), words(4))
         case ("above")
            read (words(2), *) bound
            description%parameters(parameter)%above = bound
         case ("at_least")
            read (words(2), *) bound
            description%parameters(parameter)%at_least = bound
         case default
            ! sizes, which are known
         end select
         number = number + 1
      end do
   end function description_of

   !> The sizes: the first lines of the description after that of the interface.
   type(sizes_type) function sizes_of(lines) result(sizes)
      !> The lines of the description
      procedure(describe_line), pointer, intent(in) :: lines
      character(len=line_length) :: words(6)
      integer :: number, pair(2)

      allocate (sizes%couplings(2, 0))
      number = 2
      do while (has_line(lines, number, words))
         select case (words(1))
         case ("sizes")
            read (words(2:), *) sizes%parameters, sizes%equations, sizes%states, sizes%delayed, &
               sizes%terms
         case ("coupling")
            read (words(2:3), *) pair
            sizes%couplings = reshape([sizes%couplings, pair], [2, size(sizes%couplings, 2) + 1])
         case default
            return
         end select
         number = number + 1
      end do
   end function sizes_of

   !> A line of a description, if there is one, in words.
   logical function has_line(lines, number, words) result(there)
      procedure(describe_line), pointer, intent(in) :: lines
      integer, intent(in) :: number
      character(len=line_length), intent(out) :: words(:)
      character(kind=c_char) :: text(letters)
      integer :: at, i, length, word

      length = lines(number, text)
      there = length > 0
      words = ""
      word = 1
      at = 0
      do i = 1, length
         if (text(i) == achar(9)) then
            word = word + 1
            at = 0
         else if (word <= size(words) .and. at < len(words)) then
            at = at + 1
            words(word) (at:at) = text(i)
         end if
      end do
   end function has_line
end module model_description
