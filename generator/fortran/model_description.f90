! SPDX-License-Identifier: BSD-3-Clause
!> What the definition of a compiled model says, read from the lines of its description.
module model_description
   use, intrinsic :: iso_c_binding, only: c_char
   use dde_errors, only: text_of => text
   use dde_kinds, only: wp
   use model_border, only: describe_line, letters => line_length
   implicit none (type, external)
   private
   public :: at_rest, auxiliary_type, description_of, description_type, line_length, &
             observed_type, of_far_node, of_near_node, of_node, parameter_type, sizes_type, &
             unbounded, word_length

   !> Letters of names; of meanings and equations.
   integer, parameter :: word_length = 64, line_length = 512
   !> Bound of a parameter that has none.
   real(wp), parameter :: unbounded = -huge(1.0_wp)

   !> A level that is the value at rest.
   real(wp), parameter :: at_rest = huge(1.0_wp)

   !> Whose a delayed value of a network is: of each node by its own delays or, for each edge by its
   !> delays, of the node at which it begins or ends.
   integer, parameter :: of_node = 1, of_far_node = 2, of_near_node = 3

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

   !> A name for the exponential of a state.
   type :: auxiliary_type
      !> Its name
      character(len=word_length) :: name = ""
      !> Number of the state
      integer :: state = 0
   end type auxiliary_type

   !> What is looked at in motions: the signal, a component of the state or its exponential.
   type :: observed_type
      !> Component of the signal
      integer :: component = 1
      !> Whether the signal is the exponential of the component
      logical :: is_exponential = .false.
      !> Values of the component: in the section, where it rises, and above which there is an event;
      !> `at_rest` stands for its value at rest
      real(wp) :: section = at_rest, event = at_rest
      !> Component that grows by the integral of the signal, 0 if there is none; whether it grows by
      !> the integral less the time
      integer :: integral = 0
      logical :: with_time = .false.
      !> Components that are the coordinates of points of the section, 0 where there are fewer
      integer :: coordinates(2) = 0
   end type observed_type

   !> Sizes of a definition.
   type :: sizes_type
      !> Numbers of parameters, of equations with their parts, of states and of delayed states, of
      !> terms of the characteristic function, and of exponential terms
      integer :: parameters = 0, equations = 0, states = 0, delayed = 0, terms = 0
      integer :: exponentials = 0
      !> Number of these whose exponents depend on delayed states
      integer :: delayed_exponents = 0
      !> Number of delayed states, the last, whose delays depend on time or states
      integer :: moving = 0
      !> Number of switches, where the equations are not smooth
      integer :: switches = 0
      !> Number of these, the last, at which the state changes
      integer :: acting = 0
      !> Equations of a chain with a second difference, and the states of which they take it, shape
      !> (2, couplings)
      integer, allocatable :: couplings(:, :)
      !> Of a network, parameters of each node and of each edge
      integer :: vectors = 0, matrices = 0
      !> Whether an edge takes part, by the set of its parameters that are 0, shape (0:); none of a
      !> model that is no network
      logical, allocatable :: needed(:)
      !> Whether all nodes depend on all
      logical :: full = .false.
      !> Of the delayed values of a network whose they are, and the numbers of the states
      integer, allocatable :: read(:), read_states(:)
      !> What is looked at in motions
      type(observed_type) :: observed
      !> Whether time is in the equations: then no disturbance along the flow stays as it is
      logical :: driven = .false.
   end type sizes_type

   !> What a definition says, for messages and files.
   type :: description_type
      !> Name, what kind of model it is, and where the equations are from
      character(len=line_length) :: name = "", kind = "", source = ""
      !> Where a state at rest is, or near which it is looked for
      character(len=line_length) :: rest = ""
      !> Parameters
      type(parameter_type), allocatable :: parameters(:)
      !> Names and meanings of the states
      character(len=word_length), allocatable :: states(:)
      character(len=line_length), allocatable :: meanings(:)
      !> Names of exponentials
      type(auxiliary_type), allocatable :: auxiliaries(:)
      !> Equations and definitions as they are written, one a line
      character(len=line_length), allocatable :: equations(:)
      !> Terms that are not smooth, as they are written
      character(len=line_length), allocatable :: switches(:)
      !> Sizes of the definition
      type(sizes_type) :: sizes
   contains
      !> What it calls a value of the problem
      procedure :: name_of
   end type description_type

contains

   !> What the definition says.
   type(description_type) function description_of(lines) result(description)
      !> The lines of the description
      procedure(describe_line), pointer, intent(in) :: lines
      character(len=line_length) :: words(9)
      character(len=*), parameter :: read_of(3) = ["node", "far ", "near"]
      integer :: equation, i, number, pair(2), parameter, place

      allocate (description%states(0), description%meanings(0), description%auxiliaries(0))
      allocate (description%switches(0), description%sizes%couplings(2, 0))
      allocate (description%sizes%read(0), description%sizes%read_states(0))
      equation = 0
      parameter = 0
      ! behind the line of the interface
      number = 2
      do while (has_line(lines, number, words))
         select case (words(1))
         case ("sizes")
            associate (sizes => description%sizes)
               read (words(2:9), *) sizes%parameters, sizes%equations, sizes%states, &
                  sizes%delayed, sizes%terms, sizes%exponentials, sizes%delayed_exponents, &
                  sizes%switches
               allocate (description%parameters(sizes%parameters), &
                         description%equations(sizes%equations))
            end associate
         case ("coupling")
            read (words(2:3), *) pair
            associate (sizes => description%sizes)
               sizes%couplings = reshape([sizes%couplings, pair], [2, size(sizes%couplings, 2) + 1])
            end associate
         case ("network")
            associate (sizes => description%sizes)
               read (words(2:3), *) sizes%vectors, sizes%matrices
               allocate (sizes%needed(0:2**sizes%matrices - 1))
               sizes%needed = [(words(4) (i:i) == "1", i=1, size(sizes%needed))]
               sizes%full = words(5) == "1"
            end associate
         case ("delayed")
            associate (sizes => description%sizes)
               read (words(3), *) place
               sizes%read = [sizes%read, findloc(read_of, words(2), dim=1)]
               sizes%read_states = [sizes%read_states, place]
            end associate
         case ("observed")
            description%sizes%observed = observed_of(words)
         case ("moving")
            read (words(2), *) description%sizes%moving
         case ("acting")
            read (words(2), *) description%sizes%acting
         case ("driven")
            description%sizes%driven = .true.
         case ("name")
            description%name = words(2)
         case ("rest")
            description%rest = words(2)
         case ("kind")
            description%kind = words(2)
         case ("source")
            description%source = words(2)
         case ("equation")
            equation = equation + 1
            description%equations(equation) = words(2)
         case ("switch")
            description%switches = [character(len=line_length) :: description%switches, words(2)]
         case ("parameter")
            parameter = parameter + 1
            description%parameters(parameter) = parameter_type(words(2), words(3), words(4))
         case ("state")
            description%states = [character(len=word_length) :: description%states, words(2)]
            description%meanings = [character(len=line_length) :: description%meanings, words(3)]
         case ("auxiliary")
            read (words(3), *) place
            description%auxiliaries = [description%auxiliaries, auxiliary_type(words(2), place)]
         case ("above")
            read (words(2), *) description%parameters(parameter)%above
         case ("at_least")
            read (words(2), *) description%parameters(parameter)%at_least
         case default
            ! no other line is written
         end select
         number = number + 1
      end do
   end function description_of

   !> What is looked at, from its line.
   type(observed_type) function observed_of(words) result(observed)
      character(len=line_length), intent(in) :: words(:)
      integer :: numbers(6)

      read (words(2:3), *) numbers(:2)
      read (words(6:9), *) numbers(3:)
      observed = observed_type(component=numbers(1), is_exponential=numbers(2) == 1, &
                               integral=numbers(3), with_time=numbers(4) == 1, &
                               coordinates=numbers(5:))
      call read_level(words(4), observed%section)
      call read_level(words(5), observed%event)

   contains

      !> The value of the component where the signal has a level.
      subroutine read_level(word, level)
         character(len=*), intent(in) :: word
         real(wp), intent(inout) :: level

         if (word == "rest") return
         read (word, *) level
         if (observed%is_exponential) level = log(level)
      end subroutine read_level
   end function observed_of

   !> What it calls a value of the problem, of a kind that `dde_problem_type` has.
   pure function name_of(self, kind, number, blocks) result(name)
      class(description_type), intent(in) :: self
      character(len=*), intent(in) :: kind
      integer, intent(in) :: number
      !> Numbers of blocks in the order of the state vector
      integer, intent(in) :: blocks(:)
      character(len=:), allocatable :: name
      integer :: place

      place = (number - 1)/size(self%states)
      if (kind == "lag") then
         name = "delay "//text_of(number)
      else if (kind == "switching") then
         name = trim(self%switches(number))
      else if (place >= size(blocks)) then
         name = kind//"("//text_of(number)//")"
      else
         name = trim(self%states(number - place*size(self%states)))
         associate (is_network => allocated(self%sizes%needed), block => blocks(1 + place))
            if (is_network) name = name//"["//text_of(block - 1)//"]"
            if (kind == "f") name = name//"'"
            if (size(blocks) > 1 .and. .not. is_network) name = name//" of block "//text_of(block)
         end associate
      end if
   end function name_of

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
